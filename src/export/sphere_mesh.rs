//! A unit sphere of triangles.

use std::f64::consts::PI;

/// Vertices on the unit sphere, which are its normals too, and triangles that face outwards.
#[derive(Debug)]
pub(super) struct SphereMesh {
    pub vertices: Vec<[f32; 3]>,
    pub triangles: Vec<[u16; 3]>,
}

impl SphereMesh {
    /// `meridians` around the y axis and `bands` from pole to pole; the poles are single vertices.
    ///
    /// With both divisible by 4 and 2 the six points of the axes are vertices, so the bounds are exactly ±1.
    pub(super) fn new(meridians: u16, bands: u16) -> Self {
        let mut vertices = vec![[0.0, 1.0, 0.0]];
        for band in 1..bands {
            let (sin_polar, cos_polar) = (PI * f64::from(band) / f64::from(bands)).sin_cos();
            for meridian in 0..meridians {
                let (sin, cos) = (2.0 * PI * f64::from(meridian) / f64::from(meridians)).sin_cos();
                vertices.push([(sin_polar * cos) as f32, cos_polar as f32, (sin_polar * sin) as f32]);
            }
        }
        vertices.push([0.0, -1.0, 0.0]);
        Self { vertices, triangles: triangles(meridians, bands) }
    }

    /// Vertices, then indices, little-endian, as a glTF buffer.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let vertices = self.vertices.iter().flatten().flat_map(|v| v.to_le_bytes());
        vertices.chain(self.triangles.iter().flatten().flat_map(|i| i.to_le_bytes())).collect()
    }
}

fn triangles(meridians: u16, bands: u16) -> Vec<[u16; 3]> {
    let ring = |band: u16, meridian: u16| 1 + (band - 1) * meridians + meridian % meridians;
    let south = 1 + (bands - 1) * meridians;
    let mut triangles = Vec::new();
    for meridian in 0..meridians {
        triangles.push([0, ring(1, meridian + 1), ring(1, meridian)]);
        for band in 1..bands - 1 {
            let [a, b] = [ring(band, meridian), ring(band, meridian + 1)];
            let [c, d] = [ring(band + 1, meridian), ring(band + 1, meridian + 1)];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
        triangles.push([south, ring(bands - 1, meridian), ring(bands - 1, meridian + 1)]);
    }
    triangles
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn is_closed_and_faces_outwards() {
        let mesh = SphereMesh::new(48, 24);
        let mut edges = BTreeSet::new();
        for &[a, b, c] in &mesh.triangles {
            let [p, q, r] = [a, b, c].map(|i| Vector3::from(mesh.vertices[usize::from(i)]));
            assert!((q - p).cross(&(r - p)).dot(&(p + q + r)) > 0.0);
            assert!([(a, b), (b, c), (c, a)].into_iter().all(|edge| edges.insert(edge)), "an edge is used twice");
        }
        assert!(edges.iter().all(|&(a, b)| edges.contains(&(b, a))), "a hole");
        // Euler: V − E + F = 2.
        assert_eq!(mesh.vertices.len() + mesh.triangles.len(), edges.len() / 2 + 2);
    }

    #[test]
    fn reaches_the_bounds_it_claims() {
        for axis in 0..3 {
            let values = SphereMesh::new(48, 24).vertices.into_iter().map(|v| v[axis]);
            let (low, high) = values.fold((0.0_f32, 0.0_f32), |(low, high), v| (low.min(v), high.max(v)));
            assert_eq!((low, high), (-1.0, 1.0));
        }
    }
}
