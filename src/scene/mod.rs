//! What a scene requires: the angles at which its materials are seen, and the cheapest model within a tolerance.
//!
//! | file | what it holds |
//! |---|---|
//! | `angles` | how often each angle is seen |
//! | `shape` | the angles of built-in shapes |
//! | `facing` | the angles of a rendered facing-ratio pass, of each material by ids or mattes |
//! | `tolerance` | the error over the angles that are seen, and the bound on it |
//! | `target` | which cost counts |
//! | `curves` | a material in every variant, with its error at every angle |
//! | `plan` | the choice for each material, and what the scene saves |
//! | `plan_file` | the plan as versioned JSON |

mod angles;
mod curves;
mod facing;
mod plan;
mod plan_file;
mod shape;
mod target;
mod tolerance;

pub use angles::{Angles, NODES, node_cosines};
pub use curves::{MaterialCurves, VariantCurve};
pub use facing::{FacingPass, FacingReport, Masks, Seen};
pub use plan::{
    Judgement, MaterialPlan, Plan, PlanError, PlanOptions, Savings, SceneMaterial, Source, Verdict, plan_scene,
};
pub use plan_file::{PLAN_FORMAT, PlanFileError};
pub use shape::{Shape, ShapeError};
pub use target::Target;
pub use tolerance::{SeenError, Tolerance};
