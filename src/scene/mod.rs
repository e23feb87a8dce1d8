//! What a scene requires: the angles at which its materials are seen, and the cheapest model within a tolerance.
//!
//! | file | what it holds |
//! |---|---|
//! | `angles` | how often each angle is seen |
//! | `shape` | the angles of built-in shapes |
//! | `facing` | the angles of a rendered facing-ratio pass, of each material by ids or mattes |
//! | `tolerance` | the error over the angles that are seen, and the bound on it |
//! | `target` | which cost counts |
//! | `material` | a material of a scene, and what it is measured against |
//! | `curves` | a material in every variant, with its error at every angle |
//! | `plan` | the choice for each material, and what the scene saves |
//! | `plan_file` | the plan as versioned JSON |
//! | `plan_export` | its materials as files of other programs, without what the scene does not need |
//! | `plan_weighing` | how far what such a file says is from the truth, at the angles that are seen |

mod angles;
mod curves;
mod facing;
mod material;
mod plan;
mod plan_export;
mod plan_file;
mod plan_weighing;
mod shape;
mod target;
mod tolerance;

pub use angles::{Angles, NODES, node_cosines};
pub use curves::{MaterialCurves, SceneCurves, VariantCurve};
pub use facing::{FacingPass, FacingReport, Masks, Seen};
pub use material::{SceneMaterial, Source};
pub use plan::{
    Judgement, MaterialPlan, Plan, PlanError, PlanOptions, Saved, Savings, Verdict, plan_scene, plan_with_curves,
};
pub use plan_export::{PlanExport, PlanExportError, PlannedFile};
pub use plan_file::{PLAN_FORMAT, PlanFileError};
pub use shape::{Shape, ShapeError};
pub use target::Target;
pub use tolerance::{SeenError, Tolerance};
