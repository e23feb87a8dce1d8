//! What a plan is made from, as its file keeps it: nothing else need be there to plan again.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Angles, SceneMaterial, Shape, Source};
use crate::metal::Metal;
use crate::preset::Preset;

/// The materials of a scene, each whole, with where it is seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SavedScene {
    /// In the order of the plan.
    pub materials: Vec<SavedMaterial>,
    /// The pass that some of them are seen in.
    pub pass: Option<SavedPass>,
}

/// A material as it was when it was planned for.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedMaterial {
    /// What it is; its file is not read again.
    pub source: Source,
    /// The file that it was read from.
    pub file: Option<String>,
    /// Where it is seen.
    pub place: Place,
    /// How often each angle is seen there; no picture is read again.
    pub angles: Angles,
}

/// Where a material is seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// On a built-in shape.
    Shape(Shape),
    /// At all the angles of the pass.
    Whole,
    /// Where the picture of ids has its number.
    Id(u32),
    /// Where its matte, a file, shows it.
    Matte(String),
}

/// The files of a rendered pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedPass {
    /// The facing ratio.
    pub file: String,
    /// The channel that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channel: Option<String>,
    /// The picture of ids.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ids: Option<String>,
    /// What was found of its pixels, as a sentence.
    pub found: String,
}

impl SavedScene {
    /// The materials as the planner takes them.
    pub fn scene_materials(&self) -> Vec<SceneMaterial> {
        let material =
            |saved: &SavedMaterial| SceneMaterial { source: saved.source.clone(), angles: saved.angles.clone() };
        self.materials.iter().map(material).collect()
    }

    /// Sentences about files that say something else by now, or are gone: each is planned for as it was.
    pub fn changed_files(&self) -> Vec<String> {
        self.materials.iter().filter_map(SavedMaterial::changed_file).collect()
    }
}

impl SavedMaterial {
    fn changed_file(&self) -> Option<String> {
        let file = self.file.as_deref()?;
        let path = Path::new(file);
        let now = match &self.source {
            Source::Metal(_) => Metal::open(path).map(|metal| Source::Metal(metal.into())).map_err(|e| e.to_string()),
            Source::Preset(_) => {
                Preset::load(path).map(|loaded| Source::Preset(loaded.preset.into())).map_err(|e| e.to_string())
            }
        };
        match now {
            Ok(now) if now == self.source => None,
            Ok(_) => Some(format!("{file} has changed since the plan was saved, which keeps what it held then")),
            Err(_) if !path.exists() => Some(format!("{file} is gone; the plan keeps what it held")),
            Err(reason) => Some(format!("{reason}; the plan keeps what the file held")),
        }
    }
}

/// A path as a plan keeps it: from the root, so that it leads there from every folder.
pub fn kept_path(path: &Path) -> String {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned()).to_string_lossy().into_owned()
}

/// The shapes of places, each named once, after what was found of a pass.
pub fn scene_sentence<'a>(found: Option<&str>, places: impl IntoIterator<Item = &'a Place>) -> String {
    let mut parts: Vec<String> = found.map(str::to_owned).into_iter().collect();
    for place in places {
        if let Place::Shape(shape) = place
            && !parts.contains(&shape.label())
        {
            parts.push(shape.label());
        }
    }
    parts.join("; ")
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const ROWS: &str = "wavelength_nm,n,k\n400,1,2\n480,1,2\n560,1,2\n640,1,2\n700,1,2\n";

    fn material(path: &Path) -> SavedMaterial {
        let source = match path.extension() {
            Some(ending) if ending == "json" => Source::Preset(Preset::load(path).unwrap().preset.into()),
            _ => Source::Metal(Metal::open(path).unwrap().into()),
        };
        let file = Some(kept_path(path));
        SavedMaterial { source, file, place: Place::Shape(Shape::Sphere), angles: Shape::Sphere.angles() }
    }

    #[test]
    fn a_file_that_changed_or_is_gone_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let (nk, preset) = (folder.path().join("mine.csv"), folder.path().join("mine.json"));
        fs::write(&nk, ROWS).unwrap();
        Preset::new_authored().save(&preset).unwrap();
        let scene = SavedScene { materials: vec![material(&nk), material(&preset)], pass: None };
        assert!(scene.changed_files().is_empty());
        fs::write(&nk, ROWS.replace("560,1,2", "560,1,3")).unwrap();
        fs::write(&preset, "{}").unwrap();
        let said = scene.changed_files();
        assert!(said[0].contains("mine.csv has changed") && said[1].contains("no Edgewise preset"), "{said:?}");
        fs::remove_file(&nk).unwrap();
        assert!(scene.changed_files()[0].contains("mine.csv is gone"));
    }

    #[test]
    fn a_scene_is_told_by_its_pass_and_each_shape_once() {
        let card = Shape::Card { from_deg: 0.0, to_deg: 60.0 };
        let places = [Place::Shape(Shape::Sphere), Place::Id(4), Place::Shape(card), Place::Shape(Shape::Sphere)];
        assert_eq!(scene_sentence(Some("a pass"), &places), "a pass; Sphere; Card tilted by 0–60°");
        assert_eq!(scene_sentence(None, &places[1..2]), "");
    }
}
