//! Does match give the numbers of the library, which are the window's, in every mode and for every outline?

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::fresnel::{CosTheta, hoffman};
use edgewise::metal::{ReflectanceTable, metal_by_name};
use edgewise::photo::{
    Body, Circle, Cylinder, LightMode, MatchRequest, MirrorPair, Photo, find_ball, find_ball_beside, snap_circle,
    snap_cylinder, solve,
};
use edgewise::preset::{Origin, Preset};
use edgewise::sample::linear_png;
use serde_json::{Value, json};

use crate::run::{json, refusal};

const LIGHT: Rgb = Rgb([0.6, 0.5, 0.4]);
const R: Rgb = Rgb([0.7, 0.6, 0.5]);
const H: Rgb = Rgb([0.8, 0.72, 0.66]);
const BALL: Circle = Circle::new(120.3, 129.6, 100.4);
const CHROMIUM_BALL: Circle = Circle::new(340.0, 130.0, 100.0);

fn of_ball(circle: Circle, x: f64, y: f64, reflectance: &dyn Fn(f64) -> Rgb) -> Option<Rgb> {
    let rho = circle.rho(x, y);
    (rho < 1.0).then(|| LIGHT.zip(reflectance((1.0 - rho * rho).sqrt()), |light, f| light * f))
}

fn of_model(cosine: f64) -> Rgb {
    R.zip(H, |r, h| hoffman(r, h, CosTheta::new(cosine)))
}

/// Two balls, and neutral patches of .9 … .1 down the right side under an even light before a darker wall.
fn table() -> Vec<Rgb> {
    let chromium = ReflectanceTable::of(metal_by_name("chromium").unwrap());
    let pixel = |x: f64, y: f64| {
        let patch = (x > 470.0 && y < 240.0).then(|| LIGHT * (0.9 / (1.0 + (y / 60.0).floor())));
        let ball = of_ball(BALL, x, y, &of_model);
        let reference = || of_ball(CHROMIUM_BALL, x, y, &|cosine| chromium.at(cosine));
        patch.or(ball).or_else(reference).unwrap_or(LIGHT * 0.3)
    };
    (0..260).flat_map(|y| (0..560).map(move |x| (x, y))).map(|(x, y)| blurred(x, y, &pixel)).collect()
}

/// The mean of four points of a pixel.
fn blurred(x: u32, y: u32, pixel: &dyn Fn(f64, f64) -> Rgb) -> Rgb {
    let points = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)];
    points.iter().fold(Rgb::BLACK, |sum, (dx, dy)| sum + pixel(f64::from(x) + dx, f64::from(y) + dy) * 0.25)
}

fn write(folder: &Path, name: &str, picture: &[Rgb], width: u32) -> String {
    let path = folder.join(name);
    fs::write(&path, linear_png(picture, width, 16).unwrap()).unwrap();
    path.to_str().unwrap().to_owned()
}

fn open(path: &str) -> Photo {
    Photo::open(Path::new(path), &mut |_| ControlFlow::Continue(())).unwrap()
}

/// Everything the library says of a request, and nothing else, stands in the answer of the command line.
fn assert_same(path: &str, arguments: &[&str], request: &MatchRequest) -> Value {
    let found = json(&[&["match", path, "--json"], arguments].concat());
    let expected = serde_json::to_value(solve(&open(path), request, RgbSpace::LinRec709).unwrap()).unwrap();
    for (name, value) in expected.as_object().unwrap() {
        assert_eq!(&found[name], value, "{arguments:?}: {name}");
    }
    found
}

