//! The closed set of models, evaluated on three channels.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::gulbrandsen::{Nk, nk_from_r_g};
use super::{CosTheta, conductor, f82_tint, generalized_schlick, gulbrandsen, hoffman, lazanyi, schlick};
use crate::color::{Rgb, UnknownName};

/// A Fresnel model with its parameters, each a linear triple of the space the caller works in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the fields are the paper's symbols; each model's file defines them")]
pub enum FresnelModel {
    /// One reflectance for every angle: no Fresnel term.
    Constant { r: Rgb },
    /// See [`schlick`].
    Schlick { r: Rgb },
    /// See [`lazanyi`]; α is shared by the channels.
    Lazanyi { r: Rgb, a: Rgb, alpha: f64 },
    /// See [`hoffman`].
    Hoffman { r: Rgb, h: Rgb },
    /// See [`f82_tint`].
    F82Tint { r: Rgb, t: Rgb },
    /// See [`generalized_schlick`].
    GeneralizedSchlick { r0: Rgb, t: Rgb, r90: Rgb, p: f64 },
    /// See [`gulbrandsen`].
    Gulbrandsen { r: Rgb, g: Rgb },
    /// See [`conductor`], applied to each channel as if it were a wavelength.
    Conductor { n: Rgb, k: Rgb },
}

impl FresnelModel {
    /// The reflectance at an angle, unclamped; NaN where the parameters stand for no material.
    pub fn reflectance(&self, cos_theta: CosTheta) -> Rgb {
        let each = |f: &dyn Fn(usize) -> f64| Rgb(std::array::from_fn(f));
        match *self {
            Self::Constant { r } => r,
            Self::Schlick { r } => r.map(|r| schlick(r, cos_theta)),
            Self::Lazanyi { r, a, alpha } => r.zip(a, |r, a| lazanyi(r, a, alpha, cos_theta)),
            Self::Hoffman { r, h } => r.zip(h, |r, h| hoffman(r, h, cos_theta)),
            Self::F82Tint { r, t } => r.zip(t, |r, t| f82_tint(r, t, cos_theta)),
            Self::GeneralizedSchlick { r0, t, r90, p } => {
                each(&|i| generalized_schlick(r0[i], t[i], r90[i], p, cos_theta))
            }
            Self::Gulbrandsen { r, g } => r.zip(g, |r, g| gulbrandsen(r, g, cos_theta)),
            Self::Conductor { n, k } => n.zip(k, |n, k| conductor(n, k, cos_theta)),
        }
    }

    /// Which model this is.
    pub const fn kind(&self) -> ModelKind {
        match self {
            Self::Constant { .. } => ModelKind::Constant,
            Self::Schlick { .. } => ModelKind::Schlick,
            Self::Lazanyi { .. } => ModelKind::Lazanyi,
            Self::Hoffman { .. } => ModelKind::Hoffman,
            Self::F82Tint { .. } => ModelKind::F82Tint,
            Self::GeneralizedSchlick { .. } => ModelKind::GeneralizedSchlick,
            Self::Gulbrandsen { .. } => ModelKind::Gulbrandsen,
            Self::Conductor { .. } => ModelKind::Conductor,
        }
    }

    /// Gulbrandsen's (r, g) as the index triple it stands for; `None` where a channel stands for none.
    pub fn conductor_from_r_g(r: Rgb, g: Rgb) -> Option<Self> {
        let mut channels = [Nk { n: 0.0, k: 0.0 }; 3];
        for (i, channel) in channels.iter_mut().enumerate() {
            *channel = nk_from_r_g(r[i], g[i])?;
        }
        Some(Self::Conductor { n: Rgb(channels.map(|nk| nk.n)), k: Rgb(channels.map(|nk| nk.k)) })
    }
}

/// The name of a [`FresnelModel`], without parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "one for each variant of FresnelModel")]
pub enum ModelKind {
    Constant,
    Schlick,
    Lazanyi,
    Hoffman,
    F82Tint,
    GeneralizedSchlick,
    Gulbrandsen,
    Conductor,
}

