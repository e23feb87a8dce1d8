//! The brightness of a picture across the edge of a body, part by part around it.

use std::ops::Range;

use crate::photo::area::pixel_range;
use crate::photo::{Body, Circle, Photo};

/// Parts around the edge: what stands behind and what is mirrored change from one to the next.
pub(super) const PARTS: usize = 24;
/// How far beside the edge pixels are read.
pub(super) const OUTSIDE_PX: f64 = 4.0;
/// Pixels of a part are averaged over this much depth, far less than any lens blurs.
const BIN_PX: f64 = 0.25;

/// What is read across the edge.
pub(super) struct Profile {
    /// Parts around the edge; those with too few pixels hold no bins.
    pub parts: Vec<Part>,
    /// Variance of one pixel, from what differs at the same depth.
    pub noise: f64,
    /// Least and largest depth, in pixels inside the edge.
    pub depth_px: [f64; 2],
}

/// One part of the edge.
#[derive(Clone, Default)]
pub(super) struct Part {
    /// Means over depths, from the outside in; none is empty.
    pub bins: Vec<Bin>,
    /// How far the edge here goes outwards for each of the other two unknowns of an outline.
    pub leads: [f64; 2],
}

/// The pixels of one depth.
#[derive(Clone, Copy, Default)]
pub(super) struct Bin {
    /// How many.
    pub count: f64,
    /// Mean depth inside the edge in pixels.
    pub depth_px: f64,
    /// Mean brightness.
    pub value: f64,
    /// Change of that mean if there is no tone curve.
    pub tone: f64,
    /// Sum of the squares of the brightness.
    squares: f64,
}

impl Bin {
    fn add(&mut self, depth_px: f64, value: f64, tone: f64) {
        self.count += 1.0;
        self.depth_px += depth_px;
        self.value += value;
        self.tone += tone;
        self.squares += value * value;
    }

    fn average(&mut self) {
        for sum in [&mut self.depth_px, &mut self.value, &mut self.tone] {
            *sum /= self.count;
        }
    }

    /// Sum of squares around the mean, after [`Self::average`].
    fn scatter(&self) -> f64 {
        (self.squares - self.count * self.value * self.value).max(0.0)
    }
}

impl Part {
    /// How far the edge of this part goes outwards with the three unknowns of an outline.
    pub fn shift(&self, change: [f64; 3]) -> f64 {
        change[0] + change[1] * self.leads[0] + change[2] * self.leads[1]
    }
}

impl Profile {
    /// Around the edge of a body. `leads` says of a point there how far the edge goes outwards when the second and
    /// the third unknown of the outline grow.
    pub fn of(photo: &Photo, body: Body, leads: &dyn Fn(f64, f64) -> [f64; 2]) -> Self {
        let inside_px = inside_px(body.radius());
        let count = ((OUTSIDE_PX + inside_px) / BIN_PX).ceil() as usize;
        let empty = Part { bins: vec![Bin::default(); count], leads: [0.0; 2] };
        let mut parts = vec![empty; PARTS];
        for (x, y, column, row) in pixels(photo, body, inside_px) {
            let Some([right, down]) = body.normal(x, y) else { continue };
            let depth_px = (1.0 - right.hypot(down)) * body.radius();
            let bin = ((depth_px + OUTSIDE_PX) / BIN_PX).floor();
            let Some([value, tone]) = brightness(photo, column, row) else { continue };
            let part = &mut parts[body.part(x, y, PARTS)];
            if bin >= 0.0 && (bin as usize) < count {
                part.bins[bin as usize].add(depth_px, value, tone);
                let leads = leads(x, y);
                part.leads = [part.leads[0] + leads[0], part.leads[1] + leads[1]];
            }
        }
        let mut noises: Vec<f64> = parts.iter_mut().filter_map(finish).collect();
        let noise = if noises.is_empty() { 0.0 } else { crate::number::median(&mut noises) };
        Self { parts, noise, depth_px: [-OUTSIDE_PX, inside_px] }
    }

