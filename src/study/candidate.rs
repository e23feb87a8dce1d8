//! What is compared with the truth: a model with a way to its parameters, or a few wavelengths.

use std::ops::ControlFlow;
use std::{fmt, str::FromStr};

use crate::color::{RgbSpace, UnknownName};
use crate::fit::{CurveError, FitError, Loss, Method, Triple, delta_e_over_degrees, fit_to_truth};
use crate::fresnel::{ModelKind, whole_degrees};
use crate::metal::{Metal, SpectralModel, TruthCurve};
use crate::spectrum::{FewWavelengths, Quadrature};

/// A contestant of the accuracy study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Candidate {
    /// An RGB model with parameters by a method.
    Model(ModelKind, Method),
    /// The spectral model at this many wavelengths.
    Spectral(usize, Quadrature),
}

/// The numbers of wavelengths the study shows.
const WAVELENGTHS: [usize; 5] = [3, 8, 16, 20, 31];

impl Candidate {
    /// Schlick with the exact r: what others are held against.
    pub const SCHLICK: Self = Self::Model(ModelKind::Schlick, Method::Exact);
    /// Lazányi with a and α by least squares.
    pub const LAZANYI: Self = Self::Model(ModelKind::Lazanyi, Method::LeastSquares);
    /// Hoffman with the exact r and h.
    pub const HOFFMAN: Self = Self::Model(ModelKind::Hoffman, Method::Exact);

    /// What people compare: each model by its usual methods, few enough for a figure.
    pub const USUAL: [Self; 10] = [
        Self::HOFFMAN,
        Self::SCHLICK,
        Self::LAZANYI,
        Self::Model(ModelKind::GeneralizedSchlick, Method::LeastSquares),
        Self::Model(ModelKind::Gulbrandsen, Method::Points(Triple::ROUND)),
        Self::Model(ModelKind::Gulbrandsen, Method::DefaultTint),
        Self::Model(ModelKind::Conductor, Method::Points(Triple::ROUND)),
        Self::Model(ModelKind::Conductor, Method::ColourMatching),
        Self::Model(ModelKind::Conductor, Method::BlackBox),
        Self::Spectral(8, Quadrature::Bins),
    ];

    /// Every model with every method, and the spectral model.
    pub fn all() -> Vec<Self> {
        let models = ModelKind::ALL.into_iter().flat_map(|kind| Method::of(kind).map(move |m| Self::Model(kind, m)));
        let spectral = |count| Quadrature::ALL.map(|quadrature| Self::Spectral(count, quadrature));
        models.chain(WAVELENGTHS.into_iter().flat_map(spectral)).collect()
    }

    /// All but the numerical searches for the smallest ΔE, which take seconds for the whole library.
    pub fn without_black_box() -> Vec<Self> {
        Self::all().into_iter().filter(|candidate| candidate.method() != Some(Method::BlackBox)).collect()
    }

    /// What reads its parameters off the metal, without any search, and Lazányi with its fitted a and α: those two
    /// have no other definition (Lazányi & Szirmay-Kalos 2005 fit them), and the fit is quick.
    pub fn without_search() -> Vec<Self> {
        let searches = [Some(Method::BlackBox), Some(Method::LeastSquares), Some(Method::MinMax)];
        let is_quick = |candidate: &Self| *candidate == Self::LAZANYI || !searches.contains(&candidate.method());
        Self::all().into_iter().filter(is_quick).collect()
    }

    /// How the parameters are derived; the spectral model has none.
    pub const fn method(self) -> Option<Method> {
        match self {
            Self::Model(_, method) => Some(method),
            Self::Spectral(..) => None,
        }
    }

    /// The stable name of the model: `hoffman`, or `spectral-20`.
    pub fn model_id(self) -> String {
        match self {
            Self::Model(kind, _) => kind.id().to_owned(),
            Self::Spectral(count, _) => format!("spectral-{count}"),
        }
    }

    /// The stable name of the method: `exact`, or how wavelengths are weighted.
    pub fn method_id(self) -> String {
        match self {
            Self::Model(_, method) => method.id(),
            Self::Spectral(_, quadrature) => quadrature.id().to_owned(),
        }
    }

    /// The name people read.
    pub fn label(self) -> String {
        match self {
            Self::Model(kind, method) => format!("{}, {}", kind.label(), method.label()),
            Self::Spectral(count, Quadrature::Bins) => format!("Spectral, {count} wavelengths, equal bins"),
            Self::Spectral(count, Quadrature::Spline) => format!("Spectral, {count} wavelengths, spline weights"),
        }
    }

