//! Are the built-in photographs what the renderer makes, and does a match find their truth?

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use edgewise::color::RgbSpace;
use edgewise::photo::{Match, MatchRequest, Photo, WarningCode, solve};
use edgewise::sample::{Sample, Truth, render_all, sample, samples};

/// `EDGEWISE_WRITE_SAMPLES=1 cargo test --test samples` writes them; `edgewise samples --write` does, too.
#[test]
fn files_are_what_the_renderer_makes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/samples");
    for rendered in render_all().unwrap() {
        for (name, bytes) in rendered.files().unwrap() {
            let path = folder.join(&name);
            if std::env::var_os("EDGEWISE_WRITE_SAMPLES").is_some() {
                fs::write(&path, &bytes).unwrap();
            }
            assert!(fs::read(&path).unwrap() == bytes, "{name} differs from what the renderer makes");
        }
    }
}

#[test]
fn samples_are_small() {
    for sample in samples() {
        assert!(sample.bytes.len() <= 300_000, "{} has {} bytes", sample.id, sample.bytes.len());
    }
}

#[test]
fn every_sample_says_that_it_is_rendered() {
    assert!(samples().len() >= 3);
    for sample in samples() {
        assert!(sample.facts.rendered, "{}", sample.id);
        assert!(sample.facts.request.circle.is_some() && !sample.facts.request.cards.is_empty());
    }
}

fn opened(sample: &Sample) -> Photo {
    Photo::from_bytes(&sample.facts.file, sample.bytes, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn solved(id: &str, change: impl Fn(&Sample, &mut MatchRequest)) -> (Match, Truth) {
    let sample = sample(id).unwrap();
    let mut request = sample.facts.request.clone();
    change(sample, &mut request);
    (solve(&opened(sample), &request, RgbSpace::LinRec709).unwrap(), sample.facts.truth)
}

fn errors(found: &Match, truth: &Truth) -> Vec<(f64, f64)> {
    (0..3).map(|i| (found.r[i].unwrap() - truth.r[i], found.h[i].unwrap() - truth.h[i])).collect()
}

fn warns(found: &Match, code: WarningCode) -> bool {
    found.warnings.iter().any(|warning| warning.code == code)
}

/// A tent as good as real ones: the floor and the gradient cost a few percent, which ± covers.
#[test]
fn gold_in_the_tent_is_found() {
    let (found, truth) = solved("gold_tent", |_, _| {});
    println!("{:?}", errors(&found, &truth));
    for (i, (r, h)) in errors(&found, &truth).into_iter().enumerate() {
        assert!(r.abs() < 0.05 && h.abs() < 0.05, "{i}: {r:+.4} {h:+.4}");
        assert!(r.abs() < found.r_uncertainty[i].unwrap() && h.abs() < found.h_uncertainty[i].unwrap(), "{found:?}");
    }
    assert!(found.r[0].unwrap() > 1.0 && warns(&found, WarningCode::Gamut), "gold's red is not clipped");
    assert!(!found.is_estimate && !warns(&found, WarningCode::Environment), "{:?}", found.warnings);
}

#[test]
fn chromium_in_the_room_warns_of_it() {
    let (found, truth) = solved("chromium_room", |_, _| {});
    println!("{:?}", errors(&found, &truth));
    assert!(warns(&found, WarningCode::Environment), "{:?}", found.warnings);
}

#[test]
fn copper_is_an_estimate_until_the_greys_are_marked() {
    let (plain, truth) = solved("copper_camera", |_, _| {});
    let (scaled, _) = solved("copper_camera", |sample, request| request.greys = sample.facts.greys.clone());
    println!("{:?} {:?}", errors(&plain, &truth), errors(&scaled, &truth));
    assert!(plain.is_estimate && warns(&plain, WarningCode::Estimate) && !scaled.is_estimate);
    assert!(warns(&plain, WarningCode::Assumed), "what the file leaves open is told with the match");
    let worst = |found: &Match| errors(found, &truth).into_iter().map(|(r, _)| r.abs()).fold(0.0, f64::max);
    assert!(worst(&plain) > 0.06 && worst(&scaled) < 0.06, "{} {}", worst(&plain), worst(&scaled));
}
