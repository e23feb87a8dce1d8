//! MaterialX: the four nodes that describe a metal.

use super::imported::{Found, Imported};
use super::materialx_node::{Document, Node};
use super::{ImportError, xml};
use crate::color::{Rgb, RgbSpace};
use crate::fresnel::{ARTISTIC_IOR_MAX_R, FresnelModel};

const METALS: [&str; 4] = ["open_pbr_surface", "generalized_schlick_bsdf", "standard_surface", "conductor_bsdf"];

/// Every metal of a document. One that cannot be read is noted; if none can, its reason is the error.
pub(super) fn read(text: &str, space: Option<RgbSpace>) -> Result<Imported, ImportError> {
    let document = Document::new(xml::elements(text)?);
    if document.root().is_none_or(|root| root.tag != "materialx") {
        return Err(ImportError::Xml("its root is not <materialx>".to_owned()));
    }
    let mut imported = Imported::default();
    let mut refusal = None;
    for node in document.nodes(&METALS) {
        let added = found(node, space, &mut imported).and_then(|found| imported.add(found));
        if let Err(error) = added {
            imported.notes.push(error.to_string());
            refusal = refusal.or(Some(error));
        }
    }
    if imported.presets.is_empty() {
        return Err(refusal.unwrap_or(ImportError::NoMetal("the document")));
    }
    Ok(imported)
}

fn found(node: Node<'_>, space: Option<RgbSpace>, imported: &mut Imported) -> Result<Found, ImportError> {
    let (names, read): (&[&str], Reader) = match node.tag() {
        "open_pbr_surface" => (&["base_color", "specular_color"], open_pbr),
        "generalized_schlick_bsdf" => (&["color0", "color82"], generalized_schlick),
        "standard_surface" => (&["base_color", "specular_color"], standard_surface),
        _ => (&["ior", "extinction"], conductor),
    };
    let (model, roughness) = read(node, imported)?;
    let space = node.space(names)?.or(space);
    let name = node.material_name().to_owned();
    let space = imported.space_or_assumed(space, &format!("“{name}”"));
    Ok(Found { name, space, model, roughness: Some(roughness) })
}

type Reader = fn(Node<'_>, &mut Imported) -> Result<(FresnelModel, f64), ImportError>;

/// The lobes around OpenPBR's metal; specular_weight dims its edge, and so is on when it is off 1.
const OPEN_PBR_OFF: [(&str, f64); 7] = [
    ("specular_weight", 1.0),
    ("specular_roughness_anisotropy", 0.0),
    ("coat_weight", 0.0),
    ("fuzz_weight", 0.0),
    ("thin_film_weight", 0.0),
    ("emission_luminance", 0.0),
    ("geometry_opacity", 1.0),
];

/// The lobes around Standard Surface's metal.
const STANDARD_SURFACE_OFF: [(&str, f64); 4] =
    [("specular_anisotropy", 0.0), ("coat", 0.0), ("thin_film_thickness", 0.0), ("emission", 0.0)];

/// OpenPBR 1.1 with the defaults of MaterialX 1.39: base_weight scales r, specular_weight would scale the edge too.
fn open_pbr(node: Node<'_>, imported: &mut Imported) -> Result<(FresnelModel, f64), ImportError> {
    node.must_be("base_metalness", 1.0, 0.0)?;
    node.must_be_off(&OPEN_PBR_OFF)?;
    imported.notes.extend(node.hidden(&["transmission_weight", "subsurface_weight"]));
    let r = node.colour("base_color", Rgb::splat(0.8))? * node.float("base_weight", 1.0)?;
    let t = node.colour("specular_color", Rgb::WHITE)?;
    Ok((FresnelModel::F82Tint { r, t }, node.float("specular_roughness", 0.3)?))
}

/// A BSDF that reflects all of its light, mirrored, without an interference film.
fn plain_reflection(node: Node<'_>) -> Result<(), ImportError> {
    node.must_be_off(&[("weight", 1.0), ("thinfilm_thickness", 0.0)])?;
    node.must_say("retroreflective", "false")?;
    node.must_say("scatter_mode", "R")
}

/// With a white edge and an exponent of 5 it is F82-tint, which is exact.
fn generalized_schlick(node: Node<'_>, _: &mut Imported) -> Result<(FresnelModel, f64), ImportError> {
    plain_reflection(node)?;
    let [r0, t, r90] = ["color0", "color82", "color90"].map(|name| node.colour(name, Rgb::WHITE));
    let (r0, t, r90, p) = (r0?, t?, r90?, node.float("exponent", 5.0)?);
    if p <= 0.0 {
        return Err(node.refused(format!("exponent is {p}; it must be above 0")));
    }
    let roughness = node.alpha("roughness", 0.05)?.sqrt();
    if r90 == Rgb::WHITE && p == 5.0 {
        return Ok((FresnelModel::F82Tint { r: r0, t }, roughness));
    }
    Ok((FresnelModel::GeneralizedSchlick { r0, t, r90, p }, roughness))
}

/// Autodesk Standard Surface 1.0.1: (r, g) through artistic_ior.
fn standard_surface(node: Node<'_>, imported: &mut Imported) -> Result<(FresnelModel, f64), ImportError> {
    node.must_be("metalness", 1.0, 0.0)?;
    node.must_be_off(&STANDARD_SURFACE_OFF)?;
    if node.colour("opacity", Rgb::WHITE)? != Rgb::WHITE {
        return Err(node.refused("its opacity is not 1; only an opaque metal can be read".to_owned()));
    }
    imported.notes.extend(node.hidden(&["transmission", "subsurface", "sheen"]));
    let r = node.colour("base_color", Rgb::splat(0.8))? * node.float("base", 1.0)?;
    let g = node.colour("specular_color", Rgb::WHITE)? * node.float("specular", 1.0)?;
    Ok((artistic_ior(node, r, g, imported), node.float("specular_roughness", 0.2)?))
}

/// n and k as values, or r and g through an artistic_ior node.
fn conductor(node: Node<'_>, imported: &mut Imported) -> Result<(FresnelModel, f64), ImportError> {
    plain_reflection(node)?;
    let roughness = node.alpha("roughness", 0.05)?.sqrt();
    if let Some(source) = node.common_source(["ior", "extinction"]).filter(|source| source.tag() == "artistic_ior") {
        let r = source.colour("reflectivity", Rgb([0.944, 0.776, 0.373]))?;
        let g = source.colour("edge_color", Rgb([0.998, 0.981, 0.751]))?;
        return Ok((artistic_ior(node, r, g, imported), roughness));
    }
    let n = node.colour("ior", Rgb([0.183, 0.421, 1.373]))?;
    let k = node.colour("extinction", Rgb([3.424, 2.346, 1.770]))?;
    Ok((FresnelModel::Conductor { n, k }, roughness))
}

/// What MaterialX shows for r and g.
fn artistic_ior(node: Node<'_>, r: Rgb, g: Rgb, imported: &mut Imported) -> FresnelModel {
    let clipped = r.map(|r| r.clamp(0.0, ARTISTIC_IOR_MAX_R));
    if clipped != r {
        imported.notes.push(format!("“{}” has r outside 0–0.99, which MaterialX clips, and so does this", node.name()));
    }
    FresnelModel::Gulbrandsen { r: clipped, g }
}
