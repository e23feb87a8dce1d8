//! The match rendered: what the marked metal looks like with the r and h that were found in it.

use rayon::prelude::*;
use thiserror::Error;

use super::facing::Facing;
use super::light::Light;
use super::outcome::{Match, MatchError};
use super::regions::Regions;
use super::view::View;
use crate::color::{Rgb, RgbSpace, delta_e_rgb};
use crate::fresnel::{CosTheta, FresnelModel};
use crate::photo::area::pixel_range;
use crate::photo::{Area, Body, LightMode, Photo};

/// The part of a photograph around the metal, as it is and rendered from a match, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendition {
    /// Left edge in pixels of the photograph.
    pub left: u32,
    /// Top edge in pixels of the photograph.
    pub top: u32,
    /// Pixels of the photograph that each pixel here covers, each way.
    pub step: u32,
    /// Width in pixels of its own.
    pub width: u32,
    /// Height in pixels of its own.
    pub height: u32,
    /// As photographed, linear Rec.709; through the grey scale where there is one.
    pub photograph: Vec<[f32; 3]>,
    /// The same with the metal rendered by r and h under the light of the match.
    pub rendered: Vec<[f32; 3]>,
    /// CIEDE2000 of both, each over its light, so that a perfect mirror is white; NaN where no metal is rendered.
    pub delta_e: Vec<f32>,
}

/// Why a match cannot be rendered.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RenditionError {
    /// A colour is missing.
    #[error("{symbol} was not measured in every channel, so there is nothing to compare with")]
    NotMeasured {
        /// r or h.
        symbol: &'static str,
    },
    /// The light is missing in a channel.
    #[error("the light was not measured in every channel, so there is nothing to compare with")]
    NoLight,
    /// No body and no mirror.
    #[error("mark the ball or the cylinder to compare the photograph with the match")]
    NoMetal,
    /// The marks no longer fit the photograph.
    #[error(transparent)]
    Marks(#[from] MatchError),
}

/// Room around the metal, as a share of its size.
const MARGIN: f64 = 0.06;

impl Rendition {
    /// Renders a match with the longer side at most `largest_side` pixels.
    pub fn of(photo: &Photo, found: &Match, largest_side: u32) -> Result<Self, RenditionError> {
        let view = View::of(photo, &found.request)?;
        let scene = Scene::of(&view, found)?;
        let [left, top, right, bottom] = scene.bounds(photo);
        let longer = (right - left).max(bottom - top);
        let step = longer.div_ceil(largest_side.max(1)).max(1);
        let [width, height] = [(right - left).div_ceil(step), (bottom - top).div_ceil(step)];
        let pixels: Vec<Shown> = (0..width * height)
            .into_par_iter()
            .map(|i| scene.pixel(&view, [left + i % width * step, top + i / width * step], step))
            .collect();
        let linear = |of: fn(&Shown) -> [f64; 3]| pixels.iter().map(|shown| of(shown).map(|v| v as f32)).collect();
        let delta_e = pixels.iter().map(|shown| shown.delta_e as f32).collect();
        let (photograph, rendered) = (linear(|shown| shown.photograph), linear(|shown| shown.rendered));
        Ok(Self { left, top, step, width, height, photograph, rendered, delta_e })
    }

    /// The mean difference over the metal, and what 95 % of its pixels stay below; `None` where none is rendered.
    pub fn mean_and_most(&self) -> Option<(f64, f64)> {
        let mut known: Vec<f32> = self.delta_e.iter().copied().filter(|delta_e| delta_e.is_finite()).collect();
        let index = (known.len() as f64 * 0.95) as usize;
        let mean = known.iter().map(|delta_e| f64::from(*delta_e)).sum::<f64>() / known.len() as f64;
        (index < known.len()).then(|| (mean, f64::from(*known.select_nth_unstable_by(index, f32::total_cmp).1)))
    }

    /// The index of the pixel that shows a point of the photograph; `None` outside.
    pub fn index_at(&self, x: f64, y: f64) -> Option<usize> {
        let along = |position: f64, start: u32, size: u32| {
            let index = ((position - f64::from(start)) / f64::from(self.step)).floor();
            (0.0..f64::from(size)).contains(&index).then_some(index as usize)
        };
        Some(along(y, self.top, self.height)? * self.width as usize + along(x, self.left, self.width)?)
    }
}

