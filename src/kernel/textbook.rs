//! The same models as textbooks, papers and renderers print them: what ours are measured against, not to be used.

use fearless_simd::{Level, Simd, dispatch};

use super::form::each_chunk;
use super::{Form, Material, Real};
use crate::color::Rgb;
use crate::fresnel::{PEAK_GAIN, SCHLICK_GAIN};

/// Schlick with `pow`, as shaders have it: NaN for a cosine slightly above 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickByPower;

impl Form<1> for SchlickByPower {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        (c.of(1.0) - c).power(5.0)
    }

    #[inline(always)]
    fn channel<T: Real>(self, x5: T, [r]: [T; 1]) -> [T; 1] {
        [r + (x5.of(1.0) - r) * x5]
    }
}

/// Hoffman's eqs. 2 and 4 as printed, with `a` at every evaluation and `pow`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoffmanAsPrinted;

impl Form<2> for HoffmanAsPrinted {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        let x = c.of(1.0) - c;
        (x.power(5.0), c * x.power(6.0))
    }

    #[inline(always)]
    fn channel<T: Real>(self, (x5, bump): (T, T), [r, h]: [T; 2]) -> [T; 1] {
        let white_minus_r = r.of(1.0) - r;
        let a = r.of(PEAK_GAIN) * (r - h) + r.of(SCHLICK_GAIN) * white_minus_r;
        [r + white_minus_r * x5 - a * bump]
    }
}

/// F82-tint as OpenPBR and MaterialX print it: Schlick less a share of what it is at 1/7, with `pow`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82AsPrinted;

impl Form<2> for F82AsPrinted {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = (T, T);

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> (T, T) {
        HoffmanAsPrinted.shared(c)
    }

    #[inline(always)]
    fn channel<T: Real>(self, (x5, bump): (T, T), [r, t]: [T; 2]) -> [T; 1] {
        let one = r.of(1.0);
        let [c, x] = [1.0 / 7.0, 6.0 / 7.0].map(
            #[inline(always)]
            |value| r.of(value),
        );
        let at_max = r + (one - r) * x.power(5.0);
        [r + (one - r) * x5 - at_max * (one - t) * bump / (c * x.power(6.0))]
    }
}

/// The conductor as most renderers have it: two square roots, two divisions, and a = √((A + t0)/2), which cancels.
///
/// (Lagarde 2013, "Memo on Fresnel equations", and many shaders since.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PopularConductor;

impl PopularConductor {
    /// n and k of each channel.
    pub fn material(n: Rgb, k: Rgb) -> Material<Self, 2> {
        Material::new(Self, std::array::from_fn(|i| [n[i], k[i]]))
    }
}

impl Form<2> for PopularConductor {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        c
    }

    #[inline(always)]
    fn channel<T: Real>(self, c: T, [n, k]: [T; 2]) -> [T; 1] {
        let (zero, half) = (c.of(0.0), c.of(0.5));
        let (n2, k2, c2) = (n * n, k * k, c * c);
        let s2 = c.of(1.0) - c2;
        let t0 = n2 - k2 - s2;
        let modulus = (t0 * t0 + c.of(4.0) * n2 * k2).sqrt();
        let a2 = half * (modulus + t0);
        let a = a2.if_below(zero, zero, a2).sqrt();
        let (t1, t2) = (modulus + c2, (c + c) * a);
        let s = (t1 - t2) / (t1 + t2);
        let (t3, t4) = (c2 * modulus + s2 * s2, t2 * s2);
        let p = s * (t3 - t4) / (t3 + t4);
        [half * (s + p)]
    }
}

/// The conductor by complex arithmetic as pbrt-v4 has it (`FrComplex` in `src/pbrt/util/scattering.h`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComplexConductor;

impl ComplexConductor {
    /// n and k of each channel.
    pub fn material(n: Rgb, k: Rgb) -> Material<Self, 2> {
        Material::new(Self, std::array::from_fn(|i| [n[i], k[i]]))
    }
}

impl Form<2> for ComplexConductor {
    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        c
    }

    #[inline(always)]
    fn channel<T: Real>(self, c: T, [n, k]: [T; 2]) -> [T; 1] {
        let (zero, one) = (c.of(0.0), c.of(1.0));
        let eta = Complex { re: n, im: k };
        let sin2 = Complex { re: one - c * c, im: zero }.over(eta.times(eta));
        let cos = Complex { re: one - sin2.re, im: -sin2.im }.root();
        let (along, across) = (Complex { re: eta.re * c, im: eta.im * c }, eta.times(cos));
        let p = along.minus(cos).over(along.plus(cos));
        let i = Complex { re: c, im: zero };
        let s = i.minus(across).over(i.plus(across));
        [(p.squared() + s.squared()) * c.of(0.5)]
    }
}

