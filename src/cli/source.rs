//! What material a subcommand is about: a metal, a file of n and k, a preset, or numbers.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;

use super::arguments;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::reflectance_range;
use crate::metal::{Metal, metal_by_name, metal_from_csv};
use crate::preset::{Preset, read_text};

/// The arguments that name a material, and the space its colours are wanted in.
#[derive(Debug, Args)]
pub struct SourceArguments {
    #[command(flatten)]
    named: Named,
    /// The RGB space of the result: a preset's own, otherwise lin_rec709, unless given
    #[arg(long)]
    space: Option<RgbSpace>,
}

#[derive(Debug, Args)]
#[group(required = true, multiple = true)]
struct Named {
    /// A metal of the library: identifier, name or symbol
    #[arg(long, value_name = "ID", conflicts_with_all = ["nk", "preset", "r", "h"])]
    metal: Option<String>,
    /// A file with the columns wavelength_nm,n,k
    #[arg(long, value_name = "FILE", conflicts_with_all = ["preset", "r", "h"])]
    nk: Option<PathBuf>,
    /// A preset file
    #[arg(long, value_name = "FILE", conflicts_with_all = ["r", "h"])]
    preset: Option<PathBuf>,
    /// Reflectance facing the surface, in the space of --space
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, requires = "h", allow_hyphen_values = true)]
    r: Option<Rgb>,
    /// Reflectance at 81.8°, in the space of --space
    #[arg(long, value_name = "R,G,B", value_parser = arguments::triple, requires = "r", allow_hyphen_values = true)]
    h: Option<Rgb>,
}

/// A material and the space its colours are wanted in.
#[derive(Debug)]
pub struct Source {
    /// What it is.
    pub material: Material,
    /// The space of every colour that is printed.
    pub space: RgbSpace,
    /// What a person should know about it.
    pub warnings: Vec<String>,
}

/// What reflects.
#[derive(Debug)]
pub enum Material {
    /// Measured n and k.
    Measured(Box<Metal>),
    /// Two colours, in [`Source::space`] already.
    Colours {
        /// The preset's name, or what was typed.
        name: String,
        /// Reflectance facing the surface.
        r: Rgb,
        /// Reflectance at 81.8°.
        h: Rgb,
    },
}

impl SourceArguments {
    /// Reads whatever the arguments name.
    pub fn source(&self) -> anyhow::Result<Source> {
        let mut warnings = Vec::new();
        let Named { metal, nk, preset, r, h } = &self.named;
        let (material, space) = match (metal, nk, preset, r.zip(*h)) {
            (Some(name), ..) => {
                (Material::Measured(Box::new(metal_by_name(name)?.clone())), self.space.unwrap_or_default())
            }
            (_, Some(path), ..) => {
                (Material::Measured(Box::new(metal_from_file(path)?)), self.space.unwrap_or_default())
            }
            (_, _, Some(path), _) => self.from_preset(path, &mut warnings)?,
            (.., Some((r, h))) => {
                (Material::Colours { name: "given colours".to_owned(), r, h }, self.space.unwrap_or_default())
            }
            _ => bail!("name a material: --metal, --nk, --preset, or --r and --h"),
        };
        warnings.extend(material.warnings(space));
        Ok(Source { material, space, warnings })
    }

    fn from_preset(&self, path: &Path, warnings: &mut Vec<String>) -> anyhow::Result<(Material, RgbSpace)> {
        let loaded = Preset::load(path)?;
        warnings.extend(loaded.warnings);
        let space = self.space.unwrap_or(loaded.preset.space);
        let Preset { name, r, h, .. } = loaded.preset.in_space(space);
        Ok((Material::Colours { name, r, h }, space))
    }
}

/// A person's own n and k.
fn metal_from_file(path: &Path) -> anyhow::Result<Metal> {
    let text = read_text(path)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    metal_from_csv(&stem, &text).with_context(|| path.display().to_string())
}

impl Material {
    /// The name people read.
    pub fn name(&self) -> &str {
        match self {
            Self::Measured(metal) => &metal.name,
            Self::Colours { name, .. } => name,
        }
    }

    /// Reflectance facing the surface and at 81.8°.
    pub fn r_h(&self, space: RgbSpace) -> (Rgb, Rgb) {
        match self {
            Self::Measured(metal) => (metal.r(space), metal.h(space)),
            Self::Colours { r, h, .. } => (*r, *h),
        }
    }

    fn warnings(&self, space: RgbSpace) -> Vec<String> {
        let (r, h) = self.r_h(space);
        let mut warnings = match self {
            Self::Measured(metal) => vec![metal.held_ends().sentence()],
            Self::Colours { .. } => vec![],
        };
        warnings.extend([("r", r), ("h", h)].map(|(symbol, rgb)| outside_unit_cube(symbol, rgb, space)));
        if let Self::Colours { .. } = self {
            warnings.push(curve_outside_unit_interval(r, h));
        }
        warnings.retain(|sentence| !sentence.is_empty());
        warnings
    }
}

fn outside_unit_cube(symbol: &str, rgb: Rgb, space: RgbSpace) -> String {
    if rgb.is_in_unit_cube() {
        return String::new();
    }
    format!("{symbol} {} leaves 0–1 in {space}; nothing is clamped", triple_text(rgb))
}

/// About r and h that are reflectances themselves, but not at every angle between.
fn curve_outside_unit_interval(r: Rgb, h: Rgb) -> String {
    const ROUNDING: f64 = 1e-9;
    if !(r.is_in_unit_cube() && h.is_in_unit_cube()) {
        return String::new();
    }
    let ranges = r.0.iter().zip(h.0).map(|(r, h)| reflectance_range(*r, h));
    let (low, high) =
        ranges.fold((0.0_f64, 1.0_f64), |(low, high), range| (low.min(*range.start()), high.max(*range.end())));
    if low >= -ROUNDING && high <= 1.0 + ROUNDING {
        return String::new();
    }
    format!("no material has these r and h: the curve reaches {low:.3} to {high:.3}; nothing is clamped")
}

/// `0.944, 0.776, 0.373`
pub fn triple_text(rgb: Rgb) -> String {
    rgb.0.map(|value| format!("{value:.4}")).join(", ")
}
