//! How many digits the exact kernels keep: n and k of real metals, dielectrics, and r and g.

use rayon::prelude::*;

use crate::color::Rgb;
use crate::fresnel::{nk_from_r_g, whole_degrees};
use crate::kernel::{ConductorAndAbsorption, Dielectric, IndexOfTint, Level, Material};
use crate::metal::preferred_metals;
use crate::number::larger;
use crate::study::stability::unit_of_single;

/// The largest errors of F and 1 − F of n and k in vectors of 32 bits, against the same form in 64 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Digits {
    /// Of F, in units of the last place.
    pub(super) reflectance_ulp: f64,
    /// Of 1 − F, relative.
    pub(super) absorbed_relative: f64,
}

/// The largest error of F of dielectrics of n = 1.0001 to 4 at every angle, in units of the last place, against the same
/// form in 64 bits.
pub(super) fn dielectric_ulp(level: Level) -> f64 {
    let cosines = cosines();
    let indices = (0..=200).map(|step| 1.0001 + 2.9999 * f64::from(step) / 200.0);
    indices.fold(0.0, |worst, n| {
        let material = Dielectric::material(Rgb::splat(n));
        let mut out = [(); 3].map(|()| vec![f32::NAN; cosines.len()]);
        material.over(level, &cosines, [out.each_mut().map(Vec::as_mut_slice)]);
        let pairs = cosines.iter().zip(&out[0]).map(|(c, got)| (f64::from(*got), material.at(f64::from(*c))[0][0]));
        pairs.fold(worst, |worst, (got, exact)| larger(worst, (got - exact).abs() / unit_of_single(exact)))
    })
}

/// The largest relative error of n and k of r = 0.04 to 1 − 1e-7 and any g, against 64 bits.
pub(super) fn index_relative(level: Level) -> f64 {
    let decades = || (1..=7).map(|power| 10_f64.powi(-power));
    let tenths = || (0..=10).map(|tenth| f64::from(tenth) / 10.0);
    let reflectances = decades().map(|gap| 1.0 - gap).chain(tenths().map(|share| 0.04 + 0.9 * share));
    let pairs = reflectances.flat_map(|r| decades().chain(tenths()).map(move |g| (r, g)));
    pairs.fold(0.0, |worst, (r, g)| larger(worst, error_of_index(level, r as f32, g as f32)))
}

fn error_of_index(level: Level, r: f32, g: f32) -> f64 {
    let [exact_r, exact_g] = [r, g].map(f64::from);
    let Some(exact) = nk_from_r_g(exact_r, exact_g) else { return f64::NAN };
    let mut out = [[[f32::NAN; 1]; 3]; 2];
    Material::of_parameters(IndexOfTint, [exact_r, exact_g].map(Rgb::splat)).over(
        level,
        &[1.0],
        out.each_mut().map(|planes| planes.each_mut().map(|plane| &mut plane[..])),
    );
    let relative = |got: f32, exact: f64| {
        let off = (f64::from(got) - exact).abs();
        if exact == 0.0 { off } else { off / exact }
    };
    larger(relative(out[0][0][0], exact.n), relative(out[1][0][0], exact.k))
}

/// Whole degrees, and what is next to grazing.
fn cosines() -> Vec<f32> {
    let near_grazing = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
    whole_degrees().map(|c| c.get() as f32).chain(near_grazing).collect()
}

/// Every metal of the library at every tenth nanometre.
pub(super) fn digits(level: Level) -> Digits {
    let cosines = cosines();
    let metals: Vec<_> = preferred_metals().collect();
    let of_metal = |metal: &&crate::metal::Metal| {
        let indices: Vec<_> = metal.nk().iter().step_by(10).collect();
        indices.chunks_exact(3).fold(Digits::default(), |worst, triple| {
            let n = Rgb(std::array::from_fn(|channel| triple[channel].n));
            let k = Rgb(std::array::from_fn(|channel| triple[channel].k));
            worst.or(of_index(n, k, &cosines, level))
        })
    };
    metals.par_iter().map(of_metal).reduce(Digits::default, Digits::or)
}

fn of_index(n: Rgb, k: Rgb, cosines: &[f32], level: Level) -> Digits {
    let material = ConductorAndAbsorption::material(n, k);
    let mut out = [(); 2].map(|()| [(); 3].map(|()| vec![f32::NAN; cosines.len()]));
    material.over(level, cosines, out.each_mut().map(|planes| planes.each_mut().map(Vec::as_mut_slice)));
    let mut worst = Digits::default();
    for (at, c) in cosines.iter().enumerate() {
        let [reflected, absorbed] = material.at(f64::from(*c));
        for channel in 0..3 {
            let off = |result: usize, exact: f64| (f64::from(out[result][channel][at]) - exact).abs();
            let (f, a) = (reflected[channel], absorbed[channel]);
            let relative = if a == 0.0 { off(1, a) } else { off(1, a) / a };
            worst = worst.or(Digits { reflectance_ulp: off(0, f) / unit_of_single(f), absorbed_relative: relative });
        }
    }
    worst
}

impl Digits {
    /// The worse of both.
    fn or(self, other: Self) -> Self {
        Self {
            reflectance_ulp: larger(self.reflectance_ulp, other.reflectance_ulp),
            absorbed_relative: larger(self.absorbed_relative, other.absorbed_relative),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 17 units of F; of 1 − F relative 6e-7, at every angle.
    #[test]
    fn metals_keep_their_digits() {
        for level in crate::kernel::levels() {
            let Digits { reflectance_ulp, absorbed_relative } = digits(level);
            assert!(reflectance_ulp <= 17.0 && absorbed_relative <= 6e-7, "{reflectance_ulp} {absorbed_relative}");
            assert!(reflectance_ulp > 0.5, "rounding is seen");
        }
    }

    #[test]
    fn dielectrics_and_edge_tints_keep_theirs() {
        for level in crate::kernel::levels() {
            let (ulp, relative) = (dielectric_ulp(level), index_relative(level));
            assert!((0.5..=10.0).contains(&ulp) && (1e-8..=4e-7).contains(&relative), "{ulp} {relative}");
        }
    }
}
