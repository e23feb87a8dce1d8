//! The sphere previews: the preset, the truth beside it, and their difference, rendered on a job.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::drawn::{Difference, Drawn, Images, truth_table};
use super::job::{Follower, Job, Poll, Progress};
use super::preview::{Off, Quality, Rung, Took, measure, milliseconds, offs, within};
use super::standing::Standing;
use crate::color::RgbSpace;
use crate::fresnel::FresnelModel;
use crate::metal::Metal;
use crate::render::{Light, RadialTable, Srgb8Picture};

/// Everything a preview depends on.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    /// The preset's curve.
    pub model: FresnelModel,
    /// The space of its numbers.
    pub space: RgbSpace,
    /// Perceptual roughness.
    pub roughness: f64,
    /// The metal to compare with.
    pub metal: Option<&'static Metal>,
    /// The light around the sphere.
    pub light: Light,
    /// Side of the picture in pixels of the screen.
    pub size: u32,
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        let id = |wanted: &Self| wanted.metal.map(|metal| metal.id.as_str());
        self.model == other.model && self.same_view(other) && id(self) == id(other)
    }
}

impl Wanted {
    /// True when both look at the same sphere under the same light.
    fn same_view(&self, other: &Self) -> bool {
        (self.light, self.size, self.space) == (other.light, other.size, other.space)
            && self.roughness == other.roughness
    }

    /// True when pictures of both are as far from the finished ones: a quality shows on the metal, where there is one.
    fn same_sphere(&self, other: &Self) -> bool {
        self.same_view(other) && self.same_truth(other) && (self.metal.is_some() || self.model == other.model)
    }

    fn same_truth(&self, other: &Self) -> bool {
        let id = |wanted: &Self| wanted.metal.map(|metal| metal.id.as_str());
        id(self) == id(other) && self.space == other.space
    }
}

/// The truth at every nanometre: what a change of the preset's colours leaves as it is.
#[derive(Clone)]
struct Kept {
    wanted: Wanted,
    truth: Arc<RadialTable>,
}

struct Rendered {
    kept: Option<Kept>,
    /// What it is, whatever less was asked for.
    quality: Quality,
    took: Took,
    images: Images,
}

/// Pictures on the screen.
pub(crate) struct Shown {
    /// The sphere of the preset.
    pub preset: TextureHandle,
    /// The sphere of the metal, the map of their difference, and its numbers.
    pub truth: Option<(TextureHandle, TextureHandle, Difference)>,
    quality: Quality,
    took_ms: f64,
}

/// Measures how far some qualities of what is wanted are from the finished picture.
type Costing = Job<(Wanted, Vec<Quality>), Vec<(Quality, Off)>>;

/// How far some qualities are from the finished picture of what was wanted.
struct Costs {
    wanted: Wanted,
    offs: Vec<(Quality, Off)>,
}

/// After so much time without a change the hand rests, and the finished picture follows.
const REST_SECONDS: f64 = 0.15;

/// The previews and the jobs that render and measure them.
#[derive(Default)]
pub(crate) struct Spheres {
    rendering: Follower<(Wanted, Quality), Rendered>,
    kept: Option<Kept>,
    /// Memory of the last sphere, for the next.
    spare: Arc<Mutex<Srgb8Picture>>,
    shown: Option<Shown>,
    /// What was wanted last, and since when.
    wanted: Option<(Wanted, f64)>,
    /// True while what is shown is not finished.
    is_refining: bool,
    /// What the last finished picture took.
    full: Took,
    measuring: Option<Job<Wanted, Vec<Rung>>>,
    measured: Option<(Wanted, Vec<Rung>)>,
    costing: Option<Costing>,
    costs: Option<Costs>,
    /// What was shown last while something moved.
    last_coarse: Option<Quality>,
}

impl Spheres {
    /// True while a picture is being rendered.
    pub(crate) fn is_busy(&self) -> bool {
        self.rendering.is_busy()
    }

    /// True while a better picture is to follow, or qualities are measured; only of a page that is on show.
    pub(crate) fn is_refining(&self) -> bool {
        self.is_refining || self.measuring.is_some()
    }

