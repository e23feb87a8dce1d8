//! What a demonstration is about: a material, and its four descriptions in one space.

use std::ops::ControlFlow;

use thiserror::Error;

use super::parameters::{Pair, Parameters};
use crate::color::{Rgb, RgbSpace};
use crate::fit::{FitError, Method, NotAMaterial, convert, fit_to_truth};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind, t_from_r_h, whole_degrees};
use crate::metal::{Metal, TruthCurve, metals};
use crate::number::short;
use crate::preset::{Origin, Preset};

/// A material to demonstrate something on.
#[derive(Clone, Copy, Debug)]
pub enum Subject<'a> {
    /// A measured metal: the truth is spectral.
    Metal(&'a Metal),
    /// Two colours, as a preset holds them: the truth is their own curve.
    Colours {
        /// The name people read.
        name: &'a str,
        /// The space of r and h.
        space: RgbSpace,
        /// Reflectance facing the surface.
        r: Rgb,
        /// Reflectance at 81.8°.
        h: Rgb,
    },
    /// A colourless dielectric: the truth is the Fresnel equations with this n and k = 0.
    Dielectric {
        /// Refractive index, above 0.
        n: f64,
    },
}

/// Why there is nothing to demonstrate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum StudyError {
    /// The way to n, k and g does not fit.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The colours have no curve.
    #[error(transparent)]
    NotAMaterial(#[from] NotAMaterial),
}

impl<'a> Subject<'a> {
    /// A preset: the measured metal whose r and h it has, else its own two colours; and why its truth is its own.
    pub fn of_preset(preset: &'a Preset) -> (Self, Option<String>) {
        let Preset { name, space, r, h, .. } = preset;
        let own = Self::Colours { name, space: *space, r: *r, h: *h };
        let Origin::Measured { metal: id, .. } = &preset.origin else {
            return (own, Some("Two colours: their own curve is the truth".to_owned()));
        };
        match metals().iter().find(|metal| metal.id == *id) {
            Some(metal) if is_of(preset, metal) => (Self::Metal(metal), None),
            Some(_) => (own, Some(format!("r and h are not those of {id}: their own curve is the truth"))),
            None => (own, Some(format!("{id} is not in the library: r and h are the truth"))),
        }
    }

    /// The name people read.
    pub fn name(&self) -> String {
        match self {
            Self::Metal(metal) => metal.name.clone(),
            Self::Colours { name, .. } => (*name).to_owned(),
            Self::Dielectric { n } => format!("Dielectric, n = {}", short(*n)),
        }
    }
}

/// Four decimals are what presets are often rounded to.
fn is_of(preset: &Preset, metal: &Metal) -> bool {
    let is_close = |own: Rgb, measured: Rgb| own.max_abs_difference(measured) < 1e-4;
    is_close(preset.r, metal.r(preset.space)) && is_close(preset.h, metal.h(preset.space))
}

/// The truth of a material in one space, and the four descriptions of it. Cheap to keep while a slider is dragged.
#[derive(Clone, Debug)]
pub struct Contestants {
    /// The material's name.
    pub name: String,
    /// The space of everything.
    pub space: RgbSpace,
    /// The true reflectance at 0°, 1°, …, 90°.
    pub truth: Vec<Rgb>,
    /// The true reflectance at θ_max.
    pub truth_at_theta_max: Rgb,
    /// One pair for each of [`Parameters::ALL`].
    pub pairs: [Pair; 4],
    /// What could not be expressed, as sentences that name the parameters.
    pub losses: Vec<String>,
}

impl Contestants {
    /// The four descriptions of a subject; `method` derives n, k and g of a measured metal.
    ///
    /// [`Method::ColourMatching`] is the robust choice. [`Method::LeastSquares`] is nearer to the truth, but leads
    /// n and k far away where the truth exceeds 1, as gold's red does in linear sRGB.
    /// For colours r is kept and g fitted by least squares, n and k follow from both.
    pub fn of(subject: &Subject<'_>, space: RgbSpace, method: Method) -> Result<Self, StudyError> {
        match *subject {
            Subject::Metal(metal) => Self::of_metal(metal, space, method),
            Subject::Colours { space: own, r, h, .. } => {
                let model = FresnelModel::Hoffman { r: own.convert(r, space), h: own.convert(h, space) };
                Self::of_model(subject.name(), &model, space)
            }
            Subject::Dielectric { n } => {
                let model = FresnelModel::Conductor { n: Rgb::splat(n), k: Rgb::BLACK };
                Self::of_model(subject.name(), &model, space)
            }
        }
    }

