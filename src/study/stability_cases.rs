//! What the study of stability computes, and over which grids.

use half::f16;

use super::exact::{self, Exact};
use super::stability::Fineness;
use crate::color::Rgb;
use crate::kernel::textbook::{
    ComplexConductor, DielectricAsPrinted, F82AsPrinted, GulbrandsenAsPrinted, HoffmanAsPrinted, IndexAsPrinted,
    PopularConductor, SchlickByPower, TintAsPrinted,
};
use crate::kernel::{
    Basis, Conductor, ConductorAndAbsorption, Dielectric, EdgeOfTint, Factored, Form, IndexOfTint, Lazanyi, Level,
    Material, Schlick, TintOfEdge, TintOfIndex,
};

/// A quantity, one way to compute it, and where.
pub(super) struct Case {
    pub(super) quantity: &'static str,
    pub(super) kind: &'static str,
    /// The parameters, and c last where there is an angle.
    axes: Vec<Axis>,
    pub(super) is_inside: fn(&[f64]) -> bool,
    /// `None` where there is none, as for r ≥ 1 of Gulbrandsen's.
    pub(super) exact: fn(&[f64]) -> Option<Exact>,
    pub(super) evaluate: Evaluate,
}

/// The quantity at a point of the grid.
type Evaluate = Box<dyn Fn(&[f64]) -> Evaluations + Send + Sync>;

/// One value in three arithmetics.
pub(super) struct Evaluations {
    pub(super) vectors: f32,
    pub(super) scalar: f32,
    pub(super) double: f64,
}

/// A parameter or the cosine.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Axis {
    /// A reflectance or a tint: around 0 and 1, and beyond, as gold's r in sRGB.
    Reflectance(&'static str),
    /// n or k: from 0 to what no material has.
    Index(&'static str),
    /// The cosine: around 0 and 1, and beyond, as dot products are.
    Cosine,
}

impl Axis {
    fn name(self) -> &'static str {
        match self {
            Self::Reflectance(name) | Self::Index(name) => name,
            Self::Cosine => "c",
        }
    }

    /// Numbers of 32 bits, so that every arithmetic is given the same.
    fn values(self, fineness: Fineness) -> Vec<f64> {
        let edges: &[f64] = match self {
            Self::Reflectance(_) => {
                &[-0.1, 0.0, 1e-7, 1e-3, 0.04, 0.3, 0.5, 0.8, 0.95, 0.9999, BELOW_1, 1.0, ABOVE_1, 1.06, 1.5]
            }
            Self::Index(_) => {
                &[0.0, 1e-8, 1e-3, 0.05, 0.2, 0.9, BELOW_1, 1.0, ABOVE_1, 1.5, 3.4, 7.0, 20.0, 1e3, 1e5, 1e12]
            }
            Self::Cosine => {
                &[-1.0, -1e-7, 0.0, 1e-7, 1e-4, 0.01, 1.0 / 7.0, 0.4, 0.7, 0.99, BELOW_1, 1.0, ABOVE_1, 1.001]
            }
        };
        let between: Vec<f64> = match (fineness, self) {
            (Fineness::Default, _) => Vec::new(),
            (Fineness::Fine, Self::Reflectance(_)) => (1..20).map(|i| f64::from(i) / 20.0).collect(),
            (Fineness::Fine, Self::Index(_)) => (-24..=30).map(|i| 10_f64.powf(f64::from(i) / 6.0)).collect(),
            (Fineness::Fine, Self::Cosine) => (1..40).map(|i| (f64::from(i) * 2.25).to_radians().cos()).collect(),
        };
        edges.iter().copied().chain(between).map(|value| f64::from(value as f32)).collect()
    }

    fn is_unit(value: f64) -> bool {
        (0.0..=1.0).contains(&value)
    }
}

/// The neighbours of 1 in 32 bits.
const BELOW_1: f64 = 1.0 - 1.0 / 16_777_216.0;
const ABOVE_1: f64 = 1.0 + 1.0 / 8_388_608.0;

