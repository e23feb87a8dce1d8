//! The type of figures: Inter, carried inside the program, and the size of what is set in it.

use std::sync::LazyLock;

use plotters::style::{FontDesc, FontFamily, FontStyle, register_font};

/// The family as SVG files name it. Inter is used where it is installed; the others are close in width.
pub(super) const FAMILY: &str = "Inter, Helvetica, Arial, sans-serif";

/// plotters takes the height of a line; Inter's em is shorter by this factor (plotters' own constant for SVG).
pub(super) const LINE_HEIGHT_PER_EM: f64 = 1.24;

/// How heavy a text is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weight {
    /// Running text and numbers.
    #[default]
    Regular,
    /// Titles and names.
    SemiBold,
}

/// Registered once, on first use; both files are read by a test.
static FONTS: LazyLock<bool> = LazyLock::new(|| {
    let regular = register_font(FAMILY, FontStyle::Normal, include_bytes!("../../assets/fonts/Inter-Regular.ttf"));
    let semi_bold = register_font(FAMILY, FontStyle::Bold, include_bytes!("../../assets/fonts/Inter-SemiBold.ttf"));
    regular.is_ok() && semi_bold.is_ok()
});

/// The font at an em size, for plotters.
pub(super) fn font(weight: Weight, em: f64) -> FontDesc<'static> {
    // Looking is what registers them.
    assert!(*FONTS, "fonts that a test has read");
    let style = match weight {
        Weight::Regular => FontStyle::Normal,
        Weight::SemiBold => FontStyle::Bold,
    };
    FontDesc::new(FontFamily::Name(FAMILY), em * LINE_HEIGHT_PER_EM, style)
}

/// Width of a text at an em size, in the same unit.
pub fn text_width(text: &str, weight: Weight, em: f64) -> f64 {
    // plotters rounds to whole units: measure large.
    const MEASURED_EM: f64 = 200.0;
    let measured = font(weight, MEASURED_EM).box_size(text).map_or(0, |(width, _)| width);
    f64::from(measured) * em / MEASURED_EM
}

/// The text, or as much of it as fits a width, with an ellipsis.
pub(super) fn fitted(text: &str, weight: Weight, em: f64, width: f64) -> String {
    if text_width(text, weight, em) <= width {
        return text.to_owned();
    }
    let ends: Vec<usize> = text.char_indices().map(|(end, _)| end).collect();
    let cut = |end: usize| format!("{}…", text[..end].trim_end());
    let fitting = ends.partition_point(|&end| text_width(&cut(end), weight, em) <= width);
    cut(ends[fitting.saturating_sub(1)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_fonts_read() {
        assert!(*LazyLock::force(&FONTS));
    }

    #[test]
    fn width_grows_with_text_size_and_weight() {
        let width = |text, weight, em| text_width(text, weight, em);
        assert!(width("Hoffman", Weight::Regular, 12.0) > width("Hoff", Weight::Regular, 12.0));
        assert!(width("Gold", Weight::SemiBold, 12.0) > width("Gold", Weight::Regular, 12.0));
        assert!((width("Gold", Weight::Regular, 24.0) / width("Gold", Weight::Regular, 12.0) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn long_texts_are_cut_to_fit() {
        let fitting = fitted("Größer als die Spalte", Weight::Regular, 12.0, 60.0);
        assert!(fitting.ends_with('…') && text_width(&fitting, Weight::Regular, 12.0) <= 60.0, "{fitting}");
        assert_eq!(fitted("short", Weight::Regular, 12.0, 60.0), "short");
    }
}
