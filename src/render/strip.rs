//! Colour over the angle, as a strip: 0° left, 90° right.

use super::Picture;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::CosTheta;

/// The angle in the middle of each of `columns` equal columns from 0° to 90°.
pub fn strip_angles(columns: u32) -> impl ExactSizeIterator<Item = CosTheta> {
    (0..columns).map(move |column| CosTheta::from_deg((f64::from(column) + 0.5) * 90.0 / f64::from(columns)))
}

/// One row of colour for each reflectance, the first on top: by custom the truth above, the model below.
pub fn strip_picture(
    reflectances: &[&dyn Fn(CosTheta) -> Rgb],
    width: u32,
    row_height: u32,
    space: RgbSpace,
) -> Picture {
    let mut picture = Picture::new(width, row_height * reflectances.len() as u32, space);
    picture.coverage.fill(1.0);
    let rows_of_each = picture.linear.chunks_mut((width * row_height).max(1) as usize);
    for (reflectance, pixels) in reflectances.iter().zip(rows_of_each) {
        let colours: Vec<[f32; 3]> = strip_angles(width).map(|c| reflectance(c).0.map(|v| v as f32)).collect();
        pixels.chunks_mut(width as usize).for_each(|row| row.copy_from_slice(&colours));
    }
    picture
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::srgb8;
    use crate::fresnel::FresnelModel;
    use crate::metal::metal_by_name;

    #[test]
    fn colours_are_the_srgb_codes_of_truth_and_model() {
        let gold = metal_by_name("gold").unwrap();
        for space in RgbSpace::ALL {
            let model = FresnelModel::Hoffman { r: gold.r(space), h: gold.h(space) };
            let truth_of = |c| gold.reflectance(c, space);
            let model_of = |c| model.reflectance(c);
            let picture = strip_picture(&[&truth_of, &model_of], 45, 3, space).to_srgb8();
            assert_eq!((picture.width, picture.height), (45, 6));
            for (column, cos_theta) in strip_angles(45).enumerate() {
                assert_eq!(picture.rgb(column as u32, 0), srgb8(truth_of(cos_theta), space).0);
                assert_eq!(picture.rgb(column as u32, 5), srgb8(model_of(cos_theta), space).0);
            }
        }
    }
}
