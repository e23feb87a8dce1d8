//! Where a file has the curve as numbers, and what its reader makes between them.

use super::Target;
use crate::color::Rgb;
use crate::fresnel::CosTheta;

/// Readers interpolate linearly between rows. The curvature of F in the cosine stays below 2·7⁷/6⁶ ·
/// |r − h| + …  ≈ 140, so that 4096 rows keep within 140 / (8 · 4095²) = 1e-6.
pub(super) const CUBE_ROWS: u32 = 4096;

/// Texels of the ramp.
pub(super) const RAMP_WIDTH: u32 = 4096;

impl Target {
    /// True where the file has the curve at some angles.
    pub const fn is_sampled(self) -> bool {
        matches!(self, Self::Csv | Self::Cube | Self::Exr)
    }

    /// What a reader makes of a curve that the file has: itself, or what is linear between its samples.
    pub(super) fn read(self, curve: impl Fn(CosTheta) -> Rgb, cos_theta: CosTheta) -> Rgb {
        let c = cos_theta.get();
        match self {
            Self::Csv => between(cos_theta.deg(), 90.0, |deg| curve(CosTheta::from_deg(deg))),
            Self::Cube => {
                let last = f64::from(CUBE_ROWS - 1);
                between(c * last, last, |row| curve(CosTheta::new(row / last)))
            }
            // Held beyond the centres of the first and last texel.
            Self::Exr => {
                let place = (c * f64::from(RAMP_WIDTH) - 0.5).max(0.0);
                between(place, f64::from(RAMP_WIDTH - 1), |texel| curve(texel_centre(texel)))
            }
            _ => curve(cos_theta),
        }
    }
}

/// The cosine of the centre of a texel of the ramp.
pub(super) fn texel_centre(texel: f64) -> CosTheta {
    CosTheta::new((texel + 0.5) / f64::from(RAMP_WIDTH))
}

/// Linear between the samples below and above a place of `0..=last`, which whole numbers have.
fn between(place: f64, last: f64, sample: impl Fn(f64) -> Rgb) -> Rgb {
    let below = place.floor().clamp(0.0, last - 1.0);
    sample(below).lerp(sample(below + 1.0), (place - below).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of what the samples are even in is read as it is, a curve near it.
    #[test]
    fn readers_are_linear_between_samples() {
        for step in 0..=1000 {
            let c = CosTheta::new(f64::from(step) / 1000.0);
            let off = |target: Target, curve: &dyn Fn(CosTheta) -> f64| {
                target.read(|c| Rgb::splat(curve(c)), c).max_abs_difference(Rgb::splat(curve(c)))
            };
            assert!(off(Target::Csv, &|c| c.deg()) < 1e-9 && off(Target::Cube, &|c| c.get()) < 1e-12);
            let held = 0.5 / f64::from(RAMP_WIDTH);
            assert!(off(Target::Exr, &|c| c.get().clamp(held, 1.0 - held)) < 1e-12);
            assert_eq!(off(Target::Glsl, &|c| c.get().powi(5)), 0.0);
            assert!(off(Target::Cube, &|c| c.get().powi(5)) < 20.0 / 8.0 / 4095.0_f64.powi(2));
        }
    }
}
