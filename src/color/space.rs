//! The linear RGB spaces Edgewise works in.

use std::{fmt, str::FromStr, sync::LazyLock};

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::xyz::{Chromaticity, Xyz, bradford, invert, xyz_from_primaries};
use super::{Rgb, UnknownName};

/// A linear RGB space: primaries and a white, no transfer curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum RgbSpace {
    /// ITU-R BT.709 primaries, D65: linear sRGB.
    #[default]
    #[serde(rename = "lin_rec709")]
    LinRec709,
    /// Display P3 primaries (SMPTE EG 432-1), D65.
    #[serde(rename = "lin_displayp3")]
    LinDisplayP3,
    /// ITU-R BT.2020 primaries, D65.
    #[serde(rename = "lin_rec2020")]
    LinRec2020,
    /// ACEScg: AP1 primaries, ACES white (Academy S-2014-004).
    #[serde(rename = "acescg")]
    AcesCg,
}

struct Matrices {
    xyz_from_rgb: Matrix3<f64>,
    rgb_from_xyz: Matrix3<f64>,
}

static MATRICES: LazyLock<[Matrices; 4]> = LazyLock::new(|| {
    RgbSpace::ALL.map(|space| {
        let xyz_from_rgb =
            xyz_from_primaries(space.primaries(), space.white()).expect("the spaces of this crate have real primaries");
        Matrices { xyz_from_rgb, rgb_from_xyz: invert(xyz_from_rgb) }
    })
});

impl RgbSpace {
    /// Every space, in menu order.
    pub const ALL: [Self; 4] = [Self::LinRec709, Self::LinDisplayP3, Self::LinRec2020, Self::AcesCg];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::LinRec709 => "lin_rec709",
            Self::LinDisplayP3 => "lin_displayp3",
            Self::LinRec2020 => "lin_rec2020",
            Self::AcesCg => "acescg",
        }
    }

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::LinRec709 => "Linear sRGB (Rec.709)",
            Self::LinDisplayP3 => "Linear Display P3",
            Self::LinRec2020 => "Linear Rec.2020",
            Self::AcesCg => "ACEScg",
        }
    }

    /// Chromaticities of the red, green and blue primaries.
    pub const fn primaries(self) -> [Chromaticity; 3] {
        let xy = Chromaticity::new;
        match self {
            Self::LinRec709 => [xy(0.64, 0.33), xy(0.30, 0.60), xy(0.15, 0.06)],
            Self::LinDisplayP3 => [xy(0.68, 0.32), xy(0.265, 0.69), xy(0.15, 0.06)],
            Self::LinRec2020 => [xy(0.708, 0.292), xy(0.170, 0.797), xy(0.131, 0.046)],
            Self::AcesCg => [xy(0.713, 0.293), xy(0.165, 0.830), xy(0.128, 0.044)],
        }
    }

    /// Chromaticity of the white: the nominal D65 of sRGB, or the ACES white.
    pub const fn white(self) -> Chromaticity {
        match self {
            Self::AcesCg => Chromaticity::new(0.32168, 0.33767),
            _ => Chromaticity::new(0.3127, 0.3290),
        }
    }

    /// The matrix from linear RGB to XYZ relative to the space's own white (no adaptation).
    pub fn xyz_from_rgb(self) -> Matrix3<f64> {
        MATRICES[self as usize].xyz_from_rgb
    }

    /// The matrix from XYZ relative to the space's own white (no adaptation) to linear RGB.
    pub fn rgb_from_xyz(self) -> Matrix3<f64> {
        MATRICES[self as usize].rgb_from_xyz
    }

    /// The matrix from this space to `target`, Bradford-adapted so that white stays white.
    pub fn matrix_to(self, target: Self) -> Matrix3<f64> {
        if self == target {
            return Matrix3::identity();
        }
        let adaptation = bradford(self.white().xyz(), target.white().xyz());
        target.rgb_from_xyz() * adaptation * self.xyz_from_rgb()
    }

    /// `rgb` of this space as the same colour in `target`. Nothing is clipped.
    pub fn convert(self, rgb: Rgb, target: Self) -> Rgb {
        Rgb::from(self.matrix_to(target) * Vector3::from(rgb))
    }

    /// Tristimulus values of `rgb` relative to the space's own white.
    pub fn xyz(self, rgb: Rgb) -> Xyz {
        Xyz::from(self.xyz_from_rgb() * Vector3::from(rgb))
    }
}

impl fmt::Display for RgbSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for RgbSpace {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        Self::ALL
            .into_iter()
            .find(|space| space.id() == text)
            .ok_or_else(|| UnknownName::new("colour space", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conversion_keeps_white_and_returns() {
        let colour = Rgb([0.9, 0.4, -0.1]);
        for from in RgbSpace::ALL {
            for to in RgbSpace::ALL {
                assert!(from.convert(Rgb::WHITE, to).max_abs_difference(Rgb::WHITE) < 1e-12);
                let back = to.convert(from.convert(colour, to), from);
                assert!(back.max_abs_difference(colour) < 1e-12, "{from} {to}");
            }
        }
    }

    /// IEC 61966-2-1:1999 prints this matrix to four digits.
    #[test]
    fn srgb_matrix_is_the_standards() {
        let printed = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let ours = RgbSpace::LinRec709.xyz_from_rgb();
        for (row, printed_row) in printed.iter().enumerate() {
            for (column, value) in printed_row.iter().enumerate() {
                assert!((ours[(row, column)] - value).abs() < 6e-5, "{row} {column}");
            }
        }
    }

    #[test]
    fn identifiers_parse_back() {
        for space in RgbSpace::ALL {
            assert_eq!(space.id().parse(), Ok(space));
        }
        assert!("srgb".parse::<RgbSpace>().unwrap_err().to_string().contains("lin_rec709"));
    }
}
