//! What the demonstrations show, computed off the window's thread and encoded for the screen.

use std::ops::ControlFlow;
use std::sync::Arc;

use eframe::egui::ColorImage;

use super::band::Band;
use super::exhibit::{OfConversion, OfDecoupling, OfPair, points_in, sweeps_at};
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fit::Method;
use crate::fresnel::CosTheta;
use crate::metal::{Metal, preferred_metals};
use crate::study::{
    Blend, BlendPair, BoundaryRow, ColourConversion, Contestants, ConversionOptions, ConversionSummary, Decoupling,
    DecouplingRow, MetalPoint, Painted, Parameters, Quantisation, SliderSweep, Swept, blend_matrix,
    blend_pairs_summary, blending, colour_at, conversions, conversions_summary, feasibility_boundary,
    feasibility_summary, painted_sphere, uniformity_summary,
};

/// What came of a study, or the sentence that says why not.
pub(crate) type Told<T> = Result<T, String>;

/// How a job says how far it is.
type Report<'a> = &'a (dyn Fn(f32) -> ControlFlow<()> + Sync);

/// One material, converted.
pub(crate) struct ShownConversion {
    /// The numbers.
    pub study: ColourConversion,
    /// The truth over the angles.
    pub truth: Band,
    /// For each description, what should be seen and what is.
    pub pairs: Vec<[Band; 2]>,
}

impl ShownConversion {
    pub(crate) fn of(of: &OfConversion) -> Told<Self> {
        let study = of.study().map_err(|error| error.to_string())?;
        let band = |colours: &[Rgb]| Band::of(colours.iter().copied(), study.options.to);
        let pairs = study.results.iter().map(|result| [band(&result.appearance), band(&result.curve)]).collect();
        Ok(Self { truth: band(&study.truth), pairs, study })
    }
}

/// All metals, converted.
pub(crate) struct ShownConversions {
    /// What is seen.
    pub sentence: String,
    /// One row for each metal and description.
    pub rows: Vec<ConversionSummary>,
}

impl ShownConversions {
    pub(crate) fn of(options: &ConversionOptions, report: Report) -> Told<Self> {
        let metals: Vec<&Metal> = preferred_metals().collect();
        let rows = conversions(&metals, options, report).map_err(|error| error.to_string())?;
        Ok(Self { sentence: conversions_summary(&rows, options), rows })
    }
}

/// Colours along a slider between two materials.
const BLEND_COLUMNS: usize = 241;

/// Two materials, blended.
pub(crate) struct ShownBlend {
    /// The numbers.
    pub study: Blend,
    /// What could not be expressed, as sentences.
    pub losses: Vec<String>,
    /// The blended truth along the slider, facing the surface.
    pub truth: Band,
    /// For each description, blended reflectance and the reflectance of blended parameters.
    pub pairs: Vec<[Band; 2]>,
    materials: [Arc<Contestants>; 2],
}

impl ShownBlend {
    pub(crate) fn of(of: &OfPair) -> Told<Self> {
        let described = |described: &super::Described| described.contestants().map_err(|error| error.to_string());
        let (a, b) = (described(&of.a)?, described(&of.b)?);
        let study = blending(&a, &b);
        let shares = || (0..BLEND_COLUMNS).map(|column| column as f64 / (BLEND_COLUMNS - 1) as f64);
        let band = |painted, angle| Band::of(shares().map(|share| colour_at(&a, &b, painted, share, angle)), a.space);
        let pair = |parameters| {
            let angle = worst_angle(&study, parameters);
            let ends = [&a, &b].map(|material| material.pair(parameters).reflectance(angle));
            let wanted = Band::of(shares().map(|share| ends[0].lerp(ends[1], share)), a.space);
            [wanted, band(Painted::Blended(parameters), angle)]
        };
        Ok(Self {
            losses: [a.losses.clone(), b.losses.clone()].concat(),
            truth: band(Painted::Truth, CosTheta::FACING),
            pairs: Parameters::ALL.map(pair).into(),
            study,
            materials: [a, b],
        })
    }

    /// For each description, how far it is off at one place of the slider and the angle of its strip.
    pub(crate) fn delta_e_at(&self, share: f64) -> [f64; 4] {
        let [a, b] = &self.materials;
        Parameters::ALL.map(|parameters| {
            let angle = worst_angle(&self.study, parameters);
            let ends = [a, b].map(|material| material.pair(parameters).reflectance(angle));
            let blended = colour_at(a, b, Painted::Blended(parameters), share, angle);
            delta_e_rgb(blended, ends[0].lerp(ends[1], share), a.space)
        })
    }
}

/// Where a description is off most; θ_max where it is exact, since the edge is what is authored.
fn worst_angle(study: &Blend, parameters: Parameters) -> CosTheta {
    const EXACT: f64 = 1e-6;
    let worst = study.results[parameters as usize].worst;
    if worst.delta_e < EXACT { CosTheta::MAX } else { CosTheta::from_deg(worst.theta_deg) }
}

/// Spheres painted with a soft spot: the truth, then each description.
pub(crate) fn painted_spheres(of: &OfPair, size: u32) -> Told<Vec<ColorImage>> {
    let described = |described: &super::Described| described.contestants().map_err(|error| error.to_string());
    let (a, b) = (described(&of.a)?, described(&of.b)?);
    let shown = std::iter::once(Painted::Truth).chain(Parameters::ALL.map(Painted::Blended));
    let image = |painted| {
        let picture = painted_sphere(&a, &b, painted, size).to_srgb8();
        ColorImage::from_rgba_unmultiplied([size as usize; 2], &picture.rgba)
    };
    Ok(shown.map(image).collect())
}

