//! The plan as versioned JSON, with what it was made from.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use thiserror::Error;

use super::scene_json::{NotPlannable, read_scene, scene_json};
use super::{MaterialPlan, Plan, SavedMaterial, SavedScene, Source, Verdict};
use crate::file::{FileError, read_text_within, replace_file};
use crate::preset::{FormatError, pretty_json, read_strict_json};

/// The format this version reads and writes, in the field `edgewise_plan`.
pub const PLAN_FORMAT: u64 = 1;

/// The field of what the plan was made from; plans had none before.
const MADE_FROM: &str = "made_from";
/// A material takes about 10 KiB, and 5 KiB more where a pass shows it.
const LARGEST_PLAN_MIB: u64 = 32;
/// Processors differ by less in sums of a spectrum.
const ROUNDING: f64 = 1e-9;
/// So many materials are fitted at once in a gigabyte.
const MOST_MATERIALS: usize = 20_000;

/// Why a plan was not read or written; the sentence names the file.
#[derive(Debug, Error)]
pub enum PlanFileError {
    /// The file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// It holds no plan, or the plan cannot be kept in it.
    #[error("{}: {reason}", path.display())]
    Format {
        /// The file as it was named.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}

/// A plan, and what it was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedPlan {
    /// What was planned.
    pub plan: Plan,
    /// All that planning again takes, or why that cannot be.
    pub scene: Result<SavedScene, NotPlannable>,
}

impl SavedPlan {
    /// The plan as JSON that people can read; numbers read back exactly. An error where a preset of the scene would not.
    pub fn to_json(&self) -> Result<Value, FormatError> {
        let mut document = json!({ "edgewise_plan": PLAN_FORMAT });
        if let (Value::Object(document), Ok(Value::Object(fields))) = (&mut document, serde_json::to_value(&self.plan))
        {
            document.extend(fields);
            if let Ok(scene) = &self.scene {
                document.insert(MADE_FROM.to_owned(), scene_json(scene)?);
            }
        }
        Ok(document)
    }

    /// Sentences about what has changed since the plan was saved: files, which count as they were, and the library, which
    /// counts as it is.
    pub fn remarks(&self) -> Vec<String> {
        let Ok(scene) = &self.scene else { return Vec::new() };
        let pairs = scene.materials.iter().zip(&self.plan.materials);
        let is_other = |(now, planned): &(&SavedMaterial, &MaterialPlan)| match &now.source {
            Source::Metal(metal) => metal.r(self.plan.space).max_abs_difference(planned.r) > ROUNDING,
            Source::Preset(_) => false,
        };
        let told = pairs.filter(is_other).map(|(_, planned)| {
            format!("the data of {} have changed since the plan was saved; planning again takes today's", planned.name)
        });
        scene.changed_files().into_iter().chain(told).collect()
    }

    /// Writes the plan, whole or not at all; see [`replace_file`]. What could not be read again is not written.
    pub fn save(&self, path: &Path) -> Result<(), PlanFileError> {
        let text = self.text().map_err(|reason| PlanFileError::Format { path: path.to_owned(), reason })?;
        Ok(replace_file(path, text.as_bytes())?)
    }

    fn text(&self) -> Result<String, String> {
        let count = self.plan.materials.len();
        if count > MOST_MATERIALS {
            return Err(format!("it would have {count} materials, and at most {MOST_MATERIALS} are read again"));
        }
        let text = pretty_json(&self.to_json().map_err(|error| error.to_string())?);
        if text.len() as u64 > LARGEST_PLAN_MIB << 20 {
            let mib = text.len().div_ceil(1 << 20);
            return Err(format!("it would take {mib} MiB, and at most {LARGEST_PLAN_MIB} MiB are read again"));
        }
        Ok(text)
    }

    /// Reads a plan.
    pub fn load(path: &Path) -> Result<Self, PlanFileError> {
        let text = read_text_within(path, LARGEST_PLAN_MIB)?;
        Self::from_text(&text).map_err(|reason| PlanFileError::Format { path: path.to_owned(), reason })
    }

