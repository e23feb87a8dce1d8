//! The conductor nearest to another model.

use super::index::{SMALLEST_START, conductor_of, nk_by_least_squares};
use super::{NotAMaterial, convert};
use crate::color::RgbSpace;
use crate::fresnel::{FresnelModel, ModelKind, Nk, whole_degrees};

/// The conductor whose curve is nearest to a model's, channel by channel, by least squares over 0°, 1°, …, 90°.
///
/// Unlike [`convert`] it does not keep r: both ends of the curve give a little.
pub fn nearest_conductor(model: &FresnelModel, space: RgbSpace) -> Result<FresnelModel, NotAMaterial> {
    let FresnelModel::Conductor { n, k } = convert(model, ModelKind::Conductor, space)?.model else {
        return Ok(*model);
    };
    let curve: Vec<_> = whole_degrees().map(|cos_theta| (cos_theta, model.reflectance(cos_theta))).collect();
    Ok(conductor_of(std::array::from_fn(|channel| {
        let samples: Vec<_> = curve.iter().map(|&(cos_theta, rgb)| (cos_theta, rgb[channel])).collect();
        let start = Nk { n: n[channel].max(SMALLEST_START), k: k[channel].max(SMALLEST_START) };
        nk_by_least_squares(&samples, start)
    })))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    const SPACE: RgbSpace = RgbSpace::LinRec709;

    fn squares(x: &FresnelModel, y: &FresnelModel) -> f64 {
        let of = |c| (x.reflectance(c) - y.reflectance(c)).0.map(|d| d * d).iter().sum::<f64>();
        whole_degrees().map(of).sum()
    }

    #[test]
    fn is_nearer_than_the_conversion_that_keeps_r() {
        let hoffman = FresnelModel::Hoffman { r: Rgb([0.55, 0.56, 0.57]), h: Rgb([0.45, 0.5, 0.75]) };
        let kept = convert(&hoffman, ModelKind::Conductor, SPACE).unwrap().model;
        let nearest = nearest_conductor(&hoffman, SPACE).unwrap();
        assert!(squares(&nearest, &hoffman) < squares(&kept, &hoffman));
    }

    #[test]
    fn a_conductor_stays() {
        let copper = FresnelModel::Conductor { n: Rgb([0.2, 0.9, 1.2]), k: Rgb([3.6, 2.6, 2.4]) };
        assert!(squares(&nearest_conductor(&copper, SPACE).unwrap(), &copper) < 1e-12);
    }
}
