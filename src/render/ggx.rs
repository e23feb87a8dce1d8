//! The GGX lobe: the directions a rough surface mirrors into.

use std::f64::consts::TAU;

/// Unit vector or direction.
pub(super) type Vector = nalgebra::Vector3<f64>;

/// Trowbridge & Reitz 1975, Walter et al. 2007 eq. 33: the density of facets facing `cos_h`, per projected area.
pub(super) fn ggx_density(cos_h: f64, alpha: f64) -> f64 {
    let a2 = alpha * alpha;
    let t = 1.0 + (a2 - 1.0) * cos_h * cos_h;
    a2 / (std::f64::consts::PI * t * t)
}

/// Two well-spread numbers in `[0, 1)` for sample `index` of `count` (Hammersley points, radical inverse in base 2).
pub(super) fn hammersley(index: u32, count: u32) -> (f64, f64) {
    let radical_inverse = f64::from(index.reverse_bits()) / 4_294_967_296.0;
    ((f64::from(index) + 0.5) / f64::from(count), radical_inverse)
}

/// A facet normal around z, distributed as the facets' area projected on the surface (Walter et al. 2007, eq. 35–36).
pub(super) fn facet_around_z((u, v): (f64, f64), alpha: f64) -> Vector {
    let cos = ((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u)).sqrt();
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    Vector::new(sin * (TAU * v).cos(), sin * (TAU * v).sin(), cos)
}

/// A facet normal as seen from `view` above the plane z = 0 (Heitz 2018, "Sampling the GGX distribution of visible normals").
pub(super) fn visible_facet(view: Vector, (u, v): (f64, f64), alpha: f64) -> Vector {
    let stretched = Vector::new(alpha * view.x, alpha * view.y, view.z).normalize();
    let length_sq = stretched.x * stretched.x + stretched.y * stretched.y;
    let t1 = if length_sq > 0.0 { Vector::new(-stretched.y, stretched.x, 0.0) / length_sq.sqrt() } else { Vector::x() };
    let t2 = stretched.cross(&t1);
    let (radius, phi) = (u.sqrt(), TAU * v);
    let p1 = radius * phi.cos();
    let lean = 0.5 * (1.0 + stretched.z);
    let p2 = (1.0 - lean) * (1.0 - p1 * p1).max(0.0).sqrt() + lean * radius * phi.sin();
    let normal = t1 * p1 + t2 * p2 + stretched * (1.0 - p1 * p1 - p2 * p2).max(0.0).sqrt();
    Vector::new(alpha * normal.x, alpha * normal.y, normal.z.max(0.0)).normalize()
}

/// Λ of Smith's masking for a direction at `cos` from the normal (Heitz 2014, eq. 72).
pub(super) fn smith_lambda(cos: f64, alpha: f64) -> f64 {
    let tan_sq = (1.0 - cos * cos).max(0.0) / (cos * cos);
    0.5 * ((1.0 + alpha * alpha * tan_sq).sqrt() - 1.0)
}