#[test]
fn every_mode_gives_the_numbers_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let table = write(folder.path(), "table.png", &table(), 560);
    let (circle, card) = ("120.3,129.6,100.4", "480,5,70,50@0.9");
    let ball = MatchRequest { circle: Some(BALL), ..MatchRequest::default() };
    let area = |text: &str| text.parse().unwrap();
    let with_mode = |mode: LightMode| MatchRequest { mode, ..ball.clone() };

    let pair = |direct, mirrored, angle| MirrorPair::new(area(direct), area(mirrored), angle).unwrap();
    let mirrors = vec![pair("480,5,70,50", "480,65,70,50", 12.0), pair("480,5,70,50", "480,125,70,50", 82.0)];
    let flat = MatchRequest { mode: LightMode::FlatMirror, mirrors, ..MatchRequest::default() };
    let direct = ["--mode", "A", "--direct", "480,5,70,50", "--mirrored", "480,65,70,50", "--angle", "12"];
    let grazing = ["--direct", "480,5,70,50", "--mirrored", "480,125,70,50", "--angle", "82"];
    assert_same(&table, &[&direct[..], &grazing].concat(), &flat);

    let reference = "340,130,100@chromium";
    let request =
        MatchRequest { reference_ball: Some(reference.parse().unwrap()), ..with_mode(LightMode::ReferenceBall) };
    let found = assert_same(&table, &["--circle", circle, "--reference-ball", reference], &request);
    assert!((found["r"][0].as_f64().unwrap() - R[0]).abs() < 0.01, "{found:#}");

    let second = "480,65,70,50@0.45";
    let request =
        MatchRequest { cards: vec![card.parse().unwrap(), second.parse().unwrap()], ..with_mode(LightMode::Card) };
    let found = assert_same(&table, &["--circle", circle, "--card", card, "--card", second], &request);
    assert!((found["h"][1].as_f64().unwrap() - H[1]).abs() < 0.01, "{found:#}");

    let backdrop = "225,5,14,20";
    let request = MatchRequest { backdrop: Some(area(backdrop)), ..with_mode(LightMode::Backdrop) };
    assert_same(&table, &["--circle", circle, "--backdrop", backdrop], &request);

    let request = MatchRequest { light: Some(LIGHT), ..with_mode(LightMode::ByEye) };
    let found = assert_same(&table, &["--mode", "F", "--circle", circle, "--light", "0.6,0.5,0.4"], &request);
    assert_eq!(found["is_estimate"], json!(true));

    let greys = ["480,5,70,50@0.9", "480,65,70,50@0.45", "480,125,70,50@0.3", "480,185,70,50@0.225"];
    let request =
        MatchRequest { greys: greys.map(|grey| grey.parse().unwrap()).to_vec(), ..with_mode(LightMode::Card) };
    let marks = greys.iter().flat_map(|grey| ["--greys", *grey]).collect::<Vec<_>>();
    assert_same(&table, &[&["--mode", "card", "--circle", circle], &marks[..]].concat(), &request);
}

/// Mode E needs a picture of its own: a ball large enough to show 85°, of which a quarter is enough here.
#[test]
fn a_solved_light_gives_the_numbers_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let large = Circle::new(5.0, 5.0, 410.0);
    let pixel = |x: f64, y: f64| of_ball(large, x, y, &of_model).unwrap_or(LIGHT * 0.3);
    let pixels = (0..425).flat_map(|y| (0..425).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
    let picture: Vec<Rgb> = pixels.map(|(x, y)| pixel(x, y)).collect();
    let path = write(folder.path(), "large.png", &picture, 425);
    let light = Rgb([1.2, 1.0, 0.8]);
    let request = MatchRequest {
        mode: LightMode::SolvedLight,
        circle: Some(large),
        light: Some(light),
        ..MatchRequest::default()
    };
    assert_same(&path, &["--mode", "solved-light", "--circle", "5,5,410", "--light", "1.2,1,0.8"], &request);
}

