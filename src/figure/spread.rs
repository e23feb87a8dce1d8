//! Labels beside what they name, moved apart just far enough not to overlap.

use std::ops::RangeInclusive;

/// Places at least `gap` apart and inside `limits`, as near as possible to the wanted ones.
///
/// Least squares under an order: with the gaps taken out this is isotonic regression, solved by
/// pooling adjacent violators (Ayer et al. 1955). Where the limits are too narrow, order and gap win.
pub(super) fn spread(wanted: &[f64], gap: f64, limits: RangeInclusive<f64>) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|&a, &b| wanted[a].total_cmp(&wanted[b]));
    let room = gap * wanted.len().saturating_sub(1) as f64;
    let (first, last) = (*limits.start(), (limits.end() - room).max(*limits.start()));
    let without_gaps = order.iter().enumerate().map(|(rank, &i)| wanted[i] - gap * rank as f64);
    let pooled = isotonic(without_gaps);
    let mut places = vec![0.0; wanted.len()];
    for (rank, (&index, place)) in order.iter().zip(pooled).enumerate() {
        places[index] = place.clamp(first, last) + gap * rank as f64;
    }
    places
}

/// The nearest non-decreasing sequence.
fn isotonic(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for value in values {
        let mut block = (value, 1);
        while let Some(&(mean, count)) = blocks.last().filter(|(mean, _)| *mean > block.0) {
            block = ((mean * count as f64 + block.0 * block.1 as f64) / (count + block.1) as f64, count + block.1);
            blocks.pop();
        }
        blocks.push(block);
    }
    blocks.into_iter().flat_map(|(mean, count)| std::iter::repeat_n(mean, count)).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn what_is_far_apart_stays_and_what_is_close_moves_evenly() {
        assert_eq!(spread(&[10.0, 50.0], 12.0, 0.0..=100.0), [10.0, 50.0]);
        assert_eq!(spread(&[50.0, 50.0], 12.0, 0.0..=100.0), [44.0, 56.0]);
        assert_eq!(spread(&[99.0, 98.0], 12.0, 0.0..=100.0), [100.0, 88.0]);
    }

    proptest! {
        #[test]
        fn no_two_are_nearer_than_the_gap(wanted in prop::collection::vec(0.0..100.0_f64, 0..8)) {
            let mut places = spread(&wanted, 12.0, 0.0..=100.0);
            places.sort_by(f64::total_cmp);
            prop_assert!(places.windows(2).all(|pair| pair[1] - pair[0] >= 12.0 - 1e-9));
            prop_assert!(places.iter().all(|place| (-1e-9..=100.0 + 1e-9).contains(place)));
        }
    }
}
