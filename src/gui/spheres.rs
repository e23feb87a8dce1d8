//! The sphere previews: the preset, the truth beside it, and their difference, rendered on a job.

use std::sync::Arc;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::job::{Job, Poll};
use crate::color::RgbSpace;
use crate::fresnel::FresnelModel;
use crate::metal::Metal;
use crate::render::{DeltaEMap, Light, RadialTable, SphereView, Srgb8Picture};

/// Everything a preview depends on.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    /// The preset's curve.
    pub model: FresnelModel,
    /// The space of its numbers.
    pub space: RgbSpace,
    /// Perceptual roughness.
    pub roughness: f64,
    /// The metal to compare with.
    pub metal: Option<&'static Metal>,
    /// The light around the sphere.
    pub light: Light,
    /// Side of the picture in pixels of the screen.
    pub size: u32,
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        let id = |wanted: &Self| wanted.metal.map(|metal| metal.id.as_str());
        self.model == other.model && self.same_view(other) && id(self) == id(other)
    }
}

impl Wanted {
    /// True when both look at the same sphere under the same light.
    fn same_view(&self, other: &Self) -> bool {
        (self.light, self.size, self.space) == (other.light, other.size, other.space)
            && self.roughness == other.roughness
    }

    fn same_truth(&self, other: &Self) -> bool {
        let id = |wanted: &Self| wanted.metal.map(|metal| metal.id.as_str());
        id(self) == id(other) && self.space == other.space
    }
}

/// What a change of the preset's colours leaves as it is.
#[derive(Clone)]
struct Kept {
    wanted: Wanted,
    view: Arc<SphereView>,
    truth: Option<Arc<RadialTable>>,
}

struct Rendered {
    kept: Kept,
    preset: Srgb8Picture,
    truth: Option<Truth>,
}

struct Truth {
    picture: Srgb8Picture,
    map: Srgb8Picture,
    difference: Difference,
}

/// The colour difference between preset and truth over the sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Difference {
    /// Mean over what is covered.
    pub mean: f64,
    /// The largest.
    pub max: f64,
    /// The ΔE at the bright end of the map's scale.
    pub full_scale: f64,
}

/// Pictures on the screen.
pub(crate) struct Shown {
    /// The sphere of the preset.
    pub preset: TextureHandle,
    /// The sphere of the metal, the map of their difference, and its numbers.
    pub truth: Option<(TextureHandle, TextureHandle, Difference)>,
}

/// The previews and the job that renders them. A job is never replaced: the next one starts when it ends, with
/// whatever is wanted then, so that a long drag still shows pictures.
#[derive(Default)]
pub(crate) struct Spheres {
    working: Option<Job<Wanted, Rendered>>,
    kept: Option<Kept>,
    shown: Option<Shown>,
}

impl Spheres {
    /// True while a picture is being rendered.
    pub(crate) fn is_busy(&self) -> bool {
        self.working.is_some()
    }

    /// The newest pictures there are.
    pub(crate) fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// Sees to it that what is wanted will be shown.
    pub(crate) fn want(&mut self, ctx: &Context, wanted: Wanted) {
        self.poll(ctx);
        let is_current = self.kept.as_ref().is_some_and(|kept| kept.wanted == wanted);
        if self.working.is_none() && !is_current {
            let kept = self.kept.clone();
            self.working = Job::start(ctx, "spheres", wanted, move |wanted, _| render(wanted, kept)).ok();
        }
    }

    fn poll(&mut self, ctx: &Context) {
        let Some(job) = self.working.take() else { return };
        match job.poll() {
            Poll::Working => self.working = Some(job),
            Poll::Done(rendered) => {
                self.shown = Some(Shown::new(ctx, &rendered));
                self.kept = Some(rendered.kept);
            }
            Poll::Lost => log::error!("the sphere preview ended unexpectedly"),
        }
    }
}

impl std::fmt::Debug for Spheres {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Spheres").field("is_busy", &self.is_busy()).finish_non_exhaustive()
    }
}

impl Shown {
    fn new(ctx: &Context, rendered: &Rendered) -> Self {
        let load = |name: &str, picture: &Srgb8Picture| ctx.load_texture(name, image(picture), TextureOptions::LINEAR);
        Self {
            preset: load("sphere of the preset", &rendered.preset),
            truth: rendered.truth.as_ref().map(|truth| {
                let sphere = load("sphere of the truth", &truth.picture);
                (sphere, load("difference of the spheres", &truth.map), truth.difference)
            }),
        }
    }
}

fn image(picture: &Srgb8Picture) -> ColorImage {
    ColorImage::from_rgba_unmultiplied([picture.width as usize, picture.height as usize], &picture.rgba)
}

fn render(wanted: Wanted, kept: Option<Kept>) -> Rendered {
    let view = match &kept {
        Some(kept) if kept.wanted.same_view(&wanted) => kept.view.clone(),
        _ => Arc::new(SphereView::new(wanted.size, wanted.light, wanted.roughness, wanted.space)),
    };
    let truth = match &kept {
        Some(kept) if kept.wanted.same_truth(&wanted) => kept.truth.clone(),
        _ => wanted.metal.map(|metal| Arc::new(RadialTable::of_metal(metal, wanted.space))),
    };
    let preset = view.render(&RadialTable::of_model(&wanted.model, wanted.space));
    let truth_shown = truth.as_ref().map(|table| {
        let picture = view.render(table);
        let map = DeltaEMap::between(&preset, &picture);
        let difference = Difference { mean: map.mean(), max: map.max(), full_scale: full_scale(map.max()) };
        Truth { picture: picture.to_srgb8(), map: map.to_false_colour(difference.full_scale), difference }
    });
    Rendered { preset: preset.to_srgb8(), truth: truth_shown, kept: Kept { wanted, view, truth } }
}

/// The smallest round end of a scale that holds `max`.
fn full_scale(max: f64) -> f64 {
    [2.0, 5.0, 10.0, 20.0, 50.0].into_iter().find(|scale| *scale >= max).unwrap_or(100.0)
}
