//! The flags of small pixels: those that any pixel they cover has.

use super::PixelFlags;
use super::samples::{Sample, is_plain};

/// The flags of a pixel in one byte: a preview has millions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PackedFlags(u8);

impl PackedFlags {
    const BLACK: u8 = 1 << 3;
    const NON_FINITE: u8 = 1 << 4;

    /// The flags one by one.
    pub fn unpack(self) -> PixelFlags {
        let has = |bit: u8| self.0 & bit != 0;
        PixelFlags {
            clipped: [has(1), has(1 << 1), has(1 << 2)],
            black: has(Self::BLACK),
            non_finite: has(Self::NON_FINITE),
        }
    }
}

impl From<PixelFlags> for PackedFlags {
    fn from(flags: PixelFlags) -> Self {
        let [red, green, blue] = flags.clipped.map(u8::from);
        let (black, non_finite) = (u8::from(flags.black), u8::from(flags.non_finite));
        Self(red | (green << 1) | (blue << 2) | (Self::BLACK * black) | (Self::NON_FINITE * non_finite))
    }
}

/// Marks of a sample.
const CLIPPED: u8 = 1;
/// Of the first sample of a pixel.
const BLACK: u8 = 2;
const NON_FINITE: u8 = 4;

/// Sets the flags of each run of columns of some rows. Most stretches of a picture have none, which is seen at once;
/// elsewhere rows are marked sample by sample, which whole registers do, and only then gathered by pixel.
pub(super) fn of_runs<T: Sample>(rows: &[&[T]], channels: usize, black: T, ends: &[usize], flags: &mut [PackedFlags]) {
    const RUNS_AT_ONCE: usize = 64;
    let (mut start, mut marks) = (0, Vec::new());
    for (ends, flags) in ends.chunks(RUNS_AT_ONCE).zip(flags.chunks_mut(RUNS_AT_ONCE)) {
        let last = ends.last().copied().unwrap_or(start);
        marks.clear();
        for row in rows {
            let run = &row[start * channels..last * channels];
            if !is_plain(run, black) {
                marks.resize(run.len(), 0);
                mark(run, channels, black, &mut marks);
            }
        }
        if !marks.is_empty() {
            gather(&marks, channels, start, ends, flags);
        }
        start = last;
    }
}

/// Adds the marks of a row to those of the rows above it.
fn mark<T: Sample>(run: &[T], channels: usize, black: T, marks: &mut [u8]) {
    for (mark, value) in marks.iter_mut().zip(run) {
        *mark |= (CLIPPED * u8::from(*value >= T::CLIPPED)) | (NON_FINITE * u8::from(!value.is_finite()));
    }
    // From each sample to the next two, or to itself where the picture is grey.
    let step = (channels - 1) / 2;
    let (second, third) = (&run[step..], &run[2 * step..]);
    for (mark, ((red, green), blue)) in marks.iter_mut().zip(run.iter().zip(second).zip(third)) {
        *mark |= BLACK * u8::from((*red < black) & (*green < black) & (*blue < black));
    }
}

/// The flags of each run from the marks of its samples.
fn gather(marks: &[u8], channels: usize, first: usize, ends: &[usize], flags: &mut [PackedFlags]) {
    let mut start = first;
    for (end, flags) in ends.iter().zip(flags) {
        let run = &marks[(start - first) * channels..(end - first) * channels];
        let any = if channels == 3 {
            run.as_chunks::<3>().0.iter().fold([0; 3], |any, pixel| [0, 1, 2].map(|i: usize| any[i] | pixel[i]))
        } else {
            [run.iter().fold(0, |any, mark| any | mark); 3]
        };
        *flags = PackedFlags::from(PixelFlags {
            clipped: any.map(|marks| marks & CLIPPED != 0),
            black: any[0] & BLACK != 0,
            non_finite: (any[0] | any[1] | any[2]) & NON_FINITE != 0,
        });
        start = *end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_flags_are_the_same() {
        for bits in 0..1 << 5 {
            let [red, green, blue, black, non_finite] = [0, 1, 2, 3, 4].map(|bit| (bits >> bit) & 1 == 1);
            let flags = PixelFlags { clipped: [red, green, blue], black, non_finite };
            assert_eq!(PackedFlags::from(flags).unpack(), flags);
        }
    }
}
