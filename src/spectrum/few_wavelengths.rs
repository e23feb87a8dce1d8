//! RGB weights for a handful of wavelengths instead of 401.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::grid::{FIRST_NM, SAMPLES};
use super::rgb_weights;
use crate::color::{Rgb, RgbSpace};

/// Where the wavelengths of [`FewWavelengths`] begin and end: nearly all of the eye's response is between.
const RANGE_NM: (f64, f64) = (400.0, 700.0);

/// How values at a few wavelengths stand for the whole spectrum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quadrature {
    /// Each wavelength stands for its neighbourhood: the usual sum over equal bins.
    Bins,
    /// The natural cubic spline through the values, summed at 1 nm: as many evaluations, a better weight for each.
    #[default]
    Spline,
}

impl Quadrature {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Bins, Self::Spline];

    /// The stable identifier used in files and on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Bins => "bins",
            Self::Spline => "spline",
        }
    }
}

/// N wavelengths with one RGB weight each, the weights summing to white.
#[derive(Clone, Debug, PartialEq)]
pub struct FewWavelengths {
    /// The wavelengths, growing.
    pub wavelengths_nm: Vec<f64>,
    /// The RGB weight of each.
    pub weights: Vec<Rgb>,
}

/// Everything that names one [`FewWavelengths`].
type Key = (usize, Quadrature, RgbSpace);

static KNOWN: LazyLock<Mutex<HashMap<Key, Arc<FewWavelengths>>>> = LazyLock::new(Mutex::default);

impl FewWavelengths {
    /// [`new`](Self::new), computed once for all metals: the weights are those of a space, and cost more than a metal
    /// at the wavelengths.
    pub fn shared(count: usize, quadrature: Quadrature, space: RgbSpace) -> Arc<Self> {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let computed = || Arc::new(Self::new(count, quadrature, space));
        Arc::clone(known.entry((count, quadrature, space)).or_insert_with(computed))
    }

    /// `count` wavelengths for a space; at least 2.
    ///
    /// Bins have their wavelength in the middle and divide 400–700 nm evenly; spline nodes include both ends.
    /// Outside, the first and last value hold.
    pub fn new(count: usize, quadrature: Quadrature, space: RgbSpace) -> Self {
        let count = count.max(2);
        let (first, last) = RANGE_NM;
        let wavelength = |index: usize| match quadrature {
            Quadrature::Bins => first + (last - first) * (index as f64 + 0.5) / count as f64,
            Quadrature::Spline => first + (last - first) * index as f64 / (count - 1) as f64,
        };
        let wavelengths_nm: Vec<f64> = (0..count).map(wavelength).collect();
        let shares = match quadrature {
            Quadrature::Bins => bins(count),
            Quadrature::Spline => cardinal_splines(&wavelengths_nm),
        };
        let weight = |share: &[f64; SAMPLES]| {
            share.iter().zip(rgb_weights(space)).fold(Rgb::BLACK, |sum, (share, weight)| sum + *weight * *share)
        };
        Self { weights: shares.iter().map(weight).collect(), wavelengths_nm }
    }

    /// The RGB of values given at each of the wavelengths.
    pub fn rgb(&self, values: impl IntoIterator<Item = f64>) -> Rgb {
        self.weights.iter().zip(values).fold(Rgb::BLACK, |sum, (weight, value)| sum + *weight * value)
    }
}

/// For each bin, the share of each wavelength of the grid that falls into it, one standing for 1 nm; the outer
/// bins take what is outside.
fn bins(count: usize) -> Vec<[f64; SAMPLES]> {
    let (first, last) = RANGE_NM;
    let edge = |index: usize| match index {
        0 => f64::NEG_INFINITY,
        _ if index == count => f64::INFINITY,
        _ => first + (last - first) * index as f64 / count as f64,
    };
    let share = |index: usize, sample: usize| {
        let nm = (FIRST_NM + sample) as f64;
        (edge(index + 1).min(nm + 0.5) - edge(index).max(nm - 0.5)).max(0.0)
    };
    (0..count).map(|index| std::array::from_fn(|sample| share(index, sample))).collect()
}

/// For each node, the natural cubic spline that is 1 there and 0 at the other nodes, at each wavelength of the grid.
///
/// Second derivatives m from h(m₋ + 4 m + m₊)/6 = (y₋ − 2 y + y₊)/h with m = 0 at both ends (de Boor 1978, chapter IV).
fn cardinal_splines(nodes_nm: &[f64]) -> Vec<[f64; SAMPLES]> {
    let curvature = curvatures(nodes_nm);
    let spline = |node: usize| {
        let value = |index: usize| f64::from(u8::from(index == node));
        std::array::from_fn(|sample| {
            let (left, weight) = interval(nodes_nm, (FIRST_NM + sample) as f64);
            let width = nodes_nm[left + 1] - nodes_nm[left];
            let (a, b) = (1.0 - weight, weight);
            let bend = (a.powi(3) - a) * curvature[(left, node)] + (b.powi(3) - b) * curvature[(left + 1, node)];
            a * value(left) + b * value(left + 1) + bend * width * width / 6.0
        })
    };
    (0..nodes_nm.len()).map(spline).collect()
}

