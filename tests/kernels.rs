//! Are the kernels as accurate on the measured metals as they say, on every instruction set of this machine?
//!
//! The exact values are the same formulas in 64 bits, which `edgewise study stability` holds against arbitrary
//! precision.

use edgewise::color::{Rgb, RgbSpace, delta_e_rgb};
use edgewise::fresnel::{CosTheta, conductor, whole_degrees};
use edgewise::kernel::{
    Conductor, ConductorAndAbsorption, LabConversion, Level, Spectral, Table, delta_e_over, levels,
};
use edgewise::metal::{TruthCurve, metal_by_name, preferred_metals};
use edgewise::spectrum::{FewWavelengths, Quadrature};

/// 0°, 1°, … 90°, and closer and closer to it.
fn cosines() -> Vec<f32> {
    let near = (1..=14_i32).map(|power| 0.5_f32.powi(2 * power));
    whole_degrees().map(|c| c.get() as f32).chain(near).collect()
}

fn ulps(got: f32, exact: f64) -> f64 {
    let nearest = (exact as f32).max(f32::MIN_POSITIVE);
    let unit = f64::from(f32::from_bits(nearest.to_bits() + 1)) - f64::from(nearest);
    ((f64::from(got) - exact) / unit).abs()
}

/// F within 17 units in the last place and 1 − F within 6e-7 of its size, for each metal, each tenth nanometre of
/// the visible and each angle.
#[test]
fn metals_keep_their_digits_to_grazing() {
    let cosines = cosines();
    let (mut worst_ulps, mut worst_absorption) = (0.0_f64, 0.0_f64);
    for metal in preferred_metals() {
        for nk in (380..=780).step_by(10).map(|nm| metal.table().at(f64::from(nm))) {
            let material = ConductorAndAbsorption::material(Rgb::splat(nk.n), Rgb::splat(nk.k));
            for level in fused_levels() {
                let mut out = [(); 6].map(|()| vec![f32::NAN; cosines.len()]);
                let [a, b, c, d, e, f] = out.each_mut().map(Vec::as_mut_slice);
                material.over(level, &cosines, [[a, b, c], [d, e, f]]);
                for (at, c) in cosines.iter().enumerate() {
                    let [[exact, ..], [absorbed, ..]] = material.at(f64::from(*c));
                    let core = conductor(nk.n, nk.k, CosTheta::new(f64::from(*c)));
                    assert!((exact - core).abs() < 1e-12, "{} {nk:?} {c}", metal.id);
                    worst_ulps = worst_ulps.max(ulps(out[0][at], exact));
                    let off = if absorbed > 0.0 { f64::from(out[3][at]) / absorbed - 1.0 } else { 0.0 };
                    worst_absorption = worst_absorption.max(off.abs());
                }
            }
        }
    }
    assert!(worst_ulps <= 17.0, "{worst_ulps}");
    assert!(worst_absorption <= 6e-7, "{worst_absorption}");
}

/// The instruction sets that round a product and its sum once.
fn fused_levels() -> Vec<Level> {
    levels().into_iter().filter(|level| !edgewise::kernel::level_id(*level).starts_with("sse")).collect()
}

/// What a slider recomputes: every cell of a table of differences within 3e-4 of 64 bits.
#[test]
fn differences_of_a_table_are_those_of_64_bits() {
    let space = RgbSpace::LinRec709;
    let cosines: Vec<f32> = whole_degrees().map(|c| c.get() as f32).collect();
    let lab = LabConversion::new(space);
    let mut largest = 0.0_f64;
    for metal in preferred_metals() {
        let truth = TruthCurve::of(metal, space);
        let weights = FewWavelengths::new(20, Quadrature::Spline, space);
        let nk = weights.wavelengths_nm.iter().map(|nm| metal.table().at(*nm));
        let spectral = Spectral::new(nk.zip(weights.weights.iter().copied()));
        let red_green_blue = |channel: usize| truth.rgb().iter().map(|rgb| rgb[channel] as f32).collect::<Vec<_>>();
        let exact = [0, 1, 2].map(red_green_blue);
        for level in levels() {
            let mut shown = [(); 3].map(|()| vec![f32::NAN; cosines.len()]);
            spectral.over(level, &cosines, shown.each_mut().map(Vec::as_mut_slice));
            let mut labs = [(); 6].map(|()| vec![f32::NAN; cosines.len()]);
            let [a, b, c, d, e, f] = labs.each_mut().map(Vec::as_mut_slice);
            lab.over(level, exact.each_ref().map(Vec::as_slice), [a, b, c]);
            lab.over(level, shown.each_ref().map(Vec::as_slice), [d, e, f]);
            let mut out = vec![f32::NAN; cosines.len()];
            let [a, b, c, d, e, f] = labs.each_ref().map(Vec::as_slice);
            delta_e_over(level, [a, b, c], [d, e, f], &mut out);
            for (at, got) in out.iter().enumerate() {
                let rgb = |planes: &[Vec<f32>; 3]| Rgb(std::array::from_fn(|channel| f64::from(planes[channel][at])));
                let off = (f64::from(*got) - delta_e_rgb(rgb(&exact), rgb(&shown), space)).abs();
                largest = edgewise::number::larger(largest, off);
            }
        }
    }
    assert!(largest < 3e-4, "{largest}");
}

/// A table of 256 values of gold is nearer than an eye can see.
#[test]
fn a_table_of_gold_is_gold() {
    let gold = metal_by_name("gold").unwrap();
    let space = RgbSpace::LinRec709;
    let table = Table::new(256, |c| gold.reflectance(c, space));
    for deg in 0..=90_u8 {
        let c = CosTheta::from_deg(f64::from(deg));
        let shown = Rgb(table.at(c.get() as f32).map(f64::from));
        let off = delta_e_rgb(shown, gold.reflectance(c, space), space);
        assert!(off < 0.02, "{deg}°: {off}");
    }
}

/// The kernel that only gives F is the same F.
#[test]
fn one_result_or_two_are_the_same() {
    let (n, k) = (Rgb([0.183, 0.421, 1.373]), Rgb([3.424, 2.346, 1.770]));
    for c in cosines() {
        let [alone] = Conductor::material(n, k).at(c);
        let [first, _] = ConductorAndAbsorption::material(n, k).at(c);
        for channel in 0..3 {
            assert!((alone[channel] - first[channel]).abs() <= 1.2e-7, "{c}");
        }
    }
}
