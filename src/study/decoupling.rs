//! Does one parameter leave what the other means alone? (paper section 6)

use serde::Serialize;

use super::Contestants;
use super::parameters::{Pair, Parameters};
use crate::color::{Lab, Rgb, RgbSpace, delta_e_2000, delta_e_rgb};
use crate::fresnel::CosTheta;

/// What is swept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecouplingOptions {
    /// How far r falls, and how far the edge parameter falls; for n and k, the share of the value.
    pub amount: f64,
}

impl Default for DecouplingOptions {
    fn default() -> Self {
        Self { amount: 0.1 }
    }
}

/// Which parameter moves while the other is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Swept {
    /// r (or n) falls, the edge parameter is held.
    First,
    /// The edge parameter (h, t, g or k) falls, r (or n) is held.
    Edge,
}

/// Steps of a sweep.
pub const SWEEP_STEPS: usize = 20;

/// Both sweeps and the cross-talk of a material, for the four descriptions.
#[derive(Clone, Debug)]
pub struct Decoupling {
    /// The material.
    pub name: String,
    /// The space of everything.
    pub space: RgbSpace,
    /// For each of [`Parameters::ALL`], r swept and the edge parameter swept.
    pub sweeps: Vec<Sweep>,
    /// For each of [`Parameters::ALL`], the colour that a grey edge parameter takes on.
    pub cross_talk: Vec<CrossTalkRow>,
}

/// One parameter moved while the other is held.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Which parameters.
    pub parameters: Parameters,
    /// Which of them moves.
    pub swept: Swept,
    /// One row for each step; the last is the material itself.
    pub rows: Vec<DecouplingRow>,
    /// How many numbers along the sweep had no meaning and were limited.
    pub left_domain: usize,
}

/// One step of one sweep. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DecouplingRow {
    /// The material.
    pub material: String,
    /// The space of every colour of the row.
    pub space: RgbSpace,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// `first`: r or n moves; `edge`: h, t, g or k moves.
    pub swept: Swept,
    /// How much was added to the moved parameter, or to 1 as its factor for n and k; 0 is the material itself.
    pub offset: f64,
    /// Reflectance facing the surface.
    pub facing_red: f64,
    /// The same, green.
    pub facing_green: f64,
    /// The same, blue.
    pub facing_blue: f64,
    /// Reflectance at 81.8°.
    pub edge_red: f64,
    /// The same, green.
    pub edge_green: f64,
    /// The same, blue.
    pub edge_blue: f64,
    /// CIEDE2000 by which the facing colour has moved from the material's.
    pub facing_delta_e: f64,
    /// CIEDE2000 by which the colour at 81.8° has moved from the material's.
    pub edge_delta_e: f64,
}

/// A grey edge parameter beside the material's own r. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CrossTalkRow {
    /// The material.
    pub material: String,
    /// The space of the colour.
    pub space: RgbSpace,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// The grey that all channels of the edge parameter were set to: the mean of the material's own.
    pub grey: f64,
    /// The colour at 81.8°.
    pub edge_red: f64,
    /// The same, green.
    pub edge_green: f64,
    /// The same, blue.
    pub edge_blue: f64,
    /// CIEDE2000 from the grey of the same lightness: 0 where a grey parameter means a grey edge.
    pub delta_e_from_grey: f64,
}

/// Sweeps r and the edge parameter of a material down from where they are, each while the other is held.
pub fn decoupling(material: &Contestants, options: &DecouplingOptions) -> Decoupling {
    let sweeps = material.pairs.iter().flat_map(|pair| {
        [Swept::First, Swept::Edge].map(|swept| Sweep::new(&material.name, material.space, *pair, swept, options))
    });
    let cross_talk = material.pairs.iter().map(|pair| CrossTalkRow::new(&material.name, material.space, *pair));
    Decoupling {
        name: material.name.clone(),
        space: material.space,
        sweeps: sweeps.collect(),
        cross_talk: cross_talk.collect(),
    }
}

/// The parameters with one of the triples moved by an offset.
fn moved(pair: Pair, swept: Swept, offset: f64) -> Pair {
    let shift = |triple: Rgb| match pair.parameters {
        Parameters::Nk => triple * (1.0 + offset),
        _ => triple + Rgb::splat(offset),
    };
    match swept {
        Swept::First => Pair { first: shift(pair.first), ..pair },
        Swept::Edge => Pair { edge: shift(pair.edge), ..pair },
    }
}

/// The colours a person sees facing the surface and at θ_max.
fn swatches(pair: Pair) -> [Rgb; 2] {
    let limited = pair.limited();
    [CosTheta::FACING, CosTheta::MAX].map(|cos_theta| limited.reflectance(cos_theta))
}

impl Sweep {
    fn new(material: &str, space: RgbSpace, pair: Pair, swept: Swept, options: &DecouplingOptions) -> Self {
        let start = swatches(pair);
        let offsets = (0..=SWEEP_STEPS).map(|step| options.amount * (step as f64 / SWEEP_STEPS as f64 - 1.0));
        let steps: Vec<(f64, Pair)> = offsets.map(|offset| (offset, moved(pair, swept, offset))).collect();
        let row = |(offset, moved): &(f64, Pair)| {
            let [facing, edge] = swatches(*moved);
            DecouplingRow {
                material: material.to_owned(),
                space,
                parameters: pair.parameters,
                swept,
                offset: *offset,
                facing_red: facing[0],
                facing_green: facing[1],
                facing_blue: facing[2],
                edge_red: edge[0],
                edge_green: edge[1],
                edge_blue: edge[2],
                facing_delta_e: delta_e_rgb(facing, start[0], space),
                edge_delta_e: delta_e_rgb(edge, start[1], space),
            }
        };
        let rows = steps.iter().map(row).collect();
        let left_domain = steps.iter().map(|(_, moved)| moved.outside_domain()).sum();
        Self { parameters: pair.parameters, swept, rows, left_domain }
    }