/// Every pair of metals, half and half.
pub(crate) struct ShownBlends {
    /// What is seen.
    pub sentence: String,
    /// The metals in the order of rows and columns.
    pub metals: Vec<&'static Metal>,
    /// For each description, the largest ΔE of each pair; NaN of a metal with itself.
    pub values: [Vec<f64>; 4],
}

impl ShownBlends {
    pub(crate) fn of(space: RgbSpace, method: Method, report: Report) -> Told<Self> {
        let metals: Vec<&'static Metal> = preferred_metals().collect();
        let rows = blend_matrix(&metals, space, method, report).map_err(|error| error.to_string())?;
        let values = Parameters::ALL.map(|parameters| square(&rows, parameters, metals.len()));
        Ok(Self { sentence: blend_pairs_summary(&rows), metals, values })
    }

    /// The largest ΔE of a pair in a description.
    pub(crate) fn value(&self, parameters: Parameters, row: usize, column: usize) -> f64 {
        self.values[parameters as usize][row * self.metals.len() + column]
    }
}

fn square(rows: &[BlendPair], parameters: Parameters, side: usize) -> Vec<f64> {
    let mut values = vec![f64::NAN; side * side];
    for row in rows.iter().filter(|row| row.parameters == parameters) {
        values[row.index_of_a * side + row.index_of_b] = row.max_delta_e;
        values[row.index_of_b * side + row.index_of_a] = row.max_delta_e;
    }
    values
}

/// A material's parameters, stored.
pub(crate) struct ShownQuantisation {
    /// The numbers.
    pub study: Quantisation,
    /// The gradient of each of its results.
    pub gradients: Vec<Band>,
    /// What could not be expressed, as sentences.
    pub losses: Vec<String>,
}

impl ShownQuantisation {
    pub(crate) fn of(of: &OfPair) -> Told<Self> {
        let study = of.quantisation().map_err(|error| error.to_string())?;
        let band = |result: &crate::study::Quantised| Band::of(result.gradient.iter().copied(), study.space);
        let losses = |described: &super::Described| described.contestants().map(|c| c.losses.clone());
        let losses = [losses(&of.a), losses(&of.b)].into_iter().flatten().flatten().collect();
        Ok(Self { gradients: study.results.iter().map(band).collect(), study, losses })
    }
}

/// Facing and edge colours along one sweep.
pub(crate) type SweepBands = [Band; 2];

/// A material's parameters, moved.
pub(crate) struct ShownDecoupling {
    /// The numbers.
    pub study: Decoupling,
    /// For each description, r swept and the edge parameter swept; the material itself first.
    pub sweeps: Vec<[SweepBands; 2]>,
    /// For each description, the colour of a grey edge parameter.
    pub greys: Band,
    /// What could not be expressed or had to be limited, as sentences.
    pub notes: Vec<String>,
}

impl ShownDecoupling {
    pub(crate) fn of(of: &OfDecoupling) -> Told<Self> {
        let study = of.study().map_err(|error| error.to_string())?;
        let bands = |parameters, swept| {
            let rows = study.sweep(parameters, swept).map_or(&[][..], |sweep| &sweep.rows);
            let band = |of: fn(&DecouplingRow) -> Rgb| Band::of(rows.iter().rev().map(of), study.space);
            [band(DecouplingRow::facing), band(DecouplingRow::edge)]
        };
        let sweeps = Parameters::ALL.map(|p| [bands(p, Swept::First), bands(p, Swept::Edge)]).into();
        let losses = of.described.contestants().map(|contestants| contestants.losses.clone()).unwrap_or_default();
        Ok(Self {
            sweeps,
            greys: Band::of(study.cross_talk.iter().map(|row| row.edge()), study.space),
            notes: [losses, study.warnings()].concat(),
            study,
        })
    }
}

/// Sliders at one r.
pub(crate) struct ShownUniformity {
    /// What is seen.
    pub sentence: String,
    /// One for each slider and range, with the colours of its positions.
    pub sweeps: Vec<(SliderSweep, Band)>,
}

impl ShownUniformity {
    pub(crate) fn of(r: f64) -> Self {
        let sweeps = sweeps_at(r);
        let sentence = uniformity_summary(&sweeps, r);
        let with_colours = |sweep: SliderSweep| {
            let band = Band::of(sweep.edges.iter().map(|&edge| Rgb::splat(edge)), RgbSpace::LinRec709);
            (sweep, band)
        };
        Self { sentence, sweeps: sweeps.into_iter().map(with_colours).collect() }
    }
}

/// The square of r and h without the preset.
pub(crate) struct ShownSquare {
    /// What is seen.
    pub sentence: String,
    /// The space of the points.
    pub space: RgbSpace,
    /// Both regions.
    pub boundary: Vec<BoundaryRow>,
    /// The measured metals.
    pub points: Vec<MetalPoint>,
}

impl ShownSquare {
    pub(crate) fn of(space: RgbSpace) -> Self {
        let points = points_in(space);
        let boundary = feasibility_boundary(super::exhibit::BOUNDARY_STEPS);
        Self { sentence: feasibility_summary(&points), space, boundary, points }
    }
}
