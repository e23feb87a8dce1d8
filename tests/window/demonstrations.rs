//! The page of demonstrations.

use std::fs;
use std::path::{Path, PathBuf};

use edgewise::color::{Rgb, RgbSpace};
use edgewise::figure::{BlendFigure, ConversionFigure, Figure, FigureTheme, UniformityFigure};
use edgewise::fit::Method;
use edgewise::fresnel::h_of_schlick;
use edgewise::metal::{metal_by_name, preferred_metals};
use edgewise::preset::{Origin, Preset};
use edgewise::study::{
    Contestants, ConversionOptions, DecouplingOptions, Reach, Slider, SliderSweep, Subject, blend_matrix,
    blend_pairs_summary, blending, conversion, conversions, conversions_summary, decoupling, feasibility_summary,
    metal_points, no_progress, quantisation, rows_to_csv, uniformity_summary,
};
use eframe::egui::{Key, Modifiers, Vec2, accesskit::Role, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::drive::Window;

const CONVERSION: &str = "Conversion: Do parameters convert like colours?";
const BLENDING: &str = "Blending: Can a painted mask be filtered?";
const QUANTISATION: &str = "Quantisation: Do eight bits suffice?";
const DECOUPLING: &str = "Decoupling: Does one slider leave the other alone?";
const UNIFORMITY: &str = "Uniformity: Do equal steps look equal?";
const FEASIBILITY: &str = "Feasibility: Which r and h are reflectances?";
const ALL: [&str; 6] = [CONVERSION, BLENDING, QUANTISATION, DECOUPLING, UNIFORMITY, FEASIBILITY];

fn open(path: Option<PathBuf>, demonstration: &str) -> Window {
    let mut window = Window::open(path);
    window.press(Modifiers::COMMAND, Key::Num3);
    window.click(demonstration);
    window
}

fn gold_preset() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/gold.json")
}

fn contestants(subject: &Subject) -> Contestants {
    Contestants::of(subject, RgbSpace::AcesCg, Method::ColourMatching).unwrap()
}

fn metal(name: &str) -> Contestants {
    contestants(&Subject::Metal(metal_by_name(name).unwrap()))
}

fn gold_converted() -> edgewise::study::ColourConversion {
    conversion(&Subject::Metal(metal_by_name("gold").unwrap()), &ConversionOptions::default()).unwrap()
}

fn sweeps(r: f64) -> Vec<SliderSweep> {
    let of_reach = |reach| Slider::ALL.map(|slider| SliderSweep::new(r, slider, reach, 20));
    [Reach::Reachable, Reach::Full].into_iter().flat_map(of_reach).flatten().collect()
}

/// The sentence of each demonstration in a new window, from the studies themselves.
fn sentences() -> [String; 6] {
    let glass = contestants(&Subject::Dielectric { n: 1.5 });
    let example = Subject::Colours {
        name: "Example colours",
        space: RgbSpace::AcesCg,
        r: Rgb([0.9, 0.7, 0.4]),
        h: Rgb([0.75, 0.65, 0.5]),
    };
    let metals: Vec<_> = preferred_metals().collect();
    [
        gold_converted().summary(),
        blending(&metal("gold"), &glass).summary(),
        quantisation(&metal("gold"), &metal("silver")).summary(),
        decoupling(&contestants(&example), &DecouplingOptions::default()).summary(),
        uniformity_summary(&sweeps(0.8), 0.8),
        feasibility_summary(&metal_points(&metals, RgbSpace::LinRec709)),
    ]
}

/// As it stands on the page: “n, k” does not break.
fn shown(sentence: &str) -> String {
    sentence.replace("n, k", "n,\u{a0}k")
}

#[test]
fn every_demonstration_says_what_its_study_measured() {
    let mut window = open(None, CONVERSION);
    for (name, sentence) in ALL.into_iter().zip(sentences()) {
        window.click(name);
        assert!(sentence.contains(char::is_numeric) && window.shows(&shown(&sentence)), "{name}: {sentence}");
        assert_eq!(window.notices(), [""; 0]);
    }
}

#[test]
fn all_metals_and_all_pairs_are_one_click_away() {
    let metals: Vec<_> = preferred_metals().collect();
    let options = ConversionOptions::default();
    let mut window = open(None, CONVERSION);
    window.click("All metals");
    let rows = conversions(&metals, &options, &no_progress).unwrap();
    assert!(window.shows(&shown(&conversions_summary(&rows, &options))));
    window.click(BLENDING);
    window.click("All pairs of metals");
    let rows = blend_matrix(&metals, RgbSpace::AcesCg, Method::ColourMatching, &no_progress).unwrap();
    assert!(window.shows(&shown(&blend_pairs_summary(&rows))));
}

