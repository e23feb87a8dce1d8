//! Rendered photographs whose true r and h are known, made from measured n and k.
//!
//! They never pass through the r, h model: a pixel is the spectral reflectance of a metal at its angle
//! times the light it mirrors. Three of them ship inside the program; tests make many more.

mod camera;
mod gallery;
mod library;
mod scene;
mod surroundings;

pub use camera::{Camera, camera_jpeg, camera_tone, linear_png};
pub use gallery::{Rendered, SampleError, render_all};
pub use library::{Sample, SampleFacts, Truth, sample, samples};
pub use scene::{Ball, Patch, Rod, Scene};
pub use surroundings::{Dome, Floor, Panorama, PanoramaError, Tent, Vec3};
