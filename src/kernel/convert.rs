//! Conversions of parameters as formulas without an angle: over textures, and to be measured.

use super::conductor::Index;
use super::{Form, Real};
use crate::fresnel::SCHLICK_WEIGHT_AT_MAX;

/// t of r and h: h / S(r, 1/7). Where S is below 1e-6, which is at r = −0.86, it is held there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TintOfEdge;

/// h of r and t: t · S(r, 1/7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeOfTint;

/// n and k of r and g, held as [`GulbrandsenOfPixels`](super::GulbrandsenOfPixels) says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndexOfTint;

/// r and g of n and k, each held in 0 to 1e9, as [`crate::fresnel::r_g_from_nk`]. g of air, n = 1 and k = 0, is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TintOfIndex;

/// S(r, 1/7).
#[inline(always)]
fn schlick_at_theta_max<T: Real>(r: T) -> T {
    r.mul_add(r.of(1.0 - SCHLICK_WEIGHT_AT_MAX), r.of(SCHLICK_WEIGHT_AT_MAX))
}

impl Form<2> for TintOfEdge {
    const HOLDS_PIXELS: Option<f64> = Some(1e30);

    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), [r, h]: [T; 2]) -> [T; 1] {
        let (schlick, least) = (schlick_at_theta_max(r), r.of(1e-6));
        [h / schlick.abs().if_below(least, least, schlick)]
    }
}

impl Form<2> for EdgeOfTint {
    const HOLDS_PIXELS: Option<f64> = Some(1e15);

    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), [r, t]: [T; 2]) -> [T; 1] {
        [t * schlick_at_theta_max(r)]
    }
}

impl Form<2, 2> for IndexOfTint {
    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), [r, g]: [T; 2]) -> [T; 2] {
        let Index { n, k, .. } = Index::of_r_g(r, g);
        [n, k]
    }
}

impl Form<2, 2> for TintOfIndex {
    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), [n, k]: [T; 2]) -> [T; 2] {
        let (zero, one, two) = (n.of(0.0), n.of(1.0), n.of(2.0));
        let (n, k) = (n.limited(0.0, 1e9), k.limited(0.0, 1e9));
        let (below, above) = (n - one, n + one);
        let d2 = above.mul_add(above, k * k);
        let r = below.mul_add(below, k * k) / d2;
        let m = two * n / ((one + r.sqrt()) * d2.sqrt());
        let range = one - two * two * m * m / ((one + r) * d2);
        [r, zero.if_below(range, (one - m) * (one + m) / range, zero)]
    }
}
