//! How every demonstration is shown: its rows, the sentence about them, and its figure.

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::super::output::{Format, FormatArguments, Output, Table};
use super::super::progress::Progress;
use crate::figure::{Figure, FigureTheme};
use crate::fit::Method;

/// The arguments of every demonstration.
#[derive(Debug, Args)]
pub(super) struct Shown {
    /// Also draw the figure into an .svg or .png file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// The look of the figure: light, for print and slides, or dark
    #[arg(long, value_name = "THEME", default_value = "light")]
    theme: FigureTheme,
    #[command(flatten)]
    format: FormatArguments,
}

impl Shown {
    /// Draws the figure where one is wanted.
    pub(super) fn draw(&self, figure: impl FnOnce() -> Box<dyn Figure>) -> anyhow::Result<()> {
        match &self.plot {
            Some(path) => Ok(figure().save(path, self.theme)?),
            None => Ok(()),
        }
    }

    /// Rows in the chosen format; below a table also what is seen in them.
    pub(super) fn output<T: Serialize>(&self, rows: &[T], seen: &str, warnings: Vec<String>) -> anyhow::Result<Output> {
        let format = self.format.format();
        let sentence = if format == Format::Table && !seen.is_empty() { format!("\n{seen}\n") } else { String::new() };
        Ok(Output { text: Table::of_rows(rows)?.render(format) + &sentence, warnings, ..Output::default() })
    }
}

/// How n, k and g of a metal are derived, of the methods that give all three.
pub(super) fn index_method(text: &str) -> Result<Method, String> {
    let method: Method = text.parse().map_err(|error: crate::color::UnknownName| error.to_string())?;
    let kinds = [crate::fresnel::ModelKind::Gulbrandsen, crate::fresnel::ModelKind::Conductor];
    if kinds.into_iter().all(|kind| method.applies_to(kind)) {
        return Ok(method);
    }
    let known = Method::ALL.into_iter().filter(|m| kinds.into_iter().all(|kind| m.applies_to(kind))).map(Method::id);
    Err(format!("“{text}” gives no n, k and g; one of: {}", known.collect::<Vec<_>>().join(", ")))
}

/// What the help says about the method.
pub(super) const METHOD_HELP: &str = "How n, k and g of a metal are derived: colour-matching, least-squares, \
    black-box, band-average, or points-R-G-B in nanometres";

/// Runs a study under a progress bar, until Ctrl-C.
pub(super) fn with_bar<T>(work: impl FnOnce(&(dyn Fn(f32) -> ControlFlow<()> + Sync)) -> T) -> T {
    let progress = Progress::new("Measuring");
    work(&|share| progress.report(share))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Triple;

    #[test]
    fn only_methods_that_give_n_k_and_g() {
        assert_eq!(index_method("least-squares"), Ok(Method::LeastSquares));
        assert_eq!(index_method("points-650-550-450"), Ok(Method::Points(Triple::ROUND)));
        assert!(index_method("exact").unwrap_err().contains("least-squares"));
        assert!(index_method("default-g").unwrap_err().contains("no n, k and g"));
    }
}
