//! What to beware of in a match: one sentence for each trap that is seen.

use super::cells::{Cell, Counts};
use super::light::Light;
use super::measured::Measured;
use super::outcome::Match;
use super::region::SECTORS;
use super::regions::Regions;
use super::shape::MetalCurve;
use super::sharpness::is_blurred;
use super::view::View;
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{CosTheta, gulbrandsen, reachable_h, reflectance_range};
use crate::number::median;
use crate::photo::cylinder_outline::steepest_cylinder;
use crate::photo::outline::steepest_circle;
use crate::photo::{
    Area, AreaStatistics, Body, LightMode, MatchRequest, Photo, Warning, WarningCode, snap_circle, snap_cylinder,
};

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Every warning of a match, in the order of the rails.
pub(super) fn warnings(
    view: &View,
    request: &MatchRequest,
    regions: &Regions,
    light: &Light,
    measured: &Measured,
    outcome: &Match,
) -> Vec<Warning> {
    let (photo, areas) = (view.photo, areas(view, regions, light));
    let noun = request.body().map_or("surface", Body::noun);
    let mut warnings = Vec::new();
    warnings.extend(geometry(photo, request, regions));
    warnings.extend(outline(photo, request));
    warnings.extend(clipped(noun, &measured.counts, &areas));
    warnings.extend(unusable(noun, measured, regions));
    warnings.extend(black(noun, &measured.counts, &areas));
    warnings.extend(two_colours(&areas));
    warnings.extend(small_ball(request));
    warnings.extend(uneven(request, measured, outcome));
    warnings.extend(rough(view, request));
    warnings.extend(mirrored_backdrop(request, measured));
    warnings.extend(infeasible(outcome));
    warnings.extend(gamut(outcome));
    warnings.extend(beyond_greys(view, light, measured));
    warnings.extend(estimate(photo, request, outcome));
    warnings
}

