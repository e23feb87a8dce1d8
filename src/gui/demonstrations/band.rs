//! Colours side by side, ready for the screen.

use eframe::egui::Color32;

use crate::color::{Rgb, RgbSpace};
use crate::gui::widgets::colour32;

/// A row of colours that was encoded off the window's thread.
#[derive(Clone, Debug)]
pub(crate) struct Band {
    /// As the screen shows them.
    pub colours: Vec<Color32>,
    /// Whether sRGB had to clip one.
    pub is_clipped: bool,
}

impl Band {
    /// Colours of a space.
    pub(crate) fn of(colours: impl IntoIterator<Item = Rgb>, space: RgbSpace) -> Self {
        let mut is_clipped = false;
        let encode = |rgb: Rgb| {
            let (colour, was_clipped) = colour32(rgb, space);
            is_clipped |= was_clipped;
            colour
        };
        Self { colours: colours.into_iter().map(encode).collect(), is_clipped }
    }

    /// The colour at a share 0–1 of the row.
    pub(crate) fn at(&self, share: f64) -> Color32 {
        let last = self.colours.len().saturating_sub(1) as f64;
        let index = (share.clamp(0.0, 1.0) * last).round() as usize;
        self.colours.get(index).copied().unwrap_or_default()
    }
}
