//! Do the demonstrations find what was measured before, by another program with 40 metals?
//!
//! The earlier numbers are of a study of robustness, uniformity and decoupling with those metals. Where
//! this library's 47 materials or its data sets give other numbers, both are written down.
#![cfg(feature = "cli")]

use std::collections::BTreeMap;
use std::process::{Command, Output, Stdio};

use edgewise::color::{Rgb, RgbSpace, delta_e_rgb};
use edgewise::fit::Method;
use edgewise::fresnel::{CosTheta, gulbrandsen};
use edgewise::metal::{Metal, metal_by_name, metals, preferred_metals};
use edgewise::study::{
    BlendPair, Contestants, ConversionOptions, Encoding, Parameters, Reach, Slider, SliderSweep, Storage, Subject,
    blend_matrix, blend_spread, blending, conversion_spread, conversions, no_progress, quantisation,
};

/// The earlier study gives two digits and ask for ten per cent.
fn is_near(got: f64, before: f64) -> bool {
    (got - before).abs() <= 0.1 * before
}

/// One data set for each material: Johnson & Christy's where there is one, as the earlier study had it.
fn metals_of_the_earlier_study() -> Vec<&'static Metal> {
    let mut chosen: BTreeMap<&str, &Metal> = preferred_metals().map(|metal| (metal.name.as_str(), metal)).collect();
    for metal in metals().iter().filter(|metal| metal.dataset == "Johnson") {
        chosen.insert(&metal.name, metal);
    }
    chosen.into_values().collect()
}

fn contestants(name: &str) -> Contestants {
    let subject = Subject::Metal(metal_by_name(name).unwrap());
    Contestants::of(&subject, RgbSpace::AcesCg, Method::LeastSquares).unwrap()
}

/// Before: ACEScg → sRGB, Schlick and h exactly 0, (r, g) mean .17 worst 1.2, (n, k) .28 worst 1.4.
///
/// The worst (n, k) is 1.17 here (gold): the one number that is further than ten per cent. With the preferred data
/// sets, whose copper and gold are more saturated, the means are .20 and .31.
#[test]
fn conversion_costs_what_it_did_before() {
    let options = ConversionOptions { from: RgbSpace::AcesCg, to: RgbSpace::LinRec709, ..Default::default() };
    let rows = conversions(&metals_of_the_earlier_study(), &options, &no_progress).unwrap();
    let [h, t, g, nk] = conversion_spread(&rows);
    assert!(h.max < 1e-9, "{h:?}");
    assert!(is_near(g.mean, 0.17) && is_near(g.max, 1.2), "{g:?}");
    assert!(is_near(nk.mean, 0.28) && (1.0..1.5).contains(&nk.max), "{nk:?}");
    assert!(t.mean > 0.0 && t.max < 0.1, "{t:?}");

    let preferred: Vec<&Metal> = preferred_metals().collect();
    let [_, _, g, nk] = conversion_spread(&conversions(&preferred, &options, &no_progress).unwrap());
    assert!(is_near(g.mean, 0.20) && is_near(nk.mean, 0.31), "{g:?} {nk:?}");
}

fn mean_to_truth(rows: &[BlendPair], parameters: Parameters) -> f64 {
    let own = rows.iter().filter(|row| row.parameters == parameters).map(|row| row.truth_mean_delta_e);
    own.clone().sum::<f64>() / own.count() as f64
}

/// Before: half and half, against the blended truth: h .22, (r, g) .46, n, k 2.6–3.8 over 780 pairs.
///
/// These 1081 pairs hold brasses, gold–silver alloys and intermetallics that are harder for every model:
/// h .31, (r, g) .54. Blending itself costs h nothing.
#[test]
fn blending_costs_what_it_did_before() {
    let metals: Vec<&Metal> = preferred_metals().collect();
    let rows = blend_matrix(&metals, RgbSpace::AcesCg, Method::LeastSquares, &no_progress).unwrap();
    assert_eq!(rows.len(), 4 * metals.len() * (metals.len() - 1) / 2);
    assert!(blend_spread(&rows)[0].max < 1e-9);
    assert!(is_near(mean_to_truth(&rows, Parameters::H), 0.31));
    assert!(is_near(mean_to_truth(&rows, Parameters::G), 0.54));
    assert!((2.6..3.8).contains(&mean_to_truth(&rows, Parameters::Nk)));
}

