//! Every kernel, ours and textbook, with the parameters of one metal and slices to work on.

use palette::color_difference::Ciede2000;
use palette::white_point::D65;

use super::SpeedOptions;
use crate::color::{Lab, Rgb, RgbSpace, delta_e_2000};
use crate::fit::polynomial_by_least_squares;
use crate::fresnel::{a_from_r_h, r_g_from_nk, t_from_r_h};
use crate::kernel::textbook::{
    ComplexConductor, DielectricAsPrinted, DividerBound, F82AsPrinted, GulbrandsenAsPrinted, HoffmanAsPrinted,
    PopularConductor, SchlickByPower,
};
use crate::kernel::{
    Basis, Conductor, ConductorAndAbsorption, ConductorOfPixels, Dielectric, Exported, F82OfPixels, Factored, Form,
    GeneralizedSchlick, GulbrandsenOfPixels, LabConversion, Lazanyi, Level, Material, Operations, Planes, Polynomial,
    Schlick, SchlickOfPixels, Spectral, Table, delta_e_over, operations_of_delta_e, over_pixels,
};
use crate::metal::{Metal, TruthCurve};
use crate::spectrum::{FewWavelengths, Quadrature, rgb_weights};

/// One contestant: what it is, and a pass over all its values.
pub(super) struct Timed {
    pub(super) id: &'static str,
    pub(super) name: &'static str,
    pub(super) kind: &'static str,
    pub(super) over: &'static str,
    pub(super) bytes: usize,
    pub(super) operations: Operations,
    pub(super) run: Box<dyn FnMut()>,
}

/// The space of the parameters; the time does not depend on it.
const SPACE: RgbSpace = RgbSpace::LinRec709;

const OURS: &str = "ours";
const TEXTBOOK: &str = "textbook";

/// All of them, the cheapest models first.
pub(super) fn kernels(options: &SpeedOptions) -> Vec<Timed> {
    let bench = Bench { level: options.level, cosines: even(options.size) };
    let subject = Subject::of(options.metal);
    let mut all = bench.of_materials(&subject);
    all.extend(bench.of_spectra(options.metal, &subject.truth));
    all.extend(bench.of_pixels(&subject));
    all.extend(bench.of_colours());
    all
}

/// The parameters of a metal in every model.
struct Subject {
    truth: TruthCurve,
    r: Rgb,
    h: Rgb,
    t: Rgb,
    g: Rgb,
    n: Rgb,
    k: Rgb,
}

impl Subject {
    /// n and k in the middle of each primary's band: any will do.
    fn of(metal: &Metal) -> Self {
        let truth = TruthCurve::of(metal, SPACE);
        let nk = [610.0, 550.0, 450.0].map(|nm| metal.table().at(nm));
        let (r, h) = (truth.r(), truth.h);
        Self {
            t: r.zip(h, t_from_r_h),
            g: Rgb(nk.map(|nk| r_g_from_nk(nk).1)),
            n: Rgb(nk.map(|nk| nk.n)),
            k: Rgb(nk.map(|nk| nk.k)),
            truth,
            r,
            h,
        }
    }
}

/// Where kernels are run.
struct Bench {
    level: Level,
    cosines: Vec<f32>,
}

/// Cosines of all sizes in no order that a branch could learn.
fn even(count: usize) -> Vec<f32> {
    (0..count).map(|i| ((i * 7919) % count) as f32 / count as f32).collect()
}

/// Parameters of each pixel: around those of the metal, so that they cannot be taken for constants.
fn around(rgb: Rgb, count: usize) -> [Vec<f32>; 3] {
    rgb.0.map(|value| (0..count).map(|i| (value * (1.0 - 0.01 * (i % 7) as f64)) as f32).collect())
}

fn borrowed(planes: &[Vec<f32>; 3]) -> [&[f32]; 3] {
    planes.each_ref().map(Vec::as_slice)
}

fn borrowed_mut(planes: &mut [Vec<f32>; 3]) -> [&mut [f32]; 3] {
    planes.each_mut().map(Vec::as_mut_slice)
}

