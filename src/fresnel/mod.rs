//! Fresnel models: one file each, with the equation it implements.
//!
//! Scalar functions take one channel; [`FresnelModel`] applies them to three. What a truth or a fit evaluates most also
//! comes over slices.

mod angle;
mod conductor;
mod conductor_over;
mod f82;
mod feasible;
mod generalized_schlick;
mod gulbrandsen;
mod hoffman;
mod lazanyi;
mod model;
mod schlick;
mod series;

pub use angle::{COS_THETA_MAX, CosTheta, THETA_MAX_DEG, whole_degrees};
pub(crate) use conductor::Root;
pub use conductor::{conductor, normal_reflectance};
pub use conductor_over::{conductor_over_angles, conductor_over_indices};
pub use f82::{f82_tint, h_from_r_t, t_from_r_h};
pub use feasible::{angle_of_minimum_deg, feasible_h, nearest_feasible_h, reachable_h, reflectance_range};
pub use generalized_schlick::generalized_schlick;
pub use gulbrandsen::{ARTISTIC_IOR_MAX_R, Nk, gulbrandsen, gulbrandsen_over_angles, nk_from_r_g, r_g_from_nk};
pub use hoffman::{
    PEAK_GAIN, SCHLICK_GAIN, Weights, a_from_r_h, h_from_r_a, h_of_schlick, hemispherical_mean, hoffman,
};
pub use lazanyi::lazanyi;
pub use model::{FresnelModel, ModelKind};
pub use schlick::{SCHLICK_WEIGHT_AT_MAX, schlick, schlick_at_theta_max};
pub use series::SchlickSeries;
