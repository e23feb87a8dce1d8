//! Spheres, strips and difference pictures, on the CPU.
//!
//! A [`RadialTable`] holds the reflectance of anything over cos θ; a [`SphereView`] holds what a
//! sphere of one size shows of one [`Light`]. Rendering multiplies the two: into a [`Picture`] in linear light, or into
//! the codes of a screen at once.

mod difference;
mod disc;
mod encode;
mod environment;
mod facets;
mod file;
mod ggx;
mod light;
mod picture;
mod radial;
mod row;
mod screen;
mod sphere;
mod srgb8;
mod strip;

pub use difference::{DeltaEMap, false_colour};
pub use environment::Environment;
pub use file::{SaveError, write_atomically};
pub use light::Light;
pub use picture::Picture;
pub use radial::RadialTable;
pub use sphere::SphereView;
pub use srgb8::Srgb8Picture;
pub use strip::{strip_angles, strip_picture};
