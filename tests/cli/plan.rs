//! `edgewise plan`, `edgewise study trade`, and export by a plan.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::run::{edgewise, json, quiet, refusal, stderr};

fn grey_png(path: &Path, size: u32, value: impl Fn(u32, u32) -> u16) {
    let picture = image::ImageBuffer::from_fn(size, size, |x, y| image::Luma([value(x, y)]));
    picture.save(path).unwrap();
}

/// The facing ratio of a ball, 16 bits, and ids: 1 on the left, 2 on the right.
fn ball(folder: &Path) -> (String, String) {
    let size = 64;
    let (ratio, ids) = (folder.join("facing.png"), folder.join("ids.png"));
    let to_radii = |pixel: u32| (f64::from(pixel) + 0.5) * 2.0 / f64::from(size) - 1.0;
    grey_png(&ratio, size, |x, y| {
        let squared = to_radii(x).powi(2) + to_radii(y).powi(2);
        ((1.0 - squared).max(0.0).sqrt() * 65535.0) as u16
    });
    grey_png(&ids, size, |x, _| if x < size / 2 { 1 } else { 2 });
    (ratio.to_str().unwrap().to_owned(), ids.to_str().unwrap().to_owned())
}

fn chosen(plan: &Value) -> Vec<&str> {
    plan["materials"].as_array().unwrap().iter().map(|material| material["chosen"].as_str().unwrap()).collect()
}

#[test]
fn a_material_below_60_degrees_needs_no_h() {
    let plan = json(&["plan", "gold@card:0-60", "copper@card:0-60", "zinc@sphere", "--json"]);
    assert_eq!(plan["materials"][0]["seen_deg"], serde_json::json!([0.0, 60.0]));
    let chosen = chosen(&plan);
    assert!(["constant:exact", "schlick:exact"].contains(&chosen[0]), "{chosen:?}");
    assert!(["constant:exact", "schlick:exact"].contains(&chosen[1]), "{chosen:?}");
    assert!(!["constant:exact", "schlick:exact"].contains(&chosen[2]), "{chosen:?}");
    let saves = &plan["saves"]["shader_operations"];
    assert!(saves["planned"].as_f64().unwrap() < saves["exact"].as_f64().unwrap() / 100.0);
    let text = quiet(&["plan", "gold@card:0-60"]);
    assert!(text.contains("Card tilted by 0–60°") && text.contains("1 of 1 materials needs no h"), "{text}");
}

#[test]
fn a_pass_with_ids_gives_each_material_its_angles() {
    let folder = tempfile::tempdir().unwrap();
    let (ratio, ids) = ball(folder.path());
    let plan = json(&["plan", "gold@id:1", "iron@id:2", "--pass", &ratio, "--ids", &ids, "--json"]);
    for material in plan["materials"].as_array().unwrap() {
        assert!((material["share"].as_f64().unwrap() - 0.5).abs() < 1e-9, "{material}");
    }
    let whole = json(&["plan", "gold", "iron", "--pass", &ratio, "--json"]);
    assert_eq!(whole["materials"][0]["seen_deg"], whole["materials"][1]["seen_deg"]);
    assert!(whole["scene"].as_str().unwrap().contains("64 × 64 pixels of channel Y"));
    let one = edgewise(&["plan", "gold@id:1", "--pass", &ratio, "--ids", &ids]);
    assert!(stderr(&one).contains("belong to no material"), "{}", stderr(&one));
    assert!(whole["notes"].as_array().unwrap().is_empty());
    let scene = plan["scene"].as_str().unwrap();
    assert!(scene.ends_with(&format!("; ids of {ids}, channel Y")), "{scene}");
    let unnamed = refusal(1, &["plan", "gold@id:1", "iron", "--pass", &ratio, "--ids", &ids]);
    assert!(unnamed.contains("gold@id:7"), "{unnamed}");
}

