//! What a subcommand prints: one table of results, as text for people, CSV or JSON.

use std::io::{self, Write};
use std::process::ExitCode;

use anyhow::bail;
use clap::{Args, ValueEnum};
use serde::Serialize;
use serde_json::{Map, Value};

use crate::preset::pretty_json;

/// How results are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Aligned columns for people
    #[default]
    Table,
    /// Comma-separated values at full precision
    Csv,
    /// JSON at full precision
    Json,
}

/// The arguments of every subcommand that choose a [`Format`].
#[derive(Debug, Default, Args)]
pub struct FormatArguments {
    /// How to print the result; a table unless given
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Short for --format json
    #[arg(long, conflicts_with = "format")]
    json: bool,
}

impl FormatArguments {
    /// The chosen format, a table unless one was chosen.
    pub fn format(&self) -> Format {
        self.chosen().unwrap_or_default()
    }

    /// The format, if one was chosen.
    pub fn chosen(&self) -> Option<Format> {
        if self.json { Some(Format::Json) } else { self.format }
    }
}

/// What a subcommand has to say.
#[derive(Debug, Default)]
pub struct Output {
    /// Standard output.
    pub text: String,
    /// Sentences for standard error.
    pub warnings: Vec<String>,
    /// True where a part of the work failed; it was said already.
    pub is_partial: bool,
}

impl Output {
    /// Prints everything.
    pub fn print(self) -> anyhow::Result<ExitCode> {
        for warning in &self.warnings {
            complain(&format!("warning: {warning}"));
        }
        print(&self.text)?;
        Ok(if self.is_partial { ExitCode::FAILURE } else { ExitCode::SUCCESS })
    }
}

fn print(text: &str) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    stdout.flush()
}

/// One line on standard output, at once: for results that come one by one.
pub fn print_line(line: &str) -> io::Result<()> {
    print(&format!("{line}\n"))
}

/// One line on standard error. Where even that cannot be written there is nobody to tell.
pub fn complain(sentence: &str) {
    let one_line = sentence.split_whitespace().collect::<Vec<_>>().join(" ");
    let _ = writeln!(io::stderr(), "edgewise: {one_line}");
}

/// An error and its causes as one sentence; a cause that the sentence holds already is not said again.
pub fn sentence(error: &anyhow::Error) -> String {
    let mut sentence = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !sentence.contains(&cause) {
            sentence = format!("{sentence}: {cause}");
        }
    }
    sentence
}

/// A column: its stable name in CSV and JSON, and its title for people, with unit or space.
#[derive(Clone, Debug)]
pub struct Column {
    name: String,
    title: String,
}

/// One value of a [`Table`].
#[derive(Clone, Debug)]
pub enum Cell {
    /// Text, left-aligned.
    Text(String),
    /// A number: so many decimals for people, all digits for machines.
    Number(f64, usize),
    /// How many.
    Count(u64),
    /// Yes or no.
    Flag(bool),
    /// There is no value.
    Nothing,
}

impl Cell {
    /// A reflectance or another number of about 1.
    pub fn unit(value: f64) -> Self {
        Self::Number(value, 6)
    }

    /// The cell of a value; other numbers than counts get three decimals for people.
    fn of(value: &Value) -> Self {
        match value {
            Value::Null => Self::Nothing,
            Value::Bool(flag) => Self::Flag(*flag),
            Value::String(text) => Self::Text(text.clone()),
            Value::Number(number) => match number.as_u64() {
                Some(count) => Self::Count(count),
                None => Self::Number(number.as_f64().unwrap_or(f64::NAN), 3),
            },
            nested => Self::Text(nested.to_string()),
        }
    }

