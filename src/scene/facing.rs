//! The angles of a rendered facing-ratio pass, of each material by ids or mattes.

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::Angles;
use crate::fresnel::CosTheta;
use crate::photo::Plane;

/// How far above 1 a ratio may be by rounding: half floats near 1 have steps of 5e-4.
const ROUNDING: f32 = 1e-3;

/// Pixels that one thread counts at once.
const CHUNK: usize = 1 << 16;

/// A pass of cosines between normal and view.
#[derive(Clone, Debug)]
pub struct FacingPass {
    /// The cosines.
    pub ratio: Plane,
}

/// What tells the materials of a pass apart.
#[derive(Clone, Debug)]
pub enum Masks {
    /// Nothing: every material is seen at all the angles of the pass.
    None,
    /// A picture of whole numbers, one for each material.
    Ids(Plane),
    /// One picture for each material, by its share of each pixel.
    Mattes(Vec<Plane>),
}

/// What was found of the pixels of a pass. Nothing is clamped: what is no cosine is left out and counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FacingReport {
    /// All pixels.
    pub pixels: u64,
    /// With a cosine above 0, and so counted.
    pub seen: u64,
    /// Without a surface: a ratio of exactly 0, or nothing covered.
    pub background: u64,
    /// Above 1 by rounding, and counted as facing.
    pub rounded: u64,
    /// Above 1 by more, left out.
    pub above_one: u64,
    /// Below 0, which faces away, left out.
    pub below_zero: u64,
    /// NaN or infinite, left out.
    pub not_finite: u64,
    /// Seen, but of no material that was asked for.
    pub unassigned: u64,
}

/// The angles of each material, in the order asked for, and what was found.
#[derive(Clone, Debug)]
pub struct Seen {
    /// One for each id, each matte, or one for the whole pass.
    pub angles: Vec<Angles>,
    /// What was found of the pixels.
    pub report: FacingReport,
}

/// What one pixel of the pass is.
enum Ratio {
    Surface(f32),
    Rounded,
    Background,
    AboveOne,
    BelowZero,
    NotFinite,
}

impl Ratio {
    fn of(value: f32, coverage: f32) -> Self {
        match value {
            _ if coverage <= 0.0 => Self::Background,
            v if !v.is_finite() || !coverage.is_finite() => Self::NotFinite,
            0.0 => Self::Background,
            v if v < 0.0 => Self::BelowZero,
            v if v <= 1.0 => Self::Surface(v),
            v if v <= 1.0 + ROUNDING => Self::Rounded,
            _ => Self::AboveOne,
        }
    }
}

impl FacingPass {
    /// The angles of the materials with these ids, in one run over the pixels; ids count only with [`Masks::Ids`].
    ///
    /// A sentence where the pictures do not fit together.
    pub fn angles(&self, masks: &Masks, ids: &[u32]) -> Result<Seen, String> {
        let others: Vec<&Plane> = match masks {
            Masks::None => Vec::new(),
            Masks::Ids(plane) => vec![plane],
            Masks::Mattes(planes) => planes.iter().collect(),
        };
        let size = (self.ratio.width, self.ratio.height);
        if let Some(other) = others.iter().find(|other| (other.width, other.height) != size) {
            let Plane { name, width, height, .. } = other;
            return Err(format!(
                "{name} has {width} × {height} pixels and {} {} × {}",
                self.ratio.name, size.0, size.1
            ));
        }
        let index: BTreeMap<u32, usize> = ids.iter().enumerate().map(|(index, id)| (*id, index)).collect();
        let count = match masks {
            Masks::None => 1,
            Masks::Ids(_) => ids.len(),
            Masks::Mattes(planes) => planes.len(),
        };
        let empty = || Seen { angles: vec![Angles::default(); count], report: FacingReport::default() };
        let starts = (0..self.ratio.values.len()).into_par_iter().step_by(CHUNK);
        let seen = starts.fold(empty, |mut seen, start| {
            self.count(start, masks, &index, &mut seen);
            seen
        });
        Ok(seen.reduce(empty, Seen::with))
    }