    /// The error against a metal's truth, and what the parameters lost.
    pub(super) fn measure(
        self,
        metal: &Metal,
        truth: &TruthCurve,
        weights: &SpectralWeights,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<(CurveError, Vec<Loss>), FitError> {
        match self {
            Self::Model(kind, method) => {
                fit_to_truth(metal, truth, kind, method, keep_going).map(|fit| (fit.error, fit.losses))
            }
            Self::Spectral(..) => {
                let model = SpectralModel::with_wavelengths(metal, weights.of(self, truth.space));
                let curve = whole_degrees().map(|cos_theta| model.reflectance(cos_theta));
                Ok((CurveError::over_degrees(delta_e_over_degrees(curve, truth)), Vec::new()))
            }
        }
    }
}

/// The weights of the spectral candidates, computed once for all metals.
pub(super) struct SpectralWeights(Vec<(Candidate, RgbSpace, FewWavelengths)>);

impl SpectralWeights {
    pub(super) fn new(candidates: &[Candidate], spaces: &[RgbSpace]) -> Self {
        let pairs = candidates.iter().flat_map(|candidate| spaces.iter().map(move |space| (*candidate, *space)));
        let weights = pairs.filter_map(|(candidate, space)| match candidate {
            Candidate::Spectral(n, quadrature) => Some((candidate, space, FewWavelengths::new(n, quadrature, space))),
            Candidate::Model(..) => None,
        });
        Self(weights.collect())
    }

    fn of(&self, candidate: Candidate, space: RgbSpace) -> FewWavelengths {
        let found = self.0.iter().find(|(c, s, _)| (*c, *s) == (candidate, space));
        found.map(|(_, _, weights)| weights.clone()).expect("made from the same candidates and spaces")
    }
}

impl fmt::Display for Candidate {
    /// `hoffman:exact`, `spectral-20:spline`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.model_id(), self.method_id())
    }
}

/// `model:method` names no candidate.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CandidateError {
    /// The text has not the form.
    #[error("“{0}” is not of the form model:method, such as hoffman:exact or spectral-20:spline")]
    Form(String),
    /// The number of wavelengths is no number of at least 2.
    #[error("“{0}” needs a number of 2–401 wavelengths, such as spectral-20:spline")]
    Wavelengths(String),
    /// A part names nothing.
    #[error(transparent)]
    Name(#[from] UnknownName),
    /// The parts do not go together.
    #[error(transparent)]
    Fit(#[from] FitError),
}

impl FromStr for Candidate {
    type Err = CandidateError;

    fn from_str(text: &str) -> Result<Self, CandidateError> {
        let (model, method) = text.split_once(':').ok_or_else(|| CandidateError::Form(text.to_owned()))?;
        if let Some(count) = model.strip_prefix("spectral-") {
            let valid = count.parse::<usize>().ok().filter(|count| (2..=401).contains(count));
            let count = valid.ok_or_else(|| CandidateError::Wavelengths(text.to_owned()))?;
            let named = Quadrature::ALL.into_iter().find(|quadrature| quadrature.id() == method);
            let unknown = || UnknownName::new("weighting", method, Quadrature::ALL.map(Quadrature::id));
            return Ok(Self::Spectral(count, named.ok_or_else(unknown)?));
        }
        let (kind, method) = (model.parse::<ModelKind>()?, method.parse::<Method>()?);
        if !method.applies_to(kind) {
            return Err(FitError::NotForThisModel { kind, method }.into());
        }
        Ok(Self::Model(kind, method))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_parse_back() {
        for candidate in Candidate::all() {
            assert_eq!(candidate.to_string().parse(), Ok(candidate));
        }
        for text in ["", "hoffman", "hoffman:colour-matching", "spectral-1:spline", "spectral-x:bins", "spectral-8:x"] {
            assert!(text.parse::<Candidate>().is_err(), "{text}");
        }
    }

    #[test]
    fn the_shorter_lists_are_parts_of_the_whole() {
        let (all, quick, read_off) = (Candidate::all(), Candidate::without_black_box(), Candidate::without_search());
        assert!(quick.iter().all(|c| all.contains(c)) && read_off.iter().all(|c| quick.contains(c)));
        assert!(read_off.len() < quick.len() && quick.len() < all.len());
        for kind in ModelKind::ALL {
            assert!(read_off.iter().any(|c| matches!(c, Candidate::Model(k, _) if *k == kind)), "{kind}");
        }
        assert!(read_off.contains(&Candidate::SCHLICK) && read_off.contains(&Candidate::HOFFMAN));
    }
}