    fn from_text(text: &str) -> Result<Self, String> {
        let mut value = read_strict_json(text).map_err(|error| format!("it cannot be read as JSON: {error}"))?;
        match value.get("edgewise_plan") {
            None => return Err("it is no plan: the field “edgewise_plan” must name its format".to_owned()),
            Some(version) if *version == json!(PLAN_FORMAT) => {}
            Some(other) => {
                return Err(format!("it has plan format {other}, and this version of Edgewise reads {PLAN_FORMAT}"));
            }
        }
        let made_from = value.as_object_mut().and_then(|document| document.shift_remove(MADE_FROM));
        let plan: Plan = serde_json::from_value(value).map_err(|error| format!("the plan cannot be read: {error}"))?;
        check(&plan)?;
        let scene = match made_from {
            Some(made_from) => read_scene(made_from, &plan).map_err(|reason| format!("{MADE_FROM}: {reason}"))?,
            None => Err(NotPlannable::Nothing),
        };
        Ok(Self { plan, scene })
    }
}

/// A plan of another program or a hand must neither panic nor hang here.
fn check(plan: &Plan) -> Result<(), String> {
    let Plan { tolerance, materials, .. } = plan;
    if !(tolerance.delta_e >= 0.0 && tolerance.delta_e.is_finite()) {
        return Err(format!("the tolerance must be at least 0, not {}", tolerance.delta_e));
    }
    if materials.len() > MOST_MATERIALS {
        return Err(format!("it has {} materials, and at most {MOST_MATERIALS} are read", materials.len()));
    }
    materials.iter().try_for_each(check_material)
}

fn check_material(material: &MaterialPlan) -> Result<(), String> {
    let name = &material.name;
    if !material.judgements.iter().any(|j| j.verdict == Verdict::Chosen && j.variant == material.chosen) {
        return Err(format!("“{name}” has no judgement of the variant that was chosen for it"));
    }
    let is_range = |(from, to): (f64, f64)| 0.0 <= from && from <= to && to <= 90.0;
    if !material.seen_deg.is_none_or(is_range) {
        return Err(format!("“{name}” is seen from one angle of 0–90° to a larger one, or not at all"));
    }
    if !(0.0..=1.0).contains(&material.share) {
        return Err(format!("“{name}” has a share of the scene of 0–1, not {}", material.share));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use super::*;
    use crate::color::Rgb;
    use crate::fresnel::CosTheta;
    use crate::metal::{Metal, metal_by_name};
    use crate::preset::Preset;
    use crate::scene::{Angles, NODES, Place, PlanOptions, SavedPass, Shape, Tolerance, plan_scene};
    use crate::study::{Measure, no_progress};

    fn library(name: &str) -> Source {
        Source::Metal(Arc::new(metal_by_name(name).unwrap().clone()))
    }

    fn on(source: Source, shape: Shape) -> SavedMaterial {
        SavedMaterial { source, file: None, place: Place::Shape(shape), angles: shape.angles() }
    }

    /// A metal of the library, a person's own n and k, an authored preset, and one that a pass shows.
    fn scene(folder: &Path) -> SavedScene {
        let path = folder.join("own.csv");
        std::fs::write(&path, "# name: Own alloy\nwavelength_nm,n,k\n400,1.5,2\n500,.9,2.5\n600,.3,3\n700,.2,4\n")
            .unwrap();
        let own = Source::Metal(Arc::new(Metal::open(&path).unwrap()));
        let preset = Preset { r: Rgb([0.9, 0.6, 0.3]), name: "Mine".to_owned(), ..Preset::new_authored() };
        let mut angles = Angles::default();
        (0..500).for_each(|step| angles.add(CosTheta::new(f64::from(step) / 499.0), 1.0 / 3.0));
        let floor = Shape::Floor { eye_m: 1.7, near_m: 1.0, far_m: 20.0 };
        SavedScene {
            materials: vec![
                on(library("zinc"), Shape::Card { from_deg: 10.0, to_deg: 60.0 }),
                SavedMaterial { file: Some(path.display().to_string()), ..on(own, Shape::Sphere) },
                on(Source::Preset(Box::new(preset)), floor),
                SavedMaterial { source: library("gold"), file: None, place: Place::Id(7), angles },
            ],
            pass: Some(SavedPass {
                file: "/shots/facing.exr".to_owned(),
                channel: Some("NdotV.Y".to_owned()),
                ids: Some("/shots/ids.png".to_owned()),
                found: "facing.exr: 4 pixels".to_owned(),
            }),
        }
    }

    fn planned(scene: SavedScene, delta_e: f64) -> SavedPlan {
        let options = PlanOptions { tolerance: Tolerance { delta_e, on: Measure::P95 }, ..PlanOptions::default() };
        let plan = plan_scene(&scene.scene_materials(), "Everything", &options, &no_progress).unwrap();
        SavedPlan { plan, scene: Ok(scene) }
    }

    #[test]
    fn a_plan_reads_back_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.json");
        let saved = planned(scene(folder.path()), 0.6);
        saved.save(&path).unwrap();
        assert_eq!(SavedPlan::load(&path).unwrap(), saved);
        assert!(std::fs::metadata(&path).unwrap().len() < 100 << 10, "shapes say their angles in a word");
    }

    /// Whatever was planned for: the file alone leads to the plan that the scene would lead to.
    #[test]
    fn planning_again_with_another_tolerance_is_planning_afresh() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.json");
        planned(scene(folder.path()), 3.0).save(&path).unwrap();
        let fresh = planned(scene(folder.path()), 0.1);
        std::fs::remove_file(folder.path().join("own.csv")).unwrap();
        let opened = SavedPlan::load(&path).unwrap();
        assert_ne!(opened.plan.materials, fresh.plan.materials);
        assert_eq!(planned(opened.scene.unwrap(), 0.1), fresh);
    }

