//! The kernels over 1024 values in the cache, ours and textbook; divan takes them one after the other.

use divan::Bencher;
use edgewise::color::Rgb;
use edgewise::color::RgbSpace;
use edgewise::kernel::textbook::{
    ComplexConductor, DividerBound, GulbrandsenAsPrinted, PopularConductor, SpectralDividerBound,
};
use edgewise::kernel::{
    Basis, Conductor, ConductorAndAbsorption, F82OfPixels, Factored, Form, GulbrandsenOfPixels, Level, Material,
    Schlick, Spectral, Table, delta_e_over, over_pixels,
};
use edgewise::metal::{Metal, metal_by_name};
use edgewise::spectrum::{FewWavelengths, Quadrature};
use palette::color_difference::Ciede2000;

fn main() {
    divan::main();
}

const VALUES: usize = 1024;

const R: Rgb = Rgb([0.944, 0.776, 0.373]);
const H: Rgb = Rgb([0.954, 0.880, 0.660]);
const N: Rgb = Rgb([0.183, 0.421, 1.373]);
const K: Rgb = Rgb([3.424, 2.346, 1.770]);

fn cosines() -> Vec<f32> {
    (0..VALUES).map(|i| ((i * 7919) % VALUES) as f32 / VALUES as f32).collect()
}

fn planes() -> [Vec<f32>; 3] {
    [(); 3].map(|()| vec![0.5; VALUES])
}

fn material<F: Form<P, N>, const P: usize, const N: usize>(bencher: Bencher, material: Material<F, P, N>) {
    let (level, cosines) = (Level::new(), cosines());
    let mut out: [[Vec<f32>; 3]; N] = std::array::from_fn(|_| planes());
    let bencher = bencher.counter(divan::counter::ItemsCount::new(VALUES));
    bencher.bench_local(|| {
        material.over(level, &cosines, out.each_mut().map(|planes| planes.each_mut().map(Vec::as_mut_slice)));
    });
}

fn pixels<F: Form<2>>(bencher: Bencher, form: F) {
    let (level, cosines) = (Level::new(), cosines());
    let (first, second, mut out) = (planes(), planes(), planes());
    let bencher = bencher.counter(divan::counter::ItemsCount::new(VALUES));
    bencher.bench_local(|| {
        let textures = [&first, &second].map(|planes| planes.each_ref().map(Vec::as_slice));
        over_pixels(form, level, (&cosines, textures), [out.each_mut().map(Vec::as_mut_slice)]);
    });
}

#[divan::bench]
fn schlick(bencher: Bencher) {
    material(bencher, Schlick::material(R));
}

#[divan::bench]
fn hoffman(bencher: Bencher) {
    material(bencher, Factored::hoffman(R, H));
}

#[divan::bench]
fn f82_tint(bencher: Bencher) {
    material(bencher, Factored::f82_tint(R, Rgb([0.983, 0.999, 0.994])));
}

#[divan::bench]
fn hoffman_basis(bencher: Bencher) {
    material(bencher, Basis::material(R, H));
}

#[divan::bench]
fn conductor(bencher: Bencher) {
    material(bencher, Conductor::material(N, K));
}

#[divan::bench]
fn conductor_and_absorption(bencher: Bencher) {
    material(bencher, ConductorAndAbsorption::material(N, K));
}

#[divan::bench]
fn conductor_popular(bencher: Bencher) {
    material(bencher, PopularConductor::material(N, K));
}

#[divan::bench]
fn conductor_complex(bencher: Bencher) {
    material(bencher, ComplexConductor::material(N, K));
}

#[divan::bench]
fn two_roots_and_a_division(bencher: Bencher) {
    material(bencher, DividerBound::material(N, K));
}

#[divan::bench]
fn hoffman_of_pixels(bencher: Bencher) {
    pixels(bencher, Basis);
}

#[divan::bench]
fn f82_of_pixels(bencher: Bencher) {
    pixels(bencher, F82OfPixels);
}

#[divan::bench]
fn gulbrandsen_of_pixels(bencher: Bencher) {
    pixels(bencher, GulbrandsenOfPixels);
}

#[divan::bench]
fn gulbrandsen_printed(bencher: Bencher) {
    pixels(bencher, GulbrandsenAsPrinted);
}

fn gold() -> &'static Metal {
    metal_by_name("gold").expect("a metal of the library")
}

#[divan::bench(args = [8, 20, 81])]
fn spectral(bencher: Bencher, count: usize) {
    let few = FewWavelengths::new(count, Quadrature::Spline, RgbSpace::LinRec709);
    let nk = few.wavelengths_nm.iter().map(|nm| gold().table().at(*nm));
    let spectral = Spectral::new(nk.zip(few.weights.iter().copied()));
    let (cosines, mut out) = (cosines(), planes());
    let bencher = bencher.counter(divan::counter::ItemsCount::new(VALUES));
    bencher.bench_local(|| spectral.over(Level::new(), &cosines, out.each_mut().map(Vec::as_mut_slice)));
}

#[divan::bench(args = [8, 20, 81])]
fn spectral_roots_and_divisions(bencher: Bencher, count: usize) {
    let bound = SpectralDividerBound::new(count);
    let (cosines, mut out) = (cosines(), planes());
    let bencher = bencher.counter(divan::counter::ItemsCount::new(VALUES));
    bencher.bench_local(|| bound.over(Level::new(), &cosines, out.each_mut().map(Vec::as_mut_slice)));
}

#[divan::bench]
fn table_of_256(bencher: Bencher) {
    let table = Table::new(256, |c| gold().reflectance(c, RgbSpace::LinRec709));
    let (cosines, mut out) = (cosines(), planes());
    let bencher = bencher.counter(divan::counter::ItemsCount::new(VALUES));
    bencher.bench_local(|| table.over(Level::new(), &cosines, out.each_mut().map(Vec::as_mut_slice)));
}

/// L*, a* and b* of colours and of others nearby.
fn labs() -> [[Vec<f32>; 3]; 2] {
    let lab = |shift: f32| {
        [(100.0, 0.0), (60.0, -30.0), (-50.0, 40.0)]
            .map(|(scale, offset): (f32, f32)| cosines().into_iter().map(|c| c * scale + offset + shift).collect())
    };
    [lab(0.0), lab(0.7)]
}

#[divan::bench]
fn delta_e(bencher: Bencher) {
    let (labs, mut out) = (labs(), vec![0.0; VALUES]);
    let bencher = bencher.counter(divan::counter::ItemsCount::new(VALUES));
    bencher.bench_local(|| {
        let [x, y] = labs.each_ref().map(|planes| planes.each_ref().map(Vec::as_slice));
        delta_e_over(Level::new(), x, y, &mut out);
    });
}

#[divan::bench]
fn delta_e_of_palette(bencher: Bencher) {
    type Lab = palette::Lab<palette::white_point::D65, f32>;
    let [x, y] = labs().map(|[l, a, b]| (0..VALUES).map(|i| Lab::new(l[i], a[i], b[i])).collect::<Vec<Lab>>());
    let mut out = vec![0.0_f32; VALUES];
    let bencher = bencher.counter(divan::counter::ItemsCount::new(VALUES));
    bencher.bench_local(|| {
        for ((x, y), out) in x.iter().zip(&y).zip(&mut out) {
            *out = x.difference(*y);
        }
    });
}
