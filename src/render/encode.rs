//! From linear light to the 8-bit sRGB codes of a screen, a row of pixels at a time.

use std::ops::Range;
use std::sync::LazyLock;

use fearless_simd::{Level, dispatch};

use crate::color::{RgbSpace, srgb_decode};

/// Makes sRGB codes of linear colours of one space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encoder {
    level: Level,
    /// The matrix to linear Rec.709, row by row; `None` where the colours are of that.
    to_srgb: Option<[[f32; 3]; 3]>,
}

impl Encoder {
    pub(super) fn new(space: RgbSpace) -> Self {
        Self::with_level(space, Level::new())
    }

    fn with_level(space: RgbSpace, level: Level) -> Self {
        let matrix = space.matrix_to(RgbSpace::LinRec709);
        let rows = std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)] as f32));
        Self { level, to_srgb: (space != RgbSpace::LinRec709).then_some(rows) }
    }

    /// The codes of a row of colours; alpha is 255. As many as `codes` has.
    ///
    /// Gives the number of pixels that are visible (their coverage is not 0) and outside sRGB by more than a tenth of
    /// an 8-bit step: they are clipped.
    pub(super) fn colours(&self, linear: Linear<'_>, coverage: &[f32], codes: &mut [[u8; 4]]) -> usize {
        let cells = &*CELLS;
        let (linear, coverage) = (linear.slice(0..codes.len()), &coverage[..codes.len()]);
        let clipped = match self.to_srgb {
            None => dispatch!(self.level, _simd => encode(cells, #[inline(always)] |rgb| rgb, linear, coverage, codes)),
            Some(matrix) => dispatch!(self.level, _simd =>
                encode(cells, #[inline(always)] |rgb| times(&matrix, rgb), linear, coverage, codes)),
        };
        clipped as usize
    }
}

/// Linear colours of a row, one slice for each channel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linear<'a> {
    /// The colours, or the reflectances where there is a light.
    pub(super) colours: [&'a [f32]; 3],
    /// What they are multiplied by; `None` of white.
    pub(super) light: Option<[&'a [f32]; 3]>,
}

impl<'a> Linear<'a> {
    /// Part of them.
    pub(super) fn slice(self, range: Range<usize>) -> Self {
        let part = |channels: [&'a [f32]; 3]| channels.map(|channel| &channel[range.clone()]);
        Self { colours: part(self.colours), light: self.light.map(part) }
    }
}

/// Writes how much of each pixel is covered, 0–1, as alpha over that of opaque pixels.
pub(super) fn write_alpha(coverage: &[f32], codes: &mut [[u8; 4]]) {
    for (coverage, code) in coverage.iter().zip(codes) {
        if *coverage != 1.0 {
            code[3] = (coverage * 255.0).round() as u8;
        }
    }
}

/// Pixels that are encoded in one go.
const BLOCK: usize = 16;

/// Plain text that the compiler makes vectors of for each instruction set.
#[inline(always)]
fn encode<'a>(
    cells: &Cells,
    to_srgb: impl Fn([f32; 3]) -> [f32; 3],
    linear: Linear<'a>,
    coverage: &[f32],
    codes: &mut [[u8; 4]],
) -> u32 {
    let blocks = |channels: [&'a [f32]; 3]| channels.map(|channel| channel.as_chunks::<BLOCK>());
    let (colours, light) = (blocks(linear.colours), linear.light.map(blocks));
    let (coverage, codes) = (coverage.as_chunks::<BLOCK>(), codes.as_chunks_mut::<BLOCK>());
    let mut clipped = 0;
    for (at, (codes, coverage)) in codes.0.iter_mut().zip(coverage.0).enumerate() {
        let colours = colours.map(
            #[inline(always)]
            |channel| channel.0[at],
        );
        let light = light.map(
            #[inline(always)]
            |light| {
                light.map(
                    #[inline(always)]
                    |channel| channel.0[at],
                )
            },
        );
        let (block, more) = encode_block(cells, &to_srgb, (colours, light), *coverage);
        *codes = block.map(u32::to_le_bytes);
        clipped += more;
    }
    if codes.1.is_empty() {
        return clipped;
    }
    let rest = |channels: [(_, &[f32]); 3]| channels.map(|channel| padded(channel.1));
    let (block, more) = encode_block(cells, &to_srgb, (rest(colours), light.map(rest)), padded(coverage.1));
    for (code, own) in codes.1.iter_mut().zip(block) {
        *code = own.to_le_bytes();
    }
    clipped + more
}

/// 0 where there are no more numbers.
fn padded(numbers: &[f32]) -> [f32; BLOCK] {
    let mut block = [0.0; BLOCK];
    block[..numbers.len()].copy_from_slice(numbers);
    block
}

/// A block of each channel.
type Block = [[f32; BLOCK]; 3];

/// The codes, red in the lowest byte, and how many are clipped. Its arrays are its own: only then are these loops made
/// vectors of, for the table might be what is written to.
#[inline(always)]
fn encode_block(
    cells: &Cells,
    to_srgb: impl Fn([f32; 3]) -> [f32; 3],
    (mut colours, light): (Block, Option<Block>),
    coverage: [f32; BLOCK],
) -> ([u32; BLOCK], u32) {
    if let Some(light) = light {
        for (colour, light) in colours.as_flattened_mut().iter_mut().zip(light.as_flattened()) {
            *colour *= light;
        }
    }
    let [red, green, blue] = colours;
    let (mut codes, mut clipped) = ([0; BLOCK], 0);
    for at in 0..BLOCK {
        let [red, green, blue] = to_srgb([red[at], green[at], blue[at]]);
        let [r, g, b] = [code_of_linear(cells, red), code_of_linear(cells, green), code_of_linear(cells, blue)];
        codes[at] = r | g << 8 | b << 16 | 0xff00_0000;
        let is_clipped = is_outside(red) | is_outside(green) | is_outside(blue);
        clipped += u32::from(is_clipped & (coverage[at] > 0.0));
    }
    (codes, clipped)
}

#[inline(always)]
fn times(matrix: &[[f32; 3]; 3], [red, green, blue]: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = matrix;
    [x, y, z].map(
        #[inline(always)]
        |row| row[0] * red + row[1] * green + row[2] * blue,
    )
}

/// By more than a tenth of an 8-bit step; NaN is.
#[inline(always)]
fn is_outside(linear: f32) -> bool {
    !(-5e-4..=1.0 + 5e-4).contains(&linear)
}

/// For each cell of linear values the sRGB code at its start, × 65536, and on top what lets a value carry into the next
/// code from where that begins. A cell holds the numbers that share sign, exponent and seven bits of the significand:
/// no two codes begin in one.
type Cells = [u32; 2048];

/// Bits of the number where the first cell begins, 2⁻¹³: code 1 begins above.
const FIRST: u32 = 0x3900_0000;

/// Bits of a number that tell its place in a cell.
const PLACE_BITS: u32 = 16;

static CELLS: LazyLock<Cells> = LazyLock::new(|| {
    let begins: [u32; 256] = std::array::from_fn(first_linear_of_code);
    std::array::from_fn(|cell| {
        let start = FIRST + ((cell as u32) << PLACE_BITS);
        // From 1 on this is 255: nothing begins there.
        let code = begins.partition_point(|&begin| begin <= start) - 1;
        let next = begins.get(code + 1).map_or(u32::MAX, |begin| begin - start);
        ((code as u32) << PLACE_BITS) + (1_u32 << PLACE_BITS).saturating_sub(next)
    })
});

/// Bits of the least linear value that is nearest to a code.
fn first_linear_of_code(code: usize) -> u32 {
    if code == 0 { 0 } else { (srgb_decode((code as f64 - 0.5) / 255.0) as f32).to_bits() }
}

/// The sRGB code of a linear value, rounded to nearest; values outside `[0, 1]` and NaN are limited.
///
/// One look into a table and one addition instead of a power, with no branch: pictures are encoded on every frame.
#[inline(always)]
fn code_of_linear(cells: &Cells, linear: f32) -> u32 {
    // Positive numbers are in the order of their bits; max gives the other number for a NaN.
    let bits = linear.max(f32::from_bits(FIRST)).min(1.0).to_bits() - FIRST;
    let place = bits & ((1 << PLACE_BITS) - 1);
    (cells[(bits >> PLACE_BITS) as usize % cells.len()] + place) >> PLACE_BITS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb, srgb8};
    use crate::kernel::levels;

    fn code(linear: f32) -> u32 {
        code_of_linear(&CELLS, linear)
    }

    /// The table gives what the curve gives, but for values within f32 rounding of a step.
    #[test]
    fn codes_are_those_of_the_curve() {
        for step in 0..=200_000u32 {
            let linear = step as f32 / 200_000.0;
            let exact = srgb8(Rgb::splat(f64::from(linear)), RgbSpace::LinRec709).0[0];
            let is_at_a_step = [-0.5, 0.5]
                .map(|half| srgb_decode((f64::from(exact) + half) / 255.0) - f64::from(linear))
                .iter()
                .any(|distance| distance.abs() < 1e-6);
            assert!(code(linear) == u32::from(exact) || is_at_a_step, "{linear}");
        }
        assert_eq!([f32::NAN, -1.0, 0.0, 1.0, 2.0, f32::INFINITY].map(code), [0, 0, 0, 255, 255, 255]);
    }

    /// No cell holds two steps, and none is off by a single number.
    #[test]
    fn each_code_begins_where_it_is_nearest() {
        for next in 1..256 {
            let begin = first_linear_of_code(next);
            assert_eq!([begin - 1, begin].map(|bits| code(f32::from_bits(bits))), [next as u32 - 1, next as u32]);
        }
    }

    /// Rows of every length, by every instruction set, against one pixel at a time.
    #[test]
    fn every_instruction_set_makes_the_same_codes() {
        let values: Vec<f32> = (0..61_u16).map(|i| f32::from(i * 37 % 61) / 50.0 - 0.1).chain([f32::NAN]).collect();
        let coverage: Vec<f32> = (0..values.len() as u16).map(|i| f32::from(i % 3) / 2.0).collect();
        let turned: Vec<f32> = values.iter().rev().copied().collect();
        for space in [RgbSpace::LinRec709, RgbSpace::AcesCg] {
            for level in levels() {
                let encoder = Encoder::with_level(space, level);
                for length in 0..=values.len() {
                    let colours = [&values[..length], &turned[..length], &values[..length]];
                    for light in [None, Some([&turned[..length]; 3])] {
                        let linear = Linear { colours, light };
                        let mut codes = vec![[9; 4]; length];
                        let clipped = encoder.colours(linear, &coverage, &mut codes);
                        let mut alone = vec![[7; 4]; length];
                        let each =
                            |i: usize| encoder.colours(linear.slice(i..i + 1), &coverage[i..], &mut alone[i..=i]);
                        assert_eq!(clipped, (0..length).map(each).sum::<usize>(), "{space} {length}");
                        assert_eq!(codes, alone, "{space} {length}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_row_is_the_curve_of_each_colour_in_the_screens_space() {
        let rgb = [0.2_f32, 0.5, 0.7];
        for space in RgbSpace::ALL {
            let mut codes = [[0; 4]; 2];
            let (half, two) = (rgb.map(|value| [value / 2.0; 2]), [2.0; 2]);
            let linear = Linear { colours: half.each_ref().map(|c| &c[..]), light: Some([&two; 3]) };
            let clipped = Encoder::new(space).colours(linear, &[1.0, 0.0], &mut codes);
            let (exact, is_clipped) = srgb8(Rgb(rgb.map(f64::from)), space);
            assert_eq!(codes, [[exact[0], exact[1], exact[2], 255]; 2], "{space}");
            assert_eq!(clipped, usize::from(is_clipped), "{space}: what is not covered is not counted");
        }
    }
}
