//! The cases that many numbers stand for: a series or polynomial of one metal, its table, its wavelengths.

use std::ops::ControlFlow;
use std::sync::LazyLock;

use super::curves::{OURS, TEXTBOOK, cosine};
use super::exact;
use super::grid::{Axis, Case, Evaluations, Exactly, Set, Where, evaluations, single};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, Nk, SchlickSeries};
use crate::kernel::textbook::PopularConductor;
use crate::kernel::{Level, Polynomial, Spectral, Table};
use crate::metal::metal_by_name;
use crate::study::{Form, Subject, Variant, forms};

/// What is common, and zinc and caesium, of which the polynomial is the farthest off.
const METALS: [&str; 6] = ["gold", "silver", "copper", "titanium", "zinc", "caesium"];

/// The space of their channels: gold's r leaves 1 here.
const SPACE: RgbSpace = RgbSpace::LinRec709;

const SERIES: usize = 3;
const POLYNOMIAL: usize = 10;
const ROWS: usize = 32;
const WAVELENGTHS: usize = 20;

/// p and β of [`SchlickSeries`].
const SHAPE_OF_SERIES: (u32, f64) = (6, 0.0);
const SHAPE_OF_POLYNOMIAL: (u32, f64) = (1, SchlickSeries::BEND_OF_METALS);

/// What no metal comes near: the largest coefficients, steepest tables and strangest indices.
const HUGE: f64 = 1e30;

static SERIES_SETS: LazyLock<Vec<Set>> = LazyLock::new(|| sets_of_coefficients(Variant::Series(SERIES), SERIES));

static POLYNOMIAL_SETS: LazyLock<Vec<Set>> =
    LazyLock::new(|| sets_of_coefficients(Variant::Polynomial(POLYNOMIAL), POLYNOMIAL));

static TABLE_SETS: LazyLock<Vec<Set>> = LazyLock::new(|| {
    let more =
        [("rows ±1 in turn", in_turn(ROWS, 1.0).collect()), ("rows ±1e30 in turn", in_turn(ROWS, HUGE).collect())];
    sets(Variant::Table(ROWS), more)
});

static SPECTRAL_SETS: LazyLock<Vec<Set>> = LazyLock::new(|| {
    let edges = [0.0, 1e-8, 0.05, 1.0, 7.0, 1e5, 1e9];
    let edge =
        |i: usize| [edges[i % edges.len()], edges[(3 * i + i / edges.len()) % edges.len()], 1.0 / WAVELENGTHS as f64];
    let more = [("n and k of every size", (0..WAVELENGTHS).flat_map(edge).collect())];
    sets(Variant::Spectral(WAVELENGTHS), more)
});

fn sets_of_coefficients(variant: Variant, count: usize) -> Vec<Set> {
    let alternating = |size: f64| [0.5].into_iter().chain(in_turn(count, size)).collect();
    sets(variant, [("r = 0.5, ±1 in turn", alternating(1.0)), ("r = 0.5, ±1e30 in turn", alternating(HUGE))])
}

/// So many of one size, of either sign.
fn in_turn(count: usize, size: f64) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| if i % 2 == 0 { size } else { -size })
}

/// A variant of each metal, channel by channel, and more.
fn sets<const N: usize>(variant: Variant, more: [(&str, Vec<f64>); N]) -> Vec<Set> {
    let of_metal = |name: &str| {
        let metal = Subject::Metal(metal_by_name(name).expect("a metal of the library"));
        let all = forms(&metal, &[variant], SPACE, &mut || ControlFlow::Continue(())).expect("nobody stops it");
        let channels = ["red", "green", "blue"].into_iter().enumerate();
        channels.map(|(i, channel)| (format!("{name} {channel}"), parameters(&all[0].form, i))).collect::<Vec<_>>()
    };
    let metals = METALS.into_iter().flat_map(of_metal);
    let more = more.into_iter().map(|(name, parameters)| (name.to_owned(), parameters));
    let set =
        |(name, parameters): (String, Vec<f64>)| Set { name, parameters: parameters.into_iter().map(single).collect() };
    metals.chain(more).map(set).collect()
}

/// One channel: r and coefficients, rows, or n, k and weight of each wavelength.
fn parameters(form: &Form, channel: usize) -> Vec<f64> {
    match form {
        Form::Model { .. } => Vec::new(),
        Form::Series(series) => {
            [series.r[channel]].into_iter().chain(series.coefficients.iter().map(|b| b[channel])).collect()
        }
        Form::Table { rows } => rows.iter().map(|row| row[channel]).collect(),
        Form::Spectral { n, k, weights, .. } => {
            let nk = n.iter().zip(k);
            nk.zip(weights).flat_map(|((n, k), weight)| [*n, *k, weight[channel]]).collect()
        }
    }
}

/// Parameters such as measured metals have, and a cosine.
const MEASURED: Where = |point| {
    let (c, parameters) = point.split_last().unwrap_or((&f64::NAN, &[]));
    Axis::is_unit(*c) && parameters.iter().all(|parameter| parameter.abs() <= 20.0)
};

/// Without the cosine.
fn own<T>(point: &[T]) -> &[T] {
    &point[..point.len() - 1]
}

