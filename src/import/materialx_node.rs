//! One shader node of a MaterialX document, with its values.

use std::collections::HashMap;

use super::numbers::{number, numbers};
use super::xml::Element;
use super::{ImportError, numbers};
use crate::color::{Rgb, RgbSpace};

/// The elements of a document, with what leads from one to another.
#[derive(Debug)]
pub(super) struct Document {
    elements: Vec<Element>,
    /// Where each named element is; the first of a name counts.
    by_name: HashMap<String, usize>,
    /// The element that has an input from a node of this name.
    user_of: HashMap<String, usize>,
}

impl Document {
    /// Follows the names once, so that every later question is answered in the size of a node.
    pub(super) fn new(elements: Vec<Element>) -> Self {
        let (mut by_name, mut user_of) = (HashMap::new(), HashMap::new());
        for (index, element) in elements.iter().enumerate() {
            if element.tag != "input" {
                if let Some(name) = element.attribute("name") {
                    by_name.entry(name.to_owned()).or_insert(index);
                }
            } else if let (Some(name), Some(parent)) = (element.attribute("nodename"), element.parent) {
                user_of.entry(name.to_owned()).or_insert(parent);
            }
        }
        Self { elements, by_name, user_of }
    }

    /// The element around all others.
    pub(super) fn root(&self) -> Option<&Element> {
        self.elements.first()
    }

    /// Every node with one of these tags.
    pub(super) fn nodes<'a>(&'a self, tags: &'a [&str]) -> impl Iterator<Item = Node<'a>> {
        let indices = (0..self.elements.len()).filter(|&index| tags.contains(&self.elements[index].tag.as_str()));
        indices.map(move |index| Node { document: self, index })
    }
}

/// A node whose inputs can be asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<'a> {
    document: &'a Document,
    index: usize,
}

impl<'a> Node<'a> {
    fn element(self) -> &'a Element {
        &self.document.elements[self.index]
    }

    /// The category of the node.
    pub(super) fn tag(self) -> &'a str {
        &self.element().tag
    }

    /// The name of the node.
    pub(super) fn name(self) -> &'a str {
        self.element().attribute("name").unwrap_or_default()
    }

    /// The name of the material that shows this node, directly or through one other node; else the node's own.
    pub(super) fn material_name(self) -> &'a str {
        let mut name = self.name();
        for _ in 0..2 {
            let Some(&user) = self.document.user_of.get(name) else { break };
            let element = &self.document.elements[user];
            name = element.attribute("name").unwrap_or(name);
            if element.tag == "surfacematerial" {
                return name;
            }
        }
        self.name()
    }

    fn input(self, name: &str) -> Option<&'a Element> {
        let inside = &self.document.elements[self.index + 1..];
        let inside = inside.iter().take_while(|e| e.parent.is_some_and(|parent| parent >= self.index));
        let mut inputs = inside.filter(|e| e.parent == Some(self.index) && e.tag == "input");
        inputs.find(|e| e.attribute("name") == Some(name))
    }

    /// The text of a value; connections to other nodes are refused.
    fn value(self, name: &str) -> Result<Option<&'a str>, ImportError> {
        let Some(input) = self.input(name) else { return Ok(None) };
        match input.attribute("value") {
            Some(value) => Ok(Some(value)),
            None => Err(self.refused(format!("{name} comes from another node, and only plain values can be read"))),
        }
    }

    /// A float, or its default.
    pub(super) fn float(self, name: &str, default: f64) -> Result<f64, ImportError> {
        self.value(name)?.map_or(Ok(default), number)
    }

    /// A color3, or its default.
    pub(super) fn colour(self, name: &str, default: Rgb) -> Result<Rgb, ImportError> {
        self.value(name)?.map_or(Ok(default), numbers::colour)
    }

    /// The first of two α of a vector2, or its default.
    pub(super) fn alpha(self, name: &str, default: f64) -> Result<f64, ImportError> {
        let Some(text) = self.value(name)? else { return Ok(default) };
        match *numbers(text)? {
            [x, y] if x == y => Ok(x),
            _ => {
                Err(self.refused("its roughness differs between two directions, which a preset cannot say".to_owned()))
            }
        }
    }

    /// The node that both inputs come from, if they do.
    pub(super) fn common_source(self, names: [&str; 2]) -> Option<Self> {
        let [first, second] = names.map(|name| self.input(name).and_then(|input| input.attribute("nodename")));
        let name = first.filter(|_| first == second)?;
        let index = *self.document.by_name.get(name)?;
        Some(Self { document: self.document, index })
    }

    /// The space of the node's colours: the tag of its inputs or of what is around it; `None` where nothing says.
    pub(super) fn space(self, names: &[&str]) -> Result<Option<RgbSpace>, ImportError> {
        let tags: Vec<Option<&str>> = names.iter().map(|name| self.tag_of(name)).collect();
        let first = tags.first().copied().flatten();
        if tags.iter().any(|tag| *tag != first) {
            return Err(self.refused("its colours are tagged with different spaces; t and g are no colours".to_owned()));
        }
        let Some(tag) = first.filter(|tag| !tag.is_empty() && *tag != "none") else { return Ok(None) };
        tag.parse().map(Some).map_err(|error: crate::color::UnknownName| self.refused(error.to_string()))
    }

    fn tag_of(self, input: &str) -> Option<&'a str> {
        let own = self.input(input).and_then(|e| e.attribute("colorspace"));
        let mut around = Some(self.index);
        let inherited = std::iter::from_fn(|| {
            let element = &self.document.elements[around?];
            around = element.parent;
            Some(element.attribute("colorspace"))
        });
        own.or_else(|| inherited.flatten().next())
    }

    /// An input that must have one value for r and h to say what the node shows.
    pub(super) fn must_be(self, name: &str, wanted: f64, default: f64) -> Result<(), ImportError> {
        let value = self.float(name, default)?;
        if value == wanted {
            return Ok(());
        }
        Err(self.refused(format!("{name} is {value}; only {wanted} is a metal that r and h can say")))
    }

    /// Layers and directions beyond r, h and roughness, each with the value that switches it off.
    pub(super) fn must_be_off(self, inputs: &[(&str, f64)]) -> Result<(), ImportError> {
        inputs.iter().try_for_each(|&(name, off)| self.must_be(name, off, off))
    }

    /// A text, or a switch, that must be this or absent.
    pub(super) fn must_say(self, name: &str, wanted: &str) -> Result<(), ImportError> {
        match self.value(name)? {
            Some(value) if value.trim() != wanted => {
                Err(self.refused(format!("{name} is {}; only {wanted} can be read", numbers::shortened(value))))
            }
            _ => Ok(()),
        }
    }

    /// Sentences about inputs that are switched on, though a metal lets nothing of them through.
    pub(super) fn hidden(self, names: &'a [&str]) -> impl Iterator<Item = String> + 'a {
        let is_on = move |name: &&&str| self.input(name).is_some() && self.float(name, 0.0).ok() != Some(0.0);
        names.iter().filter(is_on).map(move |name| format!("“{}” has {name}, which no metal shows", self.name()))
    }

    /// An error about this node.
    pub(super) fn refused(self, reason: String) -> ImportError {
        ImportError::metal(self.name(), reason)
    }
}
