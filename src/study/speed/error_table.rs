//! ΔE of ten models of many metals at 0°, 1°, …, 90°: what is computed again whenever a slider moves.

use std::ops::ControlFlow;

use serde::Serialize;

use super::curve::{InVectors, curve};
use crate::color::{Lab, RgbSpace, delta_e_2000};
use crate::fit::{Method, Triple};
use crate::fresnel::{CosTheta, ModelKind, whole_degrees};
use crate::kernel::{LabConversion, Level, delta_e_over};
use crate::metal::Metal;
use crate::number::{larger, largest};
use crate::spectrum::SAMPLES;
use crate::study::{Form, StudyError, Subject, Variant, forms};

/// The models of every metal.
const MODELS: [Variant; 10] = [
    Variant::SCHLICK,
    Variant::HOFFMAN,
    Variant::Model(ModelKind::Hoffman, Method::LeastSquares),
    Variant::Model(ModelKind::F82Tint, Method::Exact),
    Variant::Model(ModelKind::Lazanyi, Method::LeastSquares),
    Variant::Model(ModelKind::GeneralizedSchlick, Method::LeastSquares),
    Variant::Polynomial(10),
    Variant::Model(ModelKind::Gulbrandsen, Method::LeastSquares),
    Variant::Model(ModelKind::Conductor, Method::Points(Triple::ROUND)),
    Variant::Model(ModelKind::Conductor, Method::ColourMatching),
];

/// The angles, and so many more as whole vectors of any instruction set need.
const ANGLES: usize = 91;
const PADDED: usize = 96;

/// What a table is computed from, for other programs too. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorTableInput {
    /// The space of everything.
    pub space: RgbSpace,
    /// Rows of the matrix from linear RGB to XYZ.
    pub xyz_from_rgb: [[f64; 3]; 3],
    /// XYZ of the space's white.
    pub white_xyz: [f64; 3],
    /// One for each metal.
    pub metals: Vec<ErrorTableMetal>,
}

/// One metal of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorTableMetal {
    /// Its identifier.
    pub metal: String,
    /// Its truth: n, k and RGB weights at some wavelengths.
    pub truth: Form,
    /// What is held against it.
    pub models: Vec<ErrorTableModel>,
}

/// One model of one metal of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorTableModel {
    /// The variant.
    pub variant: Variant,
    /// Its parameters.
    pub form: Form,
    /// The mean of ΔE over the angles, in 64 bits.
    pub mean_delta_e: f64,
    /// The largest.
    pub max_delta_e: f64,
}

impl ErrorTableInput {
    fn new(
        metals: &[&Metal],
        wavelengths: usize,
        space: RgbSpace,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self, StudyError> {
        let metals: Result<Vec<ErrorTableMetal>, StudyError> =
            metals.iter().map(|metal| of_metal(metal, wavelengths, space, keep_going)).collect();
        let matrix = space.xyz_from_rgb();
        Ok(Self {
            space,
            xyz_from_rgb: std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)])),
            white_xyz: space.white().xyz().0,
            metals: metals?,
        })
    }

    /// Every ΔE in 64 bits: metal by metal, model by model, angle by angle.
    pub fn delta_e(&self) -> Vec<f64> {
        let of_metal = |metal: &ErrorTableMetal| {
            let truth = labs(&metal.truth, self.space);
            let of = |model: &ErrorTableModel| differences(&model.form, &truth, self.space);
            metal.models.iter().flat_map(of).collect::<Vec<f64>>()
        };
        self.metals.iter().flat_map(of_metal).collect()
    }
}

fn of_metal(
    metal: &Metal,
    wavelengths: usize,
    space: RgbSpace,
    keep_going: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<ErrorTableMetal, StudyError> {
    let truth = if wavelengths == SAMPLES { Variant::Exact } else { Variant::Spectral(wavelengths) };
    let mut forms = forms(&Subject::Metal(metal), &[&[truth][..], &MODELS].concat(), space, keep_going)?.into_iter();
    let truth = forms.next().expect("one form for each variant").form;
    let true_labs = labs(&truth, space);
    let models = forms.map(|of| {
        let delta_e = differences(&of.form, &true_labs, space);
        ErrorTableModel {
            variant: of.variant,
            mean_delta_e: delta_e.iter().sum::<f64>() / delta_e.len() as f64,
            max_delta_e: largest(delta_e),
            form: of.form,
        }
    });
    Ok(ErrorTableMetal { metal: metal.id.clone(), models: models.collect(), truth })
}

fn labs(form: &Form, space: RgbSpace) -> Vec<Lab> {
    whole_degrees().map(|c| Lab::from_rgb(form.reflectance(c), space)).collect()
}

fn differences(form: &Form, truth: &[Lab], space: RgbSpace) -> Vec<f64> {
    labs(form, space).into_iter().zip(truth).map(|(shown, truth)| delta_e_2000(shown, *truth)).collect()
}

/// The same in kernels.
pub struct ErrorTable {
    input: ErrorTableInput,
    /// The truth and the models of each metal.
    curves: Vec<(InVectors, Vec<InVectors>)>,
    lab: LabConversion,
    cosines: [f32; PADDED],
}

impl std::fmt::Debug for ErrorTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ErrorTable").field("input", &self.input).finish_non_exhaustive()
    }
}

