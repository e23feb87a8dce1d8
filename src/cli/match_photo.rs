//! `edgewise match`: r and h from a photograph.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;
use serde_json::{Value, json};

use super::inspect::ReadingArguments;
use super::marks::{Fitted, MarkArguments, Marks};
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::{batch, usage};
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::figure::{CurveFigure, CurveSeries, Figure, FigureTheme, curve_figure, swatch_figure};
use crate::fresnel::{CosTheta, Weights};
use crate::metal::metal_by_name;
use crate::photo::{Match, Photo, solve};
use crate::preset::{Preset, pretty_json};
use crate::sample::{Sample, Truth, sample, samples};

/// Arguments of `edgewise match`.
#[derive(Debug, Default, Args)]
pub struct MatchCommand {
    /// The photograph; several, or a folder of them, give one line of JSON each
    #[arg(required_unless_present = "sample")]
    pub(super) photos: Vec<PathBuf>,
    /// A built-in sample instead, with its own marks unless others are given; `edgewise samples` lists them
    #[arg(long, value_name = "ID", conflicts_with = "photos")]
    sample: Option<String>,
    #[command(flatten)]
    pub(super) marks: MarkArguments,
    #[command(flatten)]
    pub(super) reading: ReadingArguments,
    /// The space of r and h
    #[arg(long, default_value_t)]
    pub(super) space: RgbSpace,
    /// Save a preset with the whole recipe; for several photographs the folder to save them in
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// The name of the preset; that of the photograph unless given
    #[arg(long)]
    name: Option<String>,
    /// Draw the curve with its uncertainty into an .svg or .png file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Draw both colours and the strip over the angle into an .svg or .png file
    #[arg(long, value_name = "FILE")]
    swatches: Option<PathBuf>,
    /// The look of figures: light, for print and slides, or dark
    #[arg(long, value_name = "THEME", default_value = "light")]
    theme: FigureTheme,
    /// Replace files that are there
    #[arg(long)]
    pub(super) force: bool,
    /// For several photographs: append the lines to this file, and leave out what it holds already
    #[arg(long, value_name = "FILE")]
    pub(super) results: Option<PathBuf>,
    #[command(flatten)]
    pub(super) format: FormatArguments,
}

/// A photograph with what was found in it.
pub(super) struct Matched {
    photo: Photo,
    result: Match,
    fitted: Fitted,
    truth: Option<Truth>,
    sample: Option<&'static Sample>,
}

impl MatchCommand {
    pub(super) fn run(&self) -> anyhow::Result<Output> {
        let is_single = matches!(&self.photos[..], [photo] if !photo.is_dir());
        if self.sample.is_none() && !is_single {
            return self.run_batch();
        }
        self.refuse_to_replace()?;
        let matched = match (&self.sample, self.photos.first()) {
            (None, Some(photo)) => self.of_file(photo, &self.marks.marks()?),
            (id, _) => self.of_sample(id.as_deref().unwrap_or_default()),
        };
        matched?.into_output(self)
    }

    fn run_batch(&self) -> anyhow::Result<Output> {
        if self.plot.is_some() || self.swatches.is_some() || self.name.is_some() {
            return Err(usage("--plot, --swatches and --name are for a single photograph"));
        }
        batch::run(self)
    }

    /// A sample, with everything that can be written about it, in a folder.
    pub(super) fn of_sample_into(id: &str, folder: &Path, force: bool, format: FormatArguments) -> Self {
        let file = |name: &str| Some(folder.join(format!("{id}{name}")));
        let (output, plot, swatches) = (file(".json"), file("_curve.png"), file("_swatches.png"));
        Self { sample: Some(id.to_owned()), output, plot, swatches, force, format, ..Self::default() }
    }

    /// The files that a preset goes to.
    fn files(&self) -> Vec<&Path> {
        [&self.output, &self.plot, &self.swatches].into_iter().flatten().map(PathBuf::as_path).collect()
    }

    /// Before anything is measured: a file that is there is replaced only with `--force`.
    fn refuse_to_replace(&self) -> anyhow::Result<()> {
        match self.files().into_iter().find(|path| path.exists()) {
            Some(path) if !self.force => bail!("{} is there already; --force replaces it", path.display()),
            _ => Ok(()),
        }
    }

