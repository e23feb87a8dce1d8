//! How often does ± contain the truth, and how far off is a match, over many pictures?
//!
//! The ordinary tests run a fixed few. The whole study, 500 random pictures and every metal of the library in three
//! modes, is `cargo test --release --test photo_study -- --ignored --nocapture`; it prints what it finds.

#![expect(clippy::print_stdout, reason = "a study reports what it found")]

mod studio;

use edgewise::color::Rgb;
use edgewise::fresnel::CosTheta;
use edgewise::metal::{Metal, metal_by_name, preferred_metals};
use edgewise::photo::{Circle, LightMode, Match, MatchRequest, MirrorPair, ReferenceBall, snap_circle};
use edgewise::sample::{Camera, Tent, Truth};
use rayon::prelude::*;
use studio::{Studio, inside};

/// A seeded sequence of numbers in [−1, 1] (Knuth's MMIX generator).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A small picture of a ball of at least 100 pixels in radius with a card beside it.
fn small(metal: &'static str) -> Studio {
    Studio {
        metal,
        size: [266, 220],
        circle: Circle::new(110.0, 110.0, 104.0),
        card: [222.0, 80.0, 40.0, 60.0],
        rays: 2,
        ..Studio::default()
    }
}

/// Who placed the outline.
#[derive(Clone, Copy)]
enum Placed {
    /// A person, to half a pixel or so.
    ByHand,
    /// A person roughly, then the program.
    Snapped,
}

/// The values of a match that were found, with their ±, and the truth: r, then h, three channels each.
struct Outcome {
    found: [Option<f64>; 6],
    plus_minus: [Option<f64>; 6],
    truth: [f64; 6],
}

impl Outcome {
    fn of(found: &Match, truth: &Truth) -> Self {
        let six = |r: [Option<f64>; 3], h: [Option<f64>; 3]| [r[0], r[1], r[2], h[0], h[1], h[2]];
        let [r, h] = [truth.r.0, truth.h.0];
        Self {
            found: six(found.r, found.h),
            plus_minus: six(found.r_uncertainty, found.h_uncertainty),
            truth: [r[0], r[1], r[2], h[0], h[1], h[2]],
        }
    }

    /// How far off; a value that was not measured is off without bound.
    fn error(&self, index: usize) -> f64 {
        self.found[index].map_or(f64::INFINITY, |value| (value - self.truth[index]).abs())
    }

    fn is_covered(&self, index: usize) -> bool {
        self.plus_minus[index].is_some_and(|plus_minus| self.error(index) <= plus_minus)
    }
}

const VALUES: [&str; 6] = ["r red", "r green", "r blue", "h red", "h green", "h blue"];

/// A random metal in a random tent: uneven by up to 5 %, tinted, a card off by 2 % on a spot off by 3 %, 1 % noise.
fn random_picture(seed: u64, placed: Placed) -> Outcome {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let metals: Vec<_> = preferred_metals().collect();
    let index = ((random.next() + 1.0) / 2.0 * metals.len() as f64) as usize;
    let mut studio = small(&metals[index.min(metals.len() - 1)].id);
    studio.tent = Tent { top: 0.05 * random.next(), right: 0.05 * random.next(), lens_deg: 4.0, ..Tent::default() };
    studio.tent.tint = Rgb([1.0 + 0.3 * random.next(), 1.0, 1.0 + 0.3 * random.next()]);
    studio.circle = Circle::new(110.0 + random.next(), 110.0 + random.next(), 104.0 + 3.0 * random.next());
    studio.card_error = 1.0 + 0.02 * random.next() + 0.03 * random.next();
    studio.camera = Camera { exposure: 0.7, blur_px: 0.6 + 0.3 * random.next(), noise: 0.01, seed };
    let mut near = |px: f64| Circle {
        x: studio.circle.x + 0.7 * px * random.next(),
        y: studio.circle.y + 0.7 * px * random.next(),
        radius: studio.circle.radius + px * random.next(),
    };
    let photo = studio.photo();
    let request = match placed {
        Placed::ByHand => MatchRequest { circle: Some(near(0.7)), ..studio.request() },
        Placed::Snapped => {
            let rough = near(6.0);
            let by_hand = || MatchRequest { circle: Some(studio.circle), ..studio.request() };
            snap_circle(&photo, rough).map_or_else(|_| by_hand(), |outline| studio.request().with_outline(&outline))
        }
    };
    let found = edgewise::photo::solve(&photo, &request, edgewise::color::RgbSpace::LinRec709).unwrap();
    Outcome::of(&found, &studio.truth())
}

/// The share of pictures in which ± contains the truth, for each channel of r and h.
fn coverage(pictures: u64, placed: Placed) -> [f64; 6] {
    let all: Vec<_> = (0..pictures).into_par_iter().map(|seed| random_picture(seed, placed)).collect();
    let share = |i: usize| all.iter().filter(|outcome| outcome.is_covered(i)).count() as f64 / all.len() as f64;
    std::array::from_fn(share)
}

fn print(what: &str, shares: [f64; 6]) {
    let cells: Vec<String> =
        VALUES.iter().zip(shares).map(|(value, share)| format!("{value} {:.1} %", 100.0 * share)).collect();
    println!("{what}: ± contains the truth in {}", cells.join(", "));
}

#[test]
fn uncertainty_covers_the_truth_in_random_pictures() {
    for placed in [Placed::ByHand, Placed::Snapped] {
        let shares = coverage(8, placed);
        print("8 pictures", shares);
        let mean = shares.iter().sum::<f64>() / 6.0;
        assert!(mean >= 0.9, "{shares:?}");
    }
}

