//! A material in one word: a metal, a file, two colours or a dielectric.

use std::path::Path;

use crate::color::{Rgb, RgbSpace};
use crate::fresnel::h_of_schlick;
use crate::metal::{Metal, metal_by_name};
use crate::preset::Preset;
use crate::study::Subject;

/// What the help says about a material.
pub(super) const MATERIAL_HELP: &str = "A metal of the library (identifier, name or symbol), a preset (.json), a file \
    of n and k (.csv, .yml), n=1.5 for a dielectric, or colours: r as 0.9,0.7,0.4 with Schlick's edge, or r/h as \
    0.9,0.7,0.4/0.93,0.85,0.7";

/// A material that is owned.
#[derive(Debug)]
pub(super) enum Material {
    Metal(Box<Metal>),
    Colours { name: String, space: RgbSpace, r: Rgb, h: Rgb },
    Dielectric { n: f64 },
}

impl Material {
    /// Reads what a word names; colours are in `space`. What a person should know about a file goes to `warnings`.
    pub(super) fn read(word: &str, space: RgbSpace, warnings: &mut Vec<String>) -> anyhow::Result<Self> {
        let ending = Path::new(word).extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        if let Some(n) = word.strip_prefix("n=") {
            return dielectric(n);
        }
        if word.contains(',') {
            return colours(word, space);
        }
        let metal = match ending.as_str() {
            "json" => return preset(Path::new(word), warnings),
            "csv" | "yml" | "yaml" => Metal::open(Path::new(word))?,
            _ => metal_by_name(word)?.clone(),
        };
        warnings.extend(metal.remarks());
        Ok(Self::Metal(Box::new(metal)))
    }

    /// The material as the studies take it.
    pub(super) fn subject(&self) -> Subject<'_> {
        match self {
            Self::Metal(metal) => Subject::Metal(metal),
            Self::Colours { name, space, r, h } => Subject::Colours { name, space: *space, r: *r, h: *h },
            Self::Dielectric { n } => Subject::Dielectric { n: *n },
        }
    }
}

fn preset(path: &Path, warnings: &mut Vec<String>) -> anyhow::Result<Material> {
    let loaded = Preset::load(path)?;
    warnings.extend(loaded.warnings);
    let Preset { name, space, r, h, .. } = loaded.preset;
    Ok(Material::Colours { name, space, r, h })
}

fn dielectric(n: &str) -> anyhow::Result<Material> {
    let n = super::super::arguments::number(n).map_err(anyhow::Error::msg)?;
    anyhow::ensure!(n >= 1.0, "a dielectric in air has a refractive index n of at least 1, not {n}");
    Ok(Material::Dielectric { n })
}

fn colours(word: &str, space: RgbSpace) -> anyhow::Result<Material> {
    let triple = |text: &str| super::super::arguments::triple(text).map_err(anyhow::Error::msg);
    let (r, h) = match word.split_once('/') {
        Some((r, h)) => (triple(r)?, triple(h)?),
        None => (triple(word)?, triple(word)?.map(h_of_schlick)),
    };
    Ok(Material::Colours { name: "Given colours".to_owned(), space, r, h })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_name_materials_or_say_why_not() {
        let read = |word: &str| Material::read(word, RgbSpace::AcesCg, &mut Vec::new());
        assert!(matches!(read("gold"), Ok(Material::Metal(metal)) if metal.name == "Gold"));
        assert!(matches!(read("n=1.5"), Ok(Material::Dielectric { n }) if n == 1.5));
        let Ok(Material::Colours { r, h, .. }) = read("0.9,0.7,0.4") else { panic!("colours") };
        assert_eq!(h, r.map(h_of_schlick));
        assert!(matches!(read("0.9,0.7,0.4/1,1,1"), Ok(Material::Colours { h, .. }) if h == Rgb::WHITE));
        for (word, reason) in [
            ("unobtainium", "unobtainium"),
            ("n=0.5", "at least 1"),
            ("n=x", "no number"),
            ("1,2", "three numbers"),
            ("1,2,3/4", "three numbers"),
            ("no/such.json", "no/such.json"),
            ("no/such.csv", "no/such.csv"),
        ] {
            let said = format!("{:#}", read(word).unwrap_err());
            assert!(said.contains(reason), "{word}: {said}");
        }
    }
}
