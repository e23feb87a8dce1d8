//! GIMP palettes, which Inkscape and Krita read too.

use std::fmt::Write as _;

use super::export::Written;
use super::names::one_line;
use super::swatch::Swatch;

/// One line for each colour: three 8-bit numbers and a name.
pub(super) fn write(title: &str, swatches: &[Swatch]) -> Written {
    let mut text = format!("GIMP Palette\nName: {}\nColumns: 2\n#\n", one_line(title));
    for Swatch { name, srgb } in swatches {
        let [red, green, blue] = srgb.0.map(|v| (v * 255.0).round());
        writeln!(text, "{red:>3} {green:>3} {blue:>3}\t{name}")?;
    }
    Ok(text.into_bytes())
}
