//! Small spheres of many presets, rendered on a job for those in sight.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::job::Follower;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::FresnelModel;
use crate::preset::Shelved;
use crate::render::{Light, RadialTable, SphereView, Srgb8Picture};

/// What a thumbnail shows: r and h in linear Rec.709 and the roughness in tenths, which is as fine as one can see in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key {
    r: [u64; 3],
    h: [u64; 3],
    tenths: u8,
    size: u32,
}

impl Key {
    /// The key of a preset at so many pixels.
    pub(crate) fn of(preset: &Shelved, size: u32) -> Self {
        let bits = |rgb: Rgb| preset.space.convert(rgb, RgbSpace::LinRec709).0.map(f64::to_bits);
        let tenths = (preset.roughness.clamp(0.0, 1.0) * 10.0).round() as u8;
        Self { r: bits(preset.r), h: bits(preset.h), tenths, size }
    }

    fn model(&self) -> FresnelModel {
        let rgb = |bits: [u64; 3]| Rgb(bits.map(f64::from_bits));
        FresnelModel::Hoffman { r: rgb(self.r), h: rgb(self.h) }
    }
}

/// As many are kept as would be scrolled past in a while.
const MOST_KEPT: usize = 512;

/// As many are rendered before any is shown.
const AT_ONCE: usize = 24;

/// The views of a sphere that thumbnails have needed: blurring the light costs more than all else.
type Views = HashMap<(u8, u32), Arc<SphereView>>;

/// What a job has rendered.
type Rendered = Vec<(Key, ColorImage)>;

/// The thumbnails and the job that renders them.
#[derive(Default)]
pub(crate) struct Thumbnails {
    rendering: Follower<Vec<Key>, (Rendered, Views)>,
    shown: HashMap<Key, TextureHandle>,
    views: Views,
}

impl Thumbnails {
    /// True while spheres are being rendered.
    pub(crate) fn is_busy(&self) -> bool {
        self.rendering.is_busy()
    }

    /// The thumbnail, once there is one.
    pub(crate) fn get(&self, key: &Key) -> Option<&TextureHandle> {
        self.shown.get(key)
    }

    /// Sees to it that those in sight are rendered; drops others where there are too many.
    pub(crate) fn want(&mut self, ctx: &Context, in_sight: &[Key]) {
        let mut missing: Vec<Key> = in_sight.iter().filter(|key| !self.shown.contains_key(key)).copied().collect();
        missing.truncate(AT_ONCE);
        if missing.is_empty() && !self.rendering.is_busy() {
            return;
        }
        let views = self.views.clone();
        let done = self.rendering.follow(ctx, "thumbnails", missing, move |keys, _| render(&keys, views));
        let Some((_, (pictures, views))) = done else { return };
        self.views = views;
        if self.shown.len() + pictures.len() > MOST_KEPT {
            let in_sight: HashSet<&Key> = in_sight.iter().collect();
            self.shown.retain(|key, _| in_sight.contains(key));
        }
        for (key, picture) in pictures {
            self.shown.insert(key, ctx.load_texture("thumbnail", picture, TextureOptions::LINEAR));
        }
        ctx.request_repaint();
    }
}

fn render(keys: &[Key], mut views: Views) -> (Rendered, Views) {
    let mut picture = Srgb8Picture::default();
    let mut image = |key: &Key| {
        let roughness = f64::from(key.tenths) / 10.0;
        let new = || Arc::new(SphereView::new(key.size, Light::PhotoStudio, roughness, RgbSpace::LinRec709));
        let view = views.entry((key.tenths, key.size)).or_insert_with(new);
        view.render_srgb8(&RadialTable::of_model(&key.model(), RgbSpace::LinRec709), &mut picture);
        let size = [picture.width as usize, picture.height as usize];
        (*key, ColorImage::from_rgba_unmultiplied(size, &picture.rgba))
    };
    (keys.iter().map(&mut image).collect(), views)
}
