//! The curve as a 1-D LUT in the .cube format (Adobe 2013).

use std::fmt::Write as _;

use super::export::Written;
use super::material::Material;
use super::names::one_ascii_line;
use super::number::push_triple;
use crate::fresnel::CosTheta;

/// Readers interpolate linearly between rows. The curvature of F in the cosine stays below 2·7⁷/6⁶ ·
/// |r − h| + …  ≈ 140, so that 4096 rows keep within 140 / (8 · 4095²) = 1e-6.
const ROWS: u32 = 4096;

/// Row i is F at cos θ = i / (rows − 1), unclamped.
pub(super) fn write(header: &[String], material: &Material<'_>) -> Written {
    let mut text = String::new();
    for line in header {
        writeln!(text, "# {}", one_ascii_line(line))?;
    }
    writeln!(text, "# Index with the cosine of the angle of incidence, in linear light.")?;
    writeln!(text, "TITLE \"{}\"", one_ascii_line(&material.name).replace('"', "'"))?;
    writeln!(text, "LUT_1D_SIZE {ROWS}\nDOMAIN_MIN 0.0 0.0 0.0\nDOMAIN_MAX 1.0 1.0 1.0")?;
    let model = material.model();
    for row in 0..ROWS {
        let cos_theta = CosTheta::new(f64::from(row) / f64::from(ROWS - 1));
        push_triple(&mut text, model.reflectance(cos_theta), " ");
        text.push('\n');
    }
    Ok(text.into_bytes())
}
