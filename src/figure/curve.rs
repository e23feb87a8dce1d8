//! Reflectance over the angle: a truth and the models of it.

use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fresnel::{CosTheta, FresnelModel};
use crate::metal::Metal;
use crate::number::larger;

/// Curves over 0–90° in three channels, their colours, and how far each is from the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFigure {
    /// What is shown, e.g. the name of a metal.
    pub title: String,
    /// What a reader must know: space, data, convention.
    pub subtitle: String,
    /// The space of every value.
    pub space: RgbSpace,
    /// What the models are compared with.
    pub truth: Option<CurveSeries>,
    /// Models, in the order of their names.
    pub models: Vec<CurveSeries>,
}

/// Samples for each degree: near grazing a degree is too coarse to look smooth.
pub(super) const STEPS_PER_DEG: usize = 4;

/// The angles of every curve: 0°, ¼°, ½°, …, 90°.
pub fn curve_angles() -> impl ExactSizeIterator<Item = CosTheta> {
    (0..90 * STEPS_PER_DEG + 1).map(|step| CosTheta::from_deg(step as f64 / STEPS_PER_DEG as f64))
}

/// Reflectance at each of the [`curve_angles`].
#[derive(Clone, Debug, PartialEq)]
pub struct CurveSeries {
    /// The name people read.
    pub label: String,
    /// One colour for each angle.
    pub values: Vec<Rgb>,
    /// Lower and upper end of the uncertainty at each angle.
    pub band: Option<Vec<(Rgb, Rgb)>>,
}

impl CurveSeries {
    /// The values of any reflectance.
    pub fn new(label: impl Into<String>, reflectance: impl Fn(CosTheta) -> Rgb) -> Self {
        Self { label: label.into(), values: curve_angles().map(reflectance).collect(), band: None }
    }

    /// The same curve with an uncertainty: the ends of its values at each angle.
    pub fn with_band(self, band: impl Fn(CosTheta) -> (Rgb, Rgb)) -> Self {
        Self { band: Some(curve_angles().map(band).collect()), ..self }
    }

    /// CIEDE2000 to another curve at each angle.
    pub fn delta_e(&self, truth: &Self, space: RgbSpace) -> DeltaE {
        let pairs = self.values.iter().zip(&truth.values);
        DeltaE::new(pairs.map(|(model, truth)| delta_e_rgb(*truth, *model, space)).collect())
    }
}

/// The difference of two curves.
#[derive(Clone, Debug, PartialEq)]
pub struct DeltaE {
    /// One difference for each angle.
    pub values: Vec<f64>,
    /// Arithmetic mean over 0°, 1°, …, 90°.
    pub mean: f64,
    /// Largest difference at any of the angles.
    pub max: f64,
}

impl DeltaE {
    fn new(values: Vec<f64>) -> Self {
        let whole_degrees = values.iter().step_by(STEPS_PER_DEG);
        let mean = whole_degrees.clone().sum::<f64>() / whole_degrees.len().max(1) as f64;
        let max = values.iter().copied().fold(0.0, larger);
        Self { values, mean, max }
    }
}

/// The standard figure: a measured metal, if there is one, and models whose parameters are given in `space`.
pub fn curve_figure(truth: Option<&Metal>, models: &[(&str, FresnelModel)], space: RgbSpace) -> CurveFigure {
    let series = |(label, model): &(&str, FresnelModel)| CurveSeries::new(*label, |c| model.reflectance(c));
    let models: Vec<CurveSeries> = models.iter().map(series).collect();
    let names: Vec<&str> = models.iter().map(|model| model.label.as_str()).collect();
    CurveFigure {
        title: truth.map_or_else(|| names.join(", "), |metal| metal.name.clone()),
        subtitle: subtitle(truth, !models.is_empty(), space),
        space,
        truth: truth.map(|metal| CurveSeries::new("Truth", |c| metal.reflectance(c, space))),
        models,
    }
}

/// The space, where n and k come from, and how curves are compared if any are.
fn subtitle(truth: Option<&Metal>, has_models: bool, space: RgbSpace) -> String {
    let source = truth.map(|metal| metal.provenance.citation()).filter(|citation| !citation.is_empty());
    let measured = source.map_or_else(String::new, |citation| format!(" · n, k: {citation}"));
    let convention = if truth.is_some() && has_models {
        " · ΔE2000 relative to the white, unclamped, mean over 0–90°"
    } else {
        ""
    };
    format!("{}{measured}{convention}", space.label())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn a_model_with_the_exact_parameters_meets_the_truth_where_they_are_defined() {
        let (gold, space) = (metal_by_name("gold").unwrap(), RgbSpace::AcesCg);
        let hoffman = FresnelModel::Hoffman { r: gold.r(space), h: gold.h(space) };
        let figure = curve_figure(Some(gold), &[("Hoffman", hoffman)], space);
        let delta_e = figure.models[0].delta_e(figure.truth.as_ref().unwrap(), space);
        assert!(delta_e.values[0] < 1e-9 && delta_e.values[360] < 1e-6 && delta_e.max > delta_e.mean);
        assert!(figure.subtitle.contains("ΔE2000"));
        assert!(figure.subtitle.contains("ACEScg") && figure.subtitle.contains("2012"), "{}", figure.subtitle);
    }

    #[test]
    fn what_is_not_compared_needs_no_convention() {
        let gold = metal_by_name("gold").unwrap();
        let schlick = [("Schlick", FresnelModel::Schlick { r: Rgb::WHITE })];
        let truth_alone = curve_figure(Some(gold), &[], RgbSpace::AcesCg);
        let model_alone = curve_figure(None, &schlick, RgbSpace::AcesCg);
        for subtitle in [truth_alone.subtitle, model_alone.subtitle] {
            assert!(subtitle.starts_with("ACEScg") && !subtitle.contains("ΔE"), "{subtitle}");
        }
    }
}