pub(super) fn baked() -> Vec<Case> {
    let axes = |sets: &'static LazyLock<Vec<Set>>| [Axis::Sets(sets.as_slice()), Axis::Cosine];
    let series: Exactly = |point| Some(exact::series(point[0], &own(point)[1..], SHAPE_OF_SERIES, cosine(point)));
    let polynomial: Exactly =
        |point| Some(exact::series(point[0], &own(point)[1..], SHAPE_OF_POLYNOMIAL, cosine(point)));
    let table: Exactly = |point| Some(exact::table(own(point), cosine(point)));
    let spectral: Exactly = |point| Some(exact::spectral(own(point), cosine(point)));
    vec![
        Case::new("series-3", &axes(&SERIES_SETS), (MEASURED, series))
            .way(OURS, |p, c| of_series::<{ SERIES + 2 }>(own(p), SHAPE_OF_SERIES, c)),
        Case::new("polynomial-10", &axes(&POLYNOMIAL_SETS), (MEASURED, polynomial))
            .way(OURS, |p, c| of_series::<{ POLYNOMIAL + 2 }>(own(p), SHAPE_OF_POLYNOMIAL, c)),
        Case::new("table-32", &axes(&TABLE_SETS), (MEASURED, table)).way(OURS, |p, c| of_table(own(p), c)),
        Case::new("spectral-20", &axes(&SPECTRAL_SETS), (MEASURED, spectral))
            .way(OURS, |p, c| of_wavelengths(own(p), c))
            .way(TEXTBOOK, |p, c| sum_of_popular(own(p), c)),
    ]
}

fn of_series<const P: usize>(parameters: &[Rgb], (first_power, bend): (u32, f64), c: f64) -> Evaluations {
    let series = SchlickSeries { r: parameters[0], first_power, bend, coefficients: parameters[1..].to_vec() };
    evaluations(&Polynomial::material::<P>(&series).expect("so many coefficients"), c, 0)
}

/// The kernel keeps its rows in 32 bits: the 64 are the core's.
fn of_table(rows: &[Rgb], c: f64) -> Evaluations {
    let mut values = rows.iter().copied();
    let kernel = Table::new(rows.len(), |_| values.next().unwrap_or(Rgb::splat(f64::NAN)));
    let core = Form::Table { rows: rows.to_vec() };
    Evaluations {
        vectors: Some(red(|out| kernel.over(Level::new(), &[c as f32], out))),
        scalar: kernel.at(c as f32)[0],
        double: core.reflectance(CosTheta::new(c))[0],
    }
}

/// The kernel keeps its constants in 32 bits: the 64 are the core's.
fn of_wavelengths(parameters: &[Rgb], c: f64) -> Evaluations {
    let of = |place: usize| parameters.iter().skip(place).step_by(3).copied();
    let nk = of(0).zip(of(1)).map(|(n, k)| Nk { n: n[0], k: k[0] });
    let kernel = Spectral::new(nk.zip(of(2)));
    let [n, k] = [0, 1].map(|place| of(place).map(|x| x[0]).collect());
    let core = Form::Spectral { wavelengths_nm: Vec::new(), n, k, weights: of(2).collect() };
    Evaluations {
        vectors: Some(red(|out| kernel.over(Level::new(), &[c as f32], out))),
        scalar: kernel.at(c as f32)[0],
        double: core.reflectance(CosTheta::new(c))[0],
    }
}

fn red(over: impl FnOnce([&mut [f32]; 3])) -> f32 {
    let mut out = [[f32::NAN; 1]; 3];
    over(out.each_mut().map(|plane| &mut plane[..]));
    out[0][0]
}

/// The weighted sum of the popular conductor.
fn sum_of_popular(parameters: &[Rgb], c: f64) -> Evaluations {
    let nothing = Evaluations { vectors: Some(0.0), scalar: 0.0, double: 0.0 };
    parameters.chunks_exact(3).fold(nothing, |sum, wavelength| {
        let f = evaluations(&PopularConductor::material(wavelength[0], wavelength[1]), c, 0);
        let weight = wavelength[2][0];
        Evaluations {
            vectors: sum.vectors.zip(f.vectors).map(|(sum, f)| sum + f * weight as f32),
            scalar: sum.scalar + f.scalar * weight as f32,
            double: sum.double + f.double * weight,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A set of a metal is its curve: the parameters are in the places where the ways look for them.
    #[test]
    fn sets_are_the_metals() {
        let gold = metal_by_name("gold").unwrap();
        let c = 0.4;
        let exact = gold.reflectance(CosTheta::new(c), SPACE);
        for case in baked() {
            let points = case.grid(crate::study::Fineness::Default);
            let point = |name: &str| {
                let mut point = points.iter().find(|point| case.told(point).starts_with(name)).unwrap().clone();
                *point.last_mut().unwrap() = c;
                point
            };
            for (channel, name) in ["gold red", "gold green", "gold blue"].into_iter().enumerate() {
                let got = (case.exact)(&point(name)).unwrap().to_f64();
                // The series of three is .006 off, the others less.
                assert!((got - exact[channel]).abs() < 0.01, "{} {name}: {got} {}", case.quantity, exact[channel]);
            }
        }
    }
}
