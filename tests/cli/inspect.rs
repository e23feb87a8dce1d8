//! Does inspect read what a file holds?

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::run::{edgewise, json, refusal, stderr};

/// A PNG whose sRGB chunk says how it is encoded.
fn png(folder: &Path, name: &str, width: u32, rgb: &[[u8; 3]]) -> String {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, rgb.len() as u32 / width);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(rgb.as_flattened()).unwrap();
    writer.finish().unwrap();
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn inspect_reads_pixels_as_linear_rec709() {
    let folder = tempfile::tempdir().unwrap();
    let path = png(folder.path(), "two.png", 2, &[[128, 0, 255], [64, 64, 64]]);
    let value = json(&["inspect", &path, "--probe", "0,0;1,0", "--json"]);
    assert_eq!(
        (&value["width"], &value["height"], &value["colour_rule"]),
        (&json!(2), &json!(1), &json!("PNG sRGB chunk: sRGB"))
    );
    let red = value["probes"]["0,0"][0].as_f64().unwrap();
    // IEC 61966-2-1: ((128/255 + 0.055) / 1.055)^2.4.
    assert!((red - 0.215_860_5).abs() < 1e-6, "{red}");

    let csv = edgewise(&["inspect", &path, "--probe", "1,0", "--format", "csv"]);
    assert!(String::from_utf8(csv.stdout).unwrap().starts_with("x,y,red,green,blue\n1,0,0.05"));
    let facts = edgewise(&["inspect", &path, "--format", "csv"]);
    assert_eq!(String::from_utf8(facts.stdout).unwrap(), "width,height,colour_rule\n2,1,PNG sRGB chunk: sRGB\n");

    let outside = edgewise(&["inspect", &path, "--probe", "2,0", "--json"]);
    assert!(stderr(&outside).contains("there is no pixel 2,0 in a picture of 2 × 1"), "{}", stderr(&outside));
    assert_eq!(serde_json::from_slice::<Value>(&outside.stdout).unwrap()["probes"], json!({ "2,0": null }));
}

#[test]
fn what_is_no_photograph_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("text.png");
    fs::write(&text, "no picture").unwrap();
    assert!(refusal(1, &["inspect", text.to_str().unwrap()]).contains("text.png"));
    assert!(refusal(1, &["inspect", "no/such.png"]).contains("no/such.png"));
    let reason = "there is no such file";
    assert_eq!(refusal(1, &["inspect", "no/such.png"]).matches(reason).count(), 1, "said once");
    assert!(refusal(1, &["inspect", env!("CARGO_MANIFEST_DIR")]).contains("not a file"));
    assert!(refusal(2, &["inspect", "p.png", "--probe", "0.5,1"]).contains("“0.5,1” is no pixel"));
}
