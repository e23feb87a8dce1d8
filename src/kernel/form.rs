//! A formula, and the loop that runs it over slices.

use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};

use super::lanes::Lanes;
use super::{Operations, Real};
use crate::color::Rgb;

/// A Fresnel formula of P constants or parameters per channel that gives N numbers per channel.
///
/// What the channels share is computed once for all three. c is the cosine, in `[0, 1]`.
pub trait Form<const P: usize, const N: usize = 1>: Copy {
    /// False for a textbook form, which is given cosines as they come.
    const HOLDS_COSINE: bool = true;

    /// How large a parameter of a pixel may be, either way; beyond, it is held there. `None` where the form itself holds
    /// them, and for a textbook form, which takes what comes.
    const HOLDS_PIXELS: Option<f64> = None;

    /// Vectors between two looks at the ends of the slices: more than one where looking takes as long as the formula.
    const STEPS: usize = 1;

    /// Calls `run` with this form. A form that computes one way or another calls it in each of them, so that its loop is
    /// compiled for each and nothing is decided inside.
    #[inline(always)]
    fn decided<R>(self, run: impl FnOnce(Self) -> R) -> R {
        run(self)
    }

    /// What depends only on the angle.
    type Shared<T: Real>: Copy;

    /// What the channels share at an angle.
    fn shared<T: Real>(self, c: T) -> Self::Shared<T>;

    /// One channel.
    fn channel<T: Real>(self, shared: Self::Shared<T>, parameters: [T; P]) -> [T; N];
}

/// A formula with its parameters: one material. The constants are kept in 64 bits and rounded once, on use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<F, const P: usize, const N: usize = 1> {
    form: F,
    channels: [[f64; P]; 3],
}

impl<F: Form<P, N>, const P: usize, const N: usize> Material<F, P, N> {
    /// A form with the constants of each channel.
    pub(super) const fn new(form: F, channels: [[f64; P]; 3]) -> Self {
        Self { form, channels }
    }

    /// A form whose constants are its parameters themselves, as they come.
    pub fn of_parameters(form: F, parameters: [Rgb; P]) -> Self {
        Self::new(form, std::array::from_fn(|channel| parameters.map(|rgb| rgb[channel])))
    }

    /// The formula.
    #[cfg(test)]
    pub(super) fn form(&self) -> F {
        self.form
    }

    /// Bytes of its constants in 32 bits.
    pub const BYTES: usize = 3 * P * size_of::<f32>();

    /// Operations for one RGB value.
    pub fn operations(&self) -> Operations {
        Operations::of(self.form)
    }

    /// At one cosine, as a shader would compute it: three channels of each of N results. c is held in `[0, 1]`.
    #[inline(always)]
    pub fn at<T: Real>(&self, c: T) -> [[T; 3]; N] {
        at(self.form, self.constants(c), c)
    }

    /// At every cosine one after the other, as a shader would compute it. The shorter slice ends it.
    pub fn one_by_one(&self, cosines: &[f32], out: &mut [[[f32; 3]; N]]) {
        let constants = self.constants(0.0_f32);
        self.form.decided(|form| {
            for (out, c) in out.iter_mut().zip(cosines) {
                *out = at(form, constants, *c);
            }
        });
    }

    /// At every cosine; `out` has a slice for each result and channel. The shortest slice ends it.
    pub fn over(&self, level: Level, cosines: &[f32], out: [[&mut [f32]; 3]; N]) {
        let material = *self;
        dispatch!(level, simd => material.over_lanes(simd, cosines, out));
    }

    #[inline(always)]
    fn over_lanes<S: Simd>(self, simd: S, cosines: &[f32], out: [[&mut [f32]; 3]; N]) {
        let constants = self.constants(Lanes::splat(simd, 0.0));
        self.form.decided(
            #[inline(always)]
            |form| {
                each_chunk(
                    simd,
                    F::STEPS,
                    (cosines, []),
                    out,
                    #[inline(always)]
                    |c, _| at(form, constants, c),
                );
            },
        );
    }

