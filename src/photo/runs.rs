//! Sums over runs of columns: what a small pixel covers of a large picture.

/// Adds the linear values of each run of columns of some rows to its sum. A run ends where the next one starts; the
/// first starts at 0. Each value is read once, and no sum of the width of the picture is kept.
pub(super) fn add<P>(rows: &[&[P]], ends: &[usize], sums: &mut [[f64; 3]], linear: impl Fn(&P) -> [f32; 3] + Copy) {
    // Rows together, as many as the compiler can see: a run has few columns.
    for rows in rows.chunks(4) {
        match *rows {
            [a, b, c, d] => add_rows([a, b, c, d], ends, sums, linear),
            [a, b, c] => add_rows([a, b, c], ends, sums, linear),
            [a, b] => add_rows([a, b], ends, sums, linear),
            [a] => add_rows([a], ends, sums, linear),
            _ => unreachable!("chunks of one to four"),
        }
    }
}

#[inline(always)]
fn add_rows<P, const ROWS: usize>(
    rows: [&[P]; ROWS],
    ends: &[usize],
    sums: &mut [[f64; 3]],
    linear: impl Fn(&P) -> [f32; 3],
) {
    let width = ends.last().copied().unwrap_or(0);
    let rows = rows.map(|row| &row[..width]);
    let mut start = 0;
    for (end, sum) in ends.iter().zip(sums) {
        let runs = rows.map(|row| &row[start..*end]);
        let [mut red, mut green, mut blue] = *sum;
        for column in 0..end - start {
            for run in runs {
                let [r, g, b] = linear(&run[column]);
                red += f64::from(r);
                green += f64::from(g);
                blue += f64::from(b);
            }
        }
        *sum = [red, green, blue];
        start = *end;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Whole numbers, so that the order of the additions does not matter.
        #[test]
        fn each_run_holds_the_sum_of_its_columns(
            lengths in prop::collection::vec(1..5_usize, 1..12),
            height in 0..10_usize,
        ) {
            let width: usize = lengths.iter().sum();
            let value = |row: usize, column: usize| (row * 7 + column * 3) as f32;
            let rows: Vec<Vec<f32>> = (0..height).map(|y| (0..width).map(|x| value(y, x)).collect()).collect();
            let ends: Vec<usize> = lengths.iter().scan(0, |end, length| { *end += length; Some(*end) }).collect();
            let mut sums = vec![[1.0; 3]; ends.len()];
            let rows: Vec<&[f32]> = rows.iter().map(Vec::as_slice).collect();
            add(&rows, &ends, &mut sums, |v| [*v, 2.0 * v, -v]);
            for ((end, length), sum) in ends.iter().zip(&lengths).zip(sums) {
                let columns = end - length..*end;
                let expected: f64 = rows.iter().flat_map(|row| &row[columns.clone()]).map(|v| f64::from(*v)).sum();
                prop_assert_eq!(sum, [1.0 + expected, 1.0 + 2.0 * expected, 1.0 - expected]);
            }
        }
    }
}
