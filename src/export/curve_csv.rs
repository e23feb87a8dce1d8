//! The curve as numbers, one row for each whole degree.

use super::export::Written;
use crate::fresnel::CosTheta;
use crate::study::Form;

/// `theta_deg,red,green,blue` from 0° to 90°, unclamped, in digits that read back exactly.
pub(super) fn write(form: &Form) -> Written {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.write_record(["theta_deg", "red", "green", "blue"])?;
    for deg in 0..=90u8 {
        let [red, green, blue] = form.reflectance(CosTheta::from_deg(f64::from(deg))).0;
        csv.serialize((deg, red, green, blue))?;
    }
    Ok(csv.into_inner()?)
}