/// What a person would not notice in a table is said on standard error and in the plan.
#[test]
fn a_wrong_pass_is_said_or_refused_and_so_are_ids_that_are_not_there() {
    let folder = tempfile::tempdir().unwrap();
    let (ratio, ids) = ball(folder.path());
    let normals = folder.path().join("normals.png");
    image::ImageBuffer::from_fn(8, 8, |x, y| image::Rgb([x as u8 * 30, y as u8 * 30, 255])).save(&normals).unwrap();
    let normals = normals.to_str().unwrap();
    let of_normals = edgewise(&["plan", "gold", "--pass", normals, "--json"]);
    let told = stderr(&of_normals);
    assert!(of_normals.status.success() && told.contains("differ in") && told.contains("R was taken"), "{told}");
    let plan: Value = serde_json::from_slice(&of_normals.stdout).unwrap();
    assert!(plan["notes"][0].as_str().unwrap().contains("R was taken"), "{}", plan["notes"]);
    quiet(&["plan", "gold", "--pass", normals, "--channel", "B"]);

    let black = folder.path().join("black.png");
    grey_png(&black, 8, |_, _| 0);
    let refused = refusal(1, &["plan", "gold", "--pass", black.to_str().unwrap()]);
    assert!(refused.contains("none is a cosine") && refused.contains("64 without a surface"), "{refused}");

    let absent = edgewise(&["plan", "gold@id:1", "iron@id:9", "--pass", &ratio, "--ids", &ids]);
    let (told, text) = (stderr(&absent), String::from_utf8_lossy(&absent.stdout).into_owned());
    assert!(told.contains("the id 9 is not in the picture, which has 1 and 2"), "{told}");
    assert!(text.contains("it is not seen"), "{text}");
    let never = refusal(1, &["plan", "gold@id:65536", "--pass", &ratio, "--ids", &ids]);
    assert!(never.contains("65536") && never.contains("up to 65535"), "{never}");
    let edge = edgewise(&["plan", "gold@card:90-90"]);
    assert!(edge.status.success() && stderr(&edge).contains("not seen"), "{}", stderr(&edge));
}

#[test]
fn a_plan_that_is_there_is_replaced_only_when_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plan.json");
    fs::write(&path, "kept").unwrap();
    let plan = ["plan", "gold", "-o", path.to_str().unwrap()];
    assert!(refusal(1, &plan).contains("is there already; --force replaces it"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "kept");
    quiet(&[&plan[..], &["--force"]].concat());
    assert!(fs::read_to_string(&path).unwrap().contains("edgewise_plan"));
    assert!(refusal(2, &["plan", "gold", "--force"]).contains("--output"));
}

#[test]
fn given_colours_have_no_roughness_that_nobody_typed() {
    let plan = json(&["plan", "0.9,0.7,0.4", "--json"]);
    assert_eq!(plan["materials"][0]["roughness"], 0.0);
    let beyond = edgewise(&["plan", "1.05,0.7,0.4"]);
    assert!(beyond.status.success() && stderr(&beyond).contains("leaves 0–1"), "{}", stderr(&beyond));
}

/// Time decides offline, so that it is measured; elsewhere only where it is wanted.
#[test]
fn times_are_measured_where_they_decide() {
    let materials = ["plan", "gold@sphere", "iron@card:0-30", "--json"];
    let with = |more: &[&str]| json(&[&materials, more].concat());
    let saved = |plan: &Value| plan["saves"]["measured_ns"].clone();
    assert_eq!((saved(&with(&[])), &with(&[])["has_times"]), (Value::Null, &Value::Bool(false)));
    for more in [&["--for", "offline"][..], &["--times"]] {
        let plan = with(more);
        let ns = |of: &str| saved(&plan)[of].as_f64().unwrap();
        assert!(plan["has_times"] == true && 0.0 < ns("planned") && ns("planned") < ns("exact"), "{plan}");
    }
}

#[test]
fn nonsense_is_refused_in_a_sentence() {
    for (arguments, reason) in [
        (["plan", "gold@cube", "--tolerance", "1"], "no shape"),
        (["plan", "unobtainium", "--tolerance", "1"], "unobtainium"),
        (["plan", "gold@id:1", "--tolerance", "1"], "--pass"),
        (["plan", "gold", "--pass", "no.exr"], "no.exr"),
        (["plan", "1e300,1,1", "--tolerance", "1"], "1e300 is no reflectance"),
        (["plan", "gold", "--list", env!("CARGO_MANIFEST_DIR")], "this is a folder, not a file"),
        (["plan", "gold", "--pass", env!("CARGO_MANIFEST_DIR")], "this is a folder, not a file"),
    ] {
        assert!(refusal(1, &arguments).contains(reason), "{arguments:?}");
    }
    assert!(refusal(2, &["plan", "gold", "--tolerance", "-1"]).contains("at least 0"));
    refusal(2, &["plan"]);
}