    #[test]
    fn a_plan_from_before_scenes_were_kept_still_opens() {
        let folder = tempfile::tempdir().unwrap();
        let saved = planned(scene(folder.path()), 1.0);
        let mut old = saved.to_json().unwrap();
        old.as_object_mut().unwrap().remove(MADE_FROM);
        let opened = SavedPlan::from_text(&old.to_string()).unwrap();
        assert_eq!((opened.plan, opened.scene), (saved.plan, Err(NotPlannable::Nothing)));
    }

    #[test]
    fn a_metal_that_the_library_lacks_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let text = planned(scene(folder.path()), 1.0).to_json().unwrap().to_string();
        let zinc = metal_by_name("zinc").unwrap().id.as_str();
        let opened = SavedPlan::from_text(&text.replace(zinc, "Zn_Nobody")).unwrap();
        assert!(opened.scene.unwrap_err().to_string().contains("Zn_Nobody"));
    }

    #[test]
    fn data_of_the_library_that_have_changed_are_said() {
        let folder = tempfile::tempdir().unwrap();
        let saved = planned(scene(folder.path()), 1.0);
        assert!(saved.remarks().is_empty(), "{:?}", saved.remarks());
        let mut document = saved.to_json().unwrap();
        document["materials"][3]["r"][1] = json!(0.5);
        let opened = SavedPlan::from_text(&document.to_string()).unwrap();
        assert!(opened.remarks()[0].starts_with("the data of Gold have changed"), "{:?}", opened.remarks());
    }

    #[test]
    fn what_is_no_plan_is_refused_in_a_sentence() {
        for (text, reason) in [
            ("", "JSON"),
            ("{\"edgewise_plan\": 1, \"edgewise_plan\": 1}", "given twice"),
            ("{}", "no plan"),
            ("[1]", "no plan"),
            ("{\"edgewise_plan\": 2}", "format 2"),
            ("{\"edgewise_plan\": 1}", "cannot be read"),
        ] {
            assert!(SavedPlan::from_text(text).unwrap_err().contains(reason), "{text}");
        }
    }

    /// What a hand or another program may have made of a plan.
    #[test]
    fn a_damaged_plan_is_refused_in_a_sentence() {
        let folder = tempfile::tempdir().unwrap();
        let sound = planned(scene(folder.path()), 1.0).to_json().unwrap();
        let weights = |with: &str| {
            let rest = ", 0".repeat(NODES - 1);
            serde_json::from_str::<Value>(&format!("[{with}{rest}]")).unwrap()
        };
        let seen = "/made_from/materials/3/weights";
        let cases = [
            ("/materials/1/judgements", json!([]), "“Own alloy” has no judgement"),
            ("/materials/0/seen_deg", json!([0.0, 1e300]), "0–90°"),
            ("/materials/0/share", json!(-0.5), "share of the scene"),
            ("/tolerance/delta_e", json!(-1.0), "the tolerance must be at least 0"),
            (seen, json!([1.0, 2.0]), "257 weights, not 2"),
            (seen, weights("null"), "made_from: "),
            (seen, weights("-1"), "weight"),
            (seen, weights("1e300"), "weight"),
            ("/made_from/materials/0/weights", json!([1.0]), "257 weights, not 1"),
            ("/made_from/materials/3/place", json!("nowhere"), "nowhere"),
            ("/made_from/materials/0/place", json!({"shape": {"kind": "card", "from_deg": 60, "to_deg": 5}}), "tilted"),
            ("/made_from/materials/0/source", json!({"kind": "wood"}), "wood"),
            ("/made_from/materials/1/source/rows", json!([[500, 1, 1]]), "Own alloy"),
            ("/made_from/materials/2/source/preset", json!({"edgewise": 9}), "preset format 9"),
            ("/made_from/materials", json!([]), "0 materials are kept of 4"),
            ("/made_from", json!(3), "made_from"),
        ];
        for (place, with, reason) in cases {
            let mut document = sound.clone();
            match document.pointer_mut(place) {
                Some(value) => *value = with,
                None => {
                    let (parent, field) = place.rsplit_once('/').unwrap();
                    document.pointer_mut(parent).unwrap()[field] = with;
                }
            }
            let refused = SavedPlan::from_text(&document.to_string()).unwrap_err();
            assert!(refused.contains(reason) && !refused.contains('\n'), "{place}: {refused}");
        }
    }

    #[test]
    fn what_is_too_large_is_neither_written_nor_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.json");
        std::fs::write(&path, vec![b' '; (32 << 20) + 1]).unwrap();
        assert!(SavedPlan::load(&path).unwrap_err().to_string().contains("larger than 32 MiB"));
        let one = planned(SavedScene { materials: vec![on(library("gold"), Shape::Sphere)], pass: None }, 1.0);
        let plan = Plan { materials: vec![one.plan.materials[0].clone(); MOST_MATERIALS + 1], ..one.plan };
        let many = SavedPlan { plan, scene: Err(NotPlannable::Nothing) };
        let other = folder.path().join("other.json");
        assert!(many.save(&other).unwrap_err().to_string().contains("20001 materials") && !other.exists());
        let bare = json!({ "name": "x", "metal": null, "r": [0, 0, 0], "h": [0, 0, 0], "roughness": 0, "share": 0,
            "seen_deg": null, "chosen": "exact", "parameters": null, "judgements": [], "notes": [] });
        let mut document =
            SavedPlan { plan: Plan { materials: Vec::new(), ..many.plan }, scene: many.scene }.to_json().unwrap();
        document["materials"] = json!(vec![bare; MOST_MATERIALS + 1]);
        assert!(SavedPlan::from_text(&document.to_string()).unwrap_err().contains("at most 20000"));
    }
}
