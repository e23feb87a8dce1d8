//! GIMP palettes.

use super::swatches::{Colour, presets};
use super::{ImportError, Imported};
use crate::color::Rgb;

/// Lines of three 8-bit numbers and a name.
pub(super) fn read(text: &str) -> Result<Imported, ImportError> {
    let mut lines = text.trim_start_matches('\u{feff}').lines();
    if lines.next().map(str::trim) != Some("GIMP Palette") {
        return Err(broken("its first line is not “GIMP Palette”"));
    }
    let is_colour = |line: &&str| line.trim_start().starts_with(|c: char| c.is_ascii_digit());
    presets(lines.filter(is_colour).map(colour).collect::<Result<_, _>>()?, "the palette")
}

fn colour(line: &str) -> Result<Colour, ImportError> {
    let mut rest = line.trim_start();
    let mut srgb = [0.0; 3];
    for channel in &mut srgb {
        let (word, after) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
        let value: u8 = word.parse().map_err(|_| broken("a line does not begin with three numbers of 0–255"))?;
        *channel = f64::from(value) / 255.0;
        rest = after.trim_start();
    }
    let name = if rest.is_empty() { "Untitled" } else { rest.trim_end() };
    Ok(Colour { name: name.to_owned(), srgb: Rgb(srgb) })
}

fn broken(reason: &str) -> ImportError {
    ImportError::Broken { format: "a GIMP palette", reason: reason.to_owned() }
}