    /// The newest pictures there are.
    pub(crate) fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// How far preset and truth are apart on the newest pictures; marked where they are coarse.
    pub(crate) fn difference_words(&self) -> Option<String> {
        let Shown { truth, quality, .. } = self.shown.as_ref()?;
        truth.as_ref().map(|(_, _, difference)| difference.words(*quality == Quality::FULL))
    }

    /// The quality of the newest pictures.
    pub(crate) fn standing(&self) -> Option<Standing> {
        let Shown { truth, quality, took_ms, .. } = self.shown.as_ref()?;
        let known = self.costs.iter().flat_map(|costs| &costs.offs).find(|(own, _)| own == quality);
        let off = known.map(|(_, off)| *off);
        Some(Standing { quality: *quality, has_metal: truth.is_some(), took_ms: *took_ms, off })
    }

    /// Sees to it that what is wanted will be shown: within a budget while it changes, finished when it rests.
    pub(crate) fn want(&mut self, ctx: &Context, wanted: Wanted, budget_ms: f64) {
        let quality = self.quality(ctx, &wanted, budget_ms);
        let kept = self.kept.clone().filter(|kept| kept.wanted.same_truth(&wanted));
        let asked = (wanted, quality);
        let spare = self.spare.clone();
        let work = move |(wanted, quality): (Wanted, Quality), _: &Progress| render(&wanted, quality, kept, &spare);
        if let Some(((_, quality), rendered)) = self.rendering.follow(ctx, "spheres", asked, work) {
            if rendered.quality != Quality::FULL {
                self.last_coarse = Some(rendered.quality);
            }
            let took_ms = rendered.took.truth_ms + rendered.took.picture_ms;
            self.shown = Some(Shown::new(ctx, rendered.images, rendered.quality, took_ms));
            if rendered.kept.is_some() {
                self.kept = rendered.kept;
            }
            if quality == Quality::FULL {
                let Took { truth_ms, picture_ms } = rendered.took;
                // A truth that was known took no time; the last one that was not still says what one takes.
                self.full = Took { truth_ms: if truth_ms > 0.0 { truth_ms } else { self.full.truth_ms }, picture_ms };
            }
        }
        self.poll_measuring();
        self.follow_costs(ctx, budget_ms);
    }

    fn quality(&mut self, ctx: &Context, wanted: &Wanted, budget_ms: f64) -> Quality {
        let time = ctx.input(|input| input.time);
        let since = match &self.wanted {
            Some((known, since)) if known == wanted => *since,
            _ => {
                (self.measuring, self.costing) = (None, None);
                self.wanted = Some((wanted.clone(), time));
                time
            }
        };
        let rests = self.shown.is_none() || time - since >= REST_SECONDS;
        if rests {
            self.is_refining = false;
            return Quality::FULL;
        }
        let needs_truth =
            wanted.metal.is_some() && !self.kept.as_ref().is_some_and(|kept| kept.wanted.same_truth(wanted));
        let quality = within(budget_ms, needs_truth, self.full, self.rungs());
        self.is_refining = quality != Quality::FULL;
        if self.is_refining {
            ctx.request_repaint_after_secs((REST_SECONDS - (time - since)) as f32);
        }
        quality
    }

    /// Sees to it that before something moves it is known what the qualities cost that will be shown then.
    fn follow_costs(&mut self, ctx: &Context, budget_ms: f64) {
        self.poll_costing();
        let is_finished = self.shown.as_ref().is_some_and(|shown| shown.quality == Quality::FULL);
        if !is_finished || self.rendering.is_busy() || self.costing.is_some() {
            return;
        }
        let Some((wanted, _)) = &self.wanted else { return };
        let known = self.costs.as_ref().filter(|costs| costs.wanted.same_sphere(wanted));
        let is_known = |quality: &Quality| known.is_some_and(|costs| costs.offs.iter().any(|(own, _)| own == quality));
        let expected = self.expected(wanted.metal.is_some(), budget_ms);
        let missing: Vec<Quality> = expected.into_iter().filter(|quality| !is_known(quality)).collect();
        if missing.is_empty() {
            return;
        }
        let truth = self.kept.as_ref().filter(|kept| kept.wanted.same_truth(wanted)).map(|kept| kept.truth.clone());
        let job = Job::start(ctx, "cost of previews", (wanted.clone(), missing), |(wanted, missing), progress| {
            offs(&wanted, &missing, truth, &mut |share| progress.report(share))
        });
        self.costing = job.inspect_err(|error| log::error!("no thread could be started: {error}")).ok();
    }

