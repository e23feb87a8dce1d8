//! Where a polished body ends in a picture.
//!
//! Close to 90° every metal mirrors what stands right behind it, so its rim fades into the backdrop like a square
//! root: the steepest step of brightness lies up to half a pixel inside. Here the brightness across the edge is
//! fitted instead, by the very curves that r and h of a metal have ([`curve`]), blurred as the picture is; part by part
//! around the edge ([`profile`]), with the unknowns of the outline in common ([`fit`]).

mod curve;
mod fit;
mod profile;

use self::curve::EdgeCurves;
use self::fit::{EdgeFit, misfit};
use self::profile::Profile;
use super::{Body, Photo};

/// How an outline has to change to lie on the edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    /// Change of the radius, and of the two other unknowns of the outline.
    pub change: [f64; 3],
    /// Standard uncertainty of the radius in pixels.
    pub uncertainty_px: f64,
    /// Standard deviation of the blur in pixels, beside that of the pixels themselves.
    pub blur_px: f64,
}

/// What the shape of a lens that is no Gaussian leaves, in pixels.
const LENS_SHAPE_PX: f64 = 0.04;
/// √3: a tone curve anywhere within reach has this much less standard uncertainty than the reach.
const RECTANGULAR: f64 = 1.732_050_807_568_877_2;

/// Fits the edge of a body that is marked to about a pixel; `None` where too little of it is seen.
///
/// With a step at the edge and without: whichever the picture supports, or both in part (Buckland, Burnham & Augustin
/// 1997), since without one the edge is known far better, and with one only if it may be there.
pub(super) fn fit_rim(photo: &Photo, body: Body, blur_px: f64, leads: &dyn Fn(f64, f64) -> [f64; 2]) -> Option<Rim> {
    let profile = Profile::of(photo, body, leads);
    let [smooth, stepped] = [false, true].map(|has_step| EdgeFit::of(&profile, body.radius(), has_step, blur_px));
    let share = match (&smooth, &stepped) {
        (Some(smooth), Some(stepped)) => share_of_step(&profile, body.radius(), smooth, stepped),
        (None, _) => 1.0,
        (_, None) => 0.0,
    };
    let (smooth, stepped) = (smooth.or(stepped)?, stepped.or(smooth)?);
    let mean = |of: &dyn Fn(&EdgeFit) -> f64| (1.0 - share) * of(&smooth) + share * of(&stepped);
    let variance = mean(&|fit| fit.variance)
        + share * (1.0 - share) * (smooth.change[0] - stepped.change[0]).powi(2)
        + (mean(&|fit| fit.by_tone) / RECTANGULAR).powi(2)
        + mean(&|fit| fit.by_misfit).powi(2)
        + LENS_SHAPE_PX.powi(2);
    Some(Rim {
        change: std::array::from_fn(|which| mean(&|fit| fit.change[which])),
        uncertainty_px: variance.sqrt(),
        blur_px: mean(&|fit| fit.blur_px),
    })
}

/// A small ball before a dark card may look like one without a step under a sharper lens: a step is never excluded.
const LEAST_SHARE_OF_STEP: f64 = 0.2;

/// How likely there is a step at the edge, by the Bayesian information criterion (Schwarz 1978) for one more unknown in
/// the mean over all parts.
fn share_of_step(profile: &Profile, radius_px: f64, smooth: &EdgeFit, stepped: &EdgeFit) -> f64 {
    let left = |fit: &EdgeFit, has_step: bool| {
        let curves = EdgeCurves::of(radius_px, fit.blur_px, profile.depth_px);
        misfit(&profile.whole(fit.change), &curves, has_step, profile.noise)
    };
    let pixels: f64 = profile.parts.iter().flat_map(|part| &part.bins).map(|bin| bin.count).sum();
    let gain = left(smooth, false) - left(stepped, true) - pixels.max(1.0).ln();
    (1.0 / (1.0 + (-0.5 * gain).exp())).max(LEAST_SHARE_OF_STEP)
}