#[derive(Clone, Copy)]
struct Complex<T> {
    re: T,
    im: T,
}

impl<T: Real> Complex<T> {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }

    #[inline(always)]
    fn over(self, other: Self) -> Self {
        let scale = self.re.of(1.0) / other.squared();
        Self {
            re: scale * (self.re * other.re + self.im * other.im),
            im: scale * (self.im * other.re - self.re * other.im),
        }
    }

    #[inline(always)]
    fn squared(self) -> T {
        self.re * self.re + self.im * self.im
    }

    #[inline(always)]
    fn root(self) -> Self {
        let (zero, half) = (self.re.of(0.0), self.re.of(0.5));
        let large = (half * (self.squared().sqrt() + self.re.abs())).sqrt();
        let small = half * self.im / large;
        let signed = self.im.if_below(zero, -large, large);
        Self { re: self.re.if_below(zero, small.abs(), large), im: self.re.if_below(zero, signed, small) }
    }
}

/// Gulbrandsen's eqs. 6 and 8 as printed, then the popular conductor: k² cancels near g = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GulbrandsenAsPrinted;

impl Form<2> for GulbrandsenAsPrinted {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        c
    }

    #[inline(always)]
    fn channel<T: Real>(self, c: T, [r, g]: [T; 2]) -> [T; 1] {
        let (n, k) = index_as_printed(r, g);
        PopularConductor.channel(c, [n, k])
    }
}

/// n and k of r and g as printed (Gulbrandsen 2014, eqs. 6 and 8).
#[inline(always)]
pub fn index_as_printed<T: Real>(r: T, g: T) -> (T, T) {
    let one = r.of(1.0);
    let s = r.sqrt();
    let n = g * (one - r) / (one + r) + (one - g) * (one + s) / (one - s);
    let (above, below) = (n + one, n - one);
    (n, ((r * above * above - below * below) / (one - r)).sqrt())
}

/// The dielectric of textbooks, by Snell's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricAsPrinted;

impl Form<1> for DielectricAsPrinted {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        c
    }

    #[inline(always)]
    fn channel<T: Real>(self, c: T, [n]: [T; 1]) -> [T; 1] {
        let one = c.of(1.0);
        let inside = (one - (one - c * c) / (n * n)).sqrt();
        let p = (n * c - inside) / (n * c + inside);
        let s = (c - n * inside) / (c + n * inside);
        [(p * p + s * s) / c.of(2.0)]
    }
}

/// No model: two square roots and one division per channel, the least an exact conductor needs. A bound for time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DividerBound;

impl DividerBound {
    /// Any numbers above 0.
    pub fn material(x: Rgb, y: Rgb) -> Material<Self, 2> {
        Material::new(Self, std::array::from_fn(|i| [x[i], y[i]]))
    }
}

impl Form<2> for DividerBound {
    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        c
    }

    #[inline(always)]
    fn channel<T: Real>(self, c: T, [x, y]: [T; 2]) -> [T; 1] {
        let (first, second) = (c + x, c + y);
        [first.sqrt() + second.sqrt() + x / second]
    }
}

/// No model: two square roots and one division for each of N wavelengths, the least a spectral sum needs. A bound for
/// time.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralDividerBound {
    wavelengths: Vec<[f32; 2]>,
}

impl SpectralDividerBound {
    /// For so many wavelengths.
    pub fn new(count: usize) -> Self {
        Self { wavelengths: (1..=count).map(|i| [i as f32, 0.5 + i as f32]).collect() }
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
            |c, _| [[self.sum(c); 3]],
        );
    }

    #[inline(always)]
    fn sum<T: Real>(&self, c: T) -> T {
        let mut sum = c.of(0.0);
        for wavelength in &self.wavelengths {
            let [x, y] = wavelength.map(
                #[inline(always)]
                |x| c.of(f64::from(x)),
            );
            sum = sum + DividerBound.channel(c, [x, y])[0];
        }
        sum
    }
}

/// n and k of r and g by [`index_as_printed`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndexAsPrinted;

impl Form<2, 2> for IndexAsPrinted {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), [r, g]: [T; 2]) -> [T; 2] {
        let (n, k) = index_as_printed(r, g);
        [n, k]
    }
}

/// r and g of n and k as printed (Gulbrandsen 2014, eqs. 5 and 7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TintAsPrinted;

impl Form<2, 2> for TintAsPrinted {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), [n, k]: [T; 2]) -> [T; 2] {
        let one = n.of(1.0);
        let (above, below) = (n + one, n - one);
        let r = (below * below + k * k) / (above * above + k * k);
        let s = r.sqrt();
        let (least, most) = ((one - r) / (one + r), (one + s) / (one - s));
        [r, (most - n) / (most - least)]
    }
}
