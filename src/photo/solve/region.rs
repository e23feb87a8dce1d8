//! A part of a picture that a match reads, cut into cells, and the angle each pixel shows.

use std::ops::Range;

use super::facing::Facings;
use super::stretch::{Stretch, crossings_of_ball, crossings_of_cylinder};
use crate::fresnel::{CosTheta, Weights};
use crate::photo::area::pixel_range;
use crate::photo::{Area, Body, Photo};

/// Sectors around a band: what varies with the surroundings varies with the azimuth.
pub(super) const SECTORS: usize = 24;
/// Rings across a band.
pub(super) const RINGS: usize = 8;
/// Tiles each way across a picked area.
const TILES: usize = 8;

/// A band of a body, or an area a person picked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    shape: Shape,
    /// sin θ where a ring begins, and where the last one ends.
    rings: [f64; RINGS + 1],
    /// One row in so many is read.
    row_step: u32,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    /// A band of a body between two angles, as their sines.
    Band { body: Body, from_rho: f64, to_rho: f64 },
    /// An area on a body, where the outline gives the angles.
    OnBody { area: Area, body: Body, margin: f64 },
    /// An area of one known angle.
    Flat { area: Area, facing: CosTheta },
}

impl Shape {
    /// Rings across the middle and across a picked area weigh as much as they show; those of a band of grazing angles
    /// are of equal angles.
    fn rings(self) -> [f64; RINGS + 1] {
        std::array::from_fn(|ring| {
            let share = ring as f64 / RINGS as f64;
            match self {
                Self::Band { from_rho, to_rho, .. } if from_rho > 0.0 => {
                    (from_rho.asin() + share * (to_rho.asin() - from_rho.asin())).sin()
                }
                Self::Band { body, to_rho, .. } => body.sine_of_area_share(share, to_rho),
                Self::OnBody { body, margin, .. } => body.sine_of_area_share(share, 1.0).min(1.0 - margin),
                Self::Flat { .. } => 0.0,
            }
        })
    }

    fn body(self) -> Option<Body> {
        match self {
            Self::Band { body, .. } | Self::OnBody { body, .. } => Some(body),
            Self::Flat { .. } => None,
        }
    }

    fn area(self) -> Option<Area> {
        match self {
            Self::Band { .. } => None,
            Self::OnBody { area, .. } | Self::Flat { area, .. } => Some(area),
        }
    }

    fn bounds(self) -> [f64; 4] {
        match self {
            Self::Band { body, .. } => body.bounds(),
            Self::OnBody { area, .. } | Self::Flat { area, .. } => area.bounds(),
        }
    }
}

impl Region {
    /// The band of a body between two angles, up to `margin` inside its outline, as a share of the radius.
    pub fn band(body: Body, band_deg: Range<f64>, margin: f64) -> Self {
        let rho = |angle_deg: f64| angle_deg.to_radians().sin();
        let to_rho = rho(band_deg.end).min(1.0 - margin);
        Self::new(Shape::Band { body, from_rho: rho(band_deg.start), to_rho })
    }

    /// An area on a body, which gives the angles, but for what lies beyond its margin.
    pub fn on_body(area: Area, body: Body, margin: f64) -> Self {
        Self::new(Shape::OnBody { area, body, margin })
    }

    /// An area of one known angle.
    pub fn flat(area: Area, facing: CosTheta) -> Self {
        Self::new(Shape::Flat { area, facing })
    }

    fn new(shape: Shape) -> Self {
        Self { shape, rings: shape.rings(), row_step: 1 }
    }

    /// With few enough rows to stay in memory while they are fitted: 16 bytes for each pixel, 32 for one that some
    /// channel cannot use.
    pub fn in_memory(self, picture_size: [u32; 2]) -> Self {
        /// Of a rectangle of more pixels than this every second row is read, or every third…
        const MOST_PIXELS: usize = 6_000_000;
        let [columns, rows] = self.pixel_ranges(picture_size);
        let row_step = (columns.len() * rows.len()).div_ceil(MOST_PIXELS).max(1) as u32;
        Self { row_step, ..self }
    }

    /// With as many pixels as a ball of 250 to 500 in radius has.
    pub fn sparse(self, picture_size: [u32; 2]) -> Self {
        const ENOUGH_PX: usize = 500;
        let [columns, rows] = self.pixel_ranges(picture_size);
        let times = (columns.len().min(rows.len()) / ENOUGH_PX) as u32;
        Self { row_step: times.saturating_pow(2).max(self.row_step), ..self }
    }

