//! The document as versioned JSON.

use serde_json::{Map, Value, json};
use thiserror::Error;

use super::{Origin, Preset, json, unknown};
use crate::color::{Rgb, RgbSpace, UnknownName};

/// The format this version reads and writes, in the field `edgewise`.
pub const PRESET_FORMAT: u64 = 1;

/// A written t may differ from the derived one by rounding; beyond this it contradicts r and h.
const TINT_TOLERANCE: f64 = 5e-4;

/// A preset as it was read, and what a person should know about its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The document.
    pub preset: Preset,
    /// Sentences: what the file says that the document cannot follow.
    pub warnings: Vec<String>,
}

/// Why a text is no preset, or a preset no text.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum FormatError {
    #[error("it cannot be read as JSON: {0}")]
    Json(#[from] serde_json::Error),
    #[error("it is no Edgewise preset: it must be an object whose field “edgewise” names the format, {PRESET_FORMAT}")]
    NoPreset,
    #[error("it has preset format {0}, and this version of Edgewise reads format {PRESET_FORMAT}")]
    Version(String),
    #[error("the field “{0}” is missing")]
    Missing(&'static str),
    #[error("the field “{field}” must be {expected}, not {found}")]
    Type { field: &'static str, expected: &'static str, found: String },
    #[error(transparent)]
    Space(#[from] UnknownName),
    #[error("the field “origin” cannot be read: {0}")]
    Origin(serde_json::Error),
    #[error("{0} is not finite, and a preset holds finite numbers only")]
    NotFinite(&'static str),
    #[error("the preset “{0}” would not read back as it is, so it was not written")]
    Unfaithful(String),
}

impl Preset {
    /// The document as JSON that people can read and edit. Every number reads back exactly.
    ///
    /// `t` is written for readers that want F82-tint; it is derived again on reading. What would
    /// not read back as this very preset (a NaN somewhere) is an error, never a file. Whoever saves
    /// what a person edited says what [`Preset::lost_fields`] names.
    pub fn to_json(&self) -> Result<String, FormatError> {
        self.check_finite()?;
        let mut document = self.known_fields()?;
        unknown::put_back(&mut document, &self.unknown_fields);
        let text = json::pretty_json(&Value::Object(document));
        match Self::from_json(&text) {
            Ok(Loaded { preset, .. }) if self.is_same_material(&preset) => Ok(text),
            _ => Err(FormatError::Unfaithful(self.name.clone())),
        }
    }

    /// Reads a document. Finite numbers of any size are kept; a `t` that contradicts r and h is a warning.
    pub fn from_json(text: &str) -> Result<Loaded, FormatError> {
        let Value::Object(raw) = json::read(text.trim_start_matches('\u{feff}'))? else {
            return Err(FormatError::NoPreset);
        };
        check_version(raw.get("edgewise"))?;
        let field = |name| Field { name, value: raw.get(name) };
        let mut preset = Self {
            name: field("name").text()?,
            space: field("space").text()?.parse::<RgbSpace>()?,
            r: field("r").rgb()?,
            h: field("h").rgb()?,
            roughness: field("roughness").number()?,
            origin: field("origin").origin()?,
            tags: field("tags").texts_or_none()?,
            notes: field("notes").text_or_empty()?,
            unknown_fields: Map::new(),
        };
        let warnings = preset.contradiction(field("t"))?.into_iter().collect();
        preset.unknown_fields = unknown::left_over(raw, &preset.known_fields()?);
        preset.unknown_fields.shift_remove("t");
        Ok(Loaded { preset, warnings })
    }

    /// Paths of the fields unknown to this version that a file cannot keep: edits took their place away.
    pub fn lost_fields(&self) -> Vec<String> {
        let document = self.known_fields();
        document.map_or_else(|_| Vec::new(), |mut document| unknown::put_back(&mut document, &self.unknown_fields))
    }

    /// Equal but for fields this version does not know, which may have lost their place with an older origin.
    fn is_same_material(&self, other: &Self) -> bool {
        *self == Self { unknown_fields: self.unknown_fields.clone(), ..other.clone() }
    }

    fn check_finite(&self) -> Result<(), FormatError> {
        let is_finite =
            [("r", self.r.is_finite()), ("h", self.h.is_finite()), ("roughness", self.roughness.is_finite())];
        is_finite.into_iter().find(|(_, finite)| !finite).map_or(Ok(()), |(name, _)| Err(FormatError::NotFinite(name)))
    }

    /// Every field of this format, in the order people read them.
    fn known_fields(&self) -> Result<Map<String, Value>, FormatError> {
        let mut fields = Map::new();
        let mut put = |name: &str, value: Value| _ = fields.insert(name.to_owned(), value);
        put("edgewise", json!(PRESET_FORMAT));
        put("name", json!(self.name));
        put("space", json!(self.space));
        put("r", json!(self.r));
        put("h", json!(self.h));
        if self.tint().is_finite() {
            put("t", json!(self.tint()));
        }
        put("roughness", json!(self.roughness));
        put("origin", serde_json::to_value(&self.origin).map_err(FormatError::Origin)?);
        put("tags", json!(self.tags));
        put("notes", json!(self.notes));
        Ok(fields)
    }

    /// The sentence about a `t` in the file that is not the one r and h give.
    fn contradiction(&self, field: Field) -> Result<Option<String>, FormatError> {
        if field.value.is_none() {
            return Ok(None);
        }
        let (written, derived) = (field.rgb()?, self.tint());
        let is_close = written.max_abs_difference(derived) <= TINT_TOLERANCE;
        let sentence =
            || format!("The file's t {:?} is not what r and h give, {:?}; r and h were kept.", written.0, derived.0);
        Ok((!is_close).then(sentence))
    }
}

fn check_version(version: Option<&Value>) -> Result<(), FormatError> {
    match version {
        None => Err(FormatError::NoPreset),
        Some(value) if *value == json!(PRESET_FORMAT) => Ok(()),
        Some(value) => Err(FormatError::Version(excerpt(value))),
    }
}

/// A field of the file, if it is there.
#[derive(Clone, Copy)]
struct Field<'a> {
    name: &'static str,
    value: Option<&'a Value>,
}

impl<'a> Field<'a> {
    fn required(self) -> Result<&'a Value, FormatError> {
        self.value.ok_or(FormatError::Missing(self.name))
    }

    fn wrong(self, expected: &'static str) -> FormatError {
        let found = self.value.map_or_else(|| "missing".to_owned(), excerpt);
        FormatError::Type { field: self.name, expected, found }
    }

    fn text(self) -> Result<String, FormatError> {
        Ok(self.required()?.as_str().ok_or_else(|| self.wrong("a text"))?.to_owned())
    }

    fn text_or_empty(self) -> Result<String, FormatError> {
        if self.value.is_none() { Ok(String::new()) } else { self.text() }
    }

    fn texts_or_none(self) -> Result<Vec<String>, FormatError> {
        let Some(value) = self.value else { return Ok(Vec::new()) };
        serde_json::from_value(value.clone()).map_err(|_| self.wrong("a list of texts"))
    }

    fn number(self) -> Result<f64, FormatError> {
        self.required()?.as_f64().ok_or_else(|| self.wrong("a number"))
    }

    fn rgb(self) -> Result<Rgb, FormatError> {
        serde_json::from_value(self.required()?.clone()).map_err(|_| self.wrong("a list of three numbers"))
    }

    /// A file that names no origin claims none: its colours count as authored.
    fn origin(self) -> Result<Origin, FormatError> {
        self.value
            .map_or(Ok(Origin::Authored), |value| serde_json::from_value(value.clone()))
            .map_err(FormatError::Origin)
    }
}

/// A value as an error names it: short, on one line.
fn excerpt(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= 60 { text } else { format!("{}…", text.chars().take(60).collect::<String>()) }
}
