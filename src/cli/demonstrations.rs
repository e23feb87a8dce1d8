//! `edgewise study conversion`, `blending`, `storage`, `decoupling`, `sliders` and `feasibility`:
//! what each parameterisation costs besides accuracy.

use std::ops::ControlFlow;

use clap::Args;
use serde::Serialize;

use super::arguments;
use super::output::{Format, FormatArguments, Output, Table};
use super::study::{BAR_STEPS, named_or_preferred, progress_bar};
use crate::color::RgbSpace;
use crate::fit::Method;
use crate::metal::metal_by_name;
use crate::study::{
    Contestants, ConversionOptions, DecouplingOptions, Subject, UniformityOptions, blend_matrix, blending, conversion,
    conversions, decoupling, feasibility_boundary, metal_points, quantisation, uniformity,
};

/// The arguments of every demonstration: how n, k and g of a metal come about, and the output.
#[derive(Debug, Args)]
struct Common {
    /// How n, k and g of a metal are derived
    #[arg(long, default_value_t = Method::LeastSquares)]
    method: Method,
    #[command(flatten)]
    format: FormatArguments,
}

impl Common {
    /// Rows in the chosen format; below a table also what is seen in them.
    fn output<T: Serialize>(&self, rows: &[T], seen: &str) -> anyhow::Result<Output> {
        let format = self.format.format();
        let is_said = format == Format::Table && !seen.is_empty();
        let sentence = if is_said { format!("\n{seen}\n") } else { String::new() };
        let text = Table::of_rows(rows)?.render(format) + &sentence;
        Ok(Output { text, ..Output::default() })
    }

    fn contestants(&self, name: &str, space: RgbSpace) -> anyhow::Result<Contestants> {
        Ok(Contestants::of(&Subject::Metal(metal_by_name(name)?), space, self.method)?)
    }
}

/// Arguments of `edgewise study conversion`.
#[derive(Debug, Args)]
pub struct Conversion {
    /// A metal of the library; may be given again. The preferred data set of every material unless given
    #[arg(long, value_name = "ID")]
    metal: Vec<String>,
    /// The space the parameters were made in
    #[arg(long, default_value_t = ConversionOptions::default().from)]
    from: RgbSpace,
    /// The space they are converted to, as if they were colours
    #[arg(long, default_value_t = ConversionOptions::default().to)]
    to: RgbSpace,
    #[command(flatten)]
    common: Common,
}

impl Conversion {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let options = ConversionOptions { from: self.from, to: self.to, method: self.common.method };
        let metals = named_or_preferred(&self.metal)?;
        if let [metal] = metals[..] {
            let one = conversion(&Subject::Metal(metal), &options)?;
            return self.common.output(&one.summaries(), &one.summary());
        }
        let rows = with_progress("Converting", |progress| conversions(&metals, &options, progress))?;
        self.common.output(&rows, "")
    }
}

/// Arguments of `edgewise study blending`.
#[derive(Debug, Args)]
pub struct Blending {
    /// The one metal, with --b: the blend of two in steps. Every pair of materials, half and half, unless given
    #[arg(long, value_name = "ID", requires = "b")]
    a: Option<String>,
    /// The other metal
    #[arg(long, value_name = "ID", requires = "a")]
    b: Option<String>,
    /// The space of the parameters
    #[arg(long, default_value_t)]
    space: RgbSpace,
    #[command(flatten)]
    common: Common,
}

impl Blending {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        if let (Some(a), Some(b)) = (&self.a, &self.b) {
            let [a, b] = [self.common.contestants(a, self.space)?, self.common.contestants(b, self.space)?];
            let blend = blending(&a, &b);
            return self.common.output(&blend.rows(), &blend.summary());
        }
        let metals = named_or_preferred(&[])?;
        let (space, method) = (self.space, self.common.method);
        let rows = with_progress("Blending", |progress| blend_matrix(&metals, space, method, progress))?;
        self.common.output(&rows, "")
    }
}

/// Arguments of `edgewise study storage`.
#[derive(Debug, Args)]
pub struct Storage {
    /// The metal whose parameters are stored with few digits
    #[arg(long, value_name = "ID")]
    metal: String,
    /// The metal that a gradient leads to
    #[arg(long, value_name = "ID", default_value = "Silver")]
    towards: String,
    /// The space of the parameters
    #[arg(long, default_value_t)]
    space: RgbSpace,
    #[command(flatten)]
    common: Common,
}

impl Storage {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let ends = [&self.metal, &self.towards].map(|name| self.common.contestants(name, self.space));
        let [metal, towards] = ends;
        let stored = quantisation(&metal?, &towards?);
        self.common.output(&stored.rows(), &stored.summary())
    }
}

/// Arguments of `edgewise study decoupling`.
#[derive(Debug, Args)]
pub struct Decoupling {
    /// The metal whose parameters are moved
    #[arg(long, value_name = "ID")]
    metal: String,
    /// How far r, then the edge parameter falls; for n and k the share of the value
    #[arg(long, default_value_t = DecouplingOptions::default().amount, value_parser = arguments::number)]
    amount: f64,
    /// The space of the parameters
    #[arg(long, default_value_t)]
    space: RgbSpace,
    #[command(flatten)]
    common: Common,
}

impl Decoupling {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let metal = self.common.contestants(&self.metal, self.space)?;
        let moved = decoupling(&metal, &DecouplingOptions { amount: self.amount });
        self.common.output(&moved.rows(), &moved.summary())
    }
}

/// Arguments of `edgewise study sliders`.
#[derive(Debug, Args)]
pub struct Sliders {
    /// Equal steps of each slider
    #[arg(long, default_value_t = UniformityOptions::default().steps, value_parser = arguments::steps)]
    steps: usize,
    #[command(flatten)]
    format: FormatArguments,
}

impl Sliders {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let sweeps = uniformity(&UniformityOptions { steps: self.steps, ..UniformityOptions::default() });
        let rows: Vec<_> = sweeps.iter().map(crate::study::SliderSweep::row).collect();
        Ok(Output { text: Table::of_rows(&rows)?.render(self.format.format()), ..Output::default() })
    }
}

/// Arguments of `edgewise study feasibility`.
#[derive(Debug, Args)]
pub struct Feasibility {
    /// Where the metals of the library lie, instead of the boundary of r and h
    #[arg(long)]
    metals: bool,
    /// The space of the metals' r and h
    #[arg(long, default_value_t)]
    space: RgbSpace,
    /// Steps of r along the boundary
    #[arg(long, default_value_t = 40, value_parser = arguments::steps)]
    steps: usize,
    #[command(flatten)]
    format: FormatArguments,
}

impl Feasibility {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let table = match self.metals {
            true => Table::of_rows(&metal_points(&named_or_preferred(&[])?, self.space)),
            false => Table::of_rows(&feasibility_boundary(self.steps)),
        };
        Ok(Output { text: table?.render(self.format.format()), ..Output::default() })
    }
}

/// Runs a study with a bar on standard error.
fn with_progress<T, E: Into<anyhow::Error>>(
    what: &'static str,
    study: impl FnOnce(&(dyn Fn(f32) -> ControlFlow<()> + Sync)) -> Result<T, E>,
) -> anyhow::Result<T> {
    let bar = progress_bar(what);
    let result = study(&|share| {
        bar.set_position((share * BAR_STEPS as f32) as u64);
        ControlFlow::Continue(())
    });
    bar.finish_and_clear();
    result.map_err(Into::into)
}
