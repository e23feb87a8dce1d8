//! What the studies measure, as figures.

use super::bars::{Bar, BarFigure};
use super::distribution::DistributionFigure;
use super::feasible::{FeasibleFigure, FeasiblePoint};
use super::matrix::MatrixFigure;
use super::table::{HeatRow, HeatTable};
use crate::color::{Rgb, RgbSpace, srgb8};
use crate::metal::{Metal, metals};
use crate::preset::Preset;
use crate::study::{AccuracyRow, BlendPair, ConversionSummary, MetalPoint, Parameters, SliderSweep};

const MEAN_OVER_ANGLES: &str = "mean ΔE2000 over 0–90°";

/// Mean ΔE of every candidate for every metal in one space, best metals first by the first candidate.
pub fn accuracy_table(rows: &[AccuracyRow], space: RgbSpace) -> HeatTable {
    let rows = || rows.iter().filter(move |row| row.space == space);
    let columns = in_order(rows().map(|row| row.candidate.label()));
    let metals = in_order(rows().map(|row| row.metal.clone()));
    let row_of = |metal: &String| {
        let own = || rows().filter(|row| row.metal == *metal);
        let value = |column: &String| own().find(|row| row.candidate.label() == *column).map(|row| row.mean_delta_e);
        HeatRow {
            label: own().next().map_or_else(String::new, |row| row.name.clone()),
            swatch: swatch_of(metal, space),
            values: columns.iter().map(value).collect(),
        }
    };
    let table = HeatTable {
        title: "How far models are from measured metals".to_owned(),
        subtitle: format!("{}, {MEAN_OVER_ANGLES}; strongest colour from 3 up", space.label()),
        rows: metals.iter().map(row_of).collect(),
        columns,
        full_scale: 3.0,
        decimals: 2,
    };
    table.sorted_by(0)
}

/// Mean ΔE over all metals, one row of dots for each candidate.
pub fn accuracy_distribution(rows: &[AccuracyRow], space: RgbSpace) -> DistributionFigure {
    let rows = || rows.iter().filter(move |row| row.space == space);
    let of_candidate = |label: String| {
        let own = rows().filter(|row| row.candidate.label() == label);
        let values = own.map(|row| row.mean_delta_e).collect();
        (label, values)
    };
    DistributionFigure {
        title: "Error of each model over all metals".to_owned(),
        subtitle: space.label().to_owned(),
        value_name: MEAN_OVER_ANGLES.to_owned(),
        is_log: true,
        rows: in_order(rows().map(|row| row.candidate.label())).into_iter().map(of_candidate).collect(),
    }
}

/// What converting parameters as if they were colours changes, over all metals.
pub fn conversion_distribution(rows: &[ConversionSummary]) -> DistributionFigure {
    let of = |parameters: Parameters| {
        let own = rows.iter().filter(|row| row.parameters == parameters);
        (parameters.label().to_owned(), own.map(|row| row.mean_delta_e).collect())
    };
    let spaces = rows.first().map(|row| format!("{} to {}", row.from.label(), row.to.label()));
    DistributionFigure {
        title: "Parameters converted as if they were colours".to_owned(),
        subtitle: spaces.unwrap_or_default(),
        value_name: format!("{MEAN_OVER_ANGLES} to the converted appearance"),
        is_log: false,
        rows: Parameters::ALL.map(of).into(),
    }
}

/// Every pair of metals blended half and half in one description.
pub fn blend_matrix_figure(pairs: &[BlendPair], parameters: Parameters) -> MatrixFigure {
    let own = || pairs.iter().filter(move |pair| pair.parameters == parameters);
    let count = own().map(|pair| pair.index_of_b + 1).max().unwrap_or(0);
    let mut names = vec![String::new(); count];
    let mut values = vec![vec![None; count]; count];
    for pair in own() {
        names[pair.index_of_a].clone_from(&pair.a);
        names[pair.index_of_b].clone_from(&pair.b);
        values[pair.index_of_a][pair.index_of_b] = Some(pair.max_delta_e);
        values[pair.index_of_b][pair.index_of_a] = Some(pair.max_delta_e);
    }
    let space = own().next().map_or("", |pair| pair.space.label());
    MatrixFigure {
        title: format!("Metals blended half and half by {}", parameters.label()),
        subtitle: format!("{space}, blended parameters against blended reflectance; strongest colour from 10 up"),
        value_name: "ΔE2000, worst angle".to_owned(),
        names,
        values,
        full_scale: 10.0,
    }
}

/// Every pair of metals blended half and half in two descriptions: one below the diagonal, one above.
pub fn blend_matrix_of_two(pairs: &[BlendPair], below: Parameters, above: Parameters) -> MatrixFigure {
    let mut figure = blend_matrix_figure(pairs, below);
    for pair in pairs.iter().filter(|pair| pair.parameters == above) {
        figure.values[pair.index_of_a][pair.index_of_b] = Some(pair.max_delta_e);
    }
    MatrixFigure {
        title: format!("Metals blended half and half: {} below the diagonal, {} above", below.label(), above.label()),
        ..figure
    }
}