    fn for_people(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(value, decimals) => format!("{value:.decimals$}"),
            Self::Count(count) => count.to_string(),
            Self::Flag(flag) => (if *flag { "yes" } else { "" }).to_owned(),
            Self::Nothing => "–".to_owned(),
        }
    }

    fn for_csv(&self) -> String {
        match self {
            Self::Number(value, _) => value.to_string(),
            Self::Count(count) => count.to_string(),
            Self::Flag(flag) => flag.to_string(),
            Self::Text(text) => text.clone(),
            Self::Nothing => String::new(),
        }
    }

    /// JSON has no NaN and no infinity: null.
    fn for_json(&self) -> Value {
        match self {
            Self::Text(text) => Value::from(text.as_str()),
            Self::Number(value, _) => Value::from(*value),
            Self::Count(count) => Value::from(*count),
            Self::Flag(flag) => Value::from(*flag),
            Self::Nothing => Value::Null,
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

/// The title of a field for people: `angle_of_max_deg` is `angle of max (°)`.
fn title(name: &str) -> String {
    name.replace("delta_e", "ΔE").replace("_deg", " (°)").replace('_', " ")
}

/// Rows of results under named columns.
#[derive(Clone, Debug, Default)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table; each column is (stable name, title for people).
    pub fn new<T: Into<String>>(columns: impl IntoIterator<Item = (&'static str, T)>) -> Self {
        let columns =
            columns.into_iter().map(|(name, title)| Column { name: name.to_owned(), title: title.into() }).collect();
        Self { columns, rows: Vec::new() }
    }

    /// A table of what serialises as objects with the same fields; their names are the columns.
    pub fn of_rows<T: Serialize>(rows: &[T]) -> anyhow::Result<Self> {
        let mut table = Self::default();
        for row in rows {
            let Value::Object(row) = serde_json::to_value(row)? else { bail!("a row of results is no object") };
            if table.rows.is_empty() {
                table.columns = row.keys().map(|name| Column { name: name.clone(), title: title(name) }).collect();
            }
            table.push(row.iter().map(|(_, value)| Cell::of(value)).collect());
        }
        Ok(table)
    }

    /// Adds a row with one cell for each column.
    pub fn push(&mut self, row: Vec<Cell>) {
        assert_eq!(row.len(), self.columns.len(), "one cell for each column");
        self.rows.push(row);
    }

    /// The rows as JSON objects.
    pub fn to_json(&self) -> Value {
        let names = || self.columns.iter().map(|column| column.name.clone());
        let object = |row: &Vec<Cell>| names().zip(row.iter().map(Cell::for_json)).collect::<Map<_, _>>();
        self.rows.iter().map(|row| Value::Object(object(row))).collect()
    }

    /// A header of the stable names, then one line for each row.
    pub fn to_csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = self.columns.iter().map(|column| column.name.clone()).collect();
        let rows = self.rows.iter().map(|row| row.iter().map(Cell::for_csv).collect());
        for record in std::iter::once::<Vec<String>>(header).chain(rows) {
            writer.write_record(record).expect("memory takes everything");
        }
        String::from_utf8(writer.into_inner().expect("memory takes everything")).expect("made of strings")
    }

    /// Aligned columns under their titles.
    pub fn to_text(&self) -> String {
        let titles = self.columns.iter().map(|column| column.title.clone()).collect();
        let mut lines: Vec<Vec<String>> = vec![titles];
        lines.extend(self.rows.iter().map(|row| row.iter().map(Cell::for_people).collect()));
        let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        lines.iter().map(|line| self.aligned(line, &widths)).collect()
    }

    fn aligned(&self, line: &[String], widths: &[usize]) -> String {
        let cell = |(column, text): (usize, &String)| {
            let width = widths[column];
            if self.is_numeric(column) { format!("{text:>width$}") } else { format!("{text:<width$}") }
        };
        let cells: Vec<String> = line.iter().enumerate().map(cell).collect();
        format!("{}\n", cells.join("  ").trim_end())
    }

    fn is_numeric(&self, column: usize) -> bool {
        self.rows.iter().any(|row| matches!(row[column], Cell::Number(..) | Cell::Count(_)))
    }

    /// The table in a format; JSON is the list of rows.
    pub fn render(&self, format: Format) -> String {
        match format {
            Format::Table => self.to_text(),
            Format::Csv => self.to_csv(),
            Format::Json => pretty_json(&self.to_json()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new([("name", "name"), ("r", "r (lin_rec709)")]);
        table.push(vec!["a, “b”".into(), Cell::unit(1.0 / 3.0)]);
        table.push(vec!["c".into(), Cell::Nothing]);
        table
    }

    #[test]
    fn people_see_aligned_columns() {
        assert_eq!(table().to_text(), "name    r (lin_rec709)\na, “b”        0.333333\nc                    –\n");
    }

    #[test]
    fn machines_see_every_digit() {
        assert_eq!(table().to_csv(), "name,r\n\"a, “b”\",0.3333333333333333\nc,\n");
        assert_eq!(
            table().to_json(),
            serde_json::json!([{ "name": "a, “b”", "r": 1.0 / 3.0 }, { "name": "c", "r": null }])
        );
    }
}
