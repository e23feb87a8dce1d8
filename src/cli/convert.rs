//! `edgewise convert`: the same material in the parameters of other models.

use clap::Args;
use serde_json::json;

use super::output::{Cell, Format, FormatArguments, Output, Table};
use super::parameters::parameters;
use super::source::{Source, SourceArguments};
use crate::fit::{Conversion, convert};
use crate::fresnel::ModelKind;
use crate::preset::pretty_json;

/// Arguments of `edgewise convert`.
#[derive(Debug, Args)]
pub struct Convert {
    #[command(flatten)]
    source: SourceArguments,
    /// The model to convert to; may be given again. All of them unless given
    #[arg(long = "to", value_name = "MODEL")]
    to: Vec<ModelKind>,
    #[command(flatten)]
    format: FormatArguments,
}

impl Convert {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let source = self.source.source()?;
        let from = source.as_model();
        let kinds = if self.to.is_empty() { ModelKind::ALL.to_vec() } else { self.to.clone() };
        let conversions: Vec<Conversion> =
            kinds.into_iter().map(|kind| convert(&from, kind, source.space)).collect::<Result<_, _>>()?;
        let text = match self.format.format() {
            Format::Json => pretty_json(&json!({
                "material": source.name, "space": source.space, "from": from,
                "conversions": conversions.iter().map(document).collect::<Vec<_>>(),
            })),
            format => table(&source, &conversions).render(format),
        };
        let losses = conversions.iter().flat_map(sentences);
        Ok(Output { text, warnings: source.warnings.into_iter().chain(losses).collect(), ..Output::default() })
    }
}

fn sentences(conversion: &Conversion) -> impl Iterator<Item = String> {
    let kind = conversion.model.kind();
    conversion.losses.iter().map(move |loss| format!("{kind}: {loss}"))
}

fn document(conversion: &Conversion) -> serde_json::Value {
    json!({
        "model": conversion.model, "exact": conversion.is_exact(), "max_difference": conversion.max_difference,
        "max_delta_e": conversion.max_delta_e, "losses": conversion.losses,
        "warnings": sentences(conversion).collect::<Vec<_>>(),
    })
}

/// One row for each parameter; a parameter without channels has one value under red.
fn table(source: &Source, conversions: &[Conversion]) -> Table {
    let mut table = Table::new([
        ("model", "model".to_owned()),
        ("parameter", "parameter".to_owned()),
        ("red", format!("red ({})", source.space)),
        ("green", "green".to_owned()),
        ("blue", "blue".to_owned()),
        ("max_difference", "max |ΔF|".to_owned()),
        ("max_delta_e", "max ΔE2000".to_owned()),
    ]);
    for conversion in conversions {
        for parameter in parameters(&conversion.model) {
            let value =
                |channel: usize| parameter.values.get(channel).map_or(Cell::Nothing, |value| Cell::unit(*value));
            table.push(vec![
                conversion.model.kind().id().into(),
                parameter.symbol.into(),
                value(0),
                value(1),
                value(2),
                Cell::unit(conversion.max_difference),
                Cell::Number(conversion.max_delta_e, 3),
            ]);
        }
    }
    table
}
