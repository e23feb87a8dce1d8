//! Does the program open a real window that shows what it should?
//!
//! Runs the binary under a virtual X server and looks at the screen. Needs Xvfb and ImageMagick.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use edgewise::color::srgb8;
use edgewise::preset::Preset;
use image::RgbImage;

const SCREEN: (u32, u32) = (1280, 800);
/// Pixels that a swatch of the colour editors has at least: most of its 64 × 64.
const SWATCH_PIXELS: usize = 3000;
const PATIENCE: Duration = Duration::from_secs(60);

/// A process that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn start(command: &mut Command) -> Running {
    let program = command.get_program().to_string_lossy().into_owned();
    Running(command.spawn().unwrap_or_else(|error| panic!("{program} must be installed: {error}")))
}

/// A virtual X server and its display, e.g. `:3`.
fn virtual_screen() -> (Running, String) {
    let (width, height) = SCREEN;
    let mut server = start(
        Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", &format!("{width}x{height}x24")])
            .stdout(Stdio::piped())
            .stderr(Stdio::null()),
    );
    let mut number = String::new();
    BufReader::new(server.0.stdout.take().unwrap()).read_line(&mut number).unwrap();
    assert!(!number.trim().is_empty(), "Xvfb says which display it took");
    (server, format!(":{}", number.trim()))
}

fn screenshot(display: &str) -> RgbImage {
    let output = Command::new("import")
        .args(["-display", display, "-window", "root", "png:-"])
        .output()
        .expect("ImageMagick must be installed");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    image::load_from_memory(&output.stdout).unwrap().to_rgb8()
}

fn census(picture: &RgbImage) -> BTreeMap<[u8; 3], usize> {
    let mut counts = BTreeMap::new();
    picture.pixels().for_each(|pixel| *counts.entry(pixel.0).or_default() += 1);
    counts
}

/// What the screen lacks of a window on this preset; empty when all is there.
fn missing(picture: &RgbImage, preset: &Preset) -> Vec<&'static str> {
    let counts = census(picture);
    let has = |colour: [u8; 3], at_least: usize| counts.get(&colour).is_some_and(|count| *count >= at_least);
    let swatch = |rgb| srgb8(rgb, preset.space).0;
    let mut missing = Vec::new();
    if counts.len() < 1000 {
        missing.push("a picture with shades");
    }
    if !has(swatch(preset.r), SWATCH_PIXELS) {
        missing.push("the swatch of r");
    }
    if !has(swatch(preset.h), SWATCH_PIXELS) {
        missing.push("the swatch of h");
    }
    missing
}

/// Opens the preset in the real window and waits until all parts are on the screen.
fn open(preset_file: &Path, renderer: &str) {
    let (_server, display) = virtual_screen();
    let home = tempfile::tempdir().unwrap();
    let _window = start(
        Command::new(env!("CARGO_BIN_EXE_edgewise"))
            .args(["--renderer", renderer])
            .arg(preset_file)
            .env("DISPLAY", &display)
            .env("HOME", home.path())
            .env("XDG_RUNTIME_DIR", home.path())
            .env_remove("XDG_CONFIG_HOME")
            .env_remove("WAYLAND_DISPLAY")
            .stderr(Stdio::null()),
    );
    let preset = Preset::load(preset_file).unwrap().preset;
    let begin = Instant::now();
    loop {
        let picture = screenshot(&display);
        let missing = missing(&picture, &preset);
        if missing.is_empty() {
            return;
        }
        if begin.elapsed() > PATIENCE {
            let seen = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("real-window-{renderer}.png"));
            picture.save(&seen).unwrap();
            panic!("the window lacks {}; see {}", missing.join(", "), seen.display());
        }
        std::thread::sleep(Duration::from_millis(250));
    }
}

#[test]
fn gold_is_on_the_screen_with_every_renderer() {
    let gold = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/gold.json");
    assert!(fs::exists(&gold).unwrap());
    for renderer in ["auto", "glow", "wgpu"] {
        open(&gold, renderer);
    }
}

#[test]
fn without_a_display_it_says_so_in_one_sentence() {
    let output = Command::new(env!("CARGO_BIN_EXE_edgewise"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success());
    assert!(said.starts_with("edgewise: ") && said.contains("display") && said.lines().count() == 1, "{said}");
}
