//! The plan as versioned JSON.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use thiserror::Error;

use super::Plan;
use crate::file::{FileError, read_text, replace_file};
use crate::preset::{pretty_json, read_strict_json};

/// The format this version reads and writes, in the field `edgewise_plan`.
pub const PLAN_FORMAT: u64 = 1;

/// Why a plan was not read or written; the sentence names the file.
#[derive(Debug, Error)]
pub enum PlanFileError {
    /// The file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// It holds no plan.
    #[error("{}: {reason}", path.display())]
    Format {
        /// The file as it was named.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}

impl Plan {
    /// The plan as JSON that people can read; numbers read back exactly.
    pub fn to_json(&self) -> Value {
        let mut document = json!({ "edgewise_plan": PLAN_FORMAT });
        if let (Value::Object(document), Ok(Value::Object(fields))) = (&mut document, serde_json::to_value(self)) {
            document.extend(fields);
        }
        document
    }

    /// Writes the plan, whole or not at all; see [`replace_file`].
    pub fn save(&self, path: &Path) -> Result<(), PlanFileError> {
        Ok(replace_file(path, pretty_json(&self.to_json()).as_bytes())?)
    }

    /// Reads a plan.
    pub fn load(path: &Path) -> Result<Self, PlanFileError> {
        Self::from_text(&read_text(path)?).map_err(|reason| PlanFileError::Format { path: path.to_owned(), reason })
    }

    fn from_text(text: &str) -> Result<Self, String> {
        let value = read_strict_json(text).map_err(|error| format!("it cannot be read as JSON: {error}"))?;
        match value.get("edgewise_plan") {
            None => return Err("it is no plan: the field “edgewise_plan” must name its format".to_owned()),
            Some(version) if *version == json!(PLAN_FORMAT) => {}
            Some(other) => {
                return Err(format!("it has plan format {other}, and this version of Edgewise reads {PLAN_FORMAT}"));
            }
        }
        let plan: Self = serde_json::from_value(value).map_err(|error| format!("the plan cannot be read: {error}"))?;
        plan.checked()
    }

    /// A plan of another program or a hand must not panic here.
    fn checked(self) -> Result<Self, String> {
        let has_choice = |material: &super::MaterialPlan| {
            material.judgements.iter().any(|j| j.verdict == super::Verdict::Chosen && j.variant == material.chosen)
        };
        match self.materials.iter().find(|material| !has_choice(material)) {
            Some(material) => {
                Err(format!("“{}” has no judgement of the variant that was chosen for it", material.name))
            }
            None => Ok(self),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::metal::metal_by_name;
    use crate::scene::{PlanOptions, SceneMaterial, Shape, Source, plan_scene};
    use crate::study::no_progress;

    fn plan() -> Plan {
        let material = |name| SceneMaterial {
            source: Source::Metal(Arc::new(metal_by_name(name).unwrap().clone())),
            angles: Shape::Sphere.angles(),
        };
        let materials = [material("gold"), material("zinc")];
        plan_scene(&materials, "Sphere", &PlanOptions::default(), &no_progress).unwrap()
    }

    #[test]
    fn a_plan_reads_back_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.json");
        let plan = plan();
        plan.save(&path).unwrap();
        assert_eq!(Plan::load(&path).unwrap(), plan);
    }

    #[test]
    fn what_is_no_plan_is_refused_in_a_sentence() {
        for (text, reason) in [
            ("", "JSON"),
            ("{\"edgewise_plan\": 1, \"edgewise_plan\": 1}", "given twice"),
            ("{}", "no plan"),
            ("{\"edgewise_plan\": 2}", "format 2"),
            ("{\"edgewise_plan\": 1}", "cannot be read"),
        ] {
            assert!(Plan::from_text(text).unwrap_err().contains(reason), "{text}");
        }
        let mut other = plan();
        other.materials[1].judgements.clear();
        let text = other.to_json().to_string();
        assert!(Plan::from_text(&text).unwrap_err().contains("Zinc"));
    }
}
