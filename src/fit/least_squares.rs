//! Closed-form least squares of one channel's curve, for the models that are linear in their colours.

use super::search::minimum_within;
use crate::color::Rgb;
use crate::fresnel::{COS_THETA_MAX, CosTheta, PEAK_GAIN, Weights, schlick};

/// r and h of the Hoffman curve nearest to samples (angle, F); `None` where the angles do not tell them apart.
///
/// The model is linear in r and h (see [`Weights`]): two normal equations.
pub fn r_h_by_least_squares(samples: impl IntoIterator<Item = (CosTheta, f64)>) -> Option<(f64, f64)> {
    let (mut rr, mut rh, mut hh, mut ry, mut hy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (cos_theta, f) in samples {
        let Weights { of_r, of_h, of_white } = Weights::at(cos_theta);
        let y = f - of_white;
        rr += of_r * of_r;
        rh += of_r * of_h;
        hh += of_h * of_h;
        ry += of_r * y;
        hy += of_h * y;
    }
    let determinant = rr * hh - rh * rh;
    (determinant > 1e-9 * rr * hh).then(|| ((ry * hh - hy * rh) / determinant, (hy * rr - ry * rh) / determinant))
}

/// h of the Hoffman curve nearest to samples (angle, F) at a given r; `None` where no sample depends on h.
pub fn h_by_least_squares(samples: impl IntoIterator<Item = (CosTheta, f64)>, r: f64) -> Option<f64> {
    let (mut product, mut square) = (0.0, 0.0);
    for (cos_theta, f) in samples {
        let Weights { of_r, of_h, of_white } = Weights::at(cos_theta);
        product += of_h * (f - of_r * r - of_white);
        square += of_h * of_h;
    }
    (square > 0.0).then(|| product / square)
}

/// r of the Schlick curve nearest to samples (angle, F); `None` where every sample grazes.
pub fn schlick_r_by_least_squares(samples: impl IntoIterator<Item = (CosTheta, f64)>) -> Option<f64> {
    let (mut product, mut square) = (0.0, 0.0);
    for (cos_theta, f) in samples {
        let of_white = schlick(0.0, cos_theta);
        let of_r = 1.0 - of_white;
        product += of_r * (f - of_white);
        square += of_r * of_r;
    }
    (square > 0.0).then(|| product / square)
}

/// The multiple of a shape nearest to three curves, channel by channel, and the sum of the squares that remain.
fn nearest_multiple(shape: &[f64], curves: &[Rgb]) -> (Rgb, f64) {
    let both = || shape.iter().zip(curves);
    let product = both().fold(Rgb::BLACK, |sum, (shape, curve)| sum + *curve * *shape);
    let multiple = product / shape.iter().map(|shape| shape * shape).sum::<f64>();
    let remains = both().fold(Rgb::BLACK, |sum, (shape, curve)| sum + (*curve - multiple * *shape).map(|f| f * f));
    (multiple, remains.0.iter().sum())
}

/// c (1 − c)^α, the shape of the correction.
fn correction(cos_theta: CosTheta, alpha: f64) -> f64 {
    let c = cos_theta.get();
    c * (1.0 - c).powf(alpha)
}

/// Where α is looked for: the correction then peaks between 30° and 88°.
const ALPHAS: std::ops::RangeInclusive<f64> = 0.15..=30.0;

/// `a` for each channel and the shared α nearest to three curves with given r.
///
/// For each α the best `a` is closed form, so that one variable is searched (Golub & Pereyra 1973, variable projection).
pub(super) fn a_alpha_by_least_squares(samples: &[(CosTheta, Rgb)], r: Rgb) -> (Rgb, f64) {
    let below_schlick: Vec<Rgb> = samples.iter().map(|&(c, f)| r.map(|r| schlick(r, c)) - f).collect();
    let nearest = |alpha: f64| {
        let shape: Vec<f64> = samples.iter().map(|(c, _)| correction(*c, alpha)).collect();
        nearest_multiple(&shape, &below_schlick)
    };
    let alpha = minimum_within(ALPHAS, 24, |alpha| nearest(alpha).1);
    (nearest(alpha).0, alpha)
}

/// Where the exponent of generalized Schlick is looked for. Above it the curves come again, p = 7 as p = 6 with
/// another t, since c x⁶ = x⁶ − x⁷.
const EXPONENTS: std::ops::RangeInclusive<f64> = 1.0..=6.5;

/// t for each channel and the shared exponent p nearest to three curves, with given r0 and white at grazing.
pub(super) fn t_exponent_by_least_squares(samples: &[(CosTheta, Rgb)], r0: Rgb) -> (Rgb, f64) {
    let base = |p: f64, c: f64| {
        let power = (1.0 - c).powf(p);
        r0.map(|r0| r0 + (1.0 - r0) * power)
    };
    let shape: Vec<f64> = samples.iter().map(|(c, _)| correction(*c, 6.0)).collect();
    let nearest = |p: f64| {
        let below_base: Vec<Rgb> = samples.iter().map(|&(c, f)| base(p, c.get()) - f).collect();
        nearest_multiple(&shape, &below_base)
    };
    let p = minimum_within(EXPONENTS, 24, |p| nearest(p).1);
    (nearest(p).0.zip(base(p, COS_THETA_MAX), |a, base| 1.0 - a / (PEAK_GAIN * base)), p)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fresnel::{generalized_schlick, hoffman, lazanyi, whole_degrees};

    fn curve(f: impl Fn(CosTheta) -> f64) -> Vec<(CosTheta, f64)> {
        whole_degrees().map(|c| (c, f(c))).collect()
    }

    proptest! {
        #[test]
        fn a_curve_of_the_model_gives_its_parameters_back(r in -0.1..1.1, h in -0.1..1.1) {
            let (r_back, h_back) = r_h_by_least_squares(curve(|c| hoffman(r, h, c))).unwrap();
            prop_assert!((r_back - r).abs() < 1e-12 && (h_back - h).abs() < 1e-12);
            let r_back = schlick_r_by_least_squares(curve(|c| schlick(r, c))).unwrap();
            prop_assert!((r_back - r).abs() < 1e-12);
        }

        /// At a least-squares solution the residual is orthogonal to the model's derivatives.
        #[test]
        fn no_nearer_curve_exists(bend in -0.3..0.3) {
            let samples = curve(|c| hoffman(0.6, 0.5, c) + bend * (9.0 * c.get()).sin());
            let (r, h) = r_h_by_least_squares(samples.iter().copied()).unwrap();
            let weighted = |weight: fn(Weights) -> f64| -> f64 {
                samples.iter().map(|&(c, f)| weight(Weights::at(c)) * (f - hoffman(r, h, c))).sum()
            };
            prop_assert!(weighted(|w| w.of_r).abs() < 1e-10 && weighted(|w| w.of_h).abs() < 1e-10);
        }

        #[test]
        fn lazanyi_gives_its_parameters_back(r in 0.3..0.95_f64, a in 0.3..2.0_f64, alpha in 1.0..12.0_f64) {
            let a = Rgb([0.8, 1.0, 1.2]) * a;
            let samples: Vec<_> = whole_degrees().map(|c| (c, a.map(|a| lazanyi(r, a, alpha, c)))).collect();
            let (a_back, alpha_back) = a_alpha_by_least_squares(&samples, Rgb::splat(r));
            prop_assert!((alpha_back - alpha).abs() < 1e-5 && a_back.max_abs_difference(a) < 1e-5, "{alpha_back}");
        }

        #[test]
        fn generalized_schlick_gives_its_curve_back(r in 0.3..0.9_f64, t in 0.5..1.1_f64, p in 3.0..6.5_f64) {
            let r0 = Rgb([0.9, 1.0, 0.8]) * r;
            let curve = |t: Rgb, p, c| r0.zip(t, |r0, t| generalized_schlick(r0, t, 1.0, p, c));
            let samples: Vec<_> = whole_degrees().map(|c| (c, curve(Rgb::splat(t), p, c))).collect();
            let (t_back, p_back) = t_exponent_by_least_squares(&samples, r0);
            for (c, f) in samples {
                prop_assert!(curve(t_back, p_back, c).max_abs_difference(f) < 1e-6, "{p_back} {t_back:?}");
            }
        }
    }

    #[test]
    fn one_angle_tells_nothing_of_two_parameters() {
        assert_eq!(r_h_by_least_squares([(CosTheta::FACING, 0.5); 5]), None);
        assert_eq!(r_h_by_least_squares([]), None);
        assert_eq!(schlick_r_by_least_squares([(CosTheta::GRAZING, 1.0)]), None);
    }
}
