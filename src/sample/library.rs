//! The photographs that ship with the program.

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, RgbSpace};
use crate::metal::Metal;
use crate::photo::{Card, MatchRequest};

static FILES: Dir = include_dir!("$CARGO_MANIFEST_DIR/assets/samples");

static SAMPLES: LazyLock<Vec<Sample>> = LazyLock::new(|| {
    let mut samples: Vec<Sample> = FILES.files().filter_map(built_in).collect();
    samples.sort_by_key(|sample| sample.facts.order);
    samples
});

/// A built-in photograph with what is known about it.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The stable identifier, the stem of its file.
    pub id: &'static str,
    /// The picture file.
    pub bytes: &'static [u8],
    /// What its sidecar says.
    pub facts: SampleFacts,
}

/// The sidecar of a sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SampleFacts {
    /// The title people read.
    pub title: String,
    /// One sentence about what it shows and what to look for.
    pub description: String,
    /// Place in lists.
    pub order: u32,
    /// Name of the picture file beside the sidecar.
    pub file: String,
    /// Always true: it was rendered, no camera was there. Shown wherever the picture is.
    pub rendered: bool,
    /// Identifier of the metal in the library.
    pub metal: String,
    /// The surroundings.
    pub environment: String,
    /// The licence of the surroundings.
    pub environment_licence: String,
    /// What a person would mark.
    pub request: MatchRequest,
    /// Neutral patches in the picture, which a person may mark to undo the tone curve.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub greys: Vec<Card>,
    /// What a match should find.
    pub truth: Truth,
}

/// The true colours of a sample's metal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// The space of r and h.
    pub space: RgbSpace,
    /// Reflectance facing the surface.
    pub r: Rgb,
    /// Reflectance at 81.8°.
    pub h: Rgb,
}

impl Truth {
    /// The spectral truth of a metal in linear Rec.709.
    pub fn of(metal: &Metal) -> Self {
        let space = RgbSpace::LinRec709;
        Self { space, r: metal.r(space), h: metal.h(space) }
    }
}

fn built_in(sidecar: &'static include_dir::File) -> Option<Sample> {
    let is_json = sidecar.path().extension().is_some_and(|extension| extension == "json");
    let text = sidecar.contents_utf8().filter(|_| is_json)?;
    let facts: SampleFacts = serde_json::from_str(text).expect("a sidecar that a test has read");
    let bytes = FILES.get_file(&facts.file).expect("a picture that a test has read").contents();
    Some(Sample { id: sidecar.path().file_stem()?.to_str()?, bytes, facts })
}

/// Every built-in photograph, in the order of lists.
pub fn samples() -> &'static [Sample] {
    &SAMPLES
}

/// The built-in photograph of an identifier.
pub fn sample(id: &str) -> Option<&'static Sample> {
    samples().iter().find(|sample| sample.id == id)
}
