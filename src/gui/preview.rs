//! How good a preview is while something moves: what fits into a stated time, and the error it costs, measured.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use image::RgbaImage;
use image::imageops::{self, FilterType};

use super::drawn::{Drawn, sphere_alone, truth_table};
use super::spheres::Wanted;
use crate::color::{RgbSpace, linear_from_srgb8};
use crate::render::{DeltaEMap, Picture, RadialTable, Srgb8Picture};

/// How good a picture is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Quality {
    /// How many pixels of the screen one of the picture is wide.
    pub coarseness: u32,
    /// Wavelengths of a metal's truth; `None` is every nanometre.
    pub wavelengths: Option<usize>,
}

impl Quality {
    /// What is shown when nothing moves.
    pub(crate) const FULL: Self = Self { coarseness: 1, wavelengths: None };

    /// From the finished picture to the quickest.
    pub(crate) const LADDER: [Self; 6] = [
        Self::FULL,
        Self { coarseness: 1, wavelengths: Some(31) },
        Self { coarseness: 2, wavelengths: Some(31) },
        Self { coarseness: 2, wavelengths: Some(16) },
        Self { coarseness: 3, wavelengths: Some(8) },
        Self { coarseness: 4, wavelengths: Some(8) },
    ];

    /// What is drawn where the truth is known at every nanometre: no fewer wavelengths are quicker.
    pub(crate) const fn with_known_truth(self) -> Self {
        Self { wavelengths: None, ..self }
    }

    /// In words: `every 2nd pixel, 16 wavelengths for a metal`.
    pub(crate) fn words(self) -> String {
        format!("{}, {} for a metal", self.pixels(), self.spectrum())
    }

    /// `every 2nd pixel`.
    pub(crate) fn pixels(self) -> String {
        match self.coarseness {
            1 => "every pixel".to_owned(),
            2 => "every 2nd pixel".to_owned(),
            3 => "every 3rd pixel".to_owned(),
            n => format!("every {n}th pixel"),
        }
    }

    /// `16 wavelengths`.
    pub(crate) fn spectrum(self) -> String {
        self.wavelengths.map_or_else(|| "every nanometre".to_owned(), |count| format!("{count} wavelengths"))
    }

    /// Side of the picture.
    pub(crate) fn size(self, full: u32) -> u32 {
        full.div_ceil(self.coarseness).max(8)
    }
}

/// What a picture took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Took {
    /// Milliseconds of the truth of a metal; 0 where it was known.
    pub truth_ms: f64,
    /// Milliseconds of everything else.
    pub picture_ms: f64,
}

/// How far a picture is from the finished one: CIEDE2000 over what both cover wholly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Off {
    /// On average.
    pub mean: f64,
    /// The largest.
    pub max: f64,
}

/// A quality with what it takes and costs, measured on this machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rung {
    /// The quality.
    pub quality: Quality,
    /// The least of a few pictures.
    pub took: Took,
    /// How far it is from the finished picture.
    pub off: Off,
}

/// The best quality within a budget, and else the quickest. `full` is what the finished picture took; what was measured
/// counts before what follows from it.
pub(crate) fn within(budget_ms: f64, needs_truth: bool, full: Took, rungs: &[Rung]) -> Quality {
    let took = |quality: Quality| {
        let measured = rungs.iter().find(|rung| rung.quality == quality).map(|rung| rung.took);
        let took = measured.unwrap_or_else(|| expected(quality, full));
        took.picture_ms + if needs_truth { took.truth_ms } else { 0.0 }
    };
    let found = Quality::LADDER.into_iter().find(|quality| took(*quality) <= budget_ms);
    found.unwrap_or(Quality::LADDER[Quality::LADDER.len() - 1])
}

/// In proportion to pixels and to wavelengths.
fn expected(quality: Quality, full: Took) -> Took {
    let wavelengths = quality.wavelengths.map_or(1.0, |count| count as f64 / crate::spectrum::SAMPLES as f64);
    let pixels = f64::from(quality.coarseness * quality.coarseness);
    Took { truth_ms: full.truth_ms * wavelengths, picture_ms: full.picture_ms / pixels }
}

/// Pictures of each quality.
const ROUNDS: usize = 3;

/// Draws a preview in every quality; what there is when `progress` breaks.
pub(crate) fn measure(wanted: &Wanted, progress: &mut dyn FnMut(f32) -> ControlFlow<()>) -> Vec<Rung> {
    let full_truth = truth_table(wanted, Quality::FULL);
    let full = Drawn::of(wanted, Quality::FULL, full_truth.as_deref(), Srgb8Picture::default());
    let mut rungs = Vec::new();
    for (index, quality) in Quality::LADDER.into_iter().enumerate() {
        if progress(index as f32 / Quality::LADDER.len() as f32).is_break() {
            break;
        }
        // The view is made once for many pictures, so that its time is none of theirs.
        let mut drawn = Drawn::of(wanted, quality, full_truth.as_deref(), Srgb8Picture::default());
        let mut took = Took { truth_ms: f64::INFINITY, picture_ms: f64::INFINITY };
        for _ in 0..ROUNDS {
            let start = Instant::now();
            let truth = truth_table(wanted, quality);
            let truth_ms = milliseconds(start);
            drawn = Drawn::of(wanted, quality, truth.as_deref(), drawn.into_spare());
            black_box(drawn.images());
            took.truth_ms = took.truth_ms.min(truth_ms);
            took.picture_ms = took.picture_ms.min(milliseconds(start) - truth_ms);
        }
        rungs.push(Rung { quality, took, off: off(drawn.sphere(), full.sphere()) });
    }
    rungs
}

