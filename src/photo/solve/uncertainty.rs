//! How well r and h are known: each source on its own.

use super::cells::Cell;
use super::fit::{BallFit, Unknowns, least_squares};
use super::light::Light;
use super::measured::{Measured, fit_metal};
use super::outcome::UncertaintyBudget;
use super::readings::Readings;
use super::region::RINGS;
use super::regions::Regions;
use super::view::View;
use crate::photo::statistics::jackknife_error;
use crate::photo::{LightMode, MatchRequest};

/// The uncertainty of a match.
pub(super) struct Uncertainty {
    pub budget: UncertaintyBudget,
    /// True when the light or the tone curve is not known.
    pub is_estimate: bool,
}

/// Every source for every channel.
pub(super) fn of(
    view: &View,
    request: &MatchRequest,
    regions: &Regions,
    light: &Light,
    measured: &Measured,
) -> Uncertainty {
    let each = |f: &dyn Fn(usize) -> [f64; 2]| std::array::from_fn(f);
    let transfer = |i: usize| {
        let level = light.value[i].unwrap_or(1.0);
        pair(&measured.curve.fits[i]).map(|value| value.abs() * view.tone_uncertainty(i, value * level))
    };
    let budget = UncertaintyBudget {
        sample: each(&|i| of_sample(&measured.kept[i], &measured.curve.fits[i], regions)),
        model: each(&|i| of_model(&measured.kept[i], &measured.curve.fits[i])),
        light: each(&|i| of_light(&measured.kept[i], &measured.curve.fits[i], regions, light.relative_uncertainty[i])),
        angle: of_angle(view, request, regions, light),
        transfer: each(&transfer),
    };
    Uncertainty { budget, is_estimate: view.is_estimate() || request.mode == LightMode::ByEye }
}

/// `[r, h]`, 0 for what is not known.
fn pair(fit: &BallFit) -> [f64; 2] {
    [fit.r.unwrap_or(0.0), fit.h.unwrap_or(0.0)]
}

/// Delete-a-block jackknife with the robust weights held; facing and grazing blocks are separate strata.
fn of_sample(cells: &[Cell], fit: &BallFit, regions: &Regions) -> [f64; 2] {
    let unknowns = Unknowns::of(cells, regions);
    let mut variance = [0.0; 2];
    for (stratum, region) in [&regions.inner, &regions.outer].into_iter().enumerate() {
        let Some(region) = region else { continue };
        let blocks: Vec<usize> = (0..region.blocks())
            .filter(|&block| cells.iter().any(|cell| cell.stratum == stratum && cell.block == block))
            .collect();
        let estimates: Vec<[f64; 2]> = blocks
            .iter()
            .map(|&block| {
                let is_left_out = |cell: &Cell| cell.stratum == stratum && cell.block == block;
                let weights: Vec<f64> = cells
                    .iter()
                    .zip(&fit.cell_weights)
                    .map(|(cell, weight)| if is_left_out(cell) { 0.0 } else { *weight })
                    .collect();
                let (r, h) = least_squares(cells, &weights, unknowns);
                [r.unwrap_or(0.0), h.unwrap_or(0.0)]
            })
            .collect();
        for (which, variance) in variance.iter_mut().enumerate() {
            let error = jackknife_error(&estimates.iter().map(|estimate| estimate[which]).collect::<Vec<_>>());
            *variance += if error.is_finite() { error * error } else { 0.0 };
        }
    }
    variance.map(f64::sqrt)
}

/// Root mean square over rings of what the curve leaves over all around: no azimuth averages it away.
fn of_model(cells: &[Cell], fit: &BallFit) -> [f64; 2] {
    let residuals = fit.residuals(cells);
    [0, 1].map(|stratum| {
        let mut rings = [(0.0, 0.0); RINGS];
        for ((cell, residual), weight) in cells.iter().zip(&residuals).zip(&fit.cell_weights) {
            if cell.stratum == stratum {
                rings[cell.ring].0 += weight * residual;
                rings[cell.ring].1 += weight;
            }
        }
        let means: Vec<f64> = rings.iter().filter(|ring| ring.1 > 0.0).map(|ring| ring.0 / ring.1).collect();
        (means.iter().map(|mean| mean * mean).sum::<f64>() / means.len().max(1) as f64).sqrt()
    })
}

