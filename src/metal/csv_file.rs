//! n and k from a CSV: the built-in files, and a person's own.

use std::collections::BTreeMap;

use thiserror::Error;

use super::{Metal, NkTable, NkTableError, Provenance};

/// Why a text is no CSV of n and k.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum NkCsvError {
    #[error("the first row must be “wavelength_nm,n,k” or “wavelength_um,n,k”, not “{0}”{hint}", hint = hint(.0))]
    Header(String),
    #[error("row {row}: “{text}” is no number{hint}", hint = hint(text))]
    Number { row: usize, text: String },
    #[error("row {row} has {found} columns instead of 3; write decimals with a point, not a comma")]
    Columns { row: usize, found: usize },
    #[error(transparent)]
    Csv(#[from] csv::Error),
    #[error(transparent)]
    Table(#[from] NkTableError),
}

/// What may be wrong with a text where a name or a number was expected.
fn hint(text: &str) -> &'static str {
    match text {
        _ if text.contains(';') => "; columns are separated by commas",
        _ if text.contains(',') && text.parse::<f64>().is_err() && text.starts_with(|c: char| c.is_ascii_digit()) => {
            "; write decimals with a point, not a comma"
        }
        _ => "",
    }
}

/// Reads a metal from CSV text. `stem` names it where the header does not.
///
/// Lines `# key: value` before the header are provenance; the columns are `wavelength_nm` (or
/// `wavelength_um`), `n` and `k`, in that order.
pub fn metal_from_csv(stem: &str, text: &str) -> Result<Metal, NkCsvError> {
    let text = text.trim_start_matches('\u{feff}');
    let mut keys = header_keys(text);
    let table = NkTable::new(rows(text)?)?;
    let mut take = |key: &str| keys.remove(key).unwrap_or_default();
    let id = non_empty(take("id"), stem);
    let name = non_empty(take("name"), stem);
    let mut metal = Metal::from_table(id, name, table);
    metal.symbol = take("symbol");
    metal.category = non_empty(take("category"), "own data");
    metal.dataset = take("dataset");
    metal.is_preferred = take("preferred") != "false";
    metal.not_measured = take("not_measured");
    metal.provenance = Provenance {
        authors: take("authors"),
        year: take("year"),
        title: take("title"),
        reference: take("reference"),
        doi: take("doi"),
        url: take("url"),
        licence: take("licence"),
        range_nm: take("range_nm"),
        comments: [take("comments"), take("derived")]
            .into_iter()
            .filter(|s| !s.is_empty())
            .collect::<Vec<_>>()
            .join(" "),
    };
    Ok(metal)
}

fn non_empty(text: String, otherwise: &str) -> String {
    if text.is_empty() { otherwise.to_owned() } else { text }
}

fn header_keys(text: &str) -> BTreeMap<String, String> {
    text.lines()
        .take_while(|line| line.starts_with('#'))
        .filter_map(|line| line.trim_start_matches('#').split_once(':'))
        .map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
        .collect()
}

fn rows(text: &str) -> Result<Vec<(f64, f64, f64)>, NkCsvError> {
    let mut reader =
        csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).flexible(true).from_reader(text.as_bytes());
    let header = reader.headers()?.iter().collect::<Vec<_>>().join(",");
    let nm_per_unit = match header.as_str() {
        "wavelength_nm,n,k" => 1.0,
        "wavelength_um,n,k" => 1000.0,
        _ => return Err(NkCsvError::Header(header.chars().take(80).collect())),
    };
    reader.records().enumerate().map(|(index, record)| row(index + 1, &record?, nm_per_unit)).collect()
}

