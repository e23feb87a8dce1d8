//! The angle of incidence, by its cosine.

/// cos θ_max = 1/7, where the correction term of Hoffman's model peaks (paper section 8).
pub const COS_THETA_MAX: f64 = 1.0 / 7.0;

/// θ_max = arccos(1/7) in degrees: the angle at which h is the reflectance.
pub const THETA_MAX_DEG: f64 = 81.786_789_298_261_81;

/// Cosine of the angle of incidence, in `[0, 1]`; 1 faces the surface.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct CosTheta(f64);

impl CosTheta {
    /// Facing the surface, θ = 0°.
    pub const FACING: Self = Self(1.0);
    /// Grazing, θ = 90°.
    pub const GRAZING: Self = Self(0.0);
    /// θ_max, where F = h.
    pub const MAX: Self = Self(COS_THETA_MAX);

    /// A cosine, limited to `[0, 1]`: a dot product of unit vectors can leave it by rounding. NaN grazes.
    pub fn new(cosine: f64) -> Self {
        Self(if cosine > 0.0 { cosine.min(1.0) } else { 0.0 })
    }

    /// From the angle of incidence in degrees, 0–90.
    pub fn from_deg(angle_deg: f64) -> Self {
        if angle_deg >= 90.0 { Self::GRAZING } else { Self::new(angle_deg.to_radians().cos()) }
    }

    /// The angle of incidence in degrees.
    pub fn deg(self) -> f64 {
        self.0.acos().to_degrees()
    }

    /// The cosine itself, c in the formulas.
    pub const fn get(self) -> f64 {
        self.0
    }
}

/// The 91 angles 0°, 1°, …, 90° over which errors are averaged.
pub fn whole_degrees() -> impl ExactSizeIterator<Item = CosTheta> + Clone {
    (0..=90u8).map(|deg| CosTheta::from_deg(f64::from(deg)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn theta_max_is_the_arc_cosine_of_one_seventh() {
        assert!((CosTheta::MAX.deg() - THETA_MAX_DEG).abs() < 1e-12);
        assert!((CosTheta::from_deg(THETA_MAX_DEG).get() - COS_THETA_MAX).abs() < 1e-15);
    }

    #[test]
    fn stays_inside_for_any_number() {
        for c in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 1.0 + f64::EPSILON, -1e-18] {
            assert!((0.0..=1.0).contains(&CosTheta::new(c).get()), "{c}");
        }
    }

    #[test]
    fn ninety_degrees_grazes_exactly() {
        assert_eq!(CosTheta::from_deg(90.0).get(), 0.0);
        assert_eq!(whole_degrees().len(), 91);
    }
}
