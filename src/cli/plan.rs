//! `edgewise plan`: what a scene requires.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, bail};
use clap::Args;

use super::arguments;
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::progress::Progress;
use super::times::measured;
use crate::color::RgbSpace;
use crate::file::read_text;
use crate::fresnel::h_of_schlick;
use crate::metal::{Metal, metal_by_name, preferred_metals};
use crate::number::short;
use crate::photo::{Plane, PlaneKind};
use crate::preset::{Preset, built_in_presets, pretty_json};
use crate::scene::{
    Angles, FacingPass, Masks, MaterialPlan, Plan, PlanOptions, SceneMaterial, Seen, Shape, Source, Target, Tolerance,
    Verdict, plan_scene,
};
use crate::study::{Costs, Measure};

/// Arguments of `edgewise plan`.
#[derive(Debug, Args)]
pub struct PlanCommand {
    /// MATERIAL or MATERIAL@SEEN. A material is a metal of the library, a preset (.json), n and k (.csv, .yml), or
    /// colours as 0.9,0.7,0.4 or r/h. SEEN is sphere, cylinder, card:0-60, floor:1.7:1-20, id:7 with --ids, or the
    /// file of a matte with --pass
    #[arg(value_name = "MATERIAL@SEEN", required_unless_present_any = ["list", "metals", "presets"])]
    materials: Vec<String>,
    /// A text file with one MATERIAL@SEEN on each line
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    /// Also every metal of the library, by its preferred data set
    #[arg(long)]
    metals: bool,
    /// Also every built-in preset
    #[arg(long)]
    presets: bool,
    /// How materials are seen that do not say it
    #[arg(long, default_value = "sphere", conflicts_with = "pass")]
    seen: Shape,
    /// A rendered facing-ratio pass (cosine between normal and view) as .exr or .png
    #[arg(long, value_name = "FILE")]
    pass: Option<PathBuf>,
    /// The channel of the pass; the likeliest unless given
    #[arg(long, value_name = "NAME", requires = "pass")]
    channel: Option<String>,
    /// A picture of whole numbers that tell the materials of the pass apart; in an 8-bit colour PNG, #rrggbb as a number
    #[arg(long, value_name = "FILE", requires = "pass")]
    ids: Option<PathBuf>,
    /// The channel of the ids
    #[arg(long, value_name = "NAME", requires = "ids")]
    ids_channel: Option<String>,
    /// The largest ΔE2000 that is allowed
    #[arg(long, default_value_t = Tolerance::default().delta_e, value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: f64,
    /// Of which number: max, mean or p95 (what 95 % of the pixels stay within)
    #[arg(long, default_value_t)]
    on: Measure,
    /// What is spared: real-time (shader operations), offline (time on this machine), texture-memory (bytes)
    #[arg(long = "for", value_name = "TARGET", default_value_t)]
    target: Target,
    /// Also say the time that is saved, measured on this machine, which offline always does
    #[arg(long)]
    times: bool,
    /// The space of parameters and differences
    #[arg(long, default_value_t)]
    space: RgbSpace,
    /// One row for each variant that was looked at
    #[arg(long)]
    detail: bool,
    /// Save the plan, for `edgewise export --plan`
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the plan that is there
    #[arg(long, requires = "output")]
    force: bool,
    #[command(flatten)]
    format: FormatArguments,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value = arguments::number(text)?;
    if value >= 0.0 { Ok(value) } else { Err(format!("a tolerance is at least 0, not {}", short(value))) }
}

/// Where a material is seen.
#[derive(Clone, Debug, PartialEq)]
enum Where {
    /// As the scene says.
    Default,
    Shape(Shape),
    Id(u32),
    Matte(PathBuf),
}

/// How often each material is seen at each angle.
struct Seeing {
    /// One for each material.
    angles: Vec<Angles>,
    /// Where they come from, in a sentence.
    scene: String,
    /// What a person should know about that.
    notes: Vec<String>,
}

