//! A sphere by the truth and by a model, as a file in one of several layouts.

use std::path::Path;

use super::difference::DifferenceFigure;
use super::output::Figure;
use super::style::FigureTheme;
use crate::render::{DeltaEMap, Picture, SaveError, write_atomically};

/// What a file shows of the two spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SphereLayout {
    /// The truth.
    Truth,
    /// The model.
    Model,
    /// The truth left, the model right.
    Beside,
    /// One sphere, its left part by the truth, its right part by the model.
    Wipe,
    /// Both and their ΔE2000 in false colour with its scale; as OpenEXR the numbers alone.
    Difference,
}

/// Two renderings of one sphere, of one size and space.
#[derive(Clone, Debug)]
pub struct ComparedSpheres {
    /// What is rendered.
    pub title: String,
    /// Space, light, convention.
    pub subtitle: String,
    /// What the two are called.
    pub labels: [String; 2],
    /// The truth and the model.
    pub pictures: [Picture; 2],
    /// Where the model begins in a wiped sphere, 0 at its left to 1 at its right.
    pub wipe: f64,
    /// The difference shown in the brightest colour; [`round_scale`] of the largest where there is none.
    pub full_scale: Option<f64>,
}

/// At this a figure is 3664 pixels wide.
const MOST_PIXELS_PER_POINT: f64 = 4.0;

impl ComparedSpheres {
    /// Saves a layout as the ending of the name says: PNG (8-bit sRGB) or OpenEXR (linear, unclipped).
    ///
    /// Gives a sentence where a PNG had to be clipped; the figure of the difference says so itself.
    pub fn save(&self, layout: SphereLayout, path: &Path, theme: FigureTheme) -> Result<Option<String>, SaveError> {
        let [truth, model] = &self.pictures;
        match layout {
            SphereLayout::Truth => save_picture(truth, path),
            SphereLayout::Model => save_picture(model, path),
            SphereLayout::Beside => save_picture(&truth.beside(model, truth.width / 16), path),
            SphereLayout::Wipe => save_picture(&truth.wiped(model, self.wipe), path),
            SphereLayout::Difference if has_ending(path, "png") => {
                write_atomically(path, &self.figure().to_png(theme, self.pixels_per_point()))?;
                Ok(None)
            }
            SphereLayout::Difference => save_picture(&DeltaEMap::between(truth, model).to_picture(truth.space), path),
        }
    }

    /// The two and their difference on one page.
    pub fn figure(&self) -> DifferenceFigure {
        let [truth, model] = &self.pictures;
        DifferenceFigure {
            title: self.title.clone(),
            subtitle: self.subtitle.clone(),
            labels: self.labels.clone(),
            pictures: self.pictures.clone(),
            full_scale: self.full_scale.unwrap_or_else(|| round_scale(DeltaEMap::between(truth, model).max())),
        }
    }

    /// One pixel of the sphere for each of the file, while text stays legible and the page small.
    fn pixels_per_point(&self) -> f64 {
        (f64::from(self.pictures[0].width) / DifferenceFigure::SIDE).clamp(1.0, MOST_PIXELS_PER_POINT)
    }
}

/// The first of 1, 2, 5, 10, 20, 50 … that is not below the largest difference, at least 1: about what an eye can see.
pub fn round_scale(largest: f64) -> f64 {
    let decade = 10f64.powf(largest.max(1.0).log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|step| step * decade).into_iter().find(|&scale| scale >= largest).unwrap_or(10.0)
}

/// Saves a picture as PNG or OpenEXR; a sentence where it had to be clipped.
pub fn save_picture(picture: &Picture, path: &Path) -> Result<Option<String>, SaveError> {
    picture.save(path)?;
    if !has_ending(path, "png") {
        return Ok(None);
    }
    let clipped = picture.to_srgb8().clipped;
    let visible = picture.coverage.iter().filter(|&&coverage| coverage > 0.0).count();
    Ok((clipped > 0).then(|| {
        format!("{clipped} of {visible} pixels lie outside sRGB and are clipped in the .png; an .exr keeps them")
    }))
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::fresnel::FresnelModel;
    use crate::metal::metal_by_name;
    use crate::render::{Light, RadialTable, SphereView};

    fn chromium() -> ComparedSpheres {
        let (metal, space) = (metal_by_name("chromium").unwrap(), RgbSpace::LinRec709);
        let view = SphereView::new(32, Light::White, 0.0, space);
        let schlick = FresnelModel::Schlick { r: metal.r(space) };
        ComparedSpheres {
            title: "Chromium".to_owned(),
            subtitle: space.label().to_owned(),
            labels: ["Truth".to_owned(), "Schlick".to_owned()],
            pictures: [
                view.render(&RadialTable::of_metal(metal, space)),
                view.render(&RadialTable::of_model(&schlick, space)),
            ],
            wipe: 0.5,
            full_scale: None,
        }
    }

    #[test]
    fn every_layout_is_a_file_of_its_size() {
        let folder = tempfile::tempdir().unwrap();
        let width = |layout: SphereLayout, name: &str| {
            let path = folder.path().join(name);
            chromium().save(layout, &path, FigureTheme::Dark).unwrap();
            image::open(&path).unwrap().width()
        };
        for ending in ["png", "exr"] {
            let name = |layout: &str| format!("{layout}.{ending}");
            assert_eq!(width(SphereLayout::Truth, &name("truth")), 32);
            assert_eq!(width(SphereLayout::Beside, &name("beside")), 66);
            assert_eq!(width(SphereLayout::Wipe, &name("wipe")), 32);
        }
        assert_eq!(width(SphereLayout::Difference, "difference.exr"), 32);
        assert!(width(SphereLayout::Difference, "difference.png") > 800);
        let refused = chromium().save(SphereLayout::Difference, &folder.path().join("a.bmp"), FigureTheme::Light);
        assert!(refused.unwrap_err().to_string().contains(".png or .exr"));
    }

    #[test]
    fn the_scale_is_round_and_holds_the_largest() {
        assert_eq!([0.0, 0.4, 1.5, 5.0, 7.0, 13.0, 99.0].map(round_scale), [1.0, 1.0, 2.0, 5.0, 10.0, 20.0, 100.0]);
    }
}
