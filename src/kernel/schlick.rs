//! Schlick's approximation (Schlick 1994), as in [`crate::fresnel::schlick`], and no approximation at all.

use super::{Form, Material, Real, held};
use crate::color::Rgb;

/// r + x⁵ (1 − r), from r and 1 − r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schlick;

impl Schlick {
    /// The curve of one material. Values beyond ±1e30 are held there.
    pub fn material(r: Rgb) -> Material<Self, 2> {
        Material::new(Self, r.0.map(|r| [held(r), 1.0 - held(r)]))
    }
}

impl Form<2> for Schlick {
    const STEPS: usize = 4;

    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        (c.of(1.0) - c).fifth_power()
    }

    #[inline(always)]
    fn channel<T: Real>(self, x5: T, [r, white_minus_r]: [T; 2]) -> [T; 1] {
        [x5.mul_add(white_minus_r, r)]
    }
}

/// r at every angle: no Fresnel term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant;

impl Constant {
    /// The curve of one material.
    pub fn material(r: Rgb) -> Material<Self, 1> {
        Material::new(Self, r.0.map(|r| [held(r)]))
    }
}

impl Form<1> for Constant {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), r: [T; 1]) -> [T; 1] {
        r
    }
}

/// Schlick from r alone: for textures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickOfPixels;

impl Form<1> for SchlickOfPixels {
    const STEPS: usize = 4;

    const HOLDS_PIXELS: Option<f64> = Some(1e30);

    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        Schlick.shared(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, x5: T, [r]: [T; 1]) -> [T; 1] {
        [x5.mul_add(x5.of(1.0) - r, r)]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{CosTheta, schlick};
    use crate::kernel::test_support::{distance, finite};

    proptest! {
        #[test]
        fn is_the_core_within_a_millionth(r in prop::array::uniform3(0.0..=1.0)) {
            let off = distance(&Schlick::material(Rgb(r)), |channel, c| schlick(r[channel], CosTheta::new(c)));
            prop_assert!(off <= 1e-6, "{off}");
        }

        #[test]
        fn is_total(r in finite(), c in finite()) {
            let curve = Schlick::material(Rgb::splat(f64::from(r)));
            prop_assert!(curve.at(c)[0].iter().all(|f| f.is_finite()));
        }
    }
}
