//! The state of the page of demonstrations: which one, of what, and what was computed for it.

mod band;
mod exhibit;
mod latest;
mod material;
mod shown;

use std::path::PathBuf;

use eframe::egui::{Context, TextureHandle, TextureOptions};

pub(crate) use self::band::Band;
pub(crate) use self::exhibit::{Exhibit, Piece};
use self::exhibit::{OfConversion, OfDecoupling, OfMatrix, OfPair};
pub(crate) use self::latest::Latest;
pub(crate) use self::material::{Choice, Described, Material, Slot};
pub(crate) use self::shown::{
    ShownBlend, ShownBlends, ShownConversion, ShownConversions, ShownDecoupling, ShownQuantisation, ShownSquare,
    ShownUniformity, SweepBands, Told,
};
use super::job::{Job, Poll};
use crate::color::RgbSpace;
use crate::fit::Method;
use crate::metal::{Metal, metal_by_name};
use crate::preset::Preset;
use crate::study::{ConversionOptions, DecouplingOptions, Parameters, Storage};

/// The demonstrations of the paper's argument.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Demonstration {
    /// Parameters converted between spaces.
    #[default]
    Conversion,
    /// Parameters blended between materials.
    Blending,
    /// Parameters stored with few digits.
    Quantisation,
    /// One parameter moved while the other is held.
    Decoupling,
    /// Equal steps of sliders.
    Uniformity,
    /// The square of r and h.
    Feasibility,
}

impl Demonstration {
    /// Every demonstration, in the order of the list.
    pub(crate) const ALL: [Self; 6] =
        [Self::Conversion, Self::Blending, Self::Quantisation, Self::Decoupling, Self::Uniformity, Self::Feasibility];

    /// The name in the list.
    pub(crate) const fn label(self) -> &'static str {
        match self {
            Self::Conversion => "Conversion",
            Self::Blending => "Blending",
            Self::Quantisation => "Quantisation",
            Self::Decoupling => "Decoupling",
            Self::Uniformity => "Uniformity",
            Self::Feasibility => "Feasibility",
        }
    }

    /// The question it answers.
    pub(crate) const fn question(self) -> &'static str {
        match self {
            Self::Conversion => "Do parameters convert like colours?",
            Self::Blending => "Can a painted mask be filtered?",
            Self::Quantisation => "Do eight bits suffice?",
            Self::Decoupling => "Does one slider leave the other alone?",
            Self::Uniformity => "Do equal steps look equal?",
            Self::Feasibility => "Which r and h are reflectances?",
        }
    }

    /// Whether it takes a second material.
    pub(crate) const fn has_second(self) -> bool {
        matches!(self, Self::Blending | Self::Quantisation)
    }
}

/// What a person has open: where a demonstration starts from.
#[derive(Clone, Copy)]
pub(crate) struct Open<'a> {
    /// The preset.
    pub preset: &'a Preset,
    /// The metal it is compared with.
    pub metal: Option<&'static Metal>,
}

impl Open<'_> {
    /// True when the preset is not the one every new window starts with.
    fn has_own_preset(&self) -> bool {
        let new = Preset::new_authored();
        (self.preset.space, self.preset.r, self.preset.h) != (new.space, new.r, new.h)
    }
}

/// The ways to n, k and g that the page offers: those that give all three without a search.
pub(crate) const METHODS: [Method; 5] = [
    Method::ColourMatching,
    Method::LeastSquares,
    Method::BandAverage,
    Method::Points(crate::fit::Triple::ROUND),
    Method::Points(crate::fit::Triple::PRIMARIES),
];

/// The r that the sliders are swept at.
pub(crate) const R_RANGE: std::ops::RangeInclusive<f64> = 0.02..=0.98;

