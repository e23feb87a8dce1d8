//! The parts of a picture a match reads, and the angle each pixel shows.

use std::ops::Range;

use super::MatchError;
use super::view::View;
use crate::fresnel::{CosTheta, Weights};
use crate::photo::area::pixel_range;
use crate::photo::{Area, Body, LightMode, MatchRequest, Photo};

/// Where r shows: the middle of the ball, up to 40°.
const INNER_DEG: Range<f64> = 0.0..40.0;
/// Where h shows: from 55° to 83°; beyond, edge pixels mix with the backdrop.
const OUTER_DEG: Range<f64> = 55.0..83.0;
/// What mirrors the backdrop just beside the rim.
const RIM_DEG: Range<f64> = 74.0..83.0;
/// Sectors around a band: what varies with the surroundings varies with the azimuth.
pub(super) const SECTORS: usize = 24;
/// Rings across a band.
pub(super) const RINGS: usize = 8;
/// Tiles each way across a picked area.
const TILES: usize = 8;

/// What a match reads: where r shows and where h shows.
#[derive(Debug)]
pub(super) struct Regions {
    /// Facing pixels.
    pub inner: Option<Region>,
    /// Grazing pixels.
    pub outer: Option<Region>,
}

/// A band of a body, or an area a person picked.
#[derive(Debug)]
pub(super) struct Region {
    shape: Shape,
    radial: Option<RadialTable>,
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

/// Where a pixel belongs: a block for the jackknife, a ring for the fit, the weights of its angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub block: usize,
    pub ring: usize,
    pub weights: Weights,
    pub cosine: f64,
    /// The surface normal, right and down; zero where there is no outline.
    pub normal: [f64; 2],
}

impl Regions {
    /// Lens blur carries the backdrop this far inside the outline, in pixels.
    pub const RIM_MARGIN_PX: f64 = 1.5;

    /// A picked area where there is one, else the band of the ball.
    pub fn of(view: &View, request: &MatchRequest) -> Result<Self, MatchError> {
        let regions = Self::with_body(request, request.body());
        if regions.inner.is_none() && regions.outer.is_none() {
            return Err(MatchError::NothingMarked);
        }
        for (region, what) in [(&regions.inner, "facing area"), (&regions.outer, "edge area")] {
            if let Some(region) = region
                && region.pixels(view.photo).next().is_none()
            {
                let what = if let Shape::Band { body, .. } = region.shape { body.noun() } else { what };
                return Err(MatchError::NoPixels { what });
            }
        }
        Ok(regions)
    }

    /// The same regions for another outline: what an error of the radius does.
    pub fn with_body(request: &MatchRequest, body: Option<Body>) -> Self {
        let margin = margin(request, body);
        let region = |picked: Option<Area>, band_deg: Range<f64>, facing: CosTheta| match (picked, body) {
            (Some(area), Some(body)) => Some(Region::new(Shape::OnBody { area, body, margin })),
            (Some(area), None) => Some(Region::new(Shape::Flat { area, facing })),
            (None, Some(body)) => Some(Region::new(Shape::band(body, band_deg, margin))),
            (None, None) => None,
        };
        if request.mode == LightMode::Backdrop {
            return Self { inner: None, outer: region(request.edge, RIM_DEG, CosTheta::MAX) };
        }
        Self {
            inner: region(request.facing, INNER_DEG, CosTheta::FACING),
            outer: region(request.edge, OUTER_DEG, CosTheta::MAX),
        }
    }

    /// The middle of a body, and all from 55° to its outline less the margin.
    pub fn to_the_rim(body: Body) -> Self {
        let band = |band_deg| Some(Region::new(Shape::band(body, band_deg, Self::RIM_MARGIN_PX / body.radius())));
        Self { inner: band(INNER_DEG), outer: band(OUTER_DEG.start..90.0) }
    }
}

/// The margin inside the outline as a share of the radius: that of the smaller of the bodies that are read.
fn margin(request: &MatchRequest, body: Option<Body>) -> f64 {
    let reference = request.reference_ball.as_ref().filter(|_| request.mode == LightMode::ReferenceBall);
    let radii = body.map(Body::radius).into_iter().chain(reference.map(|ball| ball.circle.radius));
    Regions::RIM_MARGIN_PX / radii.fold(f64::INFINITY, f64::min)
}

