//! Adobe Swatch Exchange.

use super::swatches::{Colour, presets};
use super::{ImportError, Imported};
use crate::color::Rgb;

const COLOR_ENTRY: u16 = 0x0001;

/// The RGB and grey colours of a file, in order; groups are passed over, other models noted.
pub(super) fn read(bytes: &[u8]) -> Result<Imported, ImportError> {
    let mut file = Bytes(bytes);
    if file.take(4)? != b"ASEF" {
        return Err(broken("it does not begin with ASEF"));
    }
    file.take(4)?;
    let count = file.u32()?;
    let (mut colours, mut others) = (Vec::new(), 0_usize);
    for _ in 0..count {
        let kind = file.u16()?;
        let length = usize::try_from(file.u32()?).map_err(|_| broken("a block is too long"))?;
        let block = Bytes(file.take(length)?);
        if kind == COLOR_ENTRY {
            match colour(block)? {
                Some(colour) => colours.push(colour),
                None => others += 1,
            }
        }
    }
    let mut imported = presets(colours, "the swatch file")?;
    if others > 0 {
        imported.notes.push(format!("{others} colours are neither RGB nor grey and were skipped"));
    }
    Ok(imported)
}

fn colour(mut block: Bytes<'_>) -> Result<Option<Colour>, ImportError> {
    let units = usize::from(block.u16()?);
    let name: Vec<u16> = (0..units).map(|_| block.u16()).collect::<Result<_, _>>()?;
    let name = String::from_utf16(&name).map_err(|_| broken("a name is not UTF-16"))?;
    let name = name.trim_end_matches('\0').to_owned();
    let srgb = match block.take(4)? {
        b"RGB " => Rgb([block.channel()?, block.channel()?, block.channel()?]),
        b"Gray" => Rgb::splat(block.channel()?),
        _ => return Ok(None),
    };
    Ok(Some(Colour { name: if name.is_empty() { "Untitled".to_owned() } else { name }, srgb }))
}

/// What is left to read, big-endian.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], ImportError> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(|| broken("it ends too early"))?;
        self.0 = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], ImportError> {
        self.take(N)?.try_into().map_err(|_| broken("it ends too early"))
    }

    fn u16(&mut self) -> Result<u16, ImportError> {
        self.array().map(u16::from_be_bytes)
    }

    fn u32(&mut self) -> Result<u32, ImportError> {
        self.array().map(u32::from_be_bytes)
    }

    fn channel(&mut self) -> Result<f64, ImportError> {
        let value = f64::from(f32::from_be_bytes(self.array()?));
        if (0.0..=1.0).contains(&value) { Ok(value) } else { Err(broken("a channel is outside 0–1")) }
    }
}

fn broken(reason: &str) -> ImportError {
    ImportError::Broken { format: "a swatch file", reason: reason.to_owned() }
}
