//! A photograph's scene: balls, flat patches and surroundings, seen from afar.

use super::surroundings::{Dome, Floor, Vec3, smooth_step};
use crate::color::Rgb;
use crate::metal::ReflectanceTable;
use crate::photo::{Body, Circle, Cylinder};

/// Everything in front of the camera. Circles and rectangles are in pixels of the finished picture.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// What surrounds the ball.
    pub dome: Dome,
    /// What it stands on.
    pub floor: Option<Floor>,
    /// How far the camera looks down, in degrees.
    pub pitch_deg: f64,
    /// Balls; the first gives the scale of the floor.
    pub balls: Vec<Ball>,
    /// Polished cylinders, seen by parallel rays.
    pub rods: Vec<Rod>,
    /// Flat things of one radiance each, in front of the rest.
    pub patches: Vec<Patch>,
    /// Rays each way in every pixel.
    pub rays: u32,
}

/// A polished ball.
#[derive(Clone, Debug)]
pub struct Ball {
    /// Its outline.
    pub circle: Circle,
    /// Its metal.
    pub metal: ReflectanceTable,
    /// Distance of the camera in ball radii; infinite for parallel rays.
    pub camera_distance: f64,
}

/// A polished cylinder across the line of sight.
#[derive(Clone, Debug)]
pub struct Rod {
    /// Its outline.
    pub cylinder: Cylinder,
    /// Its metal.
    pub metal: ReflectanceTable,
}

/// A rectangle of one radiance that faces the camera.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    /// Left, top, width, height in pixels.
    pub bounds: [f64; 4],
    /// What it sends to the camera.
    pub radiance: Rgb,
    /// Radius of its corners in pixels.
    pub corner: f64,
    /// How dark and how wide, in pixels, a shadow it throws behind itself; (0, 0) for none.
    pub shadow: (f64, f64),
}

impl Scene {
    /// Linear Rec.709 radiance, row by row, each pixel the mean of its rays.
    pub fn render(&self) -> Vec<Rgb> {
        let pixels = (0..self.height).flat_map(|row| (0..self.width).map(move |column| (column, row)));
        pixels.map(|(column, row)| self.pixel(column, row)).collect()
    }

    fn pixel(&self, column: u32, row: u32) -> Rgb {
        let offset = |index: u32| (f64::from(index) + 0.5) / f64::from(self.rays);
        let mut sum = Rgb::BLACK;
        for sub_row in 0..self.rays {
            for sub_column in 0..self.rays {
                sum += self.ray(f64::from(column) + offset(sub_column), f64::from(row) + offset(sub_row));
            }
        }
        sum / f64::from(self.rays * self.rays)
    }

    /// The radiance along the ray through a point of the picture.
    fn ray(&self, x: f64, y: f64) -> Rgb {
        if let Some(patch) = self.patches.iter().rev().find(|patch| patch.distance(x, y) <= 0.0) {
            return patch.radiance;
        }
        let ball = self.balls.iter().find_map(|ball| self.mirrored(ball, x, y));
        let rod = || self.rods.iter().find_map(|rod| self.mirrored_by_rod(rod, x, y));
        ball.or_else(rod).unwrap_or_else(|| self.behind(x, y) * self.shade(x, y))
    }

    /// What a ball shows; `None` beside it.
    fn mirrored(&self, ball: &Ball, x: f64, y: f64) -> Option<Rgb> {
        let Circle { x: cx, y: cy, radius } = ball.circle;
        let (px, py) = ((x - cx) / radius, (cy - y) / radius);
        let (normal, to_camera) = ball.normal_and_view(px, py)?;
        Some(self.mirrored_at(&normal, &to_camera, &ball.metal))
    }

    /// What a rod shows; `None` beside it.
    fn mirrored_by_rod(&self, rod: &Rod, x: f64, y: f64) -> Option<Rgb> {
        let [right, down] = Body::Cylinder(rod.cylinder).normal(x, y)?;
        let sine2 = right * right + down * down;
        let normal = (sine2 < 1.0).then(|| Vec3::new(right, -down, (1.0 - sine2).sqrt()))?;
        Some(self.mirrored_at(&normal, &Vec3::z(), &rod.metal))
    }

    /// The surroundings in a mirror of this normal, both directions in the camera's axes.
    fn mirrored_at(&self, normal: &Vec3, to_camera: &Vec3, metal: &ReflectanceTable) -> Rgb {
        let cosine = normal.dot(to_camera);
        let direction = self.tilted(&(normal * (2.0 * cosine) - to_camera));
        self.surroundings(&self.tilted(normal), &direction) * metal.at(cosine)
    }

    /// From the camera's axes to the world's.
    fn tilted(&self, v: &Vec3) -> Vec3 {
        let (sin, cos) = self.pitch_deg.to_radians().sin_cos();
        Vec3::new(v.x, v.y * cos + v.z * sin, v.z * cos - v.y * sin)
    }

