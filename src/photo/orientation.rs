//! How the stored rows lie in the picture people see.

use std::ops::Range;

/// One of the eight orientations of EXIF (CIPA DC-008-2019, tag 274).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Orientation {
    /// Columns of the picture run along stored columns instead of rows.
    is_transposed: bool,
    /// Stored columns are counted from the right.
    flips_x: bool,
    /// Stored rows are counted from the bottom.
    flips_y: bool,
}

impl Orientation {
    /// Transposed first, then counted from the right, then from the bottom.
    pub const fn new(is_transposed: bool, flips_x: bool, flips_y: bool) -> Self {
        Self { is_transposed, flips_x, flips_y }
    }

    /// The orientation of an EXIF value; `None` outside 1–8.
    pub const fn from_exif(value: u32) -> Option<Self> {
        let (is_transposed, flips_x, flips_y) = match value {
            1 => (false, false, false),
            2 => (false, true, false),
            3 => (false, true, true),
            4 => (false, false, true),
            5 => (true, false, false),
            6 => (true, false, true),
            7 => (true, true, true),
            8 => (true, true, false),
            _ => return None,
        };
        Some(Self { is_transposed, flips_x, flips_y })
    }

    /// The size people see, of a stored size; also the other way round.
    pub const fn size(self, [width, height]: [u32; 2]) -> [u32; 2] {
        if self.is_transposed { [height, width] } else { [width, height] }
    }

    /// The stored column and row of a pixel, given the stored size.
    pub const fn stored(self, [column, row]: [u32; 2], [width, height]: [u32; 2]) -> [u32; 2] {
        let [x, y] = if self.is_transposed { [row, column] } else { [column, row] };
        [if self.flips_x { width - 1 - x } else { x }, if self.flips_y { height - 1 - y } else { y }]
    }

    /// The places of the pixels of a part of a row, given the stored size.
    pub fn places(self, row: u32, columns: Range<u32>, size: [u32; 2]) -> Places {
        let width = size[0] as usize;
        let first = |start| {
            let [x, y] = self.stored([start, row], size);
            y as usize * width + x as usize
        };
        Places {
            first: if columns.is_empty() { 0 } else { first(columns.start) },
            step: if self.is_transposed { width } else { 1 },
            is_backward: if self.is_transposed { self.flips_y } else { self.flips_x },
            count: columns.len(),
        }
    }
}

/// Where the pixels of a part of a row lie in the order of the file.
pub(super) struct Places {
    first: usize,
    step: usize,
    is_backward: bool,
    count: usize,
}

impl Places {
    /// From left to right.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        let Self { first, step, is_backward, count } = *self;
        (0..count).map(move |i| if is_backward { first - i * step } else { first + i * step })
    }

    /// All of them, in any order, where nothing lies between.
    pub fn range(&self) -> Option<Range<usize>> {
        let start = if self.is_backward { self.first + 1 - self.count.max(1) } else { self.first };
        (self.step == 1).then_some(start..start + self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIPA DC-008-2019 names the corner that the stored 0th row and 0th column lie at: top left, top right,
    /// bottom right, bottom left, left top, right top, right bottom, left bottom.
    #[test]
    fn the_stored_corner_lies_where_exif_says() {
        let (left, right, top, bottom) = (0, 2, 0, 1);
        let untransposed = [[left, top], [right, top], [right, bottom], [left, bottom]];
        let transposed = [[left, top], [bottom, top], [bottom, right], [left, right]];
        for (value, corner) in (1..).zip(untransposed.into_iter().chain(transposed)) {
            let orientation = Orientation::from_exif(value).unwrap();
            assert_eq!(orientation.stored(corner, [3, 2]), [0, 0], "{value}");
        }
        assert_eq!(Orientation::from_exif(0), None);
        assert_eq!(Orientation::from_exif(9), None);
    }

    #[test]
    fn places_of_a_row_are_those_of_its_pixels() {
        let stored = [5, 3];
        for orientation in (1..=8).filter_map(Orientation::from_exif) {
            let [width, height] = orientation.size(stored);
            for (row, columns) in (0..height).flat_map(|row| [(row, 0..width), (row, 1..3), (row, 2..2)]) {
                let places = orientation.places(row, columns.clone(), stored);
                let (range, mut places) = (places.range(), places.iter().collect::<Vec<_>>());
                let positions = columns.map(|column| orientation.stored([column, row], stored));
                let expected: Vec<usize> = positions.map(|[x, y]| (y * stored[0] + x) as usize).collect();
                assert_eq!(places, expected, "{orientation:?}");
                places.sort_unstable();
                assert!(range.is_none_or(|range| range.eq(places)), "{orientation:?}");
            }
        }
    }

    #[test]
    fn quarter_turns_swap_the_size() {
        assert_eq!(Orientation::from_exif(6).unwrap().size([3, 2]), [2, 3]);
        assert_eq!(Orientation::from_exif(3).unwrap().size([3, 2]), [3, 2]);
    }
}
