//! Is every trap warned of, and nothing else? For each rail one picture that triggers it and one that does not.

mod studio;

use edgewise::color::{Rgb, RgbSpace};
use edgewise::metal::{ReflectanceTable, metal_by_name};
use edgewise::photo::{Card, Circle, MatchRequest, Photo, Warning, WarningCode, solve};
use edgewise::sample::{Camera, Tent};
use studio::{Stored, Studio, codes, inside, largest_error};

const DEFAULT: fn() -> Studio = Studio::default;

fn with_exposure(exposure: f64) -> Camera {
    Camera { exposure, ..DEFAULT().camera }
}

#[test]
fn an_honest_picture_warns_of_nothing() {
    assert_eq!(DEFAULT().codes(), []);
    assert_eq!(Studio { stored: Stored::Png, ..DEFAULT() }.codes(), []);
}

/// Gold's red exceeds white: at this exposure it alone is clipped, and alone has no value.
#[test]
fn a_clipped_channel_has_no_value() {
    let studio = Studio { metal: "gold", camera: with_exposure(0.97), stored: Stored::Png, ..DEFAULT() };
    let found = studio.solve();
    assert!(codes(&found).contains(&WarningCode::Clipped), "{:?}", found.warnings);
    assert_eq!((found.r[0], found.r_uncertainty[0]), (None, None));
    assert!(found.r[1].is_some() && found.r[2].is_some());
    let wide = solve(&studio.photo(), &studio.request(), RgbSpace::AcesCg).unwrap();
    assert_eq!(wide.r, [None; 3], "another space mixes the channels");
    let darker = Studio { camera: with_exposure(0.7), ..studio };
    assert!(!darker.codes().contains(&WarningCode::Clipped));
}

#[test]
fn a_clipped_card_says_nothing_of_white() {
    let found = Studio { camera: with_exposure(1.2), stored: Stored::Png, ..DEFAULT() }.solve();
    assert!(codes(&found).contains(&WarningCode::Clipped));
    assert_eq!((found.r, found.h), ([None; 3], [None; 3]));
}

