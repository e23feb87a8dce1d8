//! The dispersion formulas of refractiveindex.info: n over wavelength from a few coefficients.

/// n at a wavelength in µm by one of the formulas 1–9; `None` for another number.
///
/// As defined in "Dispersion formulas" of refractiveindex.info (M. N. Polyanskiy, Sci. Data 11, 94, 2024). Coefficients
/// that are left out are 0. NaN where a formula has no real value, infinite at its poles.
pub(super) fn refractive_index(formula: u32, coefficients: &[f64], wavelength_um: f64) -> Option<f64> {
    let l = wavelength_um;
    let l2 = l * l;
    let c = |index: usize| coefficients.get(index).copied().unwrap_or(0.0);
    let pairs = |from: usize| (from..coefficients.len()).step_by(2).map(move |i| (c(i), c(i + 1)));
    let powers = |from: usize| pairs(from).map(|(factor, power)| factor * l.powf(power)).sum::<f64>();
    Some(match formula {
        // Sellmeier
        1 => (1.0 + c(0) + pairs(1).map(|(b, pole)| b * l2 / (l2 - pole * pole)).sum::<f64>()).sqrt(),
        // Sellmeier with the pole squared in the coefficient
        2 => (1.0 + c(0) + pairs(1).map(|(b, pole)| b * l2 / (l2 - pole)).sum::<f64>()).sqrt(),
        // Polynomial
        3 => (c(0) + powers(1)).sqrt(),
        // RefractiveIndex.INFO
        4 => {
            let resonance = |i: usize| match c(i) {
                0.0 => 0.0,
                factor => factor * l.powf(c(i + 1)) / (l2 - c(i + 2).powf(c(i + 3))),
            };
            (c(0) + resonance(1) + resonance(5) + powers(9)).sqrt()
        }
        // Cauchy
        5 => c(0) + powers(1),
        // Gases
        6 => 1.0 + c(0) + pairs(1).map(|(b, pole)| b / (pole - 1.0 / l2)).sum::<f64>(),
        // Herzberger
        7 => {
            let pole = 1.0 / (l2 - 0.028);
            c(0) + c(1) * pole + c(2) * pole * pole + c(3) * l2 + c(4) * l2.powi(2) + c(5) * l2.powi(3)
        }
        // Retro
        8 => {
            let v = c(0) + c(1) * l2 / (l2 - c(2)) + c(3) * l2;
            ((1.0 + 2.0 * v) / (1.0 - v)).sqrt()
        }
        // Exotic
        9 => {
            let d = l - c(4);
            (c(0) + c(1) / (l2 - c(2)) + c(3) * d / (d * d + c(5))).sqrt()
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(formula: u32, coefficients: &[f64], wavelength_um: f64, n: f64, tolerance: f64) {
        let got = refractive_index(formula, coefficients, wavelength_um).unwrap();
        assert!((got - n).abs() <= tolerance, "formula {formula}: {got} instead of {n}");
    }

    /// SCHOTT's catalogue gives n_d (587.56 nm) of N-BK7 as 1.51680 for these Sellmeier coefficients.
    #[test]
    fn bk7_by_sellmeier() {
        let (b, c) = ([1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653]);
        close(2, &[0.0, b[0], c[0], b[1], c[1], b[2], c[2]], 0.58756, 1.51680, 5e-6);
        let roots = c.map(f64::sqrt);
        close(1, &[0.0, b[0], roots[0], b[1], roots[1], b[2], roots[2]], 0.58756, 1.51680, 5e-6);
    }

    /// The other formulas against each other, where their terms coincide.
    #[test]
    fn formulas_agree_where_they_coincide() {
        close(3, &[2.25, 0.01, -2.0], 0.5, (2.25_f64 + 0.04).sqrt(), 1e-15);
        close(5, &[1.5, 0.01, -2.0], 0.5, 1.54, 1e-15);
        close(6, &[0.0, 0.05, 200.0], 0.5, 1.0 + 0.05 / 196.0, 1e-15);
        close(7, &[1.4, 0.0, 0.0, 0.1, 0.01, 0.001], 0.5, 1.4 + 0.025 + 0.000625 + 0.000015625, 1e-15);
        // A resonance of formula 4 with λ² over λ² − 0.1² is a Sellmeier term.
        let sellmeier = refractive_index(1, &[0.0, 1.2, 0.1], 0.5).unwrap();
        close(4, &[1.0, 1.2, 2.0, 0.1, 2.0], 0.5, sellmeier, 1e-15);
        close(4, &[2.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.01, -2.0], 0.5, 2.29_f64.sqrt(), 1e-15);
        // Lorentz–Lorenz: (n² − 1)/(n² + 2) = v.
        let n: f64 = refractive_index(8, &[0.45, 0.1, 0.07, -0.00015], 0.6).unwrap();
        let v = 0.45 + 0.1 * 0.36 / (0.36 - 0.07) - 0.00015 * 0.36;
        assert!(((n * n - 1.0) / (n * n + 2.0) - v).abs() < 1e-14);
        close(9, &[2.25, 0.02, 0.03, 0.0, 1.5, 0.9], 0.5, (2.25_f64 + 0.02 / 0.22).sqrt(), 1e-15);
        assert_eq!(refractive_index(10, &[1.0], 0.5), None);
    }
}
