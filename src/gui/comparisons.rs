//! Other models of the preset, drawn beneath it.

use std::collections::BTreeSet;

use eframe::egui::Context;

use super::job::Follower;
use super::truth::{Curve, curve_angles_deg};
use crate::color::RgbSpace;
use crate::fit::{convert, nearest_conductor};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind};

/// A model that the preset can be compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Comparison {
    /// Schlick's curve with the same r.
    Schlick,
    /// F82-tint as programs read it that limit the tint to 0–1.
    LimitedTint,
    /// The same r with the g that comes nearest.
    Gulbrandsen,
    /// The n and k of each channel that come nearest.
    Conductor,
}

impl Comparison {
    /// Every model, in the order of the legend.
    pub(crate) const ALL: [Self; 4] = [Self::Schlick, Self::LimitedTint, Self::Gulbrandsen, Self::Conductor];

    /// A short name for the legend and the read-out.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Schlick => "Schlick",
            Self::LimitedTint => "F82-tint",
            Self::Gulbrandsen => "r, g",
            Self::Conductor => "n, k",
        }
    }

    /// One sentence about what is drawn.
    pub(crate) const fn what(self) -> &'static str {
        match self {
            Self::Schlick => "Schlick's curve with the same r",
            Self::LimitedTint => "The tint of the preset in a program that limits r and the tint to 0–1, as most do",
            Self::Gulbrandsen => "Gulbrandsen's model with the same r and the edge tint g that comes nearest",
            Self::Conductor => "The n and k of each channel whose curve comes nearest, by least squares",
        }
    }

    /// The model, and what it cannot express of the preset, as sentences.
    fn of(self, preset: &FresnelModel, space: RgbSpace) -> Result<(FresnelModel, String), String> {
        let to = match self {
            Self::Schlick => ModelKind::Schlick,
            Self::LimitedTint => ModelKind::F82Tint,
            Self::Gulbrandsen => ModelKind::Gulbrandsen,
            Self::Conductor => ModelKind::Conductor,
        };
        let conversion = convert(preset, to, space).map_err(|error| error.to_string())?;
        let losses = conversion.losses.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        Ok(match (self, conversion.model) {
            (Self::LimitedTint, FresnelModel::F82Tint { r, t }) => {
                (FresnelModel::F82Tint { r: r.clipped(), t: t.clipped() }, losses)
            }
            (Self::Conductor, _) => (nearest_conductor(preset, space).map_err(|error| error.to_string())?, losses),
            (_, model) => (model, losses),
        })
    }
}

/// A model of the preset over the angle.
#[derive(Clone, Debug)]
pub(crate) struct Compared {
    pub which: Comparison,
    /// Reflectance at each angle of the curves; empty where the preset has no such model.
    pub curve: Curve,
    /// What it cannot express, as sentences.
    pub losses: String,
}

/// What the curves depend on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Asked {
    /// The preset's model.
    pub model: FresnelModel,
    /// The space of its numbers.
    pub space: RgbSpace,
    /// What is drawn.
    pub which: BTreeSet<Comparison>,
}

/// The newest curves, and the job that follows the preset.
#[derive(Default)]
pub(crate) struct Comparisons {
    following: Follower<Asked, Vec<Compared>>,
    newest: Vec<Compared>,
}

impl Comparisons {
    /// True while curves are computed.
    pub(crate) fn is_busy(&self) -> bool {
        self.following.is_busy()
    }

    /// The newest curves of what is asked for, and sees to it that newer ones follow.
    pub(crate) fn curves(&mut self, ctx: &Context, asked: &Asked) -> Vec<Compared> {
        if let Some((_, newest)) =
            self.following.follow(ctx, "compare models", asked.clone(), |asked, _| all_of(&asked))
        {
            self.newest = newest;
        }
        self.newest.iter().filter(|compared| asked.which.contains(&compared.which)).cloned().collect()
    }
}

impl std::fmt::Debug for Comparisons {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Comparisons").field("is_busy", &self.is_busy()).finish_non_exhaustive()
    }
}

fn all_of(asked: &Asked) -> Vec<Compared> {
    let compared = |&which: &Comparison| match which.of(&asked.model, asked.space) {
        Ok((model, losses)) => {
            let curve = curve_angles_deg().map(|deg| model.reflectance(CosTheta::from_deg(deg))).collect();
            Compared { which, curve, losses }
        }
        Err(sentence) => Compared { which, curve: Curve::new(), losses: sentence },
    };
    asked.which.iter().map(compared).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn compared(r: Rgb, h: Rgb, which: Comparison) -> Compared {
        let model = FresnelModel::Hoffman { r, h };
        all_of(&Asked { model, space: RgbSpace::LinRec709, which: BTreeSet::from([which]) }).remove(0)
    }

    #[test]
    fn every_model_keeps_what_it_says_it_keeps() {
        let (r, h) = (Rgb([0.6, 0.5, 0.4]), Rgb([0.62, 0.55, 0.5]));
        for which in [Comparison::Schlick, Comparison::LimitedTint, Comparison::Gulbrandsen] {
            assert!(compared(r, h, which).curve[0].max_abs_difference(r) < 1e-9, "{which:?}");
        }
        let tint = compared(r, h, Comparison::LimitedTint);
        let own = FresnelModel::Hoffman { r, h };
        let difference = |(deg, rgb): (f64, &Rgb)| own.reflectance(CosTheta::from_deg(deg)).max_abs_difference(*rgb);
        assert!(curve_angles_deg().zip(&tint.curve).map(difference).fold(0.0, f64::max) < 1e-12);
    }

    #[test]
    fn what_a_model_cannot_express_is_told() {
        let white_edge = compared(Rgb([0.5; 3]), Rgb([0.95; 3]), Comparison::LimitedTint);
        assert!(white_edge.losses.contains("outside 0–1"), "{}", white_edge.losses);
        let bright = compared(Rgb([1.04, 0.7, 0.4]), Rgb([1.0, 0.9, 0.7]), Comparison::Gulbrandsen);
        assert!(bright.losses.contains("no n and k"), "{}", bright.losses);
    }
}
