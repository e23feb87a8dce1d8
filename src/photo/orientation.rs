//! How the stored rows lie in the picture people see.

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
    fn quarter_turns_swap_the_size() {
        assert_eq!(Orientation::from_exif(6).unwrap().size([3, 2]), [2, 3]);
        assert_eq!(Orientation::from_exif(3).unwrap().size([3, 2]), [3, 2]);
    }
}