impl PlanCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        self.refuse_to_replace()?;
        let mut warnings = Vec::new();
        let (sources, places): (Vec<Source>, Vec<Where>) = self.sources(&mut warnings)?.into_iter().unzip();
        let Seeing { angles, scene, notes } = self.angles(&places)?;
        warnings.extend(notes.iter().cloned());
        let pairs = sources.into_iter().zip(angles);
        let materials: Vec<SceneMaterial> = pairs.map(|(source, angles)| SceneMaterial { source, angles }).collect();
        let plan = Plan { notes, ..self.plan(&materials, &scene, self.costs(&mut warnings)?)? };
        if let Some(path) = &self.output {
            plan.save(path)?;
        }
        let table = if self.detail { detail(&plan) } else { table(&plan) };
        let text = match self.format.format() {
            Format::Json => pretty_json(&plan.to_json()),
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

    /// What can be counted, and times where they decide or are wanted.
    fn costs(&self, warnings: &mut Vec<String>) -> anyhow::Result<Costs> {
        let has_times = self.times || self.target == Target::Offline;
        if has_times { Ok(measured(warnings)?) } else { Ok(Costs::counted()) }
    }

    fn plan(&self, materials: &[SceneMaterial], scene: &str, costs: Costs) -> anyhow::Result<Plan> {
        let options = PlanOptions {
            space: self.space,
            tolerance: Tolerance { delta_e: self.tolerance, on: self.on },
            target: self.target,
            costs,
        };
        let progress = Progress::new("Planning");
        Ok(plan_scene(materials, scene, &options, &|share| progress.report(share))?)
    }

    fn sources(&self, warnings: &mut Vec<String>) -> anyhow::Result<Vec<(Source, Where)>> {
        let listed = match &self.list {
            Some(path) => read_text(path)?,
            None => String::new(),
        };
        let lines = listed.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
        let words = self.materials.iter().map(String::as_str).chain(lines);
        let mut sources: Vec<(Source, Where)> =
            words.map(|word| self.material(word, warnings)).collect::<anyhow::Result<_>>()?;
        let metals = preferred_metals().filter(|_| self.metals).map(|metal| Source::Metal(Arc::new(metal.clone())));
        let presets = built_in_presets().iter().filter(|_| self.presets);
        let presets = presets.map(|preset| Source::Preset(Box::new(preset.clone())));
        sources.extend(metals.chain(presets).map(|source| (source, Where::Default)));
        Ok(sources)
    }

    /// A material and, after the last @, where it is seen.
    fn material(&self, word: &str, warnings: &mut Vec<String>) -> anyhow::Result<(Source, Where)> {
        match word.rsplit_once('@') {
            Some((material, place)) => Ok((self.source(material, warnings)?, seen(place)?)),
            None => Ok((self.source(word, warnings)?, Where::Default)),
        }
    }

    fn source(&self, word: &str, warnings: &mut Vec<String>) -> anyhow::Result<Source> {
        let ending = Path::new(word).extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        match ending.as_str() {
            "json" => {
                let loaded = Preset::load(Path::new(word))?;
                warnings.extend(loaded.warnings);
                Ok(Source::Preset(Box::new(loaded.preset)))
            }
            "csv" | "yml" | "yaml" => Ok(Source::Metal(Arc::new(Metal::open(Path::new(word))?))),
            _ if word.contains(',') => self.colours(word, warnings),
            _ => Ok(Source::Metal(Arc::new(metal_by_name(word)?.clone()))),
        }
    }

    fn colours(&self, word: &str, warnings: &mut Vec<String>) -> anyhow::Result<Source> {
        let triple = |text: &str| arguments::triple(text).map_err(anyhow::Error::msg);
        let (r, h) = match word.split_once('/') {
            Some((r, h)) => (triple(r)?, triple(h)?),
            None => (triple(word)?, triple(word)?.map(h_of_schlick)),
        };
        if r.0.into_iter().chain(h.0).any(|value| !(0.0..=1.0).contains(&value)) {
            warnings.push(format!("{word} leaves 0–1 in {}; nothing is clamped", self.space));
        }
        let name = "Given colours".to_owned();
        // Nobody said how rough it is; a metal of the library is none either.
        let preset = Preset { name, r, h, space: self.space, roughness: 0.0, ..Preset::new_authored() };
        Ok(Source::Preset(Box::new(preset)))
    }

    /// The angles of each material, and where they come from.
    fn angles(&self, places: &[Where]) -> anyhow::Result<Seeing> {
        let Some(path) = &self.pass else { return self.shapes(places) };
        let mut notes = Vec::new();
        let pass = FacingPass { ratio: open(path, PlaneKind::Facing, self.channel.as_deref(), &mut notes)? };
        let (masks, ids) = self.masks(places, &mut notes)?;
        let Seen { mut angles, scene, warnings, .. } = pass.angles(&masks, &ids).map_err(anyhow::Error::msg)?;
        if matches!(masks, Masks::None) {
            angles = vec![angles.remove(0); places.len()];
        }
        Ok(Seeing { angles, scene, notes: [notes, warnings].concat() })
    }

    fn shapes(&self, places: &[Where]) -> anyhow::Result<Seeing> {
        let shape = |place: &Where| match place {
            Where::Default => Ok(self.seen),
            Where::Shape(shape) => Ok(*shape),
            Where::Id(_) | Where::Matte(_) => bail!("ids and mattes belong to a facing-ratio pass: --pass FILE"),
        };
        let shapes: Vec<Shape> = places.iter().map(shape).collect::<anyhow::Result<_>>()?;
        let mut different: Vec<Shape> = Vec::new();
        for shape in &shapes {
            if !different.contains(shape) {
                different.push(*shape);
            }
        }
        let labels: Vec<String> = different.iter().map(|shape| shape.label()).collect();
        Ok(Seeing {
            angles: shapes.into_iter().map(Shape::angles).collect(),
            scene: labels.join("; "),
            notes: different.into_iter().filter_map(Shape::warning).collect(),
        })
    }

    /// What tells the materials of the pass apart: all in one way.
    fn masks(&self, places: &[Where], warnings: &mut Vec<String>) -> anyhow::Result<(Masks, Vec<u32>)> {
        if let Some(ids) = &self.ids {
            let id = |place: &Where| if let Where::Id(id) = place { Some(*id) } else { None };
            let all: Option<Vec<u32>> = places.iter().map(id).collect();
            let all = all.context("with --ids every material says which one it has, like gold@id:7")?;
            let mut sorted = all.clone();
            sorted.sort_unstable();
            if let Some(twice) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                bail!("the id {} is given to two materials", twice[0]);
            }
            return Ok((Masks::Ids(open(ids, PlaneKind::Id, self.ids_channel.as_deref(), warnings)?), all));
        }
        if places.iter().all(|place| *place == Where::Default) {
            return Ok((Masks::None, Vec::new()));
        }
        let mattes = places.iter().map(|place| match place {
            Where::Matte(path) => open(path, PlaneKind::Matte, None, warnings),
            Where::Id(_) => bail!("ids need their picture: --ids FILE"),
            Where::Shape(shape) => bail!("with --pass no material is seen on a shape ({})", shape.label()),
            Where::Default => bail!("where one material has a matte, every one has: MATERIAL@FILE"),
        });
        Ok((Masks::Mattes(mattes.collect::<anyhow::Result<_>>()?), Vec::new()))
    }
}