/// Second derivatives at each node (rows) of the cardinal spline of each node (columns), for even nodes.
fn curvatures(nodes_nm: &[f64]) -> DMatrix<f64> {
    let count = nodes_nm.len();
    let mut all = DMatrix::zeros(count, count);
    let inner = count - 2;
    if inner == 0 {
        return all;
    }
    let step = nodes_nm[1] - nodes_nm[0];
    let near = |row: usize, column: usize| row.abs_diff(column) == 1;
    let system = DMatrix::from_fn(inner, inner, |i, j| match i.abs_diff(j) {
        0 => 4.0,
        1 => 1.0,
        _ => 0.0,
    });
    let bends = DMatrix::from_fn(inner, count, |i, node| match node {
        _ if node == i + 1 => -2.0,
        _ if near(node, i + 1) => 1.0,
        _ => 0.0,
    });
    let solved = system.lu().solve(&(bends * (6.0 / (step * step)))).expect("a diagonally dominant matrix");
    for i in 0..inner {
        all.set_row(i + 1, &solved.row(i));
    }
    all
}

/// The interval a wavelength is in and how far along, limited to the nodes.
fn interval(nodes_nm: &[f64], wavelength_nm: f64) -> (usize, f64) {
    let last_interval = nodes_nm.len() - 2;
    let left = nodes_nm.partition_point(|node| *node <= wavelength_nm).saturating_sub(1).min(last_interval);
    let weight = (wavelength_nm - nodes_nm[left]) / (nodes_nm[left + 1] - nodes_nm[left]);
    (left, weight.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{rgb_from_reflectance, wavelengths_nm};

    #[test]
    fn white_stays_white() {
        for (count, quadrature) in [2, 3, 8, 31].into_iter().flat_map(|n| Quadrature::ALL.map(|q| (n, q))) {
            let few = FewWavelengths::new(count, quadrature, RgbSpace::LinRec709);
            let white = few.rgb(vec![1.0; count]);
            assert!(white.max_abs_difference(Rgb::WHITE) < 1e-12, "{count} {quadrature:?}: {white:?}");
        }
    }

    #[test]
    fn what_is_shared_is_the_same() {
        for (count, space) in [(3, RgbSpace::AcesCg), (8, RgbSpace::AcesCg), (8, RgbSpace::LinRec709)] {
            let shared = || FewWavelengths::shared(count, Quadrature::Spline, space);
            assert_eq!(*shared(), FewWavelengths::new(count, Quadrature::Spline, space));
            assert!(Arc::ptr_eq(&shared(), &shared()));
        }
    }

    /// A smooth reflectance: the error of the spline falls much faster than that of bins.
    #[test]
    fn more_wavelengths_converge_to_the_whole_spectrum() {
        let reflectance = |nm: f64| 0.5 + 0.4 * (nm.clamp(400.0, 700.0) / 40.0).sin();
        let space = RgbSpace::AcesCg;
        let whole = rgb_from_reflectance(wavelengths_nm().map(reflectance), space);
        let error = |count, quadrature| {
            let few = FewWavelengths::new(count, quadrature, space);
            few.rgb(few.wavelengths_nm.iter().map(|nm| reflectance(*nm))).max_abs_difference(whole)
        };
        assert!(error(40, Quadrature::Spline) < error(20, Quadrature::Spline) / 8.0);
        assert!(error(40, Quadrature::Bins) < error(10, Quadrature::Bins) / 8.0);
        assert!(error(20, Quadrature::Spline) < error(20, Quadrature::Bins));
    }

    #[test]
    fn two_nodes_are_a_straight_line() {
        let few = FewWavelengths::new(2, Quadrature::Spline, RgbSpace::LinRec709);
        let line = |nm: f64| 0.2 + nm.clamp(400.0, 700.0) / 1000.0;
        let whole = rgb_from_reflectance(wavelengths_nm().map(line), RgbSpace::LinRec709);
        assert!(few.rgb([line(400.0), line(700.0)]).max_abs_difference(whole) < 1e-12);
    }

    #[test]
    fn a_spline_passes_through_its_nodes() {
        let nodes: Vec<f64> = (0..7).map(|i| 400.0 + 50.0 * f64::from(i)).collect();
        let splines = cardinal_splines(&nodes);
        for (index, spline) in splines.iter().enumerate() {
            for (other, node) in nodes.iter().enumerate() {
                let expected = f64::from(u8::from(index == other));
                assert!((spline[*node as usize - FIRST_NM] - expected).abs() < 1e-12);
            }
        }
    }
}
