//! Which parts of a picture a match reads.

use std::ops::Range;

use super::MatchError;
use super::region::Region;
use super::view::View;
use crate::fresnel::CosTheta;
use crate::photo::{Area, Body, LightMode, MatchRequest};

/// Where r shows: the middle of the ball, up to 40°.
const INNER_DEG: Range<f64> = 0.0..40.0;
/// Where h shows: from 55° to 83°; beyond, edge pixels mix with the backdrop.
const OUTER_DEG: Range<f64> = 55.0..83.0;
/// What mirrors the backdrop just beside the rim.
const RIM_DEG: Range<f64> = 74.0..83.0;

/// What a match reads: where r shows and where h shows.
#[derive(Debug)]
pub(super) struct Regions {
    /// Facing pixels.
    pub inner: Option<Region>,
    /// Grazing pixels.
    pub outer: Option<Region>,
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
                && region
                    .rows([view.photo.width, view.photo.height])
                    .all(|row| region.stretches(row, view.photo.width).is_empty())
            {
                let body = request.body().filter(|_| region.is_band());
                return Err(MatchError::NoPixels { what: body.map_or(what, Body::noun) });
            }
        }
        Ok(regions)
    }

    /// The same regions for another outline: what an error of the radius does.
    pub fn with_body(request: &MatchRequest, body: Option<Body>) -> Self {
        let margin = margin(request, body);
        let region = |picked: Option<Area>, band_deg: Range<f64>, facing: CosTheta| match (picked, body) {
            (Some(area), Some(body)) => Some(Region::on_body(area, body, margin)),
            (Some(area), None) => Some(Region::flat(area, facing)),
            (None, Some(body)) => Some(Region::band(body, band_deg, margin)),
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
        let band = |band_deg| Some(Region::band(body, band_deg, Self::RIM_MARGIN_PX / body.radius()));
        Self { inner: band(INNER_DEG), outer: band(OUTER_DEG.start..90.0) }
    }

    /// The same regions with fewer rows of large ones: enough for a difference between two fits, in which what the
    /// pixels have in common cancels.
    pub fn sparse(self) -> Self {
        let sparse = |region: Option<Region>| region.map(Region::sparse);
        Self { inner: sparse(self.inner), outer: sparse(self.outer) }
    }
}

/// The margin inside the outline as a share of the radius: that of the smaller of the bodies that are read.
fn margin(request: &MatchRequest, body: Option<Body>) -> f64 {
    let reference = request.reference_ball.as_ref().filter(|_| request.mode == LightMode::ReferenceBall);
    let radii = body.map(Body::radius).into_iter().chain(reference.map(|ball| ball.circle.radius));
    Regions::RIM_MARGIN_PX / radii.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::Circle;

    fn rows(radius: f64) -> [usize; 2] {
        let request = MatchRequest { circle: Some(Circle::new(radius, radius, radius)), ..MatchRequest::default() };
        let size = (2.0 * radius) as u32;
        let count = |regions: Regions| regions.inner.unwrap().rows([size, size]).count();
        let regions = || Regions::with_body(&request, request.body());
        [count(regions()), count(regions().sparse())]
    }

    /// A megapixel and four are read whole; of a ball of more than that some rows, and for a difference fewer still.
    #[test]
    fn every_row_is_read_unless_the_ball_is_very_large() {
        assert_eq!(rows(200.0), [400, 400]);
        assert_eq!(rows(564.0), [1128, 282]);
        assert_eq!(rows(1200.0), [2400, 150]);
        assert_eq!(rows(2000.0), [4000 / 3 + 1, 63]);
    }
}
