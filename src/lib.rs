//! Edgewise: author how metals reflect, with two colours an artist can see.
//!
//! A photograph or a measured metal becomes r, the reflectance facing the surface, and h, the
//! reflectance at 81.8° (Hoffman, "Fresnel Equations Considered Harmful"); these are looked at,
//! changed, compared with the truth, saved as a preset and exported to renderers.
//!
//! | module | what it holds |
//! |---|---|
//! | [`file`] | files, whole or not at all |
//! | [`number`] | extremes and the median, with which NaN is not lost |
//! | [`color`] | linear triples, RGB spaces, adaptation, Lab and CIEDE2000, encodings |
//! | [`spectrum`] | the observer, the illuminants, the way from a spectrum to RGB |
//! | [`fresnel`] | one file per model, and the region of reflectances |
//! | [`kernel`] | the same models in 32 bits over slices, on the processor's vectors |
//! | [`metal`] | measured n and k, and the ground truth they give |
//! | [`fit`] | parameters of each model for a measured metal; conversions |
//! | [`photo`] | from the pixels of a photograph to r and h |
//! | [`sample`] | rendered photographs whose r and h are known |
//! | [`preset`] | the document, its file, the library |
//! | [`study`] | the paper's evidence, measured |
//! | [`scene`] | the angles a scene sees, and the cheapest model within a tolerance |
//! | [`render`] | spheres and difference pictures, on the CPU |
//! | [`figure`] | plots and strips as SVG or PNG |
//! | [`export`] | what a preset says to each renderer |
//! | [`import`] | what other programs say about a metal |
//!
//! The library knows nothing of windows, arguments or printing: `cli` and `gui` are two shells over it.

pub mod color;
pub mod export;
pub mod figure;
pub mod file;
pub mod fit;
pub mod fresnel;
pub mod import;
pub mod kernel;
pub mod metal;
pub mod number;
pub mod photo;
pub mod preset;
pub mod render;
pub mod sample;
pub mod scene;
pub mod spectrum;
pub mod study;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "gui")]
pub mod gui;
