//! The copy on the screen: exposed for looking at, or in false colours. Measurements never see it.

use std::sync::Arc;

use eframe::egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use rayon::prelude::*;

use crate::color::srgb_encode;
use crate::gui::job::Follower;
use crate::gui::theme;
use crate::photo::{PixelFlags, Preview};

/// How the copy is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Development {
    /// Stops of exposure.
    pub exposure_ev: f32,
    /// Marks what is clipped, black, not finite or negative in colours of its own.
    pub is_false_colour: bool,
}

/// The texture of a preview, renewed on a job when the development changes.
#[derive(Default)]
pub(crate) struct Developer {
    work: Follower<Development, ColorImage>,
    texture: Option<TextureHandle>,
}

impl Developer {
    /// True while a picture is being developed.
    pub(crate) fn is_busy(&self) -> bool {
        self.work.is_busy()
    }

    /// The newest texture there is, and sees to it that the one that is wanted follows.
    pub(crate) fn texture(
        &mut self,
        ctx: &Context,
        preview: &Arc<Preview>,
        wanted: Development,
    ) -> Option<&TextureHandle> {
        let preview = preview.clone();
        if let Some((_, image)) = self.work.follow(ctx, "develop", wanted, move |how, _| develop(&preview, how)) {
            self.texture = Some(ctx.load_texture("photograph", image, TextureOptions::LINEAR));
        }
        self.texture.as_ref()
    }
}

/// The picture of a preview.
pub(super) fn develop(preview: &Preview, how: Development) -> ColorImage {
    let gain = how.exposure_ev.exp2();
    let pixels = preview.rgb.par_iter().zip(&preview.flags);
    let shown = pixels.map(|(rgb, flags)| {
        let alarm = how.is_false_colour.then(|| alarm(*rgb, flags.unpack())).flatten();
        alarm.unwrap_or_else(|| encode(*rgb, gain))
    });
    ColorImage::new([preview.width as usize, preview.height as usize], shown.collect())
}

/// The 8-bit sRGB code of linear Rec.709 times a gain, limited to what a screen has.
pub(super) fn encode(rgb: [f32; 3], gain: f32) -> Color32 {
    let [red, green, blue] = rgb.map(|v| (srgb_encode(f64::from((v * gain).clamp(0.0, 1.0))) * 255.0).round() as u8);
    Color32::from_rgb(red, green, blue)
}

/// The colour of what must not be measured.
fn alarm(rgb: [f32; 3], flags: PixelFlags) -> Option<Color32> {
    let is_negative = rgb.iter().any(|v| *v < 0.0);
    let alarms = [
        (flags.non_finite, theme::NON_FINITE),
        (flags.clipped.contains(&true), theme::CLIPPED),
        (flags.black, theme::BLACK),
        (is_negative, theme::NEGATIVE),
    ];
    alarms.into_iter().find_map(|(is_true, colour)| is_true.then_some(colour))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(rgb: [f32; 3], flags: PixelFlags, how: Development) -> Color32 {
        let preview = Preview { width: 1, height: 1, rgb: vec![rgb], flags: vec![flags.into()] };
        develop(&preview, how).pixels[0]
    }

    #[test]
    fn one_stop_doubles_the_light() {
        let how = |exposure_ev| Development { exposure_ev, ..Development::default() };
        let clean = PixelFlags::default();
        assert_eq!(one([0.1; 3], clean, how(1.0)), one([0.2; 3], clean, how(0.0)));
        assert_eq!(one([1.0; 3], clean, how(0.0)), Color32::WHITE);
    }

    #[test]
    fn false_colours_are_for_what_must_not_be_measured() {
        let how = Development { is_false_colour: true, ..Development::default() };
        let clipped = PixelFlags { clipped: [false, true, false], ..PixelFlags::default() };
        assert_eq!(one([0.5; 3], clipped, how), theme::CLIPPED);
        assert_eq!(one([0.5, -0.1, 0.5], PixelFlags::default(), how), theme::NEGATIVE);
        let plain = Development::default();
        assert_eq!(one([0.5; 3], PixelFlags::default(), how), one([0.5; 3], clipped, plain));
    }
}