fn row(row: usize, record: &csv::StringRecord, nm_per_unit: f64) -> Result<(f64, f64, f64), NkCsvError> {
    if record.len() != 3 {
        return Err(NkCsvError::Columns { row, found: record.len() });
    }
    let number = |column: usize| {
        record[column]
            .parse::<f64>()
            .map_err(|_| NkCsvError::Number { row, text: record[column].chars().take(40).collect() })
    };
    Ok((number(0)? * nm_per_unit, number(1)?, number(2)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: &str = "400,1,2\n450,1,2\n500,1,2\n550,1,2\n600,1,2\n650,1,2\n700,1,2\n";

    #[test]
    fn reads_nanometres_and_micrometres() {
        let nm = metal_from_csv("mine", &format!("wavelength_nm,n,k\n{ROWS}")).unwrap();
        let um_rows = "0.4,1,2\n0.45,1,2\n0.5,1,2\n0.55,1,2\n0.6,1,2\n0.65,1,2\n0.7,1,2\n";
        let um = metal_from_csv("mine", &format!("# name: Mine\nwavelength_um, n, k\n{um_rows}")).unwrap();
        assert_eq!((nm.name.as_str(), um.name.as_str()), ("mine", "Mine"));
        assert_eq!(nm.table(), um.table());
    }

    #[test]
    fn refuses_with_a_reason() {
        let reason = |text: &str| metal_from_csv("x", text).unwrap_err().to_string();
        assert!(reason("").contains("first row"));
        assert!(reason(&format!("nm,n,k\n{ROWS}")).contains("wavelength_nm"));
        assert!(reason("wavelength_nm,n,k\n400,1,2,5,3\n").contains("decimals with a point"));
        assert!(reason("wavelength_nm;n;k\n400;1;2\n").contains("separated by commas"));
        assert!(reason("wavelength_nm,n,k\n400,\"0,2\",2\n").contains("decimals with a point"));
        assert!(reason("wavelength_nm,n,k\n400,0,2,2,5\n").contains("decimals with a point"));
        assert!(reason("wavelength_nm,n,k\n400,x,2\n").contains("“x” is no number"));
        assert!(reason("wavelength_nm,n,k\n400,NaN,2\n").contains("n is NaN"));
        assert!(reason(&format!("wavelength_um,n,k\n{ROWS}")).contains("unit"));
        let angstroms = "4000,1,2\n5000,1,2\n6000,1,2\n7000,1,2\n";
        assert!(reason(&format!("wavelength_nm,n,k\n{angstroms}")).contains("unit"));
        assert!(reason("wavelength_ev,n,k\n1.8,1,2\n3,1,2\n").contains("wavelength_nm"));
    }

    #[test]
    fn refuses_rows_that_are_no_measurement_of_the_visible() {
        let reason = |rows: &str| metal_from_csv("x", &format!("wavelength_nm,n,k\n{rows}")).unwrap_err().to_string();
        assert!(reason("400,1,2\n400,1,2\n").contains("row 2: the wavelength 400 nm does not follow 400 nm"));
        assert!(reason("500,1,2\n450,1,2\n").contains("must grow"));
        assert!(reason("400,-1,2\n").contains("row 1: n is -1; it must be a finite number of at least 0"));
        assert!(reason("400,1,-2\n").contains("k is -2"));
        assert!(reason("-400,1,2\n").contains("the wavelength is -400"));
        assert!(reason("400,1,inf\n").contains("k is inf"));
        assert!(reason("400,1,2\n520,1,2\n600,1,2\n700,1,2\n").contains("no row between 400 and 520 nm"));
        assert!(reason("500,1,2\n600,1,2\n700,1,2\n").contains("middle of the visible"));
    }

    #[test]
    fn ends_that_are_held_are_told() {
        let metal = metal_from_csv("mine", &format!("wavelength_nm,n,k\n{ROWS}")).unwrap();
        assert_eq!(metal.remarks(), ["The data cover 400–700 nm; n and k are held outside."]);
        let calculated = metal_from_csv("mine", &format!("# not_measured: a guess\nwavelength_nm,n,k\n{ROWS}"));
        assert_eq!(calculated.unwrap().remarks()[0], "This is no measurement but a guess.");
    }
}
