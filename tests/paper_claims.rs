//! The claims of Hoffman, "Fresnel Equations Considered Harmful", one test each, named by their section.
//!
//! Every test states the outcome as measured, also where the paper's sentence depends on something it does not say.

use std::sync::LazyLock;

use edgewise::color::RgbSpace;
use edgewise::fit::{Method, Triple};
use edgewise::fresnel::{ModelKind, THETA_MAX_DEG};
use edgewise::study::{Candidate, Evidence, Summary, Verdict, no_progress};

static EVIDENCE: LazyLock<Evidence> = LazyLock::new(|| Evidence::measure(&no_progress).expect("nobody stops it"));

const SRGB: RgbSpace = RgbSpace::LinRec709;
const ACESCG: RgbSpace = RgbSpace::AcesCg;
const ROUND: Candidate = Candidate::Model(ModelKind::Conductor, Method::Points(Triple::ROUND));
const PRIMARIES: Candidate = Candidate::Model(ModelKind::Conductor, Method::Points(Triple::PRIMARIES));
const WEIGHTED: Candidate = Candidate::Model(ModelKind::Conductor, Method::ColourMatching);
const NEAREST_NK: Candidate = Candidate::Model(ModelKind::Conductor, Method::LeastSquares);

fn summary(space: RgbSpace, candidate: Candidate) -> &'static Summary {
    EVIDENCE.summary(space, candidate).expect("measured in this space")
}

fn mean(space: RgbSpace, candidate: Candidate) -> f64 {
    summary(space, candidate).mean_delta_e
}

/// "Overall Schlick's approximation is quite accurate; for the majority of metals the average error is under 2 dE."
#[test]
fn section_2_schlick_is_under_two_for_most_metals() {
    for space in RgbSpace::ALL {
        let schlick = summary(space, Candidate::SCHLICK);
        assert!(schlick.below_two * 10 > schlick.metals * 9, "{schlick:?}");
    }
}

/// The average hides the edge: "the accuracy of Schlick's approximation is not perfect".
#[test]
fn section_2_schlick_is_far_off_near_grazing() {
    let schlick = summary(SRGB, Candidate::SCHLICK);
    assert!(schlick.largest_delta_e > 10.0 && schlick.angle_of_largest_deg > 80.0, "{schlick:?}");
    assert!(schlick.mean_max_delta_e > 3.0 * schlick.mean_delta_e);
}

/// "A process with no physical meaning, for which there is no a priori correct method": the methods disagree by more
/// than Schlick is wrong, and each is right in another space.
#[test]
fn section_3_there_is_no_correct_way_to_rgb_n_and_k() {
    for space in [SRGB, ACESCG] {
        let means = [ROUND, PRIMARIES, WEIGHTED, NEAREST_NK].map(|candidate| mean(space, candidate));
        let largest = means.iter().copied().fold(0.0, f64::max);
        assert!(largest - means[3] > mean(space, Candidate::SCHLICK), "{space}: {means:?}");
    }
    assert!(mean(ACESCG, ROUND) > 1.5 * mean(SRGB, ROUND));
}

/// "Converting parameter values to a new color space": exact for r and h, wrong for g, n and k.
#[test]
fn section_4_only_colours_convert() {
    let [h, t, g, nk] = &EVIDENCE.conversion;
    assert!(h.max < 1e-9, "{h:?}");
    assert!(g.max > 1.0 && nk.max > 1.0 && g.mean > 0.1 && nk.mean > 0.1, "{g:?} {nk:?}");
    assert!(t.max < 0.5 && t.max > 1e-6, "t is no colour either, but nearly one: {t:?}");
}

/// "Blending of parameter values": exact for r and h, very wrong for n and k. For g it is wrong by less than Schlick
/// itself: the paper's sentence is stronger than this measurement.
#[test]
fn section_4_only_colours_blend() {
    let [h, _, g, nk] = &EVIDENCE.blending;
    assert!(h.max < 1e-9, "{h:?}");
    assert!(nk.mean > mean(ACESCG, Candidate::SCHLICK) && nk.max > 10.0, "{nk:?}");
    assert!(g.mean > 0.2 && g.mean < mean(ACESCG, Candidate::SCHLICK) && g.max > 1.5, "{g:?}");
}

/// "The methods which are currently in common production use (e.g., spectral point sampling) introduce errors which
/// are as large or larger than those resulting from Schlick's approximation": in ACEScg yes; in linear sRGB only with
/// the wavelengths of the primaries, and for a minority of metals.
#[test]
fn section_5_point_sampling_depends_on_the_space() {
    for candidate in [ROUND, PRIMARIES] {
        assert!(mean(ACESCG, candidate) > 1.3 * mean(ACESCG, Candidate::SCHLICK));
        let acescg = summary(ACESCG, candidate);
        assert!(2 * acescg.worse_than_schlick.unwrap() > acescg.metals, "{acescg:?}");
        let srgb = summary(SRGB, candidate);
        assert!(2 * srgb.worse_than_schlick.unwrap() < srgb.metals, "{srgb:?}");
    }
    assert!(mean(SRGB, ROUND) < mean(SRGB, Candidate::SCHLICK));
    assert!(mean(SRGB, PRIMARIES) > mean(SRGB, Candidate::SCHLICK));
}

