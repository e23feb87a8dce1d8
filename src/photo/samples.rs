//! The stored samples of a photograph, as the file has them.

use half::f16;

use super::PixelFlags;

/// Interleaved samples at the depth of the file.
pub(super) enum Samples {
    /// 0–255.
    U8(Vec<u8>),
    /// 0–65535.
    U16(Vec<u16>),
    /// Half floats.
    F16(Vec<f16>),
    /// Floats.
    F32(Vec<f32>),
}

impl Samples {
    /// Number of samples, over all channels.
    pub fn len(&self) -> usize {
        match self {
            Self::U8(samples) => samples.len(),
            Self::U16(samples) => samples.len(),
            Self::F16(samples) => samples.len(),
            Self::F32(samples) => samples.len(),
        }
    }

    /// The depth in words.
    pub const fn depth(&self) -> &'static str {
        match self {
            Self::U8(_) => "8-bit",
            Self::U16(_) => "16-bit",
            Self::F16(_) => "16-bit float",
            Self::F32(_) => "32-bit float",
        }
    }
}

/// What a stored number type says about itself.
pub(super) trait Sample: Copy + Default + PartialOrd + Send + Sync + 'static {
    /// The smallest value that counts as clipped: 0.995 of the range, or the largest number of a float.
    const CLIPPED: Self;

    /// The value as a fraction of its range; a float as it is.
    fn fraction(self) -> f64;

    /// Below this a channel is black: 12/255 where values are display-encoded, the linear value of that sRGB
    /// code where they are linear, and zero for floats, which have no code values.
    fn black(is_linear: bool) -> Self;

    /// The linear value of every code, of a length that no code exceeds; floats have none.
    type Table<'a>: Copy;

    /// The table that lies in a slice of every code.
    fn table(values: &[f32]) -> Self::Table<'_>;

    /// The linear value by the table, or by `curve` where there is none.
    fn decode(self, table: Self::Table<'_>, curve: impl Fn(f64) -> f64) -> f32;

    /// False for NaN and infinities.
    fn is_finite(self) -> bool {
        true
    }

    /// True below zero.
    fn is_negative(self) -> bool {
        false
    }
}

/// The linear value of the sRGB code 12.
const LINEAR_BLACK: f64 = 0.003_677;

impl Sample for u8 {
    const CLIPPED: Self = 254;

    fn fraction(self) -> f64 {
        f64::from(self) / 255.0
    }

    fn black(is_linear: bool) -> Self {
        if is_linear { 1 } else { 12 }
    }

    type Table<'a> = &'a [f32; 1 << 8];

    fn table(values: &[f32]) -> Self::Table<'_> {
        values.try_into().expect("a value of every code")
    }

    #[inline]
    fn decode(self, table: Self::Table<'_>, _: impl Fn(f64) -> f64) -> f32 {
        table[usize::from(self)]
    }
}

impl Sample for u16 {
    const CLIPPED: Self = 65_208;

    fn fraction(self) -> f64 {
        f64::from(self) / 65_535.0
    }

    fn black(is_linear: bool) -> Self {
        let fraction = if is_linear { LINEAR_BLACK } else { 12.0 / 255.0 };
        (fraction * 65_535.0).ceil() as Self
    }

    type Table<'a> = &'a [f32; 1 << 16];

    fn table(values: &[f32]) -> Self::Table<'_> {
        values.try_into().expect("a value of every code")
    }

    #[inline]
    fn decode(self, table: Self::Table<'_>, _: impl Fn(f64) -> f64) -> f32 {
        table[usize::from(self)]
    }
}

impl Sample for f16 {
    const CLIPPED: Self = f16::MAX;

    fn fraction(self) -> f64 {
        self.to_f64()
    }

    fn black(_: bool) -> Self {
        f16::MIN_POSITIVE_SUBNORMAL
    }

    type Table<'a> = ();

    fn table(_: &[f32]) -> Self::Table<'_> {}