/// Before: with a dielectric partner n, k are worst. The study says 8–10 for n, k and 1.6 for (r, g);
/// glass of n = 1.5, half and half, gives 6.1 and .86 here: its partner is not known.
#[test]
fn a_dielectric_partner_is_worst_for_n_k() {
    let glass = Contestants::of(&Subject::Dielectric { n: 1.5 }, RgbSpace::AcesCg, Method::LeastSquares).unwrap();
    let halfway = |name: &str| {
        let blend = blending(&contestants(name), &glass);
        Parameters::ALL.map(|parameters| blend.results[parameters as usize].halfway().mean_delta_e)
    };
    for name in ["gold", "copper", "silver", "aluminium", "iron"] {
        let [h, t, g, nk] = halfway(name);
        assert!(h < 1e-9 && t < g && g < nk && nk > 2.0, "{name}: {h} {t} {g} {nk}");
    }
}

/// Before: 8-bit storage of the edge parameter of gold, largest ΔE: h .08, t .16, g 1.7.
///
/// Where a value lies between two codes is luck; half a code in each channel is the most it can be off. In ACEScg
/// that is h .50, t .43, g 2.0, which bounds the earlier numbers; what is stored of h itself is off by .17.
#[test]
fn eight_bits_hold_h_and_not_g() {
    let study = quantisation(&contestants("Au_Johnson"), &contestants("silver"));
    let rounding =
        |parameters| study.result(parameters, Storage::Bits8, Encoding::Linear).unwrap().row.rounding_delta_e;
    let [h, t, g, _] = Parameters::ALL.map(rounding);
    assert!((0.08..0.55).contains(&h) && (0.16..0.55).contains(&t) && (1.7..2.2).contains(&g), "{h} {t} {g}");
    // No rounding exceeds what half a code can do.
    for result in study.results.iter().filter(|result| result.row.clipped == 0) {
        let row = &result.row;
        assert!(row.edge_delta_e <= 1.02 * row.rounding_delta_e + 1e-3, "{row:?}");
    }
}

/// Before: variation of 20 equal steps over what g can reach, g and linear h.
#[test]
fn steps_vary_as_they_did_before() {
    let variation = |r, slider, reach| SliderSweep::new(r, slider, reach, 20).unwrap().row().variation;
    for (r, g, h) in [(0.3, 0.35, 0.15), (0.5, 0.55, 0.19), (0.8, 1.6, 0.14), (0.95, 3.8, 0.046)] {
        let got = [Slider::G, Slider::HLinear].map(|slider| variation(r, slider, Reach::Reachable));
        assert!(is_near(got[0], g) && is_near(got[1], h), "{r}: {got:?}");
    }
    // "Over its full range linear h is itself non-uniform (.4–1.0)": every h that is a reflectance, by r.
    assert!(is_near(variation(0.02, Slider::HLinear, Reach::Feasible), 0.4));
    assert!(is_near(variation(0.95, Slider::HLinear, Reach::Feasible), 1.0));
    assert!(variation(0.8, Slider::OURS, Reach::Full) < 0.25 * variation(0.8, Slider::HLinear, Reach::Full));
}

/// Before: r from .85 to .95 moves the edge by 4.7–6.0 ΔE at fixed g.
///
/// That holds for g from 0 to 3/4; at g = 1, where most metals are, it is .5.
#[test]
fn r_moves_the_edge_at_fixed_g() {
    let moved = |g| {
        let [from, to] = [0.85, 0.95].map(|r| Rgb::splat(gulbrandsen(r, g, CosTheta::MAX)));
        delta_e_rgb(from, to, RgbSpace::AcesCg)
    };
    for g in [0.0, 0.25, 0.5, 0.75] {
        assert!((4.65..6.05).contains(&moved(g)), "{g}: {}", moved(g));
    }
    assert!(moved(1.0) < 1.0);
}

