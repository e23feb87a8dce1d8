//! A curve of any form as a function in a shading language.

use super::form::{a_of_generalized, limited_index};
use super::number::{number, triple};
use super::shader::OSL_SHADER;
use crate::color::Rgb;
use crate::fresnel::{FresnelModel, Nk, SchlickSeries, nk_from_r_g};
use crate::study::Form;

/// How a language writes the function: what comes before and after it, a vector, the declarations of a number, of a
/// vector and of one that changes, and a table.
pub(super) struct Language {
    before: &'static str,
    after: &'static str,
    vector: &'static str,
    signature: &'static str,
    conductor: &'static str,
    scalar: &'static str,
    constant: &'static str,
    variable: &'static str,
    cosine: &'static str,
    table: Table,
}

/// How a table is declared, and how it is indexed.
struct Table {
    before: &'static str,
    after: &'static str,
    is_local: bool,
    index: &'static str,
    index_as_number: &'static str,
}

impl Language {
    pub(super) const GLSL: Self = Self {
        before: "#ifdef GL_ES\nprecision highp float;\n#endif\n\n",
        after: "",
        vector: "vec3",
        signature: "vec3 fresnel_$NAME(float cosTheta)",
        conductor: "vec3 edgewise_conductor(vec3 n, vec3 k, float c)",
        scalar: "float",
        constant: "vec3",
        variable: "vec3",
        cosine: "clamp(cosTheta, 0.0, 1.0)",
        table: Table {
            before: "const vec3 rows_$NAME[$COUNT] = vec3[$COUNT](",
            after: ");",
            is_local: false,
            index: "int i = int(",
            index_as_number: "float(i)",
        },
    };

    pub(super) const HLSL: Self = Self {
        before: "",
        after: "",
        vector: "float3",
        signature: "float3 fresnel_$NAME(float cosTheta)",
        conductor: "float3 edgewise_conductor(float3 n, float3 k, float c)",
        scalar: "float",
        constant: "float3",
        variable: "float3",
        cosine: "saturate(cosTheta)",
        table: Table {
            before: "static const float3 rows_$NAME[$COUNT] = {",
            after: "};",
            is_local: false,
            index: "int i = int(",
            index_as_number: "float(i)",
        },
    };

    pub(super) const WGSL: Self = Self {
        before: "",
        after: "",
        vector: "vec3<f32>",
        signature: "fn fresnel_$NAME(cos_theta: f32) -> vec3<f32>",
        conductor: "fn edgewise_conductor(n: vec3<f32>, k: vec3<f32>, c: f32) -> vec3<f32>",
        scalar: "let",
        constant: "let",
        variable: "var",
        cosine: "clamp(cos_theta, 0.0, 1.0)",
        table: Table {
            before: "var<private> rows_$NAME: array<vec3<f32>, $COUNT> = array<vec3<f32>, $COUNT>(",
            after: ");",
            is_local: false,
            index: "let i = u32(",
            index_as_number: "f32(i)",
        },
    };

    pub(super) const OSL: Self = Self {
        before: "",
        after: OSL_SHADER,
        vector: "color",
        signature: "color fresnel_$NAME(float cosTheta)",
        conductor: "color edgewise_conductor(color n, color k, float c)",
        scalar: "float",
        constant: "color",
        variable: "color",
        cosine: "clamp(cosTheta, 0.0, 1.0)",
        table: Table {
            before: "color rows_$NAME[$COUNT] = {",
            after: "};",
            is_local: true,
            index: "int i = int(",
            index_as_number: "float(i)",
        },
    };

    /// The source of a function `fresnel_<name>` of the cosine. r and h have templates of their own.
    pub(super) fn function(&self, name: &str, form: &Form) -> String {
        let (general, body) = match form {
            Form::Series(series) => (String::new(), self.of_series(series)),
            Form::Model { model } => self.of_model(model),
            Form::Table { rows } => (self.table_outside(rows), self.of_table(rows)),
            Form::Spectral { n, k, weights, .. } => (self.conductor(), self.of_wavelengths(n, k, weights)),
        };
        let Self { before, after, signature, .. } = self;
        let comment = comment(form);
        format!("{before}{general}// {comment}\n{signature} {{\n{body}}}\n{after}").replace("$NAME", name)
    }

    fn vector(&self, rgb: Rgb) -> String {
        format!("{}({})", self.vector, triple(rgb, ", "))
    }

    /// The cosine and its complement, which all but conductors begin with.
    fn cosine_and_x(&self) -> String {
        let Self { scalar, cosine, .. } = self;
        format!("    {scalar} c = {cosine};\n    {scalar} x = 1.0 - c;\n")
    }

