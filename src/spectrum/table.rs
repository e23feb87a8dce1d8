//! The tables under `assets/cie`, one row per nanometre.

use super::grid::{FIRST_NM, SAMPLES};

/// Columns `names` of a built-in table whose first column is `wavelength_nm`.
///
/// # Panics
/// If the table is not the one this program was written for; a unit test reads every table.
pub(super) fn columns<const N: usize>(table: &str, names: [&str; N]) -> [Vec<f64>; N] {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(table.as_bytes());
    let header = reader.headers().expect("a header row").clone();
    let indices = names.map(|name| header.iter().position(|h| h == name).expect("the named column"));
    let mut columns = names.map(|_| Vec::with_capacity(SAMPLES));
    for (row, record) in reader.records().enumerate() {
        let record = record.expect("a row of the table");
        let number = |column: usize| record[column].trim().parse::<f64>().expect("a number");
        assert_eq!(number(0), (FIRST_NM + row) as f64, "rows are whole nanometres");
        for (column, index) in columns.iter_mut().zip(indices) {
            column.push(number(index));
        }
    }
    assert!(columns.iter().all(|column| column.len() == SAMPLES), "rows cover the visible");
    columns
}