/// The bar of the project: 90 % of 500 pictures, in every channel of r and of h.
#[test]
#[ignore = "the full study of the test above: half a minute with --release"]
fn uncertainty_covers_the_truth_in_500_random_pictures() {
    for (placed, what) in [(Placed::ByHand, "500 pictures, by hand"), (Placed::Snapped, "500 pictures, snapped")] {
        let shares = coverage(500, placed);
        print(what, shares);
        assert!(shares.iter().all(|share| *share >= 0.9), "{what}");
    }
}

/// Mode C in even light.
fn by_card(metal: &'static Metal) -> Outcome {
    let studio = small(&metal.id);
    Outcome::of(&studio.solve(), &studio.truth())
}

/// Mode B in light that is uneven by more than a quarter.
fn by_reference(metal: &'static Metal) -> Outcome {
    let reference = Circle::new(326.0, 110.0, 102.0);
    let studio = Studio {
        tent: Tent { top: 0.3, right: 0.25, ..Tent::default() },
        size: [436, 220],
        card: [200.0, 2.0, 24.0, 24.0],
        reference: Some((reference, "chromium")),
        ..small(&metal.id)
    };
    let ball = ReferenceBall { circle: reference, metal: metal_by_name("chromium").unwrap().id.clone() };
    let request = MatchRequest { mode: LightMode::ReferenceBall, reference_ball: Some(ball), ..studio.request() };
    Outcome::of(&studio.solve_as(&request), &studio.truth())
}

/// Mode A: a card in the flat metal at 12° and at 82°, under a tinted light.
fn by_flat_mirror(metal: &'static Metal) -> Outcome {
    let card = |i: usize| [4.0 + 66.0 * i as f64, 4.0, 60.0, 60.0];
    let at =
        |angle_deg: f64| metal.reflectance(CosTheta::from_deg(angle_deg), edgewise::color::RgbSpace::LinRec709) * 0.9;
    let radiances = [Rgb::splat(0.9), at(12.0), Rgb::splat(0.9), at(82.0)];
    let tent = Tent { tint: Rgb([1.0, 0.8, 0.5]), ..Tent::default() };
    let studio = Studio {
        tent,
        patches: radiances.into_iter().enumerate().map(|(i, radiance)| (card(i), radiance)).collect(),
        ..small(&metal.id)
    };
    let pair = |i: usize, angle_deg| MirrorPair::new(inside(card(i)), inside(card(i + 1)), angle_deg).unwrap();
    let mirrors = vec![pair(0, 12.0), pair(2, 82.0)];
    let found = studio.solve_as(&MatchRequest { mode: LightMode::FlatMirror, mirrors, ..MatchRequest::default() });
    Outcome::of(&found, &studio.truth())
}

/// Errors of r and of h with their metal, the largest first; the three largest are printed.
fn errors(what: &str, metals: &[&'static Metal], of: fn(&'static Metal) -> Outcome) -> [Vec<(f64, &'static str)>; 2] {
    let outcomes: Vec<_> = metals.par_iter().map(|metal| (metal.id.as_str(), of(metal))).collect();
    [0, 1].map(|which| {
        let error = |outcome: &Outcome| (0..3).map(|i| outcome.error(3 * which + i)).fold(0.0, f64::max);
        let mut errors: Vec<_> = outcomes.iter().map(|(id, outcome)| (error(outcome), *id)).collect();
        errors.sort_by(|a, b| b.0.total_cmp(&a.0));
        let worst: Vec<String> = errors.iter().take(3).map(|(error, id)| format!("{error:.4} ({id})")).collect();
        println!("{what}, {} metals: {} off by at most {}", metals.len(), ["r", "h"][which], worst.join(", "));
        errors
    })
}

/// Fits over a ball know two colours and the shape that most metals have between them. Caesium is off by .04 in r and
/// .053 in h, zinc by .04 in h, every other metal by at most .011.
const HARD: [&str; 2] = ["Cs_Smith", "Zn_Querry"];

/// The bars of the project at 1 % noise and 100 pixels: A and even C r within .01 and h within .02, uneven B within .03;
/// the hard metals within twice the .03 where they are fitted over a ball.
fn assert_bars(metals: &[&'static Metal]) {
    let assert_within = |what: &str, of: fn(&'static Metal) -> Outcome, bars: [f64; 2], hard_bar: Option<f64>| {
        for (errors, bar) in errors(what, metals, of).into_iter().zip(bars) {
            let bar_of = |id: &str| hard_bar.filter(|_| HARD.contains(&id)).unwrap_or(bar);
            assert!(errors.iter().all(|(error, id)| *error < bar_of(id)), "{what}: {:?}", &errors[..1]);
        }
    };
    assert_within("mode A", by_flat_mirror, [0.01, 0.02], None);
    assert_within("mode B, uneven", by_reference, [0.03; 2], Some(0.06));
    assert_within("mode C, even", by_card, [0.01, 0.02], Some(0.06));
}

#[test]
fn three_metals_meet_the_bars() {
    assert_bars(&["gold", "titanium", "iron"].map(|name| metal_by_name(name).unwrap()));
}

#[test]
#[ignore = "the full study of the test above: every metal of the library"]
fn every_metal_meets_the_bars() {
    assert_bars(&preferred_metals().collect::<Vec<_>>());
}