/// The page of demonstrations.
pub(crate) struct DemonstrationsPage {
    /// Which one is on show.
    pub demonstration: Demonstration,
    /// What a person chose it to be about; `None` is the most telling.
    pub first: Option<Choice>,
    /// The material it is blended with, likewise.
    pub second: Option<Choice>,
    /// The refractive index of a dielectric.
    pub n: f64,
    /// Where parameters are converted from.
    pub from: RgbSpace,
    /// Where to.
    pub to: RgbSpace,
    /// The space of every other demonstration.
    pub space: RgbSpace,
    /// How n, k and g of a metal are derived.
    pub method: Method,
    /// The conversion of all metals in place of one.
    pub has_all_metals: bool,
    /// All pairs of metals in place of two materials.
    pub has_all_pairs: bool,
    /// The place of the slider between two materials.
    pub share: f64,
    /// The descriptions below and above the diagonal of all pairs.
    pub matrix: [Parameters; 2],
    /// The storage whose gradients are shown.
    pub storage: Storage,
    /// How far parameters are moved.
    pub amount: f64,
    /// The r that the sliders are swept at; `None` is the preset's.
    pub r: Option<f64>,
    conversion: Latest<OfConversion, Told<ShownConversion>>,
    conversions: Latest<ConversionOptions, Told<ShownConversions>>,
    blend: Latest<OfPair, Told<ShownBlend>>,
    painted: Latest<(OfPair, u32), Told<Vec<eframe::egui::ColorImage>>>,
    spheres: Vec<TextureHandle>,
    blends: Latest<(RgbSpace, Method), Told<ShownBlends>>,
    quantisation: Latest<OfPair, Told<ShownQuantisation>>,
    decoupling: Latest<OfDecoupling, Told<ShownDecoupling>>,
    uniformity: Latest<f64, ShownUniformity>,
    square: Latest<RgbSpace, ShownSquare>,
    exports: Vec<Job<PathBuf, Result<(), String>>>,
    /// The file that was written last.
    pub exported: Option<PathBuf>,
}

impl Default for DemonstrationsPage {
    fn default() -> Self {
        let ConversionOptions { from, to, method } = ConversionOptions::default();
        Self {
            demonstration: Demonstration::default(),
            first: None,
            second: None,
            n: 1.5,
            from,
            to,
            space: RgbSpace::AcesCg,
            method,
            has_all_metals: false,
            has_all_pairs: false,
            share: 0.5,
            matrix: [Parameters::G, Parameters::Nk],
            storage: Storage::Bits8,
            amount: DecouplingOptions::default().amount,
            r: None,
            conversion: Latest::default(),
            conversions: Latest::default(),
            blend: Latest::default(),
            painted: Latest::default(),
            spheres: Vec::new(),
            blends: Latest::default(),
            quantisation: Latest::default(),
            decoupling: Latest::default(),
            uniformity: Latest::default(),
            square: Latest::default(),
            exports: Vec::new(),
            exported: None,
        }
    }
}

impl DemonstrationsPage {
    /// True while a file is written.
    pub(crate) fn is_writing(&self) -> bool {
        !self.exports.is_empty()
    }

    /// True while what is on show is computed; a demonstration that was left is asked again when it is next on show.
    pub(crate) fn is_computing(&self) -> bool {
        match self.demonstration {
            Demonstration::Conversion if self.has_all_metals => self.conversions.is_busy(),
            Demonstration::Conversion => self.conversion.is_busy(),
            Demonstration::Blending if self.has_all_pairs => self.blends.is_busy(),
            Demonstration::Blending => self.blend.is_busy() || self.painted.is_busy(),
            Demonstration::Quantisation => self.quantisation.is_busy(),
            Demonstration::Decoupling => self.decoupling.is_busy(),
            Demonstration::Uniformity => self.uniformity.is_busy(),
            Demonstration::Feasibility => self.square.is_busy(),
        }
    }

