//! Parameters stored with few digits: what rounding them costs (paper section 4, robustness).

use half::f16;
use serde::{Deserialize, Serialize};

use super::Contestants;
use super::conversion::delta_e_of_curves;
use super::parameters::{Pair, Parameters};
use crate::color::{Rgb, RgbSpace, delta_e_rgb, srgb_decode, srgb_encode};
use crate::fresnel::CosTheta;
use crate::number::{larger, largest};

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Storage {
    /// 256 codes from 0 to 1.
    Bits8,
    /// 1024 codes from 0 to 1.
    Bits10,
    /// IEEE 754 binary16, as in OpenEXR.
    Half,
}

/// The curve a number is stored through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Encoding {
    /// As it is.
    Linear,
    /// Through the sRGB curve, as colour textures are.
    Srgb,
}

impl Storage {
    /// Every storage.
    pub const ALL: [Self; 3] = [Self::Bits8, Self::Bits10, Self::Half];

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Bits8 => "8-bit",
            Self::Bits10 => "10-bit",
            Self::Half => "half float",
        }
    }

    /// The number that comes back; codes reach from 0 to 1 only.
    fn stored(self, value: f64) -> f64 {
        let in_codes = |most: f64| (value.clamp(0.0, 1.0) * most).round() / most;
        match self {
            Self::Bits8 => in_codes(255.0),
            Self::Bits10 => in_codes(1023.0),
            Self::Half => f16::from_f64(value).to_f64(),
        }
    }

    /// The distance between neighbouring codes at a value.
    fn step_at(self, value: f64) -> f64 {
        match self {
            Self::Bits8 => 1.0 / 255.0,
            Self::Bits10 => 1.0 / 1023.0,
            // Eleven significant bits, and no exponent below −14 (IEEE 754, binary16).
            Self::Half => (value.abs().log2().floor().max(-14.0) - 10.0).exp2(),
        }
    }

    /// Whether a number is beyond the largest code.
    fn clips(self, value: f64) -> bool {
        self != Self::Half && !(0.0..=1.0).contains(&value)
    }
}

impl Encoding {
    /// Both encodings.
    pub const ALL: [Self; 2] = [Self::Linear, Self::Srgb];

    /// The name people read.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "sRGB-encoded",
        }
    }

    fn encode(self, value: f64) -> f64 {
        if self == Self::Srgb { srgb_encode(value) } else { value }
    }

    fn decode(self, value: f64) -> f64 {
        if self == Self::Srgb { srgb_decode(value) } else { value }
    }
}

/// n and k are stored as a share of this, since codes end at 1 and the n and k of metals do not.
pub const NK_SCALE: f64 = 16.0;

/// Columns of the gradient that shows banding.
pub const GRADIENT_COLUMNS: usize = 512;

/// Stored parameters of one material, and of the gradient to another.
#[derive(Clone, Debug)]
pub struct Quantisation {
    /// The material.
    pub name: String,
    /// What the gradient leads to.
    pub towards: String,
    /// The space of the parameters.
    pub space: RgbSpace,
    /// One for each of parameters, storage and encoding, in this order.
    pub results: Vec<Quantised>,
}

/// One description in one storage.
#[derive(Clone, Debug)]
pub struct Quantised {
    /// Its numbers.
    pub row: QuantisationRow,
    /// The gradient at θ_max, with its edge parameter stored.
    pub gradient: Vec<Rgb>,
}

/// One description in one storage. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct QuantisationRow {
    /// The material.
    pub material: String,
    /// What the gradient leads to.
    pub towards: String,
    /// The space of the parameters.
    pub space: RgbSpace,
    /// `h`, `t`, `g` or `nk`.
    pub parameters: Parameters,
    /// `bits8`, `bits10` or `half`.
    pub storage: Storage,
    /// `linear` or `srgb`.
    pub encoding: Encoding,
    /// Largest CIEDE2000 over the angles with only the edge parameter stored: h, t, g, or k.
    pub edge_delta_e: f64,
    /// Largest CIEDE2000 that rounding the edge parameter can cause near here: each channel half a code up or down.
    pub rounding_delta_e: f64,
    /// Largest CIEDE2000 over the angles with all six numbers stored.
    pub all_delta_e: f64,
    /// How many of the six numbers were beyond the largest code.
    pub clipped: usize,
    /// Bands of one colour on the gradient at 81.8° with the edge parameter stored.
    pub bands: usize,
    /// Largest CIEDE2000 between two neighbouring bands.
    pub band_delta_e: f64,
    /// Largest CIEDE2000 between the gradient and the same without storing.
    pub gradient_delta_e: f64,
}

