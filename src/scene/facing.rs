//! The angles of a rendered facing-ratio pass, of each material by ids or mattes.

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{Angles, Masks};
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
    /// Covered by more than the whole, which counts as the whole.
    pub over_covered: u64,
    /// Shares by mattes of what is seen that are above 1 by more than rounding, and count as 1.
    pub matte_above_one: u64,
    /// Shares by mattes that are below 0 by more than rounding, and count as 0.
    pub matte_below_zero: u64,
    /// Shares by mattes that are NaN or infinite, and count as 0.
    pub matte_not_finite: u64,
}

/// The angles of each material, in the order asked for, and what was found.
#[derive(Clone, Debug)]
pub struct Seen {
    /// One for each id, each matte, or one for the whole pass.
    pub angles: Vec<Angles>,
    /// What was found of the pixels.
    pub report: FacingReport,
    /// Where the angles come from, as a sentence that names every file.
    pub scene: String,
    /// Sentences about what was left out and what is not in the pictures.
    pub warnings: Vec<String>,
}

/// What a thread has counted.
struct Counted {
    angles: Vec<Angles>,
    report: FacingReport,
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
    /// A sentence where the pictures do not fit together, where an id can be in no pixel, and where nothing is seen.
    pub fn angles(&self, masks: &Masks, ids: &[u32]) -> Result<Seen, String> {
        self.check_sizes(masks)?;
        masks.check_ids(ids)?;
        let index: BTreeMap<u32, usize> = ids.iter().enumerate().map(|(index, id)| (*id, index)).collect();
        let count = match masks {
            Masks::None => 1,
            Masks::Ids(_) => ids.len(),
            Masks::Mattes(planes) => planes.len(),
        };
        let empty = || Counted { angles: vec![Angles::default(); count], report: FacingReport::default() };
        let starts = (0..self.ratio.values.len()).into_par_iter().step_by(CHUNK);
        let counted = starts.fold(empty, |mut counted, start| {
            self.count(start, masks, &index, &mut counted);
            counted
        });
        let Counted { angles, report } = counted.reduce(empty, Counted::with);
        if report.seen == 0 {
            return Err(self.nothing_seen(&report));
        }
        let scene = format!("{}{}", self.scene(&report), masks.scene());
        let warnings = report.sentences().into_iter().map(|sentence| format!("{}: {sentence}", self.ratio.name));
        let warnings = warnings.chain(masks.unseen(ids, &angles)).collect();
        Ok(Seen { angles, report, scene, warnings })
    }

    fn check_sizes(&self, masks: &Masks) -> Result<(), String> {
        let Plane { name, width, height, .. } = &self.ratio;
        match masks.planes().iter().find(|other| (other.width, other.height) != (*width, *height)) {
            Some(other) => Err(format!(
                "{} has {} × {} pixels and {name} {width} × {height}",
                other.name, other.width, other.height
            )),
            None => Ok(()),
        }
    }

    fn scene(&self, report: &FacingReport) -> String {
        let Plane { name, width, height, channel, .. } = &self.ratio;
        let FacingReport { seen, background, .. } = report;
        format!(
            "{name}: {width} × {height} pixels of channel {channel}, {seen} with a surface and {background} without"
        )
    }

    fn nothing_seen(&self, report: &FacingReport) -> String {
        let Plane { name, channel, .. } = &self.ratio;
        let told = [
            (report.background, "without a surface"),
            (report.below_zero, "below 0"),
            (report.above_one, "above 1"),
            (report.not_finite, "no numbers"),
        ];
        let told = told.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
        let told = told.collect::<Vec<_>>().join(", ");
        format!("{name} is no facing ratio: of the pixels of channel {channel} none is a cosine of 0–1 ({told})")
    }

    /// Counts the pixels of one chunk.
    fn count(&self, start: usize, masks: &Masks, index: &BTreeMap<u32, usize>, seen: &mut Counted) {
        let end = (start + CHUNK).min(self.ratio.values.len());
        let report = &mut seen.report;
        // Neighbours mostly share their id.
        let mut last: (Option<u32>, Option<usize>) = (None, None);
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
            report.over_covered += u64::from(coverage > 1.0 + ROUNDING);
            let cos_theta = CosTheta::new(f64::from(ratio));
            let weight = f64::from(coverage.min(1.0));
            match masks {
                Masks::None => seen.angles[0].add(cos_theta, weight),
                Masks::Ids(ids) => {
                    let id = ids.id(pixel);
                    if id != last.0 {
                        last = (id, id.and_then(|id| index.get(&id).copied()));
                    }
                    match last.1 {
                        Some(material) => seen.angles[material].add(cos_theta, weight),
                        None => report.unassigned += 1,
                    }
                }
                Masks::Mattes(mattes) => {
                    let mut is_any = false;
                    for (angles, matte) in seen.angles.iter_mut().zip(mattes) {
                        let share = report.share_of(matte.values[pixel]);
                        if share > 0.0 {
                            angles.add(cos_theta, weight * f64::from(share));
                            is_any = true;
                        }
                    }
                    report.unassigned += u64::from(!is_any);
                }
            }
        }
    }
}

impl Counted {
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

