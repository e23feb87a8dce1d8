//! The curve as a function in four shading languages, for programs that have no file for this model.
//!
//! No `pow` where a product will do: it is NaN for a cosine slightly above 1. The cosine is clamped; every literal has a
//! point.

use super::Target;
use super::export::Written;
use super::language::Language;
use super::material::Material;
use super::names::one_ascii_line;
use super::number::{number, triple};
use crate::fresnel::{FresnelModel, PEAK_GAIN, SCHLICK_GAIN};
use crate::study::Form;

/// The function in the language of a target: GLSL for `#version 330`, `300 es` and Vulkan `450` (the including shader
/// has the version line), HLSL for shader model 2 and later, WGSL, or OSL with a shader around it that states the
/// reflectance at the shading point.
///
/// WGSL has no preprocessor, so a module with two metals must drop the second general function.
pub(super) fn source(header: &[String], material: &Material<'_>, target: Target) -> Written {
    let comments: String = header.iter().map(|line| format!("// {}\n", one_ascii_line(line))).collect();
    let (templates, language) = Templates::of(target);
    let text = match &material.form {
        Form::Model { model: FresnelModel::Hoffman { .. } } => fill(templates.whole, material),
        Form::Model { model: FresnelModel::Schlick { .. } } => {
            fill(&[templates.schlick, templates.rest].concat(), material)
        }
        Form::Model { model: FresnelModel::Constant { .. } } => {
            fill(&[templates.constant, templates.rest].concat(), material)
        }
        form => language.function(&material.identifier, form),
    };
    Ok(format!("{comments}{text}").into_bytes())
}

/// A curve of any form as a function `fresnel_<name>` of the cosine.
pub(super) fn function(target: Target, name: &str, form: &Form) -> String {
    Templates::of(target).1.function(name, form)
}

/// Puts a material into a template. `$NAME`s are replaced one by one; no value contains another's name.
fn fill(template: &str, material: &Material<'_>) -> String {
    template
        .replace("$PEAK_GAIN", &number(PEAK_GAIN))
        .replace("$SCHLICK_GAIN", &number(SCHLICK_GAIN))
        .replace("$NAME", &material.identifier)
        .replace("$R", &triple(material.r, ", "))
        .replace("$H", &triple(material.h, ", "))
}

/// A shader around a function of OSL, which states the reflectance at the shading point.
pub(super) const OSL_SHADER: &str = "
shader edgewise_$NAME(output color reflectance = 0.0) {
    reflectance = fresnel_$NAME(abs(dot(I, N)));
}
";

/// The functions of a language for as much of the curve as is said.
struct Templates {
    whole: &'static str,
    schlick: &'static str,
    constant: &'static str,
    /// What follows the functions that say less.
    rest: &'static str,
}

impl Templates {
    /// For r and h and less, and the language for everything else.
    const fn of(target: Target) -> (&'static Self, &'static Language) {
        match target {
            Target::Hlsl => (&Self::HLSL, &Language::HLSL),
            Target::Wgsl => (&Self::WGSL, &Language::WGSL),
            Target::Osl => (&Self::OSL, &Language::OSL),
            _ => (&Self::GLSL, &Language::GLSL),
        }
    }

    const GLSL: Self = Self {
        whole: GLSL,
        schlick: "\
#ifdef GL_ES
precision highp float;
#endif

// Schlick 1994: r facing the surface, white at grazing.
vec3 fresnel_$NAME(float cosTheta) {
    vec3 r = vec3($R);
    float x = 1.0 - clamp(cosTheta, 0.0, 1.0);
    float x2 = x * x;
    return r + (x2 * x2 * x) * (vec3(1.0) - r);
}
",
        constant: "\
#ifdef GL_ES
precision highp float;
#endif

vec3 fresnel_$NAME(float cosTheta) {
    return vec3($R);
}
",
        rest: "",
    };

