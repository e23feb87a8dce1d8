//! The state of the page of metals: which one, compared how, and the table of all of them.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::Arc;

use eframe::egui::Context;

use super::job::Follower;
use super::spheres::Spheres;
use super::truth::curve_angles_deg;
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fit::{CurveError, Method, Triple, fit};
use crate::fresnel::{CosTheta, FresnelModel, ModelKind};
use crate::metal::{Metal, metal_by_name, metals, preferred_metals};
use crate::number::median_of_sorted;
use crate::render::Light;
use crate::study::{AccuracyRow, Candidate, accuracy};

/// A model with a way to its parameters, as the page offers it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contestant {
    /// A short name for legends and columns.
    pub name: &'static str,
    /// One sentence about how its parameters come about.
    pub what: &'static str,
    /// The model.
    pub kind: ModelKind,
    /// The way to its parameters.
    pub method: Method,
}

impl Contestant {
    /// The same as the accuracy study knows it.
    pub(crate) const fn candidate(self) -> Candidate {
        Candidate::Model(self.kind, self.method)
    }
}

/// What can be drawn over the truth; also the columns of the table.
pub(crate) const CONTESTANTS: [Contestant; 8] = [
    Contestant {
        name: "r, h",
        what: "Hoffman's model with the true r and h",
        kind: ModelKind::Hoffman,
        method: Method::Exact,
    },
    Contestant {
        name: "Schlick",
        what: "Schlick's curve with the true r",
        kind: ModelKind::Schlick,
        method: Method::Exact,
    },
    Contestant {
        name: "Lazányi",
        what: "Lazányi's correction of Schlick, fitted by least squares",
        kind: ModelKind::Lazanyi,
        method: Method::LeastSquares,
    },
    Contestant {
        name: "r, g",
        what: "Gulbrandsen's edge tint, g from n and k at 650, 550 and 450 nm",
        kind: ModelKind::Gulbrandsen,
        method: Method::Points(Triple::ROUND),
    },
    Contestant {
        name: "r, g = 0.5",
        what: "Gulbrandsen's edge tint as a user interface starts with it",
        kind: ModelKind::Gulbrandsen,
        method: Method::DefaultTint,
    },
    Contestant {
        name: "n, k points",
        what: "RGB n and k at 650, 550 and 450 nm",
        kind: ModelKind::Conductor,
        method: Method::Points(Triple::ROUND),
    },
    Contestant {
        name: "n, k weighted",
        what: "RGB n and k weighted by the colour-matching functions",
        kind: ModelKind::Conductor,
        method: Method::ColourMatching,
    },
    Contestant {
        name: "n, k fitted",
        what: "RGB n and k fitted to the reflectance by least squares",
        kind: ModelKind::Conductor,
        method: Method::LeastSquares,
    },
];

/// A contestant's curve for one metal.
#[derive(Clone, Debug)]
pub(crate) struct Fitted {
    /// Which of [`CONTESTANTS`].
    pub contestant: usize,
    /// With its parameters.
    pub model: FresnelModel,
    /// Reflectance at each angle of the curves.
    pub curve: Vec<Rgb>,
    /// ΔE to the truth at each angle of the curves.
    pub delta_e: Vec<f64>,
    /// Mean ΔE over whole degrees.
    pub mean: f64,
    /// The largest.
    pub max: f64,
    /// What its parameters could not express, as sentences.
    pub losses: String,
}

/// The truth of a metal and what is drawn over it.
#[derive(Clone, Debug)]
pub(crate) struct Curves {
    /// The spectral truth at each angle of the curves.
    pub truth: Vec<Rgb>,
    /// The contestants asked for.
    pub fitted: Vec<Fitted>,
    /// Other measurements of the same material, where they are asked for and there are any.
    pub spread: Option<Spread>,
}

/// How far other measurements of a material are apart from the one on show.
#[derive(Clone, Debug)]
pub(crate) struct Spread {
    /// How many others there are.
    pub others: usize,
    /// The least of all at each angle, this one included.
    pub low: Vec<Rgb>,
    /// The greatest.
    pub high: Vec<Rgb>,
    /// The median ΔE of the others to this one at each angle.
    pub delta_e: Vec<f64>,
}

