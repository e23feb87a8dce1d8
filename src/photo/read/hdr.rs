//! Radiance HDR, in RGB or XYZ, in any of its eight orientations (Ward, "Radiance file formats", 1994).
//!
//! The header is read here, since it says exposure, primaries and orientation; the pixels by a crate, behind a
//! plain header.

use std::io::{Cursor, Read};

use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;

use super::colour::{Claim, Colour, Primaries};
use super::{Decoded, Progress, limits, report};
use crate::color::RgbSpace;
use crate::photo::orientation::Orientation;
use crate::photo::samples::Samples;
use crate::photo::{ColourRule, PhotoErrorKind, Warning, WarningCode};

fn damaged(reason: &dyn std::fmt::Display) -> PhotoErrorKind {
    PhotoErrorKind::damaged("Radiance HDR")(reason)
}

/// What the lines before the pixels say.
#[derive(Debug, PartialEq)]
struct Header {
    /// Stored width and height: scanlines may run along columns.
    size: [u64; 2],
    orientation: Orientation,
    /// What the values were multiplied by: the product of every EXPOSURE and COLORCORR line.
    gain: [f64; 3],
    primaries: Option<Primaries>,
    is_xyz: bool,
    /// Where the pixels start.
    length: usize,
}

impl Default for Header {
    fn default() -> Self {
        let (size, orientation) = ([0; 2], Orientation::default());
        Self { size, orientation, gain: [1.0; 3], primaries: None, is_xyz: false, length: 0 }
    }
}

/// Decodes to radiance: exposure and colour correction are undone.
pub(super) fn decode(bytes: &[u8], progress: Progress<'_>) -> Result<Decoded, PhotoErrorKind> {
    let header = Header::read(bytes)?;
    let size = limits::check_size(header.size[0], header.size[1], 12)?;
    report(progress, 0, 1)?;
    let mut samples = pixels(&bytes[header.length..], size)?;
    report(progress, 1, 1)?;

    let is_gain_usable = header.gain.iter().all(|gain| gain.is_normal() && *gain > 0.0);
    let mut warnings = Vec::new();
    if !is_gain_usable {
        let message = "EXPOSURE or COLORCORR is no positive number; the values are left as stored";
        warnings.push(Warning::new(WarningCode::Profile, message));
    } else if header.gain != [1.0; 3] {
        let unexpose =
            |pixel: &mut [f32]| (0..3).for_each(|i| pixel[i] = (f64::from(pixel[i]) / header.gain[i]) as f32);
        samples.chunks_exact_mut(3).for_each(unexpose);
    }
    Ok(Decoded {
        samples: Samples::F32(samples),
        channels: 3,
        size,
        orientation: header.orientation,
        colour: Colour { claims: header.claims() },
        layers: Vec::new(),
        warnings,
    })
}

fn pixels(coded: &[u8], [width, height]: [u32; 2]) -> Result<Vec<f32>, PhotoErrorKind> {
    let plain = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n");
    let decoder = HdrDecoder::new(Cursor::new(plain).chain(coded)).map_err(|error| damaged(&error))?;
    let mut bytes = limits::reserve::<u8>(width as usize * height as usize * 12)?;
    bytes.resize(width as usize * height as usize * 12, 0);
    decoder.read_image(&mut bytes).map_err(|error| damaged(&error))?;
    Ok(bytes.as_chunks().0.iter().map(|bytes| f32::from_ne_bytes(*bytes)).collect())
}

impl Header {
    fn read(bytes: &[u8]) -> Result<Self, PhotoErrorKind> {
        let mut header = Self::default();
        let mut is_past_variables = false;
        loop {
            let rest = &bytes[header.length..];
            let end = rest.iter().position(|byte| *byte == b'\n').ok_or_else(|| damaged(&"its header does not end"))?;
            header.length += end + 1;
            let line = String::from_utf8_lossy(&rest[..end]);
            match line.trim() {
                "" => is_past_variables = true,
                resolution if is_past_variables => {
                    header.resolution(resolution).ok_or_else(|| damaged(&"its size line cannot be read"))?;
                    return Ok(header);
                }
                variable => header.variable(variable)?,
            }
        }
    }