    /// What a slot holds: a person's choice, their own preset, or what shows most.
    pub(crate) fn material(&self, slot: Slot, open: Open) -> Material {
        let choice = match slot {
            Slot::First => self.first.unwrap_or_else(|| self.telling(open)),
            Slot::Second => self.second.unwrap_or_else(|| self.telling_partner()),
        };
        Material::of(choice, open.preset, self.n)
    }

    /// Makes the demonstrations about a material.
    pub(crate) fn choose(&mut self, slot: Slot, choice: Choice) {
        match slot {
            Slot::First => self.first = Some(choice),
            Slot::Second => self.second = Some(choice),
        }
        match self.demonstration {
            Demonstration::Conversion => self.has_all_metals = false,
            Demonstration::Blending => self.has_all_pairs = false,
            _ => {}
        }
    }

    fn telling(&self, open: Open) -> Choice {
        let measured = open.metal.or(metal_by_name("gold").ok()).map_or(Choice::Example, Choice::Metal);
        match self.demonstration {
            _ if open.has_own_preset() => Choice::Preset,
            // Near g = 1, where most metals are, the edge hardly depends on r: that would hide the coupling.
            Demonstration::Decoupling => Choice::Example,
            _ => measured,
        }
    }

    fn telling_partner(&self) -> Choice {
        match (self.demonstration, metal_by_name("silver")) {
            (Demonstration::Quantisation, Ok(silver)) => Choice::Metal(silver),
            _ => Choice::Dielectric,
        }
    }

    /// The r of the sliders: chosen, or the mean of the preset's channels.
    pub(crate) fn slider_r(&self, open: Open) -> f64 {
        const TYPICAL: f64 = 0.8;
        let mean = open.preset.r.0.iter().sum::<f64>() / 3.0;
        let own = if open.has_own_preset() { mean } else { TYPICAL };
        self.r.unwrap_or(own).clamp(*R_RANGE.start(), *R_RANGE.end())
    }

    /// What is on show, as a job can compute it.
    pub(crate) fn exhibit(&self, open: Open) -> Exhibit {
        match self.demonstration {
            Demonstration::Conversion if self.has_all_metals => Exhibit::Conversions(self.options()),
            Demonstration::Conversion => Exhibit::Conversion(self.of_conversion(open)),
            Demonstration::Blending if self.has_all_pairs => {
                let [below, above] = self.matrix;
                Exhibit::Blends(OfMatrix { space: self.space, method: self.method, below, above })
            }
            Demonstration::Blending => Exhibit::Blending(self.of_pair(open)),
            Demonstration::Quantisation => Exhibit::Quantisation(self.of_pair(open)),
            Demonstration::Decoupling => Exhibit::Decoupling(self.of_decoupling(open)),
            Demonstration::Uniformity => Exhibit::Uniformity(self.slider_r(open)),
            Demonstration::Feasibility => Exhibit::Feasibility(Box::new(open.preset.clone())),
        }
    }

    fn options(&self) -> ConversionOptions {
        ConversionOptions { from: self.from, to: self.to, method: self.method }
    }

    fn of_conversion(&self, open: Open) -> OfConversion {
        OfConversion { material: self.material(Slot::First, open), options: self.options() }
    }

    fn described(&self, slot: Slot, open: Open) -> Described {
        Described { material: self.material(slot, open), space: self.space, method: self.method }
    }

    fn of_pair(&self, open: Open) -> OfPair {
        OfPair { a: self.described(Slot::First, open), b: self.described(Slot::Second, open) }
    }

    fn of_decoupling(&self, open: Open) -> OfDecoupling {
        OfDecoupling { described: self.described(Slot::First, open), amount: self.amount }
    }

    /// One material, converted.
    pub(crate) fn conversion(&mut self, ctx: &Context, open: Open) -> Option<&Told<ShownConversion>> {
        let of = self.of_conversion(open);
        self.conversion.of(ctx, "conversion", of, |of, _| ShownConversion::of(&of))
    }