/// What is measured: every ΔE, and its mean and maximum over the angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    delta_e: Vec<f32>,
    mean: Vec<f32>,
    max: Vec<f32>,
}

impl ErrorTable {
    /// Fits the models and prepares the kernels; the truth is a sum over so many wavelengths with spline weights, or over
    /// every nanometre.
    pub fn new(
        metals: &[&Metal],
        wavelengths: usize,
        space: RgbSpace,
        keep_going: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self, StudyError> {
        let input = ErrorTableInput::new(metals, wavelengths, space, keep_going)?;
        let kernel =
            |form: &Form| curve(form).expect("each of these variants has a kernel, as a test holds").in_vectors;
        let curves = input
            .metals
            .iter()
            .map(|metal| (kernel(&metal.truth), metal.models.iter().map(|model| kernel(&model.form)).collect()));
        let mut cosines = [0.0; PADDED];
        for (cosine, angle) in cosines.iter_mut().zip(whole_degrees()) {
            *cosine = CosTheta::get(angle) as f32;
        }
        Ok(Self { curves: curves.collect(), lab: LabConversion::new(space), cosines, input })
    }

    /// What it is computed from.
    pub fn input(&self) -> &ErrorTableInput {
        &self.input
    }

    /// Room for the results.
    pub fn nothing_yet(&self) -> Errors {
        let cells = self.curves.len() * MODELS.len();
        Errors { delta_e: vec![0.0; cells * PADDED], mean: vec![0.0; cells], max: vec![0.0; cells] }
    }

    /// Computes everything from the parameters.
    pub fn measure(&self, level: Level, out: &mut Errors) {
        let metals = self.curves.iter().zip(out.delta_e.chunks_exact_mut(MODELS.len() * PADDED));
        for ((truth, models), cells) in metals {
            let truth = self.labs(level, truth);
            for (model, cell) in models.iter().zip(cells.chunks_exact_mut(PADDED)) {
                let shown = self.labs(level, model);
                delta_e_over(
                    level,
                    shown.each_ref().map(|plane| &plane[..]),
                    truth.each_ref().map(|plane| &plane[..]),
                    cell,
                );
            }
        }
        let cells = out.delta_e.chunks_exact(PADDED).zip(out.mean.iter_mut().zip(&mut out.max));
        for (cell, (mean, max)) in cells {
            *mean = cell[..ANGLES].iter().sum::<f32>() / ANGLES as f32;
            *max = cell[..ANGLES].iter().copied().fold(0.0, f32::max);
        }
    }

    fn labs(&self, level: Level, curve: &InVectors) -> [[f32; PADDED]; 3] {
        let (mut rgb, mut lab) = ([[0.0; PADDED]; 3], [[0.0; PADDED]; 3]);
        curve(level, &self.cosines, rgb.each_mut().map(|plane| &mut plane[..]));
        self.lab.over(level, rgb.each_ref().map(|plane| &plane[..]), lab.each_mut().map(|plane| &mut plane[..]));
        lab
    }

    /// How far a ΔE in 32 bits is from the same in 64, at most.
    pub fn largest_difference(&self, level: Level) -> f64 {
        let mut out = self.nothing_yet();
        self.measure(level, &mut out);
        let cells = out.delta_e.chunks_exact(PADDED).flat_map(|cell| &cell[..ANGLES]);
        let pairs = cells.zip(self.input.delta_e());
        pairs.fold(0.0, |worst, (single, double)| larger(worst, (f64::from(*single) - double).abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    fn table() -> ErrorTable {
        let metals = ["gold", "zinc", "chromium"].map(|name| metal_by_name(name).unwrap());
        ErrorTable::new(&metals, 31, RgbSpace::LinRec709, &mut || ControlFlow::Continue(())).unwrap()
    }

    #[test]
    fn every_cell_is_the_core() {
        let table = table();
        assert_eq!(table.input().delta_e().len(), 3 * MODELS.len() * ANGLES);
        for level in crate::kernel::levels() {
            let off = table.largest_difference(level);
            assert!(off < 3e-4, "{off}");
        }
    }

    #[test]
    fn means_and_maxima_are_those_of_the_cells() {
        let table = table();
        let mut out = table.nothing_yet();
        table.measure(Level::new(), &mut out);
        let models = table.input().metals.iter().flat_map(|metal| &metal.models);
        for ((model, mean), max) in models.zip(&out.mean).zip(&out.max) {
            assert!((f64::from(*mean) - model.mean_delta_e).abs() < 3e-4, "{}", model.variant);
            assert!((f64::from(*max) - model.max_delta_e).abs() < 3e-4, "{}", model.variant);
        }
    }
}
