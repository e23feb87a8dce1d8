//! Reflectance in 32 bits over slices, on the vectors the processor has: for pictures, tables and measurements.
//!
//! | file | what it holds |
//! |---|---|
//! | `real`, `lanes`, `level` | the numbers a formula is written for: scalars, and vectors of an instruction set |
//! | `form` | a formula with its constants, at one cosine and over slices |
//! | `schlick`, `hoffman`, `lazanyi` | Schlick; Hoffman and F82-tint; Lazányi and generalized Schlick |
//! | `index` | exact F of n and k, in the steps between its roots |
//! | `conductor` | as materials: n and k, Gulbrandsen's r and g, the dielectric |
//! | `convert` | r and h to t, r and g to n and k, and back |
//! | `spectral`, `polynomial`, `table` | N wavelengths; one metal baked into coefficients or a table |
//! | `lab`, `delta_e` | L*a*b* and CIEDE2000 |
//! | `textbook` | what others print, to measure against |
//! | `operations` | how many operations a formula is made of |
//!
//! Each formula is one text over [`Real`]. As vectors it is the kernel that [`Material::over`] dispatches to the
//! instruction set of the machine at run time (4, 8 or 16 numbers at a time); as `f32` it is what a shader computes;
//! as `f64` it is held against [`crate::fresnel`]. Slices are structures of arrays: one for each channel.
//!
//! No finite cosine and no finite parameters, of a material or of pixels, make a NaN or an infinity; a NaN stays one.
//! Textbook forms promise nothing.

mod conductor;
mod convert;
mod delta_e;
mod form;
mod hoffman;
mod index;
mod lab;
mod lanes;
mod lazanyi;
mod level;
mod operations;
mod polynomial;
mod real;
mod schlick;
mod spectral;
mod table;
pub mod textbook;

pub use conductor::{Conductor, ConductorAndAbsorption, ConductorOfPixels, Dielectric, GulbrandsenOfPixels};
pub use convert::{EdgeOfTint, IndexOfTint, TintOfEdge, TintOfIndex};
pub use delta_e::{delta_e, delta_e_over, operations_of_delta_e};
pub use form::{Form, Material, Planes, at_pixel, over_pixels};
pub use hoffman::{Basis, Exported, F82OfPixels, Factored};
pub use lab::LabConversion;
pub use lazanyi::{GeneralizedSchlick, Lazanyi};
pub use level::{Level, level_id, levels};
pub use operations::Operations;
pub use polynomial::Polynomial;
pub use real::Real;
pub use schlick::{Constant, Schlick, SchlickOfPixels};
pub use spectral::Spectral;
pub use table::Table;

/// A parameter within ±1e30: no sum or product of a formula of polynomials leaves 32 bits there, and nothing that
/// reflects comes near. NaN stays NaN.
fn held(value: f64) -> f64 {
    value.clamp(-1e30, 1e30)
}

#[cfg(test)]
pub(crate) mod test_support {
    //! What the tests of several files share.

    use proptest::prelude::*;

    use super::{Form, Level, Material};

    /// Any finite number of 32 bits, and those around which cosines are wrong.
    pub(crate) fn finite() -> impl Strategy<Value = f32> {
        let around = [0.0, -0.0, 1.0, 1.0 + f32::EPSILON, 1.0 - f32::EPSILON / 2.0, -1e-7, f32::MAX, f32::MIN, 1e-40];
        prop_oneof![any::<u32>().prop_map(f32::from_bits), prop::sample::select(around.to_vec()), 0.0..1.0_f32]
            .prop_filter("finite", |x| x.is_finite())
    }

    /// The results of a kernel at some cosines: result, channel, cosine.
    pub(crate) fn results<F: Form<P, N>, const P: usize, const N: usize>(
        material: &Material<F, P, N>,
        level: Level,
        cosines: &[f32],
    ) -> Vec<[Vec<f32>; 3]> {
        let mut out = vec![[(); 3].map(|()| vec![f32::NAN; cosines.len()]); N];
        let mut planes = out.iter_mut().map(|result| result.each_mut().map(Vec::as_mut_slice));
        let planes = std::array::from_fn(|_| planes.next().unwrap());
        material.over(level, cosines, planes);
        out
    }

    /// The largest distance of a kernel, in lanes and alone, from a curve in 64 bits at even cosines.
    pub(crate) fn distance<F: Form<P>, const P: usize>(
        material: &Material<F, P>,
        curve: impl Fn(usize, f64) -> f64,
    ) -> f64 {
        let cosines: Vec<f32> = (0..=256_u16).map(|i| f32::from(i) / 256.0).chain([1.0 / 7.0, 1e-4, 1e-7]).collect();
        let mut largest = 0.0_f64;
        for level in super::levels() {
            let [channels] = &results(material, level, &cosines)[..] else { panic!("one result") };
            for (at, c) in cosines.iter().enumerate() {
                let alone = material.at(*c)[0];
                for channel in 0..3 {
                    let exact = curve(channel, f64::from(*c));
                    for got in [channels[channel][at], alone[channel]] {
                        largest = crate::number::larger(largest, (f64::from(got) - exact).abs());
                    }
                }
            }
        }
        largest
    }

    /// Units in the last place of 32 bits between a number and an exact one.
    pub(crate) fn ulps(got: f32, exact: f64) -> f64 {
        let nearest = (exact as f32).abs().max(f32::MIN_POSITIVE);
        let unit = f64::from(f32::from_bits(nearest.to_bits() + 1)) - f64::from(nearest);
        ((f64::from(got) - exact) / unit).abs()
    }
}