#[test]
fn outlines_are_found_or_snapped_and_kept_with_their_uncertainty() {
    let folder = tempfile::tempdir().unwrap();
    let table = write(folder.path(), "table.png", &table(), 560);
    let photo = open(&table);
    let card = "480,5,70,50@0.9";
    let cards = MatchRequest { cards: vec![card.parse().unwrap()], ..MatchRequest::default() };
    let preset = folder.path().join("p.json");

    let snapped = snap_circle(&photo, Circle::new(124.0, 126.0, 96.0)).unwrap();
    let marks = ["--circle", "124,126,96", "--snap", "--card", card, "-o", preset.to_str().unwrap()];
    let found = assert_same(&table, &marks, &cards.clone().with_outline(&snapped));
    assert_eq!(found["outline"], serde_json::to_value(snapped).unwrap());
    assert!((found["request"]["circle"]["radius"].as_f64().unwrap() - BALL.radius).abs() < 0.2, "{found:#}");
    let Origin::Matched(recipe) = Preset::load(&preset).unwrap().preset.origin else { panic!("not matched") };
    assert_eq!(recipe.request.circle_uncertainty_px, Some(snapped.uncertainty_px));
    assert_eq!(recipe.solve_again(&photo, RgbSpace::LinRec709).unwrap().r[0].unwrap(), found["r"][0].as_f64().unwrap());

    let request = cards.with_outline(&find_ball(&photo).unwrap());
    assert_same(&table, &["--circle", "auto", "--card", card], &request);

    // Beside a reference, which is snapped as well, the other ball is the one to measure.
    let reference = snap_circle(&photo, Circle::new(338.0, 131.0, 98.0)).unwrap();
    let mut request = MatchRequest {
        mode: LightMode::ReferenceBall,
        reference_ball: Some("338,131,98@chromium".parse().unwrap()),
        ..MatchRequest::default()
    };
    request.reference_ball.as_mut().unwrap().circle = reference.circle;
    let request = request.with_outline(&find_ball_beside(&photo, &[reference.circle]).unwrap());
    let found = assert_same(&table, &["--circle", "auto", "--reference-ball", "338,131,98@chromium"], &request);
    assert!((found["outline"]["circle"]["x"].as_f64().unwrap() - BALL.x).abs() < 0.3, "{:#}", found["outline"]);
    assert_eq!(found["reference_outline"], serde_json::to_value(reference).unwrap());
}

#[test]
fn a_cylinder_gives_the_numbers_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let axis = Cylinder::new([20.0, 70.0], [280.0, 78.0], 60.5);
    let pixel = |x: f64, y: f64| {
        let card = (x > 290.0).then(|| LIGHT * 0.9);
        let body = || Body::Cylinder(axis).sine(x, y).map(|sine| (1.0 - sine * sine).max(0.0).sqrt());
        let metal = || body().map(|cosine| LIGHT.zip(of_model(cosine), |light, f| light * f));
        card.or_else(metal).unwrap_or(LIGHT * 0.3)
    };
    let picture: Vec<Rgb> =
        (0..150).flat_map(|y| (0..340).map(move |x| (x, y))).map(|(x, y)| blurred(x, y, &pixel)).collect();
    let path = write(folder.path(), "rod.png", &picture, 340);
    let card = "300,20,30,100@0.9";
    let cards = MatchRequest { cards: vec![card.parse().unwrap()], ..MatchRequest::default() };

    let given = MatchRequest { cylinder: Some(axis), ..cards.clone() };
    let found = assert_same(&path, &["--cylinder", "20,70,280,78,60.5", "--card", card], &given);
    assert!((found["h"][0].as_f64().unwrap() - H[0]).abs() < 0.02, "{found:#}");

    let snapped = snap_cylinder(&open(&path), Cylinder::new([20.0, 73.0], [280.0, 75.0], 57.0)).unwrap();
    let marks = ["--cylinder", "20,73,280,75,57", "--snap", "--card", card];
    let found = assert_same(&path, &marks, &cards.with_cylinder(&snapped));
    assert_eq!(found["outline"], serde_json::to_value(snapped).unwrap());
    assert!((snapped.cylinder.radius - 60.5).abs() < 0.2, "{snapped:?}");
}

#[test]
fn outlines_that_are_not_there_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let grey = write(folder.path(), "grey.png", &vec![Rgb::splat(0.5); 10_000], 100);
    let with = |marks: &[&'static str]| [&["match", grey.as_str(), "--card", "2,2,10,10@0.9"], marks].concat();
    let sentence = refusal(1, &with(&["--circle", "auto"]));
    assert!(sentence.contains("grey.png: no ball was found"), "{sentence}");
    assert!(refusal(1, &with(&["--circle", "50,50,30", "--snap"])).contains("no round outline"));
    assert!(refusal(1, &with(&["--cylinder", "20,20,80,20,9", "--snap"])).contains("no two parallel edges"));
    assert!(refusal(2, &with(&["--cylinder", "20,20,80,20"])).contains("x0,y0,x1,y1"));
    assert!(refusal(2, &with(&["--cylinder", "1,1,9,1,5", "--circle", "5,5,5"])).contains("cannot be used with"));
    assert!(refusal(2, &with(&["--snap"])).contains("--cylinder or --reference-ball"));
    assert!(refusal(2, &with(&["--circle", "auto", "--circle-uncertainty", "0.3"])).contains("has its own"));
    assert!(refusal(2, &with(&["--circle", "automatic"])).contains("x,y,radius"));
}
