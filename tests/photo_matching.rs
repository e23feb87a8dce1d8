//! Does a match find the r and h that a picture was made with?

mod studio;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::metal::metal_by_name;
use edgewise::photo::{
    Area, Card, Circle, Cylinder, LightMode, MatchError, MatchRequest, MirrorPair, Photo, Recipe, ReferenceBall,
    WarningCode, find_ball, snap_circle, snap_cylinder, solve,
};
use edgewise::sample::{Camera, Tent};
use studio::{Stored, Studio, codes, covered, inside, largest_error};

/// The bar of the project: at R ≥ 100 px and 1 % noise, mode C in even light finds r within .01 and h within .02, warns
/// of nothing but the gamut, and its ± holds the truth.
fn meets_the_bar(studio: &Studio) {
    let metal = studio.metal;
    let (found, truth) = (studio.solve(), studio.truth());
    let (r, h) = (largest_error(found.r, truth.r), largest_error(found.h, truth.h));
    println!("{metal}: r off by {r:.4}, h by {h:.4}");
    assert!(r < 0.01 && h < 0.02, "{metal}: {r} {h}\n{found:#?}");
    assert!(codes(&found).iter().all(|code| *code == WarningCode::Gamut), "{metal}: {:?}", found.warnings);
    assert_eq!(covered(found.r, found.r_uncertainty, truth.r), 3, "{metal}");
    assert_eq!(covered(found.h, found.h_uncertainty, truth.h), 3, "{metal}");
}

#[test]
fn an_even_tent_gives_r_and_h() {
    for metal in ["chromium", "gold", "copper", "aluminium", "titanium", "iron", "tungsten", "nickel"] {
        let studio = Studio { metal, ..Studio::default() };
        meets_the_bar(&studio);
    }
}

/// A cylinder shows the angles of a ball in one direction, and is held to the same bar.
#[test]
fn a_cylinder_gives_r_and_h() {
    let axis = Cylinder::new([20.0, 122.0], [240.0, 134.0], 104.0);
    for metal in ["chromium", "gold", "copper"] {
        let studio = Studio { metal, cylinder: Some(axis), ..Studio::default() };
        meets_the_bar(&studio);
    }
}

#[test]
fn a_rough_cylinder_snaps_to_its_edges() {
    let axis = Cylinder::new([20.0, 122.0], [240.0, 134.0], 104.0);
    let studio = Studio { cylinder: Some(axis), ..Studio::default() };
    let rough = Cylinder::new([20.0, 127.0], [240.0, 130.0], 97.0);
    let found = snap_cylinder(&studio.photo(), rough).unwrap();
    assert!((found.cylinder.radius - 104.0).abs() < 0.15 && found.warning().is_none(), "{found:?}");
    let request = MatchRequest { cylinder: None, ..studio.request() }.with_cylinder(&found);
    assert!(largest_error(studio.solve_as(&request).h, studio.truth().h) < 0.03);
    let unsnapped = MatchRequest { cylinder: Some(rough), ..studio.request() };
    assert!(codes(&studio.solve_as(&unsnapped)).contains(&WarningCode::Geometry));
    let both = MatchRequest { circle: Some(studio.circle), ..studio.request() };
    assert_eq!(solve(&studio.photo(), &both, RgbSpace::LinRec709), Err(MatchError::TwoBodies));
}

/// A reference ball serves a cylinder: where their normals agree they mirror the same surroundings.
#[test]
fn a_reference_ball_serves_a_cylinder() {
    let reference = Circle::new(392.0, 128.0, 104.0);
    let studio = Studio {
        metal: "copper",
        tent: Tent { top: 0.3, right: 0.2, ..Tent::default() },
        size: [500, 256],
        cylinder: Some(Cylinder::new([20.0, 128.0], [270.0, 128.0], 104.0)),
        card: [4.0, 2.0, 16.0, 16.0],
        reference: Some((reference, "chromium")),
        ..Studio::default()
    };
    let ball = ReferenceBall { circle: reference, metal: metal_by_name("chromium").unwrap().id.clone() };
    let request = MatchRequest { mode: LightMode::ReferenceBall, reference_ball: Some(ball), ..studio.request() };
    let (found, truth) = (studio.solve_as(&request), studio.truth());
    assert!(largest_error(found.r, truth.r) < 0.03 && largest_error(found.h, truth.h) < 0.03, "{found:?}");
}

