//! A Mitsuba 3 scene fragment with a conductor.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use super::export::Written;
use super::material::Material;
use super::materialx::comment;
use super::number::{number, triple};
use crate::color::Rgb;

/// Below this α Mitsuba's microfacet distribution is a mirror by another name.
const SMALLEST_ALPHA: f64 = 1e-4;

/// `roughconductor`, or `conductor` for a mirror, with eta = n and k, to be included in a scene.
pub(super) fn write(header: &[String], material: &Material<'_>, (n, k): (Rgb, Rgb)) -> Written {
    let is_rough = material.alpha() >= SMALLEST_ALPHA;
    let plugin = if is_rough { "roughconductor" } else { "conductor" };
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 4);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    for line in header {
        comment(&mut xml, line)?;
    }
    xml.create_element("scene").with_attribute(("version", "3.0.0")).write_inner_content(|xml| {
        let bsdf = xml.create_element("bsdf").with_attributes([("type", plugin), ("id", &material.identifier)]);
        bsdf.write_inner_content(|xml| {
            let mut value = |tag: &str, name: &str, value: &str| {
                xml.create_element(tag).with_attributes([("name", name), ("value", value)]).write_empty().map(drop)
            };
            if is_rough {
                value("string", "distribution", "ggx")?;
                value("float", "alpha", &number(material.alpha()))?;
            }
            value("rgb", "eta", &triple(n, ", "))?;
            value("rgb", "k", &triple(k, ", "))
        })?;
        Ok(())
    })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    Ok(bytes)
}