    /// Horner's scheme, then Schlick's curve and the term that vanishes at both ends.
    fn of_series(&self, series: &SchlickSeries) -> String {
        let Self { scalar, variable, .. } = self;
        let vector = |rgb| self.vector(rgb);
        let mut highest_first = series.coefficients.iter().rev();
        let first = highest_first.next().copied().unwrap_or_default();
        let steps: String = highest_first.map(|b| format!("    p = p * t + {};\n", vector(*b))).collect();
        let powers = " * x".repeat(series.first_power.saturating_sub(1) as usize);
        format!(
            "{}    \
             {scalar} t = (1.0 - {} * c) / (1.0 + {} * c);\n    \
             {scalar} x2 = x * x;\n    \
             {variable} p = {};\n\
             {steps}    \
             return {} + (x2 * x2 * x) * {} + (c * x{powers}) * p;\n",
            self.cosine_and_x(),
            number(2.0 + series.bend),
            number(series.bend),
            vector(first),
            vector(series.r),
            vector(series.r.map(|r| 1.0 - r)),
        )
    }

    /// What stands before the function, and its body.
    fn of_model(&self, model: &FresnelModel) -> (String, String) {
        let vector = |rgb| self.vector(rgb);
        let powers = format!("{}    {} x2 = x * x;\n", self.cosine_and_x(), self.scalar);
        match *model {
            FresnelModel::Lazanyi { r, a, alpha } => {
                let white = vector(r.map(|r| 1.0 - r));
                let (r, a, alpha) = (vector(r), vector(a), number(alpha));
                let curve = format!("{r} + (x2 * x2 * x) * {white} - (c * pow(x, {alpha})) * {a}");
                (String::new(), format!("{powers}    return {curve};\n"))
            }
            FresnelModel::GeneralizedSchlick { r0, t, r90, p } => {
                let a = vector(a_of_generalized(r0, t, r90, p));
                let (r0, rise, p) = (vector(r0), vector(r90 - r0), number(p));
                let curve = format!("{r0} + pow(x, {p}) * {rise} - (c * (x2 * x2 * x2)) * {a}");
                (String::new(), format!("{powers}    return {curve};\n"))
            }
            FresnelModel::Conductor { n, k } => {
                let [n, k] = [n, k].map(limited_index);
                let cosine = self.cosine;
                let body = format!("    return edgewise_conductor({}, {}, {cosine});\n", vector(n), vector(k));
                (self.conductor(), body)
            }
            FresnelModel::Gulbrandsen { r, g } => {
                let (n, k) = n_k_of(r, g);
                self.of_model(&FresnelModel::Conductor { n, k })
            }
            FresnelModel::Constant { r }
            | FresnelModel::Schlick { r }
            | FresnelModel::Hoffman { r, .. }
            | FresnelModel::F82Tint { r, .. } => (String::new(), format!("    return {};\n", vector(r))),
        }
    }

    /// The exact equations for three n and k: the small part of the root comes from n k, not from a difference.
    fn conductor(&self) -> String {
        let Self { conductor, scalar, constant, .. } = self;
        let function = format!(
            "// Born & Wolf 1999, section 14.2: a conductor in air, unpolarised, at three n and k.\n\
             {conductor} {{\n    \
             {scalar} s2 = (1.0 - c) * (1.0 + c);\n    \
             {constant} nk = n * k;\n    \
             {constant} t = (n - k) * (n + k) - s2;\n    \
             {constant} q = sqrt(t * t + 4.0 * nk * nk);\n    \
             {constant} larger = sqrt(0.5 * (q + abs(t)));\n    \
             {constant} smaller = nk / larger;\n    \
             {constant} a = 0.5 * (larger + smaller) + 0.5 * sign(t) * (larger - smaller);\n    \
             {constant} d = (2.0 * c) * a;\n    \
             {constant} s = q + c * c;\n    \
             {constant} p = q * (c * c) + s2 * s2;\n    \
             return 0.5 * ((s - d) / (s + d)) * (1.0 + (p - s2 * d) / (p + s2 * d));\n\
             }}\n"
        );
        if self.has_guards() {
            format!("#ifndef EDGEWISE_CONDUCTOR\n#define EDGEWISE_CONDUCTOR\n{function}#endif\n\n")
        } else {
            format!("// WGSL cannot guard against a second copy: keep one of this function in a module.\n{function}\n")
        }
    }

