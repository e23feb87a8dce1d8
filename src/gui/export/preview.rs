//! What an export would write, what its reader will show, and what is lost: computed before anything is written.

use std::fmt::Write as _;

use crate::color::{Rgb, RgbSpace};
use crate::export::{Difference, ExportError, Options, Target, export, shown};
use crate::fresnel::FresnelModel;
use crate::gui::panels::curves::sample;
use crate::preset::Preset;

/// What is to be exported, and how.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Asked {
    /// The preset.
    pub preset: Preset,
    /// The kind of file.
    pub target: Target,
    /// The space the scene works in.
    pub space: RgbSpace,
}

impl Asked {
    /// How the library is asked.
    pub(crate) fn options(&self) -> Options {
        Options { space: Some(self.space) }
    }
}

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct Preview {
    /// What the file is called unless a person says otherwise.
    pub file_name: String,
    /// Its size.
    pub bytes: usize,
    /// Its beginning, readable.
    pub text: String,
    /// True where [`Self::text`] is the file and can be pasted as it is.
    pub is_whole: bool,
    /// The preset's curve in the space of the file.
    pub wanted: Vec<Rgb>,
    /// The curve the reader shows.
    pub shown: Vec<Rgb>,
    /// How far these part.
    pub difference: Difference,
    /// Sentences about what is lost.
    pub losses: Vec<String>,
}

/// More lines than this nobody reads in a dialog.
const MOST_LINES: usize = 240;
/// More characters than this of one line make no picture either.
const LONGEST_LINE: usize = 400;

/// Makes the file and reads it as its reader would.
pub(crate) fn preview(asked: &Asked) -> Result<Preview, ExportError> {
    let exported = export(&asked.preset, asked.target, &asked.options())?;
    let seen = shown(&asked.preset, asked.target, &asked.options())?;
    let [file] = &exported.files[..] else { return Err(ExportError::NoPreset) };
    let (text, is_whole) = readable(asked.target, &file.bytes);
    let curve = |model: &FresnelModel| sample(model);
    Ok(Preview {
        file_name: file.name.clone(),
        bytes: file.bytes.len(),
        text,
        is_whole,
        wanted: curve(&seen.wanted),
        shown: curve(&seen.model),
        difference: Difference::between(&seen.wanted, &seen.model, seen.space),
        losses: exported.losses.iter().map(ToString::to_string).collect(),
    })
}

/// The file as people read it, and whether that is all of it.
fn readable(target: Target, bytes: &[u8]) -> (String, bool) {
    if target.is_text() {
        return beginning(&String::from_utf8_lossy(bytes));
    }
    let json = (target == Target::Gltf).then(|| gltf::Glb::from_slice(bytes).ok()).flatten();
    match json.and_then(|glb| serde_json::from_slice::<serde_json::Value>(&glb.json).ok()) {
        Some(document) => (beginning(&crate::preset::pretty_json(&document)).0, false),
        None => (hexadecimal(bytes), false),
    }
}

fn beginning(text: &str) -> (String, bool) {
    let lines = text.lines().count();
    let mut shown = String::new();
    let mut is_whole = lines <= MOST_LINES;
    for line in text.lines().take(MOST_LINES) {
        is_whole &= line.chars().count() <= LONGEST_LINE;
        shown.extend(line.chars().take(LONGEST_LINE));
        shown.push('\n');
    }
    if lines > MOST_LINES {
        let _ = writeln!(shown, "… {} more lines", lines - MOST_LINES);
    }
    (shown, is_whole)
}

/// Sixteen bytes a line, as numbers and as characters.
fn hexadecimal(bytes: &[u8]) -> String {
    const LINES: usize = 24;
    let mut shown = String::new();
    for (line, some) in bytes.chunks(16).take(LINES).enumerate() {
        let numbers: Vec<String> = some.iter().map(|byte| format!("{byte:02x}")).collect();
        let letter = |byte: &u8| if (0x20..0x7f).contains(byte) { char::from(*byte) } else { '.' };
        let letters: String = some.iter().map(letter).collect();
        let _ = writeln!(shown, "{:06x}  {:<47}  {letters}", line * 16, numbers.join(" "));
    }
    let rest = bytes.len().saturating_sub(LINES * 16);
    if rest > 0 {
        let _ = writeln!(shown, "… {rest} more bytes");
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_target_can_be_looked_at_in_every_space_it_knows() {
        for target in Target::ALL {
            for &space in target.spaces() {
                let preview = preview(&Asked { preset: Preset::new_authored(), target, space }).unwrap();
                assert!(preview.text.lines().count() > 2 && preview.bytes > 0, "{target} {space}");
                assert_eq!((preview.wanted.len(), preview.shown.len()), (181, 181));
                assert!(preview.text.lines().count() <= MOST_LINES + 1, "{target}");
            }
        }
    }

    #[test]
    fn what_is_shown_of_a_text_is_the_file_or_says_what_is_left_out() {
        let of =
            |target| preview(&Asked { preset: Preset::new_authored(), target, space: RgbSpace::LinRec709 }).unwrap();
        let glsl = of(Target::Glsl);
        assert!(glsl.is_whole && glsl.text.contains("vec3 fresnel_new_metal(float cosTheta)"));
        let cube = of(Target::Cube);
        assert!(!cube.is_whole && cube.text.ends_with("more lines\n"), "{}", cube.text);
        assert!(of(Target::Gltf).text.contains("EXT_materials_specular_edge_color"));
        assert!(of(Target::Ase).text.starts_with("000000  41 53 45 46"));
    }
}