impl Case {
    /// Every combination of the axes.
    pub(super) fn grid(&self, fineness: Fineness) -> Vec<Vec<f64>> {
        self.axes.iter().fold(vec![Vec::new()], |points, axis| {
            let values = axis.values(fineness);
            let extended = |point: &Vec<f64>| {
                let with = |value: &f64| point.iter().copied().chain([*value]).collect::<Vec<f64>>();
                values.iter().map(with).collect::<Vec<_>>()
            };
            points.iter().flat_map(extended).collect()
        })
    }

    /// Parameters as half floats hold them; one beyond their largest, 65504, becomes that. The cosine is no parameter.
    pub(super) fn halved(&self, point: &[f64]) -> Vec<f64> {
        let halved = |(value, axis): (&f64, &Axis)| match axis {
            Axis::Cosine => *value,
            _ => f16::from_f64(value.clamp(-65504.0, 65504.0)).to_f64(),
        };
        point.iter().zip(&self.axes).map(halved).collect()
    }

    /// `r = 0.3, h = 1, c = 0`.
    pub(super) fn told(&self, point: &[f64]) -> String {
        let one = |(axis, value): (&Axis, &f64)| format!("{} = {}", axis.name(), *value as f32);
        self.axes.iter().zip(point).map(one).collect::<Vec<_>>().join(", ")
    }
}

/// One channel of a material at the cosine, the result of this place.
fn evaluations<F: Form<P, N>, const P: usize, const N: usize>(
    material: &Material<F, P, N>,
    c: f64,
    result: usize,
) -> Evaluations {
    let mut out = [[[f32::NAN; 1]; 3]; N];
    let planes = out.each_mut().map(|planes| planes.each_mut().map(|plane| &mut plane[..]));
    material.over(Level::new(), &[c as f32], planes);
    Evaluations {
        vectors: out[result][0][0],
        scalar: material.at(c as f32)[result][0],
        double: material.at(c)[result][0],
    }
}

type Inside = fn(&[f64]) -> bool;
type Exactly = fn(&[f64]) -> Option<Exact>;

const UNIT: Inside = |point| point.iter().all(|value| Axis::is_unit(*value));
/// n from .001 to 20, k from 0 to 20, and a cosine.
const METAL: Inside = |point| {
    (0.001..=20.0).contains(&point[0])
        && (0.0..=20.0).contains(&point[1])
        && point[2..].iter().all(|c| Axis::is_unit(*c))
};
/// As the unit box, but r = 1 has no n and k.
const TINTED: Inside = |point| UNIT(point) && point[0] < 1.0;

const R_C: [Axis; 2] = [Axis::Reflectance("r"), Axis::Cosine];
const R_H_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("h"), Axis::Cosine];
const R_T_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("t"), Axis::Cosine];
const R_A_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("a"), Axis::Cosine];
const R_G_C: [Axis; 3] = [Axis::Reflectance("r"), Axis::Reflectance("g"), Axis::Cosine];
const N_C: [Axis; 2] = [Axis::Index("n"), Axis::Cosine];
const N_K_C: [Axis; 3] = [Axis::Index("n"), Axis::Index("k"), Axis::Cosine];
const R_H: [Axis; 2] = [Axis::Reflectance("r"), Axis::Reflectance("h")];
const R_T: [Axis; 2] = [Axis::Reflectance("r"), Axis::Reflectance("t")];
const R_G: [Axis; 2] = [Axis::Reflectance("r"), Axis::Reflectance("g")];
const N_K: [Axis; 2] = [Axis::Index("n"), Axis::Index("k")];

/// The cosine as the exact value takes it.
fn cosine(point: &[f64]) -> f64 {
    point.last().map_or(f64::NAN, |c| c.clamp(0.0, 1.0))
}

/// α of the Lazányi case: not whole, so that its power is one.
const ALPHA: f64 = 6.3;

