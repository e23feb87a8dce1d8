//! Which way a surface faces where a pixel shows it.

use crate::fresnel::CosTheta;
use crate::photo::Body;

/// Which way a spot of a surface faces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facing {
    /// Cosine of the angle of incidence.
    pub cosine: f64,
    /// The surface normal, right and down; zero where there is no outline.
    pub normal: [f64; 2],
}

/// The facings along a row of pixels: the normal of a ball and of a cylinder is linear along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facings {
    /// Of the middle of column 0.
    start: [f64; 2],
    step: [f64; 2],
    /// The angle where no outline gives it.
    even: Option<CosTheta>,
}

impl Facings {
    /// Along a body.
    pub fn along(body: Body, y: f64) -> Self {
        let (start, next) = (body.offset(0.5, y), body.offset(1.5, y));
        Self { start, step: [next[0] - start[0], next[1] - start[1]], even: None }
    }

    /// The same everywhere.
    pub const fn even(facing: CosTheta) -> Self {
        Self { start: [0.0; 2], step: [0.0; 2], even: Some(facing) }
    }

    /// Of the pixel in a column.
    pub fn at(&self, column: u32) -> Facing {
        let x = f64::from(column);
        let normal = [self.start[0] + x * self.step[0], self.start[1] + x * self.step[1]];
        let cosine = (1.0 - normal[0] * normal[0] - normal[1] * normal[1]).max(0.0).sqrt();
        Facing { cosine: self.even.map_or(cosine, CosTheta::get), normal }
    }
}
