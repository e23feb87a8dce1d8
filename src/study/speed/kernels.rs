//! What has a turn: our kernels, textbook forms, bounds, and what other programs do for the same.

use std::hint::black_box;
use std::ops::ControlFlow;

use palette::color_difference::Ciede2000;

use super::SpeedOptions;
use super::buffers::{COLOURS, buffer, colours, cosines, labs, planes};
use super::curve::{InVectors, curve, kernel_of};
use super::error_table::ErrorTable;
use crate::color::{Lab, Rgb, RgbSpace, delta_e_2000};
use crate::fresnel::{CosTheta, FresnelModel};
use crate::kernel::textbook::{
    ComplexConductor, DielectricAsPrinted, DividerBound, F82AsPrinted, GulbrandsenAsPrinted, HoffmanAsPrinted,
    PopularConductor, SchlickByPower, SpectralDividerBound,
};
use crate::kernel::{
    Basis, Conductor, ConductorAndAbsorption, ConductorOfPixels, Dielectric, Exported, F82OfPixels, Form as Formula,
    GulbrandsenOfPixels, LabConversion, Level, Material, Operations, SchlickOfPixels, at_pixel, delta_e_over,
    operations_of_delta_e, over_pixels,
};
use crate::metal::{metal_by_name, preferred_metals};
use crate::render::{Light, RadialTable, SphereView, Srgb8Picture};
use crate::study::{FormOfVariant, StudyError, Subject, Variant, forms};

/// Our vectors.
pub(super) const OURS: &str = "ours";
/// Our text one by one, as a shader has it.
pub(super) const SCALAR: &str = "scalar";
/// The core.
pub(super) const DOUBLE: &str = "64-bits";
/// As printed, in our vectors.
pub(super) const TEXTBOOK: &str = "textbook";
/// pbrt's arithmetic, in our vectors.
pub(super) const COMPLEX: &str = "textbook, complex";
/// What a kernel cannot do without, in our vectors.
pub(super) const BOUND: &str = "bound";
/// The crate of that name, in 32 bits, and in 64.
pub(super) const PALETTE: &str = "palette";
pub(super) const PALETTE_DOUBLE: &str = "palette, 64-bits";

/// Three channels of one material.
pub(super) const MATERIAL: &str = "material";
/// Three channels of parameters from a texture.
pub(super) const PIXEL: &str = "pixel";
/// Two colours.
pub(super) const PAIR: &str = "pair";
/// A colour.
pub(super) const COLOR: &str = "color";
/// A whole table of errors.
pub(super) const TABLE: &str = "table";
/// A whole picture.
pub(super) const PICTURE: &str = "picture";

/// The table of errors whose time is aimed at: so many metals, and wavelengths for their truth.
pub(super) const TABLE_METALS: usize = 33;
pub(super) const TABLE_WAVELENGTHS: usize = 81;

/// Width and height of the picture of a sphere.
const PICTURE_SIZE: u32 = 1024;

/// Evaluations in a row: cosines and results stay in the first cache.
const VALUES: usize = COLOURS;
/// Of many wavelengths.
const VALUES_OF_MANY: usize = 256;

/// The space of everything that needs one.
const SPACE: RgbSpace = RgbSpace::LinRec709;

/// Gold as textbooks have it.
const R: Rgb = Rgb([0.944, 0.776, 0.373]);
const H: Rgb = Rgb([0.954, 0.880, 0.660]);
const T: Rgb = Rgb([0.983, 0.999, 0.994]);
const N: Rgb = Rgb([0.183, 0.421, 1.373]);
const K: Rgb = Rgb([3.424, 2.346, 1.770]);
/// One that has a turn.
pub(super) struct Kernel {
    pub(super) name: String,
    pub(super) kind: &'static str,
    pub(super) per: &'static str,
    pub(super) parameter_bytes: Option<u64>,
    pub(super) operations: Option<Operations>,
    /// How many evaluations `run` makes.
    pub(super) evaluations: usize,
    pub(super) run: Box<dyn FnMut()>,
}

impl Kernel {
    /// Schlick's model, which all are held against.
    pub(super) fn is_reference(&self) -> bool {
        (self.name.as_str(), self.kind, self.per) == ("schlick", OURS, MATERIAL)
    }

