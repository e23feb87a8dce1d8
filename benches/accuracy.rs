//! The spectral truth, the colour difference, the fits and the whole accuracy study.
//!
//! On two cores the study without searches, 47 metals in 4 spaces, is to stay well under a second, r and h by least
//! squares at microseconds, n and k under a millisecond, and a search for the smallest ΔE over all metals at seconds.

use std::hint::black_box;
use std::ops::ControlFlow;

use divan::Bencher;
use edgewise::color::{Rgb, RgbSpace, delta_e_rgb};
use edgewise::fit::{Method, fit_to_truth, r_h_by_least_squares};
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

/// The closed form of three channels, without the error that a fit also measures.
#[divan::bench]
fn r_and_h_by_least_squares(bencher: Bencher) {
    let truth = TruthCurve::of(copper(), SPACE);
    bencher.bench(|| [0, 1, 2].map(|channel| r_h_by_least_squares(black_box(&truth).channel(channel))));
}

#[divan::bench(args = [
    Candidate::HOFFMAN,
    Candidate::Model(ModelKind::Hoffman, Method::LeastSquares),
    Candidate::Model(ModelKind::Gulbrandsen, Method::LeastSquares),
    Candidate::Model(ModelKind::Conductor, Method::LeastSquares),
    Candidate::Model(ModelKind::Lazanyi, Method::LeastSquares),
    Candidate::Model(ModelKind::Hoffman, Method::BlackBox),
    FITTED_NK,
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

/// n and k with the smallest mean ΔE for every metal of the library, in one space.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn black_box_of_all_metals(bencher: Bencher) {
    let metals: Vec<&Metal> = preferred_metals().collect();
    bencher.bench(|| accuracy(&metals, &[FITTED_NK], &[SPACE], &no_progress));
}

const FITTED_NK: Candidate = Candidate::Model(ModelKind::Conductor, Method::BlackBox);
