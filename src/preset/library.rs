//! The presets that ship with the program: one for each measured material.

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use super::Preset;
use crate::color::RgbSpace;
use crate::metal::preferred_metals;

static FILES: Dir = include_dir!("$CARGO_MANIFEST_DIR/presets");

static PRESETS: LazyLock<Vec<Preset>> = LazyLock::new(|| {
    let text = |file: &include_dir::File| file.contents_utf8().expect("UTF-8").to_owned();
    let preset = |text: String| Preset::from_json(&text).expect("a file that a test has read").preset;
    let mut presets: Vec<Preset> = FILES.files().map(|file| preset(text(file))).collect();
    presets.sort_by(|a, b| a.name.cmp(&b.name));
    presets
});

/// One preset for each material of the library, by name, in linear Rec.709.
pub fn built_in_presets() -> &'static [Preset] {
    &PRESETS
}

/// What the files of `presets/` are made of: the exact r and h of each preferred data set.
pub fn presets_from_metals() -> impl Iterator<Item = Preset> {
    preferred_metals().map(|metal| Preset::from_metal(metal, RgbSpace::LinRec709))
}