    const HLSL: Self = Self {
        whole: HLSL,
        schlick: "\
// Schlick 1994: r facing the surface, white at grazing.
float3 fresnel_$NAME(float cosTheta) {
    float3 r = float3($R);
    float x = 1.0 - saturate(cosTheta);
    float x2 = x * x;
    return r + (x2 * x2 * x) * (float3(1.0, 1.0, 1.0) - r);
}
",
        constant: "\
float3 fresnel_$NAME(float cosTheta) {
    return float3($R);
}
",
        rest: "",
    };

    const WGSL: Self = Self {
        whole: WGSL,
        schlick: "\
// Schlick 1994: r facing the surface, white at grazing.
fn fresnel_$NAME(cos_theta: f32) -> vec3<f32> {
    let r = vec3<f32>($R);
    let x = 1.0 - clamp(cos_theta, 0.0, 1.0);
    let x2 = x * x;
    return r + (x2 * x2 * x) * (vec3<f32>(1.0) - r);
}
",
        constant: "\
fn fresnel_$NAME(cos_theta: f32) -> vec3<f32> {
    return vec3<f32>($R);
}
",
        rest: "",
    };

    const OSL: Self = Self {
        whole: OSL,
        schlick: "\
// Schlick 1994: r facing the surface, white at grazing.
color fresnel_$NAME(float cosTheta) {
    color r = color($R);
    float x = 1.0 - clamp(cosTheta, 0.0, 1.0);
    float x2 = x * x;
    return r + (x2 * x2 * x) * (color(1.0) - r);
}
",
        constant: "\
color fresnel_$NAME(float cosTheta) {
    return color($R);
}
",
        rest: OSL_SHADER,
    };
}

const GLSL: &str = "\
#ifdef GL_ES
precision highp float;
#endif

#ifndef EDGEWISE_FRESNEL
#define EDGEWISE_FRESNEL
// Hoffman 2023: r facing the surface, h at 81.8 degrees (cosine 1/7), white at grazing.
vec3 edgewise_fresnel(vec3 r, vec3 h, float cosTheta) {
    float c = clamp(cosTheta, 0.0, 1.0);
    float x = 1.0 - c;
    float x2 = x * x;
    vec3 w = vec3(1.0) - r;
    vec3 a = $PEAK_GAIN * (r - h) + $SCHLICK_GAIN * w;
    return r + (x2 * x2 * x) * (w - (c * x) * a);
}
#endif

vec3 fresnel_$NAME(float cosTheta) {
    return edgewise_fresnel(vec3($R), vec3($H), cosTheta);
}
";

const HLSL: &str = "\
#ifndef EDGEWISE_FRESNEL
#define EDGEWISE_FRESNEL
// Hoffman 2023: r facing the surface, h at 81.8 degrees (cosine 1/7), white at grazing.
float3 edgewise_fresnel(float3 r, float3 h, float cosTheta) {
    float c = saturate(cosTheta);
    float x = 1.0 - c;
    float x2 = x * x;
    float3 w = float3(1.0, 1.0, 1.0) - r;
    float3 a = $PEAK_GAIN * (r - h) + $SCHLICK_GAIN * w;
    return r + (x2 * x2 * x) * (w - (c * x) * a);
}
#endif

float3 fresnel_$NAME(float cosTheta) {
    return edgewise_fresnel(float3($R), float3($H), cosTheta);
}
";

const WGSL: &str = "\
// Hoffman 2023: r facing the surface, h at 81.8 degrees (cosine 1/7), white at grazing.
// WGSL cannot guard against a second copy: keep one of this function in a module.
fn edgewise_fresnel(r: vec3<f32>, h: vec3<f32>, cos_theta: f32) -> vec3<f32> {
    let c = clamp(cos_theta, 0.0, 1.0);
    let x = 1.0 - c;
    let x2 = x * x;
    let w = vec3<f32>(1.0) - r;
    let a = $PEAK_GAIN * (r - h) + $SCHLICK_GAIN * w;
    return r + (x2 * x2 * x) * (w - (c * x) * a);
}

fn fresnel_$NAME(cos_theta: f32) -> vec3<f32> {
    return edgewise_fresnel(vec3<f32>($R), vec3<f32>($H), cos_theta);
}
";

const OSL: &str = "\
#ifndef EDGEWISE_FRESNEL
#define EDGEWISE_FRESNEL
// Hoffman 2023: r facing the surface, h at 81.8 degrees (cosine 1/7), white at grazing.
color edgewise_fresnel(color r, color h, float cosTheta) {
    float c = clamp(cosTheta, 0.0, 1.0);
    float x = 1.0 - c;
    float x2 = x * x;
    color w = color(1.0) - r;
    color a = $PEAK_GAIN * (r - h) + $SCHLICK_GAIN * w;
    return r + (x2 * x2 * x) * (w - (c * x) * a);
}
#endif

color fresnel_$NAME(float cosTheta) {
    return edgewise_fresnel(color($R), color($H), cosTheta);
}

shader edgewise_$NAME(output color reflectance = 0.0) {
    reflectance = fresnel_$NAME(abs(dot(I, N)));
}
";
