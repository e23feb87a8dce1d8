//! What a preset is called on disk.

/// A path component may have 255 bytes; this leaves room for a hash, the space and the extension.
const MAX_STEM_BYTES: usize = 120;

/// Names that Windows gives to devices, whatever the extension.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "com", "lpt"];

/// A file name without extension: letters and digits of any script, `-` and `_`, in lower case.
///
/// A function of the name alone, so that exporting again replaces the same file.
pub fn file_stem(name: &str) -> String {
    let mut stem = String::new();
    for c in name.chars().flat_map(char::to_lowercase) {
        let c = if c.is_alphanumeric() || c == '_' { c } else { '-' };
        if !(c == '-' && (stem.is_empty() || stem.ends_with('-'))) && stem.len() + c.len_utf8() <= MAX_STEM_BYTES {
            stem.push(c);
        }
    }
    let stem = stem.trim_end_matches('-');
    match stem {
        "" => "preset".to_owned(),
        _ if is_device(stem) => format!("_{stem}"),
        _ => stem.to_owned(),
    }
}

fn is_device(stem: &str) -> bool {
    DEVICES.contains(&stem.trim_end_matches(|c: char| c.is_ascii_digit())) && stem.len() <= 4
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn stems_are_safe(name in any::<String>()) {
            let stem = file_stem(&name);
            prop_assert!(!stem.is_empty() && stem.len() <= MAX_STEM_BYTES + 1);
            prop_assert!(stem.chars().all(|c| c.is_alphanumeric() || c == '-' || c == '_'), "{}", stem);
        }
    }

    #[test]
    fn names_people_use() {
        assert_eq!(file_stem("Brass, 70 % copper"), "brass-70-copper");
        assert_eq!(file_stem("Gold (Olmon, 2012)"), "gold-olmon-2012");
        assert_eq!(file_stem("../../etc/passwd"), "etc-passwd");
        assert_eq!(file_stem("真鍮"), "真鍮");
        assert_eq!(file_stem("..."), "preset");
        assert_eq!(file_stem("COM1"), "_com1");
        assert_eq!(file_stem("Concrete"), "concrete");
    }
}