    /// Whether an evaluation is comparable with one of Schlick's.
    pub(super) fn is_one_colour(&self) -> bool {
        !matches!(self.per, TABLE | PICTURE)
    }
}

/// The kernels that are wanted, beside Schlick's. `progress` is asked between what takes long to prepare.
pub(super) fn kernels(
    options: &SpeedOptions,
    progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Vec<Kernel>, StudyError> {
    let mut field = Field { level: options.level, wanted: &options.kernels, kernels: Vec::new() };
    field.all(&mut || progress(0.0))?;
    Ok(field.kernels)
}

/// The names of all, each once, in their order.
pub(super) fn names() -> Vec<String> {
    let mut names: Vec<String> = variants().map(kernel_of).collect();
    names.extend(OTHERS.map(str::to_owned));
    names
}

/// The names that are no variant's.
const OTHERS: [&str; 12] = [
    "hoffman-basis",
    CONDUCTOR_ANY,
    CONDUCTOR_BOTH,
    CONDUCTOR_BOTH_ANY,
    "dielectric",
    "gulbrandsen",
    "lab",
    "delta-e",
    "error-table",
    "error-table-401",
    "preview-white",
    "preview-soft-boxes",
];

/// F of n and k where k < n, and F and 1 − F, where k ≥ n and where not.
const CONDUCTOR_ANY: &str = "conductor-any";
const CONDUCTOR_BOTH: &str = "conductor-and-absorption";
const CONDUCTOR_BOTH_ANY: &str = "conductor-and-absorption-any";

/// One variant for each kernel, and one more for the number of wavelengths that is aimed at.
fn variants() -> impl Iterator<Item = Variant> {
    let mut seen: Vec<String> = Vec::new();
    let all = Variant::ALL.into_iter().chain([Variant::Spectral(TABLE_WAVELENGTHS)]);
    all.filter(move |variant| {
        let name = kernel_of(*variant);
        let is_new = !seen.contains(&name);
        seen.push(name);
        is_new
    })
}

/// What is gathered.
struct Field<'a> {
    level: Level,
    wanted: &'a [String],
    kernels: Vec<Kernel>,
}

