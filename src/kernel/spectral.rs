//! The spectral model: exact Fresnel equations at N wavelengths, and an RGB weight for each.

use fearless_simd::{Level, Simd, dispatch};

use super::Real;
use super::form::each_chunk;
use super::index::{Angle, AnyIndex, Index, Metal, Parts, are_of_metal, constants, constants_of_metal};
use super::operations::{Counted, Operations};
use crate::color::Rgb;
use crate::fresnel::Nk;

/// One material at N wavelengths, in 32 bits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectral {
    /// Those at which k ≥ n.
    metals: Vec<Wavelength<3>>,
    others: Vec<Wavelength<6>>,
}

/// The constants of an index, and its weight of each channel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wavelength<const P: usize> {
    constants: [f32; P],
    weights: [f32; 3],
}

impl Spectral {
    /// n and k at each wavelength and its RGB weight; negative n or k are held at 0, those beyond 1e9 there.
    pub fn new(wavelengths: impl IntoIterator<Item = (Nk, Rgb)>) -> Self {
        let mut all = Self::default();
        for (Nk { n, k }, weight) in wavelengths {
            let (constants, weights) = (constants(n, k), weight.0.map(|x| x as f32));
            let in_32_bits = constants.map(|x| x as f32);
            if are_of_metal(&constants) {
                all.metals.push(Wavelength { constants: constants_of_metal(in_32_bits), weights });
            } else {
                all.others.push(Wavelength { constants: in_32_bits, weights });
            }
        }
        all
    }

    /// How many wavelengths.
    pub fn count(&self) -> usize {
        self.metals.len() + self.others.len()
    }

    /// Bytes of constants and weights.
    pub fn bytes(&self) -> usize {
        size_of_val(self.metals.as_slice()) + size_of_val(self.others.as_slice())
    }

    /// Operations for one RGB value.
    pub fn operations(&self) -> Operations {
        Operations::while_running(|| {
            self.at(Counted);
        })
    }

    /// Operations for one RGB value of so many wavelengths, whatever n and k are there.
    pub fn operations_of(count: usize) -> Operations {
        Self { metals: Vec::new(), others: vec![Wavelength { constants: [0.0; 6], weights: [0.0; 3] }; count] }
            .operations()
    }

    /// At one cosine, held in `[0, 1]`.
    #[inline(always)]
    pub fn at<T: Real>(&self, c: T) -> [T; 3] {
        let angle = Angle::of(c.limited(0.0, 1.0));
        let mut sum = [c.of(0.0); 3];
        add_all::<T, Metal<T>, 3>(&mut sum, angle, &self.metals);
        add_all::<T, AnyIndex<T>, 6>(&mut sum, angle, &self.others);
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

/// Adds what all wavelengths reflect. Of four in a row the first is added while the next is divided and a root is taken of
/// each of the two after it: with one finished before the next, a processor that sees only some dozen operations ahead
/// would wait.
#[inline(always)]
fn add_all<T: Real, I: Index<T, P>, const P: usize>(sum: &mut [T; 3], angle: Angle<T>, all: &[Wavelength<P>]) {
    let kind = sum[0];
    let [first, second, third, ..] = all else {
        for wavelength in all {
            wavelength.add(sum, reflectance(wavelength.index::<T, I>(kind).parts_at(angle)));
        }
        return;
    };
    let mut parts = first.index::<T, I>(kind).parts_at(angle);
    let mut root = second.index::<T, I>(kind).root_at(angle);
    let mut modulus = third.index::<T, I>(kind).modulus(angle);
    for [added, divided, rooted, begun] in all.array_windows() {
        let reflectance = reflectance(parts);
        parts = divided.index::<T, I>(kind).parts(angle, root);
        root = rooted.index::<T, I>(kind).root(modulus);
        modulus = begun.index::<T, I>(kind).modulus(angle);
        added.add(sum, reflectance);
    }
    let [.., added, divided, rooted] = all else { return };
    added.add(sum, reflectance(parts));
    divided.add(sum, reflectance(divided.index::<T, I>(kind).parts(angle, root)));
    let rooted_index = rooted.index::<T, I>(kind);
    rooted.add(sum, reflectance(rooted_index.parts(angle, rooted_index.root(modulus))));
}

#[inline(always)]
fn reflectance<T: Real>(parts: Parts<T>) -> T {
    let [above, below] = parts.quotient();
    above.nearly_over(below)
}

impl<const P: usize> Wavelength<P> {
    #[inline(always)]
    fn index<T: Real, I: Index<T, P>>(&self, kind: T) -> I {
        // Not `map`: an array of vectors is not passed on in registers where that is a call.
        let mut vectors = [kind; P];
        for (vector, x) in vectors.iter_mut().zip(self.constants) {
            *vector = kind.of(f64::from(x));
        }
        I::of(vectors)
    }

    #[inline(always)]
    fn add<T: Real>(&self, sum: &mut [T; 3], reflectance: T) {
        for (sum, weight) in sum.iter_mut().zip(self.weights) {
            *sum = reflectance.mul_add(reflectance.of(f64::from(weight)), *sum);
        }
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
        (0..40).for_each(is_the_sum_of);
    }

    /// About half of the wavelengths have k < n, so that both loops come to every length from none.
    fn is_the_sum_of(count: u8) {
        let wavelengths: Vec<(Nk, Rgb)> = (0..count)
            .map(|i| f64::from(i) / 40.0)
            .map(|x| (Nk { n: 0.1 + 5.0 * x, k: 4.0 - 2.0 * x }, Rgb([x, 1.0 - x, 0.3]) * (1.0 / 40.0)))
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
