//! The chart of cost against accuracy: of what, over which cost, and what was measured.

use std::sync::Arc;

use eframe::egui::Context;

use super::Same;
use super::files::DataFormat;
use super::material::Resolved;
use crate::color::RgbSpace;
use crate::figure::{ScatterFigure, trade_figure};
use crate::gui::demonstrations::{Latest, Told};
use crate::gui::job::Progress;
use crate::metal::{Metal, metal_by_name, preferred_metals};
use crate::preset::{Loaded, Preset, Shelf, built_in_presets};
use crate::study::{
    CostAxis, Costs, Measure, Subject, TradeErrors, TradeOptions, TradeRow, rows_to_csv, rows_to_json, trade_summary,
};

/// What the chart is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TradeOf {
    /// One metal.
    Metal,
    /// The materials of the plan's list.
    Scene,
    /// The presets that ship with the program.
    Presets,
    /// The presets of the folder that is open on the page of the library.
    Folder,
    /// Every metal of the library, by its preferred data set.
    AllMetals,
}

impl TradeOf {
    /// Every choice with its name.
    pub(crate) const ALL: [(Self, &'static str); 5] = [
        (Self::Metal, "One metal"),
        (Self::Scene, "Materials of the plan"),
        (Self::Presets, "Built-in presets"),
        (Self::Folder, "Presets of the library"),
        (Self::AllMetals, "All metals"),
    ];
}

/// The state of the chart.
pub(crate) struct Trading {
    /// What it is of.
    pub of: TradeOf,
    /// Which metal, where it is of one.
    pub metal: &'static Metal,
    /// The horizontal axis.
    pub cost: CostAxis,
    /// The vertical axis.
    pub measure: Measure,
    folders: Latest<Same<Shelf>, Told<Arc<Folder>>>,
    /// The folder on show.
    folder: Option<Arc<Folder>>,
    errors: Latest<(String, Vec<Resolved>, RgbSpace), Told<Arc<Traded>>>,
    chart: Latest<ChartAsked, Arc<Chart>>,
}

/// The errors of every variant.
struct Traded {
    name: String,
    space: RgbSpace,
    errors: TradeErrors,
}

/// What the chart depends on.
#[derive(Clone, PartialEq)]
struct ChartAsked {
    traded: Same<Traded>,
    cost: CostAxis,
    measure: Measure,
    costs: Costs,
}

/// The chart, as it is drawn and as it is saved.
#[derive(Debug)]
pub(crate) struct Chart {
    /// The figure that is saved.
    pub figure: ScatterFigure,
    /// The same points for the screen: one for each variant that has a cost and an error.
    pub points: Vec<ChartPoint>,
    /// What the front says.
    pub summary: String,
    rows: Vec<TradeRow>,
}

/// A variant.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ChartPoint {
    /// A name that fits beside a dot.
    pub short: String,
    /// What it is and what it costs, in words.
    pub words: String,
    /// Its cost.
    pub x: f64,
    /// Its error.
    pub y: f64,
    /// Which of the figure's series.
    pub series: usize,
    /// True where no other variant is as cheap and nearer to the truth.
    pub is_on_front: bool,
}

impl Default for Trading {
    fn default() -> Self {
        Self {
            of: TradeOf::Metal,
            metal: metal_by_name("gold").expect("the library has gold"),
            cost: CostAxis::default(),
            measure: Measure::default(),
            folders: Latest::default(),
            folder: None,
            errors: Latest::default(),
            chart: Latest::default(),
        }
    }
}

impl Trading {
    pub(super) fn is_busy(&self) -> bool {
        self.folders.is_busy() || self.errors.is_busy() || self.chart.is_busy()
    }

    /// What a person should know about the materials.
    pub(crate) fn remarks(&self) -> &[String] {
        self.folder.as_ref().map(|folder| folder.remarks.as_slice()).unwrap_or_default()
    }

    /// How much of a study of many materials is done, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.errors.progress()
    }

    /// The newest chart there is, and sees to it that the one asked for follows.
    pub(super) fn follow(
        &mut self,
        ctx: &Context,
        scene: Vec<Resolved>,
        shelf: &Arc<Shelf>,
        (space, costs): (RgbSpace, &Costs),
    ) -> Option<Told<Arc<Chart>>> {
        self.folder = None;
        let (name, materials) = match self.of {
            TradeOf::Metal => (self.metal.name.clone(), vec![Resolved::Metal(self.metal)]),
            TradeOf::Scene => (counted(scene.len(), "material"), scene),
            TradeOf::Presets => {
                let presets = built_in_presets();
                (counted(presets.len(), "preset"), presets.iter().map(Resolved::BuiltIn).collect())
            }
            TradeOf::Folder => match self.follow_folder(ctx, shelf)? {
                Ok(folder) => {
                    let presets = folder.presets.clone();
                    self.folder = Some(folder);
                    (counted(presets.len(), "preset"), presets)
                }
                Err(error) => return Some(Err(error)),
            },
            TradeOf::AllMetals => ("All metals".to_owned(), preferred_metals().map(Resolved::Metal).collect()),
        };
        if materials.is_empty() {
            return Some(Err("There is no material in the plan".to_owned()));
        }
        let traded = self.errors.of(ctx, "trade", (name, materials, space), |(name, materials, space), progress| {
            let subjects: Vec<Subject> = materials.iter().map(Resolved::subject).collect();
            let errors = TradeErrors::of(&subjects, space, &|share| progress.report(share));
            let errors = errors.map_err(|error| error.to_string())?;
            Ok(Arc::new(Traded { name, space, errors }))
        });
        let traded = match traded? {
            Ok(traded) => traded.clone(),
            Err(error) => return Some(Err(error.clone())),
        };
        let asked = ChartAsked { traded: Same(traded), cost: self.cost, measure: self.measure, costs: costs.clone() };
        self.chart.of(ctx, "trade chart", asked, |asked, _| Arc::new(Chart::of(&asked))).cloned().map(Ok)
    }

    fn follow_folder(&mut self, ctx: &Context, shelf: &Arc<Shelf>) -> Option<Told<Arc<Folder>>> {
        let read = |Same(shelf): Same<Shelf>, progress: &Progress| Folder::read(&shelf, progress);
        self.folders.of(ctx, "read presets", Same(shelf.clone()), read).cloned()
    }
}

