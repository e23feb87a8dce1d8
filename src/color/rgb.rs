//! A linear colour triple.

use std::ops::{Add, AddAssign, Div, Index, Mul, Neg, Sub};

use serde::{Deserialize, Serialize};

use crate::number::{largest, smallest};

/// Three linear, unclamped channels of some [`RgbSpace`](super::RgbSpace).
///
/// The channels have no names on purpose: `r`, `g`, `h`, `n`, `k` and `t` are
/// parameters of Fresnel models throughout this crate, never colour channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rgb(pub [f64; 3]);

impl Rgb {
    /// No light in any channel.
    pub const BLACK: Self = Self([0.0; 3]);
    /// The white of every space of this crate: a perfect reflector.
    pub const WHITE: Self = Self([1.0; 3]);

    /// The same value in all three channels.
    pub const fn splat(value: f64) -> Self {
        Self([value; 3])
    }

    /// Applies `f` to each channel.
    pub fn map(self, f: impl FnMut(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    /// Combines two triples channel by channel.
    pub fn zip(self, other: Self, mut f: impl FnMut(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    /// True when no channel is NaN or infinite.
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|v| v.is_finite())
    }

    /// Largest channel; NaN if any is.
    pub fn max_channel(self) -> f64 {
        largest(self.0)
    }

    /// Smallest channel; NaN if any is.
    pub fn min_channel(self) -> f64 {
        smallest(self.0)
    }

    /// True when every channel lies in `[0, 1]`.
    pub fn is_in_unit_cube(self) -> bool {
        self.0.iter().all(|v| (0.0..=1.0).contains(v))
    }

    /// Each channel limited to `[0, 1]`; callers report what [`is_in_unit_cube`](Self::is_in_unit_cube) says.
    pub fn clipped(self) -> Self {
        self.map(|v| v.clamp(0.0, 1.0))
    }

    /// Weighted mean `(1 − weight)·self + weight·other`.
    pub fn lerp(self, other: Self, weight: f64) -> Self {
        self * (1.0 - weight) + other * weight
    }

    /// Largest absolute difference over the channels; NaN if one is, so that no bound on it holds.
    pub fn max_abs_difference(self, other: Self) -> f64 {
        (self - other).map(f64::abs).max_channel()
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        self.zip(rhs, |a, b| a + b)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, rhs: Self) {
        *self = *self + rhs;
    }
}

impl Sub for Rgb {
    type Output = Self;
    fn sub(self, rhs: Self) -> Self {
        self.zip(rhs, |a, b| a - b)
    }
}

impl Neg for Rgb {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|v| -v)
    }
}

impl Mul for Rgb {
    type Output = Self;
    fn mul(self, rhs: Self) -> Self {
        self.zip(rhs, |a, b| a * b)
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;
    fn mul(self, rhs: f64) -> Self {
        self.map(|v| v * rhs)
    }
}

impl Div for Rgb {
    type Output = Self;
    fn div(self, rhs: Self) -> Self {
        self.zip(rhs, |a, b| a / b)
    }
}

impl Div<f64> for Rgb {
    type Output = Self;
    fn div(self, rhs: f64) -> Self {
        self.map(|v| v / rhs)
    }
}

impl Index<usize> for Rgb {
    type Output = f64;
    fn index(&self, channel: usize) -> &f64 {
        &self.0[channel]
    }
}

impl From<Rgb> for nalgebra::Vector3<f64> {
    fn from(rgb: Rgb) -> Self {
        rgb.0.into()
    }
}

impl From<nalgebra::Vector3<f64>> for Rgb {
    fn from(v: nalgebra::Vector3<f64>) -> Self {
        Self(v.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_channel_that_is_no_number_is_near_nothing() {
        for channel in 0..3 {
            let mut broken = Rgb::WHITE;
            broken.0[channel] = f64::NAN;
            assert!(broken.max_channel().is_nan() && broken.min_channel().is_nan());
            assert!(!broken.max_abs_difference(Rgb::WHITE).is_finite());
        }
        assert!(Rgb::splat(f64::NAN).max_abs_difference(Rgb::BLACK).is_nan());
        assert_eq!(Rgb([0.5, -3.0, 1.0]).max_abs_difference(Rgb::WHITE), 4.0);
    }
}
