//! The light of each spot of a ball, read off a reference ball in the same surroundings.

use super::MatchError;
use super::facing::Facing;
use super::view::View;
use crate::metal::{ReflectanceTable, metal_by_name};
use crate::photo::statistics::usable_channels;
use crate::photo::{Circle, ReferenceBall};

/// A ball of a known metal: its pixel over its reflectance is the light from that direction.
#[derive(Debug)]
pub(super) struct ReferenceField {
    circle: Circle,
    reflectance: ReflectanceTable,
}

impl ReferenceField {
    /// Published data sets of one metal differ by about this much, relative.
    pub const RELATIVE_UNCERTAINTY: f64 = 0.015;

    pub fn of(ball: &ReferenceBall) -> Result<Self, MatchError> {
        let metal = metal_by_name(&ball.metal).map_err(|error| MatchError::Metal(error.to_string()))?;
        Ok(Self { circle: ball.circle, reflectance: ReflectanceTable::of(metal) })
    }

    /// F facing the surface.
    pub fn facing_reflectance(&self) -> [f64; 3] {
        self.reflectance.at(1.0).0
    }

    /// L where a body faces this way: it and the ball mirror the same direction at the same normal.
    ///
    /// NaN in a channel where one of the four pixels around the spot is missing, clipped or not finite.
    pub fn light(&self, view: &View, facing: &Facing) -> [f64; 3] {
        let [u, v] = facing.normal;
        let (x, y) = (self.circle.x + u * self.circle.radius - 0.5, self.circle.y + v * self.circle.radius - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (s, t) = (x - column, y - row);
        let mut sum = [0.0; 3];
        for (dx, dy, weight) in
            [(0.0, 0.0, (1.0 - s) * (1.0 - t)), (1.0, 0.0, s * (1.0 - t)), (0.0, 1.0, (1.0 - s) * t), (1.0, 1.0, s * t)]
        {
            let is_inside = column + dx >= 0.0 && row + dy >= 0.0;
            let pixel = is_inside.then(|| view.pixel((column + dx) as u32, (row + dy) as u32)).flatten();
            let usable = pixel.as_ref().map_or([false; 3], usable_channels);
            for i in 0..3 {
                let value = pixel.filter(|_| usable[i]).map_or(f64::NAN, |pixel| pixel.rgb[i]);
                sum[i] += weight * value;
            }
        }
        let reflectance = self.reflectance.at(facing.cosine);
        std::array::from_fn(|i| sum[i] / reflectance[i])
    }
}