    /// The coarse qualities that are to be expected when something moves: the truth stays known, or another metal comes.
    fn expected(&self, has_metal: bool, budget_ms: f64) -> Vec<Quality> {
        let of = |needs_truth| within(budget_ms, needs_truth, self.full, self.rungs());
        let anew = has_metal.then(|| of(true));
        let mut expected = vec![of(false).with_known_truth()];
        for quality in anew.into_iter().chain(self.last_coarse) {
            if !expected.contains(&quality) {
                expected.push(quality);
            }
        }
        expected.retain(|quality| *quality != Quality::FULL);
        expected
    }

    fn poll_costing(&mut self) {
        let Some(job) = self.costing.take() else { return };
        match job.poll() {
            Poll::Working => self.costing = Some(job),
            Poll::Done(mut offs) => {
                let wanted = job.input.0.clone();
                let known = self.costs.take().filter(|costs| costs.wanted.same_sphere(&wanted));
                offs.extend(known.into_iter().flat_map(|costs| costs.offs));
                self.costs = Some(Costs { wanted, offs });
            }
            Poll::Lost => log::error!("measuring what previews cost ended unexpectedly"),
        }
    }

    fn rungs(&self) -> &[Rung] {
        self.measured.as_ref().map(|(_, rungs)| rungs.as_slice()).unwrap_or_default()
    }

    /// What each quality takes and costs of the picture that is wanted, and sees to it that it is measured; of an older
    /// one while that goes on.
    pub(crate) fn measured(&mut self, ctx: &Context) -> &[Rung] {
        if let Some((wanted, _)) = &self.wanted
            && self.measuring.is_none()
            && self.measured.as_ref().is_none_or(|(known, _)| known != wanted)
        {
            let job = Job::start(ctx, "measure previews", wanted.clone(), |wanted, progress| {
                measure(&wanted, &mut |share| progress.report(share))
            });
            self.measuring = job.inspect_err(|error| log::error!("no thread could be started: {error}")).ok();
        }
        self.rungs()
    }

    fn poll_measuring(&mut self) {
        let Some(job) = self.measuring.take() else { return };
        match job.poll() {
            Poll::Working => self.measuring = Some(job),
            Poll::Done(rungs) => self.measured = Some((job.input.clone(), rungs)),
            Poll::Lost => log::error!("measuring previews ended unexpectedly"),
        }
    }
}

impl std::fmt::Debug for Spheres {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Spheres").field("is_busy", &self.is_busy()).finish_non_exhaustive()
    }
}

impl Shown {
    fn new(ctx: &Context, images: Images, quality: Quality, took_ms: f64) -> Self {
        let load = |name: &str, image: ColorImage| ctx.load_texture(name, image, TextureOptions::LINEAR);
        Self {
            preset: load("sphere of the preset", images.preset),
            truth: images.truth.map(|(sphere, map, difference)| {
                (load("sphere of the truth", sphere), load("difference of the spheres", map), difference)
            }),
            quality,
            took_ms,
        }
    }
}

