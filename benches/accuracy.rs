//! The spectral truth, the colour difference, the fits and the whole accuracy study.
//!
//! The study without searches, 47 metals in 4 spaces, is to stay well under a second on two cores, and n and k by
//! least squares under a millisecond for a metal.

use std::hint::black_box;
use std::ops::ControlFlow;

use divan::Bencher;
use edgewise::color::{Rgb, RgbSpace, delta_e_rgb};
use edgewise::fit::{Method, fit_to_truth};
use edgewise::fresnel::{CosTheta, ModelKind};
use edgewise::metal::{Metal, SpectralCurve, TruthCurve, metal_by_name, preferred_metals};
use edgewise::study::{Candidate, accuracy, no_progress};

fn main() {
    divan::main();
}

const SPACE: RgbSpace = RgbSpace::AcesCg;

fn copper() -> &'static Metal {
    metal_by_name("copper").expect("a metal of the library")
}

#[divan::bench]
fn truth_at_one_angle(bencher: Bencher) {
    bencher.bench(|| copper().reflectance(black_box(CosTheta::MAX), SPACE));
}

#[divan::bench]
fn truth_at_91_angles_in_four_spaces(bencher: Bencher) {
    bencher.bench(|| {
        let spectral = SpectralCurve::of(black_box(copper()));
        RgbSpace::ALL.map(|space| spectral.truth(space))
    });
}

#[divan::bench]
fn delta_e(bencher: Bencher) {
    bencher.bench(|| delta_e_rgb(black_box(Rgb([0.9, 0.6, 0.4])), black_box(Rgb([0.88, 0.61, 0.43])), SPACE));
}

#[divan::bench(args = [
    Candidate::HOFFMAN,
    Candidate::Model(ModelKind::Hoffman, Method::LeastSquares),
    Candidate::Model(ModelKind::Gulbrandsen, Method::LeastSquares),
    Candidate::Model(ModelKind::Conductor, Method::LeastSquares),
    Candidate::Model(ModelKind::Lazanyi, Method::LeastSquares),
    Candidate::Model(ModelKind::Hoffman, Method::BlackBox),
    Candidate::Model(ModelKind::Conductor, Method::BlackBox),
])]
fn fit_of_a_metal(bencher: Bencher, candidate: Candidate) {
    let truth = TruthCurve::of(copper(), SPACE);
    let Candidate::Model(kind, method) = candidate else { return };
    bencher.bench(|| fit_to_truth(copper(), &truth, kind, method, &mut || ControlFlow::Continue(())));
}

#[divan::bench(sample_count = 10)]
fn study_without_searches(bencher: Bencher) {
    let metals: Vec<&Metal> = preferred_metals().collect();
    bencher.bench(|| accuracy(&metals, &Candidate::without_search(), &RgbSpace::ALL, &no_progress));
}

#[divan::bench(sample_count = 10)]
fn study_without_black_box(bencher: Bencher) {
    let metals: Vec<&Metal> = preferred_metals().collect();
    bencher.bench(|| accuracy(&metals, &Candidate::without_black_box(), &RgbSpace::ALL, &no_progress));
}