/// How far pictures of some qualities are from the finished one; of fewer where `progress` breaks. `known` is the truth
/// at every nanometre, where it is known.
pub(crate) fn offs(
    wanted: &Wanted,
    qualities: &[Quality],
    known: Option<Arc<RadialTable>>,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Vec<(Quality, Off)> {
    let full_truth = known.or_else(|| truth_table(wanted, Quality::FULL));
    let full = sphere_alone(wanted, Quality::FULL, full_truth.as_deref());
    let mut offs = Vec::new();
    for (index, &quality) in qualities.iter().enumerate() {
        if progress(index as f32 / qualities.len() as f32).is_break() {
            break;
        }
        let truth = match quality.wavelengths {
            None => full_truth.clone(),
            Some(_) => truth_table(wanted, quality),
        };
        offs.push((quality, off(&sphere_alone(wanted, quality, truth.as_deref()), &full)));
    }
    offs
}

/// Milliseconds since then.
pub(crate) fn milliseconds(start: Instant) -> f64 {
    1000.0 * start.elapsed().as_secs_f64()
}

/// How far a coarse picture, drawn as large as the fine one as the screen does, is from the fine one.
fn off(coarse: &Srgb8Picture, fine: &Srgb8Picture) -> Off {
    let image = |picture: &Srgb8Picture| RgbaImage::from_raw(picture.width, picture.height, picture.rgba.clone());
    let (Some(coarse), Some(fine)) = (image(coarse), image(fine)) else { return Off { mean: f64::NAN, max: f64::NAN } };
    let coarse = imageops::resize(&coarse, fine.width(), fine.height(), FilterType::Triangle);
    let is_whole: Vec<bool> = coarse.pixels().zip(fine.pixels()).map(|(a, b)| a[3] == 255 && b[3] == 255).collect();
    let linear = |picture: &RgbaImage| Picture {
        width: picture.width(),
        height: picture.height(),
        space: RgbSpace::LinRec709,
        linear: picture
            .pixels()
            .map(|code| linear_from_srgb8([code[0], code[1], code[2]]).0.map(|v| v as f32))
            .collect(),
        coverage: is_whole.iter().map(|is_whole| f32::from(u8::from(*is_whole))).collect(),
    };
    let map = DeltaEMap::between(&linear(&coarse), &linear(&fine));
    Off { mean: map.mean(), max: map.max() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::FresnelModel;
    use crate::metal::metal_by_name;
    use crate::render::Light;

    fn wanted() -> Wanted {
        let gold = metal_by_name("gold").unwrap();
        let space = RgbSpace::LinRec709;
        Wanted {
            model: FresnelModel::Schlick { r: gold.r(space) },
            space,
            roughness: 0.0,
            metal: Some(gold),
            light: Light::SoftBoxes,
            size: 64,
        }
    }

    #[test]
    fn the_finished_picture_has_no_error_and_the_quickest_has_the_most() {
        let rungs = measure(&wanted(), &mut |_| ControlFlow::Continue(()));
        assert_eq!(rungs.iter().map(|rung| rung.quality).collect::<Vec<_>>(), Quality::LADDER);
        assert_eq!(rungs[0].off, Off { mean: 0.0, max: 0.0 });
        assert!(rungs[5].off.mean > rungs[1].off.mean && rungs[5].off.max > 1.0, "{rungs:?}");
        assert!(rungs[2..].iter().all(|rung| rung.off.mean > 0.0), "{rungs:?}");
        // The same by themselves, and with the truth known only what the pixels cost.
        let qualities = [Quality::LADDER[5], Quality::LADDER[5].with_known_truth(), Quality::FULL];
        let offs = offs(&wanted(), &qualities, None, &mut |_| ControlFlow::Continue(()));
        assert_eq!(offs[0], (qualities[0], rungs[5].off));
        assert!(offs[1].1.mean > 0.0 && offs[1].1 != offs[0].1, "{offs:?}");
        assert_eq!(offs[2].1, Off { mean: 0.0, max: 0.0 });
    }

    #[test]
    fn a_larger_budget_never_makes_a_picture_worse() {
        let full = Took { truth_ms: 8.0, picture_ms: 20.0 };
        let at = |budget_ms, needs_truth| within(budget_ms, needs_truth, full, &[]);
        let place = |quality: Quality| Quality::LADDER.into_iter().position(|own| own == quality).unwrap();
        for needs_truth in [false, true] {
            let places: Vec<usize> = (1..60).map(|ms| place(at(f64::from(ms), needs_truth))).collect();
            assert!(places.is_sorted_by(|a, b| a >= b), "{places:?}");
        }
        assert_eq!(at(28.0, true), Quality::FULL);
        assert_eq!(at(21.0, true), Quality { coarseness: 1, wavelengths: Some(31) });
        assert_eq!(at(6.0, false), Quality { coarseness: 2, wavelengths: Some(31) });
        assert_eq!(at(0.0, false), Quality::LADDER[5]);
        // What was measured counts before what is expected.
        let slow = Rung {
            quality: Quality::FULL,
            took: Took { truth_ms: 0.0, picture_ms: 90.0 },
            off: Off { mean: 0.0, max: 0.0 },
        };
        assert_ne!(within(28.0, true, full, &[slow]), Quality::FULL);
    }
}