// --- the command line ---

fn edgewise(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewise"));
    command.arg("study").args(arguments).stdin(Stdio::null()).output().unwrap()
}

const COMMANDS: [&[&str]; 9] = [
    &["conversion"],
    &["conversion", "--detail"],
    &["blending"],
    &["blending", "gold", "n=1.5", "--detail"],
    &["quantisation"],
    &["decoupling"],
    &["decoupling", "--cross-talk"],
    &["uniformity", "--r", "0.8"],
    &["feasibility", "--metals"],
];

#[test]
fn every_demonstration_prints_every_format() {
    for command in COMMANDS {
        let text = |more: &[&str]| {
            let output = edgewise(&[command, more].concat());
            assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
            String::from_utf8(output.stdout).unwrap()
        };
        let json: serde_json::Value = serde_json::from_str(&text(&["--json"])).unwrap();
        let rows = json.as_array().unwrap();

        let csv = text(&["--format", "csv"]);
        assert_eq!(csv.lines().count(), rows.len() + 1, "{command:?}");
        let names: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
        assert!(names.iter().all(|name| rows[0].get(name).is_some()), "{command:?}: {names:?}");

        let table = text(&[]);
        assert_eq!(table.lines().count(), rows.len() + 3, "{command:?}");
        let sentence = table.lines().last().unwrap();
        assert!(sentence.contains(char::is_numeric) && sentence.ends_with('.'), "{sentence}");
    }
}

#[test]
fn every_demonstration_draws_its_figure() {
    let folder = tempfile::tempdir().unwrap();
    let commands = COMMANDS.iter().copied().chain([["conversion", "--all"].as_slice()]);
    for (index, command) in commands.enumerate() {
        let path = folder.path().join(format!("{index}.svg"));
        let output = edgewise(&[command, &["--plot", path.to_str().unwrap()]].concat());
        assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
        let svg = std::fs::read_to_string(&path).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        assert!(document.descendants().filter(|node| node.has_tag_name("text")).count() > 8, "{command:?}");
    }
    let refused = edgewise(&["uniformity", "--plot", folder.path().join("a.pdf").to_str().unwrap()]);
    assert!(!refused.status.success() && String::from_utf8_lossy(&refused.stderr).contains(".svg or .png"));
}

#[test]
fn what_makes_no_sense_is_refused_in_one_sentence() {
    let refusals: [(&[&str], &str); 8] = [
        (&["conversion", "unobtainium"], "unobtainium"),
        (&["conversion", "--from", "srgb"], "lin_rec709"),
        (&["conversion", "gold", "--all"], "cannot be used with"),
        (&["blending", "gold", "n=0.2"], "at least 1"),
        (&["blending", "--method", "exact"], "least-squares"),
        (&["decoupling", "--amount", "2"], "at most 1"),
        (&["uniformity", "--r", "1"], "between 0 and 1"),
        (&["uniformity", "--steps", "1"], "whole number"),
    ];
    for (arguments, reason) in refusals {
        let output = edgewise(arguments);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && output.stdout.is_empty(), "{arguments:?}");
        assert!(said.lines().count() == 1 && said.contains(reason), "{arguments:?}: {said}");
    }
}

/// Parameters of a preset are read in its own space, whatever space the study is in.
#[test]
fn presets_and_colours_are_subjects() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    let preset = edgewise::preset::Preset::from_metal(metal_by_name("copper").unwrap(), RgbSpace::LinRec2020);
    preset.save(&path).unwrap();
    let output = edgewise(&["conversion", path.to_str().unwrap(), "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json[0]["material"], "Copper");
    assert!(json[0]["max_delta_e"].as_f64().unwrap() < 1e-9);
    assert!(json[2]["max_delta_e"].as_f64().unwrap() > 1.0);
}
