//! How often each angle is seen.

use std::sync::LazyLock;

use crate::fresnel::CosTheta;

/// Number of angles a distribution keeps: even steps of √c, which are fine towards grazing, where models differ.
pub const NODES: usize = 257;

static COSINES: LazyLock<[CosTheta; NODES]> =
    LazyLock::new(|| std::array::from_fn(|node| CosTheta::new((node as f64 / (NODES - 1) as f64).powi(2))));

/// The cosines of the nodes, from grazing to facing.
pub fn node_cosines() -> &'static [CosTheta; NODES] {
    &COSINES
}

/// A histogram over the cosine of the angle of incidence.
///
/// What is seen between two nodes is shared by both so that its mean cosine stays: a mean over the nodes is a mean
/// over what was seen, and the nodes that were touched enclose every angle that was.
#[derive(Clone, Debug, PartialEq)]
pub struct Angles {
    weights: Box<[f64; NODES]>,
    /// The smallest and the largest cosine that was seen; in the wrong order where nothing was.
    ends: [CosTheta; 2],
}

impl Default for Angles {
    fn default() -> Self {
        Self { weights: Box::new([0.0; NODES]), ends: [CosTheta::FACING, CosTheta::GRAZING] }
    }
}

/// More than any picture has pixels: sums of so many keep their digits.
const MOST_SEEN: f64 = 1e15;

impl Angles {
    /// The weights of the nodes, from grazing to facing, and the smallest and the largest cosine that was seen, none
    /// where nothing was; a sentence where they are none.
    pub fn from_weights(weights: &[f64], cosines: Option<[f64; 2]>) -> Result<Self, String> {
        let count = || format!("there must be {NODES} weights, not {}", weights.len());
        let weights: Box<[f64; NODES]> = Box::new(weights.try_into().map_err(|_| count())?);
        if let Some(weight) = weights.iter().find(|weight| !(0.0..=MOST_SEEN).contains(*weight)) {
            return Err(format!("a weight lies in 0–{MOST_SEEN:e}, unlike {weight:e}"));
        }
        let unseen = Self { weights, ..Self::default() };
        match cosines {
            None if unseen.is_empty() => Ok(unseen),
            None => Err("what is seen has a smallest and a largest cosine".to_owned()),
            Some([smallest, largest]) if 0.0 <= smallest && smallest <= largest && largest <= 1.0 => {
                Ok(Self { ends: [smallest, largest].map(CosTheta::new), ..unseen })
            }
            Some([smallest, largest]) => Err(format!("cosines go from 0 up to 1, unlike {smallest:e} to {largest:e}")),
        }
    }

    /// The smallest and the largest cosine that was seen.
    pub fn cosines(&self) -> Option<[f64; 2]> {
        (!self.is_empty()).then(|| self.ends.map(CosTheta::get))
    }

    /// The same angles, each seen so many times.
    pub fn times(mut self, factor: f64) -> Self {
        self.weights.iter_mut().for_each(|weight| *weight *= factor);
        self
    }

    /// Adds something seen at an angle, by its share of the picture; only finite weights above 0 count.
    pub fn add(&mut self, cos_theta: CosTheta, weight: f64) {
        let valid = if weight.is_finite() { weight.max(0.0) } else { 0.0 };
        if valid > 0.0 {
            self.reach(cos_theta);
        }
        let below = ((cos_theta.get().sqrt() * (NODES - 1) as f64).floor() as usize).min(NODES - 2);
        let [low, high] = [below, below + 1].map(|node| COSINES[node].get());
        let share = ((cos_theta.get() - low) / (high - low)).clamp(0.0, 1.0);
        self.weights[below] += valid * (1.0 - share);
        self.weights[below + 1] += valid * share;
    }

    /// Lets the range of angles reach one that is a limit: of a row of places it is the end, and no place.
    pub(super) fn reach(&mut self, cos_theta: CosTheta) {
        let [smallest, largest] = &mut self.ends;
        if cos_theta < *smallest {
            *smallest = cos_theta;
        }
        if cos_theta > *largest {
            *largest = cos_theta;
        }
    }

