//! What blending parameters does between two materials.

use super::page::{LEFT, Lines, Page, RIGHT, delta_e_text, ink, share_ticks};
use crate::color::Rgb;
use crate::figure::axis::Axis;
use crate::figure::drawing::{Align, Drawing, Inset, Label};
use crate::figure::output::Figure;
use crate::figure::style::{FigureTheme, em};
use crate::fresnel::CosTheta;
use crate::study::{Blend, BlendedParameters, Contestants, Painted, Parameters, blending, colour_at, painted_sphere};

/// Strips over the blend with the worst place marked, ΔE below, and a sphere painted with a soft edge.
#[derive(Clone, Debug)]
pub struct BlendFigure {
    a: Contestants,
    b: Contestants,
    blend: Blend,
}

const STRIP: f64 = 20.0;
const ROW_GAP: f64 = 18.0;
const CHART: f64 = 150.0;
const COLUMNS: usize = 121;
const SPHERE: f64 = 146.0;
/// Pixels of a sphere for each point.
const SPHERE_SCALE: f64 = 2.0;

impl BlendFigure {
    /// A figure of two materials described in one space.
    pub fn new(a: &Contestants, b: &Contestants) -> Self {
        Self { blend: blending(a, b), a: a.clone(), b: b.clone() }
    }

    /// The angle all strips are shown at: where the worst of them is.
    fn angle_deg(&self) -> f64 {
        let worst = self.blend.results.iter().map(|result| result.worst);
        worst.max_by(|x, y| x.delta_e.total_cmp(&y.delta_e)).map_or(0.0, |worst| worst.theta_deg)
    }

    fn colours(&self, painted: Painted) -> Vec<Rgb> {
        let angle = CosTheta::from_deg(self.angle_deg());
        let weight = |column: usize| column as f64 / (COLUMNS - 1) as f64;
        (0..COLUMNS).map(|column| colour_at(&self.a, &self.b, painted, weight(column), angle)).collect()
    }
}

impl Figure for BlendFigure {
    fn drawing(&self, theme: FigureTheme) -> Drawing {
        let title = format!("{} blended with {}, in {}", self.a.name, self.b.name, self.a.space.label());
        let mut page = Page::new(&title, &self.blend.summary(), theme);
        let share = Axis::new((0.0, 1.0), (LEFT, RIGHT));
        page.caption(
            &format!("Colour at {:.0}°. Above: blended reflectance. Below: blended parameters", self.angle_deg()),
            LEFT,
        );
        let mut has_clipped = false;
        for result in &self.blend.results {
            has_clipped |= self.pair_of_strips(&mut page, share, result);
        }
        page.y += 2.0;
        let ticks = share_ticks();
        page.ticks_below(share, &ticks, page.y);
        page.axis_name("Share", page.y);
        page.y += 46.0;
        page.caption("Largest ΔE2000 over the angles, by blending alone", LEFT);
        let values =
            Parameters::ALL.map(|p| self.blend.results[p as usize].own.iter().map(|e| e.max_delta_e).collect());
        Lines { x: share, x_ticks: &ticks, top: page.y, height: CHART, values }.draw(&mut page);
        page.y += CHART + 52.0;
        self.spheres(&mut page);
        page.clip_note(has_clipped);
        page.finish()
    }
}

impl BlendFigure {
    fn pair_of_strips(&self, page: &mut Page, share: Axis, result: &BlendedParameters) -> bool {
        let (palette, space, parameters) = (page.palette, self.a.space, result.parameters);
        let pair_of = |material: &Contestants| material.pair(parameters);
        let angle = CosTheta::from_deg(self.angle_deg());
        let ends = [pair_of(&self.a), pair_of(&self.b)].map(|pair| pair.reflectance(angle));
        let wanted: Vec<Rgb> = (0..COLUMNS).map(|c| ends[0].lerp(ends[1], c as f64 / (COLUMNS - 1) as f64)).collect();
        let blended = self.colours(Painted::Blended(parameters));
        let clipped = page.strip(share, (page.y, STRIP), &wanted, space)
            | page.strip(share, (page.y + STRIP, STRIP), &blended, space);
        let middle = page.y + STRIP;
        page.name(parameters.label(), middle, ink(parameters, palette));
        page.value(&delta_e_text(result.worst.delta_e), "max ΔE", middle);
        if result.worst.delta_e > 1e-6 {
            page.pointer((share.at(result.worst.weight), page.y - 2.0));
        }
        page.y += 2.0 * STRIP + ROW_GAP;
        clipped
    }

    fn spheres(&self, page: &mut Page) {
        let text = format!("A sphere of {} with a soft spot of {}, in white surroundings", self.a.name, self.b.name);
        page.caption(&text, super::page::MARGIN);
        let shown = std::iter::once(("Blended truth", Painted::Truth))
            .chain(Parameters::ALL.map(|p| (p.label(), Painted::Blended(p))));
        let gap = (super::page::WIDTH - 2.0 * super::page::MARGIN - 5.0 * SPHERE) / 4.0;
        for (column, (name, painted)) in shown.enumerate() {
            let x = super::page::MARGIN + (SPHERE + gap) * column as f64;
            let size = (SPHERE * SPHERE_SCALE) as u32;
            let picture = painted_sphere(&self.a, &self.b, painted, size).to_srgb8();
            page.drawing.insets.push(Inset { x, y: page.y, width: SPHERE, picture });
            let (centre, baseline) = (x + SPHERE / 2.0, page.y + SPHERE + 18.0);
            let label = Label::new(name, centre, baseline, em::LABEL, page.palette.ink);
            page.drawing.text(label.aligned(Align::Centre).semi_bold());
        }
        page.y += SPHERE + 18.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::fit::Method;
    use crate::metal::metal_by_name;
    use crate::study::Subject;

    #[test]
    fn texts_are_legible() {
        let of = |subject: &Subject| Contestants::of(subject, RgbSpace::AcesCg, Method::LeastSquares).unwrap();
        let metal = |name| of(&Subject::Metal(metal_by_name(name).unwrap()));
        let glass = of(&Subject::Dielectric { n: 1.5 });
        for (a, b) in [(metal("copper"), metal("zinc")), (metal("gold"), glass), (metal("silver"), metal("silver"))] {
            crate::figure::check::assert_texts_are_legible(&BlendFigure::new(&a, &b).drawing(FigureTheme::Light));
        }
    }
}
