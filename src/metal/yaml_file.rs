//! n and k from a file of refractiveindex.info.

use serde::Deserialize;
use thiserror::Error;

use super::dispersion::refractive_index;
use super::{Metal, NkTable, NkTableError, Provenance};
use crate::spectrum::{FIRST_NM, LAST_NM};

/// Why a text is no file of refractiveindex.info with n and k.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is said in its message")]
pub enum NkYamlError {
    #[error("it is no file of refractiveindex.info: {0}")]
    Yaml(String),
    #[error("it has no {0}; a metal needs both n and k")]
    Missing(&'static str),
    #[error("it gives {0} twice")]
    Twice(&'static str),
    #[error("it has data of the type “{0}”, which is none of: tabulated nk, tabulated n, tabulated k, formula 1 to 9")]
    Type(String),
    #[error("data row {row}: “{text}” is no number{}", if text.contains(',') { "; write decimals with a point, not a comma" } else { "" })]
    Number { row: usize, text: String },
    #[error("data row {row} has {found} columns instead of {wanted}")]
    Columns { row: usize, found: usize, wanted: usize },
    #[error("{name}: {source}")]
    Column { name: &'static str, source: NkTableError },
    #[error("the formula gives n = {n} at {wavelength_nm} nm, which is inside the range it is stated for")]
    FormulaOutOfRange { n: f64, wavelength_nm: f64 },
    #[error("its n and k have no wavelength in common")]
    NoOverlap,
    #[error(transparent)]
    Table(#[from] NkTableError),
}

/// The parts of the file that matter here; the rest is left alone.
#[derive(Deserialize)]
struct File {
    #[serde(rename = "REFERENCES", default)]
    references: String,
    #[serde(rename = "COMMENTS", default)]
    comments: String,
    #[serde(rename = "DATA")]
    data: Vec<Block>,
}

#[derive(Deserialize)]
struct Block {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    data: String,
    #[serde(default)]
    wavelength_range: String,
    #[serde(default)]
    coefficients: String,
}

/// Reads a metal from the text of a refractiveindex.info file, whose wavelengths are in µm.
///
/// Takes `tabulated nk`, or n and k apart: `tabulated n` or a `formula 1` to `9`, with a `tabulated k`. Where their
/// wavelengths differ, both are interpolated linearly, over the range they share. `stem` names the metal.
pub fn metal_from_yaml(stem: &str, text: &str) -> Result<Metal, NkYamlError> {
    let parsed = serde_saphyr::from_str::<File>(text.trim_start_matches('\u{feff}'));
    let file = parsed.map_err(|error| NkYamlError::Yaml(first_line(&error.without_snippet().to_string())))?;
    let (n, k) = columns(&file.data)?;
    let table = NkTable::new(joined(&n, &k)?)?;
    let mut metal = Metal::from_table(stem.to_owned(), stem.to_owned(), table);
    metal.provenance = provenance(&file, text, n.range_nm(), k.range_nm());
    Ok(metal)
}

fn first_line(message: &str) -> String {
    message.lines().next().unwrap_or_default().to_owned()
}

/// A quantity over wavelength, growing.
struct Column {
    wavelength_nm: Vec<f64>,
    values: Vec<f64>,
}

impl Column {
    /// Checks what the table cannot once both columns are joined: every row of each, in the order of the file.
    fn new(name: &'static str, rows: impl IntoIterator<Item = (f64, f64)>) -> Result<Self, NkYamlError> {
        let mut column = Self { wavelength_nm: Vec::new(), values: Vec::new() };
        for (index, (wavelength_nm, value)) in rows.into_iter().enumerate() {
            NkTable::check_row(index + 1, column.wavelength_nm.last().copied(), wavelength_nm, &[(name, value)])
                .map_err(|source| NkYamlError::Column { name, source })?;
            column.wavelength_nm.push(wavelength_nm);
            column.values.push(value);
        }
        match column.values.is_empty() {
            true => Err(NkYamlError::Column { name, source: NkTableError::Empty }),
            false => Ok(column),
        }
    }

    /// First and last wavelength; a column has a row at least.
    fn range_nm(&self) -> (f64, f64) {
        let last = self.wavelength_nm.len() - 1;
        (self.wavelength_nm[0], self.wavelength_nm[last])
    }

    /// Linear between rows, held beyond them.
    fn at(&self, wavelength_nm: f64) -> f64 {
        let last = self.wavelength_nm.len() - 1;
        let above = self.wavelength_nm.partition_point(|nm| *nm <= wavelength_nm);
        if above == 0 || above > last {
            return self.values[above.min(last)];
        }
        let (low, high) = (self.wavelength_nm[above - 1], self.wavelength_nm[above]);
        let weight = (wavelength_nm - low) / (high - low);
        self.values[above - 1] + (self.values[above] - self.values[above - 1]) * weight
    }
}

/// n and k, from whichever blocks hold them.
fn columns(blocks: &[Block]) -> Result<(Column, Column), NkYamlError> {
    let (mut n, mut k) = (None, None);
    for block in blocks {
        match block.kind.trim() {
            "tabulated nk" => {
                let rows = numbers::<3>(&block.data)?;
                put(&mut n, "n", Column::new("n", rows.iter().map(|[um, n, _]| (um * NM_PER_UM, *n)))?)?;
                put(&mut k, "k", Column::new("k", rows.iter().map(|[um, _, k]| (um * NM_PER_UM, *k)))?)?;
            }
            "tabulated n" => {
                let rows = numbers::<2>(&block.data)?;
                put(&mut n, "n", Column::new("n", rows.iter().map(|[um, n]| (um * NM_PER_UM, *n)))?)?;
            }
            "tabulated k" => {
                let rows = numbers::<2>(&block.data)?;
                put(&mut k, "k", Column::new("k", rows.iter().map(|[um, k]| (um * NM_PER_UM, *k)))?)?;
            }
            kind => put(&mut n, "n", by_formula(kind, block)?)?,
        }
    }
    Ok((n.ok_or(NkYamlError::Missing("n"))?, k.ok_or(NkYamlError::Missing("k"))?))
}

const NM_PER_UM: f64 = 1000.0;

fn put(slot: &mut Option<Column>, name: &'static str, column: Column) -> Result<(), NkYamlError> {
    match slot.replace(column) {
        None => Ok(()),
        Some(_) => Err(NkYamlError::Twice(name)),
    }
}

/// n of a dispersion formula at every whole nanometre of the visible that its range covers, and at the range's ends.
fn by_formula(kind: &str, block: &Block) -> Result<Column, NkYamlError> {
    let number = kind.strip_prefix("formula ").and_then(|number| number.trim().parse::<u32>().ok());
    let formula = number.filter(|number| (1..=9).contains(number)).ok_or_else(|| NkYamlError::Type(kind.to_owned()))?;
    let [first_um, last_um] = row::<2>(1, &block.wavelength_range)?;
    let coefficients: Vec<f64> =
        block.coefficients.split_whitespace().map(|text| parsed(1, text)).collect::<Result<_, _>>()?;
    let visible = |um: f64| (um * NM_PER_UM).clamp(FIRST_NM as f64, LAST_NM as f64);
    let (first, last) = (visible(first_um), visible(last_um));
    let between = (FIRST_NM..=LAST_NM).map(|nm| nm as f64).filter(|nm| *nm > first && *nm < last);
    let mut wavelengths = vec![first];
    wavelengths.extend(between);
    wavelengths.extend((last > first).then_some(last));
    let rows = wavelengths.into_iter().map(|nm| {
        let n = refractive_index(formula, &coefficients, nm / NM_PER_UM).unwrap_or(f64::NAN);
        if n.is_finite() && n >= 0.0 {
            Ok((nm, n))
        } else {
            Err(NkYamlError::FormulaOutOfRange { n, wavelength_nm: nm })
        }
    });
    Column::new("n", rows.collect::<Result<Vec<_>, _>>()?)
}

/// Rows at the wavelengths of both columns, where they overlap.
fn joined(n: &Column, k: &Column) -> Result<Vec<(f64, f64, f64)>, NkYamlError> {
    let (n_range, k_range) = (n.range_nm(), k.range_nm());
    let (first, last) = (n_range.0.max(k_range.0), n_range.1.min(k_range.1));
    let mut wavelengths: Vec<f64> = n.wavelength_nm.iter().chain(&k.wavelength_nm).copied().collect();
    wavelengths.retain(|nm| (first..=last).contains(nm));
    wavelengths.sort_by(f64::total_cmp);
    wavelengths.dedup();
    match wavelengths.is_empty() {
        true => Err(NkYamlError::NoOverlap),
        false => Ok(wavelengths.into_iter().map(|nm| (nm, n.at(nm), k.at(nm))).collect()),
    }
}

fn numbers<const N: usize>(data: &str) -> Result<Vec<[f64; N]>, NkYamlError> {
    let lines = data.lines().filter(|line| !line.trim().is_empty());
    lines.enumerate().map(|(index, line)| row(index + 1, line)).collect()
}

fn row<const N: usize>(row: usize, line: &str) -> Result<[f64; N], NkYamlError> {
    let numbers = line.split_whitespace().map(|text| parsed(row, text)).collect::<Result<Vec<f64>, _>>()?;
    let found = numbers.len();
    numbers.try_into().map_err(|_| NkYamlError::Columns { row, found, wanted: N })
}

fn parsed(row: usize, text: &str) -> Result<f64, NkYamlError> {
    text.parse().map_err(|_| NkYamlError::Number { row, text: text.chars().take(40).collect() })
}

/// What the file says about its source: the lines of REFERENCES are authors, title and publication.
fn provenance(file: &File, text: &str, n_nm: (f64, f64), k_nm: (f64, f64)) -> Provenance {
    let plain = without_tags(&file.references);
    let mut lines = plain.lines().map(|line| line.trim().trim_end_matches('.').to_owned());
    let (authors, title) = (lines.next().unwrap_or_default(), lines.next().unwrap_or_default());
    Provenance {
        authors,
        title,
        year: year(&plain),
        reference: lines.collect::<Vec<_>>().join(" ").trim().to_owned(),
        doi: doi(&file.references),
        licence: if text.contains("CC0") { "CC0 1.0".to_owned() } else { String::new() },
        range_nm: format!("{}..{}", n_nm.0.max(k_nm.0), n_nm.1.min(k_nm.1)),
        comments: without_tags(&file.comments).split_whitespace().collect::<Vec<_>>().join(" "),
        ..Provenance::default()
    }
}

/// The text between `<` and `>` left out.
fn without_tags(html: &str) -> String {
    let mut plain = String::with_capacity(html.len());
    let mut is_tag = false;
    for character in html.chars() {
        match character {
            '<' => is_tag = true,
            '>' if is_tag => is_tag = false,
            _ if !is_tag => plain.push(character),
            _ => {}
        }
    }
    plain
}

/// The first number in parentheses that is a year.
fn year(text: &str) -> String {
    let in_parentheses = text.split('(').skip(1).filter_map(|rest| rest.split(')').next());
    let is_year = |word: &&str| word.len() == 4 && word.bytes().all(|byte| byte.is_ascii_digit());
    in_parentheses.map(str::trim).find(is_year).unwrap_or_default().to_owned()
}

/// What follows `doi.org/` in the first link.
fn doi(html: &str) -> String {
    let after = html.split("doi.org/").nth(1).unwrap_or_default();
    after.split(['"', '<', '>', ' ', '\n']).next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::metal::metal_by_name;

    const TABLE: &str =
        "0.38 1.5 2\n0.45 1.4 2\n0.5 1.3 2.5\n0.55 1 2.6\n0.6 0.5 3\n0.65 0.3 3.5\n0.7 0.2 4\n0.8 0.2 5\n";

    fn indented(rows: &str) -> String {
        rows.lines().map(|line| format!("        {line}\n")).collect()
    }

    fn file(blocks: &[(&str, &str)]) -> String {
        let block = |(kind, rows): &(&str, &str)| format!("  - type: {kind}\n    data: |\n{}", indented(rows));
        format!(
            "REFERENCES: |\n    A. Author, B. Other.\n    A title.\n    <a href=\"https://doi.org/10.1/x\">J. <b>1</b>, 2 (1999)</a>\nCOMMENTS: |\n    Film\nDATA:\n{}",
            blocks.iter().map(block).collect::<String>()
        )
    }

    fn column(index: usize) -> String {
        TABLE
            .lines()
            .map(|line| {
                let parts: Vec<&str> = line.split(' ').collect();
                format!("{} {}\n", parts[0], parts[index])
            })
            .collect()
    }

    #[test]
    fn reads_n_and_k_together_or_apart() {
        let together = metal_from_yaml("mine", &file(&[("tabulated nk", TABLE)])).unwrap();
        let apart = file(&[("tabulated n", &column(1)), ("tabulated k", &column(2))]);
        assert_eq!(together.table(), metal_from_yaml("mine", &apart).unwrap().table());
        assert_eq!(together.provenance.citation(), "Author & Other 1999");
        assert_eq!((together.provenance.doi.as_str(), together.provenance.title.as_str()), ("10.1/x", "A title"));
        assert!(together.held_ends().is_none());
    }

    #[test]
    fn joins_different_grids_exactly_and_says_where_they_end() {
        let coarse_k = "0.4 2\n0.48 2.4\n0.56 2.8\n0.64 3.2\n0.72 3.6\n";
        let metal = metal_from_yaml("mine", &file(&[("tabulated n", &column(1)), ("tabulated k", coarse_k)])).unwrap();
        for nm in [400.0, 450.0, 512.0, 600.0, 720.0] {
            assert!((metal.table().at(nm).k - nm / 200.0).abs() < 1e-12, "{nm}");
        }
        assert!((metal.table().at(525.0).n - 1.15).abs() < 1e-12);
        assert_eq!((metal.held_ends().below_nm, metal.held_ends().above_nm), (Some(400.0), Some(720.0)));
    }

    #[test]
    fn reads_a_formula_with_a_table_of_k() {
        let text = "DATA:\n  - type: formula 5\n    wavelength_range: 0.3 1.2\n    coefficients: 0.2 0.1 -2\n";
        let k = "  - type: tabulated k\n    data: |\n";
        let metal = metal_from_yaml("mine", &format!("{text}{k}{}", indented(&column(2)))).unwrap();
        assert!((metal.table().at(500.0).n - 0.6).abs() < 1e-12);
        assert_eq!(metal.table().at(500.0).k, 2.5);
        let bad = text.replace("formula 5", "formula 12");
        assert!(metal_from_yaml("x", &bad).unwrap_err().to_string().contains("formula 1 to 9"));
    }

    #[test]
    fn refuses_with_a_reason() {
        let reason = |text: &str| metal_from_yaml("x", text).unwrap_err().to_string();
        let nk = |rows: &str| reason(&file(&[("tabulated nk", rows)]));
        assert!(reason("hello").starts_with("it is no file of refractiveindex.info"));
        assert!(reason("").starts_with("it is no file of refractiveindex.info"));
        assert!(!reason("DATA: [1, {").contains('\n'));
        assert_eq!(reason("DATA: []"), "it has no n; a metal needs both n and k");
        assert!(reason(&file(&[("tabulated n", &column(1))])).contains("it has no k"));
        assert!(reason(&file(&[("tabulated nk", TABLE), ("tabulated n", &column(1))])).contains("n twice"));
        assert!(nk("0,4 1,2 3,4\n").contains("decimals with a point"));
        assert!(nk("0.4 1.2\n").contains("2 columns instead of 3"));
        assert!(nk("0.5 1 2\n0.4 1 2\n").contains("must grow"));
        assert!(nk("0.4 -1 2\n").contains("at least 0"));
        assert!(nk("0.4 1 inf\n").contains("finite"));
        assert!(nk("400 1 2\n700 1 2\n").contains("are the wavelengths in the unit"));
        assert!(nk("0.4 1 2\n0.6 1 2\n0.7 1 2\n").contains("100 nm at most"));
        assert!(
            reason(&file(&[("tabulated n", "0.4 1\n0.5 1\n"), ("tabulated k", "0.6 1\n0.7 1\n")]))
                .contains("in common")
        );
    }

    /// Aliases that double and double, nesting, and a key given twice.
    #[test]
    fn hostile_files_are_refused_quickly_in_a_sentence() {
        let levels = |level: u32| format!("a{}: &a{} [*a{level}, *a{level}, *a{level}]\n", level + 1, level + 1);
        let bomb = format!("a0: &a0 [x, x, x]\n{}DATA: [*a40]\n", (0..40).map(levels).collect::<String>());
        let nested = format!("DATA: {}", "[".repeat(100_000));
        let mappings: String = (0..2_000).map(|depth| format!("{}a:\n", " ".repeat(depth))).collect();
        let twice = "DATA: []\nDATA: []\n".to_owned();
        let type_twice = "DATA:\n  - type: tabulated nk\n    type: tabulated n\n    data: 0.4 1 2\n".to_owned();
        for text in [bomb, nested, mappings, twice, type_twice] {
            let start = std::time::Instant::now();
            let error = metal_from_yaml("x", &text).unwrap_err().to_string();
            assert!(!error.contains('\n') && error.len() < 400, "{error}");
            assert!(start.elapsed().as_secs() < 10, "{error}: {:?}", start.elapsed());
        }
    }

    proptest! {
        /// Whatever is cut off or changed, the answer is a metal or a sentence.
        #[test]
        fn damaged_files_are_refused_or_read(cut in 0..400_usize, change in 0..400_usize, byte in 0..128_u8) {
            let mut text = file(&[("tabulated nk", TABLE)]);
            let at = change.min(text.len() - 1);
            text.replace_range(at..=at, &char::from(byte).to_string());
            text.truncate(text.len() - cut.min(text.len()));
            if let Err(error) = metal_from_yaml("x", &text) {
                prop_assert!(!error.to_string().is_empty() && !error.to_string().contains('\n'), "{error}");
            }
        }
    }

    /// The same rows as YAML give the metal that the library has as CSV.
    #[test]
    fn a_built_in_metal_survives_the_format() {
        let gold = metal_by_name("gold").unwrap();
        let rows: String = (380..=780)
            .step_by(10)
            .map(|nm| {
                let nk = gold.table().at(f64::from(nm));
                format!("{} {} {}\n", f64::from(nm) / 1000.0, nk.n, nk.k)
            })
            .collect();
        let read = metal_from_yaml("gold", &file(&[("tabulated nk", &rows)])).unwrap();
        assert!((read.table().at(550.0).k - gold.table().at(550.0).k).abs() < 1e-12);
    }
}
