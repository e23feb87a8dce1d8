//! Every way to know the light, from a photograph to r and h, in the window.

use std::fs;
use std::ops::ControlFlow;
use std::path::PathBuf;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::fresnel::CosTheta;
use edgewise::metal::metal_by_name;
use edgewise::photo::{Card, Circle, LightMode, Match, MatchRequest, Photo, solve};
use edgewise::preset::{Origin, Preset};
use edgewise::sample::{Camera, Tent};
use eframe::egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use tempfile::TempDir;

use crate::drive::Window;
use crate::studio::{Stored, Studio, largest_error};

/// A photograph on disk, open on its page.
pub struct Shoot {
    pub window: Window,
    photo: Photo,
    path: PathBuf,
    folder: TempDir,
}

impl Shoot {
    pub fn of(studio: &Studio) -> Self {
        Self::with(Window::open(None), studio)
    }

    pub fn with(mut window: Window, studio: &Studio) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let name = if matches!(studio.stored, Stored::Jpeg) { "studio.jpg" } else { "studio.png" };
        let path = folder.path().join(name);
        // One ray for each quarter of a pixel is enough here, and the tests are many.
        fs::write(&path, Studio { rays: 2, ..studio.clone() }.file()).unwrap();
        let photo = Photo::open(&path, &mut |_| ControlFlow::Continue(())).unwrap();
        window.press(Modifiers::COMMAND, Key::P);
        window.enter("Path of a photograph", path.to_str().unwrap());
        assert_eq!(window.notices(), [""; 0]);
        Self { window, photo, path, folder }
    }

    pub fn marks(&self) -> MatchRequest {
        self.window.harness.state().state().marks().expect("a photograph is open").clone()
    }

    pub fn choose(&mut self, mode: LightMode) {
        self.window.click(&format!("Mode {}: {}", mode.letter(), mode.label().to_lowercase()));
        assert_eq!(self.marks().mode, mode);
    }

    /// Where a pixel is on the screen: the view shows the whole photograph, centred.
    pub fn on_screen(&self, [x, y]: [f64; 2]) -> Pos2 {
        let view = self.window.harness.get_by_label(&format!("Photograph {}", self.photo.name)).rect();
        let (width, height) = (self.photo.width as f32, self.photo.height as f32);
        let scale = (view.width() / width).min(view.height() / height);
        view.center() + vec2(x as f32 - width / 2.0, y as f32 - height / 2.0) * scale
    }

    pub fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        let [from, to] = [from, to].map(|point| self.on_screen(point));
        self.window.drag(from, to);
    }

    /// Draws a rectangle well inside `bounds`.
    pub fn draw_inside(&mut self, [x, y, width, height]: [f64; 4]) {
        self.drag([x + 5.0, y + 5.0], [x + width - 5.0, y + height - 5.0]);
    }

    /// Draws a circle roughly: a few pixels off, as a hand is.
    pub fn draw_roughly(&mut self, name: &str, circle: Circle) {
        self.window.click(name);
        let Circle { x, y, radius } = circle;
        self.drag([x - radius + 4.0, y - 3.0], [x + radius + 2.0, y + 2.0]);
    }

    /// The match of the library from the marks of the window; the preset must hold exactly its numbers.
    pub fn matched(&self) -> Match {
        let found = solve(&self.photo, &self.marks(), RgbSpace::LinRec709).unwrap();
        let preset = self.window.preset();
        for (in_preset, in_library) in [(preset.r, found.complete_r()), (preset.h, found.complete_h())] {
            if let Some(colour) = in_library {
                assert_eq!(in_preset, colour);
            }
        }
        let Origin::Matched(recipe) = &preset.origin else { panic!("not matched: {:?}", preset.origin) };
        assert_eq!(**recipe, found.recipe(&self.photo));
        found
    }

    /// Saves the preset, opens it in another window with its photograph, and finds the same numbers.
    pub fn assert_reopens(&mut self) {
        let path = self.folder.path().join("matched.json");
        self.window.command("Save to path");
        self.window.answer_path(&path);
        let saved = Preset::load(&path).unwrap().preset;
        let mut reopened = Window::open(Some(path));
        reopened.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
        reopened.answer_path(&self.path);
        assert_eq!(reopened.harness.state().state().marks(), Some(&self.marks()));
        assert_eq!(*reopened.preset(), saved);
        assert!(reopened.shows("no changes"), "solving again changes nothing");
    }
}