/// The warnings of a match that rests on areas alone.
pub(super) fn area_warnings(
    view: &View,
    request: &MatchRequest,
    areas: &[(&'static str, AreaStatistics)],
    outcome: &Match,
) -> Vec<Warning> {
    let counts = [Counts::default(); 2];
    let mut warnings = clipped("mirror", &counts, areas);
    warnings.extend(black("mirror", &counts, areas));
    warnings.extend(two_colours(areas));
    warnings.extend(infeasible(outcome));
    warnings.extend(gamut(outcome));
    warnings.extend(estimate(view.photo, request, outcome));
    warnings
}

/// The areas a person marked, by name.
fn areas(view: &View, regions: &Regions, light: &Light) -> Vec<(&'static str, AreaStatistics)> {
    let picked = |region: &Option<super::region::Region>| region.as_ref().and_then(super::region::Region::picked);
    let of = |name: &'static str, area: Area| (name, view.statistics(area));
    let cards = light.cards.iter().map(|(_, statistics)| ("card", statistics.clone()));
    let facing = picked(&regions.inner).map(|area| of("facing area", area));
    let edge = picked(&regions.outer).map(|area| of("edge area", area));
    cards.chain(facing).chain(edge).collect()
}

/// An outline this far from the body's edge, in pixels plus a share of the radius, was not placed on it.
const MISPLACED: (f64, f64) = (1.5, 0.01);

/// What the edge in the picture says of the outline; nothing where no edge is clear.
fn outline(photo: &Photo, request: &MatchRequest) -> Vec<Warning> {
    let found = request.body().and_then(|body| match body {
        Body::Ball(circle) => {
            steepest_circle(photo, circle).ok().map(|found| (body, found.circle.radius, found.warning()))
        }
        Body::Cylinder(cylinder) => {
            steepest_cylinder(photo, cylinder).ok().map(|found| (body, found.cylinder.radius, found.warning()))
        }
    });
    let Some((body, better, warning)) = found else { return Vec::new() };
    let radius = body.radius();
    let misplaced = ((better - radius).abs() > MISPLACED.0 + MISPLACED.1 * radius).then(|| {
        let (noun, edge) = (body.noun(), snapped_radius(photo, body).unwrap_or(better));
        let message = format!("The {noun}'s radius is {radius:.1} pixels, but the edge is at {edge:.1}: snap it.");
        Warning::new(WarningCode::Geometry, message)
    });
    misplaced.into_iter().chain(warning).collect()
}

/// The radius a person would get by snapping.
fn snapped_radius(photo: &Photo, body: Body) -> Option<f64> {
    match body {
        Body::Ball(circle) => snap_circle(photo, circle).ok().map(|found| found.circle.radius),
        Body::Cylinder(cylinder) => snap_cylinder(photo, cylinder).ok().map(|found| found.cylinder.radius),
    }
}

fn geometry(photo: &Photo, request: &MatchRequest, regions: &Regions) -> Vec<Warning> {
    let mut messages = Vec::new();
    if let Some(body) = request.body().filter(|body| !body.is_inside(photo.width, photo.height)) {
        messages.push(format!("The {} is cut off by the picture; only the part inside is measured.", body.noun()));
    }
    let cards = request.cards.iter().map(|card| ("card", card.area));
    let picks = [("facing area", request.facing), ("edge area", request.edge)];
    let picks = picks.into_iter().filter_map(|(name, area)| Some((name, area?)));
    for (name, area) in cards.chain(picks) {
        if !area.is_inside(photo.width, photo.height) {
            messages.push(format!("The {name} leaves the picture; only the part inside is measured."));
        }
    }
    for (name, region) in [("facing area", &regions.inner), ("edge area", &regions.outer)] {
        if let Some(region) = region
            && region.leaves_body(photo)
        {
            messages.push(format!("The {name} leaves the outline; only the part inside it is measured."));
        }
    }
    messages.into_iter().map(|message| Warning::new(WarningCode::Geometry, message)).collect()
}

fn clipped(noun: &str, counts: &[Counts; 2], areas: &[(&str, AreaStatistics)]) -> Vec<Warning> {
    let in_areas = areas.iter().flat_map(|(name, statistics)| {
        (0..3).filter(|&i| statistics.is_clipped(i)).map(|i| ((*name).to_owned(), CHANNELS[i])).collect::<Vec<_>>()
    });
    let bands = [(format!("middle of the {noun}"), 0), (format!("rim of the {noun}"), 1)];
    let is_picked = |name: &str| areas.iter().any(|area| area.0 == name);
    let in_bands = bands.into_iter().filter(|(_, stratum)| !is_picked(["facing area", "edge area"][*stratum]));
    let in_bands = in_bands.flat_map(|(name, stratum)| {
        (0..3).filter(move |&i| counts[stratum].is_clipped(i)).map(move |i| (name.clone(), CHANNELS[i]))
    });
    let message = |(name, channel): (String, &str)| {
        format!("The {channel} channel is clipped in the {name}: it has no value there. Expose less.")
    };
    in_areas.chain(in_bands).map(|place| Warning::new(WarningCode::Clipped, message(place))).collect()
}

/// Channels in which no pixel is left, for another reason than that all are clipped.
fn unusable(noun: &str, measured: &Measured, regions: &Regions) -> Vec<Warning> {
    let places = [(0, "middle", &regions.inner), (1, "rim", &regions.outer)];
    let said = places.into_iter().filter(|(.., region)| region.is_some()).filter_map(|(stratum, place, _)| {
        let has_cells = |i: usize| measured.all[i].iter().any(|cell| cell.stratum == stratum);
        let empty = (0..3).filter(|&i| !has_cells(i) && !measured.counts[stratum].is_clipped(i));
        let channels: Vec<&str> = empty.map(|i| CHANNELS[i]).collect();
        (!channels.is_empty()).then(|| {
            format!(
                "No pixel in the {place} of the {noun} can be used ({}): nothing is measured there.",
                channels.join(", ")
            )
        })
    });
    said.map(|message| Warning::new(WarningCode::NonFinite, message)).collect()
}

/// Signal below this many times its scatter is no measurement.
const LEAST_SIGNAL_TO_NOISE: f64 = 5.0;

fn black(noun: &str, counts: &[Counts; 2], areas: &[(&str, AreaStatistics)]) -> Vec<Warning> {
    let is_dark = |s: &AreaStatistics| {
        let drowns = |i: usize| s.trimmed_mean[i] < LEAST_SIGNAL_TO_NOISE * s.standard_deviation[i];
        2 * s.black > s.pixels || (0..3).all(drowns)
    };
    let dark_band = counts.iter().any(|counts| 2 * counts.black > counts.pixels);
    let names = areas.iter().filter(|(_, s)| is_dark(s)).map(|(name, _)| *name);
    let body = (dark_band && areas.iter().all(|(_, s)| !is_dark(s))).then_some(noun);
    let message = |name: &str| format!("The {name} is too dark to measure: expose more.");
    names.chain(body).map(|name| Warning::new(WarningCode::Black, message(name))).collect()
}

fn two_colours(areas: &[(&str, AreaStatistics)]) -> Vec<Warning> {
    let has_two = |s: &AreaStatistics| {
        (0..3).any(|i| {
            let difference = (s.mean[i] - s.median[i]).abs();
            let is_skewed = difference > 2.0 * s.standard_error[i] && difference > 0.02 * s.mean[i].abs();
            // Noise alone gives 0.64, an even gradient 0.75.
            let is_split = s.bimodality[i] > 0.85 && s.standard_deviation[i] > 0.02 * s.mean[i].abs();
            is_skewed || is_split
        })
    };
    let message = |name: &str| format!("There are two colours in the {name}: mark a smaller, even part.");
    areas
        .iter()
        .filter(|(_, s)| has_two(s))
        .map(|(name, _)| Warning::new(WarningCode::Multimodal, message(name)))
        .collect()
}

/// Below this radius the angle of a pixel near the rim is not known well enough for h.
const SMALL_RADIUS_PX: f64 = 60.0;

fn small_ball(request: &MatchRequest) -> Option<Warning> {
    let body = request.body()?;
    let (noun, radius) = (body.noun(), body.radius());
    (radius < SMALL_RADIUS_PX).then(|| {
        let message = format!(
            "The {noun}'s radius is {radius:.0} pixels; below {SMALL_RADIUS_PX:.0} trust r only, h is of low confidence."
        );
        Warning::new(WarningCode::SmallBall, message)
    })
}

/// A change around the azimuth beyond this is uneven surroundings.
const AZIMUTH_CHANGE: f64 = 0.10;
/// Cells scatter more than this many times the noise: the surroundings have structure.
const RESIDUAL_OVER_NOISE: f64 = 3.0;
/// What the model itself leaves over on measured metals.
const MODEL_RESIDUAL: f64 = 0.01;

fn uneven(request: &MatchRequest, measured: &Measured, outcome: &Match) -> Option<Warning> {
    let body = request.body()?;
    let change = (0..3).map(|i| azimuth_change(&measured.all[i], &measured.curve, i)).fold(0.0, f64::max);
    let is_scattered = outcome.residual.into_iter().zip(outcome.noise).any(|both| {
        matches!(both, (Some(residual), Some(noise)) if residual > RESIDUAL_OVER_NOISE * noise.max(MODEL_RESIDUAL))
    });
    let seen = if change > AZIMUTH_CHANGE {
        format!("the reflection changes by {:.0} % around the {}", change * 100.0, body.noun())
    } else if is_scattered {
        "the reflection is patchy".to_owned()
    } else {
        return None;
    };
    let message = format!("The surroundings are uneven: {seen}. Use a light tent or a reference ball.");
    Some(Warning::new(WarningCode::Environment, message))
}

/// A rough metal, seen where it mirrors a lamp or the camera.
fn rough(view: &View, request: &MatchRequest) -> Option<Warning> {
    let body = request.body().filter(|body| body.radius() >= SMALL_RADIUS_PX && is_blurred(view, *body))?;
    let message = format!(
        "Nothing that the {} mirrors has a sharp edge: if the metal is rough, r and h are means over many angles.",
        body.noun()
    );
    Some(Warning::new(WarningCode::Rough, message))
}

/// The spread of the sectors from the tenth to the ninetieth percentile, over their mean.
///
/// A sector's value is the median over its rings of observed over fitted: where a ball stands its own
/// shadow darkens a sector or two, which the fit leaves out.
fn azimuth_change(cells: &[Cell], curve: &MetalCurve, channel: usize) -> f64 {
    let spread = |stratum: usize| {
        let mut sectors = sector_medians(cells, curve, channel, stratum);
        sectors.sort_by(f64::total_cmp);
        let tenth = sectors.len() / 10;
        match (sectors.get(tenth), sectors.iter().rev().nth(tenth)) {
            (Some(low), Some(high)) => (high - low) * sectors.len() as f64 / sectors.iter().sum::<f64>(),
            _ => 0.0,
        }
    };
    spread(0).max(spread(1))
}

fn sector_medians(cells: &[Cell], curve: &MetalCurve, channel: usize, stratum: usize) -> Vec<f64> {
    let ratio = |cell: &Cell| cell.reflectance / curve.at(cell.weights, cell.cosine)[channel];
    let in_sector = |sector: usize| cells.iter().filter(move |cell| cell.stratum == stratum && cell.block == sector);
    let ratios = (0..SECTORS).map(|sector| in_sector(sector).map(ratio).collect::<Vec<_>>());
    ratios.filter(|ratios| !ratios.is_empty()).map(|mut ratios| median(&mut ratios)).collect()
}

/// A fall of less than this towards the rim needs no explanation.
const STEEPEST_FALL: f64 = 0.10;
/// Zinc falls from .74 to .53 by itself: darker than any conductor of its r by this is another light.
const BELOW_ANY_CONDUCTOR: f64 = 0.05;

fn mirrored_backdrop(request: &MatchRequest, measured: &Measured) -> Option<Warning> {
    mirrors_backdrop(request, measured).then(|| {
        let message = "The reflection falls towards the rim: it mirrors the backdrop, so h cannot be measured. Use a \
                       bright backdrop.";
        Warning::new(WarningCode::Environment, message)
    })
}

/// True when the band of a ball's rim shows the backdrop instead of the light.
pub(super) fn mirrors_backdrop(request: &MatchRequest, measured: &Measured) -> bool {
    request.body().is_some() && request.edge.is_none() && falls_at_rim(measured)
}

/// True when, in at least two channels, the outermost rings are darker than the inner rings of the outer
/// band, and darker than any n + i k of that r is there.
fn falls_at_rim(measured: &Measured) -> bool {
    let falls = |i: usize| {
        let of_rings = |rings: std::ops::Range<usize>, value: fn(&Cell) -> f64| {
            let cells = measured.all[i].iter().filter(|cell| cell.stratum == 1 && rings.contains(&cell.ring));
            median(&mut cells.map(value).collect::<Vec<_>>())
        };
        let (rim, cosine) = (of_rings(6..8, |cell| cell.reflectance), of_rings(6..8, |cell| cell.cosine));
        let is_darker = rim < (1.0 - STEEPEST_FALL) * of_rings(0..3, |cell| cell.reflectance);
        let facing = of_facing(&measured.all[i]);
        is_darker && rim < darkest_conductor(facing, cosine) - BELOW_ANY_CONDUCTOR
    };
    (0..3).filter(|&i| falls(i)).count() >= 2
}

/// The median over the middle of the ball: r, whatever the rim shows.
fn of_facing(cells: &[Cell]) -> f64 {
    median(&mut cells.iter().filter(|cell| cell.stratum == 0).map(|cell| cell.reflectance).collect::<Vec<_>>())
}

/// The smallest F that real n and k of this r reach at an angle.
fn darkest_conductor(r: f64, cosine: f64) -> f64 {
    const STEPS: u32 = 16;
    let at = |step: u32| gulbrandsen(r.clamp(0.0, 0.999), f64::from(step) / f64::from(STEPS), CosTheta::new(cosine));
    (0..=STEPS).map(at).fold(f64::INFINITY, f64::min)
}

/// ACEScg contains the colours of real metals; linear Rec.709 does not, so feasibility is judged there.
fn infeasible(outcome: &Match) -> Vec<Warning> {
    let (Some(r), Some(h)) = (outcome.complete_r(), outcome.complete_h()) else { return Vec::new() };
    let [r, h] = [r, h].map(|rgb| outcome.space.convert(rgb, RgbSpace::AcesCg));
    let largest = |u: [Option<f64>; 3]| u.into_iter().flatten().fold(0.0, f64::max);
    let (u_r, u_h) = (largest(outcome.r_uncertainty), largest(outcome.h_uncertainty));
    let unreachable = (0..3).find(|&i| is_unreachable(r[i], h[i], u_r, u_h));
    let impossible = (0..3).find(|&i| {
        let range = reflectance_range(r[i], h[i]);
        *range.start() < -u_h || *range.end() > 1.0 + u_r.max(u_h)
    });
    let unreachable = unreachable.map(|i| {
        let (channel, r, h) = (CHANNELS[i], r[i], h[i]);
        format!("No real metal has h {h:.2} at r {r:.2} ({channel}, ACEScg): check the light and the outline.")
    });
    let impossible = impossible.map(|i| {
        let channel = CHANNELS[i];
        format!("The curve leaves 0 to 1 in the {channel} channel (ACEScg): no surface reflects like that.")
    });
    unreachable.into_iter().chain(impossible).map(|message| Warning::new(WarningCode::Infeasible, message)).collect()
}

/// True when h ± u lies outside what real n and k reach for any r ± u; u is expanded.
fn is_unreachable(r: f64, h: f64, u_r: f64, u_h: f64) -> bool {
    let bands = [r - u_r, r, r + u_r].map(|r| reachable_h(r.clamp(0.0, 0.999)));
    let lowest = bands.iter().flatten().map(|band| *band.start()).fold(f64::INFINITY, f64::min);
    let highest = bands.iter().flatten().map(|band| *band.end()).fold(0.0, f64::max);
    h < lowest - u_h || h > highest + u_h
}

fn gamut(outcome: &Match) -> Option<Warning> {
    let outside = |rgb: Option<Rgb>| rgb.is_some_and(|rgb| !rgb.is_in_unit_cube());
    let names: Vec<&str> = [("r", outcome.complete_r()), ("h", outcome.complete_h())]
        .into_iter()
        .filter_map(|(name, rgb)| outside(rgb).then_some(name))
        .collect();
    (!names.is_empty()).then(|| {
        let (lie, are, them) = if names.len() > 1 { ("lie", "are", "them") } else { ("lies", "is", "it") };
        let (names, space) = (names.join(" and "), outcome.space.label());
        let message = format!(
            "{names} {lie} outside 0 to 1 in {space} and {are} kept as measured. A wider space holds {them}, or map \
             {them} into the gamut."
        );
        Warning::new(WarningCode::Gamut, message)
    })
}

/// A grey scale says nothing of what is brighter than its brightest patch.
fn beyond_greys(view: &View, light: &Light, measured: &Measured) -> Option<Warning> {
    let is_beyond = |i: usize| {
        let (fit, level) = (&measured.curve.fits[i], light.value[i].unwrap_or(1.0));
        [fit.r, fit.h].into_iter().flatten().any(|value| view.is_beyond_greys(value * level))
    };
    let channels: Vec<&str> = (0..3).filter(|&i| is_beyond(i)).map(|i| CHANNELS[i]).collect();
    (!channels.is_empty()).then(|| {
        let message = format!(
            "The metal is brighter than the brightest grey patch ({}): there the tone curve is extended, which widens ±.",
            channels.join(", ")
        );
        Warning::new(WarningCode::Assumed, message)
    })
}

fn estimate(photo: &Photo, request: &MatchRequest, outcome: &Match) -> Option<Warning> {
    outcome.is_estimate.then(|| {
        let message = match request.mode {
            LightMode::ByEye => "The light was set by eye: this is an estimate, not a measurement.".to_owned(),
            _ => format!(
                "The tone curve of {} is assumed: this is an estimate. Mark neutral patches, or use a linear file.",
                photo.name
            ),
        };
        Warning::new(WarningCode::Estimate, message)
    })
}
