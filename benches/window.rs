//! What a frame costs on the processor while a colour is dragged: our panels, curves and preview pixels,
//! and egui's layout of them, without a display. The bar is 8 ms on a 2-core machine without a GPU.
//!
//! The first line says what the longest frame is while a photograph of 24 megapixels opens: 16 ms would be noticed.

#![expect(clippy::print_stdout, reason = "the longest frame is what it is run for")]

use std::path::Path;
use std::time::{Duration, Instant};

use divan::Bencher;
use edgewise::gui::App;
use eframe::egui::{Key, Modifiers, accesskit::Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

fn main() {
    println!("longest frame while 24 megapixels open: {:.1?}", longest_frame_while_opening());
    divan::main();
}

fn longest_frame_while_opening() -> Duration {
    let folder = tempfile::tempdir().expect("a folder to write in");
    let path = folder.path().join("photo.jpg");
    write_jpeg(&path, 6000, 4000);
    let mut harness = window_on(&path);
    let mut longest = Duration::ZERO;
    while harness.state().is_busy() {
        let start = Instant::now();
        harness.step();
        longest = longest.max(start.elapsed());
        std::thread::sleep(Duration::from_millis(2));
    }
    longest
}

/// Noise at several scales compresses as a photograph does.
fn write_jpeg(path: &Path, width: u16, height: u16) {
    let hash =
        |x: u32, y: u32| (x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77)).wrapping_mul(0xC2B2_AE3D) >> 24;
    let value = |x: u32, y: u32| (hash(x / 64, y / 64) / 2 + hash(x / 8, y / 8) / 4 + hash(x, y) / 16) as u8;
    let (columns, rows) = (u32::from(width), u32::from(height));
    let pixels: Vec<u8> = (0..rows).flat_map(|y| (0..columns).flat_map(move |x| [value(x, y); 3])).collect();
    let encoder = jpeg_encoder::Encoder::new_file(path, 93).expect("a folder to write in");
    encoder.encode(&pixels, width, height, jpeg_encoder::ColorType::Rgb).expect("a picture");
}

fn window() -> Harness<'static, App> {
    let mut harness = window_on(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/presets/gold.json")));
    settle(&mut harness);
    harness
}

fn window_on(path: &Path) -> Harness<'static, App> {
    let builder = Harness::builder().with_size([1280.0, 800.0]).with_max_steps(60);
    builder.build_eframe(|cc| App::new(&cc.egui_ctx, Some(path.to_owned())))
}

fn settle(harness: &mut Harness<'static, App>) {
    harness.step();
    while harness.state().is_busy() {
        std::thread::sleep(Duration::from_millis(2));
        harness.step();
    }
}

/// Nothing changes: what egui and the panels cost at rest.
#[divan::bench]
fn frame_at_rest(bencher: Bencher) {
    let mut harness = window();
    bencher.bench_local(|| harness.step());
}

/// The hand moves a slider of h on every frame: curves, strips and previews follow.
#[divan::bench]
fn frame_while_dragging_h(bencher: Bencher) {
    let mut harness = window();
    let slider = harness.get_by_role_and_label(Role::Slider, "h red, sRGB-encoded Linear sRGB (Rec.709) slider").rect();
    let at = |fraction: f32| slider.left_center() + vec2(slider.width() * fraction, 0.0);
    harness.drag_at(at(0.9));
    harness.step();
    let mut frame = 0_u16;
    bencher.bench_local(|| {
        frame += 1;
        harness.hover_at(at(0.3 + 0.6 * f32::from(frame % 97) / 97.0));
        harness.step();
    });
}

/// A window on a demonstration whose studies are done.
fn demonstration(name: &str) -> Harness<'static, App> {
    let mut harness = window();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num3);
    harness.step();
    harness.get_by_label_contains(name).click();
    settle(&mut harness);
    harness
}

/// The hand moves the slider between two materials: every description is read anew.
#[divan::bench]
fn frame_while_dragging_a_blend(bencher: Bencher) {
    let mut harness = demonstration("Blending: ");
    let sliders = harness.get_all_by_role(Role::Slider).map(|slider| slider.rect());
    let slider = sliders.max_by(|a, b| a.width().total_cmp(&b.width())).expect("the slider between the materials");
    drag(bencher, &mut harness, slider);
}

/// The hand moves a cross of the preset over the square.
#[divan::bench]
fn frame_while_dragging_a_cross(bencher: Bencher) {
    let mut harness = demonstration("Feasibility: ");
    let cross = harness.get_by_label_contains("Cross of blue").rect();
    drag(bencher, &mut harness, cross);
}

/// A window on the page of plans, with every metal of the library in the list.
fn planner() -> Harness<'static, App> {
    let mut harness = window();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num4);
    harness.step();
    harness.get_by_label("Add all metals").click();
    settle(&mut harness);
    harness
}

/// Nothing changes on the page of plans.
#[divan::bench]
fn frame_of_a_plan_at_rest(bencher: Bencher) {
    let mut harness = planner();
    bencher.bench_local(|| harness.step());
}

/// The hand moves the tolerance: every frame asks for another plan.
#[divan::bench]
fn frame_while_dragging_a_tolerance(bencher: Bencher) {
    let mut harness = planner();
    let slider = harness.get_by_role_and_label(Role::Slider, "Tolerance").rect();
    drag(bencher, &mut harness, slider);
}

/// Nothing changes on the chart of cost against accuracy.
#[divan::bench]
fn frame_of_a_trade_chart_at_rest(bencher: Bencher) {
    let mut harness = planner();
    harness.get_by_label("Trade").click();
    settle(&mut harness);
    bencher.bench_local(|| harness.step());
}

/// Drags back and forth from the middle of a place.
fn drag(bencher: Bencher, harness: &mut Harness<'static, App>, place: eframe::egui::Rect) {
    harness.drag_at(place.center());
    harness.step();
    let mut frame = 0_u16;
    bencher.bench_local(|| {
        frame += 1;
        harness.hover_at(place.center() - vec2(f32::from(frame % 97), f32::from(frame % 31)));
        harness.step();
    });
}