    /// How far the facing colour and the edge colour moved from end to end, in CIEDE2000.
    pub fn moved(&self) -> [f64; 2] {
        self.rows.first().map_or([f64::NAN; 2], |row| [row.facing_delta_e, row.edge_delta_e])
    }
}

impl DecouplingRow {
    /// The facing colour.
    pub fn facing(&self) -> Rgb {
        Rgb([self.facing_red, self.facing_green, self.facing_blue])
    }

    /// The colour at 81.8°.
    pub fn edge(&self) -> Rgb {
        Rgb([self.edge_red, self.edge_green, self.edge_blue])
    }
}

impl CrossTalkRow {
    fn new(material: &str, space: RgbSpace, pair: Pair) -> Self {
        let grey = pair.edge.0.iter().sum::<f64>() / 3.0;
        let [_, edge] = swatches(Pair { edge: Rgb::splat(grey), ..pair });
        let [edge_red, edge_green, edge_blue] = edge.0;
        Self {
            material: material.to_owned(),
            space,
            parameters: pair.parameters,
            grey,
            edge_red,
            edge_green,
            edge_blue,
            delta_e_from_grey: delta_e_from_grey(edge, space),
        }
    }

    /// The colour at 81.8°.
    pub fn edge(&self) -> Rgb {
        Rgb([self.edge_red, self.edge_green, self.edge_blue])
    }
}

/// CIEDE2000 between a colour and the grey of its lightness.
fn delta_e_from_grey(rgb: Rgb, space: RgbSpace) -> f64 {
    let lab = Lab::from_rgb(rgb, space);
    delta_e_2000(lab, Lab { a: 0.0, b: 0.0, ..lab })
}

impl Decoupling {
    /// Every step of every sweep.
    pub fn rows(&self) -> Vec<DecouplingRow> {
        self.sweeps.iter().flat_map(|sweep| sweep.rows.iter().cloned()).collect()
    }

    /// What had to be limited, as sentences.
    pub fn warnings(&self) -> Vec<String> {
        let limited = self.sweeps.iter().filter(|sweep| sweep.left_domain > 0);
        let sentence = |sweep: &Sweep| {
            let [first, edge] = sweep.parameters.symbols();
            let symbol = if sweep.swept == Swept::First { first } else { edge };
            format!(
                "{}: {} values left their domain while {symbol} was swept and were limited",
                sweep.parameters.label(),
                sweep.left_domain
            )
        };
        limited.map(sentence).collect()
    }

    /// One sweep.
    pub fn sweep(&self, parameters: Parameters, swept: Swept) -> Option<&Sweep> {
        self.sweeps.iter().find(|sweep| sweep.parameters == parameters && sweep.swept == swept)
    }

    /// What is seen, with the numbers in it.
    pub fn summary(&self) -> String {
        let edge = |parameters| self.sweep(parameters, Swept::First).map_or(f64::NAN, |sweep| sweep.moved()[1]);
        let grey = |parameters: Parameters| self.cross_talk[parameters as usize].delta_e_from_grey;
        format!(
            "{}: lowering r moves the colour at 81.8° by {:.2} ΔE while h is held, by {:.2} while t and by {:.2} while g \
             is. A grey h gives a grey edge; a grey t is {:.1} ΔE off grey, a grey g {:.1}.",
            self.name,
            edge(Parameters::H),
            edge(Parameters::T),
            edge(Parameters::G),
            grey(Parameters::T),
            grey(Parameters::G)
        )
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fit::Method;
    use crate::study::Subject;

    fn of(r: [f64; 3], h: [f64; 3]) -> Decoupling {
        let subject = Subject::Colours { name: "mine", space: RgbSpace::AcesCg, r: Rgb(r), h: Rgb(h) };
        let contestants = Contestants::of(&subject, RgbSpace::AcesCg, Method::LeastSquares).unwrap();
        decoupling(&contestants, &DecouplingOptions::default())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]
        /// r is F at 0° and h is F at θ_max, whatever the other is (paper eq. 3).
        #[test]
        fn r_and_h_leave_each_other_alone(r in prop::array::uniform3(0.2..1.0), h in prop::array::uniform3(0.2..1.0)) {
            let study = of(r, h);
            let [_, edge] = study.sweep(Parameters::H, Swept::First).unwrap().moved();
            let [facing, _] = study.sweep(Parameters::H, Swept::Edge).unwrap().moved();
            prop_assert!(edge < 1e-9 && facing < 1e-9, "{edge} {facing}");
            for row in study.sweep(Parameters::H, Swept::First).unwrap().rows.iter() {
                prop_assert!(row.edge().max_abs_difference(Rgb(h)) < 1e-14);
            }
            prop_assert!(study.cross_talk[0].delta_e_from_grey < 1e-9);
        }
    }

    #[test]
    fn t_and_g_are_coupled_to_r() {
        // In the middle of what g can reach: near g = 1 the edge hardly depends on r.
        let study = of([0.9, 0.7, 0.4], [0.8, 0.65, 0.5]);
        for parameters in [Parameters::T, Parameters::G] {
            assert!(study.sweep(parameters, Swept::First).unwrap().moved()[1] > 0.1, "{parameters}");
            assert!(study.cross_talk[parameters as usize].delta_e_from_grey > 1.0, "grey {parameters}");
        }
    }
}
