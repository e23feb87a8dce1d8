//! Are pictures what the models say?

use std::fs;
use std::path::Path;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::metal::metal_by_name;
use edgewise::preset::Preset;
use serde_json::{Value, json};

use crate::run::{edgewise, refusal, stderr};

/// A picture of 64 pixels written into a folder, and what is printed and said about it.
fn picture(folder: &Path, name: &str, more: &[&str]) -> (Vec<u8>, Value, String) {
    let path = folder.join(name);
    let arguments = [&["picture", "--size", "64", "--json", "-o", path.to_str().unwrap()], more].concat();
    let output = edgewise(&arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    (fs::read(path).unwrap(), serde_json::from_slice(&output.stdout).unwrap(), stderr(&output))
}

/// Under white light the pixel in the middle is r itself, and an .exr keeps it although sRGB cannot show it.
#[test]
fn picture_exr_is_linear_in_the_space_and_unclipped() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--metal", "Au", "--light", "white", "--layout", "truth", "--space", "lin_rec709"];
    let (exr, _, _) = picture(folder.path(), "gold.exr", &options);
    let pixels = image::load_from_memory(&exr).unwrap().into_rgba32f();
    assert_eq!(pixels.dimensions(), (64, 64));
    let middle = Rgb([0, 1, 2].map(|channel| f64::from(pixels.get_pixel(32, 32)[channel])));
    let r = metal_by_name("Au").unwrap().r(RgbSpace::LinRec709);
    assert!(r[0] > 1.0 && middle.max_abs_difference(r) < 1e-4, "{middle:?} {r:?}");
    assert_eq!(pixels.get_pixel(0, 0).0, [0.0; 4], "nothing beside the sphere");

    let (_, _, said) = picture(folder.path(), "gold.png", &options);
    assert!(said.contains("outside sRGB and are clipped"), "{said}");
    let darker = [&options[..], &["--exposure", "-1"]].concat();
    let (exr, _, _) = picture(folder.path(), "darker.exr", &darker);
    let pixels = image::load_from_memory(&exr).unwrap().into_rgba32f();
    assert!((f64::from(pixels.get_pixel(32, 32)[0]) / middle[0] - 0.5).abs() < 1e-6, "a stop is a factor of two");
}

/// The numbers that are printed are those of the difference picture, and beside and wipe hold the same pixels.
#[test]
fn picture_layouts_show_the_same_two_spheres() {
    let folder = tempfile::tempdir().unwrap();
    let of = |layout: &str, ending: &str| {
        let options = ["--metal", "Cr", "--model", "schlick", "--light", "soft-boxes", "--layout", layout];
        picture(folder.path(), &format!("{layout}.{ending}"), &options)
    };
    let decoded = |layout: &str| image::load_from_memory(&of(layout, "exr").0).unwrap().into_rgba32f();
    let [truth, model, beside, wipe, difference] = ["truth", "model", "beside", "wipe", "difference"].map(decoded);
    assert_eq!(beside.dimensions(), (64 + 4 + 64, 64));
    for (column, row) in [(20, 5), (32, 32), (50, 60)] {
        assert_eq!(beside.get_pixel(column, row), truth.get_pixel(column, row));
        assert_eq!(beside.get_pixel(column + 68, row), model.get_pixel(column, row));
        let half = if column < 32 { &truth } else { &model };
        assert_eq!(wipe.get_pixel(column, row), half.get_pixel(column, row));
    }
    let (png, value, _) = of("difference", "png");
    let whole = difference.pixels().filter(|pixel| pixel[3] == 1.0).map(|pixel| f64::from(pixel[0]));
    let largest = whole.fold(0.0, f64::max);
    let (mean, max) = (value["mean_delta_e"].as_f64().unwrap(), value["max_delta_e"].as_f64().unwrap());
    assert!(0.0 < mean && mean < largest && largest <= max, "{mean} {largest} {max}");
    assert_eq!(image::load_from_memory(&png).unwrap().width(), 916, "a legible page around small spheres");
}

#[test]
fn picture_of_a_preset_needs_a_model_to_compare_with() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rough.json");
    Preset { roughness: 0.5, ..Preset::new_authored() }.save(&path).unwrap();
    let preset = ["--preset", path.to_str().unwrap()];
    let (_, alone, _) = picture(folder.path(), "alone.png", &preset);
    assert_eq!(
        (&alone["roughness"], &alone["max_delta_e"], &alone["model"]),
        (&json!(0.5), &Value::Null, &Value::Null)
    );
    let same = [&preset[..], &["--model", "f82-tint", "--roughness", "0"]].concat();
    let (_, same, _) = picture(folder.path(), "same.png", &same);
    assert_eq!((&same["roughness"], &same["model"]["kind"]), (&json!(0.0), &json!("f82-tint")));
    assert!(same["max_delta_e"].as_f64().unwrap() < 1e-3, "two words for one curve: {same}");

    let wipe = [&["picture"], &preset[..], &["--layout", "wipe", "-o", "never.png"]].concat();
    assert!(refusal(1, &wipe).contains("--model"));
}

#[test]
fn pictures_that_cannot_be_are_refused() {
    let with = |more: &[&'static str]| [&["picture", "--metal", "Cr"], more].concat();
    assert!(refusal(1, &with(&["-o", "sphere.bmp"])).contains(".png or .exr"));
    assert!(refusal(2, &with(&["--light", "moon"])).contains("city-square"));
    assert!(refusal(2, &with(&["--size", "7"])).contains("8..=4096"));
    assert!(refusal(2, &with(&["--roughness", "-0.1"])).contains("0–1"));
    assert!(refusal(2, &with(&["--exposure", "99"])).contains("99 stops"));
    assert!(refusal(2, &with(&["--full-scale", "0"])).contains("above 0"));
    assert!(refusal(2, &with(&["--layout", "wipe"])).contains("--output"));
    assert!(refusal(2, &["picture"]).contains("name one material"));
    assert!(refusal(1, &with(&["--model", "spectral", "--method", "exact"])).contains("--method"));
    assert!(refusal(1, &with(&["-o", "no/such/folder/sphere.png"])).contains("no/such/folder"));
}