/// "It is possible to achieve highly accurate results with the Fresnel equations, but only when taking great care":
/// weighting n and k as if they were colours is careful enough to beat r and h on average.
#[test]
fn section_5_careful_weighting_is_accurate() {
    for space in [SRGB, ACESCG] {
        assert!(mean(space, WEIGHTED) < mean(space, Candidate::HOFFMAN));
    }
}

/// "The most accurate results are achieved via black-box numerical fitting": of all RGB models, and far better than h.
#[test]
fn section_5_black_box_fitting_is_the_most_accurate() {
    for space in [SRGB, ACESCG] {
        let fitted = mean(space, Evidence::FITTED_NK);
        assert!(fitted < 0.1 && fitted < 0.2 * mean(space, Candidate::HOFFMAN), "{fitted}");
        let others = EVIDENCE.summaries.iter().filter(|s| s.space == space);
        for other in others.filter(|s| matches!(s.candidate, Candidate::Model(..))) {
            assert!(fitted <= other.mean_delta_e, "{other:?}");
        }
        let wins = EVIDENCE.wins(space, Evidence::FITTED_NK, Candidate::HOFFMAN);
        assert!(wins + 3 >= summary(space, Candidate::HOFFMAN).metals, "{wins}");
    }
}

/// "It also does not have a reasonable default value": no constant g beats leaving g out.
#[test]
fn section_5_g_has_no_reasonable_default() {
    let half = Candidate::Model(ModelKind::Gulbrandsen, Method::DefaultTint);
    for space in RgbSpace::ALL {
        assert!(mean(space, half) > mean(space, Candidate::SCHLICK));
    }
    let (g, error) = EVIDENCE.best_constant_g;
    assert!(error > mean(ACESCG, Candidate::SCHLICK), "g = {g}: {error}");
}

/// "This angle is close to the peak of the actual Schlick error term for the metals we investigated."
#[test]
fn section_8_the_peak_of_schlicks_error_is_near_theta_max() {
    let peak = &EVIDENCE.schlick_peak_deg;
    assert!((peak.median - THETA_MAX_DEG).abs() < 1.0, "{peak:?}");
    assert!(peak.lower_quartile > THETA_MAX_DEG - 6.0 && peak.upper_quartile < THETA_MAX_DEG + 6.0, "{peak:?}");
}

/// "The reparameterized Lazanyi model has lower error than Schlick's approximation": for every metal, in every space.
#[test]
fn section_8_h_beats_schlick_on_every_metal() {
    for space in RgbSpace::ALL {
        let wins = EVIDENCE.wins(space, Candidate::HOFFMAN, Candidate::SCHLICK);
        assert_eq!(wins, summary(space, Candidate::SCHLICK).metals, "{space}");
        assert!(mean(space, Candidate::HOFFMAN) < 0.4 * mean(space, Candidate::SCHLICK));
    }
}

/// Where the model loses: alkali metals, titanium nitride and zinc. Fitting α too (Lazányi's own model) halves the
/// error, which is the price of the fixed α = 6.
#[test]
fn section_8_h_has_hard_cases() {
    let hard: Vec<&str> = EVIDENCE.hard_cases(ACESCG).into_iter().take(4).map(|row| row.name.as_str()).collect();
    for name in ["Caesium", "Rubidium", "Zinc"] {
        assert!(hard.contains(&name), "{hard:?}");
    }
    assert!(EVIDENCE.hard_cases(ACESCG)[0].mean_delta_e > 2.0, "caesium is above the paper's own bound");
    assert!(mean(ACESCG, Evidence::FITTED_LAZANYI) < 0.6 * mean(ACESCG, Candidate::HOFFMAN));
}

/// The document says of each claim what these tests found.
#[test]
fn verdicts_are_the_ones_above() {
    let verdicts: Vec<(&str, Verdict)> = EVIDENCE.claims().iter().map(|claim| (claim.section, claim.verdict)).collect();
    use Verdict::{Depends, Holds};
    let expected = [
        ("2", Holds),
        ("4", Holds),
        ("4", Depends),
        ("5", Depends),
        ("5", Holds),
        ("5", Holds),
        ("8", Holds),
        ("8", Holds),
    ];
    assert_eq!(verdicts, expected);
}

/// `docs/evidence.md` is what the program writes. Numbers may differ in the last digit between platforms.
#[test]
fn the_document_is_the_programs_own() {
    let written = EVIDENCE.markdown();
    let kept = include_str!("../docs/evidence.md").replace("\r\n", "\n");
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let (written_words, kept_words) = (words(&written), words(&kept));
    assert_eq!(written_words.len(), kept_words.len(), "run `edgewise study accuracy --evidence > docs/evidence.md`");
    for (now, then) in written_words.iter().zip(&kept_words) {
        assert!(
            is_same(now, then),
            "“{then}” is now “{now}”: run `edgewise study accuracy --evidence > docs/evidence.md`"
        );
    }
}

/// The same word, or a number within a hundredth or two per cent.
fn is_same(now: &str, then: &str) -> bool {
    let number = |word: &str| word.trim_matches(|c: char| !c.is_ascii_digit()).parse::<f64>().ok();
    match (number(now), number(then)) {
        (Some(x), Some(y)) => (x - y).abs() <= 0.011_f64.max(0.02 * y.abs()),
        _ => now == then,
    }
}