    fn has_guards(&self) -> bool {
        self.scalar != "let"
    }

    /// Three wavelengths at a time, each with its colour.
    fn of_wavelengths(&self, n: &[f64], k: &[f64], weights: &[Rgb]) -> String {
        let Self { scalar, variable, cosine, .. } = self;
        let mut body = format!("    {scalar} c = {cosine};\n    {variable} sum = {};\n", self.vector(Rgb::BLACK));
        let mut declaration = format!("{variable} ");
        for ((n, k), weights) in n.chunks(3).zip(k.chunks(3)).zip(weights.chunks(3)) {
            // The last of them may be less than three, and is filled up.
            let three = |values: &[f64]| Rgb(std::array::from_fn(|i| values[i.min(values.len() - 1)]));
            let (n, k) = (self.vector(three(n)), self.vector(three(k)));
            body += &format!("    {declaration}f = edgewise_conductor({n}, {k}, c);\n");
            let terms: Vec<String> =
                weights.iter().enumerate().map(|(i, weight)| format!("f[{i}] * {}", self.vector(*weight))).collect();
            body += &format!("    sum = sum + {};\n", terms.join(" + "));
            declaration.clear();
        }
        body + "    return sum;\n"
    }

    fn rows(&self, rows: &[Rgb]) -> String {
        let Table { before, after, .. } = self.table;
        let rows_of_text: Vec<String> = rows.iter().map(|row| format!("    {}", self.vector(*row))).collect();
        let before = before.replace("$COUNT", &rows.len().to_string());
        format!("{before}\n{}\n{after}\n", rows_of_text.join(",\n"))
    }

    fn table_outside(&self, rows: &[Rgb]) -> String {
        if self.table.is_local { String::new() } else { format!("{}\n", self.rows(rows)) }
    }

    /// Linear between rows that are even in √c.
    fn of_table(&self, rows: &[Rgb]) -> String {
        let Self { scalar, cosine, table, .. } = self;
        let Table { index, index_as_number, .. } = table;
        let local = if table.is_local { self.rows(rows) } else { String::new() };
        let last = rows.len().saturating_sub(1) as f64;
        let (last, before_last) = (number(last), number(last - 1.0));
        format!(
            "{local}    \
             {scalar} place = sqrt({cosine}) * {last};\n    \
             {index}min(place, {before_last}));\n    \
             {scalar} rest = place - {index_as_number};\n    \
             return (1.0 - rest) * rows_$NAME[i] + rest * rows_$NAME[i + 1];\n"
        )
    }
}

/// r = 1 is a mirror, which has no index; the file's nine digits and single precision hide so little.
const MIRROR: f64 = 1.0 - 1e-6;

/// n and k of r and g; 0 where these stand for none.
fn n_k_of(r: Rgb, g: Rgb) -> (Rgb, Rgb) {
    let nk = |i: usize| nk_from_r_g(r[i].min(MIRROR), g[i]).unwrap_or(Nk { n: 0.0, k: 0.0 });
    let nk: [Nk; 3] = std::array::from_fn(nk);
    (Rgb(nk.map(|nk| nk.n)), Rgb(nk.map(|nk| nk.k)))
}

/// What the function is.
const fn comment(form: &Form) -> &'static str {
    match form {
        Form::Series(_) => "Schlick 1994, and a polynomial of t fitted to this metal alone; white at grazing.",
        Form::Table { .. } => "Rows of this material alone, even in the root of the cosine, and linear between.",
        Form::Spectral { .. } => "n and k of this material at some wavelengths, each with its color.",
        Form::Model { model } => match model {
            FresnelModel::Lazanyi { .. } => "Lazanyi and Szirmay-Kalos 2005: Schlick 1994 less a c x^alpha.",
            FresnelModel::GeneralizedSchlick { .. } => {
                "Hoffman 2023: Schlick 1994 with a power of its own, less a c x^6."
            }
            FresnelModel::Gulbrandsen { .. } | FresnelModel::Conductor { .. } => "n and k of each channel.",
            _ => "Schlick 1994: r facing the surface.",
        },
    }
}

/// What a function says, in a sentence without a point.
pub(super) fn described(form: &Form) -> String {
    match form {
        Form::Model { model } => model.kind().label().to_owned(),
        Form::Series(series) => {
            format!("r and {} coefficients of each channel", series.coefficients.len())
        }
        Form::Table { rows } => format!("{} rows, even in the root of the cosine", rows.len()),
        Form::Spectral { n, .. } => format!("n and k at {} wavelengths", n.len()),
    }
}