    fn of_metal(metal: &Metal, space: RgbSpace, method: Method) -> Result<Self, StudyError> {
        let truth = TruthCurve::of(metal, space);
        let fitted = |kind| fit_to_truth(metal, &truth, kind, method, &mut || ControlFlow::Continue(()));
        let (g, nk) = (fitted(ModelKind::Gulbrandsen)?, fitted(ModelKind::Conductor)?);
        let said = |what: &str, losses: &[crate::fit::Loss]| {
            losses.iter().map(|loss| format!("{}, {what}: {loss}", metal.name)).collect::<Vec<_>>()
        };
        Ok(Self {
            name: metal.name.clone(),
            space,
            truth: truth.rgb().to_vec(),
            truth_at_theta_max: truth.h,
            pairs: pairs(truth.r(), truth.h, &g.model, &nk.model),
            losses: [said("g", &g.losses), said("n, k", &nk.losses), beyond_n_k(metal, &truth)].concat(),
        })
    }

    fn of_model(name: String, model: &FresnelModel, space: RgbSpace) -> Result<Self, StudyError> {
        let g = convert(model, ModelKind::Gulbrandsen, space)?;
        let nk = match model.kind() {
            ModelKind::Conductor => *model,
            _ => convert(&g.model, ModelKind::Conductor, space)?.model,
        };
        let (r, h) = (model.reflectance(CosTheta::FACING), model.reflectance(CosTheta::MAX));
        Ok(Self {
            space,
            truth: whole_degrees().map(|cos_theta| model.reflectance(cos_theta)).collect(),
            truth_at_theta_max: h,
            pairs: pairs(r, h, &g.model, &nk),
            losses: g.losses.iter().map(|loss| format!("{name}, g: {loss}")).collect(),
            name,
        })
    }

    /// The description by one set of parameters.
    pub fn pair(&self, parameters: Parameters) -> Pair {
        self.pairs[parameters as usize]
    }
}

/// Channels that reflect more than 1: the nearest n and k are far from any that were measured.
fn beyond_n_k(metal: &Metal, truth: &TruthCurve) -> Vec<String> {
    let highest = |channel: usize| truth.channel(channel).map(|(_, f)| f).fold(f64::NEG_INFINITY, f64::max);
    let sentence = |(channel, name): (usize, &str)| {
        let highest = highest(channel);
        let text = format!("the reflectance reaches {highest:.4} in this space, and no n and k reflect more than 1");
        (highest > 1.0 + 1e-9).then(|| format!("{}, n, k: {name}: {text}", metal.name))
    };
    ["red", "green", "blue"].into_iter().enumerate().filter_map(sentence).collect()
}

fn pairs(r: Rgb, h: Rgb, gulbrandsen: &FresnelModel, conductor: &FresnelModel) -> [Pair; 4] {
    let pair_of = |model: &FresnelModel| match *model {
        FresnelModel::Gulbrandsen { r, g } => Pair::new(Parameters::G, r, g),
        FresnelModel::Conductor { n, k } => Pair::new(Parameters::Nk, n, k),
        _ => Pair::new(Parameters::H, r, h),
    };
    let t = Pair::new(Parameters::T, r, r.zip(h, t_from_r_h));
    [Pair::new(Parameters::H, r, h), t, pair_of(gulbrandsen), pair_of(conductor)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn every_subject_has_four_descriptions_in_order() {
        let gold = Subject::Metal(metal_by_name("gold").unwrap());
        let colours = Subject::Colours {
            name: "mine",
            space: RgbSpace::AcesCg,
            r: Rgb([0.9, 0.7, 0.4]),
            h: Rgb([0.93, 0.85, 0.7]),
        };
        for subject in [gold, colours, Subject::Dielectric { n: 1.5 }] {
            for space in RgbSpace::ALL {
                let contestants = Contestants::of(&subject, space, Method::LeastSquares).unwrap();
                assert_eq!(contestants.pairs.map(|pair| pair.parameters), Parameters::ALL);
                assert!(contestants.pairs.iter().all(|pair| pair.outside_domain() == 0), "{subject:?}");
            }
        }
    }

    /// r = ((n − 1)/(n + 1))², g = 0: a dielectric is exact in g and in n, k.
    #[test]
    fn glass_is_exact_in_g_and_n_k() {
        let glass = Contestants::of(&Subject::Dielectric { n: 1.5 }, RgbSpace::AcesCg, Method::LeastSquares).unwrap();
        assert!(glass.pair(Parameters::G).first.max_abs_difference(Rgb::splat(0.04)) < 1e-12);
        for parameters in [Parameters::G, Parameters::Nk] {
            let curve = glass.pair(parameters).curve();
            assert!(curve.iter().zip(&glass.truth).all(|(x, y)| x.max_abs_difference(*y) < 1e-9), "{parameters}");
        }
    }

    #[test]
    fn says_what_gold_loses_in_srgb() {
        let gold = Subject::Metal(metal_by_name("gold").unwrap());
        let contestants = Contestants::of(&gold, RgbSpace::LinRec709, Method::LeastSquares).unwrap();
        assert!(contestants.losses[0].starts_with("Gold, g: red: no n and k have r = 1."), "{:?}", contestants.losses);
        assert!(Contestants::of(&gold, RgbSpace::AcesCg, Method::Exact).is_err());
    }
}