    /// All parts in one, each moved to where a changed outline has its edge.
    pub fn whole(&self, change: [f64; 3]) -> Vec<Bin> {
        let count = ((self.depth_px[1] - self.depth_px[0]) / BIN_PX).ceil() as usize;
        let mut bins = vec![Bin::default(); count];
        for part in &self.parts {
            for bin in &part.bins {
                let depth_px = bin.depth_px + part.shift(change);
                let index = ((depth_px - self.depth_px[0]) / BIN_PX).floor();
                if index >= 0.0 && (index as usize) < count {
                    let sum = &mut bins[index as usize];
                    sum.count += bin.count;
                    sum.depth_px += bin.count * depth_px;
                    sum.value += bin.count * bin.value;
                }
            }
        }
        bins.retain(|bin| bin.count > 0.0);
        bins.iter_mut().for_each(Bin::average);
        bins
    }
}

/// Depth that is read: where r and h show beside the light, and little else.
fn inside_px(radius_px: f64) -> f64 {
    (0.08 * radius_px).clamp(5.0, 16.0)
}

/// Averages a part; the variance of one pixel in it, away from the edge, where a bin is level.
fn finish(part: &mut Part) -> Option<f64> {
    const CLEAR_OF_THE_EDGE: Range<f64> = -1.5..2.5;
    part.bins.retain(|bin| bin.count > 0.0);
    let count: f64 = part.bins.iter().map(|bin| bin.count).sum();
    part.leads = part.leads.map(|sum| sum / count.max(1.0));
    part.bins.iter_mut().for_each(Bin::average);
    let level = part.bins.iter().filter(|bin| !CLEAR_OF_THE_EDGE.contains(&bin.depth_px));
    let (scatter, freedom) =
        level.fold((0.0, 0.0), |(scatter, freedom), bin| (scatter + bin.scatter(), freedom + bin.count - 1.0));
    (freedom > 0.0).then(|| scatter / freedom)
}

/// The middles of the pixels that may lie across the edge, with their columns and rows.
fn pixels(photo: &Photo, body: Body, inside_px: f64) -> impl Iterator<Item = (f64, f64, u32, u32)> {
    let [_, y, _, height] = body.bounds();
    let width = photo.width;
    pixel_range(y - OUTSIDE_PX, height + 2.0 * OUTSIDE_PX, photo.height).flat_map(move |row| {
        let middle = f64::from(row) + 0.5;
        stretches(body, middle, inside_px).into_iter().flat_map(move |[from, to]| {
            pixel_range(from, to - from, width).map(move |column| (f64::from(column) + 0.5, middle, column, row))
        })
    })
}

/// Where a row of pixels crosses the edge: of a ball on its left and its right.
fn stretches(body: Body, y: f64, inside_px: f64) -> Vec<[f64; 2]> {
    let Body::Ball(Circle { x, y: centre, radius }) = body else {
        let [x, _, width, _] = body.bounds();
        return vec![[x - OUTSIDE_PX, x + width + OUTSIDE_PX]];
    };
    let half = |radius: f64| (radius * radius - (y - centre).powi(2)).max(0.0).sqrt();
    let (outer, inner) = (half(radius + OUTSIDE_PX), half((radius - inside_px).max(0.0)));
    if inner < 1.0 { vec![[x - outer, x + outer]] } else { vec![[x - outer, x - inner], [x + inner, x + outer]] }
}

/// Brightness of a pixel, and its change if there is no tone curve; `None` where it is no number.
///
/// A curve that lifts the middle moves the half-way point of an edge towards its dark side. Cameras have one about as
/// strong as the shoulder (1 − e^(−3x)) / 0.95, which lifts a half to 0.82; other pictures have none. Where the picture
/// may have one, 0.45 stands for 0.95, and the difference to none is uncertainty.
fn brightness(photo: &Photo, column: u32, row: u32) -> Option<[f64; 2]> {
    const STRENGTH: f64 = 0.45;
    let pixel = photo.pixel(column, row).filter(|pixel| !pixel.flags.non_finite)?;
    let luminance = 0.2126 * pixel.rgb[0] + 0.7152 * pixel.rgb[1] + 0.0722 * pixel.rgb[2];
    if photo.is_scene_linear() {
        return Some([luminance, 0.0]);
    }
    let value = -(1.0 - STRENGTH * luminance.clamp(0.0, 1.0)).ln() / STRENGTH;
    Some([value, luminance - value])
}
