//! Does the accuracy study reproduce errors that an independent program measured?

use edgewise::color::RgbSpace;
use edgewise::fit::{Method, Triple};
use edgewise::fresnel::ModelKind;
use edgewise::metal::{Metal, metal_by_name};
use edgewise::study::{AccuracyRow, Candidate, accuracy, no_progress};

/// Mean and largest CIEDE2000 by the same convention; the file's header says how.
const REFERENCE: &str = include_str!("data/model_error.csv");

/// The file has four decimals; the rest is the other program's interpolation of n and k.
const TOLERANCE_DELTA_E: f64 = 0.02;

/// One row of the file.
struct Reference {
    metal: &'static Metal,
    space: RgbSpace,
    model: String,
    mean: f64,
    max: f64,
}

fn references() -> Vec<Reference> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(REFERENCE.as_bytes());
    let rows = reader.records().map(|record| record.expect("a row")).map(|record| Reference {
        metal: metal_by_name(&record[0]).expect("a metal of the library"),
        space: if &record[1] == "sRGB" { RgbSpace::LinRec709 } else { RgbSpace::AcesCg },
        model: record[2].to_owned(),
        mean: record[3].parse().expect("a number"),
        max: record[4].parse().expect("a number"),
    });
    rows.collect()
}

fn candidate(model: &str) -> Candidate {
    match model {
        "schlick, true r" => Candidate::SCHLICK,
        "hoffman, true r and h" => Candidate::HOFFMAN,
        "conductor, n,k sampled at 650/550/450 nm" => {
            Candidate::Model(ModelKind::Conductor, Method::Points(Triple::ROUND))
        }
        "conductor, n,k sampled at 630/532/465 nm" => {
            Candidate::Model(ModelKind::Conductor, Method::Points(Triple::PRIMARIES))
        }
        "lazanyi, a(3) and alpha(1) fitted" => Candidate::Model(ModelKind::Lazanyi, Method::BlackBox),
        other => panic!("unknown model {other}"),
    }
}

fn measured(reference: &Reference) -> AccuracyRow {
    let rows = accuracy(&[reference.metal], &[candidate(&reference.model)], &[reference.space], &no_progress);
    rows.expect("nobody stops it").remove(0)
}

#[test]
fn errors_without_a_fit_are_the_same() {
    let references: Vec<Reference> = references().into_iter().filter(|r| !r.model.contains("fitted")).collect();
    assert_eq!(references.len(), 96);
    for reference in references {
        let row = measured(&reference);
        let (mean, max) = ((row.mean_delta_e - reference.mean).abs(), (row.max_delta_e - reference.max).abs());
        let at = format!("{} {} {}", reference.metal.id, reference.space, reference.model);
        assert!(mean <= TOLERANCE_DELTA_E && max <= TOLERANCE_DELTA_E, "{at}: {row:?}");
    }
}

/// The other program's fits are upper bounds on the optimum, so ours may be better but not worse.
#[test]
fn fitted_errors_are_not_above_the_bound() {
    let references: Vec<Reference> = references().into_iter().filter(|r| r.model.contains("fitted")).collect();
    assert_eq!(references.len(), 24);
    for reference in references {
        let row = measured(&reference);
        let at = format!("{} {}", reference.metal.id, reference.space);
        assert!(row.mean_delta_e <= reference.mean + TOLERANCE_DELTA_E, "{at}: {row:?}");
    }
}
