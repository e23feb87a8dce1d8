//! Rows of a study as JSON.

use serde::Serialize;

use crate::preset::pretty_json;

/// The rows as a list of objects, at full precision; null for what is no finite number.
pub fn rows_to_json<T: Serialize>(rows: &[T]) -> String {
    pretty_json(&serde_json::to_value(rows).expect("flat rows under texts"))
}