/// The same plan, whether it is made afresh or from one that was saved, of whatever its materials are and wherever they
/// are seen; the files that it came from may be gone.
#[test]
fn a_saved_plan_is_planned_again() {
    let folder = tempfile::tempdir().unwrap();
    let (ratio, ids) = ball(folder.path());
    let [own, preset, saved] = ["own.csv", "mine.json", "plan.json"].map(|name| folder.path().join(name));
    fs::write(&own, "wavelength_nm,n,k\n400,1.5,2\n500,.9,2.5\n600,.3,3\n700,.2,4\n").unwrap();
    fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/copper.json"), &preset).unwrap();
    let [own, preset, saved] = [&own, &preset, &saved].map(|path| path.to_str().unwrap());
    let on_shapes = [&format!("{own}@card:0-70"), &format!("{preset}@floor:1.7:1-20"), "zinc", "0.9,0.7,0.4@cylinder"];
    let by_ids = [&format!("{own}@id:1"), "zinc@id:2", "--pass", &ratio, "--ids", &ids];
    let scenes: [(&[&str], &[&str]); 2] = [
        (&on_shapes, &["--tolerance", "0.2", "--on", "p95", "--for", "texture-memory"]),
        (&by_ids, &["--tolerance", "0.2", "--space", "acescg"]),
    ];
    let made = scenes.map(|(scene, asked)| {
        let with = |more: &[&str]| json(&[&["plan"], scene, more, &["--json"]].concat());
        let again = |more: &[&str]| json(&[&["plan", "--from", saved, "--json"], more].concat());
        let first = with(&["--tolerance", "4", "-o", saved, "--force"]);
        let kept: Value = serde_json::from_slice(&fs::read(saved).unwrap()).unwrap();
        assert_eq!(kept, first, "what is printed is what is saved");
        assert_eq!(again(&[]), first, "nothing else is asked for");
        let fresh = with(asked);
        assert_ne!(fresh["materials"], first["materials"]);
        assert_eq!(again(asked), fresh);
        fs::read(saved).unwrap()
    });
    for file in [own, preset, &ratio, &ids] {
        fs::remove_file(file).unwrap();
    }
    for plan in made {
        fs::write(saved, plan).unwrap();
        let again = edgewise(&["plan", "--from", saved, "--tolerance", "1"]);
        assert!(
            again.status.success() && stderr(&again).contains("own.csv is gone; the plan keeps"),
            "{}",
            stderr(&again)
        );
    }
    assert!(refusal(2, &["plan", "gold", "--from", saved]).contains("cannot be used with"));
    assert!(refusal(1, &["plan", "--from", "no.json"]).contains("no.json"));
    fs::write(saved, "{\"edgewise_plan\": 2}").unwrap();
    assert!(refusal(1, &["plan", "--from", saved]).contains("plan format 2"));
}

#[test]
fn a_plan_drives_an_export_without_h() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.json");
    let plan = plan.to_str().unwrap();
    quiet(&["plan", "gold@card:0-45", "chromium@sphere", "--tolerance", "0.8", "-o", plan]);
    let out = folder.path().join("out");
    let out = out.to_str().unwrap();
    let exported = json(&["export", "--plan", plan, "--to", "glsl", "-o", out, "--json"]);
    assert_eq!(exported[0]["files"].as_array().unwrap().len(), 2);
    let gold = fs::read_to_string(Path::new(out).join("gold.glsl")).unwrap();
    assert!(!gold.contains("vec3 h"), "{gold}");
    let chromium = fs::read_to_string(Path::new(out).join("chromium.glsl")).unwrap();
    assert!(chromium.contains("p = p * t"), "chromium is a series: {chromium}");
    let shards = folder.path().join("shards");
    for (shard, files) in [("2/2", vec!["chromium.glsl"]), ("1/2", vec!["chromium.glsl", "gold.glsl"])] {
        json(&["export", "--plan", plan, "--to", "glsl", "--shard", shard, "-o", shards.to_str().unwrap(), "--json"]);
        let names = fs::read_dir(&shards).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        assert_eq!(names, files);
    }
    assert_eq!(fs::read_to_string(shards.join("gold.glsl")).unwrap(), gold);
    assert!(refusal(1, &["export", "--plan", "no.json", "--to", "glsl"]).contains("no.json"));
}

