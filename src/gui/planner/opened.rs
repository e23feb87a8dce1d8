//! A plan of a file: shown as it was saved until something of it is changed.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::planned::Planned;
use super::scene::PlanScene;
use crate::gui::demonstrations::Told;
use crate::scene::{NotPlannable, SavedPlan};

/// What a file was read as.
pub(super) struct ReadPlan {
    planned: Planned,
    scene: Result<PlanScene, NotPlannable>,
    remarks: Vec<String>,
}

impl ReadPlan {
    /// Reads it; a sentence where it is no plan.
    pub(super) fn read(path: &Path) -> Told<Self> {
        let saved = SavedPlan::load(path).map_err(|error| error.to_string())?;
        let scene = saved.scene.as_ref().map(|scene| PlanScene::of_saved(scene, &saved.plan)).map_err(Clone::clone);
        let remarks = saved.remarks();
        let entries = scene.as_ref().map(PlanScene::keys).unwrap_or_default();
        let planned = Planned::of_file(saved, entries).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Self { planned, scene, remarks })
    }
}

/// The plan that was opened.
pub(crate) struct Opened {
    /// Its file.
    pub path: PathBuf,
    /// The plan as it was saved.
    pub planned: Arc<Planned>,
    /// Sentences about the files of its materials.
    pub remarks: Vec<String>,
    /// What it was made for, or why it cannot be changed.
    scene: Result<PlanScene, NotPlannable>,
    /// What was on the page before.
    before: PlanScene,
}

impl Opened {
    /// Puts the scene of a file, if it has one, in the place of the page's.
    pub(super) fn on_page(path: PathBuf, read: ReadPlan, scene: &mut PlanScene) -> Self {
        let before = scene.clone();
        let ReadPlan { planned, scene: of_file, remarks } = read;
        if let Ok(of_file) = &of_file {
            scene.clone_from(of_file);
        }
        Self { path, planned: planned.into(), remarks, scene: of_file, before }
    }

    /// Why it cannot be changed.
    pub(crate) fn why_fixed(&self) -> Option<&NotPlannable> {
        self.scene.as_ref().err()
    }

    /// True while the page asks for what the file has.
    pub(super) fn is_as_saved(&self, scene: &PlanScene) -> bool {
        self.scene.as_ref().is_ok_and(|of_file| of_file == scene) || self.scene.is_err()
    }

    /// The scene as it was saved; `None` where the file has none.
    pub(super) fn scene(&self) -> Option<&PlanScene> {
        self.scene.as_ref().ok()
    }

    /// What was on the page before.
    pub(super) fn into_before(self) -> PlanScene {
        self.before
    }
}