impl ModelKind {
    /// Every model, simplest first.
    pub const ALL: [Self; 8] = [
        Self::Constant,
        Self::Schlick,
        Self::Lazanyi,
        Self::Hoffman,
        Self::F82Tint,
        Self::GeneralizedSchlick,
        Self::Gulbrandsen,
        Self::Conductor,
    ];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Schlick => "schlick",
            Self::Lazanyi => "lazanyi",
            Self::Hoffman => "hoffman",
            Self::F82Tint => "f82-tint",
            Self::GeneralizedSchlick => "generalized-schlick",
            Self::Gulbrandsen => "gulbrandsen",
            Self::Conductor => "conductor",
        }
    }

    /// The name people read, with its parameters.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Constant => "Constant (r)",
            Self::Schlick => "Schlick (r)",
            Self::Lazanyi => "Lazányi (r, a, α)",
            Self::Hoffman => "Hoffman (r, h)",
            Self::F82Tint => "F82-tint (r, t)",
            Self::GeneralizedSchlick => "Generalized Schlick (r0, t, r90, p)",
            Self::Gulbrandsen => "Gulbrandsen (r, g)",
            Self::Conductor => "Conductor (n, k)",
        }
    }
}

impl fmt::Display for ModelKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl FromStr for ModelKind {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.id() == text)
            .ok_or_else(|| UnknownName::new("model", text, Self::ALL.map(Self::id)))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};
    use proptest::prelude::*;

    use super::*;
    use crate::color::RgbSpace;

    fn transformed(matrix: Matrix3<f64>, rgb: Rgb) -> Rgb {
        Rgb::from(matrix * Vector3::from(rgb))
    }

    prop_compose! {
        /// A random matrix whose rows sum to one: white stays white.
        fn white_preserving()(m in prop::array::uniform3((-0.5..1.5, -0.5..1.5))) -> Matrix3<f64> {
            let rows = m.map(|(a, b): (f64, f64)| nalgebra::RowVector3::new(a, b, 1.0 - a - b));
            Matrix3::from_rows(&rows)
        }
    }

    proptest! {
        /// Paper section 4: converting r and h converts the appearance.
        #[test]
        fn white_preserving_matrices_commute_with_r_h(
            m in white_preserving(),
            r in prop::array::uniform3(0.0..1.0), h in prop::array::uniform3(0.0..1.0), c in 0.0..1.0,
        ) {
            let (r, h, c) = (Rgb(r), Rgb(h), CosTheta::new(c));
            let appearance = transformed(m, FresnelModel::Hoffman { r, h }.reflectance(c));
            let parameters = FresnelModel::Hoffman { r: transformed(m, r), h: transformed(m, h) };
            prop_assert!(parameters.reflectance(c).max_abs_difference(appearance) < 1e-12);
        }

        #[test]
        fn blending_parameters_of_r_h_blends_reflectance(
            r in prop::array::uniform2(0.0..1.0_f64), h in prop::array::uniform2(0.0..1.0_f64), w in 0.0..1.0_f64, c in 0.0..1.0_f64,
        ) {
            let c = CosTheta::new(c);
            let blended: f64 = hoffman(r[0] * (1.0 - w) + r[1] * w, h[0] * (1.0 - w) + h[1] * w, c);
            let reflectance: f64 = hoffman(r[0], h[0], c) * (1.0 - w) + hoffman(r[1], h[1], c) * w;
            prop_assert!((blended - reflectance).abs() < 1e-12);
        }
    }

    /// Paper section 4, the other half: converting (r, g) as colours changes the appearance.
    #[test]
    fn conversion_does_not_commute_with_r_g() {
        // Both r lie in 0–1 in both spaces, so that both are a material.
        let (r, g) = (Rgb([0.8, 0.65, 0.4]), Rgb([0.9, 0.6, 0.3]));
        let m = RgbSpace::AcesCg.matrix_to(RgbSpace::LinRec709);
        let appearance = transformed(m, FresnelModel::Gulbrandsen { r, g }.reflectance(CosTheta::MAX));
        let parameters = FresnelModel::Gulbrandsen { r: transformed(m, r), g: transformed(m, g).clipped() };
        assert!(parameters.reflectance(CosTheta::MAX).max_abs_difference(appearance) > 0.01);
    }

    #[test]
    fn identifiers_parse_back_and_match_the_files() {
        for kind in ModelKind::ALL {
            assert_eq!(kind.id().parse(), Ok(kind));
            assert_eq!(serde_json::to_string(&kind).unwrap(), format!("\"{kind}\""));
        }
    }
}
