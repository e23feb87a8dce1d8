//! A row of a sphere's picture with the one that mirrors it: the light that is seen in them, and its reflection.

use std::ops::Range;

use super::disc::{HalfRow, Point, RIM_SAMPLE};
use super::radial::{Place, RadialTable};

/// A row in the upper half of the picture and its mirror image in the lower, but for the reflectance.
///
/// Both halves of both have the same angles, so that reflectance is looked up for a quarter of the sphere.
#[derive(Clone, Debug)]
pub(super) struct RowPair {
    /// How many pixels at either end lie beside the sphere.
    pub(super) beside: usize,
    /// How many are between.
    pub(super) covered: usize,
    /// How many samples of each pixel near the rim are on the sphere, in the left half.
    rim: Vec<u8>,
    /// The angles of those samples, one pixel after another.
    rim_angles: Vec<Place>,
    /// The angles of the other pixels, up to the middle.
    inner_angles: Vec<Place>,
    /// What the upper row mirrors and what the lower; `None` where that is white everywhere.
    lights: Option<[RowLight; 2]>,
}

/// What a row mirrors to the viewer.
#[derive(Clone, Debug)]
struct RowLight {
    /// Radiance of the samples near the rim, in the left half and in the right.
    rim: [Vec<[f32; 3]>; 2],
    /// Radiance of the pixels between, from left to right: for each channel, or for all where it is the same.
    inner: Vec<Vec<f32>>,
}

/// What a row needs while it is drawn; used for one after another.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    /// How much of each covered pixel is the sphere's, 0–1.
    coverage: Vec<f32>,
    /// Reflectance of the samples near the rim; the fourth number is nothing.
    rim: Vec<[f32; 4]>,
    /// Colour of the covered pixels near the rim and reflectance of those between, for each channel.
    colours: [Vec<f32>; 3],
}

