//! Textbook forms that are measured for their digits alone: for time there are those of [`crate::kernel::textbook`].

use crate::color::RgbSpace;
use crate::fresnel::COS_THETA_MAX;
use crate::kernel::{Form, Real};

/// r0, the tint and r90 as MaterialX prints it (`mx_fresnel_hoffman_schlick`), with `pow` and `mix`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GeneralizedAsPrinted {
    pub(super) exponent: f64,
}

impl Form<3> for GeneralizedAsPrinted {
    type Shared<T: Real> = T;

    #[inline(always)]
    fn shared<T: Real>(self, c: T) -> T {
        c
    }

    #[inline(always)]
    fn channel<T: Real>(self, c: T, [r0, t, r90]: [T; 3]) -> [T; 1] {
        let (one, max) = (c.of(1.0), c.of(COS_THETA_MAX));
        let schlick = |x: T| {
            let share = x.power(self.exponent);
            r0 * (one - share) + r90 * share
        };
        let a = schlick(one - max) * (one - t) * (one / (max * (one - max).power(6.0)));
        [schlick(one - c) - a * c * (one - c).power(6.0)]
    }
}

/// L*, a* and b* of linear RGB with the constants that are printed most: .008856, 7.787, 16/116, and `pow` for the root
/// (CIE 15.2:1986, and many programs since). At .008856 it jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LabAsPrinted {
    pub(super) space: RgbSpace,
}

impl Form<3, 3> for LabAsPrinted {
    const HOLDS_COSINE: bool = false;

    type Shared<T: Real> = ();

    #[inline(always)]
    fn shared<T: Real>(self, _: T) {}

    #[inline(always)]
    fn channel<T: Real>(self, (): (), rgb: [T; 3]) -> [T; 3] {
        let (matrix, white) = (self.space.xyz_from_rgb(), self.space.white().xyz());
        let root = |row: usize| {
            let [x, y, z] = [0, 1, 2].map(|column| rgb[column] * rgb[column].of(matrix[(row, column)]));
            let ratio = (x + y + z) / x.of(white.0[row]);
            let toe = ratio.of(7.787) * ratio + ratio.of(16.0 / 116.0);
            ratio.of(0.008_856).if_below(ratio, ratio.power(1.0 / 3.0), toe)
        };
        let [fx, fy, fz] = [root(0), root(1), root(2)];
        [fy.of(116.0) * fy - fy.of(16.0), fx.of(500.0) * (fx - fy), fy.of(200.0) * (fy - fz)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Lab, Rgb};
    use crate::fresnel::{CosTheta, generalized_schlick};
    use crate::kernel::Material;

    /// Another text of the same: what is lost is lost by 32 bits.
    #[test]
    fn in_64_bits_they_are_the_core() {
        let exponent = 4.7;
        let form = Material::of_parameters(GeneralizedAsPrinted { exponent }, [0.9, 0.7, 0.95].map(Rgb::splat));
        for c in [0.0, 0.1, 0.5, 1.0] {
            let exact = generalized_schlick(0.9, 0.7, 0.95, exponent, CosTheta::new(c));
            assert!((form.at(c)[0][0] - exact).abs() < 1e-14);
        }
        for (rgb, limit) in [(Rgb([0.9, 0.4, 0.1]), 1e-12), (Rgb([0.004, 0.002, -0.001]), 0.01)] {
            let space = RgbSpace::AcesCg;
            let [lightness, a, b] = Material::of_parameters(LabAsPrinted { space }, rgb.0.map(Rgb::splat)).at(1.0);
            let exact = Lab::from_rgb(rgb, space);
            for (got, exact) in [(lightness[0], exact.lightness), (a[0], exact.a), (b[0], exact.b)] {
                assert!((got - exact).abs() < limit, "{got} {exact}");
            }
        }
    }
}
