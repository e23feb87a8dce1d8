//! What Edgewise can write.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::color::{RgbSpace, UnknownName};

/// A kind of file, and so a reader: what the file says is chosen by what that reader shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "one for each row of the table in docs/exports.md, named by `label`")]
pub enum Target {
    Json,
    Csv,
    OpenPbr,
    GeneralizedSchlick,
    Blender,
    Gltf,
    Usd,
    Glsl,
    Hlsl,
    Wgsl,
    Osl,
    Cube,
    Exr,
    StandardSurface,
    Mitsuba,
    MitsubaPlugin,
    Gpl,
    Ase,
    Aco,
}

impl Target {
    /// Every target, in order of worth.
    pub const ALL: [Self; 19] = [
        Self::Json,
        Self::Csv,
        Self::OpenPbr,
        Self::GeneralizedSchlick,
        Self::Blender,
        Self::Gltf,
        Self::Usd,
        Self::Glsl,
        Self::Hlsl,
        Self::Wgsl,
        Self::Osl,
        Self::Cube,
        Self::Exr,
        Self::StandardSurface,
        Self::Mitsuba,
        Self::MitsubaPlugin,
        Self::Gpl,
        Self::Ase,
        Self::Aco,
    ];

    /// The stable identifier used on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Csv => "csv",
            Self::OpenPbr => "open-pbr",
            Self::GeneralizedSchlick => "generalized-schlick",
            Self::Blender => "blender",
            Self::Gltf => "gltf",
            Self::Usd => "usd",
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Wgsl => "wgsl",
            Self::Osl => "osl",
            Self::Cube => "cube",
            Self::Exr => "exr",
            Self::StandardSurface => "standard-surface",
            Self::Mitsuba => "mitsuba",
            Self::MitsubaPlugin => "mitsuba-plugin",
            Self::Gpl => "gpl",
            Self::Ase => "ase",
            Self::Aco => "aco",
        }
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Json => "Edgewise preset (JSON)",
            Self::Csv => "Curve (CSV)",
            Self::OpenPbr => "MaterialX OpenPBR surface",
            Self::GeneralizedSchlick => "MaterialX generalized Schlick",
            Self::Blender => "Blender script",
            Self::Gltf => "glTF binary",
            Self::Usd => "USD material",
            Self::Glsl => "GLSL source",
            Self::Hlsl => "HLSL source",
            Self::Wgsl => "WGSL source",
            Self::Osl => "OSL source",
            Self::Cube => "1-D LUT (.cube)",
            Self::Exr => "Ramp (OpenEXR)",
            Self::StandardSurface => "MaterialX standard surface",
            Self::Mitsuba => "Mitsuba conductor (XML)",
            Self::MitsubaPlugin => "Mitsuba plugin (Python)",
            Self::Gpl => "GIMP palette",
            Self::Ase => "Adobe swatch exchange",
            Self::Aco => "Photoshop swatches",
        }
    }

    /// What follows the stem of the file name; targets that share an extension stay apart.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Csv => "csv",
            Self::OpenPbr => "open_pbr.mtlx",
            Self::GeneralizedSchlick => "generalized_schlick.mtlx",
            Self::Blender => "blender.py",
            Self::Gltf => "glb",
            Self::Usd => "usda",
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Wgsl => "wgsl",
            Self::Osl => "osl",
            Self::Cube => "cube",
            Self::Exr => "exr",
            Self::StandardSurface => "standard_surface.mtlx",
            Self::Mitsuba => "mitsuba.xml",
            Self::MitsubaPlugin => "mitsuba.py",
            Self::Gpl => "gpl",
            Self::Ase => "ase",
            Self::Aco => "aco",
        }
    }

    /// The extension of the file, without a point.
    pub fn extension(self) -> &'static str {
        self.suffix().rsplit('.').next().unwrap_or_default()
    }

    /// The spaces the reader can work in; the first is what is written unless another is asked for.
    ///
    /// A script or a function has no space of its own, so the caller's is as good as any.
    pub const fn spaces(self) -> &'static [RgbSpace] {
        use RgbSpace::{AcesCg, LinDisplayP3, LinRec709, LinRec2020};
        match self {
            Self::Gltf | Self::Gpl | Self::Ase | Self::Aco => &[LinRec709],
            Self::OpenPbr | Self::GeneralizedSchlick | Self::StandardSurface => &[LinRec709, AcesCg, LinDisplayP3],
            Self::Blender => &[LinRec709, AcesCg, LinRec2020],
            _ => &[LinRec709, AcesCg, LinDisplayP3, LinRec2020],
        }
    }

    /// True where many presets share one file: a palette.
    pub const fn is_palette(self) -> bool {
        matches!(self, Self::Gpl | Self::Ase | Self::Aco)
    }

    /// True where the file has a place for the roughness.
    pub const fn says_roughness(self) -> bool {
        use Target::{Aco, Ase, Csv, Cube, Exr, Glsl, Gpl, Hlsl, Osl, Wgsl};
        !matches!(self, Csv | Glsl | Hlsl | Wgsl | Osl | Cube | Exr | Gpl | Ase | Aco)
    }

    /// True for files a person can read.
    pub const fn is_text(self) -> bool {
        !matches!(self, Self::Gltf | Self::Exr | Self::Ase | Self::Aco)
    }

    /// What its readers do with the file that a person should know before relying on it.
    pub const fn note(self) -> &'static str {
        match self {
            Self::Json => "Exact: r, h, their space and where they come from.",
            Self::Csv => "Exact: the reflectance at every whole degree, unclamped.",
            Self::OpenPbr => {
                "Exact in readers of MaterialX 1.39, among them Arnold and Maya. MaterialX's own OSL \
                 generator drops the edge tint; its MDL generator keeps it from MDL 1.10 on."
            }
            Self::GeneralizedSchlick => {
                "Exact in MaterialX 1.39. Its own OSL generator drops color82; its MDL generator keeps it \
                 from MDL 1.10 on."
            }
            Self::Blender => {
                "Exact in Cycles 4.2–5.0. Run it in the text editor; it asks the file for its working space \
                 and sets the numbers for that space."
            }
            Self::Gltf => {
                "Viewers without EXT_materials_specular_edge_color show Schlick's curve. glTF colours are \
                 always linear Rec.709."
            }
            Self::Usd => {
                "Exact where the renderer takes the MaterialX shader. Where only UsdPreviewSurface is read, \
                 a metal has one reflectance for every angle; Blender reads the edge tint from it all the same."
            }
            Self::Glsl => "Exact. For Unity, Unreal and Godot too: they have no file for this model.",
            Self::Hlsl => "Exact. For Unreal's custom node and Unity's custom function.",
            Self::Wgsl => "Exact.",
            Self::Osl => "Exact. Arnold, RenderMan, Cycles and V-Ray compile OSL.",
            Self::Cube => "Exact to 1e-6 between rows. Look it up with the cosine, in linear light.",
            Self::Exr => "Exact at texel centres, (i + 0.5) / width. Look it up with the cosine, in linear light.",
            Self::StandardSurface => {
                "Lossy: standard_surface takes Gulbrandsen's edge tint g, which is fitted to the curve."
            }
            Self::Mitsuba => "Lossy: n and k are fitted to the curve. Load it in an RGB variant.",
            Self::MitsubaPlugin => "Exact in RGB variants. Import it after mi.set_variant.",
            Self::Gpl => "Two sRGB colours of 8 bits, for looking at; the curve is not in the file.",
            Self::Ase => "Two sRGB colours, for looking at; the curve is not in the file.",
            Self::Aco => "Two sRGB colours of 16 bits, for looking at; the curve is not in the file.",
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for Target {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        Self::ALL
            .into_iter()
            .find(|target| target.id() == text)
            .ok_or_else(|| UnknownName::new("export target", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn identifiers_parse_back_and_match_the_files() {
        for target in Target::ALL {
            assert_eq!(target.id().parse(), Ok(target));
            assert_eq!(serde_json::to_string(&target).unwrap(), format!("\"{target}\""));
        }
    }

    #[test]
    fn no_two_targets_write_the_same_file() {
        let suffixes: BTreeSet<_> = Target::ALL.iter().map(|target| target.suffix()).collect();
        assert_eq!(suffixes.len(), Target::ALL.len());
        assert_eq!(Target::OpenPbr.extension(), "mtlx");
    }

    #[test]
    fn every_target_speaks_linear_srgb_first() {
        assert!(Target::ALL.iter().all(|target| target.spaces()[0] == RgbSpace::LinRec709));
    }
}