/// Where no pixel is a number there is none of r and h, of noise or of what is left over either, and JSON says `null`.
#[test]
fn a_channel_without_a_usable_pixel_has_no_numbers() {
    let studio = DEFAULT();
    let photo = studio.photo();
    let without = |radius: f64| {
        let at = |x: u32, y: u32| {
            let rho = studio.circle.rho(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let rgb = photo.pixel(x, y).unwrap().rgb.0.map(|value| value as f32);
            if rho < radius { [f32::NAN; 3] } else { rgb }
        };
        let pixels = (0..256).flat_map(|y| (0..310).map(move |x| (x, y))).map(|(x, y)| at(x, y)).collect();
        let photo = Photo::from_linear("holes", 310, 256, pixels);
        solve(&photo, &studio.request(), RgbSpace::LinRec709).unwrap()
    };
    let is_said = |found: &edgewise::photo::Match, place: &str| {
        found
            .warnings
            .iter()
            .any(|warning| warning.message.contains(place) && warning.message.contains("nothing is measured"))
    };
    let found = without(1.1);
    assert_eq!((found.r, found.h, found.noise, found.residual), ([None; 3], [None; 3], [None; 3], [None; 3]));
    assert!(is_said(&found, "middle of the ball") && is_said(&found, "rim of the ball"), "{:?}", found.warnings);
    let json = serde_json::to_value(&found).unwrap();
    assert_eq!((&json["noise"][0], &json["residual"][2]), (&serde_json::Value::Null, &serde_json::Value::Null));
    let found = without(0.7);
    assert!(found.h[1].is_some() && found.noise[1].is_some() && found.residual[1].is_some(), "{found:?}");
    assert!(is_said(&found, "middle of the ball") && !is_said(&found, "rim of the ball"), "{:?}", found.warnings);
    assert!(!is_said(&without(0.0), "ball"));
}

#[test]
fn a_picture_drowned_in_noise_is_too_dark() {
    let dark = Camera { exposure: 0.01, noise: 0.03, ..DEFAULT().camera };
    assert!(Studio { camera: dark, ..DEFAULT() }.codes().contains(&WarningCode::Black));
    let dim = Camera { exposure: 0.01, noise: 0.0005, ..DEFAULT().camera };
    assert!(!Studio { camera: dim, ..DEFAULT() }.codes().contains(&WarningCode::Black));
}

/// Below 12 code values of 255 a picture holds steps, not tones, however little noise there is.
#[test]
fn a_picture_of_few_codes_is_too_dark() {
    let exposed = |exposure| {
        let camera = Camera { exposure, noise: 0.0, ..DEFAULT().camera };
        Studio { camera, stored: Stored::Png, ..DEFAULT() }.codes()
    };
    assert!(exposed(0.003).contains(&WarningCode::Black));
    assert!(!exposed(0.02).contains(&WarningCode::Black));
}

#[test]
fn a_small_ball_gives_h_of_low_confidence() {
    let ball = |radius| Studio { circle: Circle::new(130.0, 128.0, radius), ..DEFAULT() };
    assert!(ball(50.0).codes().contains(&WarningCode::SmallBall));
    assert!(!ball(64.0).codes().contains(&WarningCode::SmallBall));
}

#[test]
fn uneven_surroundings_are_seen_around_the_ball() {
    let side = |right| Studio { tent: Tent { right, ..Tent::default() }, ..DEFAULT() };
    assert!(side(0.25).codes().contains(&WarningCode::Environment));
    assert!(!side(0.02).codes().contains(&WarningCode::Environment));
}

/// A ball of microfacets that lean up to a slope, under a lamp with sharp edges in an otherwise even tent.
fn under_a_lamp(slope: f64) -> Photo {
    const FACETS: u32 = 48;
    let studio = DEFAULT();
    let curve = ReflectanceTable::of(metal_by_name(studio.metal).unwrap());
    let [width, height] = studio.size;
    let light = |direction: [f64; 3]| {
        let toward_lamp = -0.6 * direction[0] + 0.5 * direction[1] + 0.62 * direction[2];
        if toward_lamp > 0.96 { 3.0 } else { 1.0 }
    };
    let white = studio.photo();
    let pixel = |x: u32, y: u32| {
        let [right, down] = [
            (f64::from(x) + 0.5 - studio.circle.x) / studio.circle.radius,
            (f64::from(y) + 0.5 - studio.circle.y) / studio.circle.radius,
        ];
        let sine2 = right * right + down * down;
        if sine2 >= 1.0 {
            return white.pixel(x, y).unwrap().rgb.0.map(|value| value as f32);
        }
        let normal = [right, -down, (1.0 - sine2).sqrt()];
        let facet = |index: u32| {
            // A spiral fills the disc of slopes evenly (Vogel 1979).
            let (share, turn) = ((f64::from(index) + 0.5) / f64::from(FACETS), 2.399_963 * f64::from(index));
            let lean = [slope * share.sqrt() * turn.cos(), slope * share.sqrt() * turn.sin(), 0.0];
            let [x, y, z] = [0, 1, 2].map(|i| normal[i] + lean[i]);
            let length = (x * x + y * y + z * z).sqrt();
            let [x, y, z] = [x / length, y / length, z / length];
            curve.at(z) * light([2.0 * z * x, 2.0 * z * y, 2.0 * z * z - 1.0])
        };
        let sum = (0..FACETS).map(facet).fold(Rgb::BLACK, |sum, radiance| sum + radiance);
        (sum * (0.7 / f64::from(FACETS))).0.map(|value| value as f32)
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
    Photo::from_linear("lamp", width, height, pixels)
}

/// Where a lamp is mirrored, a rough metal shows a glow; a polished one shows its edges.
#[test]
fn a_blurred_reflection_may_be_a_rough_metal() {
    let says_rough = |slope: f64| {
        let found = solve(&under_a_lamp(slope), &DEFAULT().request(), RgbSpace::LinRec709).unwrap();
        codes(&found).contains(&WarningCode::Rough)
    };
    assert!(says_rough(0.15));
    assert!(!says_rough(0.0));
    let lens = Studio { tent: Tent { lens_deg: 8.0, lamp: 2.0, ..Tent::default() }, ..DEFAULT() };
    assert!(!lens.codes().contains(&WarningCode::Rough));
}

#[test]
fn a_rim_that_mirrors_a_dark_backdrop_shows_no_h() {
    let backdrop = |limit| Studio { tent: Tent { dark_beyond_deg: limit, ..Tent::default() }, ..DEFAULT() };
    let found = backdrop(Some(146.0)).solve();
    assert!(found.warnings.iter().any(|warning| warning.message.contains("backdrop")), "{:?}", found.warnings);
    assert_eq!(found.h, [None; 3]);
    assert!(found.r[0].is_some());
    assert!(backdrop(None).solve().h[0].is_some());
    // Zinc is darker at the rim by itself.
    let zinc = Studio { metal: "zinc", ..DEFAULT() };
    assert!(largest_error(zinc.solve().h, zinc.truth().h) < 0.05, "{:?}", zinc.solve());
}

/// Rings, so that no sector of the ball is brighter than another: only the scatter within the sectors tells.
#[test]
fn a_patchy_reflection_is_seen_in_the_scatter() {
    let says = |strength| {
        let (studio, photo) = (DEFAULT(), with_rings(&DEFAULT(), strength));
        let found = solve(&photo, &studio.request(), RgbSpace::LinRec709).unwrap();
        found.warnings.iter().any(|warning| warning.message.contains("patchy"))
    };
    assert!(says(0.1));
    assert!(!says(0.005));
}

/// The studio's picture, its ball multiplied by 1 ± `strength` in rings of 12 pixels.
fn with_rings(studio: &Studio, strength: f64) -> Photo {
    let [width, height] = studio.size;
    let circle = studio.circle;
    let ring = |at: usize| {
        let [x, y] = [at % width as usize, at / width as usize].map(|pixel| pixel as f64 + 0.5);
        let distance = (x - circle.x).hypot(y - circle.y);
        let sign = if (distance / 12.0) as u32 % 2 == 0 { 1.0 } else { -1.0 };
        if distance < circle.radius { 1.0 + sign * strength } else { 1.0 }
    };
    let linear = studio.picture().into_iter().enumerate().map(|(at, rgb)| (rgb * ring(at)).0.map(|value| value as f32));
    Photo::from_linear("rings", width, height, linear.collect())
}

#[test]
fn two_colours_in_a_card_are_seen() {
    let studio = Studio { patches: vec![([258.0, 100.0, 18.0, 60.0], Rgb::splat(0.5))], ..DEFAULT() };
    assert!(studio.codes().contains(&WarningCode::Multimodal));
}

/// A card labelled half as bright as it is halves r and h: no n and k reach so dark a rim.
#[test]
fn what_no_material_reaches_is_said() {
    let studio = DEFAULT();
    let labelled = |reflectance| {
        let cards = vec![Card { reflectance, ..studio.card() }];
        codes(&studio.solve_as(&MatchRequest { cards, ..studio.request() }))
    };
    assert!(labelled(1.0).iter().all(|code| *code != WarningCode::Infeasible));
    assert!(labelled(0.45).contains(&WarningCode::Infeasible));
}

/// Silver under a card that reflects less than its label says is brighter than a mirror.
#[test]
fn a_curve_beyond_everything_is_said() {
    let says = |card_error| {
        let studio = Studio { metal: "silver", card_error, camera: with_exposure(0.5), ..DEFAULT() };
        studio.solve().warnings.iter().any(|warning| warning.message.contains("leaves 0 to 1"))
    };
    assert!(says(0.8));
    assert!(!says(1.0));
}

#[test]
fn marks_that_leave_the_picture_or_miss_the_edge_are_said() {
    let cut = Studio { circle: Circle::new(96.0, 128.0, 110.0), ..DEFAULT() };
    assert!(cut.codes().contains(&WarningCode::Geometry));
    let studio = DEFAULT();
    let too_small = MatchRequest { circle: Some(Circle::new(130.0, 128.0, 100.0)), ..studio.request() };
    assert!(codes(&studio.solve_as(&too_small)).contains(&WarningCode::Geometry));
    let half_outside = vec![Card::neutral("290,100,40,40".parse().unwrap(), 0.9)];
    let found = studio.solve_as(&MatchRequest { cards: half_outside, ..studio.request() });
    assert!(codes(&found).contains(&WarningCode::Geometry));
}

/// A picture drawn out sideways: the outline is an ellipse.
#[test]
fn an_ellipse_is_said() {
    let studio = DEFAULT();
    let (photo, request) = (studio.photo(), studio.request());
    let circle = studio.circle;
    let drawn_out = |factor: f64| {
        let column = |x: u32| circle.x + (f64::from(x) + 0.5 - circle.x) / factor - 0.5;
        let at = |x: u32, y: u32| {
            let (left, share) = (column(x).floor(), column(x) - column(x).floor());
            let pixel = |column: f64| photo.pixel(column.clamp(0.0, 309.0) as u32, y).unwrap().rgb;
            pixel(left).lerp(pixel(left + 1.0), share).0.map(|value| value as f32)
        };
        let pixels = (0..256).flat_map(|y| (0..310).map(move |x| (x, y))).map(|(x, y)| at(x, y)).collect();
        Photo::from_linear("drawn out", 310, 256, pixels)
    };
    let says_ellipse = |photo: &Photo| {
        let found = solve(photo, &request, RgbSpace::LinRec709).unwrap();
        found.warnings.iter().any(|warning| warning.message.contains("ellipse"))
    };
    assert!(says_ellipse(&drawn_out(1.05)));
    assert!(!says_ellipse(&drawn_out(1.0)));
}

/// Copper's red is brighter than a white patch of .9, titanium is not.
#[test]
fn metals_brighter_than_the_grey_scale_are_said() {
    let step = |i: usize| [258.0, 2.0 + 42.0 * i as f64, 48.0, 40.0];
    let said = |metal| {
        let neutrals = Card::COLOR_CHECKER_NEUTRALS.into_iter().enumerate();
        let patches = neutrals.clone().map(|(i, y)| (step(i), Rgb::splat(y))).collect();
        let studio = Studio { metal, patches, stored: Stored::Jpeg, ..DEFAULT() };
        let greys: Vec<Card> = neutrals.map(|(i, reflectance)| Card::neutral(inside(step(i)), reflectance)).collect();
        studio.solve_as(&MatchRequest { cards: Vec::new(), greys, ..studio.request() }).warnings
    };
    let is_said =
        |warnings: &[Warning]| warnings.iter().any(|warning| warning.message.contains("brightest grey patch"));
    assert!(is_said(&said("copper")));
    let titanium = said("titanium");
    assert!(!is_said(&titanium), "{titanium:?}");
}

#[test]
fn a_tone_curve_makes_an_estimate() {
    let found = Studio { stored: Stored::Jpeg, ..DEFAULT() }.solve();
    assert!(found.is_estimate && codes(&found).contains(&WarningCode::Estimate));
    assert!(!DEFAULT().solve().is_estimate);
}

#[test]
fn colours_beyond_the_space_are_kept_and_said() {
    let gold = Studio { metal: "gold", ..DEFAULT() };
    let found = gold.solve();
    assert!(found.r[0].unwrap() > 1.0 && codes(&found).contains(&WarningCode::Gamut));
    let wide = solve(&gold.photo(), &gold.request(), RgbSpace::AcesCg).unwrap();
    assert!(!codes(&wide).contains(&WarningCode::Gamut), "{:?}", wide.warnings);
}

#[test]
fn every_warning_is_a_sentence() {
    let found = Studio { stored: Stored::Jpeg, circle: Circle::new(96.0, 128.0, 50.0), ..DEFAULT() }.solve();
    for warning in &found.warnings {
        assert!(warning.message.ends_with('.') && warning.message.len() < 200, "{}", warning.message);
    }
}
