//! The state of the page of plans: the materials and where they are seen, what is allowed, and what came of it.

mod files;
mod material;
mod opened;
mod planned;
mod scene;
mod seeing;
mod trading;

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::Context;

pub(crate) use self::files::{DataFormat, PlanFile};
use self::files::{Done, Task};
pub(crate) use self::material::{Entry, PathField, PlanMaterial};
pub(crate) use self::opened::Opened;
use self::opened::ReadPlan;
use self::planned::{ListAsked, PlanAsked};
pub(crate) use self::planned::{ListCurves, Look, Planned};
pub(crate) use self::scene::PlanScene;
pub(crate) use self::seeing::{Apart, SeenScene};
use self::seeing::{PassFiles, ReadPass, Seeing};
pub(crate) use self::trading::{Chart, ChartPoint, TradeOf, Trading};
use super::demonstrations::{Latest, Told};
use super::job::{Job, Poll, Progress};
use crate::export;
use crate::metal::Metal;
use crate::preset::{Preset, Shelf};
use crate::scene::{Shape, kept_path};
use crate::study::{Costs, measured_costs};

/// What a person asks of the page.
#[derive(Clone, Debug)]
pub(crate) enum PlanAction {
    /// Finds a material by its name.
    Find,
    /// Adds a material to the list.
    Add(PlanMaterial),
    /// Finds the metal of the chart.
    FindTradeMetal,
    /// Makes the chart one of this metal.
    Trade(&'static Metal),
    /// Asks for a file.
    Choose(PlanFile),
    /// Reads or writes it.
    Take(PlanFile, PathBuf),
}

/// What the page shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum PlannerView {
    /// The materials and what is chosen for them.
    #[default]
    Plan,
    /// Cost against accuracy.
    Trade,
}

impl PlannerView {
    /// Every view with its name and what it shows.
    pub(crate) const ALL: [(Self, &'static str, &'static str); 2] = [
        (Self::Plan, "Plan", "The cheapest model for each material of a scene"),
        (Self::Trade, "Trade", "Every model by its cost and its error"),
    ];
}

/// Something shared that is equal only to itself: large results are told apart without looking into them.
pub(crate) struct Same<T>(pub Arc<T>);

impl<T> Clone for Same<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<T> PartialEq for Same<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The page of plans.
pub(crate) struct PlannerPage {
    /// What is on show.
    pub view: PlannerView,
    /// The materials, and what is allowed.
    pub scene: PlanScene,
    /// The place of the material that is looked at.
    pub selected: usize,
    /// How often files were asked to be read again.
    reads: u64,
    /// Whose files its materials are exported to.
    pub export_to: export::Target,
    /// The chart.
    pub trading: Trading,
    costs: Costs,
    curves: Latest<ListAsked, Told<Arc<ListCurves>>>,
    passes: Latest<PassFiles, Told<Arc<ReadPass>>>,
    seen: Latest<(Vec<u64>, Seeing), Told<Arc<SeenScene>>>,
    plans: Latest<PlanAsked, Told<Arc<Planned>>>,
    opened: Option<Opened>,
    chart: Option<Arc<Chart>>,
    planned: Option<Arc<Planned>>,
    tasks: Vec<Job<Task, Told<Done>>>,
    measuring: Option<Job<(), Told<Costs>>>,
    /// What came of the last file.
    pub said: Option<Told<String>>,
}

impl Default for PlannerPage {
    fn default() -> Self {
        Self {
            view: PlannerView::default(),
            scene: PlanScene::default(),
            selected: 0,
            reads: 0,
            export_to: export::Target::Glsl,
            trading: Trading::default(),
            costs: Costs::counted(),
            curves: Latest::default(),
            passes: Latest::default(),
            seen: Latest::default(),
            plans: Latest::default(),
            opened: None,
            chart: None,
            planned: None,
            tasks: Vec::new(),
            measuring: None,
            said: None,
        }
    }
}

