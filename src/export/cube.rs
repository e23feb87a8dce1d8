//! The curve as a 1-D LUT in the .cube format (Adobe 2013).

use std::fmt::{self, Write as _};

use super::export::Written;
use super::material::Material;
use super::names::one_ascii_line;
use super::sampling::CUBE_ROWS;
use crate::fresnel::CosTheta;

/// Row i is F at cos θ = i / (rows − 1), unclamped.
pub(super) fn write(header: &[String], material: &Material<'_>) -> Written {
    let mut text = String::new();
    for line in header {
        writeln!(text, "# {}", one_ascii_line(line))?;
    }
    writeln!(text, "# Index with the cosine of the angle of incidence, in linear light.")?;
    writeln!(text, "TITLE \"{}\"", one_ascii_line(&material.name).replace('"', "'"))?;
    writeln!(text, "LUT_1D_SIZE {CUBE_ROWS}\nDOMAIN_MIN 0.0 0.0 0.0\nDOMAIN_MAX 1.0 1.0 1.0")?;
    for row in 0..CUBE_ROWS {
        let cos_theta = CosTheta::new(f64::from(row) / f64::from(CUBE_ROWS - 1));
        let [red, green, blue] = material.form.reflectance(cos_theta).0.map(Fixed);
        writeln!(text, "{red} {green} {blue}")?;
    }
    Ok(text.into_bytes())
}

/// A number to eight decimals, finer than the error between rows: by whole numbers a LUT takes less than half the time.
struct Fixed(f64);

impl fmt::Display for Fixed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const UNIT: u64 = 100_000_000;
        let scaled = (self.0 * UNIT as f64).round();
        let sign = if scaled < 0.0 { "-" } else { "" };
        let units = scaled.abs() as u64;
        write!(f, "{sign}{}.{:08}", units / UNIT, units % UNIT)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn eight_decimals_are_kept(value in -100.0..100.0_f64) {
            let back: f64 = Fixed(value).to_string().parse().unwrap();
            prop_assert!((back - value).abs() <= 0.501e-8, "{} {}", value, back);
        }
    }

    #[test]
    fn a_sign_stands_only_where_something_is_below_zero() {
        assert_eq!(
            [-0.0, -1e-9, -0.5, 1.0].map(|v| Fixed(v).to_string()),
            ["0.00000000", "0.00000000", "-0.50000000", "1.00000000"]
        );
    }
}
