//! The cases of one curve or conversion of a few parameters: models, exact indices, conversions.

use super::exact::{self, Exact};
use super::grid::{Axis, Case, Evaluations, Exactly, Where, evaluations, raw};
use super::printed::GeneralizedAsPrinted;
use crate::color::Rgb;
use crate::kernel::textbook::{
    ComplexConductor, DielectricAsPrinted, F82AsPrinted, GulbrandsenAsPrinted, HoffmanAsPrinted, IndexAsPrinted,
    PopularConductor, SchlickByPower, TintAsPrinted,
};
use crate::kernel::{
    Basis, Conductor, ConductorAndAbsorption, Dielectric, EdgeOfTint, Factored, Form, GeneralizedSchlick, IndexOfTint,
    Lazanyi, Material, Schlick, TintOfEdge, TintOfIndex,
};

/// Our vectors, their text one by one, and the same in 64 bits.
pub(super) const OURS: &str = "ours";
/// As printed.
pub(super) const TEXTBOOK: &str = "textbook";
/// pbrt's arithmetic.
const COMPLEX: &str = "textbook, complex";

const UNIT: Where = |point| point.iter().all(|value| Axis::is_unit(*value));
/// All but the exponent, which is before the cosine.
const GENERALIZED: Where = |point| UNIT(&point[..3]) && Axis::is_unit(point[4]);
/// n from .001 to 20, k from 0 to 20, and a cosine.
const METAL: Where = |point| {
    (0.001..=20.0).contains(&point[0])
        && (0.0..=20.0).contains(&point[1])
        && point[2..].iter().all(|c| Axis::is_unit(*c))
};
/// As the unit box, but r = 1 has no n and k.
const TINTED: Where = |point| UNIT(point) && point[0] < 1.0;
/// n above 1, to 20.
const TRANSPARENT: Where = |point| point[0] > 1.0 && point[0] <= 20.0 && Axis::is_unit(point[1]);

const R_C: [Axis; 2] = [Axis::Reflectance("r"), Axis::Cosine];
const R_H_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("h"), Axis::Cosine];
const R_T_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("t"), Axis::Cosine];
const R_A_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("a"), Axis::Cosine];
const R0_T_R90_P_C: [Axis; 5] = [
    Axis::Of("r0", &[-0.1, 0.0, 0.5, 0.9999, 1.06]),
    Axis::Of("t", &[0.0, 0.5, 1.0, 1.2]),
    Axis::Of("r90", &[0.0, 0.5, 1.0, 1.5]),
    Axis::Of("p", &[0.5, 1.0, 4.7, 5.0, 12.0]),
    Axis::Cosine,
];
const R_G_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("g"), Axis::Cosine];
const N_C: [Axis; 2] = [Axis::Index("n"), Axis::Cosine];
const N_K_C: [Axis; 3] = [Axis::Index("n"), Axis::Index("k"), Axis::Cosine];
const R_H: [Axis; 2] = [Axis::Reflectance("r"), Axis::Reflectance("h")];
const R_T: [Axis; 2] = [Axis::Reflectance("r"), Axis::Reflectance("t")];
const R_G: [Axis; 2] = [Axis::Reflectance("r"), Axis::Reflectance("g")];
const N_K: [Axis; 2] = [Axis::Index("n"), Axis::Index("k")];

/// The cosine as the exact value takes it.
pub(super) fn cosine(point: &[f64]) -> f64 {
    point.last().map_or(f64::NAN, |c| c.clamp(0.0, 1.0))
}

/// α of the Lazányi case: not whole, so that its power is one.
const ALPHA: f64 = 6.3;

/// Every model but those of n and k.
pub(super) fn models() -> Vec<Case> {
    let schlick: (Where, Exactly) = (UNIT, |point| Some(exact::schlick(point[0], cosine(point))));
    let hoffman: (Where, Exactly) = (UNIT, |point| Some(exact::hoffman(point[0], point[1], cosine(point))));
    let f82: (Where, Exactly) = (UNIT, |point| Some(exact::f82_tint(point[0], point[1], cosine(point))));
    let lazanyi: (Where, Exactly) = (UNIT, |point| Some(exact::lazanyi(point[0], point[1], ALPHA, cosine(point))));
    let generalized: (Where, Exactly) = (GENERALIZED, |point| {
        Some(exact::generalized_schlick([point[0], point[1], point[2], point[3]], cosine(point)))
    });
    vec![
        Case::new("schlick", &R_C, schlick)
            .way(OURS, |p, c| evaluations(&Schlick::material(p[0]), c, 0))
            .way(TEXTBOOK, |p, c| raw(SchlickByPower, [p[0]], c)),
        Case::new("hoffman", &R_H_C, hoffman)
            .way(OURS, |p, c| evaluations(&Factored::hoffman(p[0], p[1]), c, 0))
            .way(TEXTBOOK, |p, c| raw(HoffmanAsPrinted, [p[0], p[1]], c)),
        Case::new("hoffman-basis", &R_H_C, hoffman).way(OURS, |p, c| evaluations(&Basis::material(p[0], p[1]), c, 0)),
        Case::new("f82-tint", &R_T_C, f82)
            .way(OURS, |p, c| evaluations(&Factored::f82_tint(p[0], p[1]), c, 0))
            .way(TEXTBOOK, |p, c| raw(F82AsPrinted, [p[0], p[1]], c)),
        Case::new("lazanyi", &R_A_C, lazanyi)
            .way(OURS, |p, c| evaluations(&Lazanyi::material(p[0], p[1], ALPHA), c, 0)),
        Case::new("generalized-schlick", &R0_T_R90_P_C, generalized)
            .way(OURS, |p, c| evaluations(&GeneralizedSchlick::material(p[0], p[1], p[2], p[3][0]), c, 0))
            .way(TEXTBOOK, |p, c| raw(GeneralizedAsPrinted { exponent: p[3][0] }, [p[0], p[1], p[2]], c)),
    ]
}

