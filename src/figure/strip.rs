//! Rows of colour over the angle.

use std::ops::Range;

use super::axis::Axis;
use super::drawing::Drawing;
use super::style::Ink;
use crate::color::{Rgb, RgbSpace, srgb8};

/// Thickness of the line under what sRGB cannot show.
pub(super) const CLIP_MARK: f64 = 1.5;

/// Draws colours at equal steps from 0° to 90° as a row, underlined in `mark` where sRGB cannot show them.
///
/// Says whether that happened. Each box reaches to the end of the row and the next colour covers
/// it: there are no seams between neighbours.
pub(super) fn draw_strip(
    drawing: &mut Drawing,
    angle: Axis,
    (top, height): (f64, f64),
    colours: &[Rgb],
    space: RgbSpace,
    mark: Ink,
) -> bool {
    let (start, end) = angle.places;
    let step = (end - start) / (colours.len().max(2) - 1) as f64;
    let edge = |index: usize| (start + step * (index as f64 - 0.5)).clamp(start, end);
    let codes: Vec<([u8; 3], bool)> = colours.iter().map(|&colour| srgb8(colour, space)).collect();
    for run in runs(&codes, |code| code.0) {
        drawing.fill(edge(run.start), top, end - edge(run.start), height, Ink::opaque(codes[run.start].0));
    }
    let clipped: Vec<_> = runs(&codes, |code| code.1).into_iter().filter(|run| codes[run.start].1).collect();
    for run in &clipped {
        let (left, right) = (edge(run.start), edge(run.end));
        drawing.fill(left, top + height - CLIP_MARK, right - left, CLIP_MARK, mark);
    }
    !clipped.is_empty()
}

/// The ranges over which a property stays the same.
fn runs<T, P: PartialEq>(items: &[T], property: impl Fn(&T) -> P) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (index, item) in items.iter().enumerate() {
        match runs.last_mut().filter(|run| property(&items[run.start]) == property(item)) {
            Some(run) => run.end = index + 1,
            None => runs.push(index..index + 1),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_cover_everything_once() {
        assert_eq!(runs(&[1, 1, 2, 1], |v| *v), [0..2, 2..3, 3..4]);
        assert!(runs(&[0; 0], |v| *v).is_empty());
    }
}