    /// With one row in so many as another.
    pub fn in_rows_of(self, other: Self) -> Self {
        Self { row_step: other.row_step, ..self }
    }

    /// The columns and rows of a picture that its bounds may touch.
    fn pixel_ranges(&self, [picture_width, picture_height]: [u32; 2]) -> [Range<u32>; 2] {
        let [x, y, width, height] = self.shape.bounds();
        [pixel_range(x, width, picture_width), pixel_range(y, height, picture_height)]
    }

    /// True for a band of a body, false for a picked area.
    pub fn is_band(&self) -> bool {
        matches!(self.shape, Shape::Band { .. })
    }

    /// The picked area, if it is one.
    pub fn picked(&self) -> Option<Area> {
        self.shape.area()
    }

    /// What a pixel that shows this cosine weighs r, h and white by.
    pub fn weights(&self, cosine: f64) -> Weights {
        match self.shape {
            Shape::Band { body, .. } | Shape::OnBody { body, .. } => footprint_mean(cosine, 1.0 / body.radius()),
            Shape::Flat { facing, .. } => Weights::at(facing),
        }
    }

    /// How many blocks the jackknife leaves out in turn.
    pub fn blocks(&self) -> usize {
        if self.is_band() { SECTORS } else { TILES * TILES }
    }

    /// The rows of a picture that may hold pixels of it.
    pub fn rows(&self, picture_size: [u32; 2]) -> impl Iterator<Item = u32> + use<> {
        let ([_, rows], row_step) = (self.pixel_ranges(picture_size), self.row_step);
        rows.filter(move |row| row % row_step == 0)
    }

    /// The pixels of a row, cut where cells end, from left to right.
    pub fn stretches(&self, row: u32, picture_width: u32) -> Vec<Stretch> {
        let y = f64::from(row) + 0.5;
        let columns = self.columns(row, picture_width);
        Stretch::between(columns, &self.crossings(y), |x| self.cell(x, y))
    }

    fn columns(&self, row: u32, picture_width: u32) -> Range<u32> {
        let [x, _, width, _] = self.shape.bounds();
        self.shape.area().map_or_else(|| pixel_range(x, width, picture_width), |area| area.columns(row, picture_width))
    }

    /// Where a row crosses from one cell to another, or out of the region, in any order.
    fn crossings(&self, y: f64) -> Vec<f64> {
        let parts = if self.is_band() { SECTORS } else { 0 };
        let mut crossings = match self.shape.body() {
            Some(Body::Ball(circle)) => crossings_of_ball(circle, &self.rings, parts, y),
            Some(Body::Cylinder(cylinder)) => crossings_of_cylinder(cylinder, &self.rings, parts, y),
            None => Vec::new(),
        };
        if let Some(area) = self.shape.area() {
            let [left, _, width, _] = area.bounds();
            crossings.extend((1..TILES).map(|tile| left + width * tile as f64 / TILES as f64));
        }
        crossings
    }

    /// The cell of a point in the columns of its row: block times [`RINGS`] plus ring; `None` where there is none.
    fn cell(&self, x: f64, y: f64) -> Option<usize> {
        let block = |body: Body| self.shape.area().map_or_else(|| body.part(x, y, SECTORS), |area| tile(area, x, y));
        match self.shape {
            Shape::Band { body, .. } | Shape::OnBody { body, .. } => {
                let ring = self.ring(body.sine(x, y)?)?;
                Some(block(body) * RINGS + ring)
            }
            Shape::Flat { area, .. } => Some(tile(area, x, y) * RINGS),
        }
    }

    /// `None` beyond the last ring, and everywhere where the margin leaves nothing: rings would descend there.
    fn ring(&self, rho: f64) -> Option<usize> {
        let is_in_one = self.rings[0] <= rho && rho < self.rings[RINGS];
        is_in_one.then(|| self.rings[1..RINGS].iter().filter(|start| rho >= **start).count())
    }

    /// True when part of a picked area lies beside the body.
    pub fn leaves_body(&self, photo: &Photo) -> bool {
        let is_outside = |(column, row)| self.cell(f64::from(column) + 0.5, f64::from(row) + 0.5).is_none();
        self.picked().is_some_and(|area| area.pixels(photo.width, photo.height).any(is_outside))
    }

    /// Which way the pixels of a row face.
    pub fn facings(&self, row: u32) -> Facings {
        let y = f64::from(row) + 0.5;
        match self.shape {
            Shape::Band { body, .. } | Shape::OnBody { body, .. } => Facings::along(body, y),
            Shape::Flat { facing, .. } => Facings::even(facing),
        }
    }
}

