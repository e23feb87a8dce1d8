//! F of an index n − i k, and what is absorbed, with one division and no cancellation, in steps that end at a root.
//!
//! With ε − sin²θ = e + 2 i n k of modulus z, whose root a + i b has the larger part q, and t1 = (z + c²) q,
//! t3 = (z c² + s⁴) q, T = 2 c a q: F = (t1 − T) t3 / ((t1 + T)(t3 + T s²)), and 1 − F = T (2 t3 + s² (t1 + T)) over
//! the same, a sum of what is positive. It rests on 1 + (t3 − t4)/(t3 + t4) = 2 t3/(t3 + t4), which saves a division,
//! and on everything being multiplied by q, so that a = n k/b needs none either: a q is the larger of a b = n k and
//! a² = (z + e)/2. Where e is negative and a² cancels, it is taken a little too small, so that n k is the larger.
//!
//! z, e, c² and s⁴ are halved, which is exact and saves two products; c3 = 1/max(1, n, k) keeps all in 32 bits. For
//! n² − k² < 1/2, e is taken as (n² − k²) − sin²θ: next to n = k = 0 the other sum, (n² − k² − 1) + c², cancels.
//!
//! Where k ≥ n, as in most metals, e is negative at every angle. Then q = b and T = 2 c n k, with nothing to choose, and
//! with x = T q, P = z + c², S = z c² + s⁴ and c² + s² = 1, multiplied by q once more: F is S (q² P − x) and 1 − F is
//! x (S + z + s²) + T² s² of their sum.

use super::Real;

/// The largest n or k: beyond it the fourth power leaves 32 bits. F is 1 there but for a hair's breadth of grazing.
pub(super) const LARGEST: f64 = 1e9;

/// Up to where products of n and k need no scale of their own to stay within 32 bits.
const LARGEST_UNSCALED: f64 = 1e6;

/// The least (n k)². It keeps z from 0, so that air in air at 90° and the critical angle are no 0/0, and is too small
/// to be seen in any sum of 32 bits.
pub(super) const NO_ZERO: f64 = 1e-36;

/// Half of n² − k² or of n² − k² − 1, how often c² and sin² are to be added to that, (n k)², n k and c3 of an index.
pub(super) type Constants<T> = [T; 6];

/// n = 0 and k = 1: F is 1 at every angle.
pub(super) const MIRROR: Constants<f64> = [-0.5, 0.0, -1.0, NO_ZERO, 0.0, 1.0];

/// Of an index; negative n or k are held at 0, those beyond 1e9 there. No index at all, n = k = 0, is a mirror as in
/// [`crate::fresnel::conductor`].
pub(super) fn constants(n: f64, k: f64) -> Constants<f64> {
    let (n, k) = (n.clamp(0.0, LARGEST), k.clamp(0.0, LARGEST));
    if n == 0.0 && k == 0.0 {
        return MIRROR;
    }
    let c3 = 1.0 / n.max(k).max(1.0);
    let real = (n - k) * (n + k);
    let (base, of_c2, of_s2) = if real < 0.5 { (real, 0.0, -1.0) } else { ((n - 1.0) * (n + 1.0) - k * k, 1.0, 0.0) };
    [0.5 * base, of_c2, of_s2, (n * k).powi(2).max(NO_ZERO), n * k, c3]
}

/// Whether they are those of a [`Metal`]: k ≥ n, and neither too large to do without a scale.
pub(super) fn are_of_metal(constants: &Constants<f64>) -> bool {
    let [base, of_c2, _, _, _, c3] = *constants;
    base <= 0.0 && of_c2 == 0.0 && c3 >= 1.0 / LARGEST_UNSCALED
}

/// c, c² and sin², and halves of them and of sin⁴.
#[derive(Clone, Copy, Debug)]
pub struct Angle<T> {
    c: T,
    c2: T,
    s2: T,
    pub(super) half_c2: T,
    half_s2: T,
    half_s4: T,
}

impl<T: Real> Angle<T> {
    #[inline(always)]
    pub(super) fn of(c: T) -> Self {
        let (one, half) = (c.of(1.0), c.of(0.5));
        let (c2, s2) = (c * c, sine_squared(c, one));
        let half_s2 = s2 * half;
        Self { c, c2, s2, half_c2: c2 * half, half_s2, half_s4: s2 * half_s2 }
    }

    /// c² sin², which only a metal's 1 − F needs.
    #[inline(always)]
    pub(super) fn c2_s2(self) -> T {
        self.c2 * self.s2
    }
}

/// sin² of the angle with cosine c, without cancellation at 0°.
#[inline(always)]
pub(super) fn sine_squared<T: Real>(c: T, one: T) -> T {
    (one - c) * (one + c)
}

/// An index, and the steps to its F. All but the first begin with the root that the step before ends with, so that a loop
/// over many can let one wait while it begins the next.
pub(super) trait Index<T: Real, const P: usize>: Copy {
    /// Of its constants.
    fn of(constants: [T; P]) -> Self;

    /// To the first root.
    fn modulus(self, angle: Angle<T>) -> Modulus<T>;

    /// To the second.
    fn root(self, modulus: Modulus<T>) -> Root<T>;

    /// To what F is made of.
    fn parts(self, angle: Angle<T>, root: Root<T>) -> Parts<T>;

    /// The first and the second.
    #[inline(always)]
    fn root_at(self, angle: Angle<T>) -> Root<T> {
        self.root(self.modulus(angle))
    }