/// The presets of a folder, and what a person should know about its files.
#[derive(Default)]
struct Folder {
    presets: Vec<Resolved>,
    remarks: Vec<String>,
}

impl Folder {
    /// Reads the files: a list holds too little of them.
    fn read(shelf: &Shelf, progress: &Progress) -> Told<Arc<Self>> {
        if shelf.items().is_empty() {
            return Err("Open a folder of presets on the page Library".to_owned());
        }
        let mut folder = Self::default();
        for (index, item) in shelf.items().iter().enumerate() {
            if progress.report(index as f32 / shelf.items().len() as f32).is_break() {
                return Err("Reading the folder was stopped".to_owned());
            }
            match Preset::load(&item.path) {
                Ok(loaded) => folder.add(loaded),
                Err(error) => folder.remarks.push(format!("left out: {error}")),
            }
        }
        if folder.presets.is_empty() {
            Err("None of the folder's files is a preset".to_owned())
        } else {
            Ok(folder.into())
        }
    }

    fn add(&mut self, loaded: Loaded) {
        self.remarks.extend(loaded.warnings);
        let note = Subject::of_preset(&loaded.preset).1;
        self.remarks.extend(note.map(|note| format!("{}: {note}", loaded.preset.name)));
        self.presets.push(Resolved::Preset(Arc::new(loaded.preset)));
    }
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

impl Chart {
    fn of(asked: &ChartAsked) -> Self {
        let ChartAsked { traded: Same(traded), cost, measure, costs } = asked;
        let options = TradeOptions { space: traded.space, cost: *cost, measure: *measure, costs: costs.clone() };
        let rows = traded.errors.rows(&options);
        let figure = trade_figure(&traded.name, &rows, &options);
        // The rows that the figure has a point for, in its order.
        let drawn = |row: &&TradeRow| row.error(*measure) > 0.0 && costs.of(row.variant).on(*cost).is_some();
        let points = figure.points.iter().zip(rows.iter().filter(drawn)).map(|(point, row)| ChartPoint {
            short: point.label.clone(),
            words: words(row, *measure),
            x: point.x,
            y: point.y,
            series: point.series,
            is_on_front: point.is_on_front,
        });
        Self { points: points.collect(), summary: trade_summary(&rows, &options), figure, rows }
    }

    /// The numbers in it.
    pub(super) fn data(&self, format: DataFormat) -> String {
        match format {
            DataFormat::Csv => rows_to_csv(&self.rows),
            DataFormat::Json => rows_to_json(&self.rows),
        }
    }
}

/// `Hoffman (r, h): largest ΔE 0.95 (Zinc), 11 shader operations, 24 bytes`.
fn words(row: &TradeRow, measure: Measure) -> String {
    let worst = row.worst.as_ref().filter(|_| row.materials > 1);
    let worst = worst.map(|worst| format!(", at most {:.2} ({worst})", row.max_delta_e)).unwrap_or_default();
    let time = row.measured_ns.map(|ns| format!(", {ns:.2} ns")).unwrap_or_default();
    format!(
        "{}: {} {:.2}{worst}, {} shader operations, {} bytes{time}",
        row.variant.label(),
        measure.label(),
        row.error(measure),
        row.shader_operations,
        row.parameter_bytes
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::no_progress;

    #[test]
    fn every_point_of_the_figure_is_on_the_screen_with_its_own_words() {
        let subjects = [Subject::Metal(metal_by_name("gold").unwrap())];
        let errors = TradeErrors::of(&subjects, RgbSpace::AcesCg, &no_progress).unwrap();
        let traded = Arc::new(Traded { name: "Gold".to_owned(), space: RgbSpace::AcesCg, errors });
        for (cost, measure) in [(CostAxis::ShaderOperations, Measure::Max), (CostAxis::ParameterBytes, Measure::P95)] {
            let chart = Chart::of(&ChartAsked { traded: Same(traded.clone()), cost, measure, costs: Costs::counted() });
            assert_eq!(chart.points.len(), chart.figure.points.len());
            assert!(chart.points.iter().any(|point| point.is_on_front));
            for point in &chart.points {
                assert!(point.words.contains(&format!("{:.2}", point.y)), "{} {}", point.words, point.y);
                assert!(point.words.contains(&format!(" {} ", point.x)), "{} {}", point.words, point.x);
            }
        }
    }
}