/// Stores the parameters of a material, and of a gradient from it to another, in every way.
pub fn quantisation(material: &Contestants, towards: &Contestants) -> Quantisation {
    let ways = Storage::ALL.into_iter().flat_map(|storage| Encoding::ALL.map(|encoding| (storage, encoding)));
    let results = Parameters::ALL.into_iter().flat_map(|parameters| {
        let ends = [material.pair(parameters), towards.pair(parameters)];
        let of_way = |(storage, encoding)| quantised(material, &towards.name, ends, Way { storage, encoding });
        ways.clone().map(of_way).collect::<Vec<_>>()
    });
    Quantisation {
        name: material.name.clone(),
        towards: towards.name.clone(),
        space: material.space,
        results: results.collect(),
    }
}

/// A storage through an encoding.
#[derive(Clone, Copy)]
struct Way {
    storage: Storage,
    encoding: Encoding,
}

impl Way {
    /// The value that comes back of one that is stored as a share of `scale`.
    fn stored(self, value: f64, scale: f64) -> f64 {
        self.encoding.decode(self.storage.stored(self.encoding.encode(value / scale))) * scale
    }

    fn edge_stored(self, pair: Pair) -> Pair {
        let scale = scale(pair.parameters);
        Pair { edge: pair.edge.map(|v| self.stored(v, scale)), ..pair }.limited()
    }

    fn all_stored(self, pair: Pair) -> Pair {
        let scale = scale(pair.parameters);
        pair.map(|triple| triple.map(|v| self.stored(v, scale))).limited()
    }

    /// Every way in which the channels can be off by half a code, at angles 5° apart and θ_max.
    fn worst_rounding(self, pair: Pair, space: RgbSpace) -> f64 {
        let scale = scale(pair.parameters);
        let angles = || (0..18).map(|step| CosTheta::from_deg(5.0 * f64::from(step))).chain([CosTheta::MAX]);
        let exact: Vec<Rgb> = angles().map(|angle| pair.reflectance(angle)).collect();
        let delta_e = |signs: usize| {
            let sign = |channel: usize| if signs >> channel & 1 == 1 { 0.5 } else { -0.5 };
            let moved = |channel: usize| self.moved(pair.edge[channel], scale, sign(channel));
            let off = Pair { edge: Rgb(std::array::from_fn(moved)), ..pair }.limited();
            let curve: Vec<Rgb> = angles().map(|angle| off.reflectance(angle)).collect();
            largest(delta_e_of_curves(&curve, &exact, space))
        };
        largest([0, 1, 2, 3, 4, 5, 6, 7].map(delta_e))
    }

    /// The value some codes away from where it is; the steps of a half float are those at the value.
    fn moved(self, value: f64, scale: f64, codes: f64) -> f64 {
        let encoded = self.encoding.encode(value / scale);
        self.encoding.decode(encoded + codes * self.storage.step_at(encoded)) * scale
    }

    fn clipped(self, pair: Pair) -> usize {
        let values = pair.first.0.into_iter().chain(pair.edge.0);
        values.filter(|v| self.storage.clips(v / scale(pair.parameters))).count()
    }
}

fn scale(parameters: Parameters) -> f64 {
    if parameters == Parameters::Nk { NK_SCALE } else { 1.0 }
}

fn quantised(material: &Contestants, towards: &str, [pair, other]: [Pair; 2], way: Way) -> Quantised {
    let space = material.space;
    let worst = |stored: Pair| largest(delta_e_of_curves(&stored.curve(), &pair.curve(), space));
    let gradient = gradient(pair, other, |blended| way.edge_stored(blended));
    let bands = bands(&gradient);
    let steps: Vec<f64> = bands.windows(2).map(|two| delta_e_rgb(two[0], two[1], space)).collect();
    let exact = self::gradient(pair, other, |blended| blended);
    let row = QuantisationRow {
        material: material.name.clone(),
        towards: towards.to_owned(),
        space,
        parameters: pair.parameters,
        storage: way.storage,
        encoding: way.encoding,
        edge_delta_e: worst(way.edge_stored(pair)),
        rounding_delta_e: way.worst_rounding(pair, space),
        all_delta_e: worst(way.all_stored(pair)),
        clipped: way.clipped(pair),
        bands: bands.len(),
        band_delta_e: steps.iter().copied().fold(0.0, larger),
        gradient_delta_e: largest(delta_e_of_curves(&gradient, &exact, space)),
    };
    Quantised { row, gradient }
}