    /// Counts the pixels of one chunk.
    fn count(&self, start: usize, masks: &Masks, index: &BTreeMap<u32, usize>, seen: &mut Seen) {
        let end = (start + CHUNK).min(self.ratio.values.len());
        let report = &mut seen.report;
        // Neighbours mostly share their id.
        let mut last: (f32, Option<usize>) = (f32::NAN, None);
        for pixel in start..end {
            report.pixels += 1;
            let coverage = self.ratio.coverage.as_ref().map_or(1.0, |coverage| coverage[pixel]);
            let ratio = match Ratio::of(self.ratio.values[pixel], coverage) {
                Ratio::Surface(ratio) => ratio,
                Ratio::Rounded => {
                    report.rounded += 1;
                    1.0
                }
                other => {
                    report.leave_out(&other);
                    continue;
                }
            };
            report.seen += 1;
            let cos_theta = CosTheta::new(f64::from(ratio));
            let weight = f64::from(coverage.min(1.0));
            match masks {
                Masks::None => seen.angles[0].add(cos_theta, weight),
                Masks::Ids(ids) => {
                    let id = ids.values[pixel];
                    if id != last.0 {
                        last = (id, whole(id).and_then(|id| index.get(&id).copied()));
                    }
                    match last.1 {
                        Some(material) => seen.angles[material].add(cos_theta, weight),
                        None => report.unassigned += 1,
                    }
                }
                Masks::Mattes(mattes) => {
                    let mut is_any = false;
                    for (angles, matte) in seen.angles.iter_mut().zip(mattes) {
                        let share = matte.values[pixel];
                        if share > 0.0 && share.is_finite() {
                            angles.add(cos_theta, weight * f64::from(share.min(1.0)));
                            is_any = true;
                        }
                    }
                    report.unassigned += u64::from(!is_any);
                }
            }
        }
    }
}

/// The whole number that a value is; a mixture at an edge is none.
fn whole(value: f32) -> Option<u32> {
    let is_whole = value.fract() == 0.0 && (0.0..=16_777_216.0).contains(&value);
    is_whole.then_some(value as u32)
}

impl Seen {
    fn with(mut self, other: Self) -> Self {
        self.angles.iter_mut().zip(&other.angles).for_each(|(angles, more)| angles.merge(more));
        self.report = self.report.with(other.report);
        self
    }
}

impl FacingReport {
    fn leave_out(&mut self, ratio: &Ratio) {
        match ratio {
            Ratio::Surface(_) | Ratio::Rounded => {}
            Ratio::Background => self.background += 1,
            Ratio::AboveOne => self.above_one += 1,
            Ratio::BelowZero => self.below_zero += 1,
            Ratio::NotFinite => self.not_finite += 1,
        }
    }

