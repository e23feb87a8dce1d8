//! Values as one pastes them from a node editor or a mail.

use super::ImportError;
use super::imported::{Found, Imported, hoffman};
use super::numbers::{colour, hex_colour, number, shortened};
use crate::color::{Rgb, RgbSpace, UnknownName};
use crate::fresnel::{FresnelModel, h_of_schlick};

/// What the keys of the lines mean, in lower case and without anything but letters and digits.
const R: [&str; 6] = ["r", "r0", "f0", "basecolor", "color0", "reflectivity"];
const H: [&str; 1] = ["h"];
const T: [&str; 7] = ["t", "speculartint", "edgetint", "specularcolor", "specularedgecolor", "color82", "f82"];
const G: [&str; 2] = ["g", "edgecolor"];
const N: [&str; 3] = ["n", "ior", "eta"];
const K: [&str; 2] = ["k", "extinction"];

/// Lines `key: colour` or `key = colour`; a line without a key is refused. A `name` begins another metal.
pub(super) fn read(text: &str, space: Option<RgbSpace>) -> Result<Imported, ImportError> {
    let mut imported = Imported::default();
    let mut space = space;
    let mut values = Values::default();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//")) {
        let (key, value) = line.split_once([':', '=']).ok_or_else(|| no_value(line))?;
        let value = value.trim().trim_end_matches([',', ';']);
        match key_of(key).as_str() {
            "name" if values.model.is_some() => {
                let finished = std::mem::replace(&mut values, Values::named(value));
                finished.add_to(&mut imported, space)?;
            }
            "name" => values.name = Some(value.to_owned()),
            "space" | "colorspace" | "colourspace" => {
                let parsed = value.parse().map_err(|error: UnknownName| ImportError::metal("space", error.to_string()));
                space = Some(parsed?);
            }
            "roughness" => values.roughness = Some(number(value)?),
            "metallic" | "metalness" if number(value)? == 1.0 => {}
            "metallic" | "metalness" => return Err(ImportError::metal(key, "only 1 is a metal")),
            key => values.set(key, line, value)?,
        }
    }
    if imported.presets.is_empty() && values.model.is_none() {
        return Err(ImportError::NoMetal("the text"));
    }
    values.add_to(&mut imported, space)?;
    Ok(imported)
}

fn no_value(line: &str) -> ImportError {
    ImportError::Number { text: shortened(line), expected: "line like “Base Color: 0.9, 0.7, 0.3”" }
}

fn key_of(text: &str) -> String {
    text.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
}

/// The lines of one metal so far.
#[derive(Default)]
struct Values {
    name: Option<String>,
    roughness: Option<f64>,
    /// First and second triple with their symbols.
    model: Option<(char, Triple)>,
    second: Option<(char, Triple)>,
}

/// Three values as the text has them.
#[derive(Clone, Copy)]
enum Triple {
    /// In the space of the metal.
    Numbers(Rgb),
    /// From `#rrggbb`: linear Rec.709.
    Hex(Rgb),
}

impl Triple {
    fn read(text: &str) -> Result<Self, ImportError> {
        hex_colour(text)?.map_or_else(|| colour(text).map(Self::Numbers), |rgb| Ok(Self::Hex(rgb)))
    }

    /// The values of `symbol` in a space; of the symbols only r and h are colours that can be converted.
    fn in_space(self, symbol: char, space: RgbSpace) -> Result<Rgb, String> {
        match self {
            Self::Numbers(rgb) => Ok(rgb),
            Self::Hex(rgb) if space == RgbSpace::LinRec709 => Ok(rgb),
            Self::Hex(rgb) if "rh".contains(symbol) => Ok(RgbSpace::LinRec709.convert(rgb, space)),
            Self::Hex(_) => Err(format!("{symbol} is no colour, so its sRGB code cannot be converted to {space}")),
        }
    }

    fn is_converted(self, space: RgbSpace) -> bool {
        matches!(self, Self::Hex(_)) && space != RgbSpace::LinRec709
    }
}

impl Values {
    fn named(name: &str) -> Self {
        Self { name: Some(name.to_owned()), ..Self::default() }
    }

    fn set(&mut self, key: &str, line: &str, value: &str) -> Result<(), ImportError> {
        let symbols: [(&[&str], char); 6] = [(&R, 'r'), (&H, 'h'), (&T, 't'), (&G, 'g'), (&N, 'n'), (&K, 'k')];
        let symbol = symbols.iter().find(|(keys, _)| keys.contains(&key)).map(|(_, symbol)| *symbol);
        let symbol = symbol.ok_or_else(|| no_value(line))?;
        let triple = Triple::read(value)?;
        let slot = if "rn".contains(symbol) { &mut self.model } else { &mut self.second };
        match slot {
            None => *slot = Some((symbol, triple)),
            Some(_) => return Err(ImportError::metal(key, "the text gives it twice for one metal")),
        }
        Ok(())
    }

