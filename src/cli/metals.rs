//! `edgewise metals`: the library of measured data.

use clap::Args;

use super::output::{Cell, Format, FormatArguments, Output, Table};
use crate::color::RgbSpace;
use crate::metal::{Metal, metals};
use crate::preset::pretty_json;

/// Arguments of `edgewise metals`.
#[derive(Debug, Args)]
pub struct Metals {
    /// Only data sets whose identifier, name or symbol contains this text
    filter: Option<String>,
    /// Only the data set that stands for its material
    #[arg(long)]
    preferred: bool,
    /// The space of r and h
    #[arg(long, default_value_t)]
    space: RgbSpace,
    #[command(flatten)]
    format: FormatArguments,
}

impl Metals {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let chosen = || metals().iter().filter(|metal| self.shows(metal));
        let text = match self.format.format() {
            Format::Json => pretty_json(&chosen().map(|metal| self.json(metal)).collect()),
            format => self.table(chosen()).render(format),
        };
        let is_empty = chosen().next().is_none();
        let warnings = is_empty.then(|| format!("no metal matches “{}”", self.filter.as_deref().unwrap_or_default()));
        Ok(Output { text, warnings: warnings.into_iter().collect(), ..Output::default() })
    }

    fn shows(&self, metal: &Metal) -> bool {
        let needle = self.filter.as_deref().unwrap_or_default().to_lowercase();
        let is_named = [&metal.id, &metal.name, &metal.symbol].iter().any(|text| text.to_lowercase().contains(&needle));
        is_named && (metal.is_preferred || !self.preferred)
    }

    fn table<'a>(&self, metals: impl Iterator<Item = &'a Metal>) -> Table {
        let channel = |symbol: &str, name: &str| format!("{symbol} {name} ({})", self.space);
        let mut table = Table::new([
            ("id", "id".to_owned()),
            ("name", "name".to_owned()),
            ("symbol", "symbol".to_owned()),
            ("category", "category".to_owned()),
            ("preferred", "preferred".to_owned()),
            ("r_red", channel("r", "red")),
            ("r_green", "green".to_owned()),
            ("r_blue", "blue".to_owned()),
            ("h_red", channel("h", "red")),
            ("h_green", "green".to_owned()),
            ("h_blue", "blue".to_owned()),
            ("source", "source".to_owned()),
            ("range_nm", "range (nm)".to_owned()),
            ("measured", "measured".to_owned()),
        ]);
        for metal in metals {
            let colours = [metal.r(self.space), metal.h(self.space)];
            let mut row: Vec<Cell> =
                [&metal.id, &metal.name, &metal.symbol, &metal.category].map(|t| t.as_str().into()).into();
            row.push(Cell::Flag(metal.is_preferred));
            row.extend(colours.iter().flat_map(|rgb| rgb.0).map(|value| Cell::Number(value, 4)));
            row.extend([Cell::Text(metal.provenance.citation()), Cell::Text(metal.provenance.range_nm.clone())]);
            row.push(Cell::Flag(metal.is_measured()));
            table.push(row);
        }
        table
    }

    fn json(&self, metal: &Metal) -> serde_json::Value {
        let held = metal.held_ends();
        serde_json::json!({
            "id": metal.id, "name": metal.name, "symbol": metal.symbol, "category": metal.category,
            "dataset": metal.dataset, "preferred": metal.is_preferred,
            "space": self.space, "r": metal.r(self.space), "h": metal.h(self.space),
            "held_below_nm": held.below_nm, "held_above_nm": held.above_nm,
            "measured": metal.is_measured(), "remarks": metal.remarks(),
            "provenance": metal.provenance,
        })
    }
}
