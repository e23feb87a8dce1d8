//! CIE XYZ, chromaticities and the Bradford adaptation.

use nalgebra::{Matrix3, Vector3};

/// CIE 1931 tristimulus values, relative to a white of Y = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Xyz(pub [f64; 3]);

/// CIE 1931 xy chromaticity coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chromaticity {
    /// x = X / (X + Y + Z)
    pub x: f64,
    /// y = Y / (X + Y + Z)
    pub y: f64,
}

impl Chromaticity {
    /// A chromaticity from its coordinates.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The tristimulus values of this chromaticity at Y = 1.
    pub fn xyz(self) -> Xyz {
        Xyz([self.x / self.y, 1.0, (1.0 - self.x - self.y) / self.y])
    }
}

impl From<Xyz> for Vector3<f64> {
    fn from(xyz: Xyz) -> Self {
        xyz.0.into()
    }
}

impl From<Vector3<f64>> for Xyz {
    fn from(v: Vector3<f64>) -> Self {
        Self(v.into())
    }
}

/// Cone responses of Lam's Bradford transform (CIE 160:2004, linearised as in ICC.1:2022 annex E).
const BRADFORD: Matrix3<f64> = Matrix3::new(
    0.8951, 0.2664, -0.1614, //
    -0.7502, 1.7135, 0.0367, //
    0.0389, -0.0685, 1.0296,
);

/// The XYZ → XYZ matrix that carries white `from` to white `to` by linear Bradford scaling.
pub fn bradford(from: Xyz, to: Xyz) -> Matrix3<f64> {
    let cone_from = BRADFORD * Vector3::from(from);
    let cone_to = BRADFORD * Vector3::from(to);
    let gain = Matrix3::from_diagonal(&cone_to.component_div(&cone_from));
    solve(BRADFORD, gain * BRADFORD)
}

/// The xyz_from_rgb matrix of a space from its primaries and white (SMPTE RP 177-1993, section 3.3).
///
/// `None` where the primaries span no triangle, as damaged files may say.
pub fn xyz_from_primaries(primaries: [Chromaticity; 3], white: Chromaticity) -> Option<Matrix3<f64>> {
    let columns = primaries.map(|p| Vector3::from(p.xyz()));
    let unscaled = Matrix3::from_columns(&columns);
    let scale = unscaled.try_inverse()? * Vector3::from(white.xyz());
    let matrix = unscaled * Matrix3::from_diagonal(&scale);
    matrix.iter().all(|v| v.is_finite()).then_some(matrix)
}

/// The inverse of a matrix that the colour constants of this module make invertible.
pub(super) fn invert(matrix: Matrix3<f64>) -> Matrix3<f64> {
    solve(matrix, Matrix3::identity())
}

fn solve(a: Matrix3<f64>, b: Matrix3<f64>) -> Matrix3<f64> {
    a.lu().solve(&b).expect("primaries and cone responses are linearly independent")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bradford_carries_one_white_to_the_other() {
        let (d65, d50) = (Chromaticity::new(0.3127, 0.3290).xyz(), Chromaticity::new(0.3457, 0.3585).xyz());
        let adapted = Xyz::from(bradford(d65, d50) * Vector3::from(d65));
        for (got, want) in adapted.0.iter().zip(d50.0) {
            assert!((got - want).abs() < 1e-12, "{got} {want}");
        }
    }
}
