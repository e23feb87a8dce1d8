//! Rows of a study as CSV.

use serde::Serialize;

/// The rows under a header of their field names, at full precision.
///
/// The rows of this module are flat: texts, numbers and names of closed sets.
pub fn rows_to_csv<T: Serialize>(rows: &[T]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("flat rows, written to memory");
    }
    String::from_utf8(writer.into_inner().expect("memory takes everything")).expect("made of strings")
}