/// Both within `limit` of the truth, in each channel.
pub fn assert_near(found: &Match, studio: &Studio, limit: f64) {
    let truth = studio.truth();
    let (r, h) = (largest_error(found.r, truth.r), largest_error(found.h, truth.h));
    assert!(r < limit && h < limit, "r off by {r:.4}, h by {h:.4}");
}

#[test]
fn a_flat_mirror_beside_its_card() {
    let cards = [[4.0, 4.0, 60.0, 60.0], [70.0, 4.0, 60.0, 60.0], [136.0, 4.0, 60.0, 60.0], [202.0, 4.0, 60.0, 60.0]];
    let metal = metal_by_name("gold").unwrap();
    let at = |angle_deg: f64| metal.reflectance(CosTheta::from_deg(angle_deg), RgbSpace::LinRec709) * 0.9;
    let radiances = [Rgb::splat(0.9), at(82.0), Rgb::splat(0.9), at(12.0)];
    let tent = Tent { tint: Rgb([1.0, 0.8, 0.5]), ..Tent::default() };
    let patches = cards.into_iter().zip(radiances).collect();
    let studio = Studio { metal: "gold", tent, patches, ..Studio::default() };
    let mut shoot = Shoot::of(&studio);
    shoot.choose(LightMode::FlatMirror);
    assert!(shoot.window.shows("Still needs"));
    // The card first, then the same card in the mirror: one drag follows the other.
    for pair in [&cards[..2], &cards[2..]] {
        shoot.window.click("Mark: Mirror pair");
        shoot.draw_inside(pair[0]);
        shoot.draw_inside(pair[1]);
    }
    shoot.window.enter("Direct card 1 angle of incidence, degrees", "82");
    shoot.window.enter("Direct card 2 angle of incidence, degrees", "12");
    assert_eq!(shoot.marks().mirrors.iter().map(|pair| pair.angle_deg).collect::<Vec<_>>(), [82.0, 12.0]);
    assert_near(&shoot.matched(), &studio, 0.02);
    shoot.assert_reopens();
}

#[test]
fn a_reference_ball_in_uneven_light() {
    let reference = Circle::new(380.0, 128.0, 104.0);
    let studio = Studio {
        metal: "copper",
        tent: Tent { top: 0.35, right: 0.25, ..Tent::default() },
        size: [500, 256],
        card: [236.0, 2.0, 36.0, 36.0],
        reference: Some((reference, "nickel")),
        // Copper's red must not clip where the light is brightest.
        camera: Camera { exposure: 0.5, ..Studio::default().camera },
        ..Studio::default()
    };
    let mut shoot = Shoot::of(&studio);
    shoot.choose(LightMode::ReferenceBall);
    shoot.draw_roughly("Mark: Ball", studio.circle);
    shoot.draw_roughly("Mark: Reference ball", reference);
    shoot.window.harness.get_by_label_contains("Metal of the reference ball: Chromium").click();
    shoot.window.settle();
    shoot.window.type_text("nickel");
    shoot.window.press(Modifiers::NONE, Key::Enter);
    let metal = metal_by_name("nickel").unwrap();
    assert_eq!(shoot.marks().reference_ball.unwrap().metal, metal.id);
    assert!(shoot.window.shows("Metal of the reference ball: Nickel, "), "and whose data");
    assert_near(&shoot.matched(), &studio, 0.04);
    shoot.assert_reopens();
}

#[test]
fn a_ball_that_snaps_and_cards_of_several_kinds() {
    let grey = [258.0, 4.0, 40.0, 60.0];
    let studio = Studio { patches: vec![(grey, Rgb::splat(0.18))], ..Studio::default() };
    let mut shoot = Shoot::of(&studio);
    assert!(shoot.window.shows("Still needs"));
    shoot.draw_roughly("Mark: Ball", studio.circle);
    let Circle { x, y, radius } = shoot.marks().circle.unwrap();
    let off = (x - studio.circle.x).hypot(y - studio.circle.y).max((radius - studio.circle.radius).abs());
    assert!(off < 0.15, "snapped: {x} {y} {radius}");
    assert!(shoot.marks().circle_uncertainty_px.is_some_and(|uncertainty| uncertainty < 0.2));
    assert!(shoot.window.shows(" % of the edge"));
    shoot.window.click("Mark: Card");
    shoot.draw_inside(studio.card);
    shoot.window.click("Mark: Card");
    shoot.draw_inside(grey);
    shoot.window.click("Card 2 is");
    shoot.window.click("Grey card, 18 %");
    assert_eq!(shoot.marks().cards.iter().map(|card| card.reflectance).collect::<Vec<_>>(), [0.9, 0.18]);
    assert_near(&shoot.matched(), &studio, 0.02);
    shoot.assert_reopens();
}

