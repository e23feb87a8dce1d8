//! JSON that hides nothing: twice-given keys are refused, numbers keep their digits, short lists stay on one line.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

/// Objects and arrays inside one another; a preset with a recipe needs seven.
pub(super) const DEEPEST_NESTING: usize = 32;
/// What is nested goes on one line where the line stays within this many characters.
const LINE_WIDTH: usize = 120;

/// Reads one JSON value. Unlike `serde_json::from_str` it refuses an object that gives a key twice.
pub(crate) fn read(text: &str) -> Result<Value, serde_json::Error> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = Strict { depth: 0 }.deserialize(&mut deserializer)?;
    deserializer.end()?;
    Ok(value)
}

/// Builds a [`Value`] at some depth.
#[derive(Clone, Copy)]
struct Strict {
    depth: usize,
}

impl Strict {
    fn deeper<E: Error>(self) -> Result<Self, E> {
        if self.depth == DEEPEST_NESTING {
            return Err(E::custom(format_args!("it is nested deeper than {DEEPEST_NESTING} levels")));
        }
        Ok(Self { depth: self.depth + 1 })
    }
}

impl<'de> DeserializeSeed<'de> for Strict {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Strict {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E: Error>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Value, E> {
        Number::from_f64(value).map(Value::Number).ok_or_else(|| E::custom("a number is not finite"))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_string<E: Error>(self, value: String) -> Result<Value, E> {
        Ok(Value::String(value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let inside = self.deeper()?;
        let mut values = Vec::new();
        while let Some(value) = items.next_element_seed(inside)? {
            values.push(value);
        }
        Ok(Value::Array(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let inside = self.deeper()?;
        let mut object = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            if object.contains_key(&key) {
                return Err(A::Error::custom(format_args!("the key “{key}” is given twice")));
            }
            let value = entries.next_value_seed(inside)?;
            object.insert(key, value);
        }
        Ok(Value::Object(object))
    }
}

/// JSON for people: two spaces for each level, what fits on a line on one line, and a final line break.
pub fn pretty_json(value: &Value) -> String {
    let mut text = String::new();
    match value {
        Value::Object(object) if !object.is_empty() => write_object(&mut text, object, 0),
        value => write_value(&mut text, value, 0),
    }
    text.push('\n');
    text
}

fn write_value(text: &mut String, value: &Value, level: usize) {
    let column = text.len() - text.rfind('\n').map_or(0, |end| end + 1);
    let one_line = one_line(value);
    match value {
        _ if column + one_line.chars().count() <= LINE_WIDTH => text.push_str(&one_line),
        Value::Array(items) if !items.is_empty() => write_array(text, items, level),
        Value::Object(object) if !object.is_empty() => write_object(text, object, level),
        _ => text.push_str(&one_line),
    }
}

fn write_object(text: &mut String, object: &Map<String, Value>, level: usize) {
    text.push('{');
    for (index, (key, value)) in object.iter().enumerate() {
        new_line(text, index, level + 1);
        text.push_str(&format!("{}: ", Value::from(key.as_str())));
        write_value(text, value, level + 1);
    }
    text.push_str(&format!("\n{}}}", "  ".repeat(level)));
}

fn write_array(text: &mut String, items: &[Value], level: usize) {
    text.push('[');
    for (index, item) in items.iter().enumerate() {
        new_line(text, index, level + 1);
        write_value(text, item, level + 1);
    }
    text.push_str(&format!("\n{}]", "  ".repeat(level)));
}

fn new_line(text: &mut String, index: usize, level: usize) {
    let comma = if index == 0 { "" } else { "," };
    text.push_str(&format!("{comma}\n{}", "  ".repeat(level)));
}

/// `{"x": 1, "y": [2, 3]}`. Numbers are the shortest that read back exactly.
fn one_line(value: &Value) -> String {
    let list = |items: Vec<String>| items.join(", ");
    match value {
        Value::Array(items) => format!("[{}]", list(items.iter().map(one_line).collect())),
        Value::Object(object) => {
            let entry = |(key, value): (&String, &Value)| format!("{}: {}", Value::from(key.as_str()), one_line(value));
            format!("{{{}}}", list(object.iter().map(entry).collect()))
        }
        scalar => scalar.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_a_key_given_twice_at_any_level() {
        for text in [r#"{"r": 1, "r": 2}"#, r#"{"a": [{"r": 1, "r": 1}]}"#] {
            assert!(read(text).unwrap_err().to_string().contains("“r” is given twice"), "{text}");
        }
    }

    #[test]
    fn refuses_deep_nesting_and_what_follows_the_value() {
        let nested = |levels: usize| format!("{}{}", "[".repeat(levels), "]".repeat(levels));
        assert!(read(&nested(DEEPEST_NESTING)).is_ok());
        assert!(read(&nested(DEEPEST_NESTING + 1)).unwrap_err().to_string().contains("32 levels"));
        assert!(read(&nested(1_000_000)).is_err());
        assert!(read("{} {}").is_err());
    }

    #[test]
    fn short_lists_stay_on_one_line_and_the_document_does_not() {
        let value =
            serde_json::json!({ "r": [1.04, 0.1, 5e-324], "empty": {}, "long": ["x".repeat(70), "y".repeat(70)] });
        let text = pretty_json(&value);
        assert!(
            text.starts_with("{\n  \"r\": [1.04, 0.1, 5e-324],\n  \"empty\": {},\n  \"long\": [\n    \"xx"),
            "{text}"
        );
        assert_eq!(read(&text).unwrap(), value);
    }
}