    #[inline(always)]
    fn constants<T: Real>(&self, kind: T) -> [[T; P]; 3] {
        let mut constants = [[kind; P]; 3];
        for (to, from) in constants.iter_mut().flatten().zip(self.channels.iter().flatten()) {
            *to = kind.of(*from);
        }
        constants
    }
}

/// Three slices for each of P parameters: a texture.
pub type Planes<'a, const P: usize> = [[&'a [f32]; 3]; P];

/// A formula at every pixel, its parameters from a texture: `parameters` has a slice for each and each channel.
///
/// Finite parameters give finite results: what a form would overflow of is held, see [`Form::HOLDS_PIXELS`].
pub fn over_pixels<F: Form<P, N>, const P: usize, const N: usize>(
    form: F,
    level: Level,
    (cosines, parameters): (&[f32], Planes<'_, P>),
    out: [[&mut [f32]; 3]; N],
) {
    dispatch!(level, simd => each_chunk(simd, F::STEPS, (cosines, parameters), out,
        #[inline(always)] |c, p| at_pixel(form, p, c)));
}

/// A formula at one pixel, as a shader would compute it: [`over_pixels`] without vectors.
#[inline(always)]
pub fn at_pixel<T: Real, F: Form<P, N>, const P: usize, const N: usize>(
    form: F,
    parameters: [[T; P]; 3],
    c: T,
) -> [[T; 3]; N] {
    at(form, held_pixels::<_, F, P, N>(parameters), c)
}

/// The parameters of a pixel as the form can take them.
#[inline(always)]
fn held_pixels<T: Real, F: Form<P, N>, const P: usize, const N: usize>(mut parameters: [[T; P]; 3]) -> [[T; P]; 3] {
    if let Some(most) = F::HOLDS_PIXELS {
        for parameter in parameters.as_flattened_mut() {
            *parameter = parameter.limited(-most, most);
        }
    }
    parameters
}

#[inline(always)]
pub(super) fn at<T: Real, F: Form<P, N>, const P: usize, const N: usize>(
    form: F,
    parameters: [[T; P]; 3],
    c: T,
) -> [[T; 3]; N] {
    let shared = form.shared(if F::HOLDS_COSINE { c.limited(0.0, 1.0) } else { c });
    let mut results = [[c; 3]; N];
    // By index: an iterator that owns an array of vectors keeps it in memory.
    for channel in 0..3 {
        let values = form.channel(shared, parameters[channel]);
        for result in 0..N {
            results[result][channel] = values[result];
        }
    }
    results
}

/// Calls `f` with a cosine and P parameters of each channel, as many pixels at a time as there are lanes, and writes
/// its N results of M channels. The shortest slice ends it.
///
/// The ends of the slices are looked at once for every `steps` vectors, see [`Form::STEPS`].
#[inline(always)]
pub(super) fn each_chunk<S: Simd, const P: usize, const M: usize, const N: usize>(
    simd: S,
    steps: usize,
    (cosines, parameters): (&[f32], Planes<'_, P>),
    mut out: [[&mut [f32]; M]; N],
    f: impl Fn(Lanes<S>, [[Lanes<S>; P]; 3]) -> [[Lanes<S>; M]; N],
) {
    let count = shortest(cosines, &parameters, &out);
    let (chunk, block) = (Lanes::<S>::COUNT, steps * Lanes::<S>::COUNT);
    let mut first = 0;
    while steps > 1 && first + block <= count {
        let here = first..first + block;
        let mut of_block: Planes<'_, P> = [[&[]; 3]; P];
        for (block, whole) in of_block.as_flattened_mut().iter_mut().zip(parameters.as_flattened()) {
            *block = &whole[here.clone()];
        }
        // Not by `map`, which stays a call that hides the lengths.
        let mut into_block: [[&mut [f32]; M]; N] = std::array::from_fn(|_| std::array::from_fn(|_| Default::default()));
        for (block, whole) in into_block.as_flattened_mut().iter_mut().zip(out.as_flattened_mut()) {
            *block = &mut whole[here.clone()];
        }
        for step in 0..steps {
            one_chunk(simd, step * chunk, (&cosines[here.clone()], &of_block), &mut into_block, &f);
        }
        first = here.end;
    }
    while first + chunk <= count {
        one_chunk(simd, first, (cosines, &parameters), &mut out, &f);
        first += chunk;
    }
    if first < count {
        some_of_chunk(simd, first..count, (cosines, &parameters), &mut out, &f);
    }
}

/// The vector that begins at a place of the slices. `f` is a reference by its type: as a value it would be called
/// through a function that knows nothing of the instruction set.
#[inline(always)]
fn one_chunk<S: Simd, const P: usize, const M: usize, const N: usize>(
    simd: S,
    first: usize,
    (cosines, parameters): (&[f32], &Planes<'_, P>),
    out: &mut [[&mut [f32]; M]; N],
    f: &impl Fn(Lanes<S>, [[Lanes<S>; P]; 3]) -> [[Lanes<S>; M]; N],
) {
    let here = first..first + Lanes::<S>::COUNT;
    let mut channels = [[Lanes::splat(simd, 0.0); P]; 3];
    // By index, as in `at`.
    for parameter in 0..P {
        for channel in 0..3 {
            channels[channel][parameter] = Lanes::load(simd, &parameters[parameter][channel][here.clone()]);
        }
    }
    let results = f(Lanes::load(simd, &cosines[here.clone()]), channels);
    for result in 0..N {
        for channel in 0..M {
            results[result][channel].store(&mut out[result][channel][here.clone()]);
        }
    }
}

/// The rest, which is shorter than a vector.
#[inline(always)]
fn some_of_chunk<S: Simd, const P: usize, const M: usize, const N: usize>(
    simd: S,
    here: Range<usize>,
    (cosines, parameters): (&[f32], &Planes<'_, P>),
    out: &mut [[&mut [f32]; M]; N],
    f: &impl Fn(Lanes<S>, [[Lanes<S>; P]; 3]) -> [[Lanes<S>; M]; N],
) {
    let mut channels = [[Lanes::splat(simd, 0.0); P]; 3];
    for (parameter, planes) in parameters.iter().enumerate() {
        for (channel, plane) in channels.iter_mut().zip(planes) {
            channel[parameter] = Lanes::load_some(simd, &plane[here.clone()]);
        }
    }
    let results = f(Lanes::load_some(simd, &cosines[here.clone()]), channels);
    for (planes, results) in out.iter_mut().zip(results) {
        for (plane, result) in planes.iter_mut().zip(results) {
            result.store_some(&mut plane[here.clone()]);
        }
    }
}

/// How many numbers every slice has.
#[inline(always)]
fn shortest<const P: usize, const M: usize, const N: usize>(
    cosines: &[f32],
    parameters: &Planes<'_, P>,
    out: &[[&mut [f32]; M]; N],
) -> usize {
    let count = parameters.iter().flatten().map(|plane| plane.len()).fold(cosines.len(), usize::min);
    out.iter().flatten().map(|plane| plane.len()).fold(count, usize::min)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::kernel::test_support::{finite, results};
    use crate::kernel::{
        Basis, ConductorAndAbsorption, EdgeOfTint, Exported, F82OfPixels, Factored, TintOfEdge, levels,
    };

    #[test]
    fn every_length_is_covered_by_every_instruction_set() {
        let (n, k) = (Rgb([0.2, 0.4, 1.4]), Rgb([3.4, 2.3, 1.8]));
        covers_every_length(&ConductorAndAbsorption::material(n, k));
        covers_every_length(&Factored::hoffman(Rgb([0.9, 0.6, 0.3]), Rgb([0.8, 0.9, 0.6])));
    }

    fn covers_every_length<F: Form<P, N>, const P: usize, const N: usize>(material: &Material<F, P, N>) {
        for level in levels() {
            for length in 0..150_u16 {
                let cosines: Vec<f32> = (0..length).map(|i| f32::from(i) / 150.0).collect();
                let results = results(material, level, &cosines);
                for (at, c) in cosines.iter().enumerate() {
                    let alone = material.at(*c);
                    for (result, channels) in results.iter().enumerate() {
                        for channel in 0..3 {
                            let off = (channels[channel][at] - alone[result][channel]).abs();
                            assert!(off < 2e-6, "{level:?} {length} {c}: {off}");
                        }
                    }
                }
            }
        }
    }

    /// Parameters differ from pixel to pixel, so that one from a wrong place would show.
    #[test]
    fn every_pixel_has_its_own_parameters() {
        let plane = |step: usize, length: usize| (0..length).map(|i| (i * step % 97) as f32 / 97.0).collect::<Vec<_>>();
        for level in levels() {
            for length in 0..150 {
                let cosines = plane(5, length);
                let planes =
                    [[7, 11, 13].map(|step| plane(step, length)), [17, 19, 23].map(|step| plane(step, length))];
                let mut out = [(); 3].map(|()| vec![f32::NAN; length]);
                let parameters = planes.each_ref().map(|planes| planes.each_ref().map(Vec::as_slice));
                over_pixels(Basis, level, (&cosines, parameters), [out.each_mut().map(Vec::as_mut_slice)]);
                for i in 0..length {
                    let of = |planes: &[Vec<f32>; 3]| Rgb(planes.each_ref().map(|plane| f64::from(plane[i])));
                    let [alone] = Basis::material(of(&planes[0]), of(&planes[1])).at(cosines[i]);
                    let off = (0..3).map(|channel| (out[channel][i] - alone[channel]).abs()).fold(0.0, f32::max);
                    assert!(off < 1e-6, "{level:?} {length} {i}: {off}");
                }
            }
        }
    }

    fn finite_of_pixels<F: Form<2>>(form: F, [x, y, c]: [f32; 3]) -> bool {
        let (x, y) = ([x], [y]);
        let mut out = [[f32::NAN; 1]; 3];
        let planes: Planes<'_, 2> = [[&x; 3], [&y; 3]];
        over_pixels(form, Level::new(), (&[c], planes), [out.each_mut().map(|plane| &mut plane[..])]);
        out.as_flattened().iter().all(|f| f.is_finite())
    }

    proptest! {
        #[test]
        fn finite_pixels_are_finite(x in finite(), y in finite(), c in finite()) {
            let point = [x, y, c];
            prop_assert!(finite_of_pixels(Basis, point) && finite_of_pixels(Exported, point));
            prop_assert!(finite_of_pixels(F82OfPixels, point));
            prop_assert!(finite_of_pixels(TintOfEdge, point) && finite_of_pixels(EdgeOfTint, point));
        }
    }

    #[test]
    fn the_shortest_slice_ends_it() {
        let cosines = [0.5_f32; 30];
        let [long, short] = [[0.4_f32; 30], [0.4; 30]];
        let mut out = [[-1.0_f32; 30]; 3];
        let [red, green, blue] = &mut out;
        let parameters = [[&long[..], &long, &short[..21]], [&long, &long, &long]];
        over_pixels(Basis, Level::new(), (&cosines, parameters), [[red, green, &mut blue[..25]]]);
        assert!(out.iter().all(|plane| plane[..21].iter().all(|x| (0.0..1.0).contains(x)) && plane[21..] == [-1.0; 9]));
    }

    #[test]
    fn a_cosine_that_is_no_number_gives_none() {
        let material = Basis::material(Rgb::splat(0.5), Rgb::splat(0.6));
        for level in levels() {
            let mut cosines = [0.3; 19];
            cosines[3] = f32::NAN;
            cosines[17] = f32::NAN;
            let [channels] = &results(&material, level, &cosines)[..] else { panic!("one result") };
            for channel in channels {
                let nan: Vec<usize> = (0..19).filter(|at| channel[*at].is_nan()).collect();
                assert_eq!(nan, [3, 17], "{level:?}");
            }
        }
        assert!(material.at(f32::NAN)[0].iter().all(|x| x.is_nan()));
    }
}
