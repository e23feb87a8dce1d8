//! What material a subcommand is about: a metal, a file of n and k, a preset, or parameters.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{arguments, usage};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, FresnelModel, reflectance_range};
use crate::metal::{Metal, metal_by_name};
use crate::preset::Preset;

/// The arguments that name a material, and the space its colours are wanted in.
#[derive(Debug, Args)]
pub struct SourceArguments {
    /// A metal of the library: identifier, name or symbol
    #[arg(long, value_name = "ID")]
    metal: Option<String>,
    /// A .csv file with the columns wavelength_nm,n,k (or wavelength_um,n,k), or a .yml of refractiveindex.info
    #[arg(long, value_name = "FILE")]
    nk: Option<PathBuf>,
    /// A preset file
    #[arg(long, value_name = "FILE")]
    preset: Option<PathBuf>,
    #[command(flatten)]
    parameters: Parameters,
    /// The RGB space of parameters and result: a preset's own, otherwise lin_rec709, unless given
    #[arg(long)]
    space: Option<RgbSpace>,
}

/// Parameters as people type them: r with h, t or g, or n with k, in the space of `--space`.
#[derive(Debug, Args)]
struct Parameters {
    /// Reflectance facing the surface
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, allow_hyphen_values = true)]
    r: Option<Rgb>,
    /// Reflectance at 81.8°
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, allow_hyphen_values = true)]
    h: Option<Rgb>,
    /// Instead of h: F82 tint
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, allow_hyphen_values = true)]
    t: Option<Rgb>,
    /// Instead of h: Gulbrandsen's edge tint
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, allow_hyphen_values = true)]
    g: Option<Rgb>,
    /// With k, instead of r: the index of refraction of each channel
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, allow_hyphen_values = true)]
    n: Option<Rgb>,
    /// The extinction coefficient of each channel
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, allow_hyphen_values = true)]
    k: Option<Rgb>,
}

/// A material and the space its colours are wanted in.
#[derive(Debug)]
pub struct Source {
    /// The name people read.
    pub name: String,
    /// What reflects.
    pub material: Material,
    /// The space of every colour that is printed.
    pub space: RgbSpace,
    /// A preset's roughness, 0–1; 0 for other materials.
    pub roughness: f64,
    /// What a person should know about it.
    pub warnings: Vec<String>,
}

/// What reflects.
#[derive(Debug)]
pub enum Material {
    /// Measured n and k.
    Measured(Box<Metal>),
    /// A model with its parameters, in [`Source::space`] already.
    Model(FresnelModel),
}

impl SourceArguments {
    /// Reads whatever the arguments name.
    pub fn source(&self) -> anyhow::Result<Source> {
        let own_space = self.space.unwrap_or_default();
        let mut source = match (&self.metal, &self.nk, &self.preset, self.parameters.model()?) {
            (Some(name), None, None, None) => Source::measured(metal_by_name(name)?.clone(), own_space),
            (None, Some(path), None, None) => Source::measured(Metal::open(path)?, own_space),
            (None, None, Some(path), None) => Source::preset(path, self.space)?,
            (None, None, None, Some(model)) => Source::model("given parameters".to_owned(), model, own_space),
            _ => {
                return Err(usage(
                    "name one material: --metal, --nk, --preset, --r with --h, --t or --g, or --n with --k",
                ));
            }
        };
        source.warnings.extend(source.material.warnings(source.space));
        Ok(source)
    }
}

impl Parameters {
    fn model(&self) -> anyhow::Result<Option<FresnelModel>> {
        match *self {
            Self { r: None, h: None, t: None, g: None, n: None, k: None } => Ok(None),
            Self { r: Some(r), h: Some(h), t: None, g: None, n: None, k: None } => {
                Ok(Some(FresnelModel::Hoffman { r, h }))
            }
            Self { r: Some(r), h: None, t: Some(t), g: None, n: None, k: None } => {
                Ok(Some(FresnelModel::F82Tint { r, t }))
            }
            Self { r: Some(r), h: None, t: None, g: Some(g), n: None, k: None } => gulbrandsen(r, g).map(Some),
            Self { r: None, h: None, t: None, g: None, n: Some(n), k: Some(k) } => conductor(n, k).map(Some),
            _ => Err(usage("give --r with one of --h, --t and --g, or --n with --k")),
        }
    }
}

