//! Are the built-in photographs what the renderer makes, and does a match find their truth?

use std::fs;
use std::path::Path;

use edgewise::sample::{render_all, samples};

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
