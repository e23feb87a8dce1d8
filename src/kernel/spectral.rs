//! The spectral model: exact Fresnel equations at N wavelengths, and an RGB weight for each.

use fearless_simd::{Level, Simd, dispatch};

use super::Real;
use super::conductor::{Angle, constants};
use super::form::each_chunk;
use super::operations::{Counted, Operations};
use crate::color::Rgb;
use crate::fresnel::Nk;

/// The constants of a conductor, and its weight of each channel.
type Wavelength = ([f32; 6], [f32; 3]);

/// One material at N wavelengths, in 32 bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectral {
    /// One after the other.
    wavelengths: Vec<Wavelength>,
}

impl Spectral {
    /// n and k at each wavelength and its RGB weight; negative n or k are held at 0, those beyond 1e9 there.
    pub fn new(wavelengths: impl IntoIterator<Item = (Nk, Rgb)>) -> Self {
        let in_32_bits =
            |(Nk { n, k }, weight): (Nk, Rgb)| (constants(n, k).map(|x| x as f32), weight.0.map(|x| x as f32));
        Self { wavelengths: wavelengths.into_iter().map(in_32_bits).collect() }
    }

    /// How many wavelengths.
    pub fn count(&self) -> usize {
        self.wavelengths.len()
    }

    /// Bytes of constants and weights.
    pub fn bytes(&self) -> usize {
        size_of_val(self.wavelengths.as_slice())
    }

    /// Operations for one RGB value of so many wavelengths.
    pub fn operations_of(count: usize) -> Operations {
        let angle = || Angle::of(Counted.limited(0.0, 1.0));
        let mut all = Operations::while_running(|| {
            angle();
        });
        let angle = angle();
        let each = Operations::while_running(|| add(&mut [Counted; 3], angle, &Wavelength::default()));
        (0..count).for_each(|_| all += each);
        all
    }

    /// At one cosine, held in `[0, 1]`.
    #[inline(always)]
    pub fn at<T: Real>(&self, c: T) -> [T; 3] {
        let angle = Angle::of(c.limited(0.0, 1.0));
        let mut sum = [c.of(0.0); 3];
        for wavelength in &self.wavelengths {
            add(&mut sum, angle, wavelength);
        }
        sum
    }

    /// At every cosine; the shortest slice ends it.
    pub fn over(&self, level: Level, cosines: &[f32], out: [&mut [f32]; 3]) {
        dispatch!(level, simd => self.over_lanes(simd, cosines, out));
    }

    #[inline(always)]
    fn over_lanes<S: Simd>(&self, simd: S, cosines: &[f32], out: [&mut [f32]; 3]) {
        each_chunk(
            simd,
            1,
            (cosines, []),
            [out],
            #[inline(always)]
            |c, _| [self.at(c)],
        );
    }
}

/// Adds what one wavelength reflects.
#[inline(always)]
fn add<T: Real>(sum: &mut [T; 3], angle: Angle<T>, (constants, weights): &Wavelength) {
    let kind = sum[0];
    // Not `map`: an array of vectors is not passed on in registers where that is a call.
    let mut vectors = [kind; 6];
    for (vector, x) in vectors.iter_mut().zip(constants) {
        *vector = kind.of(f64::from(*x));
    }
    let reflectance = angle.parts(vectors).reflectance();
    for (sum, weight) in sum.iter_mut().zip(weights) {
        *sum = reflectance.mul_add(kind.of(f64::from(*weight)), *sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{CosTheta, conductor};
    use crate::kernel::levels;

    #[test]
    fn each_wavelength_divides_once_and_has_two_roots() {
        let (few, many) = (Spectral::operations_of(3), Spectral::operations_of(20));
        assert_eq!((few.quotients, few.roots, many.quotients, many.roots), (3, 6, 20, 40));
    }

    #[test]
    fn is_the_weighted_sum_of_conductors() {
        let wavelengths: Vec<(Nk, Rgb)> = (0..31_u8)
            .map(|i| f64::from(i) / 30.0)
            .map(|x| (Nk { n: 0.1 + 1.4 * x, k: 4.0 - 2.0 * x }, Rgb([x, 1.0 - x, 0.3]) * (1.0 / 15.0)))
            .collect();
        let spectral = Spectral::new(wavelengths.iter().copied());
        let cosines: Vec<f32> = (0..=100_u8).map(|i| f32::from(i) / 100.0).collect();
        for level in levels() {
            let mut out = [(); 3].map(|()| vec![f32::NAN; cosines.len()]);
            spectral.over(level, &cosines, out.each_mut().map(Vec::as_mut_slice));
            for (at, c) in cosines.iter().enumerate() {
                let cos = CosTheta::new(f64::from(*c));
                let exact =
                    wavelengths.iter().fold(Rgb::BLACK, |sum, (nk, weight)| sum + *weight * conductor(nk.n, nk.k, cos));
                for got in [std::array::from_fn(|channel| out[channel][at]), spectral.at(*c)] {
                    let off = Rgb(got.map(f64::from)).max_abs_difference(exact);
                    assert!(off < 2e-6, "{level:?} {c}: {off}");
                }
            }
        }
    }
}
