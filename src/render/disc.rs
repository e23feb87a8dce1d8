//! Where on a sphere the pixels of its picture lie: a view from afar, the sphere filling the square but for a margin of
//! one pixel.

/// The samples of a row of pixels in the upper half of the picture, or in the middle, from the left to the middle. What is
/// right of that or below mirrors it.
#[derive(Clone, Debug, Default)]
pub(super) struct HalfRow {
    /// How many pixels lie beside the sphere.
    pub(super) beside: usize,
    /// How many samples of each pixel near the rim, which are next, are on the sphere; from 0 to 16.
    pub(super) rim: Vec<u8>,
    /// The samples of those, one pixel after another, then one of each further pixel, its middle.
    pub(super) points: Vec<Point>,
}

/// A point of the sphere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Cosine between the surface's normal and the view.
    pub(super) cos_theta: f64,
    /// Where the view is mirrored to: x right, y up, the viewer at +z.
    pub(super) mirrored: [f64; 3],
}

/// Samples across a pixel near the rim.
const RIM_SAMPLES: u32 = 4;

/// How much of a pixel near the rim each of its samples covers.
pub(super) const RIM_SAMPLE: f32 = 1.0 / (RIM_SAMPLES * RIM_SAMPLES) as f32;

impl HalfRow {
    /// A row of a picture of `size` × `size` pixels.
    pub(super) fn new(row: u32, size: u32) -> Self {
        let mut half = Self::default();
        for column in 0..size.div_ceil(2) {
            if is_near_rim(column, row, size) {
                let before = half.points.len();
                half.points.extend(rim_samples(column, row, size));
                half.rim.push((half.points.len() - before) as u8);
            } else {
                let middle = Point::at(f64::from(column) + 0.5, f64::from(row) + 0.5, size);
                half.beside += usize::from(middle.is_none());
                half.points.extend(middle);
            }
        }
        half
    }

    /// How many of the points are of pixels near the rim.
    pub(super) fn rim_points(&self) -> usize {
        self.rim.iter().map(|count| usize::from(*count)).sum()
    }
}

fn rim_samples(column: u32, row: u32, size: u32) -> impl Iterator<Item = Point> {
    let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(RIM_SAMPLES);
    let sample = move |index: u32| {
        let (across, down) = (offset(index % RIM_SAMPLES), offset(index / RIM_SAMPLES));
        Point::at(f64::from(column) + across, f64::from(row) + down, size)
    };
    (0..RIM_SAMPLES * RIM_SAMPLES).filter_map(sample)
}

impl Point {
    /// The point at a place of the picture; `None` beside the sphere.
    fn at(column: f64, row: f64, size: u32) -> Option<Self> {
        let (x, y) = on_disc(column, row, size);
        let z_squared = 1.0 - x * x - y * y;
        let cos_theta = (z_squared >= 0.0).then(|| z_squared.sqrt())?;
        // 2 (n·v) n − v with v along z.
        Some(Self { cos_theta, mirrored: [2.0 * cos_theta * x, 2.0 * cos_theta * y, 2.0 * z_squared - 1.0] })
    }
}

/// A place of the picture on the unit disc, y up.
fn on_disc(column: f64, row: f64, size: u32) -> (f64, f64) {
    let centre = f64::from(size) / 2.0;
    let radius = centre - 1.0;
    ((column - centre) / radius, (centre - row) / radius)
}

/// True from θ ≈ 64° outwards, up to the farthest corner of a pixel that the disc can touch, where a pixel spans so much
/// of the cosine that its middle does not stand for it.
fn is_near_rim(column: u32, row: u32, size: u32) -> bool {
    /// F bends by at most 140 over the cosine: a mean over this much of it is within .001 of its middle.
    const MOST_COSINE: f64 = 0.0125;
    let (x, y) = on_disc(f64::from(column) + 0.5, f64::from(row) + 0.5, size);
    let pixel = 1.0 / f64::from(size / 2 - 1);
    let (rho, margin) = (x.hypot(y), 2.0 * pixel);
    let cosine_of_pixel = rho * pixel / (1.0 - rho * rho).max(0.0).sqrt();
    (0.9 - margin..1.0 + margin).contains(&rho) && cosine_of_pixel > MOST_COSINE
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels beside the sphere, then those near its rim, then the others: no row has them in another order.
    #[test]
    fn rows_are_beside_then_rim_then_middles() {
        for size in [8_u32, 9, 33, 128, 1023, 1024] {
            for row in 0..size.div_ceil(2) {
                let half = HalfRow::new(row, size);
                let (beside, rim) = (half.beside as u32, half.rim.len() as u32);
                let is_rim = |column| is_near_rim(column, row, size);
                assert!((0..beside).all(|column| !is_rim(column)), "{size} {row}");
                assert!((beside..beside + rim).all(is_rim), "{size} {row}");
                let others = half.points.len() - half.rim_points();
                assert_eq!((beside + rim) as usize + others, size.div_ceil(2) as usize);
            }
        }
    }

    #[test]
    fn points_mirror_the_view_about_their_normals() {
        let half = HalfRow::new(20, 65);
        for Point { cos_theta, mirrored: [x, y, z] } in half.points {
            assert!((x.hypot(y).hypot(z) - 1.0).abs() < 1e-12);
            // The mirrored direction is twice as far from the view as the normal is.
            assert!((z - (2.0 * cos_theta * cos_theta - 1.0)).abs() < 1e-12 && x <= 0.0 && y >= 0.0);
        }
    }
}
