//! The elements of an XML document, read without following anything in it.

use std::collections::HashSet;

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::ImportError;

/// What a material library needs, with room to spare.
const MOST_ELEMENTS: usize = 200_000;
const MOST_ATTRIBUTES: usize = 64;
const DEEPEST_NESTING: usize = 64;

/// An element: its tag, its attributes, and the place of the element around it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Element {
    pub tag: String,
    pub attributes: Vec<(String, String)>,
    pub parent: Option<usize>,
}

impl Element {
    /// The value of an attribute.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }
}

/// Every element in the order of the document.
///
/// A DOCTYPE is refused: it is where entities are declared, and no material has one. Attributes are checked for
/// repetition in linear time, so that a long tag costs no more than its length.
pub(super) fn elements(text: &str) -> Result<Vec<Element>, ImportError> {
    let mut reader = Reader::from_str(text.trim_start_matches('\u{feff}'));
    let mut elements = Vec::<Element>::new();
    let mut open = Vec::<usize>::new();
    loop {
        match reader.read_event().map_err(|error| broken(error.to_string()))? {
            Event::Eof => break,
            Event::DocType(_) => return Err(broken("it has a DOCTYPE")),
            Event::End(_) => _ = open.pop(),
            Event::Start(tag) => {
                let element = element(&tag, open.last().copied())?;
                elements.push(element);
                open.push(elements.len() - 1);
            }
            Event::Empty(tag) => elements.push(element(&tag, open.last().copied())?),
            _ => {}
        }
        if open.len() > DEEPEST_NESTING {
            return Err(broken(format!("it is nested deeper than {DEEPEST_NESTING} levels")));
        }
        if elements.len() > MOST_ELEMENTS {
            return Err(broken(format!("it has more than {MOST_ELEMENTS} elements")));
        }
    }
    if open.is_empty() { Ok(elements) } else { Err(broken("it ends inside an element")) }
}

fn element(tag: &BytesStart<'_>, parent: Option<usize>) -> Result<Element, ImportError> {
    let mut attributes = Vec::new();
    let mut keys = HashSet::new();
    for attribute in tag.attributes().with_checks(false) {
        let attribute = attribute.map_err(|error| broken(error.to_string()))?;
        let key = attribute.key.as_ref().to_owned();
        let value = attribute.normalized_value(XmlVersion::Explicit1_0).map_err(|error| broken(error.to_string()))?;
        if attributes.len() == MOST_ATTRIBUTES {
            return Err(broken(format!("an element has more than {MOST_ATTRIBUTES} attributes")));
        }
        if !keys.insert(key.clone()) {
            return Err(broken(format!("an element has two attributes “{key}”")));
        }
        attributes.push((key, value.into_owned()));
    }
    Ok(Element { tag: tag.name().as_ref().to_owned(), attributes, parent })
}

fn broken(reason: impl Into<String>) -> ImportError {
    ImportError::Xml(reason.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_order_and_parents() {
        let found = elements("<?xml version=\"1.0\"?><a x='1'><b/><c y=\"&lt;2\">text</c></a>").unwrap();
        let tags: Vec<_> = found.iter().map(|e| (e.tag.as_str(), e.parent)).collect();
        assert_eq!(tags, [("a", None), ("b", Some(0)), ("c", Some(0))]);
        assert_eq!((found[0].attribute("x"), found[2].attribute("y")), (Some("1"), Some("<2")));
    }

    #[test]
    fn refuses_hostile_documents_with_a_reason() {
        let bomb = "<!DOCTYPE a [<!ENTITY b \"bbbb\"><!ENTITY c \"&b;&b;&b;\">]><a x=\"&c;\"/>";
        let many: String = (0..200_000).map(|i| format!(" a{i}='1'")).collect();
        for (text, reason) in [
            (bomb.to_owned(), "DOCTYPE"),
            ("<a>".repeat(100_000), "nested"),
            (format!("<a{many}/>"), "attributes"),
            ("<a/>".repeat(300_000), "elements"),
            ("<a x='1' x='2'/>".to_owned(), "two attributes"),
            ("<a x='&unknown;'/>".to_owned(), "XML"),
            ("<a><b></a>".to_owned(), "XML"),
            ("<a>".to_owned(), "ends inside"),
        ] {
            let error = elements(&text).unwrap_err().to_string();
            assert!(error.contains(reason) && error.len() < 300, "{error}");
        }
    }
}
