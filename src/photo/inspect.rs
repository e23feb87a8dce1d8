//! What a photograph is, for people and scripts.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Photo, Warning};

/// The answer of `edgewise inspect`; its JSON form is fixed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inspection {
    /// Width after orientation.
    pub width: u32,
    /// Height after orientation.
    pub height: u32,
    /// The rule that made the picture linear.
    pub colour_rule: String,
    /// What a person must know.
    pub warnings: Vec<Warning>,
    /// Linear Rec.709, unclamped, at `"column,row"`; `null` outside the picture.
    pub probes: BTreeMap<String, Option<[f64; 3]>>,
    /// Layers of an EXR that can be chosen by name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<String>,
}

/// Inspects a photograph at some pixels, given as column and row from the top left.
pub fn inspect(photo: &Photo, probes: &[(u32, u32)]) -> Inspection {
    let probe =
        |&(column, row): &(u32, u32)| (format!("{column},{row}"), photo.pixel(column, row).map(|pixel| pixel.rgb.0));
    Inspection {
        width: photo.width,
        height: photo.height,
        colour_rule: photo.colour_rule.to_string(),
        warnings: photo.warnings.clone(),
        probes: probes.iter().map(probe).collect(),
        layers: photo.layers.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_json_form_is_the_fixed_one() {
        let photo = Photo::from_linear("made", 2, 1, vec![[0.25, -0.5, 2.0], [0.0; 3]]);
        let json = serde_json::to_value(inspect(&photo, &[(0, 0), (7, 7)])).unwrap();
        let expected = serde_json::json!({
            "width": 2, "height": 1, "colour_rule": "Linear Rec.709 as made", "warnings": [],
            "probes": { "0,0": [0.25, -0.5, 2.0], "7,7": null },
        });
        assert_eq!(json, expected);
    }
}