fn gulbrandsen(r: Rgb, g: Rgb) -> anyhow::Result<FresnelModel> {
    if r.is_in_unit_cube() && g.is_in_unit_cube() {
        return Ok(FresnelModel::Gulbrandsen { r, g });
    }
    Err(usage("Gulbrandsen's r and g must lie in 0–1: outside they stand for no n and k"))
}

fn conductor(n: Rgb, k: Rgb) -> anyhow::Result<FresnelModel> {
    if n.min_channel() >= 0.0 && k.min_channel() >= 0.0 && (n + k).min_channel() > 0.0 {
        return Ok(FresnelModel::Conductor { n, k });
    }
    Err(usage("n and k must be at least 0, and not both 0"))
}

impl Source {
    fn measured(metal: Metal, space: RgbSpace) -> Self {
        Self {
            name: metal.name.clone(),
            material: Material::Measured(Box::new(metal)),
            space,
            roughness: 0.0,
            warnings: vec![],
        }
    }

    fn model(name: String, model: FresnelModel, space: RgbSpace) -> Self {
        Self { name, material: Material::Model(model), space, roughness: 0.0, warnings: vec![] }
    }

    fn preset(path: &Path, space: Option<RgbSpace>) -> anyhow::Result<Self> {
        let loaded = Preset::load(path)?;
        let preset = loaded.preset.in_space(space.unwrap_or(loaded.preset.space));
        let source = Self::model(preset.name.clone(), preset.model(), preset.space);
        Ok(Self { roughness: preset.roughness, warnings: loaded.warnings, ..source })
    }

    /// The material as one model: a metal by its exact r and h.
    pub fn as_model(&self) -> FresnelModel {
        match &self.material {
            Material::Measured(metal) => FresnelModel::Hoffman { r: metal.r(self.space), h: metal.h(self.space) },
            Material::Model(model) => *model,
        }
    }
}

impl Material {
    fn warnings(&self, space: RgbSpace) -> Vec<String> {
        let warnings = match self {
            Self::Measured(metal) => {
                let (r, h) = (metal.r(space), metal.h(space));
                let mut remarks = metal.remarks();
                remarks.extend([outside("r", r, space), outside("h", h, space)]);
                remarks
            }
            Self::Model(model) => {
                let (r, h) = (model.reflectance(CosTheta::FACING), model.reflectance(CosTheta::MAX));
                vec![outside("r", r, space), outside("h", h, space), curve_outside(model)]
            }
        };
        warnings.into_iter().filter(|sentence| !sentence.is_empty()).collect()
    }
}

fn outside(symbol: &str, rgb: Rgb, space: RgbSpace) -> String {
    if rgb.is_in_unit_cube() {
        return String::new();
    }
    format!("{symbol} {} leaves 0–1 in {space}; nothing is clamped", triple_text(rgb))
}

/// About r and h that are reflectances themselves, while the curve between them is none.
fn curve_outside(model: &FresnelModel) -> String {
    const ROUNDING: f64 = 1e-9;
    let FresnelModel::Hoffman { r, h } = *model else { return String::new() };
    if !(r.is_in_unit_cube() && h.is_in_unit_cube()) {
        return String::new();
    }
    let ranges = r.0.iter().zip(h.0).map(|(r, h)| reflectance_range(*r, h));
    let wider = |(low, high): (f64, f64), range: RangeInclusive<f64>| (low.min(*range.start()), high.max(*range.end()));
    let (low, high) = ranges.fold((f64::INFINITY, f64::NEG_INFINITY), wider);
    if low >= -ROUNDING && high <= 1.0 + ROUNDING {
        return String::new();
    }
    format!("no material has this r and h: the curve runs from {low:.3} to {high:.3}; nothing is clamped")
}

/// `0.9442, 0.7762, 0.3733`
pub fn triple_text(rgb: Rgb) -> String {
    rgb.0.map(|value| format!("{value:.4}")).join(", ")
}