/// What the curves depend on.
#[derive(Clone, Debug)]
struct Asked {
    metal: &'static Metal,
    space: RgbSpace,
    contestants: BTreeSet<usize>,
    has_spread: bool,
}

impl PartialEq for Asked {
    fn eq(&self, other: &Self) -> bool {
        (&self.metal.id, self.space, &self.contestants) == (&other.metal.id, other.space, &other.contestants)
            && self.has_spread == other.has_spread
    }
}

/// What the page shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum MetalsView {
    /// Models over the truth of one metal.
    #[default]
    Curves,
    /// Spheres by the truth and by one model.
    Spheres,
    /// Every metal against every model.
    Table,
}

impl MetalsView {
    /// Every view with its name and what it shows.
    pub(crate) const ALL: [(Self, &'static str, &'static str); 3] = [
        (Self::Curves, "Curves", "Models over the truth of this metal"),
        (Self::Spheres, "Spheres", "A sphere by the truth and by a model, and where they differ"),
        (Self::Table, "All metals", "A table of every metal and model"),
    ];
}

/// What the cells of the table show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Measure {
    /// Mean over whole degrees.
    #[default]
    Mean,
    /// The largest.
    Max,
    /// The angle of the largest.
    Angle,
    /// Mean over the picture of a sphere.
    Sphere,
}

impl Measure {
    /// Every choice with its name.
    pub(crate) const ALL: [(Self, &'static str); 4] = [
        (Self::Mean, "Mean over 0–90°"),
        (Self::Max, "Largest"),
        (Self::Angle, "Angle of the largest"),
        (Self::Sphere, "Mean over a sphere"),
    ];

    pub(crate) fn of(self, error: &CurveError) -> f64 {
        match self {
            Self::Mean => error.mean_delta_e,
            Self::Max => error.max_delta_e,
            Self::Angle => error.angle_of_max_deg,
            Self::Sphere => error.sphere_delta_e,
        }
    }
}

/// How the table is sorted: by the name, or by a contestant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sorting {
    /// `None` is the name.
    pub column: Option<usize>,
    /// Largest first.
    pub is_descending: bool,
}

impl Sorting {
    /// A click on a column: the same one turns the order around.
    pub(crate) fn click(&mut self, column: Option<usize>) {
        *self = Self { column, is_descending: self.column == column && !self.is_descending };
    }
}

/// One row of the table.
#[derive(Clone, Debug)]
pub(crate) struct TableRow {
    /// The metal.
    pub metal: &'static Metal,
    /// The error of each contestant.
    pub cells: Vec<CurveError>,
}

/// The page of metals.
pub(crate) struct MetalsPage {
    /// What is typed into the search.
    pub search: String,
    /// The metal on show.
    pub metal: &'static Metal,
    /// The space everything is measured in.
    pub space: RgbSpace,
    /// Metals from a person's own files; they live as long as the program.
    pub own: Vec<&'static Metal>,
    /// What is typed in the field for the path of a file.
    pub path: String,
    /// Which of [`CONTESTANTS`] are drawn.
    pub shown: BTreeSet<usize>,
    /// Whether other measurements of the same material are drawn.
    pub has_spread: bool,
    /// What is on show.
    pub view: MetalsView,
    /// What the cells of the table show.
    pub measure: Measure,
    /// How the table is sorted.
    pub sorting: Sorting,
    /// Which of [`CONTESTANTS`] is on the spheres.
    pub on_sphere: usize,
    /// The light around the spheres.
    pub light: Light,
    /// Where the model begins in the wiped sphere, 0–1.
    pub wipe: f32,
    /// The pictures of the spheres.
    pub spheres: Spheres,
    /// The angle under the pointer.
    pub cursor_deg: Option<f64>,
    fits: Follower<Asked, Curves>,
    curves: Option<Curves>,
    study: Follower<Studied, Vec<TableRow>>,
    table: Option<Table>,
}