/// A pixel of both pictures.
struct Shown {
    photograph: [f64; 3],
    rendered: [f64; 3],
    delta_e: f64,
}

/// The metal of a match, where it is, and the light on it.
struct Scene {
    model: FresnelModel,
    light: Light,
    surfaces: Vec<Surface>,
}

/// Where a photograph shows the metal.
enum Surface {
    /// A ball or a cylinder.
    Body(Body),
    /// A flat piece that mirrors a card, with what the card sends.
    Mirror { area: Area, angle: CosTheta, card: [f64; 3] },
}

impl Scene {
    fn of(view: &View, found: &Match) -> Result<Self, RenditionError> {
        let linear = |colour: Option<Rgb>, symbol: &'static str| {
            let colour = colour.ok_or(RenditionError::NotMeasured { symbol })?;
            Ok::<_, RenditionError>(found.space.convert(colour, RgbSpace::LinRec709))
        };
        let model = FresnelModel::Hoffman { r: linear(found.complete_r(), "r")?, h: linear(found.complete_h(), "h")? };
        if found.light.contains(&None) {
            return Err(RenditionError::NoLight);
        }
        let light = match found.mode {
            LightMode::ReferenceBall => Light::of(view, &found.request)?,
            _ => Light::even(found.light, [0.0; 3]),
        };
        let surfaces = surfaces(view, found);
        if surfaces.is_empty() { Err(RenditionError::NoMetal) } else { Ok(Self { model, light, surfaces }) }
    }

    /// Left, top, right and bottom of the part that shows the metal, cut at the picture's ends.
    fn bounds(&self, photo: &Photo) -> [u32; 4] {
        let of_surface = |surface: &Surface| match surface {
            Surface::Body(body) => body.bounds(),
            Surface::Mirror { area, .. } => area.bounds(),
        };
        let all = self.surfaces.iter().map(of_surface).map(|[x, y, width, height]| [x, y, x + width, y + height]);
        let union = |a: [f64; 4], b: [f64; 4]| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])];
        let [left, top, right, bottom] = all.reduce(union).unwrap_or_default();
        let margin = MARGIN * (right - left).max(bottom - top);
        let columns = pixel_range(left - margin, right - left + 2.0 * margin, photo.width);
        let rows = pixel_range(top - margin, bottom - top + 2.0 * margin, photo.height);
        [columns.start, rows.start, columns.end, rows.end]
    }

    /// The mean of `step` × `step` pixels from a column and row on, and the same rendered in their middle.
    fn pixel(&self, view: &View, [column, row]: [u32; 2], step: u32) -> Shown {
        let photograph = block_mean(view, [column, row], step);
        let middle = |start: u32| f64::from(start) + f64::from(step) / 2.0;
        let [x, y] = [middle(column), middle(row)];
        let plain = Shown { photograph, rendered: photograph, delta_e: f64::NAN };
        let Some((angle, light, is_sure)) = self.surfaces.iter().find_map(|surface| self.meet(view, surface, x, y))
        else {
            return plain;
        };
        let reflectance = self.model.reflectance(angle);
        if light.iter().any(|light| !light.is_finite()) {
            return plain;
        }
        let seen = Rgb(std::array::from_fn(|i| photograph[i] / light[i]));
        let rendered = std::array::from_fn(|i| reflectance[i] * light[i]);
        let delta_e = if is_sure { delta_e_rgb(seen, reflectance, RgbSpace::LinRec709) } else { f64::NAN };
        Shown { photograph, rendered, delta_e }
    }

    /// The angle and the light where a surface shows a point, and whether blur keeps the backdrop away from it.
    fn meet(&self, view: &View, surface: &Surface, x: f64, y: f64) -> Option<(CosTheta, [f64; 3], bool)> {
        match surface {
            Surface::Body(body) => {
                let normal = body.normal(x, y)?;
                let sine = Some(normal[0].hypot(normal[1])).filter(|sine| *sine < 1.0)?;
                let angle = CosTheta::new((1.0 - sine * sine).sqrt());
                let facing = Facing { cosine: angle.get(), normal };
                let is_sure = (1.0 - sine) * body.radius() > Regions::RIM_MARGIN_PX;
                Some((angle, self.light.at(view, &facing), is_sure))
            }
            Surface::Mirror { area, angle, card } => area.contains(x, y).then_some((*angle, *card, true)),
        }
    }
}