/// The (r, h) square with measured metals and, if there is one, the preset being authored.
pub fn feasible_figure(points: &[MetalPoint], preset: Option<&Preset>) -> FeasibleFigure {
    let channel = |point: &MetalPoint| ["red", "green", "blue"].iter().position(|name| *name == point.channel);
    let symbol = |id: &str| metals().iter().find(|metal| metal.id == id).map_or_else(String::new, |m| m.symbol.clone());
    let figure_point = |point: &MetalPoint| FeasiblePoint {
        // One name for each metal, at its green channel.
        label: if point.channel == "green" { symbol(&point.metal) } else { String::new() },
        r: point.r,
        h: point.h,
        channel: channel(point).unwrap_or(0),
    };
    let space = points.first().map_or("", |point| point.space.label());
    FeasibleFigure {
        title: "Which r and h are reflectances".to_owned(),
        subtitle: format!("Red, green and blue of measured metals, {space}"),
        points: points.iter().map(figure_point).collect(),
        current: preset.map(|preset| std::array::from_fn(|i| (preset.r[i], preset.h[i]))),
    }
}

/// The steps of one slider, each with its grey and its ΔE.
pub fn step_figure(sweep: &SliderSweep) -> BarFigure {
    let bar = |(step, &value): (usize, &f64)| Bar {
        label: format!("{:.2} – {:.2}", sweep.positions[step], sweep.positions[step + 1]),
        value,
        series: 0,
        swatch: Some(srgb8(Rgb::splat(sweep.edges[step]), RgbSpace::LinRec709).0),
    };
    BarFigure {
        title: "Equal steps of a slider".to_owned(),
        subtitle: format!("{}, {}, r = {}", sweep.slider.label(), sweep.reach.label(), sweep.r),
        value_name: "ΔE2000 of the step at 81.8°".to_owned(),
        bars: sweep.delta_e.iter().enumerate().map(bar).collect(),
        decimals: 2,
    }
}

/// Each text once, in the order of first appearance.
fn in_order(texts: impl Iterator<Item = String>) -> Vec<String> {
    let mut seen = Vec::new();
    texts.for_each(|text| {
        if !seen.contains(&text) {
            seen.push(text);
        }
    });
    seen
}

/// The colour of a library metal facing the surface.
fn swatch_of(id: &str, space: RgbSpace) -> Option<[u8; 3]> {
    let metal: &Metal = metals().iter().find(|metal| metal.id == id)?;
    Some(srgb8(metal.r(space), space).0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::check::assert_texts_are_legible;
    use crate::figure::{Figure, FigureTheme};
    use crate::metal::metal_by_name;
    use crate::study::{Candidate, Reach, Slider, accuracy, metal_points, no_progress};

    const SPACE: RgbSpace = RgbSpace::LinRec709;

    fn is_legible(figure: &impl Figure) {
        assert_texts_are_legible(&figure.drawing(FigureTheme::Light));
    }

    #[test]
    fn accuracy_becomes_a_table_and_a_distribution() {
        let metals = ["gold", "zinc"].map(|name| metal_by_name(name).unwrap());
        let candidates = &Candidate::without_search()[..6];
        let rows = accuracy(&metals, candidates, &[SPACE, RgbSpace::AcesCg], &no_progress).unwrap();
        let table = accuracy_table(&rows, SPACE);
        assert_eq!((table.rows.len(), table.columns.len()), (2, candidates.len()));
        let hoffman =
            rows.iter().find(|row| row.space == SPACE && row.name == "Zinc" && row.model == "hoffman").unwrap();
        let column = table.columns.iter().position(|column| *column == hoffman.candidate.label()).unwrap();
        let zinc = table.rows.iter().find(|row| row.label == "Zinc").unwrap();
        assert_eq!(zinc.values[column], Some(hoffman.mean_delta_e));
        is_legible(&table);
        is_legible(&accuracy_distribution(&rows, SPACE));
    }

    #[test]
    fn the_square_names_each_metal_once() {
        let gold = metal_by_name("gold").unwrap();
        let figure = feasible_figure(&metal_points(&[gold], SPACE), Some(&Preset::from_metal(gold, SPACE)));
        assert_eq!(figure.points.iter().filter(|point| point.label == "Au").count(), 1);
        assert_eq!(figure.current.unwrap()[2], (gold.r(SPACE)[2], gold.h(SPACE)[2]));
        is_legible(&figure);
    }

    #[test]
    fn steps_become_bars() {
        let sweep = SliderSweep::new(0.8, Slider::ALL[0], Reach::ALL[0], 20).unwrap();
        let figure = step_figure(&sweep);
        assert_eq!(figure.bars.iter().map(|bar| bar.value).collect::<Vec<_>>(), sweep.delta_e);
        is_legible(&figure);
    }
}
