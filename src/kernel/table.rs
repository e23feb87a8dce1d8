//! A precomputed table of reflectance, read with linear interpolation.

use fearless_simd::{Level, Simd, SimdBase, dispatch};

use super::lanes::Lanes;
use super::{Operations, Real};
use crate::color::Rgb;
use crate::fresnel::CosTheta;

/// A curve at N cosines, even in √c: six times more accurate than even in c, for one square root.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The value at each cosine but the last, and how much larger it is at the next.
    steps: Vec<Step>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    value: [f32; 3],
    rise: [f32; 3],
}

impl Table {
    /// The values of a curve at `size` cosines, at least 2.
    pub fn new(size: usize, curve: impl FnMut(CosTheta) -> Rgb) -> Self {
        let last = size.max(2) - 1;
        let cosine = |index: usize| CosTheta::new((index as f64 / last as f64).powi(2));
        let values: Vec<Rgb> = (0..=last).map(cosine).map(curve).collect();
        let step =
            |pair: &[Rgb]| Step { value: pair[0].0.map(|x| x as f32), rise: (pair[1] - pair[0]).0.map(|x| x as f32) };
        Self { steps: values.windows(2).map(step).collect() }
    }

    /// How many values.
    pub fn size(&self) -> usize {
        self.steps.len() + 1
    }

    /// Bytes of the values; the steps between them are kept here too, but need not be.
    pub fn bytes(&self) -> usize {
        3 * self.size() * size_of::<f32>()
    }

    /// Operations for one RGB value: the place of the cosine, its whole part and rest, and two values of three channels
    /// with what is between.
    pub const OPERATIONS: Operations = Operations {
        sums: 1 + 6,
        products: 1 + 3,
        fused: 3,
        quotients: 0,
        roots: 1,
        powers: 0,
        choices: 2 + 2,
        loads: 2,
    };

    /// At one cosine, held in `[0, 1]`; NaN is NaN.
    pub fn at(&self, c: f32) -> [f32; 3] {
        let place = c.clamp(0.0, 1.0).sqrt() * self.steps.len() as f32;
        // NaN counts as 0 here; the rest keeps it.
        let index = (place as usize).min(self.steps.len() - 1);
        self.steps[index].at(place - index as f32)
    }

    /// At every cosine; the shortest slice ends it.
    pub fn over(&self, level: Level, cosines: &[f32], out: [&mut [f32]; 3]) {
        dispatch!(level, simd => self.over_lanes(simd, cosines, out));
    }

    /// Places in vectors, rows of the table one by one: no instruction set but the newest gathers faster than that.
    #[inline(always)]
    fn over_lanes<S: Simd>(&self, simd: S, cosines: &[f32], [red, green, blue]: [&mut [f32]; 3]) {
        let lanes = Lanes::<S>::COUNT;
        let pixels =
            cosines.chunks(lanes).zip(red.chunks_mut(lanes)).zip(green.chunks_mut(lanes).zip(blue.chunks_mut(lanes)));
        for ((cosines, red), (green, blue)) in pixels {
            let c = if cosines.len() == lanes { Lanes::load(simd, cosines) } else { Lanes::load_some(simd, cosines) };
            let place = c.limited(0.0, 1.0).sqrt() * c.of(self.steps.len() as f64);
            let (indices, rests) = place.whole_and_rest(self.steps.len() - 1);
            let rows = indices.as_slice().iter().zip(rests.as_slice()).zip(cosines);
            for ((((index, rest), _), red), (green, blue)) in rows.zip(red).zip(green.iter_mut().zip(blue)) {
                [*red, *green, *blue] = self.steps[*index as usize].at(*rest);
            }
        }
    }
}

impl Step {
    #[inline(always)]
    fn at(self, rest: f32) -> [f32; 3] {
        std::array::from_fn(
            #[inline(always)]
            |i| self.rise[i] * rest + self.value[i],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::conductor;
    use crate::kernel::levels;

    fn gold(c: CosTheta) -> Rgb {
        Rgb([(0.183, 3.424), (0.421, 2.346), (1.373, 1.770)].map(|(n, k)| conductor(n, k, c)))
    }

    fn error(size: usize, level: Level) -> f64 {
        let cosines: Vec<f32> = (0..=999_u16).map(|i| f32::from(i) / 999.0).chain([-0.5, 1.5]).collect();
        let table = Table::new(size, gold);
        let mut out = [(); 3].map(|()| vec![f32::NAN; cosines.len()]);
        table.over(level, &cosines, out.each_mut().map(Vec::as_mut_slice));
        cosines.iter().enumerate().fold(0.0, |largest, (at, c)| {
            let exact = gold(CosTheta::new(f64::from(*c)));
            let off = |got: [f32; 3]| Rgb(got.map(f64::from)).max_abs_difference(exact);
            let lanes = off(std::array::from_fn(|channel| out[channel][at]));
            crate::number::larger(crate::number::larger(largest, lanes), off(table.at(*c)))
        })
    }

    /// Linear interpolation converges with the square of the size.
    #[test]
    fn four_times_the_size_is_sixteen_times_nearer() {
        for level in levels() {
            let [coarse, fine] = [64, 256].map(|size| error(size, level));
            assert!(fine < coarse / 12.0 && fine < 1e-4, "{coarse} {fine}");
        }
    }

    #[test]
    fn ends_are_exact_and_a_nan_stays_one() {
        let table = Table::new(1, gold);
        assert_eq!(table.size(), 2);
        assert_eq!(table.at(1.0), gold(CosTheta::FACING).0.map(|x| x as f32));
        assert_eq!(table.at(0.0), [1.0; 3]);
        assert!(table.at(f32::NAN).iter().all(|x| x.is_nan()));
        let mut out = [[0.0_f32; 9]; 3];
        table.over(Level::new(), &[f32::NAN; 9], out.each_mut().map(|plane| &mut plane[..]));
        assert!(out.as_flattened().iter().all(|x| x.is_nan()));
    }
}
