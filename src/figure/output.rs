//! From a laid-out figure to SVG text and PNG bytes.

use std::path::Path;
use std::str::FromStr;

use image::imageops::{self, FilterType};
use image::{RgbImage, RgbaImage};
use plotters::prelude::{BitMapBackend, IntoDrawingArea as _, SVGBackend};

use super::drawing::{BASELINE_EM, Drawing};
use super::style::FigureTheme;
use crate::color::UnknownName;
use crate::render::{SaveError, Srgb8Picture, write_atomically};

/// A figure: plain data that knows how it is laid out.
pub trait Figure {
    /// The figure laid out in a theme.
    fn drawing(&self, theme: FigureTheme) -> Drawing;

    /// The figure as an SVG document.
    fn to_svg(&self, theme: FigureTheme) -> String {
        self.drawing(theme).to_svg()
    }

    /// The figure as a PNG file with `scale` pixels per point.
    fn to_png(&self, theme: FigureTheme, scale: f64) -> Vec<u8> {
        self.drawing(theme).to_picture(scale).to_png()
    }

    /// Saves the figure in the format the ending of the name says; PNG at two pixels per point.
    fn save(&self, path: &Path, theme: FigureTheme) -> Result<(), SaveError> {
        let bytes = match FigureFormat::of(path)? {
            FigureFormat::Svg => self.to_svg(theme).into_bytes(),
            FigureFormat::Png => self.to_png(theme, 2.0),
        };
        write_atomically(path, &bytes)
    }
}

/// A file format for figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureFormat {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
}

impl FigureFormat {
    /// Both formats.
    pub const ALL: [Self; 2] = [Self::Svg, Self::Png];

    /// The ending of file names, which is the identifier too.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// The format that the ending of a file name asks for.
    pub fn of(path: &Path) -> Result<Self, SaveError> {
        let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        ending.parse().map_err(|_| SaveError::UnknownFormat { path: path.to_owned(), known: ".svg or .png" })
    }
}

impl FromStr for FigureFormat {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let found = Self::ALL.into_iter().find(|format| format.extension() == text);
        found.ok_or_else(|| UnknownName::new("figure format", text, Self::ALL.map(Self::extension)))
    }
}

/// plotters' SVG has whole numbers only: draw ten times as large and let the view box shrink it.
const SVG_UNITS_PER_POINT: f64 = 10.0;

/// Pixels drawn per pixel shown, each way: plotters' bitmap lines have no partial coverage.
const OVERSAMPLING: f64 = 4.0;

impl Drawing {
    /// The drawing as an SVG document: text stays text, pictures are embedded.
    pub fn to_svg(&self) -> String {
        let mut svg = String::new();
        let unit = |points: f64| (points * SVG_UNITS_PER_POINT).round() as u32;
        let size = (unit(self.width), unit(self.height));
        {
            let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
            let drawn = self.draw_on(&area, SVG_UNITS_PER_POINT).and_then(|()| area.present());
            drawn.expect("drawing to memory in a font that a test has read");
        }
        let svg = with_header(&svg, size, self);
        // Attributes only: plotters escapes quotation marks in text.
        svg.replace("dy=\"0.76em\"", &format!("dy=\"{BASELINE_EM}em\""))
            .replace("font-weight=\"bold\"", "font-weight=\"600\"")
            .replace("</svg>", &format!("{}</svg>", insets_as_svg(self)))
    }

    /// The drawing as an opaque picture with `scale` pixels per point (0.25 to 8), lines and text anti-aliased.
    pub fn to_picture(&self, scale: f64) -> Srgb8Picture {
        let scale = scale.clamp(0.25, 8.0);
        let pixels = |points: f64| ((points * scale).round() as u32).max(1);
        let (width, height) = (pixels(self.width), pixels(self.height));
        let fine = self.rasterised(width * OVERSAMPLING as u32, height * OVERSAMPLING as u32, scale * OVERSAMPLING);
        let mut shown = image::DynamicImage::from(imageops::thumbnail(&fine, width, height)).into_rgba8();
        for inset in &self.insets {
            let side = |points: f64| pixels(points);
            let height = inset.width * f64::from(inset.picture.height) / f64::from(inset.picture.width);
            let scaled = resized(&inset.picture, side(inset.width), side(height));
            imageops::overlay(&mut shown, &scaled, (inset.x * scale).round() as i64, (inset.y * scale).round() as i64);
        }
        Srgb8Picture { width, height, rgba: shown.into_raw(), clipped: 0 }
    }

    fn rasterised(&self, width: u32, height: u32, scale: f64) -> RgbImage {
        let mut rgb = vec![0; 3 * width as usize * height as usize];
        {
            let area = BitMapBackend::with_buffer(&mut rgb, (width, height)).into_drawing_area();
            let drawn = self.draw_on(&area, scale).and_then(|()| area.present());
            drawn.expect("drawing to memory in a font that a test has read");
        }
        RgbImage::from_raw(width, height, rgb).expect("three bytes for each pixel")
    }
}

