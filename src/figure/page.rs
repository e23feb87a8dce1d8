//! What figures share: the heading, the note at the foot, a frame with two axes, a colour scale.

use super::axis::{Axis, tick_text};
use super::drawing::{Align, Drawing, Label};
use super::style::{FigureTheme, Ink, Palette, em};
use super::text::{Weight, fitted};

pub(super) const MARGIN: f64 = 24.0;
/// Lower edge of the heading.
pub(super) const HEADING: f64 = 72.0;
/// From the middle of a text's capitals to its baseline.
pub(super) const TO_BASELINE: f64 = 4.2;
pub(super) const HAIR: f64 = 1.0;

/// A drawing under construction, with its colours.
#[derive(Debug)]
pub(super) struct Page {
    pub(super) drawing: Drawing,
    pub(super) palette: Palette,
}

impl Page {
    /// A page with a title and a subtitle whose left ends are at `left`.
    pub(super) fn new(
        (title, subtitle): (&str, &str),
        (width, height): (f64, f64),
        left: f64,
        theme: FigureTheme,
    ) -> Self {
        let palette = theme.palette();
        let mut drawing = Drawing::new(format!("{title}. {subtitle}"), width, height, palette.ground);
        let room = width - MARGIN - left;
        let title = fitted(title, Weight::SemiBold, em::TITLE, room);
        drawing.text(Label::new(title, left, 38.0, em::TITLE, palette.ink).semi_bold());
        let subtitle = fitted(subtitle, Weight::Regular, em::SUBTITLE, room);
        drawing.text(Label::new(subtitle, left, 58.0, em::SUBTITLE, palette.muted));
        Self { drawing, palette }
    }

    /// A small grey text, if there is any.
    pub(super) fn caption(&mut self, text: &str, x: f64, baseline: f64, align: Align) {
        if text.is_empty() {
            return;
        }
        self.drawing.text(Label::new(text, x, baseline, em::SMALL, self.palette.muted).aligned(align));
    }

    /// A text in ink, beside a height.
    pub(super) fn name(&mut self, text: impl Into<String>, x: f64, middle: f64, align: Align) {
        self.drawing.text(Label::new(text, x, middle + TO_BASELINE, em::LABEL, self.palette.ink).aligned(align));
    }

    /// Grid lines, ticks and the names of both axes.
    pub(super) fn frame(&mut self, frame: &Frame) {
        self.vertical_grid(frame);
        let (x, y) = (frame.x, frame.y);
        for value in y.ticks(6) {
            self.drawing.rule((x.places.0, y.at(value)), (x.places.1, y.at(value)), HAIR, self.palette.grid);
            self.caption(&tick_text(value), x.places.0 - 8.0, y.at(value) + 4.0, Align::Right);
        }
        self.caption(&frame.y_name, x.places.0, y.places.1 - 12.0, Align::Left);
    }

    /// The grid, ticks and name of the horizontal axis alone.
    pub(super) fn vertical_grid(&mut self, frame: &Frame) {
        let (x, y) = (frame.x, frame.y);
        for value in x.ticks(6) {
            self.drawing.rule((x.at(value), y.places.0), (x.at(value), y.places.1), HAIR, self.palette.grid);
            self.caption(&tick_text(value), x.at(value), y.places.0 + 18.0, Align::Centre);
        }
        self.caption(&frame.x_name, x.places.1, y.places.0 + 38.0, Align::Right);
    }

    /// A horizontal bar of colours from 0 to `full_scale`, with values under it and a name before it.
    pub(super) fn colour_scale(
        &mut self,
        name: &str,
        (x, y, width): (f64, f64, f64),
        full_scale: f64,
        colour: impl Fn(f64) -> Ink,
    ) {
        const STEPS: u32 = 64;
        const HEIGHT: f64 = 10.0;
        for step in 0..STEPS {
            let left = x + width * f64::from(step) / f64::from(STEPS);
            self.drawing.fill(left, y, x + width - left, HEIGHT, colour((f64::from(step) + 0.5) / f64::from(STEPS)));
        }
        let axis = Axis::new((0.0, full_scale), (x, x + width));
        for value in axis.ticks(4) {
            self.caption(&tick_text(value), axis.at(value), y + HEIGHT + 15.0, Align::Centre);
        }
        self.caption(name, x - 12.0, y + 9.0, Align::Right);
    }
}

/// Two axes and their names.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) x_name: String,
    pub(super) y_name: String,
}

/// A colour for a share 0–1 of a scale of errors: the ground, amber, red.
pub(super) fn heat(share: f64, theme: FigureTheme) -> Ink {
    let stops: [[u8; 3]; 3] = match theme {
        FigureTheme::Light => [[0xfb, 0xfb, 0xf8], [0xf7, 0xc9, 0x6b], [0xb8, 0x2a, 0x22]],
        FigureTheme::Dark => [[0x22, 0x22, 0x21], [0x8a, 0x5a, 0x14], [0xf0, 0x5d, 0x48]],
    };
    let position = share.clamp(0.0, 1.0) * 2.0;
    let index = usize::from(position >= 1.0);
    let mix = |i: usize| {
        let (from, to) = (f64::from(stops[index][i]), f64::from(stops[index + 1][i]));
        (from + (to - from) * (position - index as f64)).round() as u8
    };
    Ink::opaque([mix(0), mix(1), mix(2)])
}

/// Black or white, whichever reads better on a colour.
pub(super) fn ink_on(ground: Ink) -> Ink {
    let [red, green, blue] = ground.rgb.map(f64::from);
    let luma = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    if luma > 135.0 { Ink::hex(0x1c1c1c) } else { Ink::hex(0xf6f6f6) }
}