    fn add_to(self, imported: &mut Imported, space: Option<RgbSpace>) -> Result<(), ImportError> {
        let name = self.name.unwrap_or_else(|| "Pasted metal".to_owned());
        let space = imported.space_or_assumed(space, &format!("“{name}”"));
        let triples = [self.model, self.second];
        if triples.iter().flatten().any(|(_, triple)| triple.is_converted(space)) {
            imported.notes.push(format!("“{name}” has an sRGB code, which was converted to {space}"));
        }
        let [first, second] = triples.map(|found| {
            found.map(|(symbol, triple)| triple.in_space(symbol, space).map(|values| (symbol, values))).transpose()
        });
        let refused = |reason| ImportError::metal(&name, reason);
        let model = match (first.map_err(refused)?, second.map_err(refused)?) {
            (Some(('r', r)), Some(('h', h))) => hoffman(r, h),
            (Some(('r', r)), Some(('t', t))) => FresnelModel::F82Tint { r, t },
            (Some(('r', r)), Some(('g', g))) => FresnelModel::Gulbrandsen { r, g },
            (Some(('n', n)), Some(('k', k))) => FresnelModel::Conductor { n, k },
            (Some(('r', r)), None) => {
                imported.notes.push(format!("“{name}” has only r; its h is that of Schlick's curve"));
                hoffman(r, r.map(h_of_schlick))
            }
            _ => return Err(ImportError::metal(&name, "it needs r with h, t or g, or n with k")),
        };
        imported.add(Found { name, space, model, roughness: self.roughness })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_a_principled_node() {
        let text = "Name: Gold\nBase Color: [1.0, 0.782, 0.344, 1.0]\nMetallic: 1.0\nSpecular Tint = 0.986 0.999 0.973\n\
                    Roughness: 0.3\nspace: acescg\n";
        let imported = read(text, None).unwrap();
        let preset = &imported.presets[0];
        assert_eq!((preset.name.as_str(), preset.space, preset.roughness), ("Gold", RgbSpace::AcesCg, 0.3));
        assert!(preset.tint().max_abs_difference(Rgb([0.986, 0.999, 0.973])) < 1e-14);
        assert!(imported.notes.is_empty(), "{:?}", imported.notes);
    }

    /// The code is sRGB, whatever space the numbers beside it have.
    #[test]
    fn a_code_is_converted_to_the_space() {
        let imported = read("r: #ff8040\nh: 0.9 0.8 0.7\nspace: acescg", None).unwrap();
        let code = crate::color::linear_from_srgb8([0xff, 0x80, 0x40]);
        let preset = &imported.presets[0];
        assert!(preset.in_space(RgbSpace::LinRec709).r.max_abs_difference(code) < 1e-12);
        assert!(preset.h.max_abs_difference(Rgb([0.9, 0.8, 0.7])) < 1e-14);
        assert!(imported.notes[0].contains("converted to acescg"), "{:?}", imported.notes);
        let tint = read("r: 0.9 0.8 0.7\nt: #ff8040\nspace: acescg", None).unwrap_err();
        assert!(tint.to_string().contains("t is no colour"), "{tint}");
        assert!(read("r: 0.9 0.8 0.7\nt: #ff8040", None).is_ok(), "linear Rec.709 is the space of the code");
    }

    #[test]
    fn a_name_begins_another_metal() {
        let text = "name: A\nr: 0.5 0.5 0.5\nh: 0.7 0.7 0.7\nname: B\nr: #808080\n";
        let imported = read(text, Some(RgbSpace::LinRec709)).unwrap();
        assert_eq!(imported.presets.len(), 2);
        assert_eq!(imported.notes.len(), 1, "B has only r");
    }

    #[test]
    fn refuses_with_a_reason() {
        let reason = |text: &str| read(text, None).unwrap_err().to_string();
        assert!(reason("").contains("no metal"));
        assert!(reason("hello").contains("Base Color"));
        assert!(reason("Base Color: NaN 0 0").contains("NaN"));
        assert!(reason("Base Color: 1 1 1\nMetallic: 0").contains("only 1"));
        assert!(reason("Specular Tint: 1 1 1").contains("no metal"));
        assert!(reason("r: 1 1 1\nr: 1 1 1").contains("twice"));
        assert!(reason("n: -1 1 1\nk: 3 3 3").contains("negative"));
        assert!(reason("n: 1 1 1\nh: 1 1 1").contains("needs r"));
    }
}
