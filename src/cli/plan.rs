//! `edgewise plan`: what a scene requires.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;

use super::arguments;
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::plan_scene::{FoundScene, SceneArguments};
use super::progress::Progress;
use super::times::measured;
use crate::color::RgbSpace;
use crate::number::short;
use crate::preset::pretty_json;
use crate::scene::{MaterialPlan, Plan, PlanOptions, SavedPlan, SavedScene, Target, Tolerance, Verdict, plan_scene};
use crate::study::{Costs, Measure};

/// Arguments of `edgewise plan`.
#[derive(Debug, Args)]
pub struct PlanCommand {
    #[command(flatten)]
    scene: SceneArguments,
    /// A saved plan, to be planned again: what is not given is as it was, and no other file is needed
    #[arg(long, value_name = "PLAN", conflicts_with_all = NAMES_A_SCENE)]
    from: Option<PathBuf>,
    /// The largest ΔE2000 that is allowed, 1 unless given
    #[arg(long, value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Of which number: max (the default), mean or p95 (what 95 % of the pixels stay within)
    #[arg(long)]
    on: Option<Measure>,
    /// What is spared: real-time (shader operations, the default), offline (time on this machine), texture-memory
    /// (bytes)
    #[arg(long = "for", value_name = "TARGET")]
    target: Option<Target>,
    /// Also say the time that is saved, measured on this machine, which offline always does
    #[arg(long)]
    times: bool,
    /// The space of parameters and differences, lin_rec709 unless given
    #[arg(long)]
    space: Option<RgbSpace>,
    /// One row for each variant that was looked at
    #[arg(long)]
    detail: bool,
    /// Save the plan, for `edgewise export --plan` and `edgewise plan --from`
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the plan that is there
    #[arg(long, requires = "output")]
    force: bool,
    #[command(flatten)]
    format: FormatArguments,
}

/// The arguments of a scene that a saved plan takes the place of.
const NAMES_A_SCENE: [&str; 9] =
    ["materials", "list", "metals", "presets", "seen", "pass", "channel", "ids", "ids_channel"];

fn tolerance(text: &str) -> Result<f64, String> {
    let value = arguments::number(text)?;
    if value >= 0.0 { Ok(value) } else { Err(format!("a tolerance is at least 0, not {}", short(value))) }
}

/// What is planned for, and what was asked the last time.
struct Asked {
    scene: SavedScene,
    sentence: String,
    notes: Vec<String>,
    options: PlanOptions,
    has_times: bool,
}

impl PlanCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        self.refuse_to_replace()?;
        let mut warnings = Vec::new();
        let Asked { scene, sentence, notes, options, has_times } = self.asked(&mut warnings)?;
        warnings.extend(notes.iter().cloned());
        let costs = self.costs(options.target, has_times, &mut warnings)?;
        let options = PlanOptions { costs, ..options };
        let progress = Progress::new("Planning");
        let plan = plan_scene(&scene.scene_materials(), &sentence, &options, &|share| progress.report(share))?;
        let saved = SavedPlan { plan: Plan { notes, ..plan }, scene: Ok(scene) };
        if let Some(path) = &self.output {
            saved.save(path)?;
        }
        let plan = &saved.plan;
        let table = if self.detail { detail(plan) } else { table(plan) };
        let text = match self.format.format() {
            Format::Json => pretty_json(&saved.to_json()?),
            Format::Csv => table.to_csv(),
            Format::Table => format!("{}\n{}\n{}\n", table.to_text(), plan.scene, plan.summary()),
        };
        Ok(Output { text, warnings, ..Output::default() })
    }

    /// Before anything is read: a plan that is there is replaced only with `--force`.
    fn refuse_to_replace(&self) -> anyhow::Result<()> {
        match &self.output {
            Some(path) if !self.force && path.exists() => {
                bail!("{} is there already; --force replaces it", path.display())
            }
            _ => Ok(()),
        }
    }

    /// What the arguments ask for; with `--from`, what the saved plan asked for where they do not.
    fn asked(&self, warnings: &mut Vec<String>) -> anyhow::Result<Asked> {
        let Some(path) = &self.from else {
            let options = self.options(&PlanOptions::default());
            let FoundScene { scene, sentence, notes } = self.scene.scene(options.space, warnings)?;
            return Ok(Asked { scene, sentence, notes, options, has_times: false });
        };
        let saved = SavedPlan::load(path)?;
        warnings.extend(saved.remarks());
        let SavedPlan { plan, scene } = saved;
        let scene = match scene {
            Ok(scene) => scene,
            Err(reason) => bail!("{}: {reason}", path.display()),
        };
        let Plan { space, tolerance, target, has_times, scene: sentence, notes, .. } = plan;
        let options = self.options(&PlanOptions { space, tolerance, target, costs: Costs::default() });
        Ok(Asked { scene, sentence, notes, options, has_times })
    }

    fn options(&self, before: &PlanOptions) -> PlanOptions {
        let Tolerance { delta_e, on } = before.tolerance;
        PlanOptions {
            space: self.space.unwrap_or(before.space),
            tolerance: Tolerance { delta_e: self.tolerance.unwrap_or(delta_e), on: self.on.unwrap_or(on) },
            target: self.target.unwrap_or(before.target),
            costs: before.costs.clone(),
        }
    }

    /// What can be counted, and times where they decide, are wanted or were known before.
    fn costs(&self, target: Target, had_times: bool, warnings: &mut Vec<String>) -> anyhow::Result<Costs> {
        let has_times = self.times || had_times || target == Target::Offline;
        if has_times { Ok(measured(warnings)?) } else { Ok(Costs::counted()) }
    }
}