/// A tinted light leaves r and h alone: the card carries the same tint.
#[test]
fn tinted_light_cancels() {
    let tent = Tent { tint: Rgb([1.1, 0.9, 0.6]), ..Tent::default() };
    let (plain, tinted) = (Studio::default().solve(), Studio { tent, ..Studio::default() }.solve());
    assert!(largest_error(tinted.r, plain.complete_r().unwrap()) < 0.005);
    assert!(largest_error(tinted.h, plain.complete_h().unwrap()) < 0.01);
}

#[test]
fn the_lens_in_the_middle_is_left_out() {
    let studio = Studio { tent: Tent { lens_deg: 8.0, ..Tent::default() }, ..Studio::default() };
    assert!(largest_error(studio.solve().r, studio.truth().r) < 0.01);
}

/// A lamp shows in the ball and lights the card by its form factor; the fit leaves its reflection out.
#[test]
fn a_lamp_changes_only_what_the_card_sees_of_it() {
    let studio = Studio { tent: Tent { lamp: 2.0, ..Tent::default() }, ..Studio::default() };
    let ratio = studio.solve().r[1].unwrap() / studio.truth().r[1];
    assert!((0.93..1.0).contains(&ratio), "{ratio}");
}

#[test]
fn a_near_camera_changes_little() {
    let studio = Studio { camera_distance: 8.0, ..Studio::default() };
    let (found, truth) = (studio.solve(), studio.truth());
    assert!(largest_error(found.r, truth.r) < 0.01 && largest_error(found.h, truth.h) < 0.03, "{found:?}");
}

/// Mode A: the ratio of two areas, whatever the light.
#[test]
fn a_flat_mirror_gives_r_and_h_by_ratio() {
    let metal = metal_by_name("gold").unwrap();
    let tent = Tent { tint: Rgb([1.0, 0.8, 0.5]), ..Tent::default() };
    let mut studio = Studio { metal: "gold", tent, ..Studio::default() };
    let cards = [[4.0, 4.0, 60.0, 60.0], [70.0, 4.0, 60.0, 60.0], [136.0, 4.0, 60.0, 60.0], [202.0, 4.0, 60.0, 60.0]];
    let at = |angle_deg: f64| {
        let cos = edgewise::fresnel::CosTheta::from_deg(angle_deg);
        metal.reflectance(cos, RgbSpace::LinRec709) * 0.9
    };
    let radiances = [Rgb::splat(0.9), at(12.0), Rgb::splat(0.9), at(82.0)];
    studio.patches = cards.into_iter().zip(radiances).collect();
    let pair = |i: usize, angle_deg| MirrorPair::new(inside(cards[i]), inside(cards[i + 1]), angle_deg).unwrap();
    let mode = LightMode::FlatMirror;
    let both = MatchRequest { mode, mirrors: vec![pair(0, 12.0), pair(2, 82.0)], ..MatchRequest::default() };
    let (found, truth) = (studio.solve_as(&both), studio.truth());
    assert!(largest_error(found.r, truth.r) < 0.01 && largest_error(found.h, truth.h) < 0.02, "{found:?}");
    assert_eq!(covered(found.r, found.r_uncertainty, truth.r), 3, "{found:?}");
    let one = MatchRequest { mode, mirrors: vec![pair(2, 82.0)], ..MatchRequest::default() };
    let found = studio.solve_as(&one);
    assert_eq!(found.r, [None; 3]);
    assert!(largest_error(found.h, truth.h) < 0.02, "{found:?}");
    let between = MatchRequest { mode, mirrors: vec![pair(2, 60.0)], ..MatchRequest::default() };
    let error = solve(&studio.photo(), &between, RgbSpace::LinRec709).unwrap_err();
    assert!(matches!(error, MatchError::MirrorAngle { .. }), "{error}");
}

