//! `edgewise study stability`: how many digits each model and conversion keeps.

use anyhow::Context;
use clap::Args;

use super::super::output::{Cell, Format, FormatArguments, Output, Table};
use super::shown::with_bar;
use crate::study::{Fineness, StabilityRow, stability, stability_summary};

/// Arguments of `edgewise study stability`.
#[derive(Debug, Args)]
pub(super) struct StabilityCommand {
    /// Every decade and tenth between the edges, which takes minutes
    #[arg(long)]
    fine: bool,
    #[command(flatten)]
    format: FormatArguments,
}

impl StabilityCommand {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let fineness = if self.fine { Fineness::Fine } else { Fineness::Default };
        let rows = with_bar(|progress| stability(fineness, progress)).context("the study was stopped")?;
        let format = self.format.format();
        let sentence =
            if format == Format::Table { format!("\n{}\n", stability_summary(&rows)) } else { String::new() };
        let table = if format == Format::Table { for_people(&rows) } else { Table::of_rows(&rows)? };
        Ok(Output { text: table.render(format) + &sentence, ..Output::default() })
    }
}

/// Errors are of every size: three decimals, as other tables have, would show most of them as 0.
fn for_people(rows: &[StabilityRow]) -> Table {
    let error = |value: Option<f64>| value.map_or(Cell::Nothing, |value| Cell::Text(format!("{value:.1e}")));
    let count = |count: usize| Cell::Count(count as u64);
    let titles = [
        ("quantity", "quantity"),
        ("kind", "kind"),
        ("arithmetic", "arithmetic"),
        ("domain", "domain"),
        ("max_absolute", "off by"),
        ("max_absolute_at", "at"),
        ("max_ulp", "ULP"),
        ("max_ulp_at", "at"),
        ("nan", "NaN"),
        ("infinite", "infinite"),
        ("negative", "negative"),
        ("above_one", "above 1"),
    ];
    let mut table = Table::new(titles);
    for row in rows {
        table.push(vec![
            row.quantity.into(),
            row.kind.into(),
            row.arithmetic.into(),
            row.domain.into(),
            error(row.max_absolute),
            row.max_absolute_at.as_str().into(),
            error(row.max_ulp),
            row.max_ulp_at.as_str().into(),
            count(row.nan),
            count(row.infinite),
            count(row.negative),
            count(row.above_one),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_are_told_where_either_error_is() {
        let row = StabilityRow {
            quantity: "schlick",
            kind: "ours",
            arithmetic: "vectors",
            domain: "inside",
            points: 2,
            max_absolute: Some(1.25e-7),
            max_absolute_at: "r = 0.5, c = 0.1".to_owned(),
            max_ulp: Some(3.5),
            max_ulp_at: "r = 0.04, c = 1".to_owned(),
            nan: 0,
            infinite: 0,
            negative: 0,
            above_one: 0,
        };
        let text = for_people(&[row]).render(Format::Table);
        for told in ["1.2e-7", "r = 0.5, c = 0.1", "3.5e0", "r = 0.04, c = 1"] {
            assert!(text.contains(told), "{told} in {text}");
        }
    }
}