    fn of_sample(&self, id: &str) -> anyhow::Result<Matched> {
        let known = || samples().iter().map(|sample| sample.id).collect::<Vec<_>>().join(", ");
        let sample = sample(id).ok_or_else(|| anyhow::anyhow!("there is no sample “{id}”; there are: {}", known()))?;
        let photo = Photo::from_bytes(&sample.facts.file, sample.bytes, &mut |_| ControlFlow::Continue(()))?;
        let marks = self.marks.marks()?;
        let (request, fitted) = if self.marks.is_empty() {
            (sample.facts.request.clone(), Fitted::default())
        } else {
            marks.in_photo(&photo)?
        };
        let result = solve(&photo, &request, self.space)?;
        Ok(Matched { photo, result, fitted, truth: Some(sample.facts.truth), sample: Some(sample) })
    }

    pub(super) fn of_file(&self, path: &Path, marks: &Marks) -> anyhow::Result<Matched> {
        let photo = Photo::open_with(path, &self.reading.options(), &mut |_| ControlFlow::Continue(()))?;
        let (request, fitted) = marks.in_photo(&photo).with_context(|| path.display().to_string())?;
        let result = solve(&photo, &request, self.space).with_context(|| path.display().to_string())?;
        Ok(Matched { photo, result, fitted, truth: None, sample: None })
    }
}

impl Matched {
    fn into_output(self, command: &MatchCommand) -> anyhow::Result<Output> {
        let name = command.name.clone().unwrap_or_else(|| self.name());
        let mut warnings = self.warnings();
        let preset = Preset::from_match(&name, &self.photo, &self.result);
        let files = command.files();
        let is_partial = preset.is_none() && !files.is_empty();
        match &preset {
            Some(preset) => self.write(command, preset)?,
            None if is_partial => {
                warnings.push("r and h were not measured in every channel, so there is no preset to write".to_owned());
            }
            None => {}
        }
        let written = if preset.is_none() || files.is_empty() { String::new() } else { written(&files) };
        let text = match command.format.format() {
            Format::Json => pretty_json(&self.json()?),
            Format::Csv => self.table().to_csv(),
            Format::Table => {
                format!("{}{}{}{written}", self.table().to_text(), self.outline_sentence(), self.distance_sentence())
            }
        };
        Ok(Output { text, warnings, is_partial })
    }

    fn write(&self, command: &MatchCommand, preset: &Preset) -> anyhow::Result<()> {
        if let Some(path) = &command.output {
            preset.save(path)?;
        }
        if let Some(path) = &command.plot {
            self.figure(preset).save(path, command.theme)?;
        }
        if let Some(path) = &command.swatches {
            swatch_figure(preset).save(path, command.theme)?;
        }
        Ok(())
    }

    /// The name of a preset: the sample's metal, or the file's stem.
    pub(super) fn name(&self) -> String {
        let stem = Path::new(&self.photo.name).file_stem().unwrap_or_default();
        self.sample.map_or_else(|| stem.to_string_lossy().into_owned(), |sample| sample.facts.title.clone())
    }

    /// The preset under its own name.
    pub(super) fn preset(&self) -> Option<Preset> {
        Preset::from_match(&self.name(), &self.photo, &self.result)
    }

    fn warnings(&self) -> Vec<String> {
        self.result.warnings.iter().map(|warning| warning.message.clone()).collect()
    }

    /// The fixed object of `match --json`, with the photograph it is about.
    pub(super) fn json(&self) -> anyhow::Result<Value> {
        let mut value = serde_json::to_value(&self.result)?;
        value["photo"] = json!(self.photo.name);
        value["photo_sha256"] = json!(self.photo.sha256);
        value["colour_rule"] = json!(self.photo.colour_rule);
        let Fitted { ball, cylinder, reference } = &self.fitted;
        let outlines =
            [("outline", json!(ball)), ("outline", json!(cylinder)), ("reference_outline", json!(reference))];
        for (name, outline) in outlines.into_iter().filter(|(_, outline)| !outline.is_null()) {
            value[name] = outline;
        }
        if let (Some(sample), Some(truth)) = (self.sample, self.truth_in_space()) {
            let [delta_e_r, delta_e_h] = self.delta_e();
            value["sample"] =
                json!({ "id": sample.id, "rendered": sample.facts.rendered, "metal": sample.facts.metal });
            value["truth"] = json!({ "r": truth[0], "h": truth[1], "delta_e_r": delta_e_r, "delta_e_h": delta_e_h });
        }
        Ok(value)
    }

