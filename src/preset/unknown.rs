//! Fields that this version does not know: kept beside the document and written back where they were.

use serde_json::{Map, Value};

/// The field that says which variant an object is; what was left over of one variant is no part of another.
const TAG: &str = "kind";

/// What `raw` holds beyond `known`, at every level of objects and lists. Of a list whose items this version knows,
/// each item keeps its place: `null` stands for one with nothing left over.
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
        (Value::Array(raw), Some(Value::Array(known))) if raw.len() == known.len() => {
            let rest: Vec<Value> =
                raw.into_iter().zip(known).map(|(raw, known)| beyond(raw, Some(known)).unwrap_or_default()).collect();
            rest.iter().any(|item| !item.is_null()).then_some(Value::Array(rest))
        }
        _ => None,
    }
}

/// Writes what was left over back; a field the document knows is the document's. Returns what found no place: the
/// fields of another variant, and those of a list that got longer or shorter, whose items can no longer be told.
pub(super) fn put_back(document: &mut Map<String, Value>, rest: &Map<String, Value>) -> Vec<String> {
    let mut lost = Vec::new();
    for (key, value) in rest.iter().filter(|(key, _)| *key != TAG) {
        match document.get_mut(key) {
            None => _ = document.insert(key.clone(), value.clone()),
            Some(known) => lost.extend(put_back_into(known, value).into_iter().map(|inner| format!("{key}{inner}"))),
        }
    }
    lost
}

/// The same for one value; what is lost is named by the path from it.
fn put_back_into(known: &mut Value, rest: &Value) -> Vec<String> {
    match (known, rest) {
        (Value::Object(inner), Value::Object(rest)) if inner.get(TAG) == rest.get(TAG) => {
            put_back(inner, rest).into_iter().map(|field| format!(".{field}")).collect()
        }
        (Value::Array(items), Value::Array(rest)) if items.len() == rest.len() => {
            let pairs = items.iter_mut().zip(rest).enumerate().filter(|(_, (_, rest))| !rest.is_null());
            pairs
                .flat_map(|(i, (item, rest))| put_back_into(item, rest).into_iter().map(move |f| format!("[{i}]{f}")))
                .collect()
        }
        _ => vec![String::new()],
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
        assert!(put_back(&mut document, &rest).is_empty());
        assert_eq!(document, raw);
    }

    #[test]
    fn items_of_a_list_keep_theirs_while_the_list_keeps_its_length() {
        let raw = object(json!({ "in": { "list": [{ "a": 1, "new": 7 }, { "a": 2 }, [{ "a": 3, "new": 8 }], 4] } }));
        let known = object(json!({ "in": { "list": [{ "a": 1 }, { "a": 2 }, [{ "a": 3 }], 4] } }));
        let rest = left_over(raw.clone(), &known);
        let mut document = known.clone();
        assert!(put_back(&mut document, &rest).is_empty());
        assert_eq!(document, raw);
        let mut shorter = object(json!({ "in": { "list": [{ "a": 1 }] } }));
        assert_eq!(put_back(&mut shorter, &rest), ["in.list"]);
        assert_eq!(Value::Object(shorter), json!({ "in": { "list": [{ "a": 1 }] } }));
        assert!(left_over(known.clone(), &known).is_empty());
    }

    #[test]
    fn another_variant_takes_nothing_over() {
        let rest = object(json!({ "in": { "kind": "x", "new": 1 } }));
        let mut document = object(json!({ "in": { "kind": "y" } }));
        assert_eq!(put_back(&mut document, &rest), ["in"]);
        assert_eq!(Value::Object(document), json!({ "in": { "kind": "y" } }));
    }
}