    fn with(self, other: Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            seen: self.seen + other.seen,
            background: self.background + other.background,
            rounded: self.rounded + other.rounded,
            above_one: self.above_one + other.above_one,
            below_zero: self.below_zero + other.below_zero,
            not_finite: self.not_finite + other.not_finite,
            unassigned: self.unassigned + other.unassigned,
        }
    }

    /// Sentences about what was left out.
    pub fn sentences(&self) -> Vec<String> {
        let told = [
            (self.above_one, "are above 1, which no cosine is, and were left out"),
            (self.below_zero, "are below 0, which faces away from the eye, and were left out"),
            (self.not_finite, "are no numbers and were left out"),
            (self.rounded, "are above 1 by rounding and count as facing"),
            (self.unassigned, "belong to no material that was named"),
        ];
        let of = |count: u64| if count == 1 { "1 pixel".to_owned() } else { format!("{count} pixels") };
        let share = |count: u64| 100.0 * count as f64 / self.pixels.max(1) as f64;
        let told = told.into_iter().filter(|(count, _)| *count > 0);
        let mut sentences: Vec<String> =
            told.map(|(count, what)| format!("{} ({:.1} %) {what}", of(count), share(count))).collect();
        if self.seen == 0 {
            sentences.push("No pixel of the pass shows a surface".to_owned());
        }
        sentences
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Shape;

    fn plane(width: u32, values: Vec<f32>) -> Plane {
        Plane {
            name: "made".to_owned(),
            width,
            height: values.len() as u32 / width,
            channel: "Y".to_owned(),
            values,
            coverage: None,
            warnings: Vec::new(),
        }
    }

    #[test]
    fn what_is_no_cosine_is_counted_and_left_out() {
        let values = vec![0.5, 0.0, -0.1, 1.0005, 1.2, f32::NAN, f32::INFINITY, 1.0];
        let pass = FacingPass { ratio: plane(4, values) };
        let seen = pass.angles(&Masks::None, &[]).unwrap();
        let expected = FacingReport {
            pixels: 8,
            seen: 3,
            background: 1,
            rounded: 1,
            above_one: 1,
            below_zero: 1,
            not_finite: 2,
            unassigned: 0,
        };
        assert_eq!(seen.report, expected);
        assert!((seen.angles[0].total() - 3.0).abs() < 1e-9);
        assert_eq!(expected.sentences().len(), 4);
    }

    #[test]
    fn coverage_weighs_and_nothing_covered_is_background() {
        let mut ratio = plane(2, vec![0.5, 0.7]);
        ratio.coverage = Some(vec![0.25, 0.0]);
        let seen = FacingPass { ratio }.angles(&Masks::None, &[]).unwrap();
        assert!((seen.angles[0].total() - 0.25).abs() < 1e-9);
        assert_eq!(seen.report.background, 1);
    }

    #[test]
    fn ids_and_mattes_tell_materials_apart() {
        let pass = FacingPass { ratio: plane(2, vec![1.0, 0.5, 0.25, 1.0]) };
        let ids = Masks::Ids(plane(2, vec![7.0, 9.0, 7.5, 3.0]));
        let seen = pass.angles(&ids, &[9, 7]).unwrap();
        assert_eq!(seen.angles.iter().map(Angles::total).collect::<Vec<_>>(), [1.0, 1.0]);
        assert_eq!(seen.report.unassigned, 2);
        let mattes = Masks::Mattes(vec![plane(2, vec![1.0, 0.5, 0.0, 0.0]), plane(2, vec![0.0, 0.5, 0.0, f32::NAN])]);
        let seen = pass.angles(&mattes, &[]).unwrap();
        assert!((seen.angles[0].total() - 1.5).abs() < 1e-9 && (seen.angles[1].total() - 0.5).abs() < 1e-9);
        assert_eq!(seen.report.unassigned, 2);
        let other = Masks::Ids(plane(1, vec![1.0, 1.0]));
        assert!(pass.angles(&other, &[1]).unwrap_err().contains("1 × 2 pixels"));
    }

    /// A rendered ball has the angles of the built-in one.
    #[test]
    fn a_picture_of_a_ball_is_a_sphere() {
        let size = 256_u32;
        let to_radii = |pixel: u32| (f64::from(pixel) + 0.5) * 2.0 / f64::from(size) - 1.0;
        let ratio = |pixel: u32| {
            let (x, y) = (to_radii(pixel % size), to_radii(pixel / size));
            (1.0 - x * x - y * y).max(0.0).sqrt() as f32
        };
        let pass = FacingPass { ratio: plane(size, (0..size * size).map(ratio).collect()) };
        let seen = pass.angles(&Masks::None, &[]).unwrap();
        let (mine, total) = (Shape::Sphere.angles(), seen.angles[0].total());
        let off: f64 = mine.weights().iter().zip(seen.angles[0].weights()).map(|(a, b)| (a - b / total).abs()).sum();
        assert!(off < 0.06, "{off}");
        assert!(seen.report.background > 10_000 && seen.report.sentences().is_empty());
    }
}
