//! What the page of metals saves: curves, the table and spheres, written by a job.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;

use super::job::Progress;
use super::metals::{CONTESTANTS, MetalsPage};
use crate::color::RgbSpace;
use crate::figure::{ComparedSpheres, Figure, FigureTheme, SphereLayout, accuracy_table, curve_figure};
use crate::fit::{FitError, fit};
use crate::fresnel::FresnelModel;
use crate::metal::{Metal, preferred_metals};
use crate::render::{Light, RadialTable, SphereView};
use crate::study::accuracy;

/// What can be saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SheetKind {
    /// The truth, the models drawn over it, and their ΔE.
    Curves,
    /// Every metal against every model.
    Table,
    /// The spheres in a layout.
    Spheres(SphereLayout),
}

impl SheetKind {
    /// The endings of the files it can be, the usual one first.
    pub(crate) const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Curves | Self::Table => &["svg", "png"],
            Self::Spheres(_) => &["png", "exr"],
        }
    }

    /// What it is called in a question.
    pub(crate) const fn label(self) -> &'static str {
        match self {
            Self::Curves => "curves",
            Self::Table => "table",
            Self::Spheres(SphereLayout::Beside) => "spheres",
            Self::Spheres(SphereLayout::Wipe) => "wiped sphere",
            Self::Spheres(SphereLayout::Difference) => "difference",
            Self::Spheres(SphereLayout::Truth) => "truth",
            Self::Spheres(SphereLayout::Model) => "model",
        }
    }
}

/// Side of a saved sphere in pixels.
pub(crate) const SPHERE_PIXELS: u32 = 1024;

/// What is saved, with everything it depends on.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    kind: SheetKind,
    metal: &'static Metal,
    own: Vec<&'static Metal>,
    space: RgbSpace,
    /// Which contestants are drawn.
    shown: BTreeSet<usize>,
    /// Which one is on the sphere.
    on_sphere: usize,
    light: Light,
    wipe: f32,
    theme: FigureTheme,
}

impl Sheet {
    /// What the page shows now.
    pub(crate) fn of(page: &MetalsPage, kind: SheetKind, theme: FigureTheme) -> Self {
        Self {
            kind,
            metal: page.metal,
            own: page.own.clone(),
            space: page.space,
            shown: page.shown.clone(),
            on_sphere: page.on_sphere,
            light: page.light,
            wipe: page.wipe,
            theme,
        }
    }

    /// A name to begin with.
    pub(crate) fn file_name(&self) -> String {
        let ending = self.kind.endings()[0];
        match self.kind {
            SheetKind::Table => format!("metals.{ending}"),
            _ => format!("{} {}.{ending}", self.metal.name.to_lowercase().replace(['/', '\\'], "-"), self.kind.label()),
        }
    }

    /// Writes the file whole; gives what a person should know about it.
    pub(crate) fn write(&self, path: &Path, progress: &Progress) -> Result<Option<String>, String> {
        let said = |error: crate::render::SaveError| error.to_string();
        match self.kind {
            SheetKind::Curves => {
                let models = self.models().map_err(|error| error.to_string())?;
                let figure = curve_figure(Some(self.metal), &models, self.space);
                figure.save(path, self.theme).map(|()| None).map_err(said)
            }
            SheetKind::Table => self.save_table(path, progress).map(|()| None),
            SheetKind::Spheres(layout) => {
                let spheres = self.spheres().map_err(|error| error.to_string())?;
                spheres.save(layout, path, self.theme).map_err(said)
            }
        }
    }

    fn model(&self, index: usize) -> Result<(&'static str, FresnelModel), FitError> {
        let contestant = CONTESTANTS[index];
        Ok((contestant.name, fit(self.metal, contestant.kind, contestant.method, self.space)?.model))
    }

    fn models(&self) -> Result<Vec<(&'static str, FresnelModel)>, FitError> {
        self.shown.iter().map(|&index| self.model(index)).collect()
    }

    fn save_table(&self, path: &Path, progress: &Progress) -> Result<(), String> {
        let metals: Vec<&Metal> = self.own.iter().copied().chain(preferred_metals()).collect();
        let report = |share: f32| -> ControlFlow<()> { progress.report(share) };
        let candidates = CONTESTANTS.map(|contestant| contestant.candidate());
        let rows = accuracy(&metals, &candidates, &[self.space], &report).map_err(|error| error.to_string())?;
        accuracy_table(&rows, self.space).save(path, self.theme).map_err(|error| error.to_string())
    }

    fn spheres(&self) -> Result<ComparedSpheres, FitError> {
        let (name, model) = self.model(self.on_sphere)?;
        let view = SphereView::new(SPHERE_PIXELS, self.light, 0.0, self.space);
        Ok(ComparedSpheres {
            title: self.metal.name.clone(),
            subtitle: format!("{} · {}", self.space.label(), self.light.label().to_lowercase()),
            labels: [format!("Truth, {}", self.metal.provenance.citation()), name.to_owned()],
            pictures: [
                view.render(&RadialTable::of_metal(self.metal, self.space)),
                view.render(&RadialTable::of_model(&model, self.space)),
            ],
            wipe: f64::from(self.wipe),
            full_scale: None,
        })
    }
}