    /// The floor where a ray meets it, else the dome.
    fn surroundings(&self, origin: &Vec3, direction: &Vec3) -> Rgb {
        let sky = self.dome.radiance(direction);
        let Some(floor) = self.floor.filter(|_| direction.y < -1e-6) else { return sky };
        let point = origin + direction * ((-1.0 - origin.y) / direction.y);
        let (light, share) = floor.at(&point);
        sky.lerp(light, share)
    }

    /// What is seen beside the balls: the floor, then the dome through a lens of moderate width.
    fn behind(&self, x: f64, y: f64) -> Rgb {
        let scale = self.balls.first().map_or(Circle::new(0.0, 0.0, 1.0), |ball| ball.circle);
        let (px, py) = ((x - scale.x) / scale.radius, (scale.y - y) / scale.radius);
        let origin = self.tilted(&Vec3::new(px, py, 0.0));
        let far = self.tilted(&Vec3::new(px * 0.16, py * 0.16, -1.0).normalize());
        let dome = self.dome.radiance(&far);
        let Some(floor) = self.floor.filter(|_| self.pitch_deg > 0.0) else { return dome };
        let forward = self.tilted(&-Vec3::z());
        let point = origin + forward * ((-1.0 - origin.y) / forward.y);
        let (light, share) = floor.at(&point);
        dome.lerp(light, share)
    }

    /// Shadows that patches throw on what is behind them.
    fn shade(&self, x: f64, y: f64) -> f64 {
        self.patches.iter().map(|patch| patch.shade(x, y)).product()
    }
}

impl Ball {
    /// Normal and direction to the camera at a point of the outline's disc, in the camera's axes.
    ///
    /// From a distance of d radii the outline is the circle of tangents, so that the picture's radius 1
    /// stands for the angle asin(1/d) around the axis.
    fn normal_and_view(&self, px: f64, py: f64) -> Option<(Vec3, Vec3)> {
        let rho2 = px * px + py * py;
        if rho2 >= 1.0 {
            return None;
        }
        if self.camera_distance.is_infinite() {
            return Some((Vec3::new(px, py, (1.0 - rho2).sqrt()), Vec3::z()));
        }
        let d = self.camera_distance;
        let slope = 1.0 / (d * d - 1.0).sqrt();
        let ray = Vec3::new(px * slope, py * slope, -1.0).normalize();
        let camera = Vec3::new(0.0, 0.0, d);
        let along = camera.dot(&ray);
        let normal = camera + ray * (-along - (along * along - d * d + 1.0).max(0.0).sqrt());
        Some((normal, -ray))
    }
}

impl Patch {
    /// Signed distance to the rounded rectangle, negative inside.
    fn distance(&self, x: f64, y: f64) -> f64 {
        let [left, top, width, height] = self.bounds;
        let outside = |p: f64, start: f64, size: f64| (p - start - size / 2.0).abs() - size / 2.0 + self.corner;
        let (dx, dy) = (outside(x, left, width), outside(y, top, height));
        dx.max(0.0).hypot(dy.max(0.0)) + dx.max(dy).min(0.0) - self.corner
    }

    fn shade(&self, x: f64, y: f64) -> f64 {
        let (darkness, width) = self.shadow;
        if darkness == 0.0 {
            return 1.0;
        }
        1.0 - darkness * smooth_step(width, -width, self.distance(x - width * 0.2, y - width * 0.35))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;
    use crate::sample::surroundings::Tent;

    fn ball(camera_distance: f64) -> Ball {
        let metal = ReflectanceTable::of(metal_by_name("chromium").unwrap());
        Ball { circle: Circle::new(0.0, 0.0, 1.0), metal, camera_distance }
    }

    #[test]
    fn a_distant_camera_is_the_limit_of_a_near_one() {
        for (x, y) in [(0.0, 0.0), (0.5, 0.2), (0.0, -0.99)] {
            let (near, _) = ball(1e5).normal_and_view(x, y).unwrap();
            let (far, _) = ball(f64::INFINITY).normal_and_view(x, y).unwrap();
            assert!((near - far).norm() < 1e-3, "{near} {far}");
        }
    }

    #[test]
    fn a_near_camera_grazes_at_the_outline_too() {
        let (normal, view) = ball(4.0).normal_and_view(0.99999, 0.0).unwrap();
        assert!((normal.norm() - 1.0).abs() < 1e-9);
        assert!(normal.dot(&view) < 0.01, "{}", normal.dot(&view));
    }

    #[test]
    fn an_even_tent_shows_the_reflectance() {
        let ball = Ball { circle: Circle::new(20.0, 20.0, 15.0), ..ball(f64::INFINITY) };
        let metal = ball.metal.clone();
        let scene = Scene {
            width: 40,
            height: 40,
            dome: Dome::Tent(Tent::default()),
            floor: None,
            pitch_deg: 0.0,
            balls: vec![ball],
            rods: Vec::new(),
            patches: Vec::new(),
            rays: 1,
        };
        assert!(scene.ray(20.0, 20.0).max_abs_difference(metal.at(1.0)) < 1e-12);
        assert_eq!(scene.ray(1.0, 1.0), Rgb::WHITE);
    }
}
