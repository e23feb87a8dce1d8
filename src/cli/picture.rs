//! `edgewise picture`: a sphere by the truth and by a model, and where they differ.

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::arguments::{self, Model};
use super::curve::Curve;
use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::source::{Material, Source, SourceArguments};
use crate::figure::{ComparedSpheres, FigureTheme, SphereLayout, save_picture};
use crate::fit::Method;
use crate::fresnel::ModelKind;
use crate::preset::pretty_json;
use crate::render::{DeltaEMap, Light, Picture, SaveError, SphereView};

/// Arguments of `edgewise picture`.
#[derive(Debug, Args)]
pub struct PictureCommand {
    #[command(flatten)]
    source: SourceArguments,
    /// What is compared with the material itself: hoffman (a metal's default), schlick, lazanyi, f82-tint,
    /// generalized-schlick, gulbrandsen, conductor, constant, or spectral-N for N wavelengths
    #[arg(long, value_parser = arguments::model)]
    model: Option<Model>,
    /// How a metal's parameters are derived; `edgewise fit` lists the methods. Exact where the model has
    /// exact parameters, otherwise least squares
    #[arg(long)]
    method: Option<Method>,
    /// What surrounds the sphere: white, soft-boxes, photo-studio, sunlit-room or city-square
    #[arg(long, default_value_t)]
    light: Light,
    /// What the file shows: beside where there is a model, otherwise truth, unless given
    #[arg(long, value_enum, requires = "output")]
    layout: Option<Layout>,
    /// Diameter of the sphere's picture in pixels, 8–4096
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(8..=4096))]
    size: u32,
    /// Perceptual roughness of 0–1: a preset's own, otherwise 0, unless given
    #[arg(long, value_parser = arguments::share, allow_hyphen_values = true)]
    roughness: Option<f64>,
    /// Stops by which the light is brighter; ΔE is measured on what is shown
    #[arg(long, value_name = "STOPS", default_value = "0", value_parser = arguments::stops, allow_hyphen_values = true)]
    exposure: f64,
    /// The ΔE2000 that --layout difference shows in its brightest colour: 1, 2, 5, 10 … above the largest,
    /// unless given
    #[arg(long, value_name = "DELTA_E", value_parser = arguments::positive, allow_hyphen_values = true)]
    full_scale: Option<f64>,
    /// The look of --layout difference: light, for print and slides, or dark
    #[arg(long, value_name = "THEME", default_value = "light")]
    theme: FigureTheme,
    /// The file: .png in sRGB, or .exr, linear in the space and unclipped
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArguments,
}

/// What the file shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Layout {
    /// The material itself: a metal by its spectrum
    Truth,
    /// The model
    Model,
    /// The truth left, the model right
    Beside,
    /// One sphere, its left half by the truth, its right half by the model
    Wipe,
    /// Both and their ΔE2000 in false colour with its scale; as .exr the numbers alone
    Difference,
}

/// The spheres and what they show.
struct Spheres<'a> {
    source: &'a Source,
    roughness: f64,
    truth: Picture,
    truth_label: String,
    model: Option<Compared<'a>>,
}

/// A model's sphere and how far it is from the truth's.
struct Compared<'a> {
    curve: Curve<'a>,
    picture: Picture,
    map: DeltaEMap,
}

