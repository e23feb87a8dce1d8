//! Outlines in the photograph: cylinders, a ball beside a reference, and a look at a picture that is still being read.

use std::time::{Duration, Instant};

use edgewise::photo::{Circle, Cylinder, LightMode};
use edgewise::sample::Tent;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use image::codecs::jpeg::JpegEncoder;

use crate::drive::Window;
use crate::light_modes::{Shoot, assert_near};
use crate::studio::Studio;

const AXIS: Cylinder = Cylinder::new([20.0, 122.0], [240.0, 134.0], 104.0);

fn rod() -> Studio {
    Studio { cylinder: Some(AXIS), ..Studio::default() }
}

fn cylinder(shoot: &Shoot) -> Cylinder {
    shoot.marks().cylinder.expect("a cylinder is marked")
}

/// How far two cylinders are apart at the corners of the first, across its axis.
fn across(a: Cylinder, b: Cylinder) -> f64 {
    let off = |x: f64, y: f64| {
        let [right, down] = b.offset(x, y);
        (right.hypot(down) * b.radius - a.radius).abs()
    };
    a.corners().map(|[x, y]| off(x, y)).into_iter().fold(0.0, f64::max)
}

/// A photograph with its card marked, and the cylinder drawn over it.
fn drawn() -> Shoot {
    let mut shoot = Shoot::of(&rod());
    shoot.window.click("Mark: Card");
    shoot.draw_inside(rod().card);
    shoot.window.click("Mark: Cylinder");
    // Straight, though the cylinder leans a little: its edges turn it.
    shoot.drag([22.0, 27.0], [238.0, 230.0]);
    shoot
}

#[test]
fn a_cylinder_is_drawn_snaps_and_is_measured() {
    let mut shoot = drawn();
    assert!(across(cylinder(&shoot), AXIS) < 0.4, "{:?}", cylinder(&shoot));
    assert!(shoot.marks().circle_uncertainty_px.is_some_and(|uncertainty| uncertainty < 0.25));
    assert!(shoot.window.shows(" % of the edge"));
    assert_eq!(shoot.marks().mode, LightMode::Card);
    assert_near(&shoot.matched(), &rod(), 0.03);
    shoot.assert_reopens();
}

#[test]
fn a_cylinder_is_moved_turned_typed_and_undone_like_a_circle() {
    let mut shoot = drawn();
    let snapped = shoot.marks();
    shoot.window.press(Modifiers::NONE, Key::ArrowDown);
    let nudged = cylinder(&shoot);
    assert!((nudged.y0 - snapped.cylinder.unwrap().y0 - 1.0).abs() < 1e-9);
    assert_eq!(shoot.marks().circle_uncertainty_px, None, "by hand");
    shoot.window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(shoot.marks(), snapped);
    shoot.drag([130.0, 128.0], [130.0, 138.0]);
    assert!((cylinder(&shoot).y1 - snapped.cylinder.unwrap().y1 - 10.0).abs() < 1.5);
    let Cylinder { x1, y1, .. } = cylinder(&shoot);
    shoot.drag([x1, y1], [x1, y1 + 8.0]);
    assert!((cylinder(&shoot).y1 - y1 - 8.0).abs() < 1.5, "an end was dragged");
    shoot.window.enter("Cylinder radius, pixels", "99");
    shoot.window.enter("Cylinder end y, pixels", "140");
    assert_eq!((cylinder(&shoot).radius, cylinder(&shoot).y1), (99.0, 140.0));
    shoot.window.click("Snap to the edge: Cylinder");
    assert!(across(cylinder(&shoot), AXIS) < 0.4, "{:?}", cylinder(&shoot));
    shoot.window.click("Remove Cylinder");
    assert_eq!(shoot.marks().cylinder, None);
}

#[test]
fn a_ball_takes_the_place_of_a_cylinder() {
    let mut shoot = drawn();
    shoot.window.click("More marks");
    shoot.window.click("Mark: Ball");
    assert_eq!(shoot.marks().cylinder, None);
    assert!(shoot.marks().circle.is_some());
}

/// The reference is the larger ball, and would be found first.
#[test]
fn the_ball_is_found_beside_the_reference() {
    let reference = Circle::new(340.0, 128.0, 112.0);
    let studio = Studio {
        circle: Circle::new(104.0, 130.0, 84.0),
        tent: Tent { top: 0.2, ..Tent::default() },
        size: [470, 256],
        card: [4.0, 2.0, 24.0, 24.0],
        reference: Some((reference, "chromium")),
        ..Studio::default()
    };
    let mut shoot = Shoot::of(&studio);
    shoot.choose(LightMode::ReferenceBall);
    shoot.draw_roughly("Mark: Reference ball", reference);
    shoot.window.click("Find the ball");
    let Circle { x, radius, .. } = shoot.marks().circle.expect("found");
    assert!((x - studio.circle.x).abs() < 1.0 && (radius - studio.circle.radius).abs() < 1.0, "{x} {radius}");
    assert!((shoot.marks().reference_ball.unwrap().circle.radius - reference.radius).abs() < 1.0);
}

#[test]
fn a_ball_that_is_not_there_is_said() {
    let reference = Circle::new(130.0, 128.0, 110.0);
    let mut shoot = Shoot::of(&Studio { card: [2.0, 2.0, 6.0, 6.0], ..Studio::default() });
    shoot.choose(LightMode::ReferenceBall);
    shoot.draw_roughly("Mark: Reference ball", reference);
    shoot.window.click("Find the ball");
    assert_eq!(shoot.marks().circle, None);
    assert!(shoot.window.shows("No ball was found in the picture"));
}

#[test]
fn a_large_photograph_is_seen_while_it_is_read() {
    const SIZE: [u32; 2] = [2800, 2000];
    const PATIENCE: Duration = Duration::from_secs(300);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.jpg");
    let bytes: Vec<u8> = (0..SIZE[0] * SIZE[1]).flat_map(|index| [(index % SIZE[0] / 11) as u8; 3]).collect();
    let mut file = Vec::new();
    let encoder = JpegEncoder::new_with_quality(&mut file, 90);
    image::ImageEncoder::write_image(encoder, &bytes, SIZE[0], SIZE[1], image::ExtendedColorType::Rgb8).unwrap();
    std::fs::write(&path, file).unwrap();
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::P);
    window.harness.get_by_label("Path of a photograph").click();
    window.settle();
    window.type_text(path.to_str().unwrap());
    window.harness.key_press(Key::Enter);
    let (start, mut was_seen) = (Instant::now(), false);
    while !was_seen && window.harness.state().state().marks().is_none() {
        assert!(start.elapsed() < PATIENCE);
        window.harness.step();
        was_seen = window.shows("First look at large.jpg, still reading");
    }
    assert!(was_seen, "before the photograph is there");
    assert!(window.harness.state().state().marks().is_none(), "nothing can be marked in a first look");
    window.settle();
    assert!(!window.shows("still reading") && window.shows("2800 × 2000"), "then it takes its place");
    assert!(window.harness.state().state().marks().is_some());
}
