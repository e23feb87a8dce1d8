//! Values by their place among all, without ordering all.

/// Even steps between the least value and the most. A step of them stays in the fastest cache.
const BINS: usize = 4096;

/// The values that stand at some places, from 0, when all are in order. The ranks ascend and are below the count.
///
/// Values are counted in even steps; only those in the steps of the ranks are put in order. No value is NaN.
pub fn at_ranks<const N: usize>(values: &[f32], ranks: [usize; N]) -> [f32; N] {
    let (least, most) = values
        .iter()
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), value| (value.min(least), value.max(most)));
    let scale = BINS as f32 / (most - least);
    let bin = |value: f32| (((value - least) * scale) as usize).min(BINS - 1);
    let mut counts = vec![0_usize; BINS];
    values.iter().for_each(|value| counts[bin(*value)] += 1);

    let bins = ranks.map(|rank| bin_of_rank(&counts, rank));
    let mut is_wanted = vec![false; BINS];
    bins.iter().for_each(|bin| is_wanted[*bin] = true);
    let mut wanted: Vec<f32> = values.iter().copied().filter(|value| is_wanted[bin(*value)]).collect();

    let passed_over = |last: usize| (0..last).filter(|bin| !is_wanted[*bin]).map(|bin| counts[bin]).sum::<usize>();
    let mut ordered = 0;
    std::array::from_fn(|i| {
        let place = ranks[i] - passed_over(bins[i]);
        let rest = &mut wanted[ordered..];
        let (_, value, _) = rest.select_nth_unstable_by(place - ordered, f32::total_cmp);
        ordered = place;
        *value
    })
}

fn bin_of_rank(counts: &[usize], rank: usize) -> usize {
    let mut before = 0;
    let is_past = |count: &usize| {
        before += count;
        before > rank
    };
    counts.iter().position(is_past).expect("a rank below the count")
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn they_are_those_of_the_sorted_values(
            mut values in prop::collection::vec(
                prop_oneof![-1.0..1.0_f32, Just(0.25), Just(f32::MAX), Just(f32::MIN), Just(1e-42), 0.9..0.9001_f32],
                1..200,
            ),
            places in prop::array::uniform4(0.0..1.0_f64),
        ) {
            let mut ranks = places.map(|place| (place * values.len() as f64) as usize);
            ranks.sort_unstable();
            let found = at_ranks(&values, ranks);
            values.sort_by(f32::total_cmp);
            prop_assert_eq!(found, ranks.map(|rank| values[rank]));
        }
    }

    #[test]
    fn equal_values_have_no_step() {
        assert_eq!(at_ranks(&[0.5; 9], [0, 4, 8]), [0.5; 3]);
        assert_eq!(at_ranks(&[f32::MAX, f32::MIN], [0, 1]), [f32::MIN, f32::MAX]);
    }
}
