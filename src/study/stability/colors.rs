//! The cases of colours: linear RGB to L*a*b*, and CIEDE2000.

use std::sync::LazyLock;

use palette::color_difference::Ciede2000;

use super::curves::{OURS, TEXTBOOK};
use super::exact_color::{ExactLab, are_nearly_opposite, delta_e_2000};
use super::grid::{Axis, Case, Evaluations, Exactly, Where, evaluations};
use super::printed::LabAsPrinted;
use crate::color::{Lab, Rgb, RgbSpace};
use crate::kernel::{LabConversion, Level, Material, delta_e, delta_e_over};

/// The space of the colours that are converted.
const SPACE: RgbSpace = RgbSpace::LinRec709;

/// The crate of that name, which has the formula as printed, by arc tangents.
const PALETTE: &str = "palette";

static EXACT: LazyLock<ExactLab> = LazyLock::new(|| ExactLab::new(SPACE));

const RGB: [Axis; 3] = [Axis::Light("red"), Axis::Light("green"), Axis::Light("blue")];
const PAIR: [Axis; 2] = [Axis::Colour(["L1", "a1", "b1"]), Axis::Colour(["L2", "a2", "b2"])];

/// No channel below 0 or above 1.
const DISPLAYED: Where = |point| point.iter().all(|value| Axis::is_unit(*value));

/// L* from 0 to 100, a* and b* from −128 to 128.
const SEEN: Where = |point| {
    let is_seen = |lab: &[f64]| (0.0..=100.0).contains(&lab[0]) && lab[1..].iter().all(|x| x.abs() <= 128.0);
    point.chunks(3).all(is_seen)
};

pub(super) fn colors() -> Vec<Case> {
    vec![
        lab("lab-lightness", 0, |rgb| Some(EXACT.lightness(rgb))),
        lab("lab-a", 1, |rgb| Some(EXACT.a(rgb))),
        lab("lab-b", 2, |rgb| Some(EXACT.b(rgb))),
        Case::new("delta-e", &PAIR, (SEEN, |pair| Some(delta_e_2000(&pair[..3], &pair[3..]))))
            .jumping(|pair| are_nearly_opposite(&pair[..3], &pair[3..]))
            .way(OURS, |p, _| difference(p))
            .way(PALETTE, |p, _| difference_of_palette(p)),
    ]
}

/// One coordinate.
fn lab(quantity: &'static str, coordinate: usize, exact: Exactly) -> Case {
    let ours = LabConversion::new(SPACE);
    Case::new(quantity, &RGB, (DISPLAYED, exact))
        .way(OURS, move |p, _| {
            let [red, green, blue] = [0, 1, 2].map(|i| p[i][0]);
            let single = [red, green, blue].map(|channel| channel as f32);
            let mut out = [[f32::NAN; 1]; 3];
            let planes = single.each_ref().map(std::slice::from_ref);
            ours.over(Level::new(), planes, out.each_mut().map(|plane| &mut plane[..]));
            Evaluations {
                vectors: Some(out[coordinate][0]),
                scalar: ours.lab(single)[coordinate],
                double: ours.lab([red, green, blue])[coordinate],
            }
        })
        .way(TEXTBOOK, move |p, _| {
            let printed = Material::of_parameters(LabAsPrinted { space: SPACE }, [p[0], p[1], p[2]]);
            evaluations(&printed, 1.0, coordinate)
        })
}

/// L*, a* and b* of both.
fn two_colours(pair: &[Rgb]) -> [[f64; 3]; 2] {
    [0, 3].map(|first| std::array::from_fn(|i| pair[first + i][0]))
}

/// The 64 bits are the core's, which every study rests on.
fn difference(pair: &[Rgb]) -> Evaluations {
    let [x, y] = two_colours(pair);
    let [single_x, single_y] = [x, y].map(|lab| lab.map(|value| value as f32));
    let mut out = [f32::NAN];
    let planes = [&single_x, &single_y].map(|lab| lab.each_ref().map(std::slice::from_ref));
    delta_e_over(Level::new(), planes[0], planes[1], &mut out);
    let [core_x, core_y] = [x, y].map(|[lightness, a, b]| Lab { lightness, a, b });
    Evaluations {
        vectors: Some(out[0]),
        scalar: delta_e(single_x, single_y),
        double: crate::color::delta_e_2000(core_x, core_y),
    }
}

fn difference_of_palette(pair: &[Rgb]) -> Evaluations {
    type Of<T> = palette::Lab<palette::white_point::D65, T>;
    let [x, y] = two_colours(pair);
    let [single_x, single_y] = [x, y].map(|lab| lab.map(|value| value as f32)).map(|[l, a, b]| Of::new(l, a, b));
    let [double_x, double_y] = [x, y].map(|[l, a, b]| Of::new(l, a, b));
    Evaluations { vectors: None, scalar: single_x.difference(single_y), double: double_x.difference(double_y) }
}