/// A red card that is said to be white makes the metal look cyan; its measured reflectance puts that right.
#[test]
fn a_measured_region_is_a_white_reference() {
    let colour = Rgb([0.6, 0.3, 0.15]);
    let region = [258.0, 4.0, 40.0, 60.0];
    let studio = Studio { patches: vec![(region, colour)], ..Studio::default() };
    let mut shoot = Shoot::of(&studio);
    shoot.draw_roughly("Mark: Ball", studio.circle);
    shoot.window.click("Mark: Card");
    shoot.draw_inside(region);
    let wrong = shoot.matched();
    assert!(largest_error(wrong.r, studio.truth().r) > 0.2);
    shoot.window.click("Card is");
    shoot.window.click("Measured region");
    for (channel, value) in [("red", "0.6"), ("green", "0.3"), ("blue", "0.15")] {
        shoot.window.enter(&format!("Card {channel} reflectance, linear Rec.709"), value);
    }
    assert_eq!(shoot.marks().cards[0].colour, Some(colour));
    assert_near(&shoot.matched(), &studio, 0.02);
    shoot.assert_reopens();
}

#[test]
fn a_backdrop_gives_h_and_leaves_r_alone() {
    let studio = Studio::default();
    let mut shoot = Shoot::of(&studio);
    let r = shoot.window.preset().r;
    shoot.choose(LightMode::Backdrop);
    shoot.draw_roughly("Mark: Ball", studio.circle);
    shoot.window.click("Mark: Backdrop");
    shoot.draw_inside([244.0, 4.0, 60.0, 60.0]);
    let found = shoot.matched();
    assert!(largest_error(found.h, studio.truth().h) < 0.05, "{:?}", found.h);
    assert_eq!(shoot.window.preset().r, r);
    shoot.assert_reopens();
}

#[test]
fn a_large_ball_gives_its_own_light() {
    let studio = Studio {
        circle: Circle::new(430.0, 430.0, 420.0),
        size: [860, 860],
        camera: Camera { exposure: 0.37, blur_px: 0.3, noise: 0.01, seed: 5 },
        card: [2.0, 2.0, 20.0, 20.0],
        rays: 1,
        ..Studio::default()
    };
    let mut shoot = Shoot::of(&studio);
    shoot.choose(LightMode::SolvedLight);
    shoot.window.click("Find the ball");
    assert!((shoot.marks().circle.unwrap().radius - 420.0).abs() < 0.1, "{:?}", shoot.marks().circle);
    assert_near(&shoot.matched(), &studio, 0.03);
    shoot.assert_reopens();
}

#[test]
fn a_light_set_by_eye_is_an_estimate() {
    let studio = Studio::default();
    let mut shoot = Shoot::of(&studio);
    shoot.choose(LightMode::ByEye);
    shoot.draw_roughly("Mark: Ball", studio.circle);
    shoot.window.click("Mark: Light");
    assert_eq!(shoot.marks().light, Some(Rgb::WHITE));
    for channel in ["red", "green", "blue"] {
        shoot.window.enter(&format!("Light {channel}, linear Rec.709"), "0.7");
    }
    assert_near(&shoot.matched(), &studio, 0.02);
    assert!(shoot.window.shows("An estimate"));
    // One stop more light halves what the metal reflects.
    let before = shoot.window.preset().r;
    shoot.window.enter("Light level, stops over 1", &(1.4_f64.log2()).to_string());
    assert!((shoot.window.preset().r[1] / before[1] - 0.5).abs() < 0.02);
    shoot.assert_reopens();
}

