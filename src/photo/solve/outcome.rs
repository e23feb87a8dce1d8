//! The result of a match.

use serde::{Serialize, Serializer};
use thiserror::Error;

use super::fit::BallFit;
use super::guard::mirrors_backdrop;
use super::light::Light;
use super::measured::Measured;
use super::uncertainty::Uncertainty;
use crate::color::{Rgb, RgbSpace};
use crate::photo::{AreaStatistics, Card, LightMode, MatchRequest, Photo, Recipe, Warning};

/// r and h of a photographed metal, with what is known about them.
///
/// As JSON it is the object of `edgewise match --json`; a value that cannot be measured is `null`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Match {
    /// The space r and h are given in.
    pub space: RgbSpace,
    /// Where the light came from.
    pub mode: LightMode,
    /// Reflectance facing the surface, unclamped.
    pub r: [Option<f64>; 3],
    /// Reflectance at 81.8°, unclamped.
    pub h: [Option<f64>; 3],
    /// The ± of r: its expanded uncertainty with coverage factor 2, about 95 %.
    pub r_uncertainty: [Option<f64>; 3],
    /// The ± of h, likewise.
    pub h_uncertainty: [Option<f64>; 3],
    /// What to beware of.
    pub warnings: Vec<Warning>,
    /// True when the light or the tone curve is not known: an estimate, never a measurement.
    pub is_estimate: bool,
    /// L: the pixel of a perfect mirror, linear Rec.709.
    pub light: [Option<f64>; 3],
    /// What each card showed, linear Rec.709.
    pub cards: Vec<CardReading>,
    /// Robust standard deviation of the averaged cells around the fit, as reflectance; `None` where nothing was fitted.
    pub residual: [Option<f64>; 3],
    /// Standard deviation of one pixel around the fit, as reflectance, likewise.
    pub noise: [Option<f64>; 3],
    /// Pixels that were read, facing and grazing together.
    pub pixels: usize,
    /// Where the uncertainty of r and h comes from, linear Rec.709.
    pub uncertainty: UncertaintyBudget,
    /// What was marked.
    pub request: MatchRequest,
}

/// A card and what was measured on it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CardReading {
    /// The card as marked.
    #[serde(flatten)]
    pub card: Card,
    /// What its area holds, linear Rec.709.
    pub statistics: AreaStatistics,
}

/// Standard uncertainties by source, each `[r, h]` for each channel, linear Rec.709.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct UncertaintyBudget {
    /// Scatter of the surface: block jackknife over sectors or tiles.
    pub sample: [[f64; 2]; 3],
    /// What the two-colour curve leaves over, ring by ring.
    pub model: [[f64; 2]; 3],
    /// The light: card tolerance, unevenness and noise.
    pub light: [[f64; 2]; 3],
    /// The angle: the outline's radius.
    pub angle: [[f64; 2]; 3],
    /// The tone curve.
    pub transfer: [[f64; 2]; 3],
}

impl UncertaintyBudget {
    /// All sources in quadrature times the coverage factor 2 (GUM 2008, 6.2): the ± of `[r, h]` of a channel.
    pub fn expanded(&self, channel: usize) -> [f64; 2] {
        self.total(channel).map(|standard| 2.0 * standard)
    }

    /// All sources in quadrature: the standard uncertainty of `[r, h]` of a channel.
    pub fn total(&self, channel: usize) -> [f64; 2] {
        let sources = [&self.sample, &self.model, &self.light, &self.angle, &self.transfer];
        std::array::from_fn(|which| sources.iter().map(|source| source[channel][which].powi(2)).sum::<f64>().sqrt())
    }
}

impl Match {
    pub(super) fn new(
        request: &MatchRequest,
        space: RgbSpace,
        light: &Light,
        measured: &Measured,
        uncertainty: &Uncertainty,
    ) -> Self {
        let usable = |channel: usize| light.value[channel].is_some();
        let kept = |values: [Option<f64>; 3], stratum: usize| -> [Option<f64>; 3] {
            let is_good = |i: usize| usable(i) && !measured.counts[stratum].is_clipped(i);
            std::array::from_fn(|i| values[i].filter(|_| is_good(i)))
        };
        let r = kept(measured.curve.fits.each_ref().map(|fit| fit.r), 0);
        // A backdrop beside the rim says nothing about what the middle of the ball mirrors.
        let r = if request.mode == LightMode::Backdrop { [None; 3] } else { r };
        let h = kept(measured.curve.fits.each_ref().map(|fit| fit.h), 1);
        let h = if mirrors_backdrop(request, measured) { [None; 3] } else { h };
        let totals = [0, 1, 2].map(|channel| uncertainty.budget.expanded(channel));
        let of = |values: [Option<f64>; 3], which: usize| in_space(values, totals.map(|total| total[which]), space);
        let ((r, r_uncertainty), (h, h_uncertainty)) = (of(r, 0), of(h, 1));
        Self {
            space,
            mode: request.mode,
            r,
            h,
            r_uncertainty,
            h_uncertainty,
            warnings: Vec::new(),
            is_estimate: uncertainty.is_estimate,
            light: light.value,
            cards: light.readings(),
            residual: measured.curve.fits.each_ref().map(|fit| known(fit.scatter)),
            noise: measured.noise.map(known),
            pixels: measured.counts.iter().map(|counts| counts.pixels).sum(),
            uncertainty: uncertainty.budget,
            request: request.clone(),
        }
    }