/// Mode B: uneven surroundings cancel.
#[test]
fn a_reference_ball_cancels_uneven_light() {
    let reference = Circle::new(380.0, 128.0, 104.0);
    let studio = Studio {
        metal: "copper",
        tent: Tent { top: 0.35, right: 0.25, ..Tent::default() },
        size: [500, 256],
        card: [236.0, 2.0, 36.0, 36.0],
        reference: Some((reference, "chromium")),
        ..Studio::default()
    };
    let ball = ReferenceBall { circle: reference, metal: metal_by_name("chromium").unwrap().id.clone() };
    let request = MatchRequest { mode: LightMode::ReferenceBall, reference_ball: Some(ball), ..studio.request() };
    let (found, truth) = (studio.solve_as(&request), studio.truth());
    assert!(largest_error(found.r, truth.r) < 0.03 && largest_error(found.h, truth.h) < 0.03, "{found:?}");
    assert!(!codes(&found).contains(&WarningCode::Environment), "{:?}", found.warnings);
}

/// Mode D: h only, from a backdrop beside the rim.
#[test]
fn a_backdrop_gives_h_only() {
    let studio = Studio::default();
    let backdrop = Some(Area::rectangle(244.0, 4.0, 60.0, 60.0));
    let request = MatchRequest { mode: LightMode::Backdrop, backdrop, ..studio.request() };
    let found = studio.solve_as(&request);
    assert_eq!(found.r, [None; 3]);
    assert!(largest_error(found.h, studio.truth().h) < 0.05, "{:?} {:?}", found.h, studio.truth().h);
}

/// Mode E: the outermost rim is white, whatever the metal.
#[test]
fn a_large_sharp_ball_gives_the_light_itself() {
    let studio = Studio {
        circle: Circle::new(430.0, 430.0, 420.0),
        size: [860, 860],
        camera: Camera { exposure: 0.37, blur_px: 0.3, noise: 0.01, seed: 5 },
        card: [2.0, 2.0, 20.0, 20.0],
        rays: 1,
        ..Studio::default()
    };
    let request = MatchRequest { mode: LightMode::SolvedLight, cards: Vec::new(), ..studio.request() };
    let (found, truth) = (studio.solve_as(&request), studio.truth());
    assert!((found.light[1].unwrap() / 0.37 - 1.0).abs() < 0.03, "{:?}", found.light);
    assert!(largest_error(found.r, truth.r) < 0.02 && largest_error(found.h, truth.h) < 0.03, "{found:?}");
    let small = Studio::default();
    let error =
        solve(&small.photo(), &MatchRequest { mode: LightMode::SolvedLight, ..small.request() }, RgbSpace::LinRec709);
    assert!(error.unwrap_err().to_string().contains("400 pixels"));
}

/// Mode F: whatever light is set is taken, and called an estimate.
#[test]
fn by_eye_is_an_estimate() {
    let studio = Studio::default();
    let light = Some(Rgb::splat(0.7));
    let found = studio.solve_as(&MatchRequest { mode: LightMode::ByEye, light, ..studio.request() });
    assert!(found.is_estimate && codes(&found).contains(&WarningCode::Estimate));
    assert!(largest_error(found.r, studio.truth().r) < 0.01);
}

/// The bar of the project: a camera's tone curve is undone to .018 in r and .012 in h by six neutral patches.
#[test]
fn a_grey_scale_undoes_the_tone_curve() {
    let step = |i: usize| [258.0, 2.0 + 42.0 * i as f64, 48.0, 40.0];
    let neutrals = Card::COLOR_CHECKER_NEUTRALS.into_iter().enumerate();
    let studio = Studio {
        metal: "copper",
        patches: neutrals.clone().map(|(i, y)| (step(i), Rgb::splat(y))).collect(),
        stored: Stored::Jpeg,
        ..Studio::default()
    };
    let greys: Vec<Card> = neutrals.map(|(i, reflectance)| Card::neutral(inside(step(i)), reflectance)).collect();
    let cards = vec![greys[0]];
    let plain = MatchRequest { cards: cards.clone(), ..studio.request() };
    let scaled = MatchRequest { cards, greys, ..studio.request() };
    let (plain, scaled, truth) = (studio.solve_as(&plain), studio.solve_as(&scaled), studio.truth());
    println!("without {:?} with {:?} truth {truth:?}", plain.r, scaled.r);
    assert!(plain.is_estimate && largest_error(plain.r, truth.r) > 0.05);
    assert!(!scaled.is_estimate);
    // Copper's red is brighter than the brightest patch: the curve has to reach beyond it, which is said.
    assert!(codes(&scaled).contains(&WarningCode::Assumed), "{:?}", scaled.warnings);
    assert_eq!(covered(scaled.r, scaled.r_uncertainty, truth.r), 3, "{:?} {:?}", scaled.r, scaled.r_uncertainty);
    for (channel, limit) in [(0, 0.04), (1, 0.018), (2, 0.018)] {
        let (r, h) = (scaled.r[channel].unwrap() - truth.r[channel], scaled.h[channel].unwrap() - truth.h[channel]);
        assert!(r.abs() < limit && h.abs() < limit, "{channel}: r {r:+.4} h {h:+.4}");
    }
}

