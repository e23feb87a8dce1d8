//! Functions of the angle, read for every pixel.

/// Equal steps of cos θ between which a function is straight: what it bends there is below 1e-5 for the weights of r
/// and h, and beyond 81.8° below 3e-5.
const STEPS: usize = 1024;

/// Where the functions of an angle are found: 1 + cos θ, below 2. The upper bits of its significand are the step.
pub(super) fn place(cosine: f32) -> f32 {
    const LAST: f32 = 2.0 - f32::EPSILON;
    (1.0 + cosine).min(LAST)
}

/// cos θ where steps begin, and where the last one ends.
pub(super) fn cosines() -> impl Iterator<Item = f64> {
    (0..=STEPS).map(|step| step as f64 / STEPS as f64)
}

fn step(place: f32) -> usize {
    const UNUSED_BITS: u32 = f32::MANTISSA_DIGITS - 1 - STEPS.ilog2();
    (place.to_bits() >> UNUSED_BITS) as usize % STEPS
}

/// `N` functions of the angle.
#[derive(Debug)]
pub(super) struct Radial<const N: usize>(Box<[Line<N>; STEPS]>);

/// Straight lines over [`place`].
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
struct Line<const N: usize> {
    at_zero: [f32; N],
    slope: [f32; N],
}

impl<const N: usize> Radial<N> {
    /// From their values at [`cosines`].
    pub fn of(values: impl Iterator<Item = [f64; N]>) -> Self {
        let values: Vec<[f64; N]> = values.collect();
        let line = |step: usize| {
            let slope: [f32; N] =
                std::array::from_fn(|i| ((values[step + 1][i] - values[step][i]) * STEPS as f64) as f32);
            // Through the middle of the step, so that what 32 bits cost the slope is least.
            let place = 1.0 + (step as f64 + 0.5) / STEPS as f64;
            let at_zero = |i: usize| 0.5 * (values[step][i] + values[step + 1][i]) - place * f64::from(slope[i]);
            Line { at_zero: std::array::from_fn(|i| at_zero(i) as f32), slope }
        };
        Self(Box::new(std::array::from_fn(line)))
    }

    /// Their values at a [`place`].
    #[inline]
    pub fn at(&self, place: f32) -> [f32; N] {
        let Line { at_zero, slope } = &self.0[step(place)];
        std::array::from_fn(|i| at_zero[i] + place * slope[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{CosTheta, Weights};

    #[test]
    fn weights_are_near_their_formula() {
        let of = |cosine: f64| Weights::at(CosTheta::new(cosine));
        let table = Radial::of(cosines().map(|cosine| [of(cosine).of_r, of(cosine).of_h]));
        for i in 0..=10_000_u16 {
            let cosine = f32::from(i) / 10_000.0;
            let (exact, found) = (of(f64::from(cosine)), table.at(place(cosine)));
            for (exact, found) in [exact.of_r, exact.of_h].into_iter().zip(found) {
                // The curvature of h's weight is 212 at 90° and falls to 57 at 81.8°.
                let limit = if cosine < 1.0 / 7.0 { 3e-5 } else { 1e-5 };
                assert!((exact - f64::from(found)).abs() < limit, "{cosine}: {exact} {found}");
            }
        }
    }
}
