//! Does the spectral route reproduce the reference values?

use edgewise::color::{Rgb, RgbSpace, delta_e_rgb};
use edgewise::fresnel::{COS_THETA_MAX, CosTheta};
use edgewise::metal::metal_by_name;

/// Values by the same convention from an independent program; the file's header says how.
const REFERENCE: &str = include_str!("data/ground_truth.csv");
const TOLERANCE_DELTA_E: f64 = 0.05;

fn space(name: &str) -> RgbSpace {
    match name {
        "sRGB" => RgbSpace::LinRec709,
        "ACEScg" => RgbSpace::AcesCg,
        other => panic!("unknown space {other}"),
    }
}

fn angle(theta_deg: f64) -> CosTheta {
    if (theta_deg - 81.7868).abs() < 1e-9 { CosTheta::new(COS_THETA_MAX) } else { CosTheta::from_deg(theta_deg) }
}

#[test]
fn within_a_twentieth_of_a_delta_e() {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(REFERENCE.as_bytes());
    let mut worst = (f64::NEG_INFINITY, String::new());
    let mut rows = 0;
    for record in reader.records() {
        let record = record.unwrap();
        let number = |column: usize| record[column].parse::<f64>().unwrap();
        let (space, theta_deg) = (space(&record[2]), number(3));
        let truth = metal_by_name(&record[0]).unwrap().reflectance(angle(theta_deg), space);
        let difference = delta_e_rgb(truth, Rgb([number(4), number(5), number(6)]), space);
        assert!(difference.is_finite(), "{record:?}: {truth:?}");
        if difference > worst.0 {
            worst = (difference, format!("{} {space} {theta_deg}°", &record[0]));
        }
        rows += 1;
    }
    println!("{rows} reference values, worst ΔE2000 {:.4} at {}", worst.0, worst.1);
    assert_eq!(rows, 240);
    assert!(worst.0 <= TOLERANCE_DELTA_E, "{worst:?}");
}
