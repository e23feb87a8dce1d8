//! Fields that this version does not know: kept beside the document and written back where they were.

use serde_json::{Map, Value};

/// The field that says which variant an object is; what was left over of one variant is no part of another.
const TAG: &str = "kind";

/// What `raw` holds beyond `known`, at every level of objects. Lists are taken as a whole.
pub(super) fn left_over(raw: Map<String, Value>, known: &Map<String, Value>) -> Map<String, Value> {
    let mut rest: Map<String, Value> =
        raw.into_iter().filter_map(|(key, value)| Some((key.clone(), beyond(value, known.get(&key))?))).collect();
    if !rest.is_empty()
        && let Some(tag) = known.get(TAG)
    {
        rest.insert(TAG.to_owned(), tag.clone());
    }
    rest
}

fn beyond(raw: Value, known: Option<&Value>) -> Option<Value> {
    match (raw, known) {
        (raw, None) => Some(raw),
        (Value::Object(raw), Some(Value::Object(known))) => {
            let rest = left_over(raw, known);
            (!rest.is_empty()).then_some(Value::Object(rest))
        }
        _ => None,
    }
}

/// Writes what was left over back; a field the document knows is the document's.
pub(super) fn put_back(document: &mut Map<String, Value>, rest: &Map<String, Value>) {
    for (key, value) in rest {
        match (document.get_mut(key), value) {
            (None, value) => _ = document.insert(key.clone(), value.clone()),
            (Some(Value::Object(inner)), Value::Object(rest)) if inner.get(TAG) == rest.get(TAG) => {
                put_back(inner, rest)
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn object(value: Value) -> Map<String, Value> {
        value.as_object().unwrap().clone()
    }

    #[test]
    fn what_was_left_over_returns_to_its_place() {
        let raw = object(json!({ "a": 1, "new": [1], "in": { "kind": "x", "b": 2, "new": null } }));
        let known = object(json!({ "a": 1, "in": { "kind": "x", "b": 2 } }));
        let rest = left_over(raw.clone(), &known);
        assert_eq!(Value::Object(rest.clone()), json!({ "new": [1], "in": { "kind": "x", "new": null } }));
        let mut document = known;
        put_back(&mut document, &rest);
        assert_eq!(document, raw);
    }

    #[test]
    fn another_variant_takes_nothing_over() {
        let rest = object(json!({ "in": { "kind": "x", "new": 1 } }));
        let mut document = object(json!({ "in": { "kind": "y" } }));
        put_back(&mut document, &rest);
        assert_eq!(Value::Object(document), json!({ "in": { "kind": "y" } }));
    }
}
