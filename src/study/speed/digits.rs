//! How many digits the exact kernels keep on real metals.

use rayon::prelude::*;

use crate::color::Rgb;
use crate::fresnel::whole_degrees;
use crate::kernel::{ConductorAndAbsorption, Level};
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

/// Every metal of the library at every tenth nanometre, at whole degrees and next to grazing.
pub(super) fn digits(level: Level) -> Digits {
    let near_grazing = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
    let cosines: Vec<f32> = whole_degrees().map(|c| c.get() as f32).chain(near_grazing).collect();
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
}