impl Bench {
    fn of_materials(&self, subject: &Subject) -> Vec<Timed> {
        let Subject { r, h, t, g, n, k, .. } = *subject;
        let a = r.zip(h, a_from_r_h);
        vec![
            self.material(OURS, "schlick", "Schlick", Schlick::material(r)),
            self.material(OURS, "hoffman", "Hoffman (r, h), a computed once", Factored::hoffman(r, h)),
            self.material(OURS, "hoffman-basis", "Hoffman (r, h) as A r + B h + C", Basis::material(r, h)),
            self.material(OURS, "f82-tint", "F82-tint (r, t), a computed once", Factored::f82_tint(r, t)),
            self.material(OURS, "lazanyi", "Lazányi (r, a, α)", Lazanyi::material(r, a, 6.3)),
            self.material(
                OURS,
                "generalized-schlick",
                "Generalized Schlick, p = 5",
                GeneralizedSchlick::material(r, t, Rgb::WHITE, 5.0),
            ),
            self.material(OURS, "conductor", "Conductor (n, k)", Conductor::material(n, k)),
            self.material(
                OURS,
                "conductor-and-absorption",
                "Conductor (n, k), F and 1 − F",
                ConductorAndAbsorption::material(n, k),
            ),
            self.material(
                OURS,
                "gulbrandsen",
                "Gulbrandsen (r, g), n and k computed once",
                Conductor::gulbrandsen(r, g),
            ),
            self.material(OURS, "dielectric", "Dielectric (n)", Dielectric::material(n)),
            self.material(
                TEXTBOOK,
                "conductor-popular",
                "Conductor, popular: 2 roots, 2 divisions",
                PopularConductor::material(n, k),
            ),
            self.material(
                TEXTBOOK,
                "conductor-complex",
                "Conductor, complex arithmetic as in pbrt",
                ComplexConductor::material(n, k),
            ),
            self.material(
                "bound",
                "two-roots-one-division",
                "2 square roots and 1 division per channel",
                DividerBound::material(n, k),
            ),
        ]
    }

    fn of_spectra(&self, metal: &'static Metal, truth: &TruthCurve) -> Vec<Timed> {
        let few = |count| {
            let few = FewWavelengths::new(count, Quadrature::Spline, SPACE);
            let nk = few.wavelengths_nm.iter().map(|nm| metal.table().at(*nm));
            Spectral::new(nk.zip(few.weights.iter().copied()))
        };
        let baked = Polynomial::material(truth.r(), polynomial_by_least_squares(truth));
        let whole = Spectral::new(metal.nk().iter().copied().zip(rgb_weights(SPACE).iter().copied()));
        vec![
            self.material(OURS, "polynomial", "Polynomial, 10 coefficients per channel", baked),
            self.table("table-256", "Table of 256 values", Table::new(256, |c| metal.reflectance(c, SPACE))),
            self.spectral("spectral-8", "8 wavelengths", few(8)),
            self.spectral("spectral-20", "20 wavelengths", few(20)),
            self.spectral("spectral-31", "31 wavelengths", few(31)),
            self.spectral("spectral-81", "81 wavelengths", few(81)),
            self.spectral("spectral-401", "401 wavelengths, the truth", whole),
        ]
    }

    fn of_pixels(&self, subject: &Subject) -> Vec<Timed> {
        let Subject { r, h, t, g, n, k, .. } = *subject;
        vec![
            self.pixels(OURS, "schlick-pixels", "Schlick, r per pixel", SchlickOfPixels, [r]),
            self.pixels(OURS, "hoffman-pixels", "Hoffman, r and h per pixel", Basis, [r, h]),
            self.pixels(OURS, "hoffman-exported", "Hoffman as exported to shaders", Exported, [r, h]),
            self.pixels(OURS, "f82-tint-pixels", "F82-tint, r and t per pixel", F82OfPixels, [r, t]),
            self.pixels(OURS, "conductor-pixels", "Conductor, n and k per pixel", ConductorOfPixels, [n, k]),
            self.pixels(OURS, "gulbrandsen-pixels", "Gulbrandsen, r and g per pixel", GulbrandsenOfPixels, [r, g]),
            self.pixels(TEXTBOOK, "schlick-power", "Schlick with pow, per pixel", SchlickByPower, [r]),
            self.pixels(TEXTBOOK, "hoffman-printed", "Hoffman as printed, per pixel", HoffmanAsPrinted, [r, h]),
            self.pixels(TEXTBOOK, "f82-tint-printed", "F82-tint as printed, per pixel", F82AsPrinted, [r, t]),
            self.pixels(
                TEXTBOOK,
                "gulbrandsen-printed",
                "Gulbrandsen as printed, per pixel",
                GulbrandsenAsPrinted,
                [r, g],
            ),
            self.pixels(TEXTBOOK, "dielectric-printed", "Dielectric as printed, per pixel", DielectricAsPrinted, [n]),
        ]
    }

