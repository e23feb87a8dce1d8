//! One metal as a function in a shading language, of r and ten coefficients for each channel: nearer to the measured
//! spectrum than r and h, and of no use for any other metal.

use super::export::name_in_space;
use super::names::{identifier, one_ascii_line};
use super::number::{number, triple};
use super::shader::OSL_SHADER;
use super::{ExportError, ExportFile, Exported, Options, Target};
use crate::color::{RgbSpace, delta_e_rgb};
use crate::fit::bake;
use crate::fresnel::{CosTheta, SchlickSeries};
use crate::metal::Metal;
use crate::number::largest;

impl Target {
    /// Whether a metal can be written as a function of its own, see [`export_baked`].
    pub const fn can_bake(self) -> bool {
        Language::of(self).is_some()
    }
}

/// Writes a metal as a function of the cosine. What it loses is said in the file, not as a loss: r and h lose more.
pub fn export_baked(stem: &str, metal: &Metal, target: Target, options: &Options) -> Result<Exported, ExportError> {
    let language = Language::of(target).ok_or(ExportError::Baked { target })?;
    let space = options.space_for(target, RgbSpace::default())?;
    let series = bake(metal, space);
    let header = [
        format!("{}, written by Edgewise", metal.name),
        format!(
            "{space}: r and {} coefficients of each channel, within {:.1e} CIEDE2000 of the spectrum of {}",
            series.coefficients.len(),
            largest_delta_e(metal, &series, space),
            metal.id
        ),
    ];
    let comments: String = header.iter().map(|line| format!("// {}\n", one_ascii_line(line))).collect();
    let function = language.function(&identifier(&metal.name), &series);
    let bytes = format!("{comments}{function}").into_bytes();
    Ok(Exported { files: vec![ExportFile { name: name_in_space(stem, target, space), bytes }], losses: Vec::new() })
}

/// Over every half degree.
fn largest_delta_e(metal: &Metal, series: &SchlickSeries, space: RgbSpace) -> f64 {
    let off = |half: u16| {
        let c = CosTheta::from_deg(f64::from(half) / 2.0);
        delta_e_rgb(series.reflectance(c), metal.reflectance(c, space), space)
    };
    largest((0..=180).map(off))
}

/// How a language writes the function: what comes before and after it, a vector, and the declaration of three things.
struct Language {
    before: &'static str,
    after: &'static str,
    vector: &'static str,
    signature: &'static str,
    scalar: &'static str,
    variable: &'static str,
    cosine: &'static str,
}

impl Language {
    const fn of(target: Target) -> Option<Self> {
        match target {
            Target::Glsl => Some(Self {
                before: "#ifdef GL_ES\nprecision highp float;\n#endif\n\n",
                after: "",
                vector: "vec3",
                signature: "vec3 fresnel_$NAME(float cosTheta)",
                scalar: "float",
                variable: "vec3",
                cosine: "clamp(cosTheta, 0.0, 1.0)",
            }),
            Target::Hlsl => Some(Self {
                before: "",
                after: "",
                vector: "float3",
                signature: "float3 fresnel_$NAME(float cosTheta)",
                scalar: "float",
                variable: "float3",
                cosine: "saturate(cosTheta)",
            }),
            Target::Wgsl => Some(Self {
                before: "",
                after: "",
                vector: "vec3<f32>",
                signature: "fn fresnel_$NAME(cos_theta: f32) -> vec3<f32>",
                scalar: "let",
                variable: "var",
                cosine: "clamp(cos_theta, 0.0, 1.0)",
            }),
            Target::Osl => Some(Self {
                before: "",
                after: OSL_SHADER,
                vector: "color",
                signature: "color fresnel_$NAME(float cosTheta)",
                scalar: "float",
                variable: "color",
                cosine: "clamp(cosTheta, 0.0, 1.0)",
            }),
            _ => None,
        }
    }

    /// Horner's scheme, then Schlick's curve and the term that vanishes at both ends.
    fn function(&self, name: &str, series: &SchlickSeries) -> String {
        let Self { before, after, vector, signature, scalar, variable, cosine } = self;
        let vector = |rgb| format!("{vector}({})", triple(rgb, ", "));
        let mut highest_first = series.coefficients.iter().rev();
        let first = highest_first.next().copied().unwrap_or_default();
        let steps: String = highest_first.map(|b| format!("    p = p * t + {};\n", vector(*b))).collect();
        let powers = " * x".repeat(series.first_power.saturating_sub(1) as usize);
        let text = format!(
            "{before}\
             // Schlick 1994, and a polynomial of t fitted to this metal alone; white at grazing.\n\
             {signature} {{\n    \
             {scalar} c = {cosine};\n    \
             {scalar} x = 1.0 - c;\n    \
             {scalar} t = (1.0 - {} * c) / (1.0 + {} * c);\n    \
             {scalar} x2 = x * x;\n    \
             {variable} p = {};\n\
             {steps}    \
             return {} + (x2 * x2 * x) * {} + (c * x{powers}) * p;\n\
             }}\n\
             {after}",
            number(2.0 + series.bend),
            number(series.bend),
            vector(first),
            vector(series.r),
            vector(series.r.map(|r| 1.0 - r)),
        );
        text.replace("$NAME", name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn only_shading_languages_have_a_function() {
        let gold = metal_by_name("gold").unwrap();
        let can: Vec<Target> = Target::ALL.into_iter().filter(|target| target.can_bake()).collect();
        assert_eq!(can, [Target::Glsl, Target::Hlsl, Target::Wgsl, Target::Osl]);
        let refused = export_baked("gold", gold, Target::Usd, &Options::default()).unwrap_err();
        assert!(refused.to_string().contains("glsl"), "{refused}");
    }

    #[test]
    fn the_file_says_how_near_it_is() {
        let osmium = metal_by_name("osmium").unwrap();
        let space = RgbSpace::AcesCg;
        let exported = export_baked("osmium", osmium, Target::Wgsl, &Options { space: Some(space) }).unwrap();
        let text = String::from_utf8(exported.files[0].bytes.clone()).unwrap();
        let off = largest_delta_e(osmium, &bake(osmium, space), space);
        assert_eq!(exported.files[0].name, "osmium.acescg.wgsl");
        assert!(off > 0.0 && text.contains(&format!("within {off:.1e} CIEDE2000")), "{text}");
    }
}
