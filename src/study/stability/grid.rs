//! What is computed, the grid of points where it is, and the ways to compute it.

use std::iter;

use half::f16;

use super::Fineness;
use super::exact::Exact;
use crate::color::Rgb;
use crate::kernel::{Form, Level, Material};

/// A quantity, where it is computed, what it is exactly, and the ways to compute it.
pub(super) struct Case {
    pub(super) quantity: &'static str,
    /// The parameters, and c last where there is an angle.
    axes: Vec<Axis>,
    is_inside: Where,
    /// Where the definition itself jumps, within the reach of rounding.
    jumps: Where,
    /// `None` where there is none, as for r ≥ 1 of Gulbrandsen's.
    pub(super) exact: Exactly,
    pub(super) ways: Vec<Way>,
}

/// Whether a point is such a one.
pub(super) type Where = fn(&[f64]) -> bool;

/// The exact value at a point.
pub(super) type Exactly = fn(&[f64]) -> Option<Exact>;

/// Ours, or another's.
pub(super) struct Way {
    pub(super) kind: &'static str,
    pub(super) evaluate: Evaluate,
}

/// The quantity at a point of the grid.
type Evaluate = Box<dyn Fn(&[f64]) -> Evaluations + Send + Sync>;

/// One value in three arithmetics; other programs have no vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Evaluations {
    pub(super) vectors: Option<f32>,
    pub(super) scalar: f32,
    pub(super) double: f64,
}

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Domain {
    Inside,
    Outside,
    Jump,
}

impl Domain {
    pub(super) const ALL: [Self; 3] = [Self::Inside, Self::Outside, Self::Jump];

    pub(super) const fn id(self) -> &'static str {
        match self {
            Self::Inside => "inside",
            Self::Outside => "outside",
            Self::Jump => "jump",
        }
    }
}

