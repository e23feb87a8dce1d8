//! MaterialX documents: three ways to say a metal.
//!
//! The numbers are for hosts that work in the document's own colour space. t and g are no colours: a host
//! that converts them shows something else, so there is one file for each working space.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::edge_tint::EdgeTint;
use super::export::Written;
use super::material::Material;
use super::number::{number, triple};
use super::tint::Tint;
use crate::color::Rgb;

/// `open_pbr_surface` (OpenPBR 1.1, MaterialX 1.39): base_color = r, specular_color = t.
///
/// specular_weight is written because hosts of OpenPBR 1.0 multiply t by it.
pub(super) fn open_pbr(header: &[String], material: &Material<'_>, tint: &Tint) -> Written {
    let inputs = [
        Input::float("base_weight", 1.0),
        Input::color("base_color", tint.r),
        Input::float("base_metalness", 1.0),
        Input::float("specular_weight", 1.0),
        Input::color("specular_color", tint.t),
        Input::float("specular_roughness", material.roughness),
    ];
    document("1.39", header, material, |writer, names| {
        node(
            writer,
            "open_pbr_surface",
            &names.shader,
            "surfaceshader",
            &without_tint(inputs, "specular_color", material),
        )
    })
}

/// The edge at 90° of `generalized_schlick_bsdf`, and the power that leads to it.
pub(super) struct Edge {
    pub r90: Rgb,
    pub exponent: f64,
}

impl Edge {
    /// Schlick's.
    pub(super) const SCHLICK: Self = Self { r90: Rgb::WHITE, exponent: 5.0 };
}

/// `generalized_schlick_bsdf` (MaterialX 1.39): color0 = r, color82 = t, and α in both directions.
pub(super) fn generalized_schlick(header: &[String], material: &Material<'_>, tint: &Tint, edge: &Edge) -> Written {
    let alpha = number(material.alpha());
    let inputs = [
        Input::float("weight", 1.0),
        Input::color("color0", tint.r),
        Input::color("color82", tint.t),
        Input::color("color90", edge.r90),
        Input::float("exponent", edge.exponent),
        Input::value("roughness", "vector2", format!("{alpha}, {alpha}")),
        Input::value("scatter_mode", "string", "R".to_owned()),
    ];
    document("1.39", header, material, |writer, names| {
        node(writer, "generalized_schlick_bsdf", &names.bsdf, "BSDF", &without_tint(inputs, "color82", material))?;
        node(writer, "surface", &names.shader, "surfaceshader", &[Input::node("bsdf", "BSDF", &names.bsdf)])
    })
}

/// `standard_surface` (Autodesk 1.0.1, MaterialX 1.38): base_color = r, specular_color = g.
pub(super) fn standard_surface(header: &[String], material: &Material<'_>, fit: &EdgeTint) -> Written {
    let inputs = [
        Input::float("base", 1.0),
        Input::color("base_color", fit.r),
        Input::float("metalness", 1.0),
        Input::float("specular", 1.0),
        Input::color("specular_color", fit.g),
        Input::float("specular_roughness", material.roughness),
    ];
    document("1.38", header, material, |writer, names| {
        node(writer, "standard_surface", &names.shader, "surfaceshader", &inputs)
    })
}

/// All inputs, but for the tint where only r is said: white is what the node has without it.
fn without_tint<const N: usize>(inputs: [Input; N], tint: &str, material: &Material<'_>) -> Vec<Input> {
    inputs.into_iter().filter(|input| material.has_edge() || input.name != tint).collect()
}

/// Names of the nodes of one material.
struct Names {
    material: String,
    shader: String,
    bsdf: String,
}

/// An input of a node: a value, or another node.
struct Input {
    name: &'static str,
    kind: &'static str,
    attribute: &'static str,
    value: String,
}

impl Input {
    fn value(name: &'static str, kind: &'static str, value: String) -> Self {
        Self { name, kind, attribute: "value", value }
    }

    fn float(name: &'static str, value: f64) -> Self {
        Self::value(name, "float", number(value))
    }

    fn color(name: &'static str, value: Rgb) -> Self {
        Self::value(name, "color3", triple(value, ", "))
    }

    fn node(name: &'static str, kind: &'static str, node: &str) -> Self {
        Self { name, kind, attribute: "nodename", value: node.to_owned() }
    }
}

type Xml = Writer<Vec<u8>>;

/// The document around the shader nodes, and the material that uses them.
fn document(
    version: &str,
    header: &[String],
    material: &Material<'_>,
    shader: impl FnOnce(&mut Xml, &Names) -> std::io::Result<()>,
) -> Written {
    let id = &material.identifier;
    let names = Names { material: id.clone(), shader: format!("{id}_shader"), bsdf: format!("{id}_bsdf") };
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    for line in header {
        comment(&mut xml, line)?;
    }
    xml.create_element("materialx")
        .with_attributes([("version", version), ("colorspace", material.space.id())])
        .write_inner_content(|xml| {
            shader(xml, &names)?;
            let input = Input::node("surfaceshader", "surfaceshader", &names.shader);
            node(xml, "surfacematerial", &names.material, "material", &[input])
        })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    Ok(bytes)
}

fn node(xml: &mut Xml, category: &str, name: &str, kind: &str, inputs: &[Input]) -> std::io::Result<()> {
    xml.create_element(category).with_attributes([("name", name), ("type", kind)]).write_inner_content(|xml| {
        for input in inputs {
            let attributes = [("name", input.name), ("type", input.kind), (input.attribute, &input.value)];
            xml.create_element("input").with_attributes(attributes).write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

/// A comment; two hyphens would end it.
pub(super) fn comment(xml: &mut Xml, line: &str) -> std::io::Result<()> {
    let mut text = format!(" {line} ");
    while text.contains("--") {
        text = text.replace("--", "- -");
    }
    xml.write_event(Event::Comment(BytesText::from_escaped(text)))
}
