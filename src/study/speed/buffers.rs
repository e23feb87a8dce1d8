//! What the kernels compute from and into.

/// Colours, or pairs of them, in a row.
pub(super) const COLOURS: usize = 1024;

/// Numbers in memory of their own. The room beyond them keeps one buffer from lying a page's size after another: then a
/// processor takes what it loads for what it has just stored elsewhere, and waits.
pub(super) fn buffer(values: impl ExactSizeIterator<Item = f32>) -> Vec<f32> {
    const ROOM: usize = 272;
    let mut buffer = Vec::with_capacity(values.len() + ROOM);
    buffer.extend(values);
    buffer
}

/// Cosines from 0 to 1 in no order.
pub(super) fn cosines(values: usize) -> Vec<f32> {
    buffer((0..values).map(|i| ((i * 7919) % values) as f32 / values as f32))
}

pub(super) fn planes(values: usize) -> [Vec<f32>; 3] {
    [(); 3].map(|()| buffer((0..values).map(|_| 0.0)))
}

/// Colours of every lightness.
pub(super) fn colours() -> [Vec<f32>; 3] {
    [1.0, 0.8, 0.3].map(|share: f32| buffer(cosines(COLOURS).into_iter().map(|c| c * share)))
}

/// L*, a* and b* of colours and of others nearby.
pub(super) fn labs() -> [[Vec<f32>; 3]; 2] {
    let lab = |shift: f32| {
        [(100.0, 0.0), (60.0, -30.0), (-50.0, 40.0)]
            .map(|(scale, offset): (f32, f32)| buffer(cosines(COLOURS).into_iter().map(|c| c * scale + offset + shift)))
    };
    [lab(0.0), lab(0.7)]
}