/// Every model and conversion, ours before the textbook's.
pub(super) fn cases() -> Vec<Case> {
    let mut all = models();
    all.extend(exact_indices());
    all.extend(conversions());
    all
}

/// A case whose result is a function of the parameters, the same in each channel, and the cosine.
fn case(
    kind: &'static str,
    quantity: &'static str,
    axes: &[Axis],
    (is_inside, exact): (Inside, Exactly),
    evaluate: impl Fn(&[Rgb], f64) -> Evaluations + Send + Sync + 'static,
) -> Case {
    let evaluate = move |point: &[f64]| {
        let rgb: Vec<Rgb> = point.iter().map(|value| Rgb::splat(*value)).collect();
        evaluate(&rgb, point.last().copied().unwrap_or(f64::NAN))
    };
    Case { quantity, kind, axes: axes.to_vec(), is_inside, exact, evaluate: Box::new(evaluate) }
}

const OURS: &str = "ours";
const TEXTBOOK: &str = "textbook";

fn models() -> Vec<Case> {
    let schlick: (Inside, Exactly) = (UNIT, |point| Some(exact::schlick(point[0], cosine(point))));
    let hoffman: (Inside, Exactly) = (UNIT, |point| Some(exact::hoffman(point[0], point[1], cosine(point))));
    let f82: (Inside, Exactly) = (UNIT, |point| Some(exact::f82_tint(point[0], point[1], cosine(point))));
    let lazanyi: (Inside, Exactly) = (UNIT, |point| Some(exact::lazanyi(point[0], point[1], ALPHA, cosine(point))));
    vec![
        case(OURS, "schlick", &R_C, schlick, |p, c| evaluations(&Schlick::material(p[0]), c, 0)),
        case(TEXTBOOK, "schlick", &R_C, schlick, |p, c| raw(SchlickByPower, [p[0]], c)),
        case(OURS, "hoffman", &R_H_C, hoffman, |p, c| evaluations(&Factored::hoffman(p[0], p[1]), c, 0)),
        case(OURS, "hoffman-basis", &R_H_C, hoffman, |p, c| evaluations(&Basis::material(p[0], p[1]), c, 0)),
        case(TEXTBOOK, "hoffman", &R_H_C, hoffman, |p, c| raw(HoffmanAsPrinted, [p[0], p[1]], c)),
        case(OURS, "f82-tint", &R_T_C, f82, |p, c| evaluations(&Factored::f82_tint(p[0], p[1]), c, 0)),
        case(TEXTBOOK, "f82-tint", &R_T_C, f82, |p, c| raw(F82AsPrinted, [p[0], p[1]], c)),
        case(OURS, "lazanyi", &R_A_C, lazanyi, |p, c| evaluations(&Lazanyi::material(p[0], p[1], ALPHA), c, 0)),
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

fn exact_indices() -> Vec<Case> {
    let conductor: (Inside, Exactly) = (METAL, |point| Some(exact_of_index(point).0));
    let absorption: (Inside, Exactly) = (METAL, |point| Some(exact_of_index(point).1));
    let dielectric: (Inside, Exactly) = (
        |point| point[0] > 1.0 && point[0] <= 20.0 && Axis::is_unit(point[1]),
        |point| Some(exact::conductor(&Exact::of(point[0].clamp(0.0, 1e9)), &Exact::of(0.0), cosine(point)).0),
    );
    let gulbrandsen: (Inside, Exactly) = (TINTED, |point| {
        let is_material = UNIT(&point[..2]) && point[0] < 1.0;
        let (n, k) = is_material.then(|| exact::index_of_tint(point[0], point[1]))?;
        Some(exact::conductor(&n, &k, cosine(point)).0)
    });
    let both = |p: &[Rgb]| ConductorAndAbsorption::material(p[0], p[1]);
    vec![
        case(OURS, "conductor", &N_K_C, conductor, |p, c| evaluations(&Conductor::material(p[0], p[1]), c, 0)),
        case(TEXTBOOK, "conductor", &N_K_C, conductor, |p, c| raw(PopularConductor, [p[0], p[1]], c)),
        case("textbook, complex", "conductor", &N_K_C, conductor, |p, c| raw(ComplexConductor, [p[0], p[1]], c)),
        case(OURS, "absorption", &N_K_C, absorption, move |p, c| evaluations(&both(p), c, 1)),
        case(TEXTBOOK, "absorption", &N_K_C, absorption, |p, c| one_minus(raw(PopularConductor, [p[0], p[1]], c))),
        case(OURS, "dielectric", &N_C, dielectric, |p, c| evaluations(&Dielectric::material(p[0]), c, 0)),
        case(TEXTBOOK, "dielectric", &N_C, dielectric, |p, c| raw(DielectricAsPrinted, [p[0]], c)),
        case(OURS, "gulbrandsen", &R_G_C, gulbrandsen, |p, c| evaluations(&Conductor::gulbrandsen(p[0], p[1]), c, 0)),
        case(TEXTBOOK, "gulbrandsen", &R_G_C, gulbrandsen, |p, c| raw(GulbrandsenAsPrinted, [p[0], p[1]], c)),
    ]
}

fn conversions() -> Vec<Case> {
    let t: (Inside, Exactly) = (UNIT, |point| Some(exact::tint_of_edge(point[0], point[1])));
    let h: (Inside, Exactly) = (UNIT, |point| Some(exact::edge_of_tint(point[0], point[1])));
    let n: (Inside, Exactly) = (TINTED, |point| TINTED(point).then(|| exact::index_of_tint(point[0], point[1]).0));
    let k: (Inside, Exactly) = (TINTED, |point| TINTED(point).then(|| exact::index_of_tint(point[0], point[1]).1));
    let r: (Inside, Exactly) = (METAL, |point| Some(exact::tint_of_index(point[0].min(1e9), point[1].min(1e9)).0));
    let g: (Inside, Exactly) = (METAL, |point| Some(exact::tint_of_index(point[0].min(1e9), point[1].min(1e9)).1));
    vec![
        case(OURS, "t-of-r-h", &R_H, t, |p, _| raw(TintOfEdge, [p[0], p[1]], 1.0)),
        case(OURS, "h-of-r-t", &R_T, h, |p, _| raw(EdgeOfTint, [p[0], p[1]], 1.0)),
        case(OURS, "n-of-r-g", &R_G, n, |p, _| pair(IndexOfTint, p, 0)),
        case(TEXTBOOK, "n-of-r-g", &R_G, n, |p, _| pair(IndexAsPrinted, p, 0)),
        case(OURS, "k-of-r-g", &R_G, k, |p, _| pair(IndexOfTint, p, 1)),
        case(TEXTBOOK, "k-of-r-g", &R_G, k, |p, _| pair(IndexAsPrinted, p, 1)),
        case(OURS, "r-of-n-k", &N_K, r, |p, _| pair(TintOfIndex, p, 0)),
        case(TEXTBOOK, "r-of-n-k", &N_K, r, |p, _| pair(TintAsPrinted, p, 0)),
        case(OURS, "g-of-n-k", &N_K, g, |p, _| pair(TintOfIndex, p, 1)),
        case(TEXTBOOK, "g-of-n-k", &N_K, g, |p, _| pair(TintAsPrinted, p, 1)),
    ]
}

/// A form whose constants are its parameters.
fn raw<F: Form<P>, const P: usize>(form: F, parameters: [Rgb; P], c: f64) -> Evaluations {
    evaluations(&Material::of_parameters(form, parameters), c, 0)
}

/// One of two results of a conversion.
fn pair<F: Form<2, 2>>(form: F, p: &[Rgb], result: usize) -> Evaluations {
    evaluations(&Material::of_parameters(form, [p[0], p[1]]), 1.0, result)
}

fn one_minus(f: Evaluations) -> Evaluations {
    Evaluations { vectors: 1.0 - f.vectors, scalar: 1.0 - f.scalar, double: 1.0 - f.double }
}
