//! What a person must know about the open preset, as sentences.

use super::state::State;
use super::widgets::channel_names;
use crate::color::srgb8;
use crate::fresnel::{feasible_h, reflectance_range};
use crate::preset::Preset;

/// Every warning about the preset, most important first.
pub(crate) fn warnings(state: &State) -> Vec<String> {
    let preset = &state.document.preset;
    let mut warnings: Vec<String> = (0..3).filter_map(|channel| infeasible(preset, channel)).collect();
    warnings.extend(out_of_gamut(preset));
    warnings
}

/// Where the curve of a channel leaves 0–1.
fn infeasible(preset: &Preset, channel: usize) -> Option<String> {
    const TOLERANCE: f64 = 1e-9;
    let (r, h) = (preset.r[channel], preset.h[channel]);
    let range = reflectance_range(r, h);
    if *range.start() >= -TOLERANCE && *range.end() <= 1.0 + TOLERANCE {
        return None;
    }
    let name = capitalised(channel_names()[channel]);
    let reach = if *range.start() < -TOLERANCE {
        format!("falls to {:.3}", range.start())
    } else {
        format!("rises to {:.3}", range.end())
    };
    Some(match feasible_h(r) {
        Some(h) => {
            format!("{name} {reach}. At this r, h between {:.3} and {:.3} stays within 0–1.", h.start(), h.end())
        }
        None => format!("{name} {reach}: r = {r:.3} itself lies outside 0–1. It is kept as it is."),
    })
}

fn out_of_gamut(preset: &Preset) -> Option<String> {
    let clipped = |rgb| srgb8(rgb, preset.space).1;
    let which = match (clipped(preset.r), clipped(preset.h)) {
        (false, false) => return None,
        (true, false) => "r lies",
        (false, true) => "h lies",
        (true, true) => "r and h lie",
    };
    Some(format!("{which} outside sRGB: the screen shows the nearest colour, the preset keeps the true one."))
}

/// With its first letter large.
pub(crate) fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb, RgbSpace};
    use crate::metal::metal_by_name;

    fn warnings_of(preset: Preset) -> Vec<String> {
        warnings(&State::new(preset))
    }

    #[test]
    fn a_grey_schlick_metal_has_none() {
        assert_eq!(warnings_of(Preset::new_authored()), [""; 0]);
    }

    /// Gold's linear-sRGB red exceeds 1, in ACEScg it does not.
    #[test]
    fn gold_is_outside_srgb_and_fits_acescg() {
        let gold = metal_by_name("gold").unwrap();
        assert!(warnings_of(Preset::from_metal(gold, RgbSpace::LinRec709)).iter().any(|w| w.starts_with("Red rises")));
        assert!(!warnings_of(Preset::from_metal(gold, RgbSpace::AcesCg)).iter().any(|w| w.starts_with("Red")));
    }

    #[test]
    fn a_black_edge_names_the_range_of_h() {
        let preset = Preset { h: Rgb([0.6, 0.0, 0.6]), ..Preset::new_authored() };
        let warnings = warnings_of(preset);
        assert!(
            warnings[0].starts_with("Green falls to -0.0") && warnings[0].contains("h between 0.0"),
            "{warnings:?}"
        );
    }
}