    /// All of them.
    #[inline(always)]
    fn parts_at(self, angle: Angle<T>) -> Parts<T> {
        self.parts(angle, self.root_at(angle))
    }
}

/// Half of e, or of −e where k ≥ n, and half of z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Modulus<T> {
    e: T,
    z: T,
}

/// Half of z, q c3, and a q; q² where k ≥ n.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root<T> {
    z: T,
    q: T,
    product: T,
}

impl<T: Real> Modulus<T> {
    /// From e/2 and (n k)².
    #[inline(always)]
    pub(super) fn of(e: T, nk2: T) -> Self {
        Self { e, z: e.mul_add(e, nk2).sqrt() }
    }

    #[inline(always)]
    pub(super) fn root(self, nk: T, c3: T) -> Root<T> {
        let Self { e, z } = self;
        // A unit in the last place more of a negative part than rounding can have put into z.
        let product = e.mul_add(e.above_one(), z).larger(nk);
        Root { z, q: (z + e.abs()).sqrt() * c3, product }
    }
}

impl<T: Real> Root<T> {
    #[inline(always)]
    pub(super) fn parts(self, angle: Angle<T>, c3: T) -> Parts<T> {
        Parts::of(angle, self, angle.c * c3 * self.product)
    }
}

/// Any index, k < n among them.
#[derive(Clone, Copy, Debug)]
pub(super) struct AnyIndex<T> {
    base: T,
    of_c2: T,
    of_s2: T,
    nk2: T,
    nk: T,
    c3: T,
}

impl<T: Real> Index<T, 6> for AnyIndex<T> {
    #[inline(always)]
    fn of([base, of_c2, of_s2, nk2, nk, c3]: Constants<T>) -> Self {
        Self { base, of_c2, of_s2, nk2, nk, c3 }
    }

    #[inline(always)]
    fn modulus(self, angle: Angle<T>) -> Modulus<T> {
        let e = self.of_c2.mul_add(angle.half_c2, self.of_s2.mul_add(angle.half_s2, self.base));
        Modulus::of(e, self.nk2)
    }

    #[inline(always)]
    fn root(self, modulus: Modulus<T>) -> Root<T> {
        modulus.root(self.nk, self.c3)
    }

    #[inline(always)]
    fn parts(self, angle: Angle<T>, root: Root<T>) -> Parts<T> {
        root.parts(angle, self.c3)
    }
}

/// An index with k ≥ n, of at most 1e6.
#[derive(Clone, Copy, Debug)]
pub(super) struct Metal<T> {
    base: T,
    nk2: T,
    nk: T,
}

/// Those of [`Constants`] that a metal needs.
pub(super) const fn constants_of_metal<T: Copy>([base, _, _, nk2, nk, _]: Constants<T>) -> [T; 3] {
    [base, nk2, nk]
}

impl<T: Real> Index<T, 3> for Metal<T> {
    #[inline(always)]
    fn of([base, nk2, nk]: [T; 3]) -> Self {
        Self { base, nk2, nk }
    }

    #[inline(always)]
    fn modulus(self, angle: Angle<T>) -> Modulus<T> {
        Modulus::of(angle.half_s2 - self.base, self.nk2)
    }

    #[inline(always)]
    fn root(self, Modulus { e, z }: Modulus<T>) -> Root<T> {
        let square = z + e;
        Root { z, q: square.sqrt(), product: square }
    }

    #[inline(always)]
    fn parts(self, angle: Angle<T>, root: Root<T>) -> Parts<T> {
        Parts::of(angle, root, angle.c * self.nk)
    }
}

impl<T: Real> Metal<T> {
    /// F and 1 − F. Where k ≥ n, F is at least .17 (facing, n = k = .71), so that it loses two or three bits as the rest of 1.
    #[inline(always)]
    pub(super) fn reflectance_and_absorption(self, angle: Angle<T>, c2_s2: T) -> [T; 2] {
        let Root { z, q, product: square } = self.root(self.modulus(angle));
        let x = q * (angle.c * self.nk);
        let s = z.mul_add(angle.c2, angle.half_s4);
        let reflected = square.mul_sub(z + angle.half_c2, x) * s;
        let absorbed = x.mul_add(s + (z + angle.half_s2), c2_s2 * self.nk2);
        let absorption = absorbed / (reflected + absorbed);
        [absorption.of(1.0) - absorption, absorption]
    }
}

/// See the head of this file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<T> {
    t: T,
    t1: T,
    t3: T,
    s2: T,
}

impl<T: Real> Parts<T> {
    #[inline(always)]
    fn of(angle: Angle<T>, Root { z, q, .. }: Root<T>, t: T) -> Self {
        let t1 = (z + angle.half_c2) * q;
        let t3 = z.mul_add(angle.c2, angle.half_s4) * q;
        Self { t, t1, t3, s2: angle.s2 }
    }

    /// F as what is still to be divided.
    #[inline(always)]
    pub(super) fn quotient(self) -> [T; 2] {
        [(self.t1 - self.t) * self.t3, (self.t1 + self.t) * self.t.mul_add(self.s2, self.t3)]
    }

    #[inline(always)]
    pub(super) fn reflectance(self) -> T {
        let [above, below] = self.quotient();
        above / below
    }

    #[inline(always)]
    pub(super) fn reflectance_and_absorption(self) -> [T; 2] {
        let [above, below] = self.quotient();
        let share = self.t.of(1.0) / below;
        [above * share, self.t * self.s2.mul_add(self.t1 + self.t, self.t3 + self.t3) * share]
    }
}