/// What a brighter light would give, by fitting again: F is pixel over light.
fn of_light(cells: &[Cell], fit: &BallFit, regions: &Regions, relative: f64) -> [f64; 2] {
    let brighter: Vec<Cell> =
        cells.iter().map(|cell| Cell { reflectance: cell.reflectance * (1.0 + relative), ..*cell }).collect();
    let (r, h) = least_squares(&brighter, &fit.cell_weights, Unknowns::of(cells, regions));
    let [old_r, old_h] = pair(fit);
    [(r.unwrap_or(0.0) - old_r).abs(), (h.unwrap_or(0.0) - old_h).abs()]
}

/// Half the difference between fits with the radius larger and smaller by its uncertainty.
fn of_angle(view: &View, request: &MatchRequest, regions: &Regions, light: &Light) -> [[f64; 2]; 3] {
    let Some(body) = request.body() else { return [[0.0; 2]; 3] };
    let error = request.radius_uncertainty_px().min(body.radius() / 2.0);
    let fits = [-error, error].map(|change| {
        let regions = regions.of_another(body.with_radius(body.radius() + change), request, view.size());
        fit_metal(&Readings::of(view, &regions, light).sums().cells(), &regions).0.fits
    });
    let [smaller, larger] = &fits;
    std::array::from_fn(|i| {
        let ([r0, h0], [r1, h1]) = (pair(&smaller[i]), pair(&larger[i]));
        [(r1 - r0).abs() / 2.0, (h1 - h0).abs() / 2.0]
    })
}

#[cfg(test)]
mod tests {
    use super::super::fit::fit;
    use super::*;
    use crate::fresnel::{CosTheta, Weights};

    fn cells(reflectance: impl Fn(usize, Weights) -> f64) -> Vec<Cell> {
        let cell = |stratum: usize, block: usize, ring: usize| {
            let angle_deg = if stratum == 0 { 5.0 * ring as f64 } else { 55.0 + 3.5 * ring as f64 };
            let weights = Weights::at(CosTheta::from_deg(angle_deg));
            Cell { stratum, block, ring, count: 100, reflectance: reflectance(block, weights), weights, cosine: 0.0 }
        };
        let indices = (0..2).flat_map(|s| (0..24).flat_map(move |b| (0..RINGS).map(move |r| (s, b, r))));
        indices.map(|(s, b, r)| cell(s, b, r)).collect()
    }

    fn ball() -> Regions {
        let request =
            MatchRequest { circle: Some(crate::photo::Circle::new(0.0, 0.0, 100.0)), ..MatchRequest::default() };
        Regions::with_body(&request, request.body())
    }

    #[test]
    fn an_exact_curve_leaves_nothing() {
        let cells = cells(|_, weights| weights.apply(0.55, 0.7));
        let fit = fit(&cells, &ball());
        assert!((fit.r.unwrap() - 0.55).abs() < 1e-12 && (fit.h.unwrap() - 0.7).abs() < 1e-12);
        for value in of_sample(&cells, &fit, &ball()).into_iter().chain(of_model(&cells, &fit)) {
            assert!(value < 1e-9, "{value}");
        }
    }

    /// Scaling every F by 1 + u moves r by u r, up to the white that stays white and bends the curve.
    #[test]
    fn the_light_scales_r() {
        let cells = cells(|_, weights| weights.apply(0.55, 0.7));
        let [r, h] = of_light(&cells, &fit(&cells, &ball()), &ball(), 0.03);
        assert!((r - 0.03 * 0.55).abs() < 0.002, "{r}");
        assert!(h > 0.5 * 0.03 * 0.7 && h < 2.0 * 0.03 * 0.7, "{h}");
    }

    #[test]
    fn uneven_sectors_widen_the_uncertainty() {
        let uneven = |amount: f64| {
            cells(move |block, weights| {
                weights.apply(0.55, 0.7) * (1.0 + amount * (block as f64 / 24.0 * std::f64::consts::TAU).cos())
            })
        };
        let errors = [0.02, 0.10].map(|amount| {
            let cells = uneven(amount);
            of_sample(&cells, &fit(&cells, &ball()), &ball())
        });
        assert!(errors[1][0] > 3.0 * errors[0][0] && errors[1][1] > 3.0 * errors[0][1], "{errors:?}");
    }
}
