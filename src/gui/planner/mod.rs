//! The state of the page of plans: the materials and where they are seen, what is allowed, and what came of it.

mod files;
mod material;
mod planned;
mod seeing;
mod trading;

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::Context;

pub(crate) use self::files::{DataFormat, PlanFile};
use self::files::{Done, Task};
use self::material::Resolved;
pub(crate) use self::material::{Entry, PathField, PlanMaterial};
use self::planned::PlanAsked;
pub(crate) use self::planned::{ListCurves, Look, Planned};
pub(crate) use self::seeing::{Apart, SeenScene};
use self::seeing::{ApartFiles, PassFiles, ReadPass, Seeing};
pub(crate) use self::trading::{Chart, ChartPoint, TradeOf, Trading};
use super::demonstrations::{Latest, Told};
use super::job::{Job, Poll};
use crate::color::RgbSpace;
use crate::export;
use crate::metal::{Metal, metal_by_name, preferred_metals};
use crate::preset::{Preset, Shelf};
use crate::scene::{Shape, Target, Tolerance};
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
pub(super) struct Same<T>(pub Arc<T>);

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
    /// The materials.
    entries: Vec<Entry>,
    next_id: u64,
    /// The place of the material that is looked at.
    pub selected: usize,
    /// Whether a rendered pass says where materials are seen.
    pub has_pass: bool,
    /// The pass.
    pub pass: PathField,
    /// The channel of the pass; the likeliest where it is empty.
    pub channel: String,
    /// How its materials are told apart.
    pub apart: Apart,
    /// The picture of ids.
    pub ids: PathField,
    /// How often files were asked to be read again.
    reads: u64,
    /// What is allowed.
    pub tolerance: Tolerance,
    /// What is spared.
    pub target: Target,
    /// The space of parameters and differences.
    pub space: RgbSpace,
    /// Whose files its materials are exported to.
    pub export_to: export::Target,
    /// The chart.
    pub trading: Trading,
    costs: Costs,
    curves: Latest<ListAsked, Told<Arc<ListCurves>>>,
    passes: Latest<PassFiles, Told<Arc<ReadPass>>>,
    seen: Latest<(Vec<u64>, Seeing), Told<Arc<SeenScene>>>,
    plans: Latest<PlanAsked, Told<Arc<Planned>>>,
    opened: Option<(PathBuf, Arc<Planned>)>,
    chart: Option<Arc<Chart>>,
    planned: Option<Arc<Planned>>,
    tasks: Vec<Job<Task, Told<Done>>>,
    measuring: Option<Job<(), Told<Costs>>>,
    /// What came of the last file.
    pub said: Option<Told<String>>,
}

/// The materials of the list by their keys and as they are read, in a space.
type ListAsked = (Vec<u64>, Vec<Resolved>, RgbSpace);

impl Default for PlannerPage {
    fn default() -> Self {
        let mut page = Self {
            view: PlannerView::default(),
            entries: Vec::new(),
            next_id: 0,
            selected: 0,
            has_pass: false,
            pass: PathField::default(),
            channel: String::new(),
            apart: Apart::default(),
            ids: PathField::default(),
            reads: 0,
            tolerance: Tolerance::default(),
            target: Target::default(),
            space: RgbSpace::default(),
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
        };
        for (name, shape) in TELLING {
            if let Ok(metal) = metal_by_name(name) {
                page.add_on(PlanMaterial::Metal(metal), shape);
            }
        }
        page
    }
}

/// What a new window plans for: where a metal is seen decides as much as which it is.
const TELLING: [(&str, Shape); 4] = [
    ("Gold", Shape::Card { from_deg: 0.0, to_deg: 60.0 }),
    ("Copper", Shape::Sphere),
    ("Chromium", Shape::Floor { eye_m: 1.7, near_m: 1.0, far_m: 20.0 }),
    ("Zinc", Shape::Sphere),
];