#[test]
fn a_grey_scale_undoes_a_camera() {
    let step = |i: usize| [258.0, 2.0 + 42.0 * i as f64, 48.0, 40.0];
    let neutrals = Card::COLOR_CHECKER_NEUTRALS.into_iter().enumerate();
    let studio = Studio {
        metal: "copper",
        patches: neutrals.map(|(i, y)| (step(i), Rgb::splat(y))).collect(),
        stored: Stored::Jpeg,
        ..Studio::default()
    };
    let mut shoot = Shoot::of(&studio);
    shoot.draw_roughly("Mark: Ball", studio.circle);
    shoot.window.click("Mark: Card");
    shoot.draw_inside(step(0));
    assert!(shoot.window.shows("An estimate"));
    shoot.window.click("Mark: Grey scale");
    // From the brightest patch down to the darkest, outside all edges.
    shoot.drag([258.0, 1.0], [306.0, 253.0]);
    assert!(shoot.window.shows("Measured"));
    assert_near(&shoot.matched(), &studio, 0.05);
    // A corner that is dragged lays the row out again, and a reflectance that is typed stays.
    let before = shoot.marks().greys;
    shoot.window.enter("Grey patch 6 reflectance, percent", "3.3");
    shoot.drag([306.0, 253.0], [304.0, 250.0]);
    let after = shoot.marks().greys;
    assert_ne!(before[5].area, after[5].area);
    assert_eq!(after[5].reflectance, 0.033);
    shoot.matched();
    shoot.assert_reopens();
    shoot.window.click("Turn the grey scale round");
    assert!(shoot.window.shows("make no tone curve"), "a row that grows darker the other way is refused");
}

#[test]
fn the_best_mode_is_suggested_and_a_person_may_choose_another() {
    let studio = Studio::default();
    let mut shoot = Shoot::of(&studio);
    shoot.draw_roughly("Mark: Ball", studio.circle);
    assert_eq!(shoot.marks().mode, LightMode::Card, "a card may still come");
    assert!(shoot.window.shows("Take the suggested mode E"), "what a ball alone allows is suggested");
    shoot.window.click("Mark: Card");
    shoot.draw_inside(studio.card);
    shoot.choose(LightMode::Backdrop);
    assert!(shoot.window.shows("Still needs"));
    shoot.window.click("Mark: Backdrop");
    shoot.draw_inside([244.0, 4.0, 60.0, 60.0]);
    assert_eq!(shoot.marks().mode, LightMode::Backdrop, "what a person chose stays");
    shoot.window.click("Take the suggested mode C");
    assert_eq!(shoot.marks().mode, LightMode::Card);
    assert_near(&shoot.matched(), &studio, 0.02);
}

#[test]
fn new_marks_are_nudged_and_escape_takes_back_their_drags() {
    let studio = Studio::default();
    let mut shoot = Shoot::of(&studio);
    shoot.choose(LightMode::FlatMirror);
    shoot.window.click("Mark: Mirror pair");
    shoot.draw_inside([10.0, 10.0, 60.0, 60.0]);
    shoot.draw_inside([100.0, 10.0, 60.0, 60.0]);
    let before = shoot.marks().mirrors[0].mirrored.bounds();
    shoot.window.press(Modifiers::NONE, Key::ArrowRight);
    shoot.window.press(Modifiers::SHIFT, Key::ArrowDown);
    let after = shoot.marks().mirrors[0].mirrored.bounds();
    assert!((after[0] - before[0] - 1.0).abs() < 1e-9 && (after[1] - before[1] - 10.0).abs() < 1e-9);
    shoot.choose(LightMode::Card);
    shoot.window.click("Mark: Grey scale");
    let placed = shoot.marks();
    let [from, to] = [[20.0, 200.0], [200.0, 240.0]].map(|point| shoot.on_screen(point));
    shoot.window.harness.drag_at(from);
    shoot.window.harness.run();
    shoot.window.harness.hover_at(to);
    shoot.window.harness.run();
    assert_ne!(shoot.marks(), placed);
    shoot.window.press(Modifiers::NONE, Key::Escape);
    shoot.window.harness.drop_at(to);
    shoot.window.settle();
    assert_eq!(shoot.marks(), placed);
    shoot.window.click("Select Grey scale");
    shoot.drag([60.0, 217.0], [62.0, 217.0]);
    let corners = shoot.marks().grey_corners.unwrap();
    shoot.window.press(Modifiers::NONE, Key::ArrowUp);
    for (after, before) in shoot.marks().grey_corners.unwrap().into_iter().zip(corners) {
        assert!((after[0] - before[0]).abs() < 1e-9 && (after[1] - before[1] + 1.0).abs() < 1e-9);
    }
}
