//! A preset at a glance: its facing and edge colour, and every angle between.

use super::axis::Axis;
use super::curve::curve_angles;
use super::drawing::{Align, Drawing, Label};
use super::output::Figure;
use super::page::{HAIR, HEADING, MARGIN, Page};
use super::strip::{CLIP_MARK, draw_strip};
use super::style::{FigureTheme, Ink, SOLID, em};
use crate::color::{Rgb, RgbSpace, hex_from_srgb8, srgb8};
use crate::fresnel::THETA_MAX_DEG;
use crate::preset::Preset;

/// Two named colours and the strip over the angle.
#[derive(Clone, Debug, PartialEq)]
pub struct SwatchFigure {
    /// The name of the material.
    pub title: String,
    /// The space of the values.
    pub space: RgbSpace,
    /// r.
    pub facing: Rgb,
    /// h.
    pub edge: Rgb,
    /// The reflectance at each of the [`curve_angles`].
    pub strip: Vec<Rgb>,
}

/// The swatches of a preset.
pub fn swatch_figure(preset: &Preset) -> SwatchFigure {
    let model = preset.model();
    SwatchFigure {
        title: preset.name.clone(),
        space: preset.space,
        facing: preset.r,
        edge: preset.h,
        strip: curve_angles().map(|c| model.reflectance(c)).collect(),
    }
}

const SWATCH: (f64, f64) = (276.0, 168.0);
const GAP: f64 = 16.0;
const STRIP: f64 = 36.0;
const TOP: f64 = HEADING + 6.0;
const STRIP_TOP: f64 = TOP + SWATCH.1 + 64.0;

impl Figure for SwatchFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let right = MARGIN + 2.0 * SWATCH.0 + GAP;
        let subtitle = format!("Reflectance in {}", self.space.label());
        let size = (right + MARGIN, STRIP_TOP + STRIP + 58.0);
        let mut page = Page::new((&self.title, &subtitle), size, MARGIN, theme);
        let mut has_clipped = swatch(&mut page, MARGIN, "r, facing the surface", self.facing, self.space);
        has_clipped |= swatch(&mut page, MARGIN + SWATCH.0 + GAP, "h, at 81.8°", self.edge, self.space);
        has_clipped |= self.strip(&mut page, Axis::new((0.0, 90.0), (MARGIN, right)));
        if has_clipped {
            let note = "Shown in sRGB; underlined where sRGB cannot show the colour and it is clipped.";
            page.caption(note, MARGIN, size.1 - 14.0, Align::Left);
        }
        page.drawing
    }
}

/// One colour with its name and values; true where it had to be clipped.
fn swatch(page: &mut Page, left: f64, name: &str, colour: Rgb, space: RgbSpace) -> bool {
    let (code, clipped) = srgb8(colour, space);
    page.drawing.fill(left, TOP, SWATCH.0, SWATCH.1, Ink::opaque(code));
    frame(page, left, TOP, SWATCH);
    let below = TOP + SWATCH.1;
    if clipped {
        page.drawing.fill(left, below - CLIP_MARK, SWATCH.0, CLIP_MARK, page.palette.muted);
    }
    let [red, green, blue] = colour.0;
    let values = format!("{red:.3}  {green:.3}  {blue:.3}");
    page.drawing.text(Label::new(name, left, below + 22.0, em::LABEL, page.palette.ink).semi_bold());
    page.caption(&values, left, below + 40.0, Align::Left);
    page.caption(&hex_from_srgb8(code), left + SWATCH.0, below + 22.0, Align::Right);
    clipped
}

fn frame(page: &mut Page, left: f64, top: f64, (width, height): (f64, f64)) {
    let (right, bottom) = (left + width, top + height);
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
    page.drawing.line(&corners, HAIR, SOLID, page.palette.grid);
}

impl SwatchFigure {
    fn strip(&self, page: &mut Page, angle: Axis) -> bool {
        let mark = page.palette.muted;
        let clipped = draw_strip(&mut page.drawing, angle, (STRIP_TOP, STRIP), &self.strip, self.space, mark);
        frame(page, MARGIN, STRIP_TOP, (angle.places.1 - angle.places.0, STRIP));
        let baseline = STRIP_TOP + STRIP + 17.0;
        page.caption("0°", MARGIN, baseline, Align::Left);
        for deg in [15.0, 30.0, 45.0, 60.0, THETA_MAX_DEG] {
            let tick = angle.at(deg);
            page.drawing.rule((tick, STRIP_TOP + STRIP), (tick, STRIP_TOP + STRIP + 4.0), HAIR, page.palette.mark);
            let text = if deg == THETA_MAX_DEG { format!("{deg:.1}°") } else { format!("{deg}°") };
            page.caption(&text, tick, baseline, Align::Centre);
        }
        page.caption("90°", angle.places.1, baseline, Align::Right);
        clipped
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::check::assert_texts_are_legible;
    use crate::metal::preferred_metals;

    #[test]
    fn every_metal_is_legible_and_shown_in_its_colour() {
        for metal in preferred_metals() {
            let figure = swatch_figure(&Preset::from_metal(metal, RgbSpace::AcesCg));
            let drawing = figure.drawing(FigureTheme::Light);
            assert_texts_are_legible(&drawing);
            let code = srgb8(figure.facing, figure.space).0;
            assert!(drawing.labels().any(|label| label.text == hex_from_srgb8(code)));
        }
    }
}
