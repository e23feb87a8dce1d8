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
        let regions = Self::with_body(request, request.body()).in_memory(view);
        if regions.inner.is_none() && regions.outer.is_none() {
            return Err(MatchError::NothingMarked);
        }
        for (region, what) in [(&regions.inner, "facing area"), (&regions.outer, "edge area")] {
            if let Some(region) = region
                && region.rows(view.size()).all(|row| region.stretches(row, view.photo.width).is_empty())
            {
                let body = request.body().filter(|_| region.is_band());
                return Err(MatchError::NoPixels { what: body.map_or(what, Body::noun) });
            }
        }
        Ok(regions)
    }

    /// The regions of an outline, with all of their rows.
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
    pub fn to_the_rim(view: &View, body: Body) -> Self {
        let band = |band_deg| Some(Region::band(body, band_deg, Self::RIM_MARGIN_PX / body.radius()));
        Self { inner: band(INNER_DEG), outer: band(OUTER_DEG.start..90.0) }.in_memory(view)
    }

    /// The regions of another outline of the body, for what an error of the radius does. Of large ones fewer rows are
    /// read, the same for every outline: what their pixels have in common cancels in a difference.
    pub fn of_another(&self, outline: Body, request: &MatchRequest, picture_size: [u32; 2]) -> Self {
        let in_rows_of = |region: Option<Region>, nominal: Option<Region>| {
            region.zip(nominal).map(|(region, nominal)| region.in_rows_of(nominal.sparse(picture_size)))
        };
        let Self { inner, outer } = Self::with_body(request, Some(outline));
        Self { inner: in_rows_of(inner, self.inner), outer: in_rows_of(outer, self.outer) }
    }

    fn in_memory(self, view: &View) -> Self {
        let in_memory = |region: Option<Region>| region.map(|region| region.in_memory(view.size()));
        Self { inner: in_memory(self.inner), outer: in_memory(self.outer) }
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

    fn middle_of_ball(radius: f64) -> Region {
        let request = MatchRequest { circle: Some(Circle::new(2000.0, 2000.0, radius)), ..MatchRequest::default() };
        Regions::with_body(&request, request.body()).inner.unwrap()
    }

    /// A megapixel and four are read whole; of a ball of more than that some rows, and for a difference fewer still.
    #[test]
    fn every_row_is_read_unless_the_ball_is_very_large() {
        let rows = |radius: f64| {
            let size = [4000; 2];
            let region = middle_of_ball(radius).in_memory(size);
            [region, region.sparse(size)].map(|region| region.rows(size).count())
        };
        assert_eq!(rows(200.0), [400, 400]);
        assert_eq!(rows(564.0), [1128, 282]);
        assert_eq!(rows(1200.0), [2400, 150]);
        assert_eq!(rows(2000.0), [4000 / 3 + 1, 63]);
    }

    /// Where the number of rows would jump with the radius, too, a difference rests on the same ones.
    #[test]
    fn outlines_that_differ_are_read_in_the_same_rows() {
        let circle = Circle::new(2000.0, 2000.0, 750.0);
        let request = MatchRequest { circle: Some(circle), ..MatchRequest::default() };
        let (body, size) = (Body::Ball(circle), [4000; 2]);
        let nominal = Regions::with_body(&request, Some(body));
        let [smaller, larger] = [749.5, 750.5].map(|radius| {
            let regions = nominal.of_another(body.with_radius(radius), &request, size);
            regions.outer.unwrap().rows(size).collect::<Vec<_>>()
        });
        let beside = larger.iter().filter(|row| !smaller.contains(row)).count();
        assert!(smaller.iter().all(|row| larger.contains(row)) && beside <= 2, "{smaller:?} {larger:?}");
    }

    /// How much of an area lies beside the picture says nothing about how many rows there are to read.
    #[test]
    fn an_area_far_beyond_the_picture_is_read_in_it() {
        let size = [60, 60];
        let rows = |area: Area| {
            let region = Region::flat(area, CosTheta::MAX).in_memory(size);
            [region, region.sparse(size)].map(|region| region.rows(size).count())
        };
        assert_eq!(rows(Area::rectangle(-1e9, 5.0, 2e9, 2.0)), [2, 2]);
        assert_eq!(rows(Area::rectangle(-1e9, -1e9, 2e9, 2e9)), [60, 60]);
    }
}
