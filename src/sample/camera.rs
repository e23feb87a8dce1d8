//! From a scene's radiance to the stored picture: exposure, blur, noise, tone curve, file.

use image::ImageError;
use image::codecs::jpeg::JpegEncoder;

use crate::color::{Rgb, srgb_encode};

/// A camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// What multiplies the radiance.
    pub exposure: f64,
    /// Standard deviation of the lens blur in pixels.
    pub blur_px: f64,
    /// Shot noise: the standard deviation at the value 1, growing with the square root.
    pub noise: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl Camera {
    /// The exposed picture, linear and unclamped: blurred, then with noise.
    pub fn expose(&self, radiance: &[Rgb], width: u32) -> Vec<Rgb> {
        let mut picture = blurred(radiance, width as usize, self.blur_px);
        let mut noise = Noise(self.seed);
        for pixel in &mut picture {
            *pixel = (*pixel * self.exposure).map(|value| value + self.noise * value.max(0.0).sqrt() * noise.next());
        }
        picture
    }
}

/// Gaussian blur in rows, then in columns; the ends are held.
fn blurred(picture: &[Rgb], width: usize, sigma_px: f64) -> Vec<Rgb> {
    if sigma_px <= 0.0 {
        return picture.to_vec();
    }
    let reach = (3.0 * sigma_px).ceil() as isize;
    let kernel: Vec<f64> = (-reach..=reach).map(|i| (-0.5 * (i as f64 / sigma_px).powi(2)).exp()).collect();
    let total: f64 = kernel.iter().sum();
    let height = picture.len() / width;
    let pass = |source: &[Rgb], step: (isize, isize)| -> Vec<Rgb> {
        let at = |index: usize, offset: isize| {
            let clamp = |value: usize, step: isize, size: usize| {
                (value as isize + step * offset).clamp(0, size as isize - 1) as usize
            };
            source[clamp(index / width, step.1, height) * width + clamp(index % width, step.0, width)]
        };
        let mean =
            |index| (-reach..=reach).zip(&kernel).fold(Rgb::BLACK, |sum, (o, w)| sum + at(index, o) * (w / total));
        (0..source.len()).map(mean).collect()
    };
    pass(&pass(picture, (1, 0)), (0, 1))
}

/// Normal deviates from SplitMix64 (Steele, Lea & Flood 2014): seeded, the same on every machine.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The sum of twelve uniform deviates less six: normal to within what a camera's noise is, and bounded.
    fn next(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// A camera's tone curve: mid-tones lifted and highlights rolled off before the sRGB curve.
pub fn camera_tone(linear: f64) -> f64 {
    const SHOULDER: f64 = 2.4;
    srgb_encode((1.0 - (-SHOULDER * linear.max(0.0)).exp()) / (1.0 - (-SHOULDER * 1.25_f64).exp()))
}

/// A 16-bit PNG that says it is linear Rec.709 (gAMA 1, cHRM), of which `bits` are used: what a sensor delivers.
pub fn linear_png(picture: &[Rgb], width: u32, bits: u32) -> Result<Vec<u8>, png::EncodingError> {
    let top = f64::from((1u32 << bits) - 1);
    let stored = |value: f64| ((value.clamp(0.0, 1.0) * top).round() / top * 65535.0).round() as u16;
    let bytes: Vec<u8> = picture.iter().flat_map(|pixel| pixel.0.map(stored)).flat_map(u16::to_be_bytes).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, picture.len() as u32 / width);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.set_compression(png::Compression::High);
    encoder.set_source_gamma(png::ScaledFloat::new(1.0));
    let xy = |x: f32, y: f32| (png::ScaledFloat::new(x), png::ScaledFloat::new(y));
    encoder.set_source_chromaticities(png::SourceChromaticities {
        white: xy(0.3127, 0.3290),
        red: xy(0.64, 0.33),
        green: xy(0.30, 0.60),
        blue: xy(0.15, 0.06),
    });
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(file)
}

/// An 8-bit JPEG through a camera's tone curve.
pub fn camera_jpeg(picture: &[Rgb], width: u32, quality: u8) -> Result<Vec<u8>, ImageError> {
    let stored = |value: f64| (camera_tone(value).clamp(0.0, 1.0) * 255.0).round() as u8;
    let bytes: Vec<u8> = picture.iter().flat_map(|pixel| pixel.0.map(stored)).collect();
    let mut file = Vec::new();
    let height = picture.len() as u32 / width;
    JpegEncoder::new_with_quality(&mut file, quality).encode(&bytes, width, height, image::ExtendedColorType::Rgb8)?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blur_keeps_the_mean() {
        let picture: Vec<Rgb> = (0..64).map(|i| Rgb::splat(if i == 27 { 64.0 } else { 0.0 })).collect();
        let sum: f64 = blurred(&picture, 8, 0.8).iter().map(|pixel| pixel[0]).sum();
        assert!((sum - 64.0).abs() < 0.1, "{sum}");
    }

    #[test]
    fn noise_is_standard() {
        let mut noise = Noise(7);
        let values: Vec<f64> = (0..100_000).map(|_| noise.next()).collect();
        let mean = values.iter().sum::<f64>() / 1e5;
        let variance = values.iter().map(|v| v * v).sum::<f64>() / 1e5;
        assert!(mean.abs() < 0.015 && (variance - 1.0).abs() < 0.02, "{mean} {variance}");
    }

    /// With white at .75 a true .55 reads .74–.84 when decoded as sRGB.
    #[test]
    fn the_tone_curve_lifts_as_cameras_do() {
        use crate::color::srgb_decode;
        let read = srgb_decode(camera_tone(0.55 * 0.75)) / srgb_decode(camera_tone(0.75));
        assert!((0.70..0.84).contains(&read), "{read}");
    }
}
