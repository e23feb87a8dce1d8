//! File names and identifiers from what people call their metals.

use std::collections::HashMap;

use sha2::{Digest, Sha256};

use crate::preset::{Preset, file_stem};

/// What the names of a batch depend on: little enough to be kept of ten thousand presets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameKey {
    /// The stem the preset has where no other is called so.
    pub stem: String,
    fingerprint: [u8; 4],
}

impl NameKey {
    /// The key of a preset.
    pub fn of(preset: &Preset) -> Self {
        Self { stem: file_stem(&preset.name), fingerprint: fingerprint(preset) }
    }

    fn hashed(&self) -> String {
        let digits: String = self.fingerprint.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("{}-{digits}", self.stem)
    }
}

/// [`unique_stems`] of presets.
pub fn file_stems(presets: &[Preset]) -> Vec<String> {
    unique_stems(&presets.iter().map(NameKey::of).collect::<Vec<_>>())
}

/// One stem for each key, in their order, no two alike.
///
/// Where names meet, each of them gets a hash of its own values: the result does not depend on the order
/// of the presets. Copies of one preset are numbered.
pub fn unique_stems(keys: &[NameKey]) -> Vec<String> {
    let mut uses = HashMap::<&str, usize>::new();
    keys.iter().for_each(|key| *uses.entry(&key.stem).or_default() += 1);
    let is_alone = |stem: &str| uses.get(stem) == Some(&1);
    let mut copies = HashMap::<String, usize>::new();
    let mut stem_of = |key: &NameKey| {
        if is_alone(&key.stem) {
            return key.stem.clone();
        }
        let hashed = key.hashed();
        let count = copies.entry(hashed.clone()).or_default();
        loop {
            *count += 1;
            let stem = if *count == 1 { hashed.clone() } else { format!("{hashed}-{count}") };
            // Somebody may have called a preset like a hash.
            if !is_alone(&stem) {
                return stem;
            }
        }
    };
    keys.iter().map(&mut stem_of).collect()
}

/// Four bytes of what a file would say.
fn fingerprint(preset: &Preset) -> [u8; 4] {
    let mut hash = Sha256::new();
    hash.update(preset.name.as_bytes());
    hash.update(preset.space.id().as_bytes());
    for value in preset.r.0.into_iter().chain(preset.h.0).chain([preset.roughness]) {
        hash.update(value.to_le_bytes());
    }
    let digest = hash.finalize();
    [digest[0], digest[1], digest[2], digest[3]]
}

/// A name every shading language and scene format takes: ASCII letters, digits and single underscores.
pub fn identifier(name: &str) -> String {
    let mut identifier = String::new();
    for c in name.chars() {
        let c = if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
        if !(c == '_' && (identifier.is_empty() || identifier.ends_with('_'))) && identifier.len() < 64 {
            identifier.push(c);
        }
    }
    let identifier = identifier.trim_end_matches('_');
    match identifier.chars().next() {
        None => "metal".to_owned(),
        Some(c) if c.is_ascii_digit() => format!("metal_{identifier}"),
        Some(_) => identifier.to_owned(),
    }
}

/// A name for a comment of one line: no control characters or line separators, no backslash to continue it.
pub(super) fn one_line(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\\' => '/',
            '\u{2028}' | '\u{2029}' | '\u{fffe}' | '\u{ffff}' => ' ',
            _ if c.is_control() => ' ',
            _ => c,
        })
        .collect()
}

/// [`one_line`] for readers that take ASCII only.
pub(super) fn one_ascii_line(text: &str) -> String {
    one_line(text).chars().map(ascii).collect()
}

fn ascii(c: char) -> &'static str {
    const GRAPHIC: &str =
        " !\"#$%&'()*+,-./0123456789:;<=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_`abcdefghijklmnopqrstuvwxyz{|}~";
    match c {
        '→' => "->",
        'Δ' => "d",
        'θ' => "theta",
        '°' => " degrees",
        '–' => "-",
        '“' | '”' => "\"",
        '⁵' => "^5",
        _ => GRAPHIC.find(c).map_or("?", |at| &GRAPHIC[at..=at]),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn identifiers_are_identifiers(name in any::<String>()) {
            let id = identifier(&name);
            prop_assert!(id.starts_with(|c: char| c.is_ascii_lowercase()));
            prop_assert!(id.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && !id.contains("__"), "{}", id);
        }

        #[test]
        fn comments_stay_on_their_line(name in any::<String>()) {
            let line = one_ascii_line(&name);
            prop_assert!(line.bytes().all(|b| (0x20..0x7f).contains(&b) && b != b'\\'), "{}", line);
        }
    }

    #[test]
    fn identifiers_of_names_people_use() {
        assert_eq!(identifier("18-carat Gold"), "metal_18_carat_gold");
        assert_eq!(identifier("真鍮"), "metal");
    }

    fn named(name: &str, roughness: f64) -> Preset {
        Preset { name: name.to_owned(), roughness, ..Preset::new_authored() }
    }

    #[test]
    fn a_batch_has_no_two_alike_in_any_order() {
        let mut presets = vec![named("Gold", 0.1), named("gold!", 0.2), named("Gold", 0.3), named("Tin", 0.1)];
        let stems = file_stems(&presets);
        assert_eq!(stems.iter().collect::<BTreeSet<_>>().len(), 4);
        assert_eq!(stems[3], "tin");
        presets.reverse();
        assert_eq!(file_stems(&presets), stems.into_iter().rev().collect::<Vec<_>>());
    }

    #[test]
    fn copies_are_numbered() {
        let stems = file_stems(&[named("Gold", 0.1), named("Gold", 0.1)]);
        assert_eq!(stems[1], format!("{}-2", stems[0]));
    }

    #[test]
    fn a_name_like_a_hash_is_nobody_elses() {
        let twice = [named("Gold", 0.1), named("Gold", 0.2)];
        let hashed = file_stems(&twice).remove(0);
        let [first, second] = twice;
        let stems = file_stems(&[first, second, named(&hashed, 0.3)]);
        assert_eq!(stems[2], hashed);
        assert_eq!(stems.iter().collect::<BTreeSet<_>>().len(), 3);
    }
}