/// Colours at θ_max from one material to another; r, or n, is exact.
fn gradient(from: Pair, to: Pair, store: impl Fn(Pair) -> Pair) -> Vec<Rgb> {
    let weight = |column: usize| column as f64 / (GRADIENT_COLUMNS - 1) as f64;
    // r stays: only then every step of the picture is a step of the edge parameter.
    let to = Pair { first: from.first, ..to };
    (0..GRADIENT_COLUMNS).map(|column| store(from.lerp(to, weight(column))).reflectance(CosTheta::MAX)).collect()
}

/// The colours of a gradient, each run of equal ones once.
fn bands(gradient: &[Rgb]) -> Vec<Rgb> {
    let mut bands = gradient.to_vec();
    bands.dedup();
    bands
}

impl Quantisation {
    /// One row for each description and storage.
    pub fn rows(&self) -> Vec<QuantisationRow> {
        self.results.iter().map(|result| result.row.clone()).collect()
    }

    /// The result of one description in one storage.
    pub fn result(&self, parameters: Parameters, storage: Storage, encoding: Encoding) -> Option<&Quantised> {
        let is_it =
            |row: &QuantisationRow| (row.parameters, row.storage, row.encoding) == (parameters, storage, encoding);
        self.results.iter().find(|result| is_it(&result.row))
    }

    /// What is seen, with the numbers in it.
    pub fn summary(&self) -> String {
        let edge = |parameters| {
            self.result(parameters, Storage::Bits8, Encoding::Linear)
                .map_or(f64::NAN, |result| result.row.rounding_delta_e)
        };
        format!(
            "{} in {}: rounding to eight linear bits can change the appearance by {:.2} ΔE where they hold h, {:.2} \
             where t, {:.2} where g and {:.2} where k.",
            self.name,
            self.space.label(),
            edge(Parameters::H),
            edge(Parameters::T),
            edge(Parameters::G),
            edge(Parameters::Nk)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Method;
    use crate::metal::{metal_by_name, metals};
    use crate::study::Subject;

    fn metal(name: &str) -> Contestants {
        Contestants::of(&Subject::Metal(metal_by_name(name).unwrap()), RgbSpace::AcesCg, Method::LeastSquares).unwrap()
    }

    #[test]
    fn codes_are_kept_and_rounding_is_half_a_step() {
        for encoding in Encoding::ALL {
            let way = Way { storage: Storage::Bits8, encoding };
            for code in 0..=255 {
                let value = encoding.decode(f64::from(code) / 255.0);
                assert!((way.stored(value, 1.0) - value).abs() < 1e-12);
            }
        }
        let way = Way { storage: Storage::Bits10, encoding: Encoding::Linear };
        assert!((way.stored(0.12345, 1.0) - 0.12345).abs() <= 0.5 / 1023.0);
        assert_eq!(way.stored(1.5, 1.0), 1.0);
        // A half has eleven significant bits (IEEE 754).
        let half = Way { storage: Storage::Half, encoding: Encoding::Linear };
        assert!((half.stored(0.9, 1.0) / 0.9 - 1.0).abs() <= 2.0_f64.powi(-11));
    }

    #[test]
    fn more_digits_cost_less_and_every_way_is_there_once() {
        let study = quantisation(&metal("copper"), &metal("silver"));
        assert_eq!(study.results.len(), 24);
        for parameters in Parameters::ALL {
            let of = |storage| study.result(parameters, storage, Encoding::Linear).unwrap().row.clone();
            let (bits8, half) = (of(Storage::Bits8), of(Storage::Half));
            assert!(half.gradient_delta_e < bits8.gradient_delta_e, "{parameters}");
            assert!(half.bands >= bits8.bands && bits8.bands > 1, "{parameters}");
        }
    }

    /// What the scale of n and k is for: no metal of the library is clipped.
    #[test]
    fn n_and_k_of_the_library_fit_the_scale() {
        let most = metals().iter().flat_map(|metal| metal.nk().iter()).map(|nk| nk.n.max(nk.k)).fold(0.0, f64::max);
        assert!(most < NK_SCALE, "{most}");
    }
}