    fn variable(&mut self, line: &str) -> Result<(), PhotoErrorKind> {
        let Some((name, value)) = line.split_once('=') else { return Ok(()) };
        let numbers = || -> Result<Vec<f64>, PhotoErrorKind> {
            let numbers: Result<_, _> = value.split_whitespace().map(str::parse).collect();
            numbers.map_err(|_| damaged(&format!("{} holds no numbers", name.trim())))
        };
        match name.trim() {
            "FORMAT" if value.trim() == "32-bit_rle_xyze" => self.is_xyz = true,
            "FORMAT" if value.trim() != "32-bit_rle_rgbe" => return Err(damaged(&"its pixel format is unknown")),
            "EXPOSURE" => match numbers()?[..] {
                [exposure] => self.gain = self.gain.map(|gain| gain * exposure),
                _ => return Err(damaged(&"EXPOSURE is not one number")),
            },
            "COLORCORR" => match numbers()?[..] {
                [red, green, blue] => self.gain = [self.gain[0] * red, self.gain[1] * green, self.gain[2] * blue],
                _ => return Err(damaged(&"COLORCORR is not three numbers")),
            },
            "PRIMARIES" => match numbers()?[..] {
                [xr, yr, xg, yg, xb, yb, xw, yw] => {
                    self.primaries = Some(Primaries::from_xy([[xr, yr], [xg, yg], [xb, yb], [xw, yw]]));
                }
                _ => return Err(damaged(&"PRIMARIES are not eight numbers")),
            },
            _ => {}
        }
        Ok(())
    }

    /// A line like `-Y 480 +X 640`: the axis from scanline to scanline, then the axis along one.
    fn resolution(&mut self, line: &str) -> Option<()> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [slow, rows, fast, columns] = words[..] else { return None };
        let (is_transposed, flips_y) = match slow {
            "-Y" => (false, false),
            "+Y" => (false, true),
            "+X" => (true, false),
            "-X" => (true, true),
            _ => return None,
        };
        let flips_x = match (is_transposed, fast) {
            (false, "+X") | (true, "-Y") => false,
            (false, "-X") | (true, "+Y") => true,
            _ => return None,
        };
        self.size = [columns.parse().ok()?, rows.parse().ok()?];
        self.orientation = Orientation::new(is_transposed, flips_x, flips_y);
        Some(())
    }

    fn claims(&self) -> Vec<Claim> {
        let linear =
            |primaries, has_primaries| Claim::Linear { primaries, rule: ColourRule::Radiance { has_primaries } };
        let stated = self.primaries.map(|primaries| linear(primaries, true));
        match self.is_xyz {
            true => vec![Claim::LinearXyz],
            false => stated.into_iter().chain([linear(Primaries::of(RgbSpace::LinRec709), false)]).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_header_multiply() {
        let text = b"#?RADIANCE\nEXPOSURE=2\n EXPOSURE= 0.5\nCOLORCORR=1 2 4\nEXPOSURE=3\n\n-Y 2 +X 3\nPIXELS";
        let header = Header::read(text).unwrap();
        assert_eq!((header.size, header.gain), ([3, 2], [3.0, 6.0, 12.0]));
        assert_eq!(&text[header.length..], b"PIXELS");
    }

    /// Ward's document: `-Y N +X M` is the usual one, `+X` first means that scanlines are columns.
    #[test]
    fn the_eight_orientations_are_those_of_exif() {
        let lines = ["-Y +X", "-Y -X", "+Y -X", "+Y +X", "+X -Y", "-X -Y", "-X +Y", "+X +Y"];
        for (exif, line) in (1..).zip(lines) {
            let (slow, fast) = line.split_once(' ').unwrap();
            let header = Header::read(format!("#?RGBE\n\n{slow} 2 {fast} 3\n").as_bytes()).unwrap();
            assert_eq!(Some(header.orientation), Orientation::from_exif(exif), "{line}");
        }
    }

    #[test]
    fn a_broken_header_is_one_sentence() {
        for text in [
            "#?RGBE\n",
            "#?RGBE\n\n-Y 2 +Y 3\n",
            "#?RGBE\nPRIMARIES=1 2\n\n",
            "#?RGBE\nEXPOSURE=x\n\n",
            "#?RGBE\n\n-Y -2 +X 3\n",
        ] {
            assert!(Header::read(text.as_bytes()).is_err(), "{text}");
        }
    }
}