    /// Adds what another distribution has seen.
    pub fn merge(&mut self, other: &Self) {
        if !other.is_empty() {
            other.ends.into_iter().for_each(|end| self.reach(end));
        }
        self.weights.iter_mut().zip(other.weights.iter()).for_each(|(weight, more)| *weight += more);
    }

    /// The weight of each node, from grazing to facing.
    pub fn weights(&self) -> &[f64; NODES] {
        &self.weights
    }

    /// Everything that was seen.
    pub fn total(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// True where nothing was seen.
    pub fn is_empty(&self) -> bool {
        self.weights.iter().all(|weight| *weight == 0.0)
    }

    /// The nodes that were seen, with their weights, from grazing to facing.
    pub fn seen(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.weights.iter().copied().enumerate().filter(|(_, weight)| *weight > 0.0)
    }

    /// The smallest and the largest angle that were seen, in degrees, to a millionth.
    pub fn range_deg(&self) -> Option<(f64, f64)> {
        // Near 0° a cosine says no more.
        let deg = |c: CosTheta| (c.deg() * 1e6).round() / 1e6;
        let [largest, smallest] = self.ends.map(deg);
        (!self.is_empty()).then_some((smallest, largest))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn weight_and_mean_cosine_are_kept(cosines in prop::collection::vec(0.0..=1.0_f64, 1..40)) {
            let mut angles = Angles::default();
            cosines.iter().for_each(|c| angles.add(CosTheta::new(*c), 1.0));
            let mean: f64 = angles.seen().map(|(node, weight)| weight * node_cosines()[node].get()).sum();
            prop_assert!((angles.total() - cosines.len() as f64).abs() < 1e-9);
            prop_assert!((mean - cosines.iter().sum::<f64>()).abs() < 1e-9);
            let (smallest, largest) = angles.range_deg().unwrap();
            for c in cosines {
                let deg = CosTheta::new(c).deg();
                prop_assert!(smallest <= deg + 1e-6 && deg <= largest + 1e-6);
            }
        }
    }

    #[test]
    fn weights_of_a_file_are_as_many_as_nodes_and_finite() {
        let weights = [2.0; NODES];
        let of = |weights: &[f64]| Angles::from_weights(weights, Some([0.25, 1.0]));
        assert_eq!(of(&weights).unwrap().weights(), &weights);
        assert_eq!(of(&weights).unwrap().cosines(), Some([0.25, 1.0]));
        assert_eq!(of(&weights).unwrap().times(0.5).total(), NODES as f64);
        assert!(of(&weights[1..]).unwrap_err().contains("257 weights, not 256"));
        assert!(Angles::from_weights(&weights, None).unwrap_err().contains("a smallest and a largest cosine"));
        assert_eq!(Angles::from_weights(&[0.0; NODES], None), Ok(Angles::default()));
        for cosines in [[0.5, 0.4], [-0.1, 0.5], [0.5, 1.1], [f64::NAN, 1.0]] {
            let refused = Angles::from_weights(&weights, Some(cosines)).unwrap_err();
            assert!(refused.contains("from 0 up to 1"), "{refused}");
        }
        for wrong in [-1.0, f64::NAN, f64::INFINITY, 1e16] {
            let mut weights = weights;
            weights[3] = wrong;
            assert!(of(&weights).unwrap_err().contains("a weight lies in"), "{wrong}");
        }
    }

    #[test]
    fn a_node_is_seen_alone_and_nothing_by_what_is_no_weight() {
        let mut angles = Angles::default();
        for weight in [f64::NAN, -1.0, f64::INFINITY, 0.0] {
            angles.add(CosTheta::MAX, weight);
        }
        assert!(angles.is_empty() && angles.range_deg().is_none());
        angles.add(CosTheta::FACING, 2.0);
        assert_eq!(angles.seen().collect::<Vec<_>>(), [(NODES - 1, 2.0)]);
        assert_eq!(angles.range_deg(), Some((0.0, 0.0)));
        let mut both = angles.clone();
        both.merge(&angles);
        assert_eq!(both.total(), 4.0);
    }
}
