//! `edgewise inspect`: what a photograph says about its colours, and its values at some pixels.

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;

use super::arguments;
use super::output::{Cell, Format, FormatArguments, Output, Table};
use crate::photo::{Inspection, OpenOptions, Photo, Untagged, inspect};
use crate::preset::pretty_json;

/// Arguments of `edgewise inspect`.
#[derive(Debug, Args)]
pub struct Inspect {
    /// The photograph
    photo: PathBuf,
    /// Pixels to read: whole columns and rows from the top left, like "0,0;120,80"
    #[arg(long, value_name = "X,Y;X,Y", value_parser = arguments::probes, default_value = "", hide_default_value = true)]
    probe: arguments::Probes,
    #[command(flatten)]
    reading: ReadingArguments,
    #[command(flatten)]
    format: FormatArguments,
}

/// The arguments of every subcommand that opens photographs: what to do where a file leaves a choice.
#[derive(Debug, Default, Args)]
pub struct ReadingArguments {
    /// The layer of an OpenEXR file to read
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,
    /// Read a file that says nothing about its colours as linear Rec.709 instead of sRGB
    #[arg(long)]
    linear: bool,
}

impl ReadingArguments {
    /// The choices as the reader takes them.
    pub fn options(&self) -> OpenOptions {
        let untagged = if self.linear { Untagged::Linear } else { Untagged::Srgb };
        OpenOptions { layer: self.layer.clone(), untagged }
    }
}

impl Inspect {
    pub(super) fn run(self) -> anyhow::Result<Output> {
        let photo = Photo::open_with(&self.photo, &self.reading.options(), &mut |_| ControlFlow::Continue(()))?;
        let inspection = inspect(&photo, &self.probe.0);
        let text = match self.format.format() {
            Format::Json => pretty_json(&serde_json::to_value(&inspection)?),
            Format::Csv if self.probe.0.is_empty() => facts(&inspection).to_csv(),
            Format::Csv => self.pixels(&photo).to_csv(),
            Format::Table => format!("{}{}", facts(&inspection).to_text(), self.pixels_below(&photo)),
        };
        let mut warnings: Vec<String> = inspection.warnings.iter().map(|warning| warning.message.clone()).collect();
        warnings.extend(self.outside(&photo));
        Ok(Output { text, warnings, ..Output::default() })
    }

    fn outside<'a>(&'a self, photo: &'a Photo) -> impl Iterator<Item = String> + 'a {
        let outside = self.probe.0.iter().filter(|(column, row)| photo.pixel(*column, *row).is_none());
        outside.map(|(column, row)| {
            format!("there is no pixel {column},{row} in a picture of {} × {}", photo.width, photo.height)
        })
    }

    fn pixels_below(&self, photo: &Photo) -> String {
        if self.probe.0.is_empty() { String::new() } else { format!("\n{}", self.pixels(photo).to_text()) }
    }

    fn pixels(&self, photo: &Photo) -> Table {
        let mut table =
            Table::new([("x", "x"), ("y", "y"), ("red", "red (lin_rec709)"), ("green", "green"), ("blue", "blue")]);
        for &(column, row) in &self.probe.0 {
            let pixel = photo.pixel(column, row);
            let value = |channel: usize| pixel.map_or(Cell::Nothing, |pixel| Cell::unit(pixel.rgb[channel]));
            let place = [column, row].map(|v| Cell::Count(v.into()));
            table.push(place.into_iter().chain([0, 1, 2].map(value)).collect());
        }
        table
    }
}

fn facts(inspection: &Inspection) -> Table {
    let mut table = Table::new([("width", "width"), ("height", "height"), ("colour_rule", "colour rule")]);
    let size = [inspection.width, inspection.height].map(|v| Cell::Count(v.into()));
    table.push(size.into_iter().chain([inspection.colour_rule.as_str().into()]).collect());
    table
}
