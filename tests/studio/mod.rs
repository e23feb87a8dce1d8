//! Photographs with known r and h, made from the spectral truth; every test changes what it asks about.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::ops::ControlFlow;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::metal::{ReflectanceTable, metal_by_name};
use edgewise::photo::{Area, Card, Circle, Cylinder, Match, MatchRequest, Photo, WarningCode, solve};
use edgewise::sample::{Ball, Camera, Dome, Patch, Rod, Scene, Tent, Truth, Vec3, camera_jpeg, linear_png};

/// How a picture reaches the solver.
#[derive(Clone, Copy)]
pub enum Stored {
    /// Unclamped floats.
    Float,
    /// A 16-bit linear PNG, clipped at 1.
    Png,
    /// An 8-bit JPEG through a camera's tone curve.
    Jpeg,
}

/// A ball under a dome with a white card beside it.
#[derive(Clone)]
pub struct Studio {
    pub metal: &'static str,
    pub tent: Tent,
    pub circle: Circle,
    /// Instead of the ball.
    pub cylinder: Option<Cylinder>,
    pub camera: Camera,
    pub camera_distance: f64,
    pub size: [u32; 2],
    pub card: [f64; 4],
    /// The card as it is, over what its label says.
    pub card_error: f64,
    pub reference: Option<(Circle, &'static str)>,
    /// Patches with their radiance under a white light of 1.
    pub patches: Vec<([f64; 4], Rgb)>,
    pub stored: Stored,
    pub rays: u32,
}

impl Default for Studio {
    fn default() -> Self {
        Self {
            metal: "chromium",
            tent: Tent::default(),
            circle: Circle::new(130.0, 128.0, 110.0),
            cylinder: None,
            camera: Camera { exposure: 0.7, blur_px: 0.5, noise: 0.01, seed: 1 },
            camera_distance: f64::INFINITY,
            size: [310, 256],
            card: [258.0, 100.0, 40.0, 60.0],
            card_error: 1.0,
            reference: None,
            patches: Vec::new(),
            stored: Stored::Float,
            rays: 3,
        }
    }
}

impl Studio {
    pub fn photo(&self) -> Photo {
        let [width, height] = self.size;
        let read =
            |name: &str, bytes: Vec<u8>| Photo::from_bytes(name, &bytes, &mut |_| ControlFlow::Continue(())).unwrap();
        match self.stored {
            Stored::Float => {
                let linear = self.picture().iter().map(|pixel| pixel.0.map(|value| value as f32)).collect();
                Photo::from_linear("studio", width, height, linear)
            }
            Stored::Png => read("studio.png", self.file()),
            Stored::Jpeg => read("studio.jpg", self.file()),
        }
    }

    /// The picture as a file: a JPEG where it is stored so, else a linear PNG of 16 bits.
    pub fn file(&self) -> Vec<u8> {
        let (picture, width) = (self.picture(), self.size[0]);
        match self.stored {
            Stored::Jpeg => camera_jpeg(&picture, width, 92).unwrap(),
            Stored::Float | Stored::Png => linear_png(&picture, width, 16).unwrap(),
        }
    }

    /// Its linear pixels, by rows.
    pub fn picture(&self) -> Vec<Rgb> {
        let [width, height] = self.size;
        let dome = Dome::Tent(self.tent);
        let white = dome.white_radiance(&Vec3::z());
        let patch = |bounds, radiance| Patch { bounds, radiance, corner: 0.0, shadow: (0.0, 0.0) };
        let card = patch(self.card, white * (0.9 * self.card_error));
        let others = self.patches.iter().map(|(bounds, reflectance)| patch(*bounds, white * *reflectance));
        let ball = |circle, metal: &str| Ball {
            circle,
            metal: ReflectanceTable::of(metal_by_name(metal).unwrap()),
            camera_distance: self.camera_distance,
        };
        let measured = self.cylinder.is_none().then(|| ball(self.circle, self.metal)).into_iter();
        let reference = self.reference.map(|(circle, metal)| ball(circle, metal));
        let metal = || ReflectanceTable::of(metal_by_name(self.metal).unwrap());
        let rod = self.cylinder.map(|cylinder| Rod { cylinder, metal: metal() });
        let scene = Scene {
            width,
            height,
            dome,
            floor: None,
            pitch_deg: 0.0,
            balls: measured.chain(reference).collect(),
            rods: rod.into_iter().collect(),
            patches: std::iter::once(card).chain(others).collect(),
            rays: self.rays,
        };
        self.camera.expose(&scene.render(), width)
    }

    pub fn card(&self) -> Card {
        Card::neutral(inside(self.card), 0.9)
    }

    pub fn request(&self) -> MatchRequest {
        let circle = self.cylinder.is_none().then_some(self.circle);
        MatchRequest { circle, cylinder: self.cylinder, cards: vec![self.card()], ..MatchRequest::default() }
    }

    pub fn solve(&self) -> Match {
        self.solve_as(&self.request())
    }

    pub fn solve_as(&self, request: &MatchRequest) -> Match {
        solve(&self.photo(), request, RgbSpace::LinRec709).unwrap()
    }

    pub fn truth(&self) -> Truth {
        Truth::of(metal_by_name(self.metal).unwrap())
    }

    pub fn codes(&self) -> Vec<WarningCode> {
        codes(&self.solve())
    }
}

/// An area well inside the edges of a rectangle.
pub fn inside([x, y, width, height]: [f64; 4]) -> Area {
    Area::rectangle(x + 4.0, y + 4.0, width - 8.0, height - 8.0)
}

pub fn codes(found: &Match) -> Vec<WarningCode> {
    found.warnings.iter().map(|warning| warning.code).collect()
}

pub fn largest_error(found: [Option<f64>; 3], truth: Rgb) -> f64 {
    (0..3).map(|i| (found[i].expect("measured") - truth[i]).abs()).fold(0.0, f64::max)
}

/// Channels in which value ± uncertainty contains the truth; a value that was not measured does not.
pub fn covered(found: [Option<f64>; 3], uncertainty: [Option<f64>; 3], truth: Rgb) -> usize {
    (0..3).filter(|&i| found[i].is_some_and(|value| (value - truth[i]).abs() <= uncertainty[i].unwrap())).count()
}
