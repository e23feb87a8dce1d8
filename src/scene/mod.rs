//! What a scene requires: the angles at which its materials are seen, and the cheapest model within a tolerance.
//!
//! | file | what it holds |
//! |---|---|
//! | `angles` | how often each angle is seen |
//! | `shape` | the angles of built-in shapes |
//! | `facing` | the angles of a rendered facing-ratio pass, and what of it was left out |
//! | `masks` | what tells the materials of a pass apart: ids or mattes |
//! | `tolerance` | the error over the angles that are seen, and the bound on it |
//! | `target` | which cost counts |
//! | `material` | a material of a scene, and what it is measured against |
//! | `curves` | a material in every variant, with its error at every angle |
//! | `plan` | the choice for each material, and what the scene saves |
//! | `saved_scene` | the materials as a plan's file keeps them, so that they can be planned for again |
//! | `scene_json` | these as JSON |
//! | `plan_file` | the plan as versioned JSON, with what it was made from |
//! | `plan_export` | its materials as files of other programs, without what the scene does not need |
//! | `plan_weighing` | how far what such a file says is from the truth, at the angles that are seen |

mod angles;
mod curves;
mod facing;
mod masks;
mod material;
mod plan;
mod plan_export;
mod plan_file;
mod plan_weighing;
mod saved_scene;
mod scene_json;
mod shape;
mod target;
mod tolerance;

pub use angles::{Angles, NODES, node_cosines};
pub use curves::{MaterialCurves, SceneCurves, VariantCurve};
pub use facing::{FacingPass, FacingReport, Seen};
pub use masks::Masks;
pub use material::{SceneMaterial, Source};
pub use plan::{
    Judgement, MaterialPlan, Plan, PlanError, PlanOptions, Saved, Savings, Verdict, plan_scene, plan_with_curves,
};
pub use plan_export::{PlanExport, PlanExportError, PlannedFile};
pub use plan_file::{PLAN_FORMAT, PlanFileError, SavedPlan};
pub use saved_scene::{Place, SavedMaterial, SavedPass, SavedScene, kept_path, scene_sentence};
pub use scene_json::NotPlannable;
pub use shape::{Shape, ShapeError};
pub use target::Target;
pub use tolerance::{SeenError, Tolerance};
