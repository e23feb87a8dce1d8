//! What EXIF says of orientation and colour.

use ::exif::{In, Reader, Tag, Value};

use super::colour::Claim;
use crate::photo::orientation::Orientation;
use crate::photo::{Warning, WarningCode};

/// The part of EXIF that concerns a measurement.
#[derive(Debug, Default)]
pub(super) struct Exif {
    pub orientation: Orientation,
    pub claim: Option<Claim>,
    pub warning: Option<Warning>,
}

impl Exif {
    /// Reads a block that starts with the TIFF header.
    pub fn read(bytes: Option<&[u8]>) -> Self {
        let Some(bytes) = bytes else { return Self::default() };
        let read = Reader::new().continue_on_error(true).read_raw(bytes.to_vec());
        match read.or_else(|error| error.distill_partial_result(|_| ())) {
            Ok(exif) => Self::of(&exif),
            Err(_) => Self { warning: Some(damaged()), ..Self::default() },
        }
    }

    fn of(exif: &::exif::Exif) -> Self {
        let number = |tag| exif.get_field(tag, In::PRIMARY).and_then(|field| field.value.get_uint(0));
        let index = exif.get_field(Tag::InteroperabilityIndex, In::PRIMARY).map(|field| &field.value);
        let is_r03 = matches!(index, Some(Value::Ascii(texts)) if texts.first().is_some_and(|t| t.starts_with(b"R03")));
        let mut found = Self { claim: claim(number(Tag::ColorSpace), is_r03), ..Self::default() };
        found.orient(number(Tag::Orientation));
        found
    }

    /// Takes an orientation value; 1–8 are known.
    pub fn orient(&mut self, value: Option<u32>) {
        match value.map(|value| (value, Orientation::from_exif(value))) {
            Some((_, Some(orientation))) => self.orientation = orientation,
            Some((value, None)) => {
                let message = format!("EXIF orientation {value} is not known; the picture is left as stored");
                self.warning = Some(Warning::new(WarningCode::Profile, message));
            }
            None => {}
        }
    }
}

/// The colour space by EXIF ColorSpace and the interoperability index (CIPA DC-008-2019, tag 40961; DCF 2.0).
pub(super) fn claim(color_space: Option<u32>, is_r03: bool) -> Option<Claim> {
    match color_space {
        Some(1) => Some(Claim::ExifSrgb),
        Some(2) => Some(Claim::ExifAdobeRgb),
        Some(65_535) if is_r03 => Some(Claim::ExifAdobeRgb),
        _ => None,
    }
}

fn damaged() -> Warning {
    Warning::new(WarningCode::Profile, "The EXIF block is damaged; orientation and colour space are not known")
}
