//! Values by their place among all, without ordering all.

/// Even steps between the least value and the most. The counts of them stay in the fastest cache.
const STEPS: usize = 4096;

/// The values that stand at some places, from 0, when all are in order. The ranks ascend and are below the count.
///
/// Values are counted in even steps; only those in the step of a rank are looked at again. No value is NaN.
pub fn at_ranks<const N: usize>(values: &[f32], ranks: [usize; N]) -> [f32; N] {
    let least = winner(values, f32::INFINITY, |a, b| a < b);
    let most = winner(values, f32::NEG_INFINITY, |a, b| a > b);
    if least == most {
        return [least; N];
    }
    let per_value = STEPS as f32 / (most - least);
    // Too few to be worth counting, or too near or too far apart to be divided.
    if values.len() <= STEPS || !per_value.is_normal() {
        return in_order(&mut values.to_vec(), ranks);
    }
    let steps = Steps { least, per_value };
    let counts = steps.counts(values);
    let places = places(&counts, ranks);
    let wanted = steps.values_in(values, places.map(|(step, _)| step));
    let (mut last, mut inside) = (STEPS, Vec::new());
    places.map(|(step, place)| {
        if step != last {
            (last, inside) = (step, steps.values_in(&wanted, [step]));
        }
        at_ranks(&inside, [place])[0]
    })
}

/// The step of each rank, and its place among the values of that step.
fn places<const N: usize>(counts: &[usize], ranks: [usize; N]) -> [(usize, usize); N] {
    let (mut step, mut before) = (0, 0);
    ranks.map(|rank| {
        while before + counts[step] <= rank {
            before += counts[step];
            step += 1;
        }
        (step, rank - before)
    })
}

/// The values at places that ascend, of values that it reorders.
fn in_order<const N: usize>(values: &mut [f32], places: [usize; N]) -> [f32; N] {
    let mut ordered = 0;
    places.map(|place| {
        let (_, value, _) = values[ordered..].select_nth_unstable_by(place - ordered, f32::total_cmp);
        ordered = place;
        *value
    })
}

struct Steps {
    least: f32,
    per_value: f32,
}

impl Steps {
    /// Where a value lies, in steps. A larger value never lies lower.
    #[inline(always)]
    fn place(&self, value: f32) -> f32 {
        (value - self.least) * self.per_value
    }

    /// How many values lie in each step.
    fn counts(&self, values: &[f32]) -> Vec<usize> {
        // Two counts in turns: neighbours are often equal, and a count has to be stored before it is read again.
        let mut counts = [vec![0; STEPS], vec![0; STEPS]];
        // Conversions to small integers are the quickest, and every number beyond them is their largest.
        let step = |value: f32| usize::from(self.place(value) as u16).min(STEPS - 1);
        let (pairs, last) = values.as_chunks::<2>();
        for [first, second] in pairs {
            counts[0][step(*first)] += 1;
            counts[1][step(*second)] += 1;
        }
        let [mut counts, others] = counts;
        last.iter().for_each(|value| counts[step(*value)] += 1);
        counts.iter_mut().zip(others).for_each(|(count, other)| *count += other);
        counts
    }

    /// The values that lie in any of some steps.
    fn values_in<const N: usize>(&self, values: &[f32], steps: [usize; N]) -> Vec<f32> {
        const AT_ONCE: usize = 1024;
        let ranges = steps.map(|step| {
            let end = if step == STEPS - 1 { f32::INFINITY } else { (step + 1) as f32 };
            [step as f32, end]
        });
        // NaN lies outside of none, so that the places of a broken picture still hold values.
        let is_outside =
            |place: f32| ranges.iter().fold(true, |is, [from, to]| is & ((place < *from) | (place >= *to)));
        let (mut found, mut room) = (Vec::new(), [0.0; AT_ONCE]);
        for values in values.chunks(AT_ONCE) {
            let mut count = 0;
            // Each value is written and kept only if the next one goes elsewhere: no branch to be guessed.
            for value in values {
                room[count] = *value;
                count += usize::from(!is_outside(self.place(*value)));
            }
            found.extend_from_slice(&room[..count]);
        }
        found
    }
}

/// The value that `wins` against all others, in lanes.
#[inline(always)]
fn winner(values: &[f32], start: f32, wins: impl Fn(f32, f32) -> bool) -> f32 {
    let better = |a: f32, b: f32| if wins(a, b) { a } else { b };
    let (chunks, rest) = values.as_chunks::<8>();
    let mut lanes = [start; 8];
    for chunk in chunks {
        lanes.iter_mut().zip(chunk).for_each(|(lane, value)| *lane = better(*value, *lane));
    }
    lanes.iter().chain(rest).copied().fold(start, better)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn any_value() -> impl Strategy<Value = f32> {
        prop_oneof![-1.0..1.0_f32, Just(0.25), Just(f32::MAX), Just(f32::MIN), Just(1e-42), 0.9..0.9001_f32]
    }

    /// Of every size, also with a few values far from all others.
    fn far_apart() -> impl Strategy<Value = f32> {
        (-30..30_i32, -1.0..1.0_f32).prop_map(|(exponent, value)| value * 10_f32.powi(exponent))
    }

    /// A few steps of the number type apart, and denormal.
    fn near() -> impl Strategy<Value = f32> {
        (prop_oneof![Just(0_u32), Just(0x3f80_0000)], 0..40_u32).prop_map(|(start, step)| f32::from_bits(start + step))
    }

    fn sets() -> impl Strategy<Value = Vec<f32>> {
        prop_oneof![
            prop::collection::vec(any_value(), 1..200),
            prop::collection::vec(far_apart(), 1..200),
            prop::collection::vec(near(), 1..60),
        ]
    }

    proptest! {
        /// Few, and so many that they are counted: then each value comes many times.
        #[test]
        fn they_are_those_of_the_sorted_values(
            set in sets(),
            repeats in prop_oneof![Just(1_usize), 4097..9000_usize],
            places in prop::array::uniform4(0.0..1.0_f64),
        ) {
            let count = repeats.max(set.len());
            let mut values: Vec<f32> = (0..count).map(|i| set[i * (i % 7 + 1) % set.len()]).collect();
            let mut ranks = places.map(|place| (place * count as f64) as usize);
            ranks.sort_unstable();
            let found = at_ranks(&values, ranks);
            values.sort_by(f32::total_cmp);
            prop_assert_eq!(found, ranks.map(|rank| values[rank]));
        }
    }

    #[test]
    fn nan_is_survived() {
        for count in [100, 5000] {
            let mut values: Vec<f32> = (0..count).map(|i| i as f32).collect();
            values[3] = f32::NAN;
            let ranks = [count / 5, count / 2, count - 2];
            assert!(at_ranks(&values, ranks).is_sorted() && at_ranks(&values, [0])[0] == 0.0);
        }
        assert!(at_ranks(&[f32::NAN; 4], [0, 1, 3])[0].is_nan());
        assert_eq!(at_ranks(&[f32::INFINITY, 1.0, f32::NEG_INFINITY], [0, 1]), [f32::NEG_INFINITY, 1.0]);
    }

    #[test]
    fn equal_values_have_no_step() {
        assert_eq!(at_ranks(&[0.5; 9], [0, 4, 8]), [0.5; 3]);
        assert_eq!(at_ranks(&[f32::MAX, f32::MIN], [0, 1]), [f32::MIN, f32::MAX]);
    }
}