fn resized(picture: &Srgb8Picture, width: u32, height: u32) -> RgbaImage {
    let image = RgbaImage::from_raw(picture.width, picture.height, picture.rgba.clone());
    let image = image.expect("four bytes for each pixel");
    if image.dimensions() == (width, height) {
        image
    } else {
        imageops::resize(&image, width, height, FilterType::CatmullRom)
    }
}

/// The document with its size in points and its title.
fn with_header(svg: &str, (width, height): (u32, u32), drawing: &Drawing) -> String {
    let body = svg.split_once('\n').map_or("", |(_, body)| body);
    let title = quick_xml::escape::escape(drawing.title.as_str());
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {width} {height}\" \
         role=\"img\">\n<title>{title}</title>\n{body}",
        drawing.width, drawing.height
    )
}

fn insets_as_svg(drawing: &Drawing) -> String {
    let element = |inset: &super::drawing::Inset| {
        let unit = |points: f64| points * SVG_UNITS_PER_POINT;
        let height = inset.width * f64::from(inset.picture.height) / f64::from(inset.picture.width);
        format!(
            "<image x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" href=\"data:image/png;base64,{}\"/>\n",
            unit(inset.x),
            unit(inset.y),
            unit(inset.width),
            unit(height),
            base64(&inset.picture.to_png())
        )
    };
    drawing.insets.iter().map(element).collect()
}

/// RFC 4648 section 4, with padding.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let code = group.iter().fold(0, |code, &byte| code << 8 | u32::from(byte)) << (8 * (3 - group.len()));
        for digit in 0..4 {
            let is_padding = digit > group.len();
            let symbol = ALPHABET[(code >> (18 - 6 * digit)) as usize & 63];
            text.push(if is_padding { '=' } else { symbol as char });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::drawing::{Align, Inset, Label};
    use crate::figure::style::Ink;

    fn example() -> Drawing {
        let mut drawing = Drawing::new("a < b & \"c\"", 80.0, 40.0, Ink::hex(0xffffff));
        drawing.rule((0.0, 20.3), (80.0, 20.3), 1.5, Ink::hex(0x0000ff));
        drawing.text(Label::new("r < h", 40.0, 15.0, 12.0, Ink::hex(0)).aligned(Align::Centre).semi_bold());
        let picture = Srgb8Picture { width: 2, height: 1, rgba: [255, 0, 0, 255].repeat(2), clipped: 0 };
        drawing.insets.push(Inset { x: 10.0, y: 30.0, width: 8.0, picture });
        drawing
    }

    #[test]
    fn svg_is_well_formed_and_says_what_it_shows() {
        let svg = example().to_svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let root = document.root_element();
        assert_eq!((root.attribute("width"), root.attribute("viewBox")), (Some("80"), Some("0 0 800 400")));
        let text_of = |tag: &str| document.descendants().find(|n| n.has_tag_name(tag)).unwrap().text().unwrap().trim();
        assert_eq!((text_of("title"), text_of("text")), ("a < b & \"c\"", "r < h"));
    }

    /// The baseline of a text in the SVG is where the drawing put it.
    #[test]
    fn svg_baselines_are_the_drawings() {
        let svg = example().to_svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let text = document.descendants().find(|n| n.has_tag_name("text")).unwrap();
        let number = |name: &str| text.attribute(name).unwrap().trim_end_matches("em").parse::<f64>().unwrap();
        assert!((number("y") + number("dy") * number("font-size") - 150.0).abs() <= 0.5);
    }

    #[test]
    fn png_has_the_size_and_the_inset() {
        let picture = example().to_picture(2.0);
        let decoded = image::load_from_memory(&picture.to_png()).unwrap().into_rgba8();
        assert_eq!(decoded.dimensions(), (160, 80));
        assert_eq!(decoded.get_pixel(28, 64).0, [255, 0, 0, 255]);
        assert_eq!([(80, 70), (159, 79), (0, 79)].map(|(x, y)| decoded.get_pixel(x, y).0), [[255; 4]; 3]);
    }

    /// A line that covers part of a pixel colours it in part.
    #[test]
    fn lines_are_anti_aliased() {
        let picture = example().to_picture(1.0);
        let partly = |row| (1..255).contains(&picture.rgb(5, row)[0]);
        assert!((18..23).any(partly));
    }

    /// RFC 4648 section 10.
    #[test]
    fn base64_is_the_standards() {
        let printed = [("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
        assert!(printed.iter().all(|(plain, code)| base64(plain.as_bytes()) == *code));
    }

    #[test]
    fn formats_follow_the_ending() {
        assert_eq!(FigureFormat::of(Path::new("a/Gold.SVG")).unwrap(), FigureFormat::Svg);
        let error = FigureFormat::of(Path::new("gold.pdf")).unwrap_err().to_string();
        assert!(error.contains("gold.pdf") && error.contains(".svg or .png"), "{error}");
        assert!(FigureFormat::of(Path::new("gold")).is_err());
    }
}
