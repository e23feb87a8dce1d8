//! Things people type: each parser says in one sentence what it expected.

use crate::color::Rgb;
use crate::fit::Method;
use crate::fresnel::{ModelKind, THETA_MAX_DEG};
use crate::spectrum::SAMPLES;

/// More angles than this are a slip of the keyboard.
const MOST_ANGLES: usize = 100_000;

/// A finite number.
pub fn number(text: &str) -> Result<f64, String> {
    let value: f64 = text.trim().parse().map_err(|_| format!("“{text}” is no number"))?;
    if value.is_finite() { Ok(value) } else { Err(format!("“{text}” is not finite")) }
}

/// `0.9,0.7,0.4`: three finite numbers, unclamped.
pub fn triple(text: &str) -> Result<Rgb, String> {
    let values = text.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
    let channels = <[f64; 3]>::try_from(values);
    channels.map(Rgb).map_err(|values| format!("expected three numbers like 0.9,0.7,0.4, found {}", values.len()))
}

/// A number of 0 to 1.
pub fn share(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err(format!("{value} lies outside 0–1")) }
}

/// Doublings of light that still leave room in 32-bit floats.
pub fn stops(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value.abs() <= 20.0 { Ok(value) } else { Err(format!("{value} stops lie outside −20 to 20")) }
}

/// A number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 { Ok(value) } else { Err(format!("{value} is not above 0")) }
}

/// What computes a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// The truth of a metal.
    Spectral,
    /// The spectral model with so many wavelengths.
    FewWavelengths(usize),
    /// A model of three channels.
    Rgb(ModelKind),
}

/// `spectral`, `spectral-8`, or a model's identifier.
pub fn model(text: &str) -> Result<Model, String> {
    let few = |count: &str| count.parse().ok().filter(|count| (2..=SAMPLES).contains(count)).map(Model::FewWavelengths);
    match text.strip_prefix("spectral-") {
        _ if text == "spectral" => Ok(Model::Spectral),
        Some(count) => {
            few(count).ok_or_else(|| format!("“{text}” needs a number of 2–{SAMPLES} wavelengths, like spectral-8"))
        }
        None => text
            .parse()
            .map(Model::Rgb)
            .map_err(|unknown: crate::color::UnknownName| format!("{unknown}, spectral, spectral-N")),
    }
}

/// `hoffman`, or `conductor:colour-matching`: a model, and how its parameters are derived from a metal.
pub fn model_with_method(text: &str) -> Result<(Model, Option<Method>), String> {
    match text.split_once(':') {
        None => Ok((model(text)?, None)),
        Some((name, way)) => {
            let method = way.parse().map_err(|unknown: crate::color::UnknownName| unknown.to_string())?;
            Ok((model(name)?, Some(method)))
        }
    }
}

/// Angles of incidence in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Angles(pub Vec<f64>);

/// `0:90:1` (first:last:step) or `0,45,81.8`; `max` is θ_max, 81.787°.
pub fn angles(text: &str) -> Result<Angles, String> {
    let angles = if text.contains(':') { stepped(text)? } else { listed(text)? };
    match angles.iter().find(|angle| !(0.0..=90.0).contains(*angle)) {
        Some(outside) => Err(format!("the angle {outside}° lies outside 0–90°")),
        None => Ok(Angles(angles)),
    }
}

fn listed(text: &str) -> Result<Vec<f64>, String> {
    text.split(',').map(|part| if part.trim() == "max" { Ok(THETA_MAX_DEG) } else { number(part) }).collect()
}

/// The last angle is included where the steps reach it.
fn stepped(text: &str) -> Result<Vec<f64>, String> {
    let parts = text.split(':').map(number).collect::<Result<Vec<_>, _>>()?;
    let [first, last, step] = parts[..] else {
        return Err(format!("expected first:last:step like 0:90:1, found “{text}”"));
    };
    if step <= 0.0 || last < first {
        return Err(format!("“{text}” does not lead from the first angle to the last: the step must be positive"));
    }
    // A last step that rounding leaves a billionth short still counts.
    let steps = ((last - first) / step + 1e-9).floor();
    if steps >= MOST_ANGLES as f64 {
        return Err(format!("“{text}” is more than {MOST_ANGLES} angles"));
    }
    Ok((0..=steps as usize).map(|index| (first + index as f64 * step).min(last)).collect())
}

/// A number of steps that finishes while one looks at it.
pub fn steps(text: &str) -> Result<usize, String> {
    let steps = text.parse().ok().filter(|steps| (2..=MOST_ANGLES).contains(steps));
    steps.ok_or_else(|| format!("“{text}” is no whole number of 2 to {MOST_ANGLES}"))
}

/// Whole pixel indices: column and row from the top left.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Probes(pub Vec<(u32, u32)>);

/// `0,0;120,80`; empty for none.
pub fn probes(text: &str) -> Result<Probes, String> {
    let parts = text.split(';').map(str::trim).filter(|part| !part.is_empty());
    parts.map(probe).collect::<Result<_, _>>().map(Probes)
}

fn probe(text: &str) -> Result<(u32, u32), String> {
    let index = |part: &str| part.trim().parse::<u32>().ok();
    let pair = text.split_once(',').and_then(|(column, row)| Some((index(column)?, index(row)?)));
    pair.ok_or_else(|| format!("“{text}” is no pixel; write whole column,row like 120,80"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triples_are_three_finite_numbers_of_any_size() {
        assert_eq!(triple("1.04, -0.1,2e3"), Ok(Rgb([1.04, -0.1, 2000.0])));
        for (text, reason) in
            [("1,2", "found 2"), ("1,2,x", "“x” is no number"), ("1,NaN,1", "not finite"), ("1;2;3", "no number")]
        {
            assert!(triple(text).unwrap_err().contains(reason), "{text}");
        }
    }

    #[test]
    fn probes_are_whole_pixels() {
        assert_eq!(probes("0,0; 12,34;"), Ok(Probes(vec![(0, 0), (12, 34)])));
        assert_eq!(probes(""), Ok(Probes::default()));
        for text in ["1", "1,2,3", "0.5,1", "-1,0", "a,b"] {
            assert!(probes(text).unwrap_err().contains("no pixel"), "{text}");
        }
    }

    #[test]
    fn angles_are_stepped_or_listed() {
        assert_eq!(angles("0:90:1").unwrap().0.len(), 91);
        assert_eq!(angles("0:90:0.1").unwrap().0.last(), Some(&90.0));
        assert_eq!(angles("0:10:4").unwrap().0, [0.0, 4.0, 8.0]);
        assert_eq!(angles("0, 45,max").unwrap().0, [0.0, 45.0, THETA_MAX_DEG]);
    }

    #[test]
    fn angles_that_are_none_are_refused() {
        let reasons = [
            ("0:90", "first:last:step"),
            ("0:90:0", "positive"),
            ("90:0:1", "first angle to the last"),
            ("0:91:1", "91°"),
            ("-1,2", "-1°"),
            ("", "no number"),
            ("0:90:1e-9", "more than"),
            ("0:90:nan", "not finite"),
            ("45°", "no number"),
        ];
        for (text, reason) in reasons {
            let said = angles(text).unwrap_err();
            assert!(said.contains(reason), "{text}: {said}");
        }
    }
}