fn table(plan: &Plan) -> Table {
    let mut table = Table::new([
        ("material", "material"),
        ("metal", "truth"),
        ("share", "share"),
        ("from_deg", "from (°)"),
        ("to_deg", "to (°)"),
        ("variant", "cheapest"),
        ("mean_delta_e", "mean ΔE"),
        ("p95_delta_e", "95 %"),
        ("max_delta_e", "max"),
        ("angle_of_max_deg", "at (°)"),
        ("shader_operations", "operations"),
        ("parameter_bytes", "bytes"),
        ("reason", "not cheaper, since"),
    ]);
    for material in &plan.materials {
        table.push(row(material, plan));
    }
    table
}

fn row(material: &MaterialPlan, plan: &Plan) -> Vec<Cell> {
    let choice = material.choice();
    let angle = |deg: Option<f64>| deg.map_or(Cell::Nothing, |deg| Cell::Number(deg, 0));
    vec![
        material.name.as_str().into(),
        material.metal.as_deref().unwrap_or("its own curve").into(),
        Cell::Number(material.share, 3),
        angle(material.seen_deg.map(|(from, _)| from)),
        angle(material.seen_deg.map(|(_, to)| to)),
        Cell::Text(choice.variant.id()),
        Cell::Number(choice.error.mean_delta_e, 2),
        Cell::Number(choice.error.p95_delta_e, 2),
        Cell::Number(choice.error.max_delta_e, 2),
        Cell::Number(choice.error.angle_of_max_deg, 0),
        Cell::Count(choice.cost.shader_operations.into()),
        Cell::Count(choice.cost.parameter_bytes),
        Cell::Text(if material.is_seen() { material.reason(plan.tolerance) } else { "it is not seen".to_owned() }),
    ]
}

fn detail(plan: &Plan) -> Table {
    let mut table = Table::new([
        ("material", "material"),
        ("variant", "variant"),
        ("verdict", "verdict"),
        ("mean_delta_e", "mean ΔE"),
        ("p95_delta_e", "95 %"),
        ("max_delta_e", "max"),
        ("angle_of_max_deg", "at (°)"),
        ("shader_operations", "operations"),
        ("measured_ns", "ns"),
        ("parameter_bytes", "bytes"),
    ]);
    for (material, judgement) in plan.materials.iter().flat_map(|m| m.judgements.iter().map(move |j| (m, j))) {
        table.push(vec![
            material.name.as_str().into(),
            Cell::Text(judgement.variant.id()),
            verdict(judgement.verdict).into(),
            Cell::Number(judgement.error.mean_delta_e, 3),
            Cell::Number(judgement.error.p95_delta_e, 3),
            Cell::Number(judgement.error.max_delta_e, 3),
            Cell::Number(judgement.error.angle_of_max_deg, 1),
            Cell::Count(judgement.cost.shader_operations.into()),
            judgement.cost.measured_ns.map_or(Cell::Nothing, |ns| Cell::Number(ns, 2)),
            Cell::Count(judgement.cost.parameter_bytes),
        ]);
    }
    table
}

const fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Chosen => "chosen",
        Verdict::TooFar => "too-far",
        Verdict::Farther => "farther",
        Verdict::Dearer => "dearer",
    }
}