impl PictureCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        self.output.as_deref().map_or(Ok(()), check_ending)?;
        let source = self.source.source()?;
        let mut warnings = source.warnings.clone();
        let spheres = self.spheres(&source, &mut warnings)?;
        if let Some(path) = &self.output {
            warnings.extend(self.write(&spheres, path)?);
        }
        let text = match self.format.format() {
            Format::Json => pretty_json(&self.document(&spheres, &warnings)),
            format => self.table(&spheres).render(format),
        };
        Ok(Output { text, warnings, ..Output::default() })
    }

    fn spheres<'a>(&self, source: &'a Source, warnings: &mut Vec<String>) -> anyhow::Result<Spheres<'a>> {
        let compared = self.compared(source, warnings)?;
        let own = Curve::new(source, None, None, warnings)?;
        let roughness = self.roughness.unwrap_or(source.roughness);
        let view = SphereView::new(self.size, self.light, roughness, source.space);
        let gain = self.exposure.exp2();
        let truth = view.render(&own.table(source, gain));
        let model = compared.map(|curve| {
            let picture = view.render(&curve.table(source, gain));
            let map = DeltaEMap::between(&truth, &picture);
            Compared { curve, picture, map }
        });
        Ok(Spheres { source, roughness, truth, truth_label: own.label(), model })
    }

    /// The model to compare with: a metal is compared with exact r and h unless another is named.
    fn compared<'a>(&self, source: &'a Source, warnings: &mut Vec<String>) -> anyhow::Result<Option<Curve<'a>>> {
        let default = matches!(source.material, Material::Measured(_)).then_some(Model::Rgb(ModelKind::Hoffman));
        match self.model.or(default) {
            None if self.method.is_none() => Ok(None),
            model => Curve::new(source, model, self.method, warnings).map(Some),
        }
    }

    /// Writes the file; what a person should know about it.
    fn write(&self, spheres: &Spheres<'_>, path: &Path) -> anyhow::Result<Option<String>> {
        let Some(compared) = &spheres.model else {
            return match self.layout {
                None | Some(Layout::Truth) => Ok(save_picture(&spheres.truth, path)?),
                _ => bail!("this layout compares a material with a model of it; name one with --model"),
            };
        };
        let both = ComparedSpheres {
            title: spheres.source.name.clone(),
            subtitle: self.subtitle(spheres),
            labels: [spheres.truth_label.clone(), compared.curve.label()],
            pictures: [spheres.truth.clone(), compared.picture.clone()],
            wipe: 0.5,
            full_scale: self.full_scale,
        };
        Ok(both.save(self.layout.unwrap_or(Layout::Beside).into(), path, self.theme)?)
    }

    fn subtitle(&self, spheres: &Spheres<'_>) -> String {
        let mut parts = vec![spheres.source.space.label().to_owned(), self.light.label().to_lowercase()];
        if spheres.roughness > 0.0 {
            parts.push(format!("roughness {}", spheres.roughness));
        }
        if self.exposure != 0.0 {
            parts.push(format!("{:+} stops", self.exposure));
        }
        parts.join(" · ")
    }

    fn document(&self, spheres: &Spheres<'_>, warnings: &[String]) -> Value {
        let compared = spheres.model.as_ref();
        let (model, method) = compared.map(|compared| compared.curve.document()).unzip();
        json!({
            "material": spheres.source.name, "space": spheres.source.space, "light": self.light,
            "exposure": self.exposure, "roughness": spheres.roughness, "size": self.size, "model": model, "method": method.flatten(),
            "mean_delta_e": compared.map(|compared| compared.map.mean()),
            "max_delta_e": compared.map(|compared| compared.map.max()),
            "file": self.output, "warnings": warnings,
        })
    }

    fn table(&self, spheres: &Spheres<'_>) -> Table {
        let mut table = Table::new([
            ("material", "material"),
            ("space", "space"),
            ("light", "light"),
            ("exposure", "stops"),
            ("roughness", "roughness"),
            ("model", "model"),
            ("mean_delta_e", "mean ΔE2000"),
            ("max_delta_e", "max ΔE2000"),
        ]);
        let compared = spheres.model.as_ref();
        let number = |value: Option<f64>| value.map_or(Cell::Nothing, |value| Cell::Number(value, 3));
        table.push(vec![
            spheres.source.name.as_str().into(),
            Cell::Text(spheres.source.space.to_string()),
            Cell::Text(self.light.to_string()),
            Cell::Number(self.exposure, 1),
            Cell::Number(spheres.roughness, 2),
            compared.map_or(Cell::Nothing, |compared| Cell::Text(compared.curve.label())),
            number(compared.map(|compared| compared.map.mean())),
            number(compared.map(|compared| compared.map.max())),
        ]);
        table
    }
}

impl From<Layout> for SphereLayout {
    fn from(layout: Layout) -> Self {
        match layout {
            Layout::Truth => Self::Truth,
            Layout::Model => Self::Model,
            Layout::Beside => Self::Beside,
            Layout::Wipe => Self::Wipe,
            Layout::Difference => Self::Difference,
        }
    }
}

/// A name that no picture can be saved under is refused before anything is rendered.
fn check_ending(path: &Path) -> Result<(), SaveError> {
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("png" | "exr") => Ok(()),
        _ => Err(SaveError::UnknownFormat { path: path.to_owned(), known: ".png or .exr" }),
    }
}
