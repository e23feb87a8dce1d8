//! What a file says about its colours, and which of its statements counts.

use nalgebra::Matrix3;

use super::{cicp, icc};
use crate::color::{Chromaticity, RgbSpace};
use crate::photo::curve::Curve;
use crate::photo::linearizer::{Linearizer, rec709_from_primaries, rec709_from_xyz};
use crate::photo::picture::Untagged;
use crate::photo::samples::Samples;
use crate::photo::{ColourRule, Warning, WarningCode};

/// Chromaticities of red, green, blue and white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Primaries {
    pub rgb: [Chromaticity; 3],
    pub white: Chromaticity,
}

impl Primaries {
    /// Those of an RGB space of this crate.
    pub const fn of(space: RgbSpace) -> Self {
        Self { rgb: space.primaries(), white: space.white() }
    }

    /// From pairs in the order red, green, blue, white.
    pub fn from_xy([red, green, blue, white]: [[f64; 2]; 4]) -> Self {
        let xy = |[x, y]: [f64; 2]| Chromaticity::new(x, y);
        Self { rgb: [xy(red), xy(green), xy(blue)], white: xy(white) }
    }

    fn matrix(self) -> Result<Matrix3<f64>, String> {
        rec709_from_primaries(self.rgb, self.white)
            .ok_or_else(|| "the primaries in the file span no colours".to_owned())
    }
}

/// Adobe RGB (1998), section 4.3.1.
const ADOBE_RGB: Primaries = Primaries {
    rgb: [Chromaticity::new(0.64, 0.33), Chromaticity::new(0.21, 0.71), Chromaticity::new(0.15, 0.06)],
    white: Chromaticity::new(0.3127, 0.3290),
};
/// Adobe RGB (1998), section 4.3.1.2: 2 + 51/256.
const ADOBE_RGB_GAMMA: f64 = 563.0 / 256.0;

/// One statement of a file.
#[derive(Clone, Debug)]
pub(super) enum Claim {
    /// A statement that is there and cannot be read, as a sentence.
    Damaged(String),
    /// PNG `cICP`.
    Cicp { primaries: u8, transfer: u8, is_rgb_full_range: bool },
    /// An ICC profile.
    Icc(Vec<u8>),
    /// PNG `sRGB`.
    PngSrgb,
    /// PNG `gAMA` and `cHRM`.
    PngGamma { gamma: Option<f64>, primaries: Option<Primaries> },
    /// EXIF says sRGB.
    ExifSrgb,
    /// EXIF says Adobe RGB (1998).
    ExifAdobeRgb,
    /// Linear by the format, with these primaries.
    Linear { primaries: Primaries, rule: ColourRule },
    /// Linear CIE XYZ relative to an equal-energy white.
    LinearXyz,
    /// Primaries of a TIFF, which does not say its curve.
    TiffPrimaries(Primaries),
}

/// The statements of a file, the strongest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Colour {
    pub claims: Vec<Claim>,
}

impl Colour {
    /// Follows the first usable statement; each unusable one before it, and each assumption, becomes a warning.
    pub fn resolve(
        self,
        samples: &Samples,
        channels: usize,
        untagged: Untagged,
        warnings: &mut Vec<Warning>,
    ) -> (Linearizer, ColourRule) {
        let mut usable = None;
        for claim in self.claims {
            match claim.follow(samples, channels) {
                Ok(followed) => {
                    usable = Some(followed);
                    break;
                }
                Err(reason) => warnings.push(Warning::new(WarningCode::Profile, reason)),
            }
        }
        let (linearizer, rule) = usable.unwrap_or_else(|| assumed(samples, untagged));
        warnings.extend(assumption(&rule));
        (linearizer, rule)
    }
}

impl Claim {
    fn follow(self, samples: &Samples, channels: usize) -> Result<(Linearizer, ColourRule), String> {
        let same =
            |curve: Curve, matrix| Linearizer::from_curves([curve.clone(), curve.clone(), curve], matrix, samples);
        let rec709 = Primaries::of(RgbSpace::LinRec709);
        Ok(match self {
            Self::Damaged(reason) => return Err(reason),
            Self::Cicp { is_rgb_full_range: false, .. } => {
                return Err("PNG cICP speaks of narrow-range or non-RGB values and is not followed".to_owned());
            }
            Self::Cicp { primaries, transfer, .. } => {
                let (curve, matrix) = cicp::curve_and_matrix(primaries, transfer)?;
                (same(curve, matrix), ColourRule::PngCicp { primaries, transfer })
            }
            Self::Icc(bytes) => icc::follow(&bytes, samples, channels)?,
            Self::PngSrgb => (same(Curve::Srgb, rec709.matrix()?), ColourRule::PngSrgb),
            Self::PngGamma { gamma, primaries } => {
                let curve = gamma.map_or(Curve::Srgb, |gamma| Curve::Power(1.0 / gamma));
                let rule = ColourRule::PngGamma { gamma, has_primaries: primaries.is_some() };
                (same(curve, primaries.unwrap_or(rec709).matrix()?), rule)
            }
            Self::ExifSrgb => (same(Curve::Srgb, rec709.matrix()?), ColourRule::ExifSrgb),
            Self::ExifAdobeRgb => (same(Curve::Power(ADOBE_RGB_GAMMA), ADOBE_RGB.matrix()?), ColourRule::ExifAdobeRgb),
            Self::Linear { primaries, rule } => (same(Curve::Linear, primaries.matrix()?), rule),
            Self::LinearXyz => {
                let white = Chromaticity::new(1.0 / 3.0, 1.0 / 3.0);
                (same(Curve::Linear, rec709_from_xyz(white.xyz())), ColourRule::RadianceXyz)
            }
            Self::TiffPrimaries(primaries) => {
                let is_float = is_float(samples);
                let curve = if is_float { Curve::Linear } else { Curve::Srgb };
                (same(curve, primaries.matrix()?), ColourRule::TiffPrimaries { is_float })
            }
        })
    }
}

fn is_float(samples: &Samples) -> bool {
    matches!(samples, Samples::F16(_) | Samples::F32(_))
}

/// What is done where a file says nothing usable.
fn assumed(samples: &Samples, untagged: Untagged) -> (Linearizer, ColourRule) {
    let (curve, rule) = match untagged {
        Untagged::Linear => (Curve::Linear, ColourRule::LinearByChoice),
        Untagged::Srgb if is_float(samples) => (Curve::Linear, ColourRule::FloatAssumed),
        Untagged::Srgb => (Curve::Srgb, ColourRule::SrgbAssumed),
    };
    let curves = [curve.clone(), curve.clone(), curve];
    (Linearizer::from_curves(curves, Matrix3::identity(), samples), rule)
}

fn assumption(rule: &ColourRule) -> Option<Warning> {
    let what = match (rule.assumes_curve(), rule.assumes_primaries()) {
        (true, true) => "Its colour space and its curve are",
        (true, false) => "Its curve is",
        (false, true) => "Its primaries are",
        (false, false) => return None,
    };
    Some(Warning::new(WarningCode::Assumed, format!("{what} not stated by the file ({rule}).")))
}
