//! A painted mask with a soft edge: texture filtering is blending, shown on a sphere.

use super::Contestants;
use super::parameters::Parameters;
use crate::color::Rgb;
use crate::fresnel::CosTheta;
use crate::render::Picture;

/// Where the soft edge of the spot lies, as a distance from its middle in radii of the sphere.
const EDGE: (f64, f64) = (0.25, 0.8);

/// The middle of the spot in radii of the sphere, right and up of its middle: towards the edge, where h matters.
const MIDDLE: (f64, f64) = (0.38, 0.3);

/// The second material's share at a place of the sphere's picture, in radii from its middle, right and up.
fn mask(x: f64, y: f64) -> f64 {
    let distance = (x - MIDDLE.0).hypot(y - MIDDLE.1);
    let share = ((EDGE.1 - distance) / (EDGE.1 - EDGE.0)).clamp(0.0, 1.0);
    // Smoothstep: the falloff of a soft brush.
    share * share * (3.0 - 2.0 * share)
}

/// What a painted sphere shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Painted {
    /// The blend of the two true reflectances.
    Truth,
    /// The reflectance of blended parameters.
    Blended(Parameters),
}

/// A sphere of `a` with a soft spot of `b`, in white surroundings: every pixel is F of its angle. `size` pixels wide.
pub fn painted_sphere(a: &Contestants, b: &Contestants, painted: Painted, size: u32) -> Picture {
    let mut picture = Picture::new(size, size, a.space);
    let to_radii = |pixel: u32| (f64::from(pixel) + 0.5) * 2.0 / f64::from(size) - 1.0;
    for row in 0..size {
        for column in 0..size {
            let (x, y) = (to_radii(column), -to_radii(row));
            let radius = x.hypot(y);
            let coverage = ((1.0 - radius) * f64::from(size) / 2.0 + 0.5).clamp(0.0, 1.0);
            if coverage > 0.0 {
                let cos_theta = CosTheta::new((1.0 - radius * radius).max(0.0).sqrt());
                let index = (row * size + column) as usize;
                picture.linear[index] = colour_at(a, b, painted, mask(x, y), cos_theta).0.map(|v| v as f32);
                picture.coverage[index] = coverage as f32;
            }
        }
    }
    picture
}

/// The colour that a place of the blend shows at an angle.
pub fn colour_at(a: &Contestants, b: &Contestants, painted: Painted, weight: f64, cos_theta: CosTheta) -> Rgb {
    match painted {
        Painted::Truth => at_angle(&a.truth, cos_theta).lerp(at_angle(&b.truth, cos_theta), weight),
        Painted::Blended(parameters) => a.pair(parameters).lerp(b.pair(parameters), weight).reflectance(cos_theta),
    }
}

/// A curve of whole degrees between its angles, linear.
fn at_angle(curve: &[Rgb], cos_theta: CosTheta) -> Rgb {
    let deg = cos_theta.deg();
    let below = (deg.floor() as usize).min(curve.len() - 2);
    curve[below].lerp(curve[below + 1], deg - below as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::fit::Method;
    use crate::metal::metal_by_name;
    use crate::study::Subject;

    #[test]
    fn the_mask_reaches_both_materials_and_h_is_blended_reflectance() {
        let metal = |name| {
            let subject = Subject::Metal(metal_by_name(name).unwrap());
            Contestants::of(&subject, RgbSpace::AcesCg, Method::LeastSquares).unwrap()
        };
        let (gold, silver) = (metal("gold"), metal("silver"));
        assert_eq!((mask(MIDDLE.0, MIDDLE.1), mask(-1.0, 0.0)), (1.0, 0.0));
        let picture = painted_sphere(&gold, &silver, Painted::Blended(Parameters::H), 32);
        let corner = picture.coverage[0];
        let facing = picture.linear[(16 * 32 + 16) as usize];
        assert!(corner == 0.0 && facing[2] > gold.truth[0][2] as f32 && facing[2] < silver.truth[0][2] as f32);
        let angle = CosTheta::from_deg(70.0);
        let truth = colour_at(&gold, &silver, Painted::Truth, 0.0, angle);
        assert!(truth.max_abs_difference(gold.truth[70]) < 1e-9);
    }
}
