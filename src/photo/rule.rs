//! Which rule made a photograph linear.

use std::fmt;

use serde::{Serialize, Serializer};

/// The rule that fired when the stored values became linear Rec.709, shown and kept as one stable sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum ColourRule {
    /// The picture was made in linear Rec.709 and never was a file.
    Linear,
    /// PNG `cICP`, code points of ITU-T H.273.
    PngCicp {
        /// ColourPrimaries, table 2.
        primaries: u8,
        /// TransferCharacteristics, table 3.
        transfer: u8,
    },
    /// An ICC profile.
    IccProfile {
        /// The description inside the profile.
        description: String,
        /// True when its curves are straight lines.
        is_linear: bool,
    },
    /// PNG `sRGB`.
    PngSrgb,
    /// PNG `gAMA` or `cHRM` or both.
    PngGamma {
        /// The encoding exponent of `gAMA`; `None` where only `cHRM` is there.
        gamma: Option<f64>,
        /// True when `cHRM` gives the primaries.
        has_primaries: bool,
    },
    /// EXIF ColorSpace 1: sRGB.
    ExifSrgb,
    /// EXIF ColorSpace 65535 with interoperability index R03, or ColorSpace 2: Adobe RGB (1998).
    ExifAdobeRgb,
    /// OpenEXR `chromaticities`.
    ExrChromaticities,
    /// OpenEXR without `chromaticities`, which that standard defines as Rec.709.
    ExrDefault,
    /// Radiance HDR; a `PRIMARIES` line or Rec.709.
    Radiance {
        /// True when the file names its primaries.
        has_primaries: bool,
    },
    /// Radiance HDR with XYZ pixels.
    RadianceXyz,
    /// TIFF WhitePoint and PrimaryChromaticities.
    TiffPrimaries {
        /// True for floating-point samples, linear by convention; else the sRGB curve is assumed.
        is_float: bool,
    },
    /// Floating-point TIFF without colour information: linear Rec.709 by convention.
    FloatAssumed,
    /// Nothing in the file: sRGB assumed.
    SrgbAssumed,
    /// Nothing in the file: linear Rec.709 as the person said.
    LinearByChoice,
}

impl ColourRule {
    /// True when the file does not say by which curve its values are encoded.
    pub fn assumes_curve(&self) -> bool {
        match self {
            Self::SrgbAssumed | Self::FloatAssumed | Self::TiffPrimaries { .. } => true,
            Self::PngGamma { gamma, .. } => gamma.is_none(),
            _ => false,
        }
    }

    /// True when the file does not say what its primaries are, and its format does not either.
    pub fn assumes_primaries(&self) -> bool {
        match self {
            Self::SrgbAssumed | Self::FloatAssumed | Self::LinearByChoice => true,
            Self::PngGamma { has_primaries, .. } | Self::Radiance { has_primaries } => !has_primaries,
            _ => false,
        }
    }

    /// True when a part of the rule is an assumption.
    pub fn is_assumed(&self) -> bool {
        self.assumes_curve() || self.assumes_primaries()
    }

    /// True when the stored values are proportional to light, so that no tone curve stands between.
    pub fn is_scene_linear(&self) -> bool {
        match self {
            Self::Linear
            | Self::ExrChromaticities
            | Self::ExrDefault
            | Self::Radiance { .. }
            | Self::RadianceXyz
            | Self::FloatAssumed
            | Self::LinearByChoice => true,
            Self::PngCicp { transfer, .. } => *transfer == 8,
            Self::IccProfile { is_linear, .. } => *is_linear,
            Self::PngGamma { gamma, .. } => *gamma == Some(1.0),
            Self::TiffPrimaries { is_float } => *is_float,
            Self::PngSrgb | Self::ExifSrgb | Self::ExifAdobeRgb | Self::SrgbAssumed => false,
        }
    }
}

impl fmt::Display for ColourRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Linear => f.write_str("Linear Rec.709 as made"),
            Self::PngCicp { primaries, transfer } => {
                write!(f, "PNG cICP: primaries {primaries}, transfer {transfer} of ITU-T H.273")
            }
            Self::IccProfile { description, is_linear: false } => write!(f, "ICC profile: {description}"),
            Self::IccProfile { description, is_linear: true } => write!(f, "ICC profile: {description} (linear)"),
            Self::PngSrgb => f.write_str("PNG sRGB chunk: sRGB"),
            Self::PngGamma { gamma: Some(gamma), has_primaries: true } => {
                write!(f, "PNG gAMA {gamma} and cHRM")
            }
            Self::PngGamma { gamma: Some(gamma), has_primaries: false } => {
                write!(f, "PNG gAMA {gamma}; Rec.709 primaries assumed")
            }
            Self::PngGamma { gamma: None, .. } => f.write_str("PNG cHRM; sRGB curve assumed"),
            Self::ExifSrgb => f.write_str("EXIF: sRGB"),
            Self::ExifAdobeRgb => f.write_str("EXIF: Adobe RGB (1998)"),
            Self::ExrChromaticities => f.write_str("OpenEXR chromaticities: linear"),
            Self::ExrDefault => f.write_str("OpenEXR without chromaticities: linear Rec.709 by its standard"),
            Self::Radiance { has_primaries: true } => f.write_str("Radiance HDR PRIMARIES: linear"),
            Self::Radiance { has_primaries: false } => f.write_str("Radiance HDR: linear; Rec.709 primaries assumed"),
            Self::RadianceXyz => f.write_str("Radiance HDR XYZE: linear CIE XYZ"),
            Self::TiffPrimaries { is_float: true } => {
                f.write_str("TIFF primaries; floating-point samples linear by convention")
            }
            Self::TiffPrimaries { is_float: false } => f.write_str("TIFF primaries; sRGB curve assumed"),
            Self::FloatAssumed => f.write_str("Floating-point TIFF: linear by convention; Rec.709 primaries assumed"),
            Self::SrgbAssumed => f.write_str("No colour information: sRGB assumed"),
            Self::LinearByChoice => f.write_str("No colour information: linear Rec.709 by choice"),
        }
    }
}

impl Serialize for ColourRule {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
