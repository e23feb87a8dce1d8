//! How often each angle is seen, as a line over the degrees.

use std::sync::LazyLock;

use crate::fresnel::CosTheta;
use crate::scene::{Angles, NODES};

/// Points of the line, as an angle in degrees and how often a degree is seen there, from facing to grazing; what was
/// seen lies between the first and the last. Empty where nothing was.
///
/// Nodes are even in √c, not in degrees, and share what lies between them: how much a node has says nothing without how
/// much an even distribution gives it. Of that the line is made, a degree of it for each point, so that what is even
/// looks even.
pub(super) fn silhouette(angles: &Angles) -> Vec<(f64, f64)> {
    let Some((smallest, largest)) = angles.range_deg() else { return Vec::new() };
    let points: Vec<(f64, f64)> = groups(angles).iter().map(Share::point).collect();
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    // A single angle has a width on the screen too.
    let centre = 0.5 * (smallest + largest);
    let ends = [smallest.min(centre - 0.5).max(0.0), largest.max(centre + 0.5).min(90.0)];
    let ends = [(ends[0], first.1), (ends[1], last.1)];
    let within = points.iter().filter(|(deg, _)| (ends[0].0..=ends[1].0).contains(deg));
    [ends[0]].iter().chain(within).chain([&ends[1]]).copied().collect()
}

/// What some nodes have beside what an even distribution gives them.
#[derive(Clone, Copy, Default)]
struct Share {
    /// What they have.
    weight: f64,
    /// Degrees of an even distribution.
    even: f64,
    /// The sum of its angles, weighted alike.
    even_deg: f64,
}

impl Share {
    fn and(self, other: Self) -> Self {
        Self {
            weight: self.weight + other.weight,
            even: self.even + other.even,
            even_deg: self.even_deg + other.even_deg,
        }
    }

    fn point(&self) -> (f64, f64) {
        let even = self.even.max(f64::MIN_POSITIVE);
        (self.even_deg / even, self.weight / even)
    }
}

/// The nodes that were seen, from facing to grazing, joined until an even distribution gives them a degree.
fn groups(angles: &Angles) -> Vec<Share> {
    let mut groups: Vec<Share> = Vec::new();
    let mut open = Share::default();
    for node in nodes(angles).rev() {
        let [even, even_deg] = EVEN[node];
        open = open.and(Share { weight: angles.weights()[node], even, even_deg });
        if open.even >= 1.0 {
            groups.push(std::mem::take(&mut open));
        }
    }
    if open.even > 0.0 || open.weight > 0.0 {
        // What is left is no degree of its own, unless it is all there is.
        let before = groups.pop().unwrap_or_default();
        groups.push(before.and(open));
    }
    groups
}

/// The nodes between the first and the last that were seen. What is seen ends between two nodes, which therefore have a
/// part only of what lies around them: where there are enough others, they are left out.
fn nodes(angles: &Angles) -> std::ops::RangeInclusive<usize> {
    let mut seen = angles.seen().map(|(node, _)| node);
    let first = seen.next().unwrap_or(0);
    let last = seen.last().unwrap_or(first);
    let is_whole = |node: usize| node == 0 || node == NODES - 1;
    if last - first < 6 {
        return first..=last;
    }
    let left_out = |node: usize| if is_whole(node) { 0 } else { 2 };
    first + left_out(first)..=last - left_out(last)
}

/// What each node has of a distribution in which every degree is seen once, and the sum of the angles there.
static EVEN: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    const STEPS: u32 = 90 * 256;
    let (mut even, mut even_deg) = (Angles::default(), Angles::default());
    for step in 0..STEPS {
        let deg = 90.0 * (f64::from(step) + 0.5) / f64::from(STEPS);
        let weight = 90.0 / f64::from(STEPS);
        even.add(CosTheta::from_deg(deg), weight);
        even_deg.add(CosTheta::from_deg(deg), weight * deg);
    }
    even.weights().iter().zip(even_deg.weights()).map(|(even, deg)| [*even, *deg]).collect()
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Shape;

    /// Every degree between two as often as any other.
    fn even(from_deg: f64, to_deg: f64) -> Angles {
        let mut angles = Angles::default();
        for step in 0..20_000 {
            angles.add(CosTheta::from_deg(from_deg + (to_deg - from_deg) * (f64::from(step) + 0.5) / 20_000.0), 1.0);
        }
        angles
    }

    fn largest(line: &[(f64, f64)]) -> f64 {
        line.iter().map(|(_, value)| *value).fold(0.0, f64::max)
    }

    #[test]
    fn what_is_even_looks_even_to_its_ends() {
        for (from_deg, to_deg) in [(0.0, 90.0), (0.0, 60.0), (20.0, 45.0), (61.0, 90.0)] {
            let line = silhouette(&even(from_deg, to_deg));
            let most = largest(&line);
            for (deg, value) in &line {
                assert!(*value > 0.93 * most, "{from_deg}–{to_deg}: {value} of {most} at {deg}");
            }
            let (first, last) = (line[0].0, line[line.len() - 1].0);
            assert!((first - from_deg).abs() < 1.5 && (last - to_deg).abs() < 0.5, "{first} {last}");
        }
    }

    /// A card shows its cosine at every tilt; of a cylinder every sin θ is as frequent as any other; of the disc of a
    /// ball every sin² θ.
    #[test]
    fn silhouettes_of_shapes_are_their_densities_without_dents() {
        let cosine = |deg: f64| deg.to_radians().cos();
        let of_ball = |deg: f64| (2.0 * deg).to_radians().sin();
        let card = Shape::Card { from_deg: 0.0, to_deg: 60.0 };
        let cases: [(Shape, &dyn Fn(f64) -> f64); 3] =
            [(card, &cosine), (Shape::Cylinder, &cosine), (Shape::Sphere, &of_ball)];
        for (shape, density) in cases {
            let line = silhouette(&shape.angles());
            let inner = &line[1..line.len() - 1];
            let factor = inner.iter().map(|(_, value)| value).sum::<f64>()
                / inner.iter().map(|(deg, _)| density(*deg)).sum::<f64>();
            for (deg, value) in inner {
                let off = (value / factor - density(*deg)).abs();
                assert!(off < 0.04, "{shape}: off by {off} at {deg}");
            }
            assert!(line.iter().all(|(deg, _)| *deg < 60.5) || shape != card, "nothing is past the last tilt");
        }
    }

    #[test]
    fn one_angle_has_a_width_and_nothing_has_no_line() {
        let mut one = Angles::default();
        one.add(CosTheta::from_deg(50.0), 3.0);
        let line = silhouette(&one);
        assert!(line[line.len() - 1].0 - line[0].0 >= 1.0 - 1e-9 && largest(&line) > 0.0, "{line:?}");
        assert!(silhouette(&Angles::default()).is_empty());
    }
}