impl PlannerPage {
    /// True while something is computed for what is on show: nothing else is followed, and can end.
    pub(crate) fn is_computing(&self) -> bool {
        match self.view {
            PlannerView::Plan if self.as_saved().is_some() => false,
            PlannerView::Plan => self.is_planning(),
            PlannerView::Trade => self.trading.is_busy(),
        }
    }

    /// True while a file is read or written, or times are measured.
    pub(crate) fn is_at_files(&self) -> bool {
        !self.tasks.is_empty() || self.measuring.is_some()
    }

    fn is_planning(&self) -> bool {
        self.curves.is_busy() || self.passes.is_busy() || self.seen.is_busy() || self.plans.is_busy()
    }

    /// How much of the fits is done, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.curves.progress()
    }

    /// The materials.
    pub(crate) fn entries(&self) -> &[Entry] {
        self.scene.entries()
    }

    /// Adds a material at the end, and selects it.
    pub(crate) fn add(&mut self, material: PlanMaterial) {
        self.add_of(material, None);
    }

    fn add_of(&mut self, material: PlanMaterial, file: Option<String>) {
        if self.is_fixed() {
            self.close_opened();
        }
        self.scene.add(material, Shape::Sphere, file);
        self.selected = self.entries().len() - 1;
    }

    /// Takes a material off the list.
    pub(crate) fn remove(&mut self, index: usize) {
        if index < self.entries().len() {
            self.scene.remove(index);
            if self.selected > index || self.selected == self.entries().len() {
                self.selected = self.selected.saturating_sub(1);
            }
        }
    }

    /// Empties the list.
    pub(crate) fn clear(&mut self) {
        self.scene.clear();
        self.selected = 0;
    }

    /// Lets files that have changed be read again.
    pub(crate) fn read_again(&mut self) {
        self.reads += 1;
    }

    /// What the variants cost: what can be counted, and the times of this machine where they were measured.
    pub(crate) fn costs(&self) -> &Costs {
        &self.costs
    }

    /// Measures what the variants take on this machine.
    pub(crate) fn measure_times(&mut self, ctx: &Context) {
        let job = Job::start(ctx, "measure times", (), |(), progress| {
            measured_costs(&|share| progress.report(share)).map_err(|error| error.to_string())
        });
        match job {
            Ok(job) => self.measuring = Some(job),
            Err(error) => self.said = Some(Err(format!("no thread could be started: {error}"))),
        }
    }

    /// How much of that is done, 0 to 1; `None` while nothing is measured.
    pub(crate) fn times_progress(&self) -> Option<f32> {
        self.measuring.as_ref().map(Job::progress)
    }

    fn poll_times(&mut self) {
        let Some(job) = self.measuring.take() else { return };
        match job.poll() {
            Poll::Working => self.measuring = Some(job),
            Poll::Done(Ok(costs)) => self.costs = costs,
            Poll::Done(Err(error)) => self.said = Some(Err(error)),
            Poll::Lost => self.said = Some(Err("Measuring times ended unexpectedly".to_owned())),
        }
    }

    /// The plan of a file.
    pub(crate) fn opened(&self) -> Option<&Opened> {
        self.opened.as_ref()
    }

    /// True where the plan of a file is looked at that cannot be changed.
    pub(crate) fn is_fixed(&self) -> bool {
        self.opened.as_ref().is_some_and(|opened| opened.why_fixed().is_some())
    }

    /// The plan of a file while nothing of it is changed.
    pub(crate) fn as_saved(&self) -> Option<&Arc<Planned>> {
        self.opened.as_ref().filter(|opened| opened.is_as_saved(&self.scene)).map(|opened| &opened.planned)
    }

    /// The plan of a file as it was saved, whatever was changed since.
    pub(crate) fn revert_opened(&mut self) {
        if let Some(scene) = self.opened.as_ref().and_then(Opened::scene) {
            self.scene.clone_from(scene);
            self.selected = 0;
        }
    }

    /// Back to what was planned for before a file was opened.
    pub(crate) fn close_opened(&mut self) {
        if let Some(opened) = self.opened.take() {
            self.scene = opened.into_before();
            (self.selected, self.planned) = (0, None);
        }
    }

    fn open(&mut self, path: PathBuf, read: ReadPlan) {
        self.close_opened();
        let opened = Opened::on_page(path, read, &mut self.scene);
        // Of its materials nothing is fitted twice.
        self.planned = Some(opened.planned.clone());
        self.opened = Some(opened);
        (self.selected, self.view) = (0, PlannerView::Plan);
    }

    /// The newest plan there is, which may be of an older list, and sees to it that the one asked for follows; a sentence
    /// where there can be none.
    pub(crate) fn follow(&mut self, ctx: &Context, open: &Preset) -> Option<Told<Arc<Planned>>> {
        if let Some(planned) = self.as_saved() {
            return Some(Ok(planned.clone()));
        }
        if self.entries().is_empty() {
            self.planned = None;
            return None;
        }
        let told = self.newest(ctx, open);
        self.planned = told.as_ref().and_then(|told| told.as_ref().ok().cloned());
        told
    }

    fn newest(&mut self, ctx: &Context, open: &Preset) -> Option<Told<Arc<Planned>>> {
        let curves = self.follow_curves(ctx, open);
        let seen = self.follow_seen(ctx);
        let (curves, seen) = match (curves, seen) {
            (Some(Err(error)), _) | (_, Some(Err(error))) => return Some(Err(error)),
            (Some(Ok(curves)), Some(Ok(seen))) if curves.entries == seen.entries => (curves, seen),
            // The last plan stays until both have come.
            _ => return self.planned.clone().map(Ok),
        };
        let asked = PlanAsked {
            curves: Same(curves),
            seen: Same(seen),
            tolerance: self.scene.tolerance,
            target: self.scene.target,
            costs: self.costs.clone(),
        };
        self.plans.of(ctx, "plan", asked, |asked, _| Planned::of(&asked)).cloned()
    }

    fn follow_curves(&mut self, ctx: &Context, open: &Preset) -> Option<Told<Arc<ListCurves>>> {
        let known = self.planned.as_ref().map(|planned| planned.curves.clone());
        let asked = ListAsked {
            entries: self.scene.keys(),
            materials: self.scene.resolved(open),
            files: self.scene.files(),
            space: self.scene.space,
        };
        let fit = move |asked, progress: &Progress| ListCurves::of(asked, known.as_deref(), progress);
        self.curves.of(ctx, "fit models", asked, fit).cloned()
    }

    fn follow_seen(&mut self, ctx: &Context) -> Option<Told<Arc<SeenScene>>> {
        let seeing = if self.scene.has_pass {
            match self.follow_pass(ctx)? {
                Ok(read) => Seeing::Pass(Same(read), self.scene.object_ids()),
                Err(error) => return Some(Err(error)),
            }
        } else {
            let (sights, pass) = self.scene.sights();
            Seeing::Each(sights, pass)
        };
        let input = (self.scene.keys(), seeing);
        self.seen.of(ctx, "angles", input, |(entries, seeing), _| SeenScene::of(entries, &seeing)).cloned()
    }

    fn follow_pass(&mut self, ctx: &Context) -> Option<Told<Arc<ReadPass>>> {
        let files = match self.scene.pass_files(self.reads) {
            Ok(files) => files,
            Err(missing) => return Some(Err(missing)),
        };
        let read = self.passes.of(ctx, "read pass", files, |files, progress| ReadPass::read(&files, progress)).cloned();
        // What was read before says nothing about these files, and may have another number of mattes.
        read.filter(|_| !self.passes.is_busy())
    }

    /// The newest chart there is, and sees to it that the one asked for follows.
    pub(crate) fn follow_chart(
        &mut self,
        ctx: &Context,
        open: &Preset,
        shelf: &Arc<Shelf>,
    ) -> Option<Told<Arc<Chart>>> {
        let scene = if self.trading.of == TradeOf::Scene { self.scene.resolved(open) } else { Vec::new() };
        let told = self.trading.follow(ctx, scene, shelf, (self.scene.space, &self.costs));
        self.chart = told.as_ref().and_then(|told| told.as_ref().ok().cloned());
        told
    }

    /// Whether there is something to write.
    pub(crate) fn has(&self, file: PlanFile) -> bool {
        match file {
            PlanFile::Save if self.is_fixed() => false,
            PlanFile::Save | PlanFile::Export(_) if self.as_saved().is_some() => true,
            PlanFile::Save | PlanFile::Export(_) => self.planned.is_some() && !self.is_planning(),
            PlanFile::Chart(_) | PlanFile::ChartData(_) => self.chart.is_some() && !self.trading.is_busy(),
            _ => true,
        }
    }

    /// Reads or writes a file.
    pub(crate) fn take(&mut self, ctx: &Context, file: PlanFile, path: PathBuf) {
        self.said = None;
        let shown = self.as_saved().or(self.planned.as_ref());
        let task = match (file, shown, &self.chart) {
            (PlanFile::Pass, ..) => return self.scene.pass.set(path),
            (PlanFile::Ids, ..) => return self.scene.ids.set(path),
            (PlanFile::Matte(id), ..) => {
                if let Some(matte) = self.scene.matte_mut(id) {
                    matte.set(path);
                }
                return;
            }
            (PlanFile::Material, ..) => Task::Add(path),
            (PlanFile::Open, ..) => Task::Open(path),
            (PlanFile::Save, Some(planned), _) => Task::Save(path, planned.clone()),
            (PlanFile::Export(target), Some(planned), _) => Task::Export(path, planned.clone(), target),
            (PlanFile::Chart(_), _, Some(chart)) => Task::SaveChart(path, chart.clone()),
            (PlanFile::ChartData(_), _, Some(chart)) => Task::SaveData(path, chart.clone()),
            (PlanFile::Save | PlanFile::Export(_) | PlanFile::Chart(_) | PlanFile::ChartData(_), ..) => {
                self.said = Some(Err("There is nothing to write yet".to_owned()));
                return;
            }
        };
        match Job::start(ctx, "file of a plan", task, |task, _| task.run()) {
            Ok(job) => self.tasks.push(job),
            Err(error) => self.said = Some(Err(format!("no thread could be started: {error}"))),
        }
    }

    /// Takes in what files and measurements have come to.
    pub(crate) fn poll(&mut self) {
        self.poll_times();
        for job in std::mem::take(&mut self.tasks) {
            match job.poll() {
                Poll::Working => self.tasks.push(job),
                Poll::Done(Ok(done)) => self.done(job.input.path().to_owned(), done),
                Poll::Done(Err(error)) => self.said = Some(Err(error)),
                Poll::Lost => {
                    let path = job.input.path().display();
                    self.said = Some(Err(format!("{path}: reading or writing it ended unexpectedly")));
                }
            }
        }
    }

    fn done(&mut self, path: PathBuf, done: Done) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match done {
            Done::Added(material, warnings) => {
                self.add_of(material, Some(kept_path(&path)));
                let warnings = warnings.iter().map(|warning| format!("; {warning}")).collect::<String>();
                self.said = Some(Ok(format!("Added {name}{warnings}")));
            }
            Done::Opened(read) => self.open(path, *read),
            Done::Exported(sentence) => self.said = Some(Ok(sentence)),
            Done::Wrote => self.said = Some(Ok(format!("Wrote {name}"))),
        }
    }
}

impl std::fmt::Debug for PlannerPage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PlannerPage").field("entries", &self.entries().len()).finish_non_exhaustive()
    }
}