    #[inline]
    fn decode(self, (): Self::Table<'_>, curve: impl Fn(f64) -> f64) -> f32 {
        curve(self.to_f64()) as f32
    }

    fn is_finite(self) -> bool {
        f16::is_finite(self)
    }

    fn is_negative(self) -> bool {
        self < f16::ZERO
    }
}

impl Sample for f32 {
    const CLIPPED: Self = f32::MAX;

    fn fraction(self) -> f64 {
        f64::from(self)
    }

    fn black(_: bool) -> Self {
        f32::from_bits(1)
    }

    type Table<'a> = ();

    fn table(_: &[f32]) -> Self::Table<'_> {}

    #[inline]
    fn decode(self, (): Self::Table<'_>, curve: impl Fn(f64) -> f64) -> f32 {
        curve(f64::from(self)) as f32
    }

    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }

    fn is_negative(self) -> bool {
        self < 0.0
    }
}

/// The flags of one pixel.
pub(super) fn flags_of<T: Sample>(pixel: [T; 3], black: T) -> PixelFlags {
    let [red, green, blue] = pixel;
    PixelFlags {
        clipped: [red >= T::CLIPPED, green >= T::CLIPPED, blue >= T::CLIPPED],
        black: (red < black) & (green < black) & (blue < black),
        non_finite: !(red.is_finite() & green.is_finite() & blue.is_finite()),
    }
}

/// True when every sample lies from `least` to below clipping: no pixel of the run then has a flag. NaN lies nowhere.
pub(super) fn is_plain<T: Sample>(run: &[T], least: T) -> bool {
    // No early end: the loop is to become one over whole registers.
    run.iter().fold(true, |is_plain, value| is_plain & (*value >= least) & (*value < T::CLIPPED))
}

/// A pixel as three channels; grey is three equal ones.
#[inline]
pub(super) fn triple<T: Sample>(pixel: &[T]) -> [T; 3] {
    if let [red, green, blue] = *pixel { [red, green, blue] } else { [pixel[0]; 3] }
}

/// Hands every pixel of a run on as three channels.
#[inline]
pub(super) fn for_each_pixel<T: Sample>(run: &[T], channels: usize, mut take: impl FnMut([T; 3])) {
    if channels == 3 {
        for pixel in run.as_chunks().0 {
            take(*pixel);
        }
    } else {
        for value in run {
            take([*value; 3]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The flags are defined as 0.995 and 12/255 of the range.
    #[test]
    fn thresholds_are_the_first_codes_beyond() {
        assert!(u8::CLIPPED.fraction() >= 0.995 && (u8::CLIPPED - 1).fraction() < 0.995);
        assert!(u16::CLIPPED.fraction() >= 0.995 && (u16::CLIPPED - 1).fraction() < 0.995);
        assert!((u16::black(false) - 1).fraction() < 12.0 / 255.0 && u16::black(false).fraction() >= 12.0 / 255.0);
        assert!((crate::color::srgb_decode(12.0 / 255.0) - LINEAR_BLACK).abs() < 1e-6);
    }

    #[test]
    fn a_plain_run_has_no_flags() {
        assert!(is_plain(&[12u8, 40, 253], u8::black(false)) && is_plain::<u8>(&[], 12));
        assert!(!is_plain(&[12u8, 254], 12) && !is_plain(&[11u8, 40], 12));
        assert!(!is_plain(&[0.5, f32::NAN], 0.0) && !is_plain(&[f32::INFINITY], 0.0) && !is_plain(&[-0.1], 0.0));
    }

    #[test]
    fn floats_are_black_at_zero_and_below() {
        assert!(flags_of([0.0, -1.0, 0.0], f32::black(true)).black);
        assert!(!flags_of([0.0, 1e-30, 0.0], f32::black(true)).black);
        assert!(flags_of([f32::NAN, 1.0, 1.0], f32::black(true)).non_finite);
        assert!(flags_of([f16::ZERO; 3], f16::black(true)).black);
    }
}