    /// From the ratios of mode A.
    pub(super) fn of_ratios(
        request: &MatchRequest,
        space: RgbSpace,
        light: [Option<f64>; 3],
        fits: &[BallFit; 3],
        uncertainty: UncertaintyBudget,
        pixels: usize,
        is_estimate: bool,
    ) -> Self {
        let totals = [0, 1, 2].map(|channel| uncertainty.expanded(channel));
        let of = |value: fn(&BallFit) -> Option<f64>, which: usize| {
            let values = std::array::from_fn(|i| value(&fits[i]).filter(|_| light[i].is_some()));
            in_space(values, totals.map(|total| total[which]), space)
        };
        let ((r, r_uncertainty), (h, h_uncertainty)) = (of(|fit| fit.r, 0), of(|fit| fit.h, 1));
        Self {
            space,
            mode: request.mode,
            r,
            h,
            r_uncertainty,
            h_uncertainty,
            warnings: Vec::new(),
            is_estimate,
            light,
            cards: Vec::new(),
            residual: [None; 3],
            noise: [None; 3],
            pixels,
            uncertainty,
            request: request.clone(),
        }
    }

    /// r when all three channels were measured.
    pub fn complete_r(&self) -> Option<Rgb> {
        complete(self.r)
    }

    /// h when all three channels were measured.
    pub fn complete_h(&self) -> Option<Rgb> {
        complete(self.h)
    }

    /// The record with which the same photograph gives the same numbers again.
    pub fn recipe(&self, photo: &Photo) -> Recipe {
        Recipe {
            photo: photo.name.clone(),
            photo_sha256: photo.sha256.clone(),
            colour_rule: photo.colour_rule.to_string(),
            request: self.request.clone(),
            r_uncertainty: self.r_uncertainty,
            h_uncertainty: self.h_uncertainty,
            warnings: self.warnings.clone(),
            is_estimate: self.is_estimate,
        }
    }
}

/// A number, if it is one: the scatter of no pixel is none.
fn known(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn complete(values: [Option<f64>; 3]) -> Option<Rgb> {
    Some(Rgb([values[0]?, values[1]?, values[2]?]))
}

/// Values and uncertainties in another space. A channel of it needs all three of Rec.709.
///
/// The uncertainties add up as if the channels erred together: an upper bound whatever their correlation.
fn in_space(
    values: [Option<f64>; 3],
    uncertainties: [f64; 3],
    space: RgbSpace,
) -> ([Option<f64>; 3], [Option<f64>; 3]) {
    if space == RgbSpace::LinRec709 {
        return (values, std::array::from_fn(|i| values[i].map(|_| uncertainties[i])));
    }
    let Some(rgb) = complete(values) else { return ([None; 3], [None; 3]) };
    let matrix = RgbSpace::LinRec709.matrix_to(space).map(f64::abs);
    let bound = Rgb::from(matrix * nalgebra::Vector3::from(uncertainties));
    (RgbSpace::LinRec709.convert(rgb, space).0.map(Some), bound.0.map(Some))
}

/// Why nothing could be matched.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MatchError {
    /// No ball and no area.
    #[error("nothing is marked to measure: mark a ball or a cylinder, or pick a facing or an edge area")]
    NothingMarked,
    /// Two outlines.
    #[error("a ball and a cylinder are marked: keep the one to measure")]
    TwoBodies,
    /// The mode lacks its reference.
    #[error("the mode “{}” needs {needs}", mode.label())]
    ModeNotMarked {
        /// The mode asked for.
        mode: LightMode,
        /// What is missing.
        needs: &'static str,
    },
    /// A mark holds no pixel of the picture.
    #[error("the {what} holds no pixel of the picture")]
    NoPixels {
        /// Which mark.
        what: &'static str,
    },
    /// Neutral patches that make no curve.
    #[error(
        "the grey patches make no tone curve: mark at least three, each inside the picture and each brighter than \
         the next darker one"
    )]
    Greys,
    /// A reference metal the library does not hold.
    #[error("{0}")]
    Metal(String),
    /// Ratios at angles that show neither r nor h.
    #[error("one ratio shows r up to {up_to_deg}° and h from {from_deg}°; add a picture at one of these angles")]
    MirrorAngle {
        /// Largest angle for r, in degrees.
        up_to_deg: f64,
        /// Smallest angle for h, in degrees.
        from_deg: f64,
    },
    /// A reference without light.
    #[error("the {what} is black: it cannot say what white is")]
    DarkReference {
        /// Which mark.
        what: &'static str,
    },
}

impl MatchError {
    pub(super) const fn needs(mode: LightMode, needs: &'static str) -> Self {
        Self::ModeNotMarked { mode, needs }
    }
}

/// Writes the sentence: errors appear as text wherever results are serialised beside them.
impl Serialize for MatchError {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