/// What the covered pixels of a row show.
#[derive(Clone, Debug)]
pub(super) struct Shown<'a> {
    /// Colours, black where nothing is covered; but reflectances between the rims where there is a light.
    pub(super) colours: [&'a [f32]; 3],
    /// The radiance that those are multiplied by; `None` of white.
    pub(super) light: Option<[&'a [f32]; 3]>,
    /// The pixels between the rims.
    pub(super) between: Range<usize>,
    /// How much of each pixel is the sphere's, 0–1; 1 between the rims.
    pub(super) coverage: &'a [f32],
}

impl RowPair {
    /// A row of a picture of `size` × `size` pixels under the light from unit directions, or under white.
    pub(super) fn new<L: Fn([f64; 3]) -> [f32; 3]>(row: u32, size: u32, light: Option<&L>) -> Self {
        let half = HalfRow::new(row, size);
        let covered = size as usize - 2 * half.beside;
        let (rim, inner) = half.points.split_at(half.rim_points());
        // A middle pixel that is near the rim is in both halves.
        let width = covered.saturating_sub(2 * half.rim.len());
        let angles = |points: &[Point]| points.iter().map(|point| Place::of(point.cos_theta as f32)).collect();
        let lit = |light: &L, upward: f64| {
            RowLight::new((rim, inner), width, |point, rightward| {
                let [x, y, z] = point.mirrored;
                light([rightward * x, upward * y, z])
            })
        };
        Self {
            beside: half.beside,
            covered,
            rim_angles: angles(rim),
            inner_angles: angles(inner),
            lights: light.map(|light| [lit(light, 1.0), lit(light, -1.0)]),
            rim: half.rim,
        }
    }

    /// True where both rows, and both halves of them, are the same.
    pub(super) fn is_white(&self) -> bool {
        self.lights.is_none()
    }

    /// Looks up what the two rows share.
    pub(super) fn reflect(&self, reflectance: &RadialTable, scratch: &mut Scratch) {
        let (rim, half) = (self.rim.len(), self.rim.len() + self.inner_angles.len());
        scratch.resize(self.covered);
        scratch.rim.clear();
        scratch.rim.extend(self.rim_angles.iter().map(|angle| reflectance.at_place(*angle)));
        let [red, green, blue] = scratch.colours.each_mut().map(|plane| &mut plane[rim..half]);
        for (((angle, red), green), blue) in self.inner_angles.iter().zip(red).zip(green).zip(blue) {
            [*red, *green, *blue, _] = reflectance.at_place(*angle);
        }
        if self.is_white() {
            let means = by_pixel(&self.rim, &scratch.rim).map(|own| mean(own.iter().map(|[r, g, b, _]| [*r, *g, *b])));
            write((0..).zip(means), &mut scratch.colours);
        }
        scratch.coverage[..half].fill(1.0);
        for (coverage, count) in scratch.coverage.iter_mut().zip(&self.rim) {
            *coverage = f32::from(*count) * RIM_SAMPLE;
        }
        scratch.colours.iter_mut().chain([&mut scratch.coverage]).for_each(|plane| mirror(plane));
    }

    /// What the covered pixels of the upper row or the lower show; after [`Self::reflect`].
    pub(super) fn shown<'a>(&'a self, is_lower: bool, scratch: &'a mut Scratch) -> Shown<'a> {
        let Scratch { coverage, rim, colours } = scratch;
        let light = self.lights.as_ref().map(|lights| &lights[usize::from(is_lower)]);
        if let Some(light) = light {
            let [left, right] = light.rim.each_ref().map(|radiance| {
                let samples = by_pixel(&self.rim, rim).zip(by_pixel(&self.rim, radiance));
                samples.map(|(own, radiance)| mean(own.iter().zip(radiance).map(product)))
            });
            write((0..).zip(left), colours);
            write((0..self.covered).rev().zip(right), colours);
        }
        Shown {
            colours: colours.each_ref().map(Vec::as_slice),
            light: light.map(RowLight::between),
            between: self.between(),
            coverage,
        }
    }

    /// The covered pixels that are not near the rim. A middle pixel that is near it is in both halves.
    fn between(&self) -> Range<usize> {
        let rim = self.rim.len();
        rim..rim.max(self.covered - rim)
    }
}

impl RowLight {
    /// From the radiance that points of the left half, in their places and mirrored, show: of those near the rim and of
    /// the pixels between, `width` of which are in the whole row.
    fn new((rim, inner): (&[Point], &[Point]), width: usize, radiance: impl Fn(&Point, f64) -> [f32; 3]) -> Self {
        const LEFT: f64 = 1.0;
        const RIGHT: f64 = -1.0;
        let mut planes = [(); 3].map(|()| vec![0.0; width]);
        write((0..).zip(inner.iter().map(|point| radiance(point, LEFT))), &mut planes);
        write((0..width).rev().zip(inner[..width / 2].iter().map(|point| radiance(point, RIGHT))), &mut planes);
        // Less memory to read for each picture.
        let is_grey = planes[0] == planes[1] && planes[1] == planes[2];
        let inner = planes.into_iter().take(if is_grey { 1 } else { 3 }).collect();
        Self { rim: [LEFT, RIGHT].map(|side| rim.iter().map(|point| radiance(point, side)).collect()), inner }
    }

    /// Radiance of the pixels that are not near the rim, for each channel.
    fn between(&self) -> [&[f32]; 3] {
        let last = self.inner.len() - 1;
        std::array::from_fn(|channel| self.inner[channel.min(last)].as_slice())
    }
}

impl Scratch {
    fn resize(&mut self, covered: usize) {
        let planes = self.colours.iter_mut().chain([&mut self.coverage]);
        planes.for_each(|plane| plane.resize(covered, 0.0));
    }
}

/// What the samples of each pixel are, of which there are so many.
fn by_pixel<'a, T>(counts: &'a [u8], samples: &'a [T]) -> impl Iterator<Item = &'a [T]> {
    let mut rest = samples;
    counts.iter().map(move |count| {
        let (own, others) = rest.split_at(usize::from(*count));
        rest = others;
        own
    })
}

/// Black where there is none.
fn mean(samples: impl ExactSizeIterator<Item = [f32; 3]>) -> [f32; 3] {
    let count = samples.len();
    let sum = samples.fold([0.0; 3], |sum: [f32; 3], own| std::array::from_fn(|channel| sum[channel] + own[channel]));
    if count == 0 { sum } else { sum.map(|channel| channel / count as f32) }
}

fn product((reflectance, radiance): (&[f32; 4], &[f32; 3])) -> [f32; 3] {
    std::array::from_fn(|channel| reflectance[channel] * radiance[channel])
}

/// Writes colours where they belong.
fn write(colours: impl Iterator<Item = (usize, [f32; 3])>, planes: &mut [Vec<f32>; 3]) {
    for (at, colour) in colours {
        (0..3).for_each(|channel| planes[channel][at] = colour[channel]);
    }
}

/// Makes the right half the mirror image of the left.
pub(super) fn mirror<T: Copy>(row: &mut [T]) {
    let (left, right) = row.split_at_mut(row.len() / 2);
    right.iter_mut().rev().zip(left).for_each(|(right, left)| *right = *left);
}