    /// All metals, converted.
    pub(crate) fn conversions(&mut self, ctx: &Context) -> Option<&Told<ShownConversions>> {
        let options = self.options();
        self.conversions.of(ctx, "conversions", options, |options, progress| {
            ShownConversions::of(&options, &|share| progress.report(share))
        })
    }

    /// Two materials, blended.
    pub(crate) fn blend(&mut self, ctx: &Context, open: Open) -> Option<&Told<ShownBlend>> {
        let of = self.of_pair(open);
        self.blend.of(ctx, "blending", of, |of, _| ShownBlend::of(&of))
    }

    /// Painted spheres of two materials, `size` pixels wide; none where there are none yet.
    pub(crate) fn spheres(&mut self, ctx: &Context, open: Open, size: u32) -> &[TextureHandle] {
        let of = (self.of_pair(open), size);
        let work = |(of, size): (OfPair, u32), _: &super::job::Progress| shown::painted_spheres(&of, size);
        if let Some(images) = self.painted.take_new(ctx, "painted spheres", of, work) {
            let load = |image| ctx.load_texture("painted sphere", image, TextureOptions::LINEAR);
            // Why there are none is said where the blend would be.
            self.spheres = images.unwrap_or_default().into_iter().map(load).collect();
        }
        &self.spheres
    }

    /// Every pair of metals, blended.
    pub(crate) fn blends(&mut self, ctx: &Context) -> Option<&Told<ShownBlends>> {
        let of = (self.space, self.method);
        self.blends.of(ctx, "all blends", of, |(space, method), progress| {
            ShownBlends::of(space, method, &|share| progress.report(share))
        })
    }

    /// How much of a study of all metals is done, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.conversions.progress().or(self.blends.progress())
    }

    /// A material's parameters, stored.
    pub(crate) fn quantisation(&mut self, ctx: &Context, open: Open) -> Option<&Told<ShownQuantisation>> {
        let of = self.of_pair(open);
        self.quantisation.of(ctx, "quantisation", of, |of, _| ShownQuantisation::of(&of))
    }

    /// A material's parameters, moved.
    pub(crate) fn decoupling(&mut self, ctx: &Context, open: Open) -> Option<&Told<ShownDecoupling>> {
        let of = self.of_decoupling(open);
        self.decoupling.of(ctx, "decoupling", of, |of, _| ShownDecoupling::of(&of))
    }

    /// Sliders at one r.
    pub(crate) fn uniformity(&mut self, ctx: &Context, open: Open) -> Option<&ShownUniformity> {
        let r = self.slider_r(open);
        self.uniformity.of(ctx, "uniformity", r, |r, _| ShownUniformity::of(r))
    }

    /// The square of r and h in a space.
    pub(crate) fn square(&mut self, ctx: &Context, space: RgbSpace) -> Option<&ShownSquare> {
        self.square.of(ctx, "feasibility", space, |space, _| ShownSquare::of(space))
    }

    /// Writes a file of what is on show.
    pub(crate) fn export(
        &mut self,
        ctx: &Context,
        exhibit: Exhibit,
        piece: Piece,
        path: PathBuf,
    ) -> std::io::Result<()> {
        let job = Job::start(ctx, "export", path, move |path, _| exhibit.write(piece, &path))?;
        self.exports.push(job);
        Ok(())
    }

    /// Sentences about exports that failed; what was written is remembered.
    pub(crate) fn poll_exports(&mut self) -> Vec<String> {
        let mut failures = Vec::new();
        for job in std::mem::take(&mut self.exports) {
            match job.poll() {
                Poll::Working => self.exports.push(job),
                Poll::Done(Ok(())) => self.exported = Some(job.input.clone()),
                Poll::Done(Err(error)) => failures.push(error),
                Poll::Lost => failures.push(format!("{}: writing it ended unexpectedly", job.input.display())),
            }
        }
        failures
    }
}

impl std::fmt::Debug for DemonstrationsPage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DemonstrationsPage").field("demonstration", &self.demonstration).finish_non_exhaustive()
    }
}