/// What the table depends on: the space, and how many metals a person has added.
type Studied = (RgbSpace, usize);

/// The newest table, in the order it was last sorted.
struct Table {
    studied: Studied,
    order: (Sorting, Measure),
    rows: Arc<Vec<TableRow>>,
}

impl Default for MetalsPage {
    fn default() -> Self {
        Self {
            search: String::new(),
            metal: metal_by_name("gold").expect("the library has gold"),
            space: RgbSpace::default(),
            own: Vec::new(),
            path: String::new(),
            shown: BTreeSet::from([0, 1, 3]),
            has_spread: true,
            view: MetalsView::default(),
            measure: Measure::default(),
            sorting: Sorting::default(),
            on_sphere: 0,
            light: Light::PhotoStudio,
            wipe: 0.5,
            spheres: Spheres::default(),
            cursor_deg: None,
            fits: Follower::default(),
            curves: None,
            study: Follower::default(),
            table: None,
        }
    }
}

impl MetalsPage {
    /// True while something is computed.
    pub(crate) fn is_busy(&self) -> bool {
        self.fits.is_busy() || self.study.is_busy() || self.spheres.is_busy()
    }

    /// Adds a metal of a person's own and shows it.
    pub(crate) fn add(&mut self, metal: Metal) {
        let metal: &'static Metal = Box::leak(Box::new(metal));
        self.own.push(metal);
        self.metal = metal;
    }

    /// The newest curves there are, and sees to it that those asked for follow.
    pub(crate) fn curves(&mut self, ctx: &Context) -> Option<&Curves> {
        let contestants = self.shown.iter().copied().chain([self.on_sphere]).collect();
        let asked = Asked { metal: self.metal, space: self.space, contestants, has_spread: self.has_spread };
        if let Some((_, curves)) = self.fits.follow(ctx, "fit models", asked, |asked, _| curves_of(&asked)) {
            self.curves = Some(curves);
        }
        self.curves.as_ref()
    }

    /// The table of all metals, sorted; sees to it that it is computed for the space on show.
    pub(crate) fn table(&mut self, ctx: &Context) -> Option<Arc<Vec<TableRow>>> {
        let (own, order) = (self.own.clone(), (self.sorting, self.measure));
        let done = self.study.follow(ctx, "accuracy study", (self.space, own.len()), move |(space, _), progress| {
            table_of(&own, space, &|fraction| progress.report(fraction))
        });
        if let Some((studied, mut rows)) = done {
            sort(&mut rows, order.0, order.1);
            self.table = Some(Table { studied, order, rows: Arc::new(rows) });
        }
        let table = self.table.as_mut().filter(|table| table.studied.0 == self.space)?;
        if table.order != order {
            sort(Arc::<Vec<TableRow>>::make_mut(&mut table.rows), order.0, order.1);
            table.order = order;
        }
        Some(table.rows.clone())
    }
}

impl std::fmt::Debug for MetalsPage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MetalsPage").field("metal", &self.metal.id).field("space", &self.space).finish_non_exhaustive()
    }
}

fn curves_of(asked: &Asked) -> Curves {
    let at = |deg: f64| asked.metal.reflectance(CosTheta::from_deg(deg), asked.space);
    let truth: Vec<Rgb> = curve_angles_deg().map(at).collect();
    let fitted = asked.contestants.iter().filter_map(|&index| fitted(asked, index, &truth)).collect();
    let spread = if asked.has_spread { spread_of(asked, &truth) } else { None };
    Curves { truth, fitted, spread }
}

/// Other measurements of a material: what is calculated or fitted to earlier data is none.
pub(crate) fn other_measurements(metal: &Metal) -> impl Iterator<Item = &'static Metal> + '_ {
    let is_other = |other: &&Metal| other.name == metal.name && other.id != metal.id && other.is_measured();
    metals().iter().filter(is_other)
}

