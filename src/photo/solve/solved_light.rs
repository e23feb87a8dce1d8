//! One light solved together with r and h: close to 90° every metal is white (mode E).

use nalgebra::{SMatrix, SVector};

use super::MatchError;
use super::cells::Cell;
use super::light::Light;
use super::readings::Readings;
use super::region::SECTORS;
use super::regions::Regions;
use super::shape::ConductorShape;
use super::view::View;
use crate::color::Rgb;
use crate::number::median;
use crate::photo::MatchRequest;
use crate::photo::statistics::jackknife_error;

/// The fit needs pixels beyond this angle.
const NEEDED_DEG: f64 = 85.0;

/// L from a fit of r L, h L and L to the whole ball; the light's colour is the request's, white if it has none.
pub(super) fn solved_light(view: &View, request: &MatchRequest) -> Result<Light, MatchError> {
    let needs = "a ball large and sharp enough to show 85°: at least 400 pixels in radius";
    let body = request.body().ok_or(MatchError::needs(request.mode, needs))?;
    if body.radius() - Regions::RIM_MARGIN_PX < body.ring_radius(NEEDED_DEG) {
        return Err(MatchError::needs(request.mode, needs));
    }
    let colour = request.light.filter(|light| light.is_finite() && light.min_channel() > 0.0).unwrap_or(Rgb::WHITE);
    let regions = Regions::to_the_rim(view, body);
    let cells = Readings::of(view, &regions, &Light::even(colour.0.map(Some), [0.0; 3])).sums().cells();
    let weights = cells.each_ref().map(|cells| first_weights(cells));
    let level = solve(&cells, &weights).ok_or(MatchError::DarkReference { what: "ball" })?;
    let blocks = (0..SECTORS).filter_map(|sector| solve(&cells, &without(&cells, &weights, sector)));
    let error = jackknife_error(&blocks.collect::<Vec<_>>()) / level;
    // What a metal's curve has beyond its conductor shows directly in the light.
    let relative = if error.is_finite() { error.hypot(0.03) } else { 0.1 };
    Ok(Light::even(colour.0.map(|channel| Some(channel * level)), [relative; 3]))
}

/// Cells far from a smooth ball are lamps: weigh by how close a cell is to the median of its ring.
fn first_weights(cells: &[Cell]) -> Vec<f64> {
    let ring_median = |cell: &Cell| {
        let same = cells.iter().filter(|other| (other.stratum, other.ring) == (cell.stratum, cell.ring));
        median(&mut same.map(|other| other.reflectance).collect::<Vec<_>>())
    };
    cells.iter().map(|cell| if (cell.reflectance / ring_median(cell) - 1.0).abs() < 0.1 { 1.0 } else { 0.0 }).collect()
}

fn without(cells: &[Vec<Cell>; 3], weights: &[Vec<f64>; 3], sector: usize) -> [Vec<f64>; 3] {
    std::array::from_fn(|i| {
        let kept = |(cell, weight): (&Cell, &f64)| if cell.block == sector { 0.0 } else { *weight };
        cells[i].iter().zip(&weights[i]).map(kept).collect()
    })
}

/// Least squares for r L and h L of each channel and one L, with the conductor's shape taken off in rounds.
fn solve(cells: &[Vec<Cell>; 3], weights: &[Vec<f64>; 3]) -> Option<f64> {
    const ROUNDS: usize = 4;
    let mut shape: Option<ConductorShape> = None;
    let mut level = 1.0;
    for _ in 0..ROUNDS {
        let (mut normal, mut right) = (SMatrix::<f64, 7, 7>::zeros(), SVector::<f64, 7>::zeros());
        for channel in 0..3 {
            for (cell, weight) in cells[channel].iter().zip(&weights[channel]) {
                let beyond = shape.as_ref().map_or(0.0, |shape| shape.at(cell.cosine)[channel]) * level;
                let mut row = SVector::<f64, 7>::zeros();
                row[2 * channel] = cell.weights.of_r;
                row[2 * channel + 1] = cell.weights.of_h;
                row[6] = cell.weights.of_white;
                normal += row * row.transpose() * *weight;
                right += row * ((cell.reflectance - beyond) * *weight);
            }
        }
        let solution = normal.cholesky()?.solve(&right);
        level = solution[6];
        if level <= 0.0 {
            return None;
        }
        let rgb = |offset: usize| Rgb(std::array::from_fn(|i| solution[2 * i + offset] / level));
        shape = ConductorShape::of(rgb(0), rgb(1));
    }
    level.is_finite().then_some(level)
}