/// `kept` is the same truth at every nanometre: no fewer wavelengths are quicker.
fn render(wanted: &Wanted, quality: Quality, kept: Option<Kept>, spare: &Mutex<Srgb8Picture>) -> Rendered {
    let start = Instant::now();
    let (truth, truth_ms) = match &kept {
        Some(kept) => (Some(kept.truth.clone()), 0.0),
        None => (truth_table(wanted, quality), milliseconds(start)),
    };
    // A panic leaves a picture of any kind, which is written over.
    let mut spare = spare.lock().unwrap_or_else(PoisonError::into_inner);
    let drawn = Drawn::of(wanted, quality, truth.as_deref(), std::mem::take(&mut *spare));
    let images = drawn.images();
    *spare = drawn.into_spare();
    let is_exact = kept.is_some() || quality.wavelengths.is_none();
    Rendered {
        images,
        quality: if is_exact || wanted.metal.is_none() { quality.with_known_truth() } else { quality },
        kept: truth.filter(|_| is_exact).map(|truth| Kept { wanted: wanted.clone(), truth }),
        took: Took { truth_ms, picture_ms: milliseconds(start) - truth_ms },
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::RawInput;

    use super::*;
    use crate::color::Rgb;
    use crate::metal::metal_by_name;

    fn wanted(r: f64) -> Wanted {
        Wanted {
            model: FresnelModel::Schlick { r: Rgb::splat(r) },
            space: RgbSpace::LinRec709,
            roughness: 0.0,
            metal: None,
            light: Light::White,
            size: 40,
        }
    }

    /// Frames at one time, until what was asked for is drawn; gives the side of the picture.
    fn side_at(ctx: &Context, spheres: &mut Spheres, r: f64, time: f64, budget_ms: f64) -> usize {
        loop {
            ctx.begin_pass(RawInput { time: Some(time), ..RawInput::default() });
            spheres.want(ctx, wanted(r), budget_ms);
            ctx.end_pass().textures_delta.clear();
            if !spheres.is_busy() {
                return spheres.shown().unwrap().preset.size()[0];
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn what_moves_is_coarse_within_its_budget_and_finished_at_rest() {
        let (ctx, mut spheres) = (Context::default(), Spheres::default());
        assert_eq!(side_at(&ctx, &mut spheres, 0.5, 0.0, 0.0), 40, "the first picture is awaited");
        assert_eq!(side_at(&ctx, &mut spheres, 0.6, 1.0, 0.0), 10);
        assert!(spheres.is_refining());
        assert_eq!(side_at(&ctx, &mut spheres, 0.7, 1.1, 0.0), 10, "it still moves");
        assert_eq!(side_at(&ctx, &mut spheres, 0.7, 1.2, 0.0), 10);
        assert_eq!(side_at(&ctx, &mut spheres, 0.7, 1.3, 0.0), 40, "at rest");
        assert!(!spheres.is_refining());
        assert_eq!(side_at(&ctx, &mut spheres, 0.8, 2.0, 1e9), 40, "all the time there is");
    }

    /// What is coarse is known to be, with what that costs, which was measured while the hand rested.
    #[test]
    fn what_moves_says_what_it_costs() {
        let (ctx, mut spheres) = (Context::default(), Spheres::default());
        side_at(&ctx, &mut spheres, 0.5, 0.0, 0.0);
        assert!(spheres.standing().unwrap().is_finished());
        while spheres.costs.is_none() {
            side_at(&ctx, &mut spheres, 0.5, 0.5, 0.0);
        }
        side_at(&ctx, &mut spheres, 0.6, 1.0, 0.0);
        let standing = spheres.standing().unwrap();
        assert_eq!(standing.quality, Quality { coarseness: 4, wavelengths: None });
        let off = standing.off.unwrap();
        assert!(0.0 < off.mean && off.mean < off.max, "{off:?}");
        assert!(!standing.has_metal && standing.took_ms > 0.0);
    }

    #[test]
    fn few_wavelengths_are_shown_only_until_the_truth_is_known() {
        let gold = metal_by_name("gold").unwrap();
        let wanted = Wanted { metal: Some(gold), ..wanted(0.5) };
        let spare = Mutex::new(Srgb8Picture::default());
        let few = Quality::LADDER[4];
        let anew = render(&wanted, few, None, &spare);
        assert_eq!(anew.quality, few);
        let full = render(&wanted, Quality::FULL, None, &spare);
        assert_eq!(
            (full.quality, render(&wanted, few, full.kept, &spare).quality),
            (Quality::FULL, few.with_known_truth())
        );
    }
}
