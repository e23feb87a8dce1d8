//! How far off the results of a case are, and where.

use super::StabilityRow;
use super::exact::Exact;
use super::grid::{Case, Domain, Evaluations, Way};

/// The arithmetics, in the order of the rows.
const ARITHMETICS: [&str; 4] = ["vectors", "scalar", "64-bits", "16-bit-parameters"];

/// What is seen of a case: way by way, arithmetic by arithmetic, domain by domain.
pub(super) struct Tallies(Vec<[[Tally; 3]; 4]>);

impl Tallies {
    pub(super) fn none(case: &Case) -> Self {
        Self(case.ways.iter().map(|_| Default::default()).collect())
    }

    pub(super) fn of(case: &Case, points: &[Vec<f64>]) -> Self {
        let mut tallies = Self::none(case);
        for point in points {
            let (domain, exact, halved) = (case.domain(point) as usize, (case.exact)(point), case.halved(point));
            for (way, tallies) in case.ways.iter().zip(&mut tallies.0) {
                for (tally, result) in tallies.iter_mut().zip(results(way, point, &halved)) {
                    let Some((result, unit)) = result else { continue };
                    tally[domain].add(exact.as_ref(), result, unit, &|| case.told(point));
                }
            }
        }
        tallies
    }

    /// Both; of equal errors the one that is here already.
    pub(super) fn and(mut self, later: Self) -> Self {
        let tallies = self.0.as_flattened_mut().as_flattened_mut().iter_mut();
        for (tally, later) in tallies.zip(later.0.into_iter().flatten().flatten()) {
            tally.and(later);
        }
        self
    }

    pub(super) fn rows(self, case: &Case) -> Vec<StabilityRow> {
        let of_way = |(way, tallies): (&Way, [[Tally; 3]; 4])| {
            let kind = way.kind;
            ARITHMETICS.into_iter().zip(tallies).flat_map(move |(arithmetic, tallies)| {
                let domains = Domain::ALL.into_iter().zip(tallies).filter(|(_, tally)| tally.points > 0);
                domains.map(move |(domain, tally)| tally.row([case.quantity, kind, arithmetic, domain.id()]))
            })
        };
        case.ways.iter().zip(self.0).flat_map(of_way).collect()
    }
}

/// One way at a point, in the order of the arithmetics: each result with the unit of its last place.
fn results(way: &Way, point: &[f64], halved: &[f64]) -> [Option<(f64, Unit)>; 4] {
    let Evaluations { vectors, scalar, double } = (way.evaluate)(point);
    let half = (way.evaluate)(halved);
    let single = |value: f32| (f64::from(value), unit_of_single as Unit);
    [vectors.map(single), Some(single(scalar)), Some((double, unit_of_double)), half.vectors.map(single)]
}

/// Distance from a number to the next.
type Unit = fn(f64) -> f64;

/// Of 32 bits.
pub(in crate::study) fn unit_of_single(value: f64) -> f64 {
    let size = (value as f32).abs().clamp(f32::MIN_POSITIVE, f32::MAX / 2.0);
    f64::from(size.next_up()) - f64::from(size)
}

/// Of 64 bits.
fn unit_of_double(value: f64) -> f64 {
    let size = value.abs().clamp(f64::MIN_POSITIVE, f64::MAX / 2.0);
    size.next_up() - size
}

/// What is seen of one arithmetic in one domain.
#[derive(Clone, Debug, Default)]
struct Tally {
    points: usize,
    absolute: Option<(f64, String)>,
    ulp: Option<(f64, String)>,
    nan: usize,
    infinite: usize,
    negative: usize,
    above_one: usize,
}

impl Tally {
    fn add(&mut self, exact: Option<&Exact>, result: f64, unit: Unit, told: &dyn Fn() -> String) {
        self.points += 1;
        self.nan += usize::from(result.is_nan());
        self.infinite += usize::from(result.is_infinite());
        let Some(exact) = exact.filter(|_| result.is_finite()) else { return };
        let off = (Exact::of(result) - exact.clone()).to_f64().abs();
        let exact = exact.to_f64();
        self.negative += usize::from(result < 0.0 && exact >= 0.0);
        self.above_one += usize::from(result > 1.0 && exact <= 1.0);
        keep_larger(&mut self.absolute, off, told);
        keep_larger(&mut self.ulp, off / unit(result.abs().max(exact.abs())), told);
    }

    fn and(&mut self, later: Self) {
        self.points += later.points;
        self.nan += later.nan;
        self.infinite += later.infinite;
        self.negative += later.negative;
        self.above_one += later.above_one;
        for (kept, later) in [(&mut self.absolute, later.absolute), (&mut self.ulp, later.ulp)] {
            if let Some((value, told)) = later {
                keep_larger(kept, value, &|| told.clone());
            }
        }
    }

    fn row(self, [quantity, kind, arithmetic, domain]: [&'static str; 4]) -> StabilityRow {
        let (max_absolute, max_absolute_at) = self.absolute.unzip();
        let (max_ulp, max_ulp_at) = self.ulp.unzip();
        StabilityRow {
            quantity,
            kind,
            arithmetic,
            domain,
            points: self.points,
            max_absolute,
            max_absolute_at: max_absolute_at.unwrap_or_default(),
            max_ulp,
            max_ulp_at: max_ulp_at.unwrap_or_default(),
            nan: self.nan,
            infinite: self.infinite,
            negative: self.negative,
            above_one: self.above_one,
        }
    }
}

fn keep_larger(kept: &mut Option<(f64, String)>, value: f64, told: &dyn Fn() -> String) {
    if kept.as_ref().is_none_or(|(largest, _)| value > *largest) {
        *kept = Some((value, told()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Fineness;
    use crate::study::stability::exact;
    use crate::study::stability::grid::{Axis, Exactly, Where};

    /// Schlick's curve by a kernel that is wrong in three ways.
    #[test]
    fn a_broken_kernel_is_noticed() {
        let axes = [Axis::Of("r", &[0.25, 0.5]), Axis::Of("c", &[0.0, 0.5, 1.0])];
        let exact: (Where, Exactly) = (|_| true, |point| Some(exact::schlick(point[0], point[1])));
        let case = Case::new("broken", &axes, exact).way("ours", |p, c| {
            let f = p[0][0] + (1.0 - p[0][0]) * (1.0 - c).powi(5);
            let (off, broken) = if c == 0.5 { (p[0][0] / 64.0, f) } else { (0.0, f64::NAN) };
            Evaluations { vectors: Some(f as f32), scalar: (f + off) as f32, double: if c == 1.0 { broken } else { f } }
        });
        let rows = Tallies::of(&case, &case.grid(Fineness::Default)).rows(&case);
        let row = |arithmetic: &str| rows.iter().find(|row| row.arithmetic == arithmetic).unwrap();
        assert_eq!((row("vectors").points, row("vectors").max_absolute, row("vectors").nan), (6, Some(0.0), 0));
        assert_eq!((row("64-bits").max_absolute, row("64-bits").nan), (Some(0.0), 2));
        let off = row("scalar");
        assert_eq!((off.max_absolute, off.max_absolute_at.as_str()), (Some(0.5 / 64.0), "r = 0.5, c = 0.5"));
        assert!(off.max_ulp > Some(1e5) && !off.max_ulp_at.is_empty());
    }
}