fn surfaces(view: &View, found: &Match) -> Vec<Surface> {
    if found.mode != LightMode::FlatMirror {
        return found.request.body().map(Surface::Body).into_iter().collect();
    }
    let mirror = |pair: &crate::photo::MirrorPair| Surface::Mirror {
        area: pair.mirrored,
        angle: CosTheta::from_deg(pair.angle_deg),
        card: view.statistics(pair.direct).trimmed_mean,
    };
    found.request.mirrors.iter().map(mirror).collect()
}

fn block_mean(view: &View, [column, row]: [u32; 2], step: u32) -> [f64; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for (x, y) in (row..row + step).flat_map(|y| (column..column + step).map(move |x| (x, y))) {
        if let Some(pixel) = view.pixel(x, y) {
            (0..3).for_each(|i| sum[i] += pixel.rgb[i]);
            count += 1.0;
        }
    }
    sum.map(|sum| sum / count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::{Circle, MatchRequest, solve};

    const BALL: Circle = Circle::new(60.0, 50.0, 40.0);

    /// A ball of two colours under a light of 0.5, before black.
    fn photo() -> Photo {
        let model = FresnelModel::Hoffman { r: Rgb([0.9, 0.7, 0.4]), h: Rgb([0.95, 0.85, 0.65]) };
        let pixel = |i: u32| {
            let rho = BALL.rho(f64::from(i % 120) + 0.5, f64::from(i / 120) + 0.5);
            let reflectance = model.reflectance(CosTheta::new((1.0 - rho * rho).max(0.0).sqrt()));
            if rho < 1.0 { reflectance.0.map(|f| (0.5 * f) as f32) } else { [0.0; 3] }
        };
        Photo::from_linear("two colours", 120, 100, (0..12_000).map(pixel).collect())
    }

    fn rendition(light: f64, largest_side: u32) -> Rendition {
        let light = Some(Rgb::splat(light));
        let request = MatchRequest { mode: LightMode::ByEye, circle: Some(BALL), light, ..MatchRequest::default() };
        let photo = photo();
        let mut found = solve(&photo, &request, RgbSpace::AcesCg).unwrap();
        let wide = |rgb: [f64; 3]| RgbSpace::LinRec709.convert(Rgb(rgb), RgbSpace::AcesCg).0.map(Some);
        (found.r, found.h) = (wide([0.9, 0.7, 0.4]), wide([0.95, 0.85, 0.65]));
        Rendition::of(&photo, &found, largest_side).unwrap()
    }

    #[test]
    fn the_truth_rendered_is_the_photograph() {
        let same = rendition(0.5, 1000);
        let (mean, most) = same.mean_and_most().unwrap();
        assert!(mean < 1e-3 && most < 1e-2, "{mean} {most}");
        let differs = |i: usize| (0..3).any(|c| (same.photograph[i][c] - same.rendered[i][c]).abs() > 1e-5);
        assert!((0..same.photograph.len()).all(|i| !differs(i)));
        assert!(same.delta_e[0].is_nan(), "beside the ball nothing is rendered");
    }

    /// Half the light with the same r and h: the photograph is twice as bright.
    #[test]
    fn another_light_differs() {
        let other = rendition(0.25, 1000);
        assert!(other.mean_and_most().unwrap().0 > 10.0);
        let middle = other.index_at(60.0, 50.0).unwrap();
        assert!((other.rendered[middle][0] / other.photograph[middle][0] - 0.5).abs() < 1e-3);
    }

    #[test]
    fn a_small_copy_shows_the_same_part() {
        let (full, small) = (rendition(0.5, 1000), rendition(0.5, 30));
        assert_eq!((full.left, full.top, full.step), (small.left, small.top, 1));
        assert!(small.step > 1 && small.width.max(small.height) <= 30);
        assert_eq!(small.index_at(f64::from(small.left) - 0.1, 50.0), None);
        assert!(small.mean_and_most().unwrap().0 < 1.0);
    }

    #[test]
    fn without_h_there_is_nothing_to_compare() {
        let request = MatchRequest { circle: Some(BALL), light: Some(Rgb::splat(0.5)), ..MatchRequest::default() };
        let mut found =
            solve(&photo(), &MatchRequest { mode: LightMode::ByEye, ..request }, RgbSpace::LinRec709).unwrap();
        found.h = [None; 3];
        assert_eq!(Rendition::of(&photo(), &found, 100), Err(RenditionError::NotMeasured { symbol: "h" }));
    }
}