impl Shape {
    fn band(body: Body, band_deg: Range<f64>, margin: f64) -> Self {
        let rho = |angle_deg: f64| angle_deg.to_radians().sin();
        let to_rho = rho(band_deg.end).min(1.0 - margin);
        Self::Band { body, from_rho: rho(band_deg.start), to_rho }
    }
}

impl Region {
    fn new(shape: Shape) -> Self {
        let radial = shape.body().map(|body| RadialTable::of(body.radius()));
        Self { shape, radial }
    }

    /// True for a band of a body, false for a picked area.
    pub fn is_band(&self) -> bool {
        matches!(self.shape, Shape::Band { .. })
    }

    /// The picked area, if it is one.
    pub fn picked(&self) -> Option<Area> {
        match self.shape {
            Shape::Band { .. } => None,
            Shape::OnBody { area, .. } | Shape::Flat { area, .. } => Some(area),
        }
    }

    /// How many blocks the jackknife leaves out in turn.
    pub fn blocks(&self) -> usize {
        if self.is_band() { SECTORS } else { TILES * TILES }
    }

    /// The pixels of a picture that belong to it, each with its place.
    pub fn pixels(&self, photo: &Photo) -> impl Iterator<Item = (u32, u32, Place)> {
        self.rows(photo).flat_map(move |row| self.pixels_of_row(photo, row))
    }

    /// The rows of a picture that may hold pixels of it.
    pub fn rows(&self, photo: &Photo) -> impl Iterator<Item = u32> + use<> {
        let [_, y, _, height] = self.shape.bounds();
        pixel_range(y, height, photo.height).step_by(self.shape.stride())
    }

    /// The pixels of one row.
    pub fn pixels_of_row(&self, photo: &Photo, row: u32) -> impl Iterator<Item = (u32, u32, Place)> + use<'_> {
        let [x, _, width, _] = self.shape.bounds();
        let columns = pixel_range(x, width, photo.width).step_by(self.shape.stride());
        columns.filter_map(move |column| {
            let place = self.place(f64::from(column) + 0.5, f64::from(row) + 0.5)?;
            Some((column, row, place))
        })
    }

    /// True when part of a picked area lies beside the body.
    pub fn leaves_body(&self, photo: &Photo) -> bool {
        let is_outside = |(column, row)| self.place(f64::from(column) + 0.5, f64::from(row) + 0.5).is_none();
        self.picked().is_some_and(|area| area.pixels(photo.width, photo.height).any(is_outside))
    }

    fn place(&self, x: f64, y: f64) -> Option<Place> {
        match self.shape {
            Shape::Band { body, from_rho, to_rho } => {
                let rho = body.sine(x, y).filter(|rho| (from_rho..to_rho).contains(rho))?;
                let share = if from_rho > 0.0 {
                    (rho.asin() - from_rho.asin()) / (to_rho.asin() - from_rho.asin())
                } else {
                    body.area_share(rho, to_rho)
                };
                Some(self.place_on(body, body.part(x, y, SECTORS), ring(share), (x, y)))
            }
            Shape::OnBody { area, body, margin } => {
                let rho = body.sine(x, y).filter(|rho| *rho < 1.0 - margin)?;
                let ring = ring(body.area_share(rho, 1.0));
                area.contains(x, y).then(|| self.place_on(body, tile(area, x, y), ring, (x, y)))
            }
            Shape::Flat { area, facing } => area.contains(x, y).then(|| Place {
                block: tile(area, x, y),
                ring: 0,
                weights: Weights::at(facing),
                cosine: facing.get(),
                normal: [0.0; 2],
            }),
        }
    }

    fn place_on(&self, body: Body, block: usize, ring: usize, (x, y): (f64, f64)) -> Place {
        let normal = body.normal(x, y).unwrap_or_default();
        let rho = normal[0].hypot(normal[1]);
        Place { block, ring, weights: self.weights_at(rho), cosine: cosine(rho), normal }
    }

    fn weights_at(&self, rho: f64) -> Weights {
        self.radial.as_ref().map_or_else(|| Weights::at(CosTheta::FACING), |table| table.at(rho))
    }
}

impl Shape {
    fn body(self) -> Option<Body> {
        match self {
            Self::Band { body, .. } | Self::OnBody { body, .. } => Some(body),
            Self::Flat { .. } => None,
        }
    }

