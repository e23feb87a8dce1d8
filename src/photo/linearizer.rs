//! From stored values to linear Rec.709.

use std::fmt;
use std::sync::Arc;

use moxcms::TransformExecutor;
use nalgebra::{Matrix3, Vector3};

use super::curve::Curve;
use super::runs;
use super::samples::{Sample, Samples, triple};
use crate::color::{Chromaticity, RgbSpace, Xyz, bradford, xyz_from_primaries};

/// A profile that only a colour management system can follow: RGB in, linear RGB of known primaries out.
pub(super) type ProfileTransform = Arc<dyn TransformExecutor<f32> + Send + Sync>;

/// How stored values become linear Rec.709: a first stage, then one matrix.
#[derive(Clone, Debug)]
pub(super) struct Linearizer {
    stage: Stage,
    matrix: Matrix3<f64>,
}

#[derive(Clone)]
enum Stage {
    /// One curve for each channel.
    Curves(Arc<Curves>),
    /// A profile with look-up tables.
    Profile(ProfileTransform),
}

/// One curve for each channel, with a table of every code for integer samples.
struct Curves {
    curves: [Curve; 3],
    tables: [Arc<[f32]>; 3],
}

impl fmt::Debug for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Curves(curves) => f.debug_tuple("Curves").field(&curves.curves).finish(),
            Self::Profile(_) => f.write_str("Profile"),
        }
    }
}

impl Linearizer {
    /// Curves, then a matrix to linear Rec.709, for the depth of `samples`.
    pub fn from_curves(curves: [Curve; 3], matrix: Matrix3<f64>, samples: &Samples) -> Self {
        let tables = tables(&curves, samples);
        Self { stage: Stage::Curves(Arc::new(Curves { curves, tables })), matrix }
    }

    /// A profile, then a matrix to linear Rec.709.
    pub fn from_profile(transform: ProfileTransform, matrix: Matrix3<f64>) -> Self {
        Self { stage: Stage::Profile(transform), matrix }
    }

    /// Replaces stored pixels by linear ones in the primaries of the file; a matrix commutes with averages, so
    /// it can come last. Pixels with NaN or infinities become zero.
    pub fn decode<T: Sample>(&self, pixels: impl Iterator<Item = [T; 3]>, linear: &mut Vec<[f32; 3]>) {
        linear.clear();
        match &self.stage {
            Stage::Curves(curves) => {
                let decode = curves.decoder();
                linear.extend(pixels.map(|pixel| decode(&pixel)));
            }
            Stage::Profile(transform) => {
                let encoded = pixels.flat_map(|pixel| finite(pixel.map(|v| v.fraction() as f32)));
                let encoded: Vec<f32> = encoded.collect();
                linear.resize(encoded.len() / 3, [0.0; 3]);
                let out = linear.as_flattened_mut();
                transform.transform(&encoded, out).expect("both sides hold the same number of RGB pixels");
            }
        }
    }

    /// Adds the linear values of each run of columns of some rows to its sum, in the primaries of the file and as
    /// [`decode`](Self::decode) would give them.
    pub fn add_runs<T: Sample>(&self, rows: &[&[T]], channels: usize, ends: &[usize], sums: &mut [[f64; 3]]) {
        match &self.stage {
            Stage::Curves(curves) if channels == 3 => {
                let rows: Vec<&[[T; 3]]> = rows.iter().map(|row| row.as_chunks().0).collect();
                runs::add(&rows, ends, sums, curves.decoder());
            }
            Stage::Curves(curves) => {
                let decode = curves.decoder();
                runs::add(rows, ends, sums, |value| decode(&[*value; 3]));
            }
            Stage::Profile(_) => {
                let mut linear = Vec::new();
                for row in rows {
                    self.decode(row.chunks_exact(channels).map(triple), &mut linear);
                    runs::add(&[&linear], ends, sums, |pixel| *pixel);
                }
            }
        }
    }

    /// The way from the primaries of the file, which [`decode`](Self::decode) leaves, to linear Rec.709.
    pub fn to_rec709(&self) -> impl Fn([f64; 3]) -> [f64; 3] + Copy + use<> {
        let matrix = (self.matrix != Matrix3::identity()).then_some(self.matrix);
        move |native| matrix.map_or(native, |matrix| (matrix * Vector3::from(native)).into())
    }

    /// Hands on each pixel as stored and in linear Rec.709.
    #[inline]
    pub fn for_each<T: Sample>(&self, pixels: impl Iterator<Item = [T; 3]>, mut take: impl FnMut([T; 3], [f64; 3])) {
        let to_rec709 = self.to_rec709();
        let mut take = |stored, native: [f32; 3]| take(stored, to_rec709(native.map(f64::from)));
        match &self.stage {
            Stage::Curves(curves) => {
                let decode = curves.decoder();
                pixels.for_each(|stored| take(stored, decode(&stored)));
            }
            Stage::Profile(_) => {
                let (stored, mut linear) = (pixels.collect::<Vec<_>>(), Vec::new());
                self.decode(stored.iter().copied(), &mut linear);
                stored.into_iter().zip(linear).for_each(|(stored, linear)| take(stored, linear));
            }
        }
    }

