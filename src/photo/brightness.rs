//! Brightness between the middles of pixels.

use super::Photo;

/// Bilinear brightness of points that follow one another, compressed so that lamps do not outweigh an outline.
pub(super) struct Brightness<'a> {
    photo: &'a Photo,
    /// Column and row of the first of the last four pixels.
    last: Option<[u32; 2]>,
    /// The last four; `None` where they leave the picture.
    four: Option<Four>,
}

/// Two rows of two pixels.
type Four = [[f64; 2]; 2];

impl<'a> Brightness<'a> {
    /// Of a photograph.
    pub const fn of(photo: &'a Photo) -> Self {
        Self { photo, last: None, four: None }
    }

    /// At a point; `None` outside.
    pub fn at(&mut self, (x, y): (f64, f64)) -> Option<f64> {
        let (x, y) = (x - 0.5, y - 0.5);
        if !((0.0..).contains(&x) && (0.0..).contains(&y)) {
            return None;
        }
        let (column, row) = (x as u32, y as u32);
        let [top, bottom] = self.four([column, row])?;
        let (s, t) = (x - f64::from(column), y - f64::from(row));
        let along = |[left, right]: [f64; 2]| left * (1.0 - s) + right * s;
        Some(along(top) * (1.0 - t) + along(bottom) * t)
    }

    /// The pixel in a column and row, and those beside and below it.
    fn four(&mut self, first: [u32; 2]) -> Option<Four> {
        if self.last != Some(first) {
            let [column, row] = first;
            let two = |row: u32| two(self.photo, column, row);
            self.four = two(row).zip(two(row.saturating_add(1))).map(Four::from);
            self.last = Some(first);
        }
        self.four
    }
}

/// Two pixels of a row.
fn two(photo: &Photo, column: u32, row: u32) -> Option<[f64; 2]> {
    let (mut values, mut count) = ([0.0; 2], 0);
    photo.for_each_of_row(row, column..column.saturating_add(2), |pixel| {
        let luminance = (0.2126 * pixel.rgb[0] + 0.7152 * pixel.rgb[1] + 0.0722 * pixel.rgb[2]).max(0.0);
        values[count] = luminance / (1.0 + luminance);
        count += 1;
    });
    (count == 2).then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between pixels it is straight in each direction, whatever was asked before.
    #[test]
    fn lies_between_the_pixels_around() {
        let value = |i: u32| [0.1 * f64::from(i % 4) as f32 + 0.3 * f64::from(i / 4) as f32; 3];
        let photo = Photo::from_linear("ramp", 4, 3, (0..12).map(value).collect());
        let pixel = |column: u32, row: u32| {
            let value = f64::from(value(4 * row + column)[0]);
            value / (1.0 + value)
        };
        let mut brightness = Brightness::of(&photo);
        assert_eq!(brightness.at((1.5, 1.5)), Some(pixel(1, 1)));
        let quarter = 0.75 * pixel(1, 1) + 0.25 * pixel(2, 1);
        assert!((brightness.at((1.75, 1.5)).unwrap() - quarter).abs() < 1e-12);
        let middle = [pixel(1, 1), pixel(2, 1), pixel(1, 2), pixel(2, 2)].iter().sum::<f64>() / 4.0;
        assert!((brightness.at((2.0, 2.0)).unwrap() - middle).abs() < 1e-12);
        for outside in [(0.4, 1.0), (1.0, 0.4), (3.6, 1.0), (1.0, 2.6), (1e12, 1.0), (f64::NAN, 1.0)] {
            assert_eq!(brightness.at(outside), None, "{outside:?}");
        }
    }
}
