//! The scenes of the built-in photographs. Their files are this module's output, byte for byte.

use thiserror::Error;

use super::camera::{Camera, camera_jpeg, linear_png};
use super::library::{SampleFacts, Truth};
use super::scene::{Ball, Patch, Scene};
use super::surroundings::{Dome, Floor, Panorama, PanoramaError, Tent, Vec3};
use crate::metal::{Metal, ReflectanceTable, UnknownMetal, metal_by_name};
use crate::photo::{Area, Card, Circle, MatchRequest};

/// Why a sample could not be rendered.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "each variant is its source's message")]
pub enum SampleError {
    #[error(transparent)]
    Metal(#[from] UnknownMetal),
    #[error(transparent)]
    Environment(#[from] PanoramaError),
    #[error(transparent)]
    Png(#[from] png::EncodingError),
    #[error(transparent)]
    Jpeg(#[from] image::ImageError),
    #[error(transparent)]
    Sidecar(#[from] serde_json::Error),
}

/// A rendered sample: its picture and its sidecar.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// What the sidecar says.
    pub facts: SampleFacts,
    /// The picture file.
    pub picture: Vec<u8>,
}

impl Rendered {
    /// The files to write: the picture and its sidecar.
    pub fn files(&self) -> Result<[(String, Vec<u8>); 2], SampleError> {
        let stem = self.facts.file.split('.').next().unwrap_or_default();
        let mut json = serde_json::to_vec_pretty(&self.facts)?;
        json.push(b'\n');
        Ok([(self.facts.file.clone(), self.picture.clone()), (format!("{stem}.json"), json)])
    }
}

/// Renders every built-in photograph again.
pub fn render_all() -> Result<Vec<Rendered>, SampleError> {
    Ok(vec![gold_in_a_tent()?, chromium_in_a_room()?, copper_by_camera()?])
}

const WIDTH: u32 = 512;
const HEIGHT: u32 = 384;
/// A pixel one code apart is a photograph's own grain at this depth.
const SENSOR_BITS: u32 = 10;
const WHITE_CARD: f64 = 0.9;
const TENT: &str = "An analytic light tent";

fn gold_in_a_tent() -> Result<Rendered, SampleError> {
    let metal = metal_by_name("gold")?;
    let circle = Circle::new(206.0, 204.0, 132.0);
    let card = [388.0, 178.0, 84.0, 112.0];
    let tent = Tent { top: 0.05, right: -0.02, lens_deg: 5.0, ..Tent::default() };
    let set = Set { metal, circle, dome: Dome::Tent(tent), floor_albedo: 0.985, floor_ends_at: 7.0, shadow: 0.14 };
    let scene = set.scene(vec![(card, WHITE_CARD)]);
    let camera = Camera { exposure: 0.66, blur_px: 0.6, noise: 0.0006, seed: 79 };
    let facts = SampleFacts {
        title: "Gold ball in a light tent".to_owned(),
        description: "Even light and a white card: the picture to learn on.".to_owned(),
        order: 1,
        file: "gold_tent.png".to_owned(),
        environment: TENT.to_owned(),
        environment_licence: String::new(),
        request: request(circle, vec![(card, WHITE_CARD)]),
        ..set.facts()
    };
    Ok(Rendered { picture: linear_png(&camera.expose(&scene.render(), WIDTH), WIDTH, SENSOR_BITS)?, facts })
}

fn chromium_in_a_room() -> Result<Rendered, SampleError> {
    let metal = metal_by_name("chromium")?;
    let circle = Circle::new(222.0, 200.0, 128.0);
    let card = [402.0, 196.0, 72.0, 96.0];
    let room = Panorama::from_hdr(include_bytes!("../../assets/environments/apartment.hdr"), 4.0, 60.0)?;
    let set = Set { metal, circle, dome: Dome::Panorama(room), floor_albedo: 0.45, floor_ends_at: 5.0, shadow: 0.92 };
    let scene = set.scene(vec![(card, WHITE_CARD)]);
    let camera = Camera { exposure: 0.28, blur_px: 0.6, noise: 0.0015, seed: 24 };
    let facts = SampleFacts {
        title: "Chromium ball in a room".to_owned(),
        description: "Windows on one side: uneven surroundings, and what warns of them.".to_owned(),
        order: 2,
        file: "chromium_room.png".to_owned(),
        environment: "Apartment, a panorama of Poly Haven".to_owned(),
        environment_licence: "CC0-1.0".to_owned(),
        request: request(circle, vec![(card, WHITE_CARD)]),
        ..set.facts()
    };
    Ok(Rendered { picture: linear_png(&camera.expose(&scene.render(), WIDTH), WIDTH, SENSOR_BITS)?, facts })
}

fn copper_by_camera() -> Result<Rendered, SampleError> {
    let metal = metal_by_name("copper")?;
    let circle = Circle::new(252.0, 232.0, 150.0);
    let tent = Tent { top: 0.1, right: 0.04, lens_deg: 4.0, lamp: 0.5, ..Tent::default() };
    let set = Set { metal, circle, dome: Dome::Tent(tent), floor_albedo: 0.97, floor_ends_at: 7.0, shadow: 0.14 };
    let step = |index: usize| [490.0, 70.0 + 57.0 * index as f64, 84.0, 48.0];
    let neutrals: Vec<_> = Card::COLOR_CHECKER_NEUTRALS.into_iter().enumerate().map(|(i, y)| (step(i), y)).collect();
    let scene = Scene { width: 640, height: 480, ..set.scene(neutrals.clone()) };
    let camera = Camera { exposure: 0.5, blur_px: 0.7, noise: 0.006, seed: 29 };
    let facts = SampleFacts {
        title: "Copper ball as a camera JPEG".to_owned(),
        description: "A tone curve bends every value; the grey scale beside the ball undoes it.".to_owned(),
        order: 3,
        file: "copper_camera.jpg".to_owned(),
        environment: TENT.to_owned(),
        environment_licence: String::new(),
        request: request(circle, neutrals[..1].to_vec()),
        greys: request(circle, neutrals).cards,
        ..set.facts()
    };
    Ok(Rendered { picture: camera_jpeg(&camera.expose(&scene.render(), 640), 640, 90)?, facts })
}

/// A ball on a floor under a dome.
struct Set {
    metal: &'static Metal,
    circle: Circle,
    dome: Dome,
    floor_albedo: f64,
    floor_ends_at: f64,
    /// How dark the floor is where the ball stands; a tent's floor glows.
    shadow: f64,
}

impl Set {
    /// The scene with matt cards: each sends back its share of the light that falls towards the camera.
    fn scene(&self, cards: Vec<([f64; 4], f64)>) -> Scene {
        let ball =
            Ball { circle: self.circle, metal: ReflectanceTable::of(self.metal), camera_distance: f64::INFINITY };
        let floor_white = self.dome.white_radiance(&Vec3::y());
        let card_white = self.dome.white_radiance(&Vec3::z());
        let bounce = floor_white * ball.metal.at(0.7) * 0.8;
        let floor = Floor {
            radiance: floor_white * self.floor_albedo,
            ends_at: self.floor_ends_at,
            shadow: self.shadow,
            bounce,
        };
        let patch = |(bounds, reflectance): ([f64; 4], f64)| Patch {
            bounds,
            radiance: card_white * reflectance,
            corner: 3.0,
            shadow: (0.16, 9.0),
        };
        Scene {
            width: WIDTH,
            height: HEIGHT,
            dome: self.dome.clone(),
            floor: Some(floor),
            pitch_deg: 9.0,
            balls: vec![ball],
            rods: Vec::new(),
            patches: cards.into_iter().map(patch).collect(),
            rays: 4,
        }
    }

    /// What is the same in every sidecar; the rest is filled in by the scene.
    fn facts(&self) -> SampleFacts {
        SampleFacts {
            title: String::new(),
            description: String::new(),
            order: 0,
            file: String::new(),
            rendered: true,
            metal: self.metal.id.clone(),
            environment: String::new(),
            environment_licence: String::new(),
            request: MatchRequest::default(),
            greys: Vec::new(),
            truth: Truth::of(self.metal),
        }
    }
}

/// What a person would mark: the ball, and cards well inside their edges.
fn request(circle: Circle, cards: Vec<([f64; 4], f64)>) -> MatchRequest {
    const MARGIN: f64 = 8.0;
    let inside = |[x, y, w, h]: [f64; 4]| Area::rectangle(x + MARGIN, y + MARGIN, w - 2.0 * MARGIN, h - 2.0 * MARGIN);
    let cards = cards.into_iter().map(|(bounds, reflectance)| Card::neutral(inside(bounds), reflectance)).collect();
    MatchRequest { circle: Some(circle), cards, ..MatchRequest::default() }
}
