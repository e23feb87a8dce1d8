//! Camera raw files, by name and by content: they are recognised so that they can be refused by name.

/// Extensions of camera raw files.
const EXTENSIONS: [(&str, &str); 24] = [
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

/// Signatures at an offset.
const SIGNATURES: [(usize, &[u8], &str); 10] = [
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

/// The raw format that the extension of a name stands for.
pub(super) fn by_name(name: &str) -> Option<&'static str> {
    let (_, extension) = name.rsplit_once('.')?;
    let known = EXTENSIONS.iter().find(|(known, _)| extension.eq_ignore_ascii_case(known));
    known.map(|(_, label)| *label)
}

/// The raw format that the bytes of a file show, by a signature or by the tags of a TIFF.
pub(super) fn by_content(bytes: &[u8]) -> Option<&'static str> {
    let at = |offset: usize, magic: &[u8]| bytes.get(offset..).is_some_and(|rest| rest.starts_with(magic));
    let signed = SIGNATURES.iter().find(|(offset, magic, _)| at(*offset, magic)).map(|(_, _, label)| *label);
    signed.or_else(|| by_tags(bytes))
}

const NEW_SUBFILE_TYPE: u16 = 254;
const COMPRESSION: u16 = 259;
const PHOTOMETRIC_INTERPRETATION: u16 = 262;
const MAKE: u16 = 271;
const DNG_VERSION: u16 = 50_706;

/// Raw files that are TIFFs: DNG says so; others hold a colour filter array, a maker's compression, or a camera's
/// thumbnail in the first place (TIFF/EP, ISO 12234-2).
fn by_tags(bytes: &[u8]) -> Option<&'static str> {
    let tags = first_directory(bytes)?;
    let value = |tag| tags.iter().find(|(known, _)| *known == tag).map(|(_, value)| *value);
    let is_mosaic = matches!(value(PHOTOMETRIC_INTERPRETATION), Some(32_803 | 34_892));
    let is_maker_compressed = matches!(value(COMPRESSION), Some(32_767 | 34_713 | 65_535));
    let is_thumbnail = value(MAKE).is_some() && value(NEW_SUBFILE_TYPE).is_some_and(|kind| kind & 1 == 1);
    match value(DNG_VERSION) {
        Some(_) => Some("DNG"),
        None if is_mosaic || is_maker_compressed || is_thumbnail => Some("built on TIFF"),
        None => None,
    }
}

/// Tags of the first directory of a classic TIFF, with their first value where it is a short or a long.
fn first_directory(bytes: &[u8]) -> Option<Vec<(u16, u32)>> {
    let is_little = match bytes.get(..4)? {
        b"II\x2a\x00" => true,
        b"MM\x00\x2a" => false,
        _ => return None,
    };
    let short = |at: usize| {
        let pair = *bytes.get(at..)?.first_chunk()?;
        Some(if is_little { u16::from_le_bytes(pair) } else { u16::from_be_bytes(pair) })
    };
    let long = |at: usize| {
        let quad = *bytes.get(at..)?.first_chunk()?;
        Some(if is_little { u32::from_le_bytes(quad) } else { u32::from_be_bytes(quad) })
    };
    let start = long(4)? as usize;
    let count = usize::from(short(start)?);
    let entry = |index: usize| {
        let at = start + 2 + 12 * index;
        let value = if short(at + 2)? == 3 { short(at + 8)?.into() } else { long(at + 8)? };
        Some((short(at)?, value))
    };
    Some((0..count).map_while(entry).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A classic little-endian TIFF of one directory.
    fn tiff(tags: &[(u16, u32)]) -> Vec<u8> {
        let mut bytes = b"II\x2a\x00\x08\x00\x00\x00".to_vec();
        bytes.extend((tags.len() as u16).to_le_bytes());
        for (tag, value) in tags {
            bytes.extend([tag.to_le_bytes(), 4u16.to_le_bytes()].concat());
            bytes.extend([1u32.to_le_bytes(), value.to_le_bytes()].concat());
        }
        bytes
    }

    #[test]
    fn raw_files_built_on_tiff_are_found_and_pictures_are_not() {
        assert_eq!(by_content(&tiff(&[(DNG_VERSION, 1)])), Some("DNG"));
        assert_eq!(by_content(&tiff(&[(PHOTOMETRIC_INTERPRETATION, 32_803)])), Some("built on TIFF"));
        assert_eq!(by_content(&tiff(&[(NEW_SUBFILE_TYPE, 1), (MAKE, 8)])), Some("built on TIFF"));
        assert_eq!(by_content(&tiff(&[(PHOTOMETRIC_INTERPRETATION, 2), (MAKE, 8)])), None);
        assert_eq!(by_content(b"II\x2a\x00\xff\xff\xff\xff"), None);
        assert_eq!(by_content(b"II\x2a"), None);
    }
}
