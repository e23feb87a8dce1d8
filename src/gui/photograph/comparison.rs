//! The photograph against the rendered match: three ways to look at both, made on a job.

use std::sync::Arc;

use eframe::egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use rayon::prelude::*;

use super::develop::encode;
use crate::gui::drawn::full_scale;
use crate::gui::job::Follower;
use crate::photo::{Match, Photo, Rendition};
use crate::render::false_colour;

/// What the view shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Looking {
    /// The photograph with its marks.
    #[default]
    Photograph,
    /// The photograph beside the rendered match.
    SideBySide,
    /// One over the other, parted by a handle.
    Wipe,
    /// How far they are apart.
    Difference,
}

impl Looking {
    /// Every way, in the order of the buttons.
    pub(crate) const ALL: [Self; 4] = [Self::Photograph, Self::SideBySide, Self::Wipe, Self::Difference];

    /// The word on its button.
    pub(crate) const fn label(self) -> &'static str {
        match self {
            Self::Photograph => "Marks",
            Self::SideBySide => "Side by side",
            Self::Wipe => "Wipe",
            Self::Difference => "Difference",
        }
    }

    /// What it shows, in a sentence.
    pub(crate) const fn explanation(self) -> &'static str {
        match self {
            Self::Photograph => "The photograph with its marks",
            Self::SideBySide => "The photograph, and beside it the metal rendered with the r and h that were found",
            Self::Wipe => "The photograph left of a handle, the rendered metal right of it",
            Self::Difference => "ΔE2000 between the photograph and the rendered metal, both over their light",
        }
    }
}

/// Longer side of the pictures that are compared.
const LARGEST_SIDE: u32 = 1024;

/// What a comparison is made from.
#[derive(Clone)]
struct Wanted {
    /// Counts the matches, which are not compared: a NaN in one would make it differ from itself.
    generation: u64,
    found: Arc<Match>,
    exposure_ev: f32,
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        (self.generation, self.exposure_ev) == (other.generation, other.exposure_ev)
    }
}

type Rendered = Result<Arc<Rendition>, String>;

struct Made {
    rendition: Rendered,
    images: Option<Images>,
}

struct Images {
    photograph: ColorImage,
    rendered: ColorImage,
    difference: ColorImage,
    scale: Scale,
}

/// The false colours of a difference and its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    /// The ΔE at the bright end.
    pub full_scale: f64,
    /// Mean over the metal.
    pub mean: f64,
    /// What 95 % of the pixels stay below.
    pub most: f64,
}

/// Pictures on the screen.
pub(crate) struct Compared {
    /// The numbers behind them.
    pub rendition: Arc<Rendition>,
    /// As photographed.
    pub photograph: TextureHandle,
    /// With the metal rendered.
    pub rendered: TextureHandle,
    /// False colours of the difference.
    pub difference: TextureHandle,
    /// What the false colours mean.
    pub scale: Scale,
}

/// How the photograph is compared with its match.
pub(crate) struct Comparison {
    /// What the view shows.
    pub looking: Looking,
    /// Where the handle is, as a share of the picture's width.
    pub wipe: f32,
    making: Follower<Wanted, Made>,
    kept: Option<(u64, Rendered)>,
    shown: Option<Compared>,
    problem: Option<String>,
}

impl Default for Comparison {
    fn default() -> Self {
        Self {
            looking: Looking::default(),
            wipe: 0.5,
            making: Follower::default(),
            kept: None,
            shown: None,
            problem: None,
        }
    }
}

impl Comparison {
    /// True while pictures are made.
    pub(crate) fn is_busy(&self) -> bool {
        self.making.is_busy()
    }

    /// The newest pictures, or why there are none; `None` while the first are on their way.
    pub(crate) fn shown(&self) -> Option<Result<&Compared, &str>> {
        match (&self.problem, &self.shown) {
            (Some(problem), _) => Some(Err(problem)),
            (None, Some(shown)) => Some(Ok(shown)),
            (None, None) => None,
        }
    }

    /// Sees to it that a match will be shown.
    pub(crate) fn follow(
        &mut self,
        ctx: &Context,
        photo: &Arc<Photo>,
        generation: u64,
        found: &Arc<Match>,
        exposure_ev: f32,
    ) {
        let (photo, kept) = (photo.clone(), self.kept.clone());
        let wanted = Wanted { generation, found: found.clone(), exposure_ev };
        let work = move |wanted: Wanted, _: &_| make(&photo, &wanted, kept);
        let Some((wanted, made)) = self.making.follow(ctx, "compare", wanted, work) else { return };
        self.problem = made.rendition.as_ref().err().cloned();
        if let (Ok(rendition), Some(images)) = (&made.rendition, made.images) {
            self.shown = Some(Compared::new(ctx, rendition.clone(), images));
        }
        self.kept = Some((wanted.generation, made.rendition));
    }
}

impl Compared {
    fn new(ctx: &Context, rendition: Arc<Rendition>, images: Images) -> Self {
        let load = |name: &str, image: ColorImage| ctx.load_texture(name, image, TextureOptions::LINEAR);
        Self {
            rendition,
            photograph: load("compared photograph", images.photograph),
            rendered: load("rendered match", images.rendered),
            difference: load("difference to the match", images.difference),
            scale: images.scale,
        }
    }
}

fn make(photo: &Photo, wanted: &Wanted, kept: Option<(u64, Rendered)>) -> Made {
    let rendition = match kept {
        Some((generation, rendition)) if generation == wanted.generation => rendition,
        _ => Rendition::of(photo, &wanted.found, LARGEST_SIDE).map(Arc::new).map_err(|error| error.to_string()),
    };
    let images = rendition.as_ref().ok().map(|rendition| images(rendition, wanted.exposure_ev.exp2()));
    Made { rendition, images }
}

fn images(rendition: &Rendition, gain: f32) -> Images {
    let (mean, most) = rendition.mean_and_most().unwrap_or_default();
    let scale = Scale { full_scale: full_scale(most), mean, most };
    let size = [rendition.width as usize, rendition.height as usize];
    let developed =
        |linear: &[[f32; 3]]| ColorImage::new(size, linear.par_iter().map(|rgb| encode(*rgb, gain)).collect());
    let false_coloured = |delta_e: &f32| {
        let [red, green, blue] = false_colour(f64::from(*delta_e) / scale.full_scale);
        if delta_e.is_finite() { Color32::from_rgb(red, green, blue) } else { Color32::TRANSPARENT }
    };
    Images {
        photograph: developed(&rendition.photograph),
        rendered: developed(&rendition.rendered),
        difference: ColorImage::new(size, rendition.delta_e.par_iter().map(false_coloured).collect()),
        scale,
    }
}