    /// Differences of colours as near to each other as a model and a metal.
    fn of_colours(&self) -> Vec<Timed> {
        let (level, count) = (self.level, self.cosines.len());
        let conversion = LabConversion::new(SPACE);
        let rgb = [0.9, 0.7, 0.4].map(|r| self.cosines.iter().map(|c| r as f32 * (1.0 - c) + c).collect::<Vec<f32>>());
        let mut lab = [(); 3].map(|()| vec![0.0_f32; count]);
        conversion.over(level, borrowed(&rgb), borrowed_mut(&mut lab));
        let near: [Vec<f32>; 3] = lab.each_ref().map(|plane| plane.iter().map(|x| x * 0.98 + 0.3).collect());
        let pairs: Vec<(Lab, Lab)> = (0..count).map(|i| (lab_at(&lab, i), lab_at(&near, i))).collect();
        let conversions = conversion.operations();
        let mut differences = vec![0.0_f32; count];
        let run = {
            let (lab, near) = (lab.clone(), near.clone());
            move || delta_e_over(level, borrowed(&lab), borrowed(&near), &mut differences)
        };
        let ours = timed(OURS, "delta-e", "CIEDE2000 in 32 bits", "pairs", (0, operations_of_delta_e()), run);
        let core = {
            let (pairs, mut out) = (pairs.clone(), vec![0.0; count]);
            move || pairs.iter().zip(&mut out).for_each(|((x, y), out)| *out = delta_e_2000(*x, *y))
        };
        let core = timed(
            TEXTBOOK,
            "delta-e-64-bits",
            "CIEDE2000 as printed, 64 bits",
            "pairs",
            (0, operations_of_delta_e()),
            core,
        );
        let palette = palette_pairs(&pairs);
        let mut out = vec![0.0_f32; count];
        let theirs = move || palette.iter().zip(&mut out).for_each(|((x, y), out)| *out = x.difference(*y));
        let theirs = timed(
            TEXTBOOK,
            "delta-e-palette",
            "CIEDE2000 of the palette crate, 32 bits",
            "pairs",
            (0, operations_of_delta_e()),
            theirs,
        );
        let to_lab = move || conversion.over(level, borrowed(&rgb), borrowed_mut(&mut lab));
        vec![ours, core, theirs, timed(OURS, "lab", "Linear RGB to L*a*b*", "colours", (36, conversions), to_lab)]
    }

    fn material<F: Form<P, N> + 'static, const P: usize, const N: usize>(
        &self,
        kind: &'static str,
        id: &'static str,
        name: &'static str,
        material: Material<F, P, N>,
    ) -> Timed {
        let (level, cosines) = (self.level, self.cosines.clone());
        let mut out: [[Vec<f32>; 3]; N] = std::array::from_fn(|_| self.planes());
        let run = move || material.over(level, &cosines, out.each_mut().map(borrowed_mut));
        timed(kind, id, name, "material", (Material::<F, P, N>::BYTES, material.operations()), run)
    }

    fn spectral(&self, id: &'static str, name: &'static str, spectral: Spectral) -> Timed {
        let (level, cosines, mut out) = (self.level, self.cosines.clone(), self.planes());
        let cost = (spectral.bytes(), spectral.operations());
        let run = move || spectral.over(level, &cosines, borrowed_mut(&mut out));
        timed(OURS, id, name, "material", cost, run)
    }

    fn table(&self, id: &'static str, name: &'static str, table: Table) -> Timed {
        let (level, cosines, mut out) = (self.level, self.cosines.clone(), self.planes());
        let cost = (table.bytes(), Table::OPERATIONS);
        let run = move || table.over(level, &cosines, borrowed_mut(&mut out));
        timed(OURS, id, name, "material", cost, run)
    }

    fn pixels<F: Form<P> + 'static, const P: usize>(
        &self,
        kind: &'static str,
        id: &'static str,
        name: &'static str,
        form: F,
        parameters: [Rgb; P],
    ) -> Timed {
        let (level, cosines, mut out) = (self.level, self.cosines.clone(), self.planes());
        let textures = parameters.map(|rgb| around(rgb, cosines.len()));
        let run = move || {
            let textures: Planes<'_, P> = textures.each_ref().map(borrowed);
            over_pixels(form, level, (&cosines, textures), [borrowed_mut(&mut out)]);
        };
        timed(kind, id, name, "pixels", (3 * P * size_of::<f32>(), Operations::of(form)), run)
    }

    fn planes(&self) -> [Vec<f32>; 3] {
        [(); 3].map(|()| vec![0.0; self.cosines.len()])
    }
}

fn timed(
    kind: &'static str,
    id: &'static str,
    name: &'static str,
    over: &'static str,
    (bytes, operations): (usize, Operations),
    run: impl FnMut() + 'static,
) -> Timed {
    Timed { id, name, kind, over, bytes, operations, run: Box::new(run) }
}

fn lab_at([lightness, a, b]: &[Vec<f32>; 3], at: usize) -> Lab {
    Lab { lightness: f64::from(lightness[at]), a: f64::from(a[at]), b: f64::from(b[at]) }
}

type PaletteLab = palette::Lab<D65, f32>;

fn palette_pairs(pairs: &[(Lab, Lab)]) -> Vec<(PaletteLab, PaletteLab)> {
    let theirs = |lab: &Lab| PaletteLab::new(lab.lightness as f32, lab.a as f32, lab.b as f32);
    pairs.iter().map(|(x, y)| (theirs(x), theirs(y))).collect()
}