fn spread_of(asked: &Asked, truth: &[Rgb]) -> Option<Spread> {
    let curve = |metal: &Metal| -> Vec<Rgb> {
        curve_angles_deg().map(|deg| metal.reflectance(CosTheta::from_deg(deg), asked.space)).collect()
    };
    let others: Vec<Vec<Rgb>> = other_measurements(asked.metal).map(curve).collect();
    let extreme = |index: usize, pick: fn(f64, f64) -> f64| {
        others.iter().fold(truth[index], |extreme, other| extreme.zip(other[index], pick))
    };
    let median_delta_e = |index: usize| {
        let mut values: Vec<f64> =
            others.iter().map(|other| delta_e_rgb(other[index], truth[index], asked.space)).collect();
        values.sort_by(f64::total_cmp);
        median_of_sorted(&values, |value| *value)
    };
    (!others.is_empty()).then(|| Spread {
        others: others.len(),
        low: (0..truth.len()).map(|index| extreme(index, f64::min)).collect(),
        high: (0..truth.len()).map(|index| extreme(index, f64::max)).collect(),
        delta_e: (0..truth.len()).map(median_delta_e).collect(),
    })
}

fn fitted(asked: &Asked, contestant: usize, truth: &[Rgb]) -> Option<Fitted> {
    let Contestant { kind, method, .. } = CONTESTANTS[contestant];
    let fit = fit(asked.metal, kind, method, asked.space).ok()?;
    let curve: Vec<Rgb> = curve_angles_deg().map(|deg| fit.model.reflectance(CosTheta::from_deg(deg))).collect();
    let delta_e = curve.iter().zip(truth).map(|(ours, theirs)| delta_e_rgb(*ours, *theirs, asked.space)).collect();
    let losses = fit.losses.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    let (mean, max) = (fit.error.mean_delta_e, fit.error.max_delta_e);
    Some(Fitted { contestant, model: fit.model, curve, delta_e, mean, max, losses })
}

fn table_of(
    own: &[&'static Metal],
    space: RgbSpace,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Vec<TableRow> {
    let metals: Vec<&'static Metal> = own.iter().copied().chain(preferred_metals()).collect();
    let candidates = CONTESTANTS.map(Contestant::candidate);
    // A study that was stopped has no rows, and nobody waits for them.
    let rows = accuracy(&metals, &candidates, &[space], progress).unwrap_or_default();
    let cells = rows.chunks_exact(candidates.len());
    metals.into_iter().zip(cells).map(|(metal, cells)| TableRow { metal, cells: errors(cells) }).collect()
}

fn errors(rows: &[AccuracyRow]) -> Vec<CurveError> {
    let error = |row: &AccuracyRow| CurveError {
        mean_delta_e: row.mean_delta_e,
        max_delta_e: row.max_delta_e,
        angle_of_max_deg: row.angle_of_max_deg,
        sphere_delta_e: row.sphere_delta_e,
    };
    rows.iter().map(error).collect()
}

fn sort(rows: &mut [TableRow], sorting: Sorting, measure: Measure) {
    match sorting.column {
        None => rows.sort_by(|a, b| a.metal.name.cmp(&b.metal.name)),
        Some(column) => rows.sort_by(|a, b| measure.of(&a.cells[column]).total_cmp(&measure.of(&b.cells[column]))),
    }
    if sorting.is_descending {
        rows.reverse();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_contestant_takes_its_method() {
        for contestant in CONTESTANTS {
            assert!(contestant.method.applies_to(contestant.kind), "{}", contestant.name);
        }
    }

    #[test]
    fn the_table_sorts_by_any_column_both_ways() {
        let mut rows = table_of(&[], RgbSpace::LinRec709, &crate::study::no_progress);
        assert_eq!(rows.len(), preferred_metals().count());
        let values = |rows: &[TableRow], column: usize| -> Vec<f64> {
            rows.iter().map(|row| Measure::Max.of(&row.cells[column])).collect()
        };
        let mut sorting = Sorting::default();
        sorting.click(Some(1));
        sort(&mut rows, sorting, Measure::Max);
        assert!(values(&rows, 1).is_sorted());
        sorting.click(Some(1));
        sort(&mut rows, sorting, Measure::Max);
        assert!(values(&rows, 1).iter().rev().is_sorted());
    }
}