/// A parameter, some that belong together, or the cosine.
#[derive(Clone, Copy, Debug)]
pub(super) enum Axis {
    /// A reflectance or a tint: around 0 and 1, and beyond, as gold's r in sRGB.
    Reflectance(&'static str),
    /// n or k: from 0 to what no material has.
    Index(&'static str),
    /// The cosine: around 0 and 1, and beyond, as dot products are.
    Cosine,
    /// A channel of linear light: below 0, in the toe of L*, to the largest half float.
    Light(&'static str),
    /// L*, a* and b* of a colour: greys, opposite hues, blues, near neighbours, and what nothing looks like.
    Colour([&'static str; 3]),
    /// These values, at either fineness.
    Of(&'static str, &'static [f64]),
    /// Parameters that belong together.
    Sets(&'static [Set]),
}

/// Parameters that belong together, under a name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Set {
    pub(super) name: String,
    /// Numbers of 32 bits.
    pub(super) parameters: Vec<f64>,
}

/// The neighbours of 1 in 32 bits.
const BELOW_1: f64 = 1.0 - 1.0 / 16_777_216.0;
const ABOVE_1: f64 = 1.0 + 1.0 / 8_388_608.0;

const REFLECTANCES: [f64; 15] =
    [-0.1, 0.0, 1e-7, 1e-3, 0.04, 0.3, 0.5, 0.8, 0.95, 0.9999, BELOW_1, 1.0, ABOVE_1, 1.06, 1.5];
const INDICES: [f64; 16] =
    [0.0, 1e-8, 1e-3, 0.05, 0.2, 0.9, BELOW_1, 1.0, ABOVE_1, 1.5, 3.4, 7.0, 20.0, 1e3, 1e5, 1e12];
const COSINES: [f64; 14] =
    [-1.0, -1e-7, 0.0, 1e-7, 1e-4, 0.01, 1.0 / 7.0, 0.4, 0.7, 0.99, BELOW_1, 1.0, ABOVE_1, 1.001];
/// .0088564517 is the end of the toe (216/24389).
const LIGHTS: [f64; 12] = [-0.5, -1e-3, 0.0, 1e-7, 1e-3, 0.008_856, 0.008_857, 0.18, BELOW_1, 1.0, 16.0, 65504.0];

/// a* and b*. Opposite: (40, 40) to (−40, −40), (−1.25, −3) to (3.75, 9) and nearly to the next, (40, 2e-5) nearly to
/// (−86, 0) and less nearly to (−2.49, 0). The mean hue of (5, 12) and (20, −46) passes 0°, and CIEDE2000 turns hues
/// around (6.1, −69.7).
const CHROMATICITIES: [[f64; 2]; 19] = [
    [0.0, 0.0],
    [1e-3, -1e-3],
    [2.5, 0.0],
    [-2.49, 0.0],
    [0.0, 2.5],
    [0.0, -86.0],
    [40.0, 40.0],
    [40.02, 40.0],
    [-40.0, -40.0],
    [-1.25, -3.0],
    [3.75, 9.0],
    [3.75, 9.000_002],
    [5.0, 12.0],
    [40.0, 2e-5],
    [-86.0, 0.0],
    [6.1, -69.7],
    [20.0, -46.0],
    [-300.0, 200.0],
    [1e12, -1e12],
];
/// L* beside 50, of a grey, a red and a blue.
const LIGHTNESSES: [f64; 4] = [0.0, 50.02, 100.0, 120.0];
const OF_EVERY_LIGHTNESS: [[f64; 2]; 3] = [[0.0, 0.0], [40.0, 40.0], [20.0, -46.0]];

impl Axis {
    /// How many numbers a value has.
    fn width(self) -> usize {
        match self {
            Self::Colour(_) => 3,
            Self::Sets(sets) => sets.first().map_or(0, |set| set.parameters.len()),
            _ => 1,
        }
    }

    /// Numbers of 32 bits, so that every arithmetic is given the same.
    fn values(self, fineness: Fineness) -> Vec<Vec<f64>> {
        let singles = |edges: &[f64], between: &mut dyn Iterator<Item = f64>| {
            let is_fine = fineness == Fineness::Fine;
            edges.iter().copied().chain(between.take_while(|_| is_fine)).map(|value| vec![single(value)]).collect()
        };
        match self {
            Self::Reflectance(_) => singles(&REFLECTANCES, &mut (1..20).map(|i| f64::from(i) / 20.0)),
            Self::Index(_) => singles(&INDICES, &mut (-24..=30).map(|i| 10_f64.powf(f64::from(i) / 6.0))),
            Self::Cosine => singles(&COSINES, &mut (1..40).map(|i| (f64::from(i) * 2.25).to_radians().cos())),
            Self::Light(_) => singles(&LIGHTS, &mut (1..8).map(|i| f64::from(i) / 8.0)),
            Self::Of(_, values) => singles(values, &mut iter::empty()),
            Self::Colour(_) => colours(fineness),
            Self::Sets(sets) => sets.iter().map(|set| set.parameters.clone()).collect(),
        }
    }

    /// `r = 0.3`, `L1 = 50, a1 = 0, b1 = 2.5` or the name of a set.
    fn told(self, value: &[f64]) -> String {
        let one = |name: &str, value: f64| format!("{name} = {}", value as f32);
        match self {
            Self::Reflectance(name) | Self::Index(name) | Self::Light(name) | Self::Of(name, _) => one(name, value[0]),
            Self::Cosine => one("c", value[0]),
            Self::Colour(names) => {
                names.iter().zip(value).map(|(name, value)| one(name, *value)).collect::<Vec<_>>().join(", ")
            }
            Self::Sets(sets) => {
                sets.iter().find(|set| set.parameters == value).map(|set| set.name.clone()).unwrap_or_default()
            }
        }
    }

    pub(super) fn is_unit(value: f64) -> bool {
        (0.0..=1.0).contains(&value)
    }
}

/// A number of 32 bits.
pub(super) fn single(value: f64) -> f64 {
    f64::from(value as f32)
}

/// Every a* and b* at L* = 50, and some at others; the finer grid has two circles of hues more.
fn colours(fineness: Fineness) -> Vec<Vec<f64>> {
    let circle = |chroma: f64| {
        (0..12).map(move |i| f64::from(i * 30).to_radians().sin_cos()).map(move |(b, a)| [chroma * a, chroma * b])
    };
    let between = [8.0, 60.0].into_iter().flat_map(circle).take_while(|_| fineness == Fineness::Fine);
    let at_50 = CHROMATICITIES.into_iter().chain(between).map(|ab| (50.0, ab));
    let others = LIGHTNESSES.into_iter().flat_map(|lightness| OF_EVERY_LIGHTNESS.map(|ab| (lightness, ab)));
    at_50.chain(others).map(|(lightness, [a, b])| [lightness, a, b].map(single).to_vec()).collect()
}

impl Case {
    /// Without a way yet.
    pub(super) fn new(quantity: &'static str, axes: &[Axis], (is_inside, exact): (Where, Exactly)) -> Self {
        Self { quantity, axes: axes.to_vec(), is_inside, jumps: |_| false, exact, ways: Vec::new() }
    }

    /// Keeps points apart where the definition itself jumps.
    pub(super) fn jumping(mut self, jumps: Where) -> Self {
        self.jumps = jumps;
        self
    }

    /// One more way: a function of the parameters, each the same in every channel, and of the last of them alone, which
    /// is the cosine where there is an angle.
    pub(super) fn way(
        mut self,
        kind: &'static str,
        evaluate: impl Fn(&[Rgb], f64) -> Evaluations + Send + Sync + 'static,
    ) -> Self {
        let evaluate = move |point: &[f64]| {
            let rgb: Vec<Rgb> = point.iter().map(|value| Rgb::splat(*value)).collect();
            evaluate(&rgb, point.last().copied().unwrap_or(f64::NAN))
        };
        self.ways.push(Way { kind, evaluate: Box::new(evaluate) });
        self
    }

    /// Every combination of the axes.
    pub(super) fn grid(&self, fineness: Fineness) -> Vec<Vec<f64>> {
        self.axes.iter().fold(vec![Vec::new()], |points, axis| {
            let values = axis.values(fineness);
            let extended = |point: &Vec<f64>| {
                let with = |value: &Vec<f64>| point.iter().chain(value).copied().collect::<Vec<f64>>();
                values.iter().map(with).collect::<Vec<_>>()
            };
            points.iter().flat_map(extended).collect()
        })
    }

    pub(super) fn domain(&self, point: &[f64]) -> Domain {
        match ((self.jumps)(point), (self.is_inside)(point)) {
            (true, _) => Domain::Jump,
            (false, true) => Domain::Inside,
            (false, false) => Domain::Outside,
        }
    }

    /// Parameters as half floats hold them; one beyond their largest, 65504, becomes that. The cosine is no parameter.
    pub(super) fn halved(&self, point: &[f64]) -> Vec<f64> {
        let halved = |value: &f64| f16::from_f64(value.clamp(-65504.0, 65504.0)).to_f64();
        let of_axis = |(axis, value): (Axis, &[f64])| match axis {
            Axis::Cosine => value.to_vec(),
            _ => value.iter().map(halved).collect(),
        };
        self.values(point).flat_map(of_axis).collect()
    }

    /// `r = 0.3, h = 1, c = 0`.
    pub(super) fn told(&self, point: &[f64]) -> String {
        self.values(point).map(|(axis, value)| axis.told(value)).collect::<Vec<_>>().join(", ")
    }

    /// The value of each axis.
    fn values<'a>(&'a self, point: &'a [f64]) -> impl Iterator<Item = (Axis, &'a [f64])> {
        self.axes.iter().scan(point, |rest, axis| {
            let (value, others) = rest.split_at(axis.width());
            *rest = others;
            Some((*axis, value))
        })
    }
}

/// One channel of a material at the cosine, the result of this place.
pub(super) fn evaluations<F: Form<P, N>, const P: usize, const N: usize>(
    material: &Material<F, P, N>,
    c: f64,
    result: usize,
) -> Evaluations {
    let mut out = [[[f32::NAN; 1]; 3]; N];
    let planes = out.each_mut().map(|planes| planes.each_mut().map(|plane| &mut plane[..]));
    material.over(Level::new(), &[c as f32], planes);
    Evaluations {
        vectors: Some(out[result][0][0]),
        scalar: material.at(c as f32)[result][0],
        double: material.at(c)[result][0],
    }
}

/// A form whose constants are its parameters.
pub(super) fn raw<F: Form<P>, const P: usize>(form: F, parameters: [Rgb; P], c: f64) -> Evaluations {
    evaluations(&Material::of_parameters(form, parameters), c, 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_told_and_halved_axis_by_axis() {
        let axes = [Axis::Reflectance("r"), Axis::Colour(["L", "a", "b"]), Axis::Cosine];
        let case = Case::new("test", &axes, (|point| point[0] > 0.5, |_| None)).jumping(|point| point[0] > 2.0);
        let point = [0.1, 50.0, 1e6, -3.0, 0.1].map(single);
        assert_eq!(case.told(&point), "r = 0.1, L = 50, a = 1000000, b = -3, c = 0.1");
        assert_eq!(case.halved(&point), [f16::from_f64(0.1).to_f64(), 50.0, 65504.0, -3.0, single(0.1)]);
        assert_eq!([0.1, 0.6, 3.0].map(|r| case.domain(&[r])), [Domain::Outside, Domain::Inside, Domain::Jump]);
    }

    #[test]
    fn the_finer_grid_has_every_point_of_the_other_and_more() {
        let case = Case::new("test", &[Axis::Reflectance("r"), Axis::Cosine], (|_| true, |_| None));
        let [coarse, fine] = [Fineness::Default, Fineness::Fine].map(|fineness| case.grid(fineness));
        assert_eq!((coarse.len(), fine.len()), (15 * 14, (15 + 19) * (14 + 39)));
        assert!(coarse.iter().all(|point| fine.contains(point)));
    }
}
