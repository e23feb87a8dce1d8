//! CSV tables of metals: r with h, t or g, or n with k.

use std::collections::HashMap;

use csv::StringRecord;

use super::ImportError;
use super::imported::{Found, Imported, hoffman};
use super::numbers::number;
use crate::color::{Rgb, RgbSpace, UnknownName};
use crate::fresnel::FresnelModel;

/// Columns `r_red,r_green,r_blue` and so for h, t, g, n and k; `name`, `space` and `roughness` where there are.
///
/// A row must hold one of (r, h), (r, t), (r, g) and (n, k); the first of these that the header has is taken.
pub(super) fn read(text: &str, space: Option<RgbSpace>) -> Result<Imported, ImportError> {
    let text = text.trim_start_matches('\u{feff}');
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let columns = Columns::of(reader.headers().map_err(table_error)?)?;
    let mut imported = Imported::default();
    let space = if columns.has("space") { RgbSpace::default() } else { imported.space_or_assumed(space, "the table") };
    for (index, record) in reader.records().enumerate() {
        let record = record.map_err(table_error)?;
        imported.add(columns.found(index + 1, &record, space)?)?;
    }
    if imported.presets.is_empty() { Err(ImportError::NoMetal("the table")) } else { Ok(imported) }
}

fn table_error(error: csv::Error) -> ImportError {
    ImportError::Table(error.to_string())
}

/// Where each column is.
struct Columns(HashMap<String, usize>);

impl Columns {
    fn of(header: &StringRecord) -> Result<Self, ImportError> {
        let mut columns = HashMap::new();
        for (index, name) in header.iter().enumerate() {
            if columns.insert(name.to_ascii_lowercase(), index).is_some() {
                return Err(ImportError::Table(format!("it has two columns “{}”", super::numbers::shortened(name))));
            }
        }
        let columns = Self(columns);
        let pairs = [["r", "h"], ["r", "t"], ["r", "g"], ["n", "k"]];
        if pairs.iter().any(|pair| pair.iter().all(|symbol| columns.has_triple(symbol))) {
            return Ok(columns);
        }
        Err(ImportError::Table(
            "its first row must name r_red,r_green,r_blue with the same for h, t or g, or these for n and k".to_owned(),
        ))
    }

    fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    fn has_triple(&self, symbol: &str) -> bool {
        ["red", "green", "blue"].iter().all(|channel| self.has(&format!("{symbol}_{channel}")))
    }

    fn text<'r>(&self, record: &'r StringRecord, name: &str) -> Option<&'r str> {
        self.0.get(name).and_then(|&index| record.get(index)).filter(|text| !text.is_empty())
    }

    fn triple(&self, record: &StringRecord, symbol: &str) -> Result<Rgb, ImportError> {
        let [red, green, blue] = ["red", "green", "blue"].map(|channel| {
            let text = self.text(record, &format!("{symbol}_{channel}")).unwrap_or_default();
            number(text)
        });
        Ok(Rgb([red?, green?, blue?]))
    }

    fn found(&self, row: usize, record: &StringRecord, space: RgbSpace) -> Result<Found, ImportError> {
        let name = self.text(record, "name").map_or_else(|| format!("row {row}"), str::to_owned);
        let space = self.text(record, "space").map_or(Ok(space), str::parse);
        let space = space.map_err(|error: UnknownName| ImportError::metal(&name, error.to_string()))?;
        let model = self.model(record).map_err(|error| ImportError::metal(&name, error.to_string()))?;
        let roughness = self.text(record, "roughness").map(number).transpose()?;
        Ok(Found { name, space, model, roughness })
    }

    fn model(&self, record: &StringRecord) -> Result<FresnelModel, ImportError> {
        let triple = |symbol| self.triple(record, symbol);
        if !self.has_triple("r") {
            return Ok(FresnelModel::Conductor { n: triple("n")?, k: triple("k")? });
        }
        let r = triple("r")?;
        if self.has_triple("h") {
            return Ok(hoffman(r, triple("h")?));
        }
        if self.has_triple("t") {
            return Ok(FresnelModel::F82Tint { r, t: triple("t")? });
        }
        if self.has_triple("g") {
            return Ok(FresnelModel::Gulbrandsen { r, g: triple("g")? });
        }
        Ok(FresnelModel::Conductor { n: triple("n")?, k: triple("k")? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD_T: &str = "name,r_red,r_green,r_blue,t_red,t_green,t_blue,roughness";

    #[test]
    fn tint_becomes_h_exactly() {
        let text = format!("{HEAD_T}\nGold,1,0.782,0.344,0.986,0.999,0.973,0.3\n");
        let imported = read(&text, Some(RgbSpace::AcesCg)).unwrap();
        let preset = &imported.presets[0];
        assert_eq!((preset.name.as_str(), preset.space, preset.roughness), ("Gold", RgbSpace::AcesCg, 0.3));
        assert!(preset.tint().max_abs_difference(Rgb([0.986, 0.999, 0.973])) < 1e-14);
        assert!(imported.notes.is_empty());
    }

    #[test]
    fn an_index_becomes_its_curve_with_a_note() {
        let text = "n_red,n_green,n_blue,k_red,k_green,k_blue\n0.183,0.421,1.373,3.424,2.346,1.77\n";
        let imported = read(text, None).unwrap();
        // The gold of MaterialX's conductor example; r and h are the exact Fresnel equations at 0° and 81.787°.
        let preset = &imported.presets[0];
        assert!(preset.r.max_abs_difference(Rgb([0.9442, 0.7762, 0.3733])) < 1e-4);
        assert!(preset.h.max_abs_difference(Rgb([0.9537, 0.8796, 0.6596])) < 1e-4);
        assert_eq!(imported.notes.len(), 2, "the space and the residual: {:?}", imported.notes);
    }

    #[test]
    fn refuses_with_a_reason() {
        let reason = |text: &str| read(text, None).unwrap_err().to_string();
        assert!(reason("").contains("first row"));
        assert!(reason("r_red,r_green,r_blue\n1,1,1\n").contains("first row"));
        assert!(reason("a,a\n").contains("two columns"));
        assert!(reason(&format!("{HEAD_T}\n")).contains("no metal"));
        assert!(reason(&format!("{HEAD_T}\nGold,1,x,0,1,1,1,0\n")).contains("Gold"));
        assert!(reason(&format!("{HEAD_T}\nGold,1,1e999,0,1,1,1,0\n")).contains("1e999"));
        assert!(reason(&format!("{HEAD_T}\nGold,1,NaN,0,1,1,1,0\n")).contains("NaN"));
        assert!(reason(&format!("{HEAD_T}\nGold,1,1,1,1,1,1,2\n")).contains("roughness"));
        assert!(reason(&format!("{HEAD_T}\nGold,1,1\n")).contains("table"));
        let nk = "n_red,n_green,n_blue,k_red,k_green,k_blue\n";
        assert!(reason(&format!("{nk}-0.2,0.4,1.4,3.4,2.3,1.8\n")).contains("negative"));
        assert!(reason(&format!("{nk}0.2,0.4,1.4,3.4,2.3,-1.8\n")).contains("negative"));
        let g = "r_red,r_green,r_blue,g_red,g_green,g_blue\n0.5,0.5,0.5,2,0.5,0.5\n";
        assert!(reason(g).contains("no material"));
    }
}
