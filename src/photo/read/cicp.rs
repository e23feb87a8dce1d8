//! Coding-independent code points of ITU-T H.273 (07/2024), as PNG `cICP` carries them.

use nalgebra::Matrix3;

use super::colour::Primaries;
use crate::color::Chromaticity;
use crate::photo::curve::Curve;
use crate::photo::linearizer::{rec709_from_primaries, rec709_from_xyz};

/// The curve and the matrix to linear Rec.709 of two code points, or a sentence.
pub(super) fn curve_and_matrix(primaries: u8, transfer: u8) -> Result<(Curve, Matrix3<f64>), String> {
    let refusal = |what: &str, value: u8| format!("PNG cICP {what} {value} is not known here and is not followed");
    let curve = curve(transfer).ok_or_else(|| refusal("transfer", transfer))?;
    let matrix = matrix(primaries).ok_or_else(|| refusal("primaries", primaries))?;
    Ok((curve, matrix))
}

/// TransferCharacteristics, table 3: the inverse of the function given there.
fn curve(transfer: u8) -> Option<Curve> {
    Some(match transfer {
        1 | 6 | 14 | 15 => Curve::Bt709,
        4 => Curve::Power(2.2),
        5 => Curve::Power(2.8),
        8 => Curve::Linear,
        13 => Curve::Srgb,
        16 => Curve::Pq,
        18 => Curve::Hlg,
        _ => return None,
    })
}

/// ColourPrimaries, table 2.
fn matrix(primaries: u8) -> Option<Matrix3<f64>> {
    const C: [f64; 2] = [0.310, 0.316];
    const D65: [f64; 2] = [0.3127, 0.3290];
    let xy = match primaries {
        1 => [[0.640, 0.330], [0.300, 0.600], [0.150, 0.060], D65],
        4 => [[0.67, 0.33], [0.21, 0.71], [0.14, 0.08], C],
        5 => [[0.64, 0.33], [0.29, 0.60], [0.15, 0.06], D65],
        6 | 7 => [[0.630, 0.340], [0.310, 0.595], [0.155, 0.070], D65],
        8 => [[0.681, 0.319], [0.243, 0.692], [0.145, 0.049], C],
        9 => [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046], D65],
        10 => return Some(rec709_from_xyz(Chromaticity::new(1.0 / 3.0, 1.0 / 3.0).xyz())),
        11 => [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060], [0.314, 0.351]],
        12 => [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060], D65],
        22 => [[0.630, 0.340], [0.295, 0.605], [0.155, 0.077], D65],
        _ => return None,
    };
    let Primaries { rgb, white } = Primaries::from_xy(xy);
    rec709_from_primaries(rgb, white)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;

    /// Points 1, 9 and 12 are three spaces of this crate.
    #[test]
    fn known_points_are_known_spaces() {
        let spaces = [(1, RgbSpace::LinRec709), (9, RgbSpace::LinRec2020), (12, RgbSpace::LinDisplayP3)];
        for (point, space) in spaces {
            let difference = matrix(point).unwrap() - space.matrix_to(RgbSpace::LinRec709);
            assert!(difference.abs().max() < 1e-12, "{point}");
        }
    }

    #[test]
    fn every_known_point_keeps_white_and_the_others_say_so() {
        for point in 0..=u8::MAX {
            if let Some(matrix) = matrix(point) {
                let white = matrix * nalgebra::Vector3::repeat(1.0);
                assert!((white - nalgebra::Vector3::repeat(1.0)).abs().max() < 1e-12, "{point}");
            }
        }
        assert!(curve_and_matrix(2, 13).unwrap_err().contains("primaries 2"));
        assert!(curve_and_matrix(1, 2).unwrap_err().contains("transfer 2"));
    }
}
