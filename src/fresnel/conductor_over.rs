//! The exact conductor at many wavelengths or angles, several at once on the vectors the processor has.
//!
//! Its roots and divisions are most of what a spectral truth costs. The results are those of [`conductor`] to the last
//! bit on every processor: nothing is reordered or fused.

use fearless_simd::{Level, dispatch};

use super::conductor::{conductor, has_room, with_room};
use super::{CosTheta, Nk};

/// [`conductor`] of each n and k at one angle; the shorter slice ends it.
pub fn conductor_over_indices(nk: &[Nk], cos_theta: CosTheta, out: &mut [f64]) {
    let c = cos_theta.get();
    if nk.iter().fold(true, |all, nk| all & has_room(nk.n, nk.k, c)) {
        dispatch!(Level::new(), _ => each_index(nk, c, out));
    } else {
        out.iter_mut().zip(nk).for_each(|(f, nk)| *f = conductor(nk.n, nk.k, cos_theta));
    }
}

/// [`conductor`] of one n and k at each angle; the shorter slice ends it.
pub fn conductor_over_angles(nk: Nk, cosines: &[CosTheta], out: &mut [f64]) {
    let Nk { n, k } = nk;
    let is_fit = |c: f64| has_room(n, k, c) | ((c == 0.0) & has_room(n, k, 1.0));
    if cosines.iter().fold(true, |all, c| all & is_fit(c.get())) {
        dispatch!(Level::new(), _ => each_angle(nk, cosines, out));
    } else {
        out.iter_mut().zip(cosines).for_each(|(f, c)| *f = conductor(n, k, *c));
    }
}

#[inline(always)]
fn each_index(nk: &[Nk], c: f64, out: &mut [f64]) {
    for (f, nk) in out.iter_mut().zip(nk) {
        *f = with_room(nk.n, nk.k, c);
    }
}

#[inline(always)]
fn each_angle(Nk { n, k }: Nk, cosines: &[CosTheta], out: &mut [f64]) {
    for (f, c) in out.iter_mut().zip(cosines) {
        *f = with_room(n, k, c.get());
    }
    // Grazing apart: a branch above would leave one angle at a time.
    for (f, _) in out.iter_mut().zip(cosines).filter(|(_, c)| c.get() == 0.0) {
        *f = 1.0;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![4 => 0.0..9.0_f64, 1 => prop::sample::select(vec![0.0, 1.0, 1e-40, 1e40, f64::MAX, f64::NAN])]
    }

    fn bits(values: &[f64]) -> Vec<u64> {
        values.iter().map(|value| value.to_bits()).collect()
    }

    proptest! {
        /// Rows that fit the vectors and rows of which one value does not.
        #[test]
        fn is_the_conductor_to_the_last_bit(
            nk in prop::collection::vec((number(), number()), 1..20), cosines in prop::collection::vec(0.0..=1.0, 1..20),
        ) {
            let nk: Vec<Nk> = nk.into_iter().map(|(n, k)| Nk { n, k }).collect();
            let edges = [CosTheta::GRAZING, CosTheta::FACING, CosTheta::new(1e-40)];
            let cosines: Vec<CosTheta> = cosines.into_iter().map(CosTheta::new).chain(edges).collect();
            for c in &cosines {
                let mut row = vec![f64::NAN; nk.len()];
                conductor_over_indices(&nk, *c, &mut row);
                let alone: Vec<f64> = nk.iter().map(|nk| conductor(nk.n, nk.k, *c)).collect();
                prop_assert_eq!(bits(&row), bits(&alone));
            }
            for (nk, count) in nk.iter().flat_map(|nk| [cosines.len() - 1, cosines.len()].map(|count| (nk, count))) {
                let mut curve = vec![f64::NAN; count];
                conductor_over_angles(*nk, &cosines, &mut curve);
                let alone: Vec<f64> = cosines[..count].iter().map(|c| conductor(nk.n, nk.k, *c)).collect();
                prop_assert_eq!(bits(&curve), bits(&alone));
            }
        }
    }
}