/// What a plan found within its tolerance is what its files say, and what they cannot say is refused where it must not be.
#[test]
fn an_export_keeps_the_plan() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (fitted, clipped, out) = (path("fitted.json"), path("clipped.json"), path("out"));
    let plan = json(&["plan", "gold@sphere", "--tolerance", "0.75", "-o", &fitted, "--json"]);
    assert_eq!(chosen(&plan), ["hoffman:least-squares"]);
    let written = json(&["export", "--plan", &fitted, "--to", "glsl", "--strict", "-o", &out, "--json"]);
    assert_eq!(written[0]["variants"][0], "hoffman:least-squares");
    let green = plan["materials"][0]["parameters"]["model"]["h"][1].as_f64().unwrap();
    let green = format!("{green:.9}").trim_end_matches('0').to_owned();
    let source = fs::read_to_string(Path::new(&out).join("gold.glsl")).unwrap();
    assert!(source.contains(&green), "{green} {source}");

    quiet(&["plan", "gold@card:0-60", "--tolerance", "1", "-o", &clipped]);
    let open_pbr = ["export", "--plan", &clipped, "--to", "open-pbr", "-o", &out];
    assert!(refusal(1, &[&open_pbr[..], &["--strict"]].concat()).contains("with --strict nothing was written"));
    let told = stderr(&edgewise(&open_pbr));
    assert!(told.contains("the largest ΔE is 1.26") && told.contains("above 1"), "{told}");
    let document = fs::read_to_string(Path::new(&out).join("gold.open_pbr.mtlx")).unwrap();
    assert!(document.contains("above 1 ") && !document.contains("t red"), "{document}");
}

#[test]
fn the_trade_is_a_table_and_a_figure() {
    let folder = tempfile::tempdir().unwrap();
    let figure = folder.path().join("trade.svg");
    let rows = json(&["study", "trade", "gold", "--plot", figure.to_str().unwrap(), "--json"]);
    let rows = rows.as_array().unwrap();
    let on_front = |row: &&Value| row["is_on_front"] == true;
    assert!(rows.len() > 15 && rows.iter().filter(on_front).count() > 3);
    assert!(fs::read_to_string(figure).unwrap().contains("Shader operations"));
    let bytes = quiet(&["study", "trade", "gold", "--cost", "parameter-bytes", "--on", "mean"]);
    assert!(bytes.contains("Mean ΔE by bytes of parameters"), "{bytes}");
}

#[test]
fn the_trade_of_a_folder_is_that_of_its_presets() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["gold", "copper"].map(|name| folder.path().join(format!("{name}.json")));
    for file in &files {
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("presets").join(file.file_name().unwrap()), file).unwrap();
    }
    let [gold, copper] = files.each_ref().map(|file| file.to_str().unwrap());
    let of_files = json(&["study", "trade", "--preset", gold, "--preset", copper, "--json"]);
    let folder_name = folder.path().to_str().unwrap();
    let rows = |rows: &Value| rows.as_array().unwrap().len();
    assert!(rows(&of_files) > 15);
    let of_folder = json(&["study", "trade", "--preset", folder_name, "--json"]);
    for (ours, theirs) in of_folder.as_array().unwrap().iter().zip(of_files.as_array().unwrap()) {
        assert_eq!((&ours["variant"], &ours["materials"]), (&theirs["variant"], &Value::from(2)));
    }
    fs::write(folder.path().join("other.json"), "{}").unwrap();
    let beside = edgewise(&["study", "trade", "--preset", folder_name, "--json"]);
    assert!(beside.status.success() && stderr(&beside).contains("other.json"), "{}", stderr(&beside));
    let empty = tempfile::tempdir().unwrap();
    fs::write(empty.path().join("other.json"), "{}").unwrap();
    assert!(refusal(1, &["study", "trade", "--preset", empty.path().to_str().unwrap()]).contains("preset"));
}

#[test]
fn the_speed_of_kernels_is_measured_here() {
    let rows = json(&["study", "speed", "--quick", "--kernel", "hoffman", "--json"]);
    let rows = rows.as_array().unwrap();
    let of = |kernel: &str, kind: &str| {
        let is = |row: &&Value| row["kernel"] == kernel && row["kind"] == kind && row["per"] == "material";
        rows.iter().find(is).unwrap_or_else(|| panic!("no {kernel}, {kind}"))
    };
    assert_eq!(of("schlick", "ours")["times_schlick"], 1.0);
    assert_eq!(of("hoffman", "ours")["shader_operations"], 13);
    assert!(of("hoffman", "textbook")["min_ns"].as_f64().unwrap() > 0.0);
    let evaluations = edgewise(&["study", "speed", "--repeat", "hoffman", "pixel", "3"]);
    assert_eq!(String::from_utf8_lossy(&evaluations.stdout).trim(), (3 * 1024).to_string());
    assert!(refusal(2, &["study", "speed", "--repeat", "hoffman", "pair", "3"]).contains("hoffman"));
    assert!(refusal(2, &["study", "speed", "--repeat", "hoffman", "pixel", "x"]).contains("whole number"));
    assert!(refusal(2, &["study", "speed", "--kernel", "warp"]).contains("warp"));
    assert!(refusal(2, &["study", "speed", "--instruction-set", "mmx"]).contains("mmx"));
}