    /// Of a large ball every second pixel each way is read, or every third…: neighbours correlate, and
    /// the surroundings limit what is known long before 200 000 pixels do.
    fn stride(self) -> usize {
        const ENOUGH_RADIUS_PX: f64 = 250.0;
        let [_, _, width, height] = self.bounds();
        ((width.min(height) / 2.0 / ENOUGH_RADIUS_PX) as usize).max(1)
    }

    fn bounds(self) -> [f64; 4] {
        match self {
            Self::Band { body, .. } => body.bounds(),
            Self::OnBody { area, .. } | Self::Flat { area, .. } => area.bounds(),
        }
    }
}

/// cos θ of sin θ = ρ.
fn cosine(rho: f64) -> f64 {
    (1.0 - rho * rho).max(0.0).sqrt()
}

/// Rings of equal area, so that each weighs as much as it shows.
fn ring(share: f64) -> usize {
    ((share * RINGS as f64) as usize).min(RINGS - 1)
}

fn tile(area: Area, x: f64, y: f64) -> usize {
    let [left, top, width, height] = area.bounds();
    let index = |offset: f64, size: f64| ((offset / size * TILES as f64) as usize).min(TILES - 1);
    index(y - top, height) * TILES + index(x - left, width)
}

/// The weights over ρ, each the mean over a pixel's footprint.
///
/// Near the rim a pixel covers several degrees: on a ball of 100 px the one around 82° spans 80–84°.
#[derive(Debug)]
struct RadialTable(Vec<Weights>);

impl RadialTable {
    const STEPS: usize = 4096;

    fn of(radius_px: f64) -> Self {
        let rho = |step: usize| (step as f64 / Self::STEPS as f64).sqrt();
        Self((0..=Self::STEPS).map(|step| footprint_mean(rho(step), 1.0 / radius_px)).collect())
    }

    /// Linear in ρ² between the steps: that is where angles crowd.
    fn at(&self, rho: f64) -> Weights {
        let position = (rho * rho).clamp(0.0, 1.0) * Self::STEPS as f64;
        let step = (position as usize).min(Self::STEPS - 1);
        let share = position - step as f64;
        let mix = |of: fn(&Weights) -> f64| of(&self.0[step]) * (1.0 - share) + of(&self.0[step + 1]) * share;
        Weights { of_r: mix(|w| w.of_r), of_h: mix(|w| w.of_h), of_white: mix(|w| w.of_white) }
    }
}

/// The mean of the weights over `rho` ± half a pixel, by five points in its middle.
fn footprint_mean(rho: f64, pixel: f64) -> Weights {
    let points = [-0.4, -0.2, 0.0, 0.2, 0.4].map(|offset| {
        let rho = (rho + offset * pixel).clamp(0.0, 1.0);
        Weights::at(CosTheta::new((1.0 - rho * rho).sqrt()))
    });
    let mean = |of: fn(&Weights) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    Weights { of_r: mean(|w| w.of_r), of_h: mean(|w| w.of_h), of_white: mean(|w| w.of_white) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::Circle;

    #[test]
    fn the_footprint_shrinks_to_the_point() {
        for angle_deg in [0.0_f64, 30.0, 60.0, 82.0] {
            let rho = angle_deg.to_radians().sin();
            let point = Weights::at(CosTheta::from_deg(angle_deg));
            assert!((footprint_mean(rho, 1e-9).of_h - point.of_h).abs() < 1e-6);
            assert!((RadialTable::of(1e6).at(rho).of_h - point.of_h).abs() < 1e-3);
        }
    }

    #[test]
    fn bands_keep_clear_of_the_outline() {
        let photo = Photo::from_linear("test", 60, 60, vec![[1.0; 3]; 3600]);
        let circle = Circle::new(30.0, 30.0, 25.0);
        let request = MatchRequest { circle: Some(circle), ..MatchRequest::default() };
        let regions = Regions::with_body(&request, request.body());
        let farthest = |region: &Option<Region>| {
            let rho = |(x, y, _)| circle.rho(f64::from(x) + 0.5, f64::from(y) + 0.5);
            region.as_ref().unwrap().pixels(&photo).map(rho).fold(0.0, f64::max)
        };
        assert!(farthest(&regions.inner) <= 40.0_f64.to_radians().sin());
        assert!(farthest(&regions.outer) <= 1.0 - 1.5 / 25.0);
    }
}