    /// What counts of a share by a matte.
    fn share_of(&mut self, matte: f32) -> f32 {
        if !matte.is_finite() {
            self.matte_not_finite += 1;
            return 0.0;
        }
        self.matte_above_one += u64::from(matte > 1.0 + ROUNDING);
        self.matte_below_zero += u64::from(matte < -ROUNDING);
        matte.clamp(0.0, 1.0)
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
            over_covered: self.over_covered + other.over_covered,
            matte_above_one: self.matte_above_one + other.matte_above_one,
            matte_below_zero: self.matte_below_zero + other.matte_below_zero,
            matte_not_finite: self.matte_not_finite + other.matte_not_finite,
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
            (self.over_covered, "have an alpha above 1, which counts as 1"),
        ];
        let of = |count: u64| if count == 1 { "1 pixel".to_owned() } else { format!("{count} pixels") };
        let share = |count: u64| 100.0 * count as f64 / self.pixels.max(1) as f64;
        let told = told.into_iter().filter(|(count, _)| *count > 0);
        let pixels = told.map(|(count, what)| format!("{} ({:.1} %) {what}", of(count), share(count)));
        let mattes = [
            (self.matte_above_one, "above 1 count as 1"),
            (self.matte_below_zero, "below 0 count as 0"),
            (self.matte_not_finite, "that are no numbers count as 0"),
        ];
        let mattes = mattes.into_iter().filter(|(count, _)| *count > 0);
        let mattes = mattes.map(|(count, what)| format!("values of mattes {what} ({})", of(count)));
        pixels.chain(mattes).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::Ids;
    use crate::scene::Shape;

    fn plane(width: u32, values: Vec<f32>) -> Plane {
        Plane {
            name: "made".to_owned(),
            width,
            height: values.len() as u32 / width,
            channel: "Y".to_owned(),
            values,
            coverage: None,
            ids: Ids::OF_FLOATS,
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
            ..FacingReport::default()
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

    #[test]
    fn a_pass_without_a_cosine_is_refused_in_a_sentence() {
        for (value, reason) in [
            (f32::NAN, "4 no numbers"),
            (f32::NEG_INFINITY, "4 no numbers"),
            (-0.5, "4 below 0"),
            (0.0, "4 without a surface"),
            (7.0, "4 above 1"),
        ] {
            let pass = FacingPass { ratio: plane(2, vec![value; 4]) };
            let refused = pass.angles(&Masks::None, &[]).unwrap_err();
            assert!(refused.contains(reason) && refused.contains("channel Y"), "{refused}");
        }
        let mut ratio = plane(2, vec![0.5; 4]);
        ratio.coverage = Some(vec![0.0; 4]);
        assert!(FacingPass { ratio }.angles(&Masks::None, &[]).is_err(), "nothing is covered");
    }

    #[test]
    fn an_id_that_is_not_seen_is_said_with_those_that_are_there() {
        let pass = FacingPass { ratio: plane(2, vec![1.0, 0.5, 0.0, 1.0]) };
        let ids = Masks::Ids(plane(2, vec![1.0, 1.0, 4.0, 2.0]));
        let seen = pass.angles(&ids, &[1, 9, 4, 2]).unwrap();
        let [absent, hidden] = seen.warnings.as_slice() else { panic!("{:?}", seen.warnings) };
        assert!(absent.contains("the id 9 is not in the picture, which has 1, 2 and 4"), "{absent}");
        assert!(hidden.contains("the id 4 is only where the pass has no surface"), "{hidden}");
        assert!(seen.scene.ends_with("; ids of made, channel Y"), "{}", seen.scene);
        assert!(pass.angles(&ids, &[1, 2]).unwrap().warnings.is_empty());
        // A float of 2²⁴ may have been 2²⁴ + 1.
        let refused = pass.angles(&ids, &[1, 16_777_216]).unwrap_err();
        assert!(refused.contains("16777216") && refused.contains("16777215"), "{refused}");
    }

    #[test]
    fn exact_ids_are_told_apart_beyond_what_floats_can() {
        let pass = FacingPass { ratio: plane(2, vec![1.0, 0.5]) };
        let mut ids = plane(2, vec![16_777_216.0; 2]);
        ids.ids = Ids { largest: u32::MAX, exact: Some(vec![16_777_216, 16_777_217]) };
        let seen = pass.angles(&Masks::Ids(ids), &[16_777_217]).unwrap();
        assert_eq!((seen.angles[0].total(), seen.report.unassigned), (1.0, 1));
    }

    #[test]
    fn shares_of_mattes_beyond_the_whole_are_counted_and_said() {
        let pass = FacingPass { ratio: plane(4, vec![1.0; 4]) };
        let mattes = Masks::Mattes(vec![plane(4, vec![3.0, -1.0, f32::NAN, 1.0005]), plane(4, vec![0.0; 4])]);
        let seen = pass.angles(&mattes, &[]).unwrap();
        let FacingReport { matte_above_one, matte_below_zero, matte_not_finite, .. } = seen.report;
        assert_eq!((matte_above_one, matte_below_zero, matte_not_finite), (1, 1, 1));
        assert_eq!(seen.angles[0].total(), 2.0);
        let told = seen.warnings.join("; ");
        for said in ["mattes above 1", "mattes below 0", "mattes that are no numbers", "made covers nothing"] {
            assert!(told.contains(said), "{told}");
        }
        assert!(seen.scene.ends_with("; mattes made and made"), "{}", seen.scene);
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