#[test]
fn a_material_and_a_space_are_chosen_by_name() {
    let mut window = open(None, BLENDING);
    window.click("Material: Gold");
    window.type_text("copper");
    window.press(Modifiers::NONE, Key::Enter);
    window.click("Blended with: Dielectric, n = 1.5");
    window.type_text("zinc");
    window.press(Modifiers::NONE, Key::Enter);
    assert!(window.shows(&shown(&blending(&metal("copper"), &metal("zinc")).summary())));
    window.click("Space of the parameters");
    window.click(RgbSpace::LinDisplayP3.label());
    let metal = |name| {
        let subject = Subject::Metal(metal_by_name(name).unwrap());
        Contestants::of(&subject, RgbSpace::LinDisplayP3, Method::ColourMatching).unwrap()
    };
    assert!(window.shows(&shown(&blending(&metal("copper"), &metal("zinc")).summary())));
    // The choice is about every demonstration.
    window.click(CONVERSION);
    assert!(window.shows("Copper from"));
}

#[test]
fn a_dielectric_takes_its_index() {
    let mut window = open(None, BLENDING);
    window.enter("Refractive index of the dielectric", "2");
    let glass = contestants(&Subject::Dielectric { n: 2.0 });
    assert!(window.shows(&shown(&blending(&metal("gold"), &glass).summary())));
}

#[test]
fn a_persons_own_preset_is_what_it_is_about() {
    let window = open(Some(gold_preset()), CONVERSION);
    let Preset { name, space, r, h, .. } = window.preset();
    let subject = Subject::Colours { name, space: *space, r: *r, h: *h };
    let study = conversion(&subject, &ConversionOptions::default()).unwrap();
    assert!(window.shows(&shown(&study.summary())), "{}", study.summary());
}

#[test]
fn the_slider_between_two_materials_reads_every_description() {
    let mut window = open(None, BLENDING);
    let name = "Share of Dielectric, n = 1.5 in Gold";
    assert!(window.harness.query_by_role_and_label(Role::Slider, name).is_some());
    let off = |window: &Window| -> f64 {
        let rows = window.harness.query_all_by_label_contains("n, k: ");
        let mut labels = rows.filter_map(|node| node.accesskit_node().label());
        let row = labels.find(|label| label.contains("at the slider")).unwrap();
        row.rsplit(", ").next().unwrap().trim_end_matches(" at the slider").parse().unwrap()
    };
    let halfway = off(&window);
    window.drag_slider(name, 0.5, 0.99);
    let near_the_end = off(&window);
    // Facts of the study: with glass n, k are off by more than ten halfway, and exact at both ends.
    assert!(halfway > 10.0 && near_the_end < 0.3 * halfway, "{halfway} {near_the_end}");
}

#[test]
fn how_far_parameters_move_and_r_follow_their_sliders() {
    let mut window = open(None, DECOUPLING);
    let before = sentences()[3].clone();
    window.drag_slider("Moved by", 0.2, 0.9);
    assert!(!window.shows(&shown(&before)) && window.shows("Example colours: lowering r moves"));
    window.click(UNIFORMITY);
    window.enter("r of the grey metal, number", "0.3");
    assert!(window.shows(&uniformity_summary(&sweeps(0.3), 0.3)));
    assert!(window.shows("our slider moves h sRGB-encoded"));
}

fn drag_cross(window: &mut Window, channel: &str, by: Vec2) {
    let from = window.harness.get_by_label_contains(&format!("Cross of {channel}")).rect().center();
    window.drag(from, from + by);
}

#[test]
fn a_drag_of_the_cross_edits_the_preset_in_one_step() {
    let mut window = open(None, FEASIBILITY);
    let before = window.preset().clone();
    drag_cross(&mut window, "blue", vec2(-60.0, 40.0));
    let after = window.preset().clone();
    assert!(after.r[0] < before.r[0] - 0.05 && after.h[0] < before.h[0] - 0.03, "{after:?}");
    assert_eq!((after.r[0], after.h[0]), (after.r[1], after.h[1]), "a grey stays grey");
    let slope = (after.r[0] - before.r[0]) / (after.h[0] - before.h[0]);
    assert!((slope - 1.5).abs() < 1e-3, "as far as the pointer went: {slope}");
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(*window.preset(), before);
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(*window.preset(), after);
}

#[test]
fn each_channel_has_its_own_cross_for_the_pointer_and_the_keyboard() {
    let mut window = open(Some(gold_preset()), FEASIBILITY);
    let before = window.preset().clone();
    drag_cross(&mut window, "blue", vec2(30.0, -10.0));
    let after = window.preset().clone();
    assert!(after.r[2] > before.r[2] + 0.02 && after.h[2] > before.h[2]);
    assert_eq!([after.r[0], after.r[1]], [before.r[0], before.r[1]]);
    assert!(matches!(after.origin, Origin::Edited { .. }), "{:?}", after.origin);
    window.harness.get_by_label_contains("Cross of green").focus();
    window.harness.run();
    window.press(Modifiers::NONE, Key::ArrowDown);
    window.press(Modifiers::SHIFT, Key::ArrowLeft);
    let moved = window.preset();
    assert!((moved.h[1] - (after.h[1] - 0.005)).abs() < 1e-12 && (moved.r[1] - (after.r[1] - 0.05)).abs() < 1e-12);
    assert_eq!((moved.r[2], moved.h[2]), (after.r[2], after.h[2]));
}