    /// One pixel in linear Rec.709.
    pub fn pixel<T: Sample>(&self, pixel: [T; 3]) -> Vector3<f64> {
        let native = match &self.stage {
            Stage::Curves(curves) => curves.decoder()(&pixel),
            Stage::Profile(_) => {
                let mut linear = Vec::with_capacity(1);
                self.decode(std::iter::once(pixel), &mut linear);
                linear[0]
            }
        };
        self.matrix * Vector3::from(native.map(f64::from))
    }
}

impl Curves {
    /// What decodes a pixel, with its tables at hand.
    #[inline]
    fn decoder<T: Sample>(&self) -> impl Fn(&[T; 3]) -> [f32; 3] + Copy + '_ {
        let tables = self.tables.each_ref().map(|table| T::table(table));
        let decode = move |pixel: &[T; 3], channel: usize| {
            pixel[channel].decode(tables[channel], |x| self.curves[channel].decode(x))
        };
        move |pixel| {
            let is_finite = pixel[0].is_finite() & pixel[1].is_finite() & pixel[2].is_finite();
            if is_finite { [decode(pixel, 0), decode(pixel, 1), decode(pixel, 2)] } else { [0.0; 3] }
        }
    }
}

fn finite(pixel: [f32; 3]) -> [f32; 3] {
    if pixel.iter().all(|v| v.is_finite()) { pixel } else { [0.0; 3] }
}

/// A table of every code for each curve; equal curves share one, floats have none.
fn tables(curves: &[Curve; 3], samples: &Samples) -> [Arc<[f32]>; 3] {
    let last_code = match samples {
        Samples::U8(_) => u32::from(u8::MAX),
        Samples::U16(_) => u32::from(u16::MAX),
        Samples::F16(_) | Samples::F32(_) => return std::array::from_fn(|_| [].into()),
    };
    let table = |curve: &Curve| -> Arc<[f32]> {
        (0..=last_code).map(|code| curve.decode(f64::from(code) / f64::from(last_code)) as f32).collect()
    };
    let red = table(&curves[0]);
    let others = [1, 2].map(|i| if curves[i] == curves[0] { red.clone() } else { table(&curves[i]) });
    let [green, blue] = others;
    [red, green, blue]
}

/// The matrix from linear RGB of some primaries and white to linear Rec.709, Bradford-adapted so that white
/// stays white; `None` where they span no colours.
pub(super) fn rec709_from_primaries(primaries: [Chromaticity; 3], white: Chromaticity) -> Option<Matrix3<f64>> {
    let rec709 = RgbSpace::LinRec709;
    if primaries == rec709.primaries() && white == rec709.white() {
        return Some(Matrix3::identity());
    }
    let xyz_from_rgb = xyz_from_primaries(primaries, white)?;
    let matrix = rec709_from_xyz(white.xyz()) * xyz_from_rgb;
    matrix.iter().all(|v| v.is_finite()).then_some(matrix)
}

/// The matrix from XYZ relative to a white to linear Rec.709, Bradford-adapted.
pub(super) fn rec709_from_xyz(white: Xyz) -> Matrix3<f64> {
    let rec709 = RgbSpace::LinRec709;
    rec709.rgb_from_xyz() * bradford(white, rec709.white().xyz())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same primaries as an RGB space of the crate give that space's own matrix.
    #[test]
    fn primaries_give_the_matrix_of_their_space() {
        for space in RgbSpace::ALL {
            let matrix = rec709_from_primaries(space.primaries(), space.white()).unwrap();
            assert!((matrix - space.matrix_to(RgbSpace::LinRec709)).abs().max() < 1e-12, "{space}");
        }
    }

    #[test]
    fn degenerate_primaries_are_none() {
        let point = Chromaticity::new(0.3, 0.3);
        let white = Chromaticity::new(0.3127, 0.3290);
        assert!(rec709_from_primaries([point; 3], white).is_none());
        let zero = Chromaticity::new(0.0, 0.0);
        assert!(rec709_from_primaries([zero; 3], white).is_none());
        assert!(rec709_from_primaries(RgbSpace::LinRec709.primaries(), zero).is_none());
    }

    /// Tables hold what the curve says at every code.
    #[test]
    fn tables_agree_with_the_curves() {
        let curves = [Curve::Srgb, Curve::Power(2.2), Curve::Srgb];
        let linearizer = Linearizer::from_curves(curves.clone(), Matrix3::identity(), &Samples::U16(Vec::new()));
        let mut linear = Vec::new();
        for code in (0..=u16::MAX).step_by(97) {
            linearizer.decode([[code; 3]].into_iter(), &mut linear);
            for channel in 0..3 {
                let exact = curves[channel].decode(code.fraction());
                assert!((f64::from(linear[0][channel]) - exact).abs() < 1e-7);
            }
        }
    }
}