#[test]
fn the_outline_is_found_on_a_rendered_ball() {
    let studio = Studio::default();
    let photo = studio.photo();
    let rough = Circle::new(135.0, 124.0, 102.0);
    for found in [snap_circle(&photo, rough).unwrap(), find_ball(&photo).unwrap()] {
        let Circle { x, y, radius } = found.circle;
        let error = (x - 130.0).hypot(y - 128.0).max((radius - 110.0).abs());
        assert!(error < 0.1, "{found:?}");
    }
}

#[test]
fn hand_picks_read_areas() {
    let studio = Studio::default();
    let facing = Some(Area::disc(130.0, 128.0, 20.0));
    let found = studio.solve_as(&MatchRequest { circle: None, facing, ..studio.request() });
    assert!(largest_error(found.r, studio.truth().r) < 0.01);
    assert_eq!((found.h, found.h_uncertainty), ([None; 3], [None; 3]), "nothing shows h");
}

#[test]
fn a_pick_on_a_ball_knows_its_angle() {
    let studio = Studio::default();
    let edge = Some(Area::rectangle(225.0, 118.0, 11.0, 20.0));
    let found = studio.solve_as(&MatchRequest { edge, ..studio.request() });
    assert!(largest_error(found.h, studio.truth().h) < 0.04, "{:?} {:?}", found.h, studio.truth().h);
}

#[test]
fn other_spaces_show_the_same_colour() {
    let studio = Studio { metal: "gold", ..Studio::default() };
    let (photo, request) = (studio.photo(), studio.request());
    let narrow = solve(&photo, &request, RgbSpace::LinRec709).unwrap();
    let wide = solve(&photo, &request, RgbSpace::AcesCg).unwrap();
    let converted = RgbSpace::LinRec709.convert(narrow.complete_r().unwrap(), RgbSpace::AcesCg);
    assert!(largest_error(wide.r, converted) < 1e-12);
}

#[test]
fn the_recipe_gives_the_same_numbers_again() {
    let studio = Studio::default();
    let photo = studio.photo();
    let found = solve(&photo, &studio.request(), RgbSpace::LinRec709).unwrap();
    let recipe = found.recipe(&photo);
    let json = serde_json::to_string(&recipe).unwrap();
    let again: Recipe = serde_json::from_str(&json).unwrap();
    assert_eq!(again, recipe);
    assert_eq!(again.solve_again(&photo, RgbSpace::LinRec709).unwrap(), found);
}

#[test]
fn what_is_not_marked_is_said() {
    let photo = Photo::from_linear("grey", 8, 8, vec![[0.5; 3]; 64]);
    let solve_with = |request: MatchRequest| solve(&photo, &request, RgbSpace::LinRec709).unwrap_err();
    assert!(solve_with(MatchRequest::default()).to_string().contains("needs a card"));
    let cards = vec!["1,1,4,4@0.9".parse().unwrap()];
    assert_eq!(solve_with(MatchRequest { cards: cards.clone(), ..MatchRequest::default() }), MatchError::NothingMarked);
    let outside = MatchRequest { cards, circle: Some(Circle::new(100.0, 100.0, 5.0)), ..MatchRequest::default() };
    assert_eq!(solve_with(outside), MatchError::NoPixels { what: "ball" });
    for mode in LightMode::ALL {
        let error = solve_with(MatchRequest { mode, ..MatchRequest::default() });
        assert!(matches!(error, MatchError::ModeNotMarked { .. }), "{mode}: {error}");
    }
}
