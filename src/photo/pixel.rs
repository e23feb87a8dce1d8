//! One pixel, linear, with what was wrong with it before any conversion.

use crate::color::Rgb;

/// A pixel in linear Rec.709, unclamped, with the flags of its stored value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Linear Rec.709.
    pub rgb: Rgb,
    /// What the stored value showed before colour conversion.
    pub flags: PixelFlags,
}

/// Flags taken from the stored value, before colour conversion can hide them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PixelFlags {
    /// Stored channels at or above 0.995 of their range; floats only at the largest number of their type.
    pub clipped: [bool; 3],
    /// Every stored channel below 12/255 of its range, or below the linear value of that sRGB code where the
    /// file is linear; floats, which have no code values, at zero and below.
    pub black: bool,
    /// A stored channel is NaN or infinite; the colour is then zero.
    pub non_finite: bool,
}

impl PixelFlags {
    /// True when the pixel may be measured.
    pub fn is_clean(self) -> bool {
        !self.clipped.contains(&true) && !self.black && !self.non_finite
    }
}
