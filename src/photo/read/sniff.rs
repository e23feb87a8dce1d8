//! Which format a file is, by its content; raw files also by their name.

use crate::photo::PhotoErrorKind;

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Png,
    Jpeg,
    Exr,
}

impl Format {
    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Exr => "OpenEXR",
        }
    }
}

/// Extensions of camera raw files.
const RAW_EXTENSIONS: [(&str, &str); 24] = [
    ("3fr", "Hasselblad 3FR"),
    ("arw", "Sony ARW"),
    ("cr2", "Canon CR2"),
    ("cr3", "Canon CR3"),
    ("crw", "Canon CRW"),
    ("dcr", "Kodak DCR"),
    ("dng", "DNG"),
    ("erf", "Epson ERF"),
    ("fff", "Hasselblad FFF"),
    ("iiq", "Phase One IIQ"),
    ("kdc", "Kodak KDC"),
    ("mef", "Mamiya MEF"),
    ("mos", "Leaf MOS"),
    ("mrw", "Minolta MRW"),
    ("nef", "Nikon NEF"),
    ("nrw", "Nikon NRW"),
    ("orf", "Olympus ORF"),
    ("pef", "Pentax PEF"),
    ("raf", "Fujifilm RAF"),
    ("raw", "RAW"),
    ("rw2", "Panasonic RW2"),
    ("rwl", "Leica RWL"),
    ("srw", "Samsung SRW"),
    ("x3f", "Sigma X3F"),
];

/// The format of a file, or why it is not read.
pub(super) fn format(name: &str, bytes: &[u8]) -> Result<Format, PhotoErrorKind> {
    let starts = |magic: &[u8]| bytes.starts_with(magic);
    match bytes {
        _ if starts(b"\x89PNG\r\n\x1a\n") => Ok(Format::Png),
        _ if starts(b"\xff\xd8\xff") => Ok(Format::Jpeg),
        _ if starts(&[0x76, 0x2f, 0x31, 0x01]) => Ok(Format::Exr),
        _ => Err(refusal(name, bytes)),
    }
}

fn refusal(name: &str, bytes: &[u8]) -> PhotoErrorKind {
    match raw_by_content(bytes).or_else(|| raw_by_name(name)) {
        Some(raw) => PhotoErrorKind::Raw(raw),
        None => other(bytes).map_or(PhotoErrorKind::UnknownFormat, PhotoErrorKind::OtherFormat),
    }
}

fn raw_by_name(name: &str) -> Option<&'static str> {
    let (_, extension) = name.rsplit_once('.')?;
    let known = RAW_EXTENSIONS.iter().find(|(known, _)| extension.eq_ignore_ascii_case(known));
    known.map(|(_, label)| *label)
}

/// Raw formats with a signature of their own.
fn raw_by_content(bytes: &[u8]) -> Option<&'static str> {
    let at = |offset: usize, magic: &[u8]| bytes.get(offset..).is_some_and(|rest| rest.starts_with(magic));
    let signatures: [(usize, &[u8], &'static str); 10] = [
        (8, b"CR\x02\x00", "Canon CR2"),
        (4, b"ftypcrx ", "Canon CR3"),
        (6, b"HEAPCCDR", "Canon CRW"),
        (0, b"FUJIFILMCCD-RAW", "Fujifilm RAF"),
        (0, b"IIRO", "Olympus ORF"),
        (0, b"IIRS", "Olympus ORF"),
        (0, b"MMOR", "Olympus ORF"),
        (0, b"IIU\x00", "Panasonic RW2"),
        (0, b"\x00MRM", "Minolta MRW"),
        (0, b"FOVb", "Sigma X3F"),
    ];
    signatures.iter().find(|(offset, magic, _)| at(*offset, magic)).map(|(_, _, label)| *label)
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
