//! How far published measurements of one material are apart, next to what a model gets wrong.

use serde::Serialize;

use super::summary::median;
use crate::color::{RgbSpace, delta_e_rgb};
use crate::fit::CurveError;
use crate::fresnel::FresnelModel;
use crate::metal::{Metal, TruthCurve};

/// The published data sets of one material, compared in r and h. The field names are stable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpreadRow {
    /// The material's name.
    pub name: String,
    /// The space.
    pub space: RgbSpace,
    /// Number of data sets.
    pub datasets: usize,
    /// How many of them are measurements; others are calculated or fitted to earlier ones.
    pub measured: usize,
    /// Median CIEDE2000 of r between the preferred data set and each other one.
    pub median_r_delta_e: f64,
    /// Median CIEDE2000 of h likewise.
    pub median_h_delta_e: f64,
    /// Largest CIEDE2000 of r between any two.
    pub max_r_delta_e: f64,
    /// Largest CIEDE2000 of h between any two.
    pub max_h_delta_e: f64,
    /// Mean CIEDE2000 over the angles of Hoffman's model with the exact r and h of the preferred data set.
    pub hoffman_mean_delta_e: f64,
    /// Largest CIEDE2000 over the angles of the same.
    pub hoffman_max_delta_e: f64,
}

/// One row for each material with two data sets or more, in the order of `metals`.
pub fn spread(metals: &[Metal], space: RgbSpace) -> Vec<SpreadRow> {
    let mut names: Vec<&str> = metals.iter().map(|metal| metal.name.as_str()).collect();
    names.dedup();
    names.into_iter().filter_map(|name| row(metals, name, space)).collect()
}

fn row(metals: &[Metal], name: &str, space: RgbSpace) -> Option<SpreadRow> {
    let sets: Vec<&Metal> = metals.iter().filter(|metal| metal.name == name).collect();
    let preferred = *sets.iter().find(|metal| metal.is_preferred)?;
    if sets.len() < 2 {
        return None;
    }
    let others = || sets.iter().filter(|metal| metal.id != preferred.id);
    let r = |a: &Metal, b: &Metal| delta_e_rgb(a.r(space), b.r(space), space);
    let h = |a: &Metal, b: &Metal| delta_e_rgb(a.h(space), b.h(space), space);
    let largest = |difference: &dyn Fn(&Metal, &Metal) -> f64| {
        sets.iter().flat_map(|a| sets.iter().map(move |b| difference(a, b))).fold(0.0, f64::max)
    };
    let truth = TruthCurve::of(preferred, space);
    let error = CurveError::of(&FresnelModel::Hoffman { r: truth.r(), h: truth.h }, &truth);
    Some(SpreadRow {
        name: name.to_owned(),
        space,
        datasets: sets.len(),
        measured: sets.iter().filter(|metal| metal.is_measured()).count(),
        median_r_delta_e: median(others().map(|other| r(preferred, other)).collect()),
        median_h_delta_e: median(others().map(|other| h(preferred, other)).collect()),
        max_r_delta_e: largest(&r),
        max_h_delta_e: largest(&h),
        hoffman_mean_delta_e: error.mean_delta_e,
        hoffman_max_delta_e: error.max_delta_e,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metals;

    /// Only for iron one of the three had to be a calculation.
    #[test]
    fn the_common_metals_have_three_sets() {
        let rows = spread(metals(), RgbSpace::LinRec709);
        for name in ["Gold", "Silver", "Copper", "Aluminium", "Titanium", "Iron"] {
            let row = rows.iter().find(|row| row.name == name).expect("a row");
            assert!(row.datasets >= 3, "{name}: {}", row.datasets);
            assert!(row.measured >= if name == "Iron" { 2 } else { 3 }, "{name}: {}", row.measured);
            assert!(row.median_r_delta_e <= row.max_r_delta_e && row.median_h_delta_e <= row.max_h_delta_e);
        }
        assert!(rows.iter().all(|row| row.datasets >= 2));
    }
}