/// The mean of the weights over a pixel of this size, in radii: half a pixel each way, by five points in its middle.
///
/// Near the rim a pixel covers several degrees: on a ball of 100 px the one around 82° spans 80–84°.
fn footprint_mean(cosine: f64, pixel: f64) -> Weights {
    let rho = (1.0 - cosine * cosine).sqrt();
    let points = [-0.4, -0.2, 0.0, 0.2, 0.4].map(|offset| {
        let rho = (rho + offset * pixel).clamp(0.0, 1.0);
        Weights::at(CosTheta::new((1.0 - rho * rho).sqrt()))
    });
    let mean = |of: fn(&Weights) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    Weights { of_r: mean(|w| w.of_r), of_h: mean(|w| w.of_h), of_white: mean(|w| w.of_white) }
}

fn tile(area: Area, x: f64, y: f64) -> usize {
    let [left, top, width, height] = area.bounds();
    let index = |offset: f64, size: f64| ((offset / size * TILES as f64) as usize).min(TILES - 1);
    index(y - top, height) * TILES + index(x - left, width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::{Circle, Cylinder};

    fn pixels(region: &Region) -> Vec<(u32, u32, usize)> {
        let of_row = |row| region.stretches(row, 60).into_iter().map(move |stretch| (row, stretch));
        let stretches = region.rows([60, 60]).flat_map(of_row);
        stretches.flat_map(|(row, Stretch { columns, cell })| columns.map(move |column| (column, row, cell))).collect()
    }

    #[test]
    fn the_footprint_shrinks_to_the_point() {
        for angle_deg in [0.0_f64, 30.0, 60.0, 82.0] {
            let point = Weights::at(CosTheta::from_deg(angle_deg));
            assert!((footprint_mean(angle_deg.to_radians().cos(), 1e-9).of_h - point.of_h).abs() < 1e-6);
        }
    }

    #[test]
    fn bands_keep_clear_of_the_outline() {
        let circle = Circle::new(30.0, 30.0, 25.0);
        let farthest = |band_deg: Range<f64>| {
            let rho = |(x, y, _)| circle.rho(f64::from(x) + 0.5, f64::from(y) + 0.5);
            pixels(&Region::band(Body::Ball(circle), band_deg, 1.5 / 25.0)).into_iter().map(rho).fold(0.0, f64::max)
        };
        assert!(farthest(0.0..40.0) <= 40.0_f64.to_radians().sin());
        assert!(farthest(55.0..83.0) <= 1.0 - 1.5 / 25.0);
    }

    /// The margin of a small ball covers a band close to its rim: there is nothing to measure.
    #[test]
    fn a_band_within_the_margin_holds_nothing() {
        let rim = |radius: f64| {
            let ball = Body::Ball(Circle::new(30.0, 30.0, radius));
            pixels(&Region::band(ball, 74.0..83.0, 1.5 / radius)).len()
        };
        assert_eq!([1.0, 8.0, 25.0].map(rim), [0; 3]);
    }

    /// Stretches hold every pixel of a region, and each in the cell that its own place gives.
    #[test]
    fn stretches_hold_what_each_pixel_alone_gives() {
        let ball = Body::Ball(Circle::new(29.7, 31.2, 24.6));
        let around_a_row = Body::Ball(Circle::new(29.7, 30.5, 24.6));
        let cylinder = Body::Cylinder(Cylinder::new([8.3, 12.1], [51.9, 44.7], 13.4));
        for body in [ball, around_a_row, cylinder] {
            let margin = 1.5 / body.radius();
            let regions = [
                Region::band(body, 0.0..40.0, margin),
                Region::band(body, 55.0..83.0, margin),
                Region::on_body(Area::disc(31.3, 28.9, 20.2), body, margin),
                Region::on_body(Area::rectangle(-4.0, 17.3, 50.0, 30.1), body, margin),
                Region::flat(Area::rectangle(10.2, 17.3, 20.0, 50.1), CosTheta::MAX),
            ];
            for region in regions {
                let is_inside = |x, y| region.picked().is_none_or(|area| area.contains(x, y));
                let of_pixel = |column: u32, row: u32| {
                    let (x, y) = (f64::from(column) + 0.5, f64::from(row) + 0.5);
                    region.cell(x, y).filter(|_| is_inside(x, y)).map(|cell| (column, row, cell))
                };
                let expected: Vec<_> = (0..3600).filter_map(|i| of_pixel(i % 60, i / 60)).collect();
                assert!(!expected.is_empty());
                assert_eq!(pixels(&region), expected, "{region:?}");
            }
        }
    }
}