/// n and k as they are held, in 512 bits.
fn index(point: &[f64]) -> (Exact, Exact) {
    (Exact::of(point[0].clamp(0.0, 1e9)), Exact::of(point[1].clamp(0.0, 1e9)))
}

fn exact_of_index(point: &[f64]) -> (Exact, Exact) {
    let (n, k) = index(point);
    exact::conductor(&n, &k, cosine(point))
}

/// The models of n and k, and of r and g, which stand for them.
pub(super) fn exact_indices() -> Vec<Case> {
    let conductor: (Where, Exactly) = (METAL, |point| Some(exact_of_index(point).0));
    let absorption: (Where, Exactly) = (METAL, |point| Some(exact_of_index(point).1));
    let dielectric: (Where, Exactly) = (TRANSPARENT, |point| {
        Some(exact::conductor(&Exact::of(point[0].clamp(0.0, 1e9)), &Exact::of(0.0), cosine(point)).0)
    });
    let gulbrandsen: (Where, Exactly) = (TINTED, |point| {
        let is_material = UNIT(&point[..2]) && point[0] < 1.0;
        let (n, k) = is_material.then(|| exact::index_of_tint(point[0], point[1]))?;
        Some(exact::conductor(&n, &k, cosine(point)).0)
    });
    let both = |p: &[Rgb]| ConductorAndAbsorption::material(p[0], p[1]);
    vec![
        Case::new("conductor", &N_K_C, conductor)
            .way(OURS, |p, c| evaluations(&Conductor::material(p[0], p[1]), c, 0))
            .way(TEXTBOOK, |p, c| raw(PopularConductor, [p[0], p[1]], c))
            .way(COMPLEX, |p, c| raw(ComplexConductor, [p[0], p[1]], c)),
        Case::new("absorption", &N_K_C, absorption)
            .way(OURS, move |p, c| evaluations(&both(p), c, 1))
            .way(TEXTBOOK, |p, c| one_minus(raw(PopularConductor, [p[0], p[1]], c))),
        Case::new("dielectric", &N_C, dielectric)
            .way(OURS, |p, c| evaluations(&Dielectric::material(p[0]), c, 0))
            .way(TEXTBOOK, |p, c| raw(DielectricAsPrinted, [p[0]], c)),
        Case::new("gulbrandsen", &R_G_C, gulbrandsen)
            .way(OURS, |p, c| evaluations(&Conductor::gulbrandsen(p[0], p[1]), c, 0))
            .way(TEXTBOOK, |p, c| raw(GulbrandsenAsPrinted, [p[0], p[1]], c)),
    ]
}

/// Between r and h, r and t, r and g, n and k.
pub(super) fn conversions() -> Vec<Case> {
    let t: (Where, Exactly) = (UNIT, |point| Some(exact::tint_of_edge(point[0], point[1])));
    let h: (Where, Exactly) = (UNIT, |point| Some(exact::edge_of_tint(point[0], point[1])));
    let n: (Where, Exactly) = (TINTED, |point| TINTED(point).then(|| exact::index_of_tint(point[0], point[1]).0));
    let k: (Where, Exactly) = (TINTED, |point| TINTED(point).then(|| exact::index_of_tint(point[0], point[1]).1));
    let r: (Where, Exactly) = (METAL, |point| Some(exact::tint_of_index(point[0].min(1e9), point[1].min(1e9)).0));
    let g: (Where, Exactly) = (METAL, |point| Some(exact::tint_of_index(point[0].min(1e9), point[1].min(1e9)).1));
    let of_tint = |quantity, axes, exact, result| {
        Case::new(quantity, axes, exact)
            .way(OURS, move |p, _| pair(IndexOfTint, p, result))
            .way(TEXTBOOK, move |p, _| pair(IndexAsPrinted, p, result))
    };
    let of_index = |quantity, axes, exact, result| {
        Case::new(quantity, axes, exact)
            .way(OURS, move |p, _| pair(TintOfIndex, p, result))
            .way(TEXTBOOK, move |p, _| pair(TintAsPrinted, p, result))
    };
    vec![
        Case::new("t-of-r-h", &R_H, t).way(OURS, |p, _| raw(TintOfEdge, [p[0], p[1]], 1.0)),
        Case::new("h-of-r-t", &R_T, h).way(OURS, |p, _| raw(EdgeOfTint, [p[0], p[1]], 1.0)),
        of_tint("n-of-r-g", &R_G, n, 0),
        of_tint("k-of-r-g", &R_G, k, 1),
        of_index("r-of-n-k", &N_K, r, 0),
        of_index("g-of-n-k", &N_K, g, 1),
    ]
}

/// One of two results of a conversion.
fn pair<F: Form<2, 2>>(form: F, p: &[Rgb], result: usize) -> Evaluations {
    evaluations(&Material::of_parameters(form, [p[0], p[1]]), 1.0, result)
}

fn one_minus(f: Evaluations) -> Evaluations {
    Evaluations { vectors: f.vectors.map(|f| 1.0 - f), scalar: 1.0 - f.scalar, double: 1.0 - f.double }
}
