//! Transfer curves: from a stored value in `[0, 1]` to a linear one.

use std::sync::Arc;

use crate::color::srgb_decode;

/// How one channel is encoded.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Curve {
    /// Proportional to light.
    Linear,
    /// IEC 61966-2-1.
    Srgb,
    /// linear = encodedᵞ.
    Power(f64),
    /// The inverse of the camera curve of ITU-R BT.709-6, item 1.2.
    Bt709,
    /// SMPTE ST 2084 with 1 at 203 cd/m², the reference white of ITU-R BT.2408-7.
    Pq,
    /// The inverse of the camera curve of ITU-R BT.2100-2, table 5, with 1 at its nominal peak.
    Hlg,
    /// Parametric curve of ICC.1:2022 section 10.18, brought to its most general form, function type 4.
    Parametric {
        /// Exponent.
        g: f64,
        /// linear = (a·x + b)ᵍ + e from `d` on.
        a: f64,
        /// See `a`.
        b: f64,
        /// linear = c·x + f below `d`.
        c: f64,
        /// Where the pieces meet.
        d: f64,
        /// See `a`.
        e: f64,
        /// See `c`.
        f: f64,
    },
    /// Evenly spaced samples over `[0, 1]`, at least two, joined by straight lines.
    Table(Arc<[f64]>),
}

impl Curve {
    /// The linear value of an encoded one. Outside `[0, 1]` every curve continues instead of clamping.
    #[inline]
    pub fn decode(&self, encoded: f64) -> f64 {
        // Floats have no table, so that each of their values comes here.
        if matches!(self, Self::Linear) { encoded } else { self.bend(encoded) }
    }

    fn bend(&self, encoded: f64) -> f64 {
        let mirrored = |f: &dyn Fn(f64) -> f64| f(encoded.abs()).copysign(encoded);
        match self {
            Self::Linear => encoded,
            Self::Srgb => srgb_decode(encoded),
            Self::Power(gamma) => mirrored(&|x| x.powf(*gamma)),
            Self::Bt709 => mirrored(&|x| if x < 0.081 { x / 4.5 } else { ((x + 0.099) / 1.099).powf(1.0 / 0.45) }),
            Self::Pq => mirrored(&|x| pq_cd_per_m2(x) / 203.0),
            Self::Hlg => mirrored(&hlg_decode),
            Self::Parametric { g, a, b, c, d, e, f } => {
                if encoded < *d {
                    c * encoded + f
                } else {
                    (a * encoded + b).max(0.0).powf(*g) + e
                }
            }
            Self::Table(samples) => interpolate(samples, encoded),
        }
    }

    /// True when the curve is a straight line through zero and one.
    pub fn is_linear(&self) -> bool {
        (0..=64).map(|i| f64::from(i) / 64.0).all(|x| (self.decode(x) - x).abs() < 1e-4)
    }
}

/// SMPTE ST 2084:2014, equation 4.1.
fn pq_cd_per_m2(encoded: f64) -> f64 {
    const M1: f64 = 2610.0 / 16384.0;
    const M2: f64 = 2523.0 / 32.0;
    const C1: f64 = 3424.0 / 4096.0;
    const C2: f64 = 2413.0 / 128.0;
    const C3: f64 = 2392.0 / 128.0;
    let root = encoded.powf(1.0 / M2);
    10_000.0 * ((root - C1).max(0.0) / (C2 - C3 * root)).powf(1.0 / M1)
}

/// The inverse OETF of ITU-R BT.2100-2, table 5.
fn hlg_decode(encoded: f64) -> f64 {
    const A: f64 = 0.178_832_77;
    const B: f64 = 1.0 - 4.0 * A;
    let c = 0.5 - A * (4.0 * A).ln();
    if encoded <= 0.5 { encoded * encoded / 3.0 } else { (((encoded - c) / A).exp() + B) / 12.0 }
}

fn interpolate(samples: &[f64], x: f64) -> f64 {
    let position = x * (samples.len() - 1) as f64;
    let index = (position.max(0.0) as usize).min(samples.len() - 2);
    samples[index] + (samples[index + 1] - samples[index]) * (position - index as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ST 2084 and BT.2100 define both ends; BT.2408-7 table 1 has 203 cd/m² at 58 % PQ and 75 % HLG.
    #[test]
    fn broadcast_curves_meet_their_anchors() {
        assert!((Curve::Pq.decode(1.0) * 203.0 - 10_000.0).abs() < 1e-6);
        assert!((Curve::Pq.decode(0.58) - 1.0).abs() < 0.01);
        assert!((Curve::Hlg.decode(1.0) - 1.0).abs() < 1e-6);
        assert!((Curve::Hlg.decode(0.75) - 0.265).abs() < 1e-3);
    }

    #[test]
    fn a_curve_continues_beyond_its_range() {
        let table = Curve::Table([0.0, 0.25, 1.0].into());
        assert_eq!(table.decode(1.5), 1.75);
        assert_eq!(table.decode(-0.5), -0.25);
        assert!(Curve::Srgb.decode(1.2) > 1.0 && Curve::Power(2.2).decode(-0.5) < 0.0);
    }

    /// The sRGB curve written as an ICC function type 3 is the sRGB curve.
    #[test]
    fn parametric_form_holds_srgb() {
        let (g, a, b, c, d) = (2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.040_45);
        let parametric = Curve::Parametric { g, a, b, c, d, e: 0.0, f: 0.0 };
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            assert!((parametric.decode(x) - Curve::Srgb.decode(x)).abs() < 1e-12);
        }
        assert!(!parametric.is_linear() && Curve::Power(1.0).is_linear());
    }
}
