//! What the previews of spheres show, drawn: from what is wanted to the images that textures are made of.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui::ColorImage;

use super::preview::Quality;
use super::spheres::Wanted;
use crate::color::RgbSpace;
use crate::metal::SpectralModel;
use crate::render::{DeltaEMap, Light, RadialTable, SphereView, Srgb8Picture};
use crate::spectrum::Quadrature;

/// The sphere of the preset, and where there is a metal, its sphere and the difference of both, as the screen shows them.
pub(super) struct Drawn {
    preset: Srgb8Picture,
    truth: Option<Truth>,
}

struct Truth {
    picture: Srgb8Picture,
    map: Srgb8Picture,
    difference: Difference,
}

/// What is drawn, as textures are made of it: the sphere of the preset, that of the truth, and their difference.
pub(super) struct Images {
    pub(super) preset: ColorImage,
    pub(super) truth: Option<(ColorImage, ColorImage, Difference)>,
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

impl Difference {
    /// In words; of coarse pictures with the few digits that hold, and marked.
    pub(crate) fn words(&self, is_finished: bool) -> String {
        if is_finished {
            format!("mean ΔE {:.2}, at most {:.2}", self.mean, self.max)
        } else {
            format!("mean ΔE ≈ {:.1}, at most ≈ {:.1} (coarse)", self.mean, self.max)
        }
    }
}

impl Drawn {
    /// Draws a preview; the truth as it is given. Without one the codes are drawn at once, into the memory of `spare`; a
    /// difference needs the linear pictures of both.
    pub(super) fn of(wanted: &Wanted, quality: Quality, truth: Option<&RadialTable>, mut spare: Srgb8Picture) -> Self {
        let view = view_of(&Wanted { size: quality.size(wanted.size), ..wanted.clone() });
        let table = RadialTable::of_model(&wanted.model, wanted.space);
        let Some(truth) = truth else {
            view.render_srgb8(&table, &mut spare);
            return Self { preset: spare, truth: None };
        };
        let (preset, picture) = (view.render(&table), view.render(truth));
        let map = DeltaEMap::between(&preset, &picture);
        let difference = Difference { mean: map.mean(), max: map.max(), full_scale: full_scale(map.max()) };
        let truth = Truth { picture: picture.to_srgb8(), map: map.to_false_colour(difference.full_scale), difference };
        Self { preset: preset.to_srgb8(), truth: Some(truth) }
    }

    /// The sphere that all of the quality shows on.
    pub(super) fn sphere(&self) -> &Srgb8Picture {
        self.truth.as_ref().map_or(&self.preset, |truth| &truth.picture)
    }

    /// Copies, multiplied by alpha.
    pub(super) fn images(&self) -> Images {
        let image = |picture: &Srgb8Picture| {
            ColorImage::from_rgba_unmultiplied([picture.width as usize, picture.height as usize], &picture.rgba)
        };
        let truth = |truth: &Truth| (image(&truth.picture), image(&truth.map), truth.difference);
        Images { preset: image(&self.preset), truth: self.truth.as_ref().map(truth) }
    }

    /// The memory of the preset's sphere, to draw into.
    pub(super) fn into_spare(self) -> Srgb8Picture {
        self.preset
    }
}

/// The sphere that all of a quality shows on, alone: that of the truth where there is one.
pub(super) fn sphere_alone(wanted: &Wanted, quality: Quality, truth: Option<&RadialTable>) -> Srgb8Picture {
    let view = view_of(&Wanted { size: quality.size(wanted.size), ..wanted.clone() });
    match truth {
        Some(truth) => view.render(truth).to_srgb8(),
        None => view.render(&RadialTable::of_model(&wanted.model, wanted.space)).to_srgb8(),
    }
}

/// The truth of the metal, if there is one.
pub(super) fn truth_table(wanted: &Wanted, quality: Quality) -> Option<Arc<RadialTable>> {
    let metal = wanted.metal?;
    Some(Arc::new(match quality.wavelengths {
        None => RadialTable::of_metal(metal, wanted.space),
        Some(count) => {
            let few = SpectralModel::new(metal, count, Quadrature::Spline, wanted.space);
            RadialTable::new(wanted.space, |cos_theta| few.reflectance(cos_theta))
        }
    }))
}

/// What one view depends on: light, size, space, and the bits of the roughness.
type ViewKey = (Light, u32, RgbSpace, u64);

/// How many views are kept: a person goes back and forth between a few lights, and each has a few sizes.
const KEPT_VIEWS: usize = 12;

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
