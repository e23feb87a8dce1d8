//! The sphere previews: the preset, the truth beside it, and their difference, rendered on a job.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::job::Follower;
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

/// The previews and the job that renders them.
#[derive(Default)]
pub(crate) struct Spheres {
    rendering: Follower<Wanted, Rendered>,
    kept: Option<Kept>,
    shown: Option<Shown>,
}

impl Spheres {
    /// True while a picture is being rendered.
    pub(crate) fn is_busy(&self) -> bool {
        self.rendering.is_busy()
    }

    /// The newest pictures there are.
    pub(crate) fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// Sees to it that what is wanted will be shown.
    pub(crate) fn want(&mut self, ctx: &Context, wanted: Wanted) {
        let kept = self.kept.clone();
        let rendered = self.rendering.follow(ctx, "spheres", wanted, move |wanted, _| render(wanted, kept));
        if let Some((_, rendered)) = rendered {
            self.shown = Some(Shown::new(ctx, &rendered));
            self.kept = Some(rendered.kept);
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
        _ => view_of(&wanted),
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

/// What one view depends on: light, size, space, and the bits of the roughness.
type ViewKey = (Light, u32, RgbSpace, u64);

/// How many views are kept: a person goes back and forth between a few lights.
const KEPT_VIEWS: usize = 6;

/// The view of a sphere. Blurring the light costs far more than rendering, so the last few are kept.
fn view_of(wanted: &Wanted) -> Arc<SphereView> {
    static VIEWS: Mutex<VecDeque<(ViewKey, Arc<SphereView>)>> = Mutex::new(VecDeque::new());
    let key = (wanted.light, wanted.size, wanted.space, wanted.roughness.to_bits());
    // Held while a view is made: whoever wants the same one then finds it. A panic leaves the list whole.
    let mut views = VIEWS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, view)) = views.iter().find(|(known, _)| *known == key) {
        return view.clone();
    }
    let view = Arc::new(SphereView::new(wanted.size, wanted.light, wanted.roughness, wanted.space));
    views.push_front((key, view.clone()));
    views.truncate(KEPT_VIEWS);
    view
}

/// The smallest round end of a scale that holds `max`.
pub(crate) fn full_scale(max: f64) -> f64 {
    [2.0, 5.0, 10.0, 20.0, 50.0].into_iter().find(|scale| *scale >= max).unwrap_or(100.0)
}
