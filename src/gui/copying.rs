//! A colour as text for other programs.

use crate::color::{Rgb, RgbSpace, hex_from_srgb8, srgb8};

/// How a colour is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CopyForm {
    /// Linear numbers in the space of the preset, unclamped, as renderers' colour fields take them.
    Linear,
    /// 8-bit sRGB of the nearest colour that sRGB has.
    Srgb,
    /// The same as a hex code.
    Hex,
}

impl CopyForm {
    /// Every form.
    pub(crate) const ALL: [Self; 3] = [Self::Linear, Self::Srgb, Self::Hex];

    /// What it is called.
    pub(crate) fn label(self, space: RgbSpace) -> String {
        match self {
            Self::Linear => space.label().to_owned(),
            Self::Srgb => "sRGB 8-bit".to_owned(),
            Self::Hex => "sRGB hex code".to_owned(),
        }
    }

    /// The text of a colour that is linear in `space`.
    pub(crate) fn words(self, colour: Rgb, space: RgbSpace) -> String {
        let (code, _) = srgb8(colour, space);
        match self {
            Self::Linear => colour.0.map(|value| value.to_string()).join(", "),
            Self::Srgb => code.map(|value| value.to_string()).join(", "),
            Self::Hex => hex_from_srgb8(code),
        }
    }

    /// True when the text says less than the colour: sRGB does not have it.
    pub(crate) fn is_clipped(self, colour: Rgb, space: RgbSpace) -> bool {
        self != Self::Linear && srgb8(colour, space).1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::linear_from_srgb8;

    #[test]
    fn each_form_says_the_same_colour() {
        let colour = linear_from_srgb8([0xc8, 0x9b, 0x6e]);
        let wide = RgbSpace::LinRec709.convert(colour, RgbSpace::AcesCg);
        for (colour, space) in [(colour, RgbSpace::LinRec709), (wide, RgbSpace::AcesCg)] {
            assert_eq!(CopyForm::Srgb.words(colour, space), "200, 155, 110");
            assert_eq!(CopyForm::Hex.words(colour, space), "#c89b6e");
            let numbers: Vec<f64> =
                CopyForm::Linear.words(colour, space).split(", ").map(|number| number.parse().unwrap()).collect();
            assert_eq!(numbers, colour.0, "linear numbers keep every digit");
        }
    }

    #[test]
    fn what_srgb_does_not_have_is_known() {
        let gold = Rgb([1.05, 0.78, 0.34]);
        assert!(CopyForm::Hex.is_clipped(gold, RgbSpace::LinRec709));
        assert!(!CopyForm::Linear.is_clipped(gold, RgbSpace::LinRec709));
        assert!(!CopyForm::Srgb.is_clipped(Rgb::splat(0.5), RgbSpace::LinRec709));
    }
}