impl PlannerPage {
    /// True while something is computed for what is on show: nothing else is followed, and can end.
    pub(crate) fn is_computing(&self) -> bool {
        match self.view {
            PlannerView::Plan if self.opened.is_some() => false,
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
        &self.entries
    }

    /// A material, to be seen elsewhere.
    pub(crate) fn entry_mut(&mut self, index: usize) -> Option<&mut Entry> {
        self.entries.get_mut(index)
    }

    /// Adds a material at the end, and selects it.
    pub(crate) fn add(&mut self, material: PlanMaterial) {
        self.add_on(material, Shape::Sphere);
        self.selected = self.entries.len() - 1;
        self.opened = None;
    }

    /// Adds every metal of the library that is not in the list.
    pub(crate) fn add_all_metals(&mut self) {
        for metal in preferred_metals() {
            let is_metal =
                |entry: &Entry| matches!(&entry.material, PlanMaterial::Metal(own) if std::ptr::eq(*own, metal));
            if !self.entries.iter().any(is_metal) {
                self.add_on(PlanMaterial::Metal(metal), Shape::Sphere);
            }
        }
    }

    fn add_on(&mut self, material: PlanMaterial, shape: Shape) {
        self.next_id += 1;
        let object_id = self.entries.iter().map(|entry| entry.object_id).max().unwrap_or(0) + 1;
        self.entries.push(Entry { id: self.next_id, material, shape, object_id, matte: PathField::default() });
    }

    /// Takes a material off the list.
    pub(crate) fn remove(&mut self, index: usize) {
        if index < self.entries.len() {
            self.entries.remove(index);
            if self.selected > index || self.selected == self.entries.len() {
                self.selected = self.selected.saturating_sub(1);
            }
        }
    }

    /// Empties the list.
    pub(crate) fn clear(&mut self) {
        self.entries.clear();
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

    /// The plan of a file that is looked at in place of the list's.
    pub(crate) fn opened(&self) -> Option<&(PathBuf, Arc<Planned>)> {
        self.opened.as_ref()
    }

    /// Back to the list.
    pub(crate) fn close_opened(&mut self) {
        self.opened = None;
        self.selected = 0;
    }

    /// The newest plan there is, which may be of an older list, and sees to it that the one asked for follows; a sentence
    /// where there can be none.
    pub(crate) fn follow(&mut self, ctx: &Context, open: &Preset) -> Option<Told<Arc<Planned>>> {
        if let Some((_, planned)) = &self.opened {
            return Some(Ok(planned.clone()));
        }
        if self.entries.is_empty() {
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
            tolerance: self.tolerance,
            target: self.target,
            costs: self.costs.clone(),
        };
        self.plans.of(ctx, "plan", asked, |asked, _| Planned::of(&asked)).cloned()
    }

    fn ids_of_entries(&self) -> Vec<u64> {
        self.entries.iter().map(|entry| entry.id).collect()
    }

    fn resolved(&self, open: &Preset) -> Vec<Resolved> {
        self.entries.iter().map(|entry| entry.material.resolved(open)).collect()
    }

    fn follow_curves(&mut self, ctx: &Context, open: &Preset) -> Option<Told<Arc<ListCurves>>> {
        let known = self.planned.as_ref().map(|planned| planned.curves.clone());
        let input = (self.ids_of_entries(), self.resolved(open), self.space);
        let curves = self.curves.of(ctx, "fit models", input, move |(entries, materials, space), progress| {
            ListCurves::of(entries, &materials, space, known.as_deref(), progress)
        });
        curves.cloned()
    }

    fn follow_seen(&mut self, ctx: &Context) -> Option<Told<Arc<SeenScene>>> {
        let seeing = if self.has_pass {
            match self.follow_pass(ctx)? {
                Ok(read) => Seeing::Pass(Same(read), self.entries.iter().map(|entry| entry.object_id).collect()),
                Err(error) => return Some(Err(error)),
            }
        } else {
            Seeing::Shapes(self.entries.iter().map(|entry| entry.shape).collect())
        };
        let input = (self.ids_of_entries(), seeing);
        self.seen.of(ctx, "angles", input, |(entries, seeing), _| SeenScene::of(entries, &seeing)).cloned()
    }

    fn follow_pass(&mut self, ctx: &Context) -> Option<Told<Arc<ReadPass>>> {
        let files = match self.pass_files() {
            Ok(files) => files,
            Err(missing) => return Some(Err(missing)),
        };
        let read = self.passes.of(ctx, "read pass", files, |files, progress| ReadPass::read(&files, progress)).cloned();
        // What was read before says nothing about these files, and may have another number of mattes.
        read.filter(|_| !self.passes.is_busy())
    }

    /// The files of the pass, or what is missing.
    fn pass_files(&self) -> Told<PassFiles> {
        let Some(pass) = self.pass.path() else {
            return Err("Choose a facing-ratio pass: the cosine between normal and view, as OpenEXR or PNG".to_owned());
        };
        let apart = match self.apart {
            Apart::Whole => ApartFiles::Whole,
            Apart::Ids => match self.ids.path() {
                Some(ids) => ApartFiles::Ids(ids.clone()),
                None => return Err("Choose the picture of ids that belongs to the pass".to_owned()),
            },
            Apart::Mattes => {
                let mattes: Option<Vec<PathBuf>> =
                    self.entries.iter().map(|entry| entry.matte.path().cloned()).collect();
                ApartFiles::Mattes(mattes.ok_or("Choose a matte for every material")?)
            }
        };
        let channel = Some(self.channel.trim().to_owned()).filter(|channel| !channel.is_empty());
        Ok(PassFiles { pass: pass.clone(), channel, apart, reads: self.reads })
    }

    /// The newest chart there is, and sees to it that the one asked for follows.
    pub(crate) fn follow_chart(
        &mut self,
        ctx: &Context,
        open: &Preset,
        shelf: &Arc<Shelf>,
    ) -> Option<Told<Arc<Chart>>> {
        let scene = if self.trading.of == TradeOf::Scene { self.resolved(open) } else { Vec::new() };
        let told = self.trading.follow(ctx, scene, shelf, (self.space, &self.costs));
        self.chart = told.as_ref().and_then(|told| told.as_ref().ok().cloned());
        told
    }

    /// Whether there is something to write.
    pub(crate) fn has(&self, file: PlanFile) -> bool {
        match file {
            PlanFile::Export(_) if self.opened.is_some() => true,
            PlanFile::Export(_) => self.planned.is_some() && !self.is_planning(),
            PlanFile::Save => self.opened.is_none() && self.planned.is_some() && !self.is_planning(),
            PlanFile::Chart(_) | PlanFile::ChartData(_) => self.chart.is_some() && !self.trading.is_busy(),
            _ => true,
        }
    }

    /// Reads or writes a file.
    pub(crate) fn take(&mut self, ctx: &Context, file: PlanFile, path: PathBuf) {
        self.said = None;
        let shown = self.opened.as_ref().map(|(_, planned)| planned).or(self.planned.as_ref());
        let task = match (file, shown, &self.chart) {
            (PlanFile::Pass, ..) => return self.pass.set(path),
            (PlanFile::Ids, ..) => return self.ids.set(path),
            (PlanFile::Matte(id), ..) => {
                if let Some(entry) = self.entries.iter_mut().find(|entry| entry.id == id) {
                    entry.matte.set(path);
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
                self.add(material);
                let warnings = warnings.iter().map(|warning| format!("; {warning}")).collect::<String>();
                self.said = Some(Ok(format!("Added {name}{warnings}")));
            }
            Done::Opened(planned) => {
                self.selected = 0;
                self.view = PlannerView::Plan;
                self.opened = Some((path, planned));
            }
            Done::Exported(sentence) => self.said = Some(Ok(sentence)),
            Done::Wrote => self.said = Some(Ok(format!("Wrote {name}"))),
        }
    }
}

impl std::fmt::Debug for PlannerPage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PlannerPage").field("entries", &self.entries.len()).finish_non_exhaustive()
    }
}