    /// True r and h in the space of the result.
    fn truth_in_space(&self) -> Option<[Rgb; 2]> {
        let truth = self.truth?;
        Some([truth.r, truth.h].map(|rgb| truth.space.convert(rgb, self.result.space)))
    }

    /// CIEDE2000 of r and h to the truth.
    fn delta_e(&self) -> [Option<f64>; 2] {
        let distance = |found: Option<Rgb>, which: usize| {
            Some(delta_e_rgb(found?, self.truth_in_space()?[which], self.result.space))
        };
        [distance(self.result.complete_r(), 0), distance(self.result.complete_h(), 1)]
    }

    fn distance_sentence(&self) -> String {
        let Some(sample) = self.sample else { return String::new() };
        let of = |distance: Option<f64>| distance.map_or_else(|| "not measured".to_owned(), |d| format!("{d:.2}"));
        let [r, h] = self.delta_e().map(of);
        format!("\nΔE2000 to the truth of {}, of which this picture was rendered: r {r}, h {h}\n", sample.facts.metal)
    }

    fn outline_sentence(&self) -> String {
        let (body, radius, plus_minus_px, support) = match (&self.fitted.ball, &self.fitted.cylinder) {
            (Some(ball), _) => {
                (format!("circle {}", ball.circle), ball.circle.radius, ball.plus_minus_px(), ball.support)
            }
            (None, Some(found)) => {
                let (cylinder, plus_minus_px) = (found.cylinder, found.plus_minus_px());
                (format!("cylinder {cylinder}"), cylinder.radius, plus_minus_px, found.support)
            }
            (None, None) => return String::new(),
        };
        let share = 100.0 * support;
        format!("\nFitted: {body}; radius {radius:.2} ± {plus_minus_px:.2} pixels, {share:.0} % of its edge was seen\n")
    }

    fn table(&self) -> Table {
        let Match { space, r, h, r_uncertainty, h_uncertainty, .. } = &self.result;
        let mut columns = vec![
            ("channel", "channel".to_owned()),
            ("r", format!("r ({space})")),
            ("r_uncertainty", "±".to_owned()),
            ("h", "h at 81.8°".to_owned()),
            ("h_uncertainty", "±".to_owned()),
        ];
        let truth = self.truth_in_space();
        if truth.is_some() {
            columns.extend([("true_r", "true r".to_owned()), ("true_h", "true h".to_owned())]);
        }
        let mut table = Table::new(columns);
        for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
            let value = |values: &[Option<f64>; 3]| values[channel].map_or(Cell::Nothing, |v| Cell::Number(v, 4));
            let mut row = vec![name.into(), value(r), value(r_uncertainty), value(h), value(h_uncertainty)];
            row.extend(truth.iter().flatten().map(|rgb| Cell::Number(rgb[channel], 4)));
            table.push(row);
        }
        table
    }

    /// The curve of the preset with its uncertainty, over the truth of a sample.
    fn figure(&self, preset: &Preset) -> CurveFigure {
        let metal = self.sample.and_then(|sample| metal_by_name(&sample.facts.metal).ok());
        let model = preset.model();
        let uncertainty =
            [self.result.r_uncertainty, self.result.h_uncertainty].map(|u| Rgb(u.map(Option::unwrap_or_default)));
        let band = |angle: CosTheta| {
            let (value, u) = (model.reflectance(angle), standard_uncertainty(uncertainty, angle));
            (value - u, value + u)
        };
        let matched = CurveSeries::new("Matched", |angle| model.reflectance(angle)).with_band(band);
        let subtitle = format!("{} · {} · band: ± about 95 %", preset.space.label(), self.photo.name);
        let figure = curve_figure(metal, &[], preset.space);
        CurveFigure { title: preset.name.clone(), subtitle, models: vec![matched], ..figure }
    }
}

fn written(files: &[&Path]) -> String {
    let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    format!("Written: {}\n", names.join(", "))
}

/// u(F) = √((A u(r))² + (B u(h))²): r and h come from different pixels.
fn standard_uncertainty([r, h]: [Rgb; 2], angle: CosTheta) -> Rgb {
    let weights = Weights::at(angle);
    r.zip(h, |r, h| (weights.of_r * r).hypot(weights.of_h * h))
}
