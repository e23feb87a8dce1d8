//! One metal as a function in a shading language, of r and ten coefficients for each channel: nearer to the measured
//! spectrum than r and h, and of no use for any other metal.

use super::export::name_in_space;
use super::names::{identifier, one_ascii_line};
use super::shader::function;
use super::{ExportError, ExportFile, Exported, Options, Target};
use crate::color::{RgbSpace, delta_e_rgb};
use crate::fit::bake;
use crate::fresnel::{CosTheta, SchlickSeries};
use crate::metal::Metal;
use crate::number::largest;
use crate::study::Form;

impl Target {
    /// Whether a metal can be written as a function of its own, see [`export_baked`].
    pub const fn can_bake(self) -> bool {
        self.is_shader()
    }
}

/// Writes a metal as a function of the cosine. What it loses is said in the file, not as a loss: r and h lose more.
pub fn export_baked(stem: &str, metal: &Metal, target: Target, options: &Options) -> Result<Exported, ExportError> {
    if !target.can_bake() {
        return Err(ExportError::Baked { target });
    }
    let space = options.space_for(target, RgbSpace::default())?;
    let series = bake(metal, space);
    let header = [
        format!("{}, written by Edgewise", metal.name),
        format!(
            "{space}: r and {} coefficients of each channel, within {:.1e} CIEDE2000 of the spectrum of {}",
            series.coefficients.len(),
            largest_delta_e(metal, &series, space),
            metal.id
        ),
    ];
    let comments: String = header.iter().map(|line| format!("// {}\n", one_ascii_line(line))).collect();
    let function = function(target, &identifier(&metal.name), &Form::Series(series));
    let bytes = format!("{comments}{function}").into_bytes();
    Ok(Exported { files: vec![ExportFile { name: name_in_space(stem, target, space), bytes }], losses: Vec::new() })
}

/// Over every half degree.
fn largest_delta_e(metal: &Metal, series: &SchlickSeries, space: RgbSpace) -> f64 {
    let off = |half: u16| {
        let c = CosTheta::from_deg(f64::from(half) / 2.0);
        delta_e_rgb(series.reflectance(c), metal.reflectance(c, space), space)
    };
    largest((0..=180).map(off))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metal::metal_by_name;

    #[test]
    fn only_shading_languages_have_a_function() {
        let gold = metal_by_name("gold").unwrap();
        let can: Vec<Target> = Target::ALL.into_iter().filter(|target| target.can_bake()).collect();
        assert_eq!(can, [Target::Glsl, Target::Hlsl, Target::Wgsl, Target::Osl]);
        let refused = export_baked("gold", gold, Target::Usd, &Options::default()).unwrap_err();
        assert!(refused.to_string().contains("glsl"), "{refused}");
    }

    #[test]
    fn the_file_says_how_near_it_is() {
        let osmium = metal_by_name("osmium").unwrap();
        let space = RgbSpace::AcesCg;
        let exported = export_baked("osmium", osmium, Target::Wgsl, &Options { space: Some(space) }).unwrap();
        let text = String::from_utf8(exported.files[0].bytes.clone()).unwrap();
        let off = largest_delta_e(osmium, &bake(osmium, space), space);
        assert_eq!(exported.files[0].name, "osmium.acescg.wgsl");
        assert!(off > 0.0 && text.contains(&format!("within {off:.1e} CIEDE2000")), "{text}");
    }
}