#[test]
fn the_square_says_when_the_preset_is_no_reflectance() {
    let mut window = open(None, FEASIBILITY);
    assert!(window.shows("New metal stays inside"));
    window.enter("h red of the preset, linear Linear sRGB (Rec.709)", "1");
    assert_eq!(window.preset().h, Rgb([1.0, h_of_schlick(0.6), h_of_schlick(0.6)]));
    assert!(window.shows("New metal leaves the region"));
}

/// Asks for a file by the name of its button and answers with a path; there is no dialog service here.
///
/// On a machine under load the missing service can answer as slowly as a person who cancels: then it is asked again.
fn export(window: &mut Window, button: &str, path: &Path) {
    let mut attempts = 0..20;
    while !window.shows("Export the demonstration") {
        assert!(attempts.next().is_some(), "no question for a path");
        window.click(button);
    }
    window.answer_path(path);
}

#[test]
fn exported_files_are_what_the_study_says() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let mut window = open(None, CONVERSION);
    export(&mut window, "Export the figure as SVG", &path("gold.svg"));
    export(&mut window, "Export the figure as PNG", &path("gold.png"));
    export(&mut window, "Export the data as CSV", &path("gold.csv"));
    assert_eq!(window.notices(), [""; 0]);
    assert!(window.shows("Wrote gold.csv"));
    let study = gold_converted();
    assert_eq!(fs::read_to_string(path("gold.csv")).unwrap(), rows_to_csv(&study.rows()));
    let figure = ConversionFigure { study };
    assert_eq!(fs::read_to_string(path("gold.svg")).unwrap(), figure.to_svg(FigureTheme::Light));
    assert_eq!(fs::read(path("gold.png")).unwrap(), figure.to_png(FigureTheme::Light, 2.0));

    window.click(BLENDING);
    export(&mut window, "Export the figure as SVG", &path("blend.svg"));
    let figure = BlendFigure::new(&metal("gold"), &contestants(&Subject::Dielectric { n: 1.5 }));
    assert_eq!(fs::read_to_string(path("blend.svg")).unwrap(), figure.to_svg(FigureTheme::Light));
    window.click(UNIFORMITY);
    export(&mut window, "Export the figure as SVG", &path("steps.svg"));
    let figure = UniformityFigure { sweeps: sweeps(0.8), r: 0.8 };
    assert_eq!(fs::read_to_string(path("steps.svg")).unwrap(), figure.to_svg(FigureTheme::Light));
}

#[test]
fn every_demonstration_exports_its_figure_and_its_tables() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open(None, CONVERSION);
    for name in ALL {
        window.click(name);
        let buttons = match name {
            DECOUPLING => vec!["CSV, sweeps", "CSV, grey edges"],
            FEASIBILITY => vec!["CSV, metals", "CSV, boundaries"],
            _ => vec!["CSV"],
        };
        let name = name.split(':').next().unwrap();
        for (index, button) in buttons.into_iter().enumerate() {
            let path = folder.path().join(format!("{name}{index}.csv"));
            export(&mut window, &format!("Export the data as {button}"), &path);
            let mut reader = csv::Reader::from_path(&path).unwrap();
            assert!(reader.headers().unwrap().len() > 4 && reader.records().count() > 3, "{name}");
        }
        // A PNG is the same drawing, and takes seconds without optimisation: one test above writes one.
        let svg = folder.path().join(format!("{name}.svg"));
        export(&mut window, "Export the figure as SVG", &svg);
        roxmltree::Document::parse(&fs::read_to_string(svg).unwrap()).unwrap();
        assert_eq!(window.notices(), [""; 0], "{name}");
    }
    let points = fs::read_to_string(folder.path().join("Feasibility0.csv")).unwrap();
    assert!(points.lines().last().unwrap().contains("New metal"), "the cross is in the data");
}

#[test]
fn a_wrong_ending_is_a_sentence_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open(None, CONVERSION);
    for (button, name, known) in
        [("Export the figure as SVG", "gold.pdf", ".svg or .png"), ("Export the data as CSV", "gold.svg", ".csv")]
    {
        let path = folder.path().join(name);
        export(&mut window, button, &path);
        let notices = window.notices();
        assert!(notices.len() == 1 && notices[0].contains(known) && notices[0].contains(name), "{notices:?}");
        assert!(!path.exists());
        window.click(&format!("Dismiss: {}", notices[0]));
    }
}