impl Field<'_> {
    fn wants(&self, name: &str) -> bool {
        self.wanted.is_empty() || name == "schlick" || self.wanted.iter().any(|own| own == name)
    }

    fn all(&mut self, keep_going: &mut dyn FnMut() -> ControlFlow<()>) -> Result<(), StudyError> {
        self.of_variants(keep_going)?;
        self.materials();
        self.textbooks();
        self.bounds();
        self.core();
        self.textures();
        self.differences();
        self.tables(keep_going)?;
        self.pictures();
        Ok(())
    }

    fn add(
        &mut self,
        (name, kind, per): (&str, &'static str, &'static str),
        (bytes, operations): (Option<usize>, Option<Operations>),
        evaluations: usize,
        run: impl FnMut() + 'static,
    ) {
        self.kernels.push(Kernel {
            name: name.to_owned(),
            kind,
            per,
            parameter_bytes: bytes.map(|bytes| bytes as u64),
            operations,
            evaluations,
            run: Box::new(run),
        });
    }

    /// Gold in every variant that has a kernel of its own.
    fn of_variants(&mut self, keep_going: &mut dyn FnMut() -> ControlFlow<()>) -> Result<(), StudyError> {
        let wanted: Vec<Variant> = variants().filter(|variant| self.wants(&kernel_of(*variant))).collect();
        let gold = Subject::Metal(metal_by_name("gold").expect("a metal of the library"));
        for FormOfVariant { variant, form, .. } in forms(&gold, &wanted, SPACE, keep_going)? {
            let curve = curve(&form).expect("every variant has a kernel, as a test holds");
            let costs = (Some(variant.parameter_bytes() as usize), Some(curve.operations));
            let (name, values) = (kernel_of(variant), values_of(variant.operations()));
            self.in_vectors((&name, OURS), costs, values, curve.in_vectors);
            self.one_by_one(&name, costs, values, curve.one_by_one);
        }
        Ok(())
    }

    fn in_vectors(
        &mut self,
        (name, kind): (&str, &'static str),
        costs: (Option<usize>, Option<Operations>),
        values: usize,
        curve: InVectors,
    ) {
        let (level, cosines, mut out) = (self.level, cosines(values), planes(values));
        self.add((name, kind, MATERIAL), costs, values, move || {
            curve(level, black_box(&cosines[..]), out.each_mut().map(Vec::as_mut_slice));
            black_box(&mut out);
        });
    }

    /// The same text, compiled for any processor of this architecture.
    fn one_by_one<const M: usize>(
        &mut self,
        name: &str,
        costs: (Option<usize>, Option<Operations>),
        values: usize,
        curve: impl Fn(&[f32], &mut [[[f32; 3]; M]]) + 'static,
    ) {
        let (cosines, mut out) = (cosines(values), vec![[[0.0_f32; 3]; M]; values]);
        self.add((name, SCALAR, MATERIAL), costs, values, move || {
            curve(black_box(&cosines), black_box(&mut out));
        });
    }

    /// A formula with its constants, in vectors and one by one; `bytes` are those of the parameters they are made from.
    fn ours<F: Formula<P, M> + 'static, const P: usize, const M: usize>(
        &mut self,
        name: &str,
        bytes: usize,
        material: Material<F, P, M>,
    ) {
        self.material((name, OURS), Some(bytes), material);
        if self.wants(name) {
            let costs = (Some(bytes), Some(material.operations()));
            self.one_by_one(name, costs, VALUES, move |cosines, out| material.one_by_one(cosines, out));
        }
    }

    fn material<F: Formula<P, M> + 'static, const P: usize, const M: usize>(
        &mut self,
        (name, kind): (&str, &'static str),
        bytes: Option<usize>,
        material: Material<F, P, M>,
    ) {
        if !self.wants(name) {
            return;
        }
        let (level, cosines) = (self.level, cosines(VALUES));
        let mut out: [[Vec<f32>; 3]; M] = std::array::from_fn(|_| planes(VALUES));
        let operations = (kind != BOUND).then(|| material.operations());
        self.add((name, kind, MATERIAL), (bytes, operations), VALUES, move || {
            let planes = out.each_mut().map(|planes| planes.each_mut().map(Vec::as_mut_slice));
            material.over(level, black_box(&cosines), planes);
            black_box(&mut out);
        });
    }

    fn materials(&mut self) {
        let [n, k] = tungsten();
        self.ours("hoffman-basis", 24, Basis::material(R, H));
        self.ours(CONDUCTOR_ANY, 24, Conductor::material(n, k));
        self.ours(CONDUCTOR_BOTH, 24, ConductorAndAbsorption::material(N, K));
        self.ours(CONDUCTOR_BOTH_ANY, 24, ConductorAndAbsorption::material(n, k));
        self.ours("dielectric", 12, Dielectric::material(Rgb([1.5, 1.51, 1.52])));
    }

    fn textbooks(&mut self) {
        let raw = Material::of_parameters(SchlickByPower, [R]);
        self.material(("schlick", TEXTBOOK), Some(12), raw);
        self.material(("hoffman", TEXTBOOK), Some(24), Material::of_parameters(HoffmanAsPrinted, [R, H]));
        self.material(("f82-tint", TEXTBOOK), Some(24), Material::of_parameters(F82AsPrinted, [R, T]));
        self.material(("conductor", TEXTBOOK), Some(24), PopularConductor::material(N, K));
        self.material(("conductor", COMPLEX), Some(24), ComplexConductor::material(N, K));
        let index = Rgb([1.5, 1.51, 1.52]);
        self.material(("dielectric", TEXTBOOK), Some(12), Material::of_parameters(DielectricAsPrinted, [index]));
    }

    fn bounds(&mut self) {
        for name in ["conductor", CONDUCTOR_ANY, CONDUCTOR_BOTH, CONDUCTOR_BOTH_ANY] {
            self.material((name, BOUND), None, DividerBound::material(N, K));
        }
        for variant in variants() {
            let count = match variant {
                Variant::Spectral(count) => count,
                Variant::Exact => crate::spectrum::SAMPLES,
                _ => continue,
            };
            let (name, bound) = (kernel_of(variant), SpectralDividerBound::new(count));
            if self.wants(&name) {
                let values = values_of(variant.operations());
                let curve: InVectors = Box::new(move |level, cosines, out| bound.over(level, cosines, out));
                self.in_vectors((name.as_str(), BOUND), (None, None), values, curve);
            }
        }
    }

    /// 64 bits, one by one.
    fn core(&mut self) {
        let models = [
            FresnelModel::Schlick { r: R },
            FresnelModel::Hoffman { r: R, h: H },
            FresnelModel::F82Tint { r: R, t: T },
            FresnelModel::Conductor { n: N, k: K },
        ];
        for model in models {
            let name = model.kind().id();
            if self.wants(name) {
                let angles: Vec<CosTheta> = cosines(VALUES).into_iter().map(|c| CosTheta::new(f64::from(c))).collect();
                let mut out = vec![Rgb::BLACK; VALUES];
                self.add((name, DOUBLE, MATERIAL), (None, None), VALUES, move || {
                    for (out, angle) in out.iter_mut().zip(black_box(&angles)) {
                        *out = black_box(&model).reflectance(*angle);
                    }
                    black_box(&mut out);
                });
            }
        }
    }

    fn textures(&mut self) {
        self.texture(("schlick", OURS), SchlickOfPixels, [R]);
        self.texture(("hoffman", OURS), Exported, [R, H]);
        self.texture(("hoffman-basis", OURS), Basis, [R, H]);
        self.texture(("f82-tint", OURS), F82OfPixels, [R, T]);
        self.texture(("conductor", OURS), ConductorOfPixels, [N, K]);
        self.texture(("gulbrandsen", OURS), GulbrandsenOfPixels, [R, H]);
        self.texture(("gulbrandsen", TEXTBOOK), GulbrandsenAsPrinted, [R, H]);
    }

    fn texture<F: Formula<P> + 'static, const P: usize>(
        &mut self,
        (name, kind): (&str, &'static str),
        form: F,
        parameters: [Rgb; P],
    ) {
        if !self.wants(name) {
            return;
        }
        let (level, cosines, mut out) = (self.level, cosines(VALUES), planes(VALUES));
        let textures = parameters.map(|rgb| rgb.0.map(|value| buffer((0..VALUES).map(|_| value as f32))));
        let costs = (Some(12 * P), Some(Operations::of(form)));
        self.add((name, kind, PIXEL), costs, VALUES, move || {
            let textures = textures.each_ref().map(|planes| planes.each_ref().map(Vec::as_slice));
            let planes = out.each_mut().map(Vec::as_mut_slice);
            over_pixels(form, level, (black_box(&cosines[..]), black_box(textures)), [planes]);
            black_box(&mut out);
        });
        if kind == OURS {
            self.pixels_one_by_one(name, form, parameters);
        }
    }

    fn pixels_one_by_one<F: Formula<P> + 'static, const P: usize>(
        &mut self,
        name: &str,
        form: F,
        parameters: [Rgb; P],
    ) {
        let of_pixel: [[f32; P]; 3] = std::array::from_fn(|channel| parameters.map(|rgb| rgb[channel] as f32));
        let (cosines, texture, mut out) = (cosines(VALUES), vec![of_pixel; VALUES], vec![[0.0; 3]; VALUES]);
        let costs = (Some(12 * P), Some(Operations::of(form)));
        self.add((name, SCALAR, PIXEL), costs, VALUES, move || {
            let pixels = black_box(&cosines).iter().zip(black_box(&texture));
            for (out, (c, pixel)) in out.iter_mut().zip(pixels) {
                [*out] = at_pixel(form, *pixel, *c);
            }
            black_box(&mut out);
        });
    }

    fn differences(&mut self) {
        let level = self.level;
        if self.wants("lab") {
            let (conversion, rgb, mut out) = (LabConversion::new(SPACE), colours(), planes(VALUES));
            self.add(("lab", OURS, COLOR), (None, Some(conversion.operations())), VALUES, move || {
                let planes = black_box(&rgb).each_ref().map(Vec::as_slice);
                conversion.over(level, planes, out.each_mut().map(Vec::as_mut_slice));
                black_box(&mut out);
            });
        }
        if !self.wants("delta-e") {
            return;
        }
        let (labs, mut out) = (labs(), vec![0.0; VALUES]);
        self.add(("delta-e", OURS, PAIR), (None, Some(operations_of_delta_e())), VALUES, move || {
            let [x, y] = black_box(&labs).each_ref().map(|planes| planes.each_ref().map(Vec::as_slice));
            delta_e_over(level, x, y, &mut out);
            black_box(&mut out);
        });
        self.others_differences();
    }

    /// The same pairs by the core, and by the crate that is used most.
    fn others_differences(&mut self) {
        let pairs = |of: &dyn Fn([f32; 3]) -> Lab| {
            let [x, y] = labs().map(|[l, a, b]| (0..VALUES).map(|i| of([l[i], a[i], b[i]])).collect::<Vec<_>>());
            x.into_iter().zip(y).collect::<Vec<_>>()
        };
        let core = pairs(&|[l, a, b]| Lab { lightness: l.into(), a: a.into(), b: b.into() });
        let single: Vec<[palette::Lab<palette::white_point::D65, f32>; 2]> = core
            .iter()
            .map(|(x, y)| [x, y].map(|c| palette::Lab::new(c.lightness as f32, c.a as f32, c.b as f32)))
            .collect();
        let double: Vec<[palette::Lab<palette::white_point::D65, f64>; 2]> =
            core.iter().map(|(x, y)| [x, y].map(|c| palette::Lab::new(c.lightness, c.a, c.b))).collect();
        self.pairs(DOUBLE, core, |(x, y)| delta_e_2000(*x, *y));
        self.pairs(PALETTE, single, |[x, y]| x.difference(*y));
        self.pairs(PALETTE_DOUBLE, double, |[x, y]| x.difference(*y));
    }

    fn pairs<P: 'static, D: Copy + Default + 'static>(
        &mut self,
        kind: &'static str,
        pairs: Vec<P>,
        difference: impl Fn(&P) -> D + 'static,
    ) {
        let mut out = vec![D::default(); pairs.len()];
        self.add(("delta-e", kind, PAIR), (None, None), pairs.len(), move || {
            for (out, pair) in out.iter_mut().zip(black_box(&pairs)) {
                *out = difference(pair);
            }
            black_box(&mut out);
        });
    }

    fn tables(&mut self, keep_going: &mut dyn FnMut() -> ControlFlow<()>) -> Result<(), StudyError> {
        for (name, wavelengths) in [("error-table", TABLE_WAVELENGTHS), ("error-table-401", crate::spectrum::SAMPLES)] {
            if !self.wants(name) {
                continue;
            }
            let metals: Vec<_> = preferred_metals().take(TABLE_METALS).collect();
            let table = ErrorTable::new(&metals, wavelengths, SPACE, keep_going)?;
            let (level, mut out, input) = (self.level, table.nothing_yet(), table.input().clone());
            self.add((name, OURS, TABLE), (None, None), 1, move || {
                table.measure(level, &mut out);
                black_box(&mut out);
            });
            self.add((name, DOUBLE, TABLE), (None, None), 1, move || {
                black_box(black_box(&input).delta_e());
            });
        }
        Ok(())
    }

    /// A sphere whose r and h changed, from the model to the codes of every pixel on the screen: the table over the angle,
    /// the light that each pixel mirrors, 8-bit sRGB. The light is known, and the picture's memory is used again, as while
    /// a slider moves. On as many threads and the best instruction set that there are.
    fn pictures(&mut self) {
        for (name, light) in [("preview-white", Light::White), ("preview-soft-boxes", Light::SoftBoxes)] {
            if self.wants(name) {
                let view = SphereView::new(PICTURE_SIZE, light, 0.0, SPACE);
                let model = FresnelModel::Hoffman { r: R, h: H };
                let mut picture = Srgb8Picture::default();
                self.add((name, OURS, PICTURE), (None, None), 1, move || {
                    view.render_srgb8(&RadialTable::of_model(black_box(&model), SPACE), &mut picture);
                    black_box(&mut picture);
                });
            }
        }
    }
}

/// n and k of a metal with n > k, at three wavelengths.
fn tungsten() -> [Rgb; 2] {
    let table = metal_by_name("tungsten").expect("a metal of the library").table();
    let nk = [650.0, 550.0, 450.0].map(|nm| table.at(nm));
    [Rgb(nk.map(|nk| nk.n)), Rgb(nk.map(|nk| nk.k))]
}

/// Fewer where an evaluation takes long.
fn values_of(operations: Operations) -> usize {
    if operations.roots > 100 { VALUES_OF_MANY } else { VALUES }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_said_once() {
        let mut names = names();
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
