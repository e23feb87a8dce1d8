//! Which format a file is, by its content; raw files also by their name.

use super::raw;
use crate::photo::PhotoErrorKind;

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Png,
    Jpeg,
    Exr,
    Tiff,
    WebP,
    Hdr,
}

impl Format {
    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Exr => "OpenEXR",
            Self::Tiff => "TIFF",
            Self::WebP => "WebP",
            Self::Hdr => "Radiance HDR",
        }
    }
}

/// The format of a file, or why it is not read.
pub(super) fn format(name: &str, bytes: &[u8]) -> Result<Format, PhotoErrorKind> {
    let at = |offset: usize, magic: &[u8]| bytes.get(offset..).is_some_and(|rest| rest.starts_with(magic));
    let is_tiff = [b"II\x2a\x00", b"MM\x00\x2a", b"II\x2b\x00", b"MM\x00\x2b"].iter().any(|magic| at(0, *magic));
    if at(0, b"\x89PNG\r\n\x1a\n") {
        Ok(Format::Png)
    } else if at(0, b"\xff\xd8\xff") {
        Ok(Format::Jpeg)
    } else if at(0, &[0x76, 0x2f, 0x31, 0x01]) {
        Ok(Format::Exr)
    } else if at(0, b"RIFF") && at(8, b"WEBP") {
        Ok(Format::WebP)
    } else if at(0, b"#?RADIANCE") || at(0, b"#?RGBE") {
        Ok(Format::Hdr)
    } else if let Some(raw) = raw::by_content(bytes).or_else(|| raw::by_name(name)) {
        Err(PhotoErrorKind::Raw(raw))
    } else if is_tiff {
        Ok(Format::Tiff)
    } else {
        Err(other(bytes).map_or(PhotoErrorKind::UnknownFormat, PhotoErrorKind::OtherFormat))
    }
}

/// Pictures that other programs read.
fn other(bytes: &[u8]) -> Option<&'static str> {
    let at = |offset: usize, magic: &[u8]| bytes.get(offset..).is_some_and(|rest| rest.starts_with(magic));
    let is_brand =
        |brand: &[u8]| at(4, b"ftyp") && bytes.get(8..64).unwrap_or(&bytes[8..]).windows(4).any(|w| w == brand);
    let signatures: [(bool, &'static str); 12] = [
        (is_brand(b"avif") || is_brand(b"avis"), "AVIF"),
        (is_brand(b"heic") || is_brand(b"heix") || is_brand(b"mif1") || is_brand(b"msf1"), "HEIC"),
        (at(0, b"\xff\x0a") || at(0, b"\x00\x00\x00\x0cJXL "), "JPEG XL"),
        (at(0, b"\x00\x00\x00\x0cjP  ") || at(0, b"\xff\x4f\xff\x51"), "JPEG 2000"),
        (at(0, b"GIF8"), "GIF"),
        (at(0, b"BM"), "BMP"),
        (at(0, b"8BPS") || at(0, b"8BPB"), "Photoshop's own format"),
        (at(0, b"DDS "), "DDS"),
        (at(0, b"%PDF"), "PDF"),
        (at(0, b"gimp xcf"), "GIMP's own format"),
        (at(0, b"SDPX") || at(0, b"XPDS"), "DPX"),
        (at(0, b"qoif"), "QOI"),
    ];
    signatures.iter().find(|(is_it, _)| *is_it).map(|(_, label)| *label)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn raw_files_are_named_by_extension_and_by_content() {
        for (name, bytes, label) in [
            ("a.NEF", b"MM\x00\x2a".as_slice(), "Nikon NEF"),
            ("a.dng", b"????", "DNG"),
            ("a", b"II\x2a\x00\x10\x00\x00\x00CR\x02\x00", "Canon CR2"),
            ("a.jpg", b"FUJIFILMCCD-RAW 0201", "Fujifilm RAF"),
            ("a", b"\x00\x00\x00\x18ftypcrx ", "Canon CR3"),
        ] {
            let text = format(name, bytes).unwrap_err().to_string();
            assert!(text.contains(label) && text.contains("16-bit linear TIFF"), "{text}");
        }
    }

    #[test]
    fn other_pictures_are_named() {
        for (bytes, label) in [
            (b"\x00\x00\x00\x1cftypheic\x00\x00\x00\x00".as_slice(), "HEIC"),
            (b"\x00\x00\x00\x1cftypmif1\x00\x00\x00\x00avif", "AVIF"),
            (b"\xff\x0a\x00\x00", "JPEG XL"),
            (b"GIF89a", "GIF"),
        ] {
            assert!(format("a", bytes).unwrap_err().to_string().starts_with(label), "{label}");
        }
        for bytes in [b"".as_slice(), b"x", b"\x00\x00\x00\x18ftyp", b"hello world"] {
            assert!(matches!(format("a.png", bytes), Err(PhotoErrorKind::UnknownFormat)));
        }
    }
}