fn open(path: &Path, kind: PlaneKind, channel: Option<&str>, warnings: &mut Vec<String>) -> anyhow::Result<Plane> {
    let plane = Plane::open(path, kind, channel, &mut |_| ControlFlow::Continue(()))?;
    warnings.extend(plane.warnings.iter().map(|warning| format!("{}: {warning}", path.display())));
    Ok(plane)
}

fn seen(text: &str) -> anyhow::Result<Where> {
    if let Some(id) = text.strip_prefix("id:") {
        let id = id.strip_prefix('#').map_or_else(|| id.parse().ok(), |hex| u32::from_str_radix(hex, 16).ok());
        return Ok(Where::Id(id.with_context(|| format!("“{text}” needs a whole number, like id:7 or id:#ff8000"))?));
    }
    let is_picture =
        Path::new(text).extension().is_some_and(|e| e.eq_ignore_ascii_case("exr") || e.eq_ignore_ascii_case("png"));
    if is_picture {
        return Ok(Where::Matte(PathBuf::from(text)));
    }
    Ok(Where::Shape(text.parse()?))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_shapes_ids_or_mattes() {
        ensure_place("sphere", Where::Shape(Shape::Sphere));
        ensure_place("id:7", Where::Id(7));
        ensure_place("id:#ff8000", Where::Id(0xff8000));
        ensure_place("gold.EXR", Where::Matte(PathBuf::from("gold.EXR")));
        for (text, reason) in [("id:x", "whole number"), ("id:-1", "whole number"), ("cube", "no shape")] {
            assert!(seen(text).unwrap_err().to_string().contains(reason), "{text}");
        }
    }

    fn ensure_place(text: &str, expected: Where) {
        assert_eq!(seen(text).unwrap(), expected);
    }
}
