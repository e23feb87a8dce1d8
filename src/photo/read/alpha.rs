//! Alpha: a photograph is opaque, so it is dropped, and whoever measures hears of it.

use half::f16;

use crate::photo::{Warning, WarningCode};

/// Gathers the colour channels of pixels that may carry alpha.
pub(super) struct Opaque<T> {
    /// Interleaved colour without alpha.
    pub samples: Vec<T>,
    /// Channels of a pixel before, 1–4; 2 and 4 carry alpha.
    channels: usize,
    is_premultiplied: bool,
    transparent: usize,
}

/// A number that can be alpha.
pub(super) trait AlphaSample: Copy + PartialEq {
    /// Full cover.
    const OPAQUE: Self;

    /// A colour that was multiplied by `alpha`, without that.
    fn divided_by(self, alpha: Self) -> Self;
}

macro_rules! integer_alpha {
    ($integer:ty) => {
        impl AlphaSample for $integer {
            const OPAQUE: Self = Self::MAX;

            fn divided_by(self, alpha: Self) -> Self {
                let scaled = u64::from(self) * u64::from(Self::MAX) + u64::from(alpha / 2);
                scaled.checked_div(u64::from(alpha)).map_or(self, |v| v.min(u64::from(Self::MAX)) as Self)
            }
        }
    };
}

integer_alpha!(u8);
integer_alpha!(u16);

impl AlphaSample for f32 {
    const OPAQUE: Self = 1.0;

    fn divided_by(self, alpha: Self) -> Self {
        if alpha > 0.0 { self / alpha } else { self }
    }
}

impl AlphaSample for f16 {
    const OPAQUE: Self = f16::ONE;

    fn divided_by(self, alpha: Self) -> Self {
        f16::from_f32(self.to_f32().divided_by(alpha.to_f32()))
    }
}

impl<T: AlphaSample> Opaque<T> {
    /// Starts with room for the colours; `channels` counts alpha.
    pub fn new(room: Vec<T>, channels: usize, is_premultiplied: bool) -> Self {
        assert!((1..=4).contains(&channels));
        Self { samples: room, channels, is_premultiplied, transparent: 0 }
    }

    /// Channels of colour in a pixel: 1 or 3.
    pub fn colours(&self) -> usize {
        if self.channels < 3 { 1 } else { 3 }
    }

    /// Takes whole pixels.
    pub fn extend(&mut self, pixels: &[T]) {
        if self.channels == self.colours() {
            return self.samples.extend_from_slice(pixels);
        }
        let colours = self.colours();
        for pixel in pixels.chunks_exact(self.channels) {
            let alpha = pixel[colours];
            self.transparent += usize::from(alpha != T::OPAQUE);
            let undo = self.is_premultiplied && alpha != T::OPAQUE;
            let colour = pixel[..colours].iter().map(|v| if undo { v.divided_by(alpha) } else { *v });
            self.samples.extend(colour);
        }
    }

    /// One sentence where a pixel was not opaque.
    pub fn warning(&self) -> Option<Warning> {
        let done = if self.is_premultiplied { "divided out" } else { "ignored" };
        let message = format!("{} pixels are partly transparent; alpha was {done}", self.transparent);
        (self.transparent > 0).then(|| Warning::new(WarningCode::Alpha, message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opaque_alpha_goes_silently_and_the_rest_does_not() {
        let mut opaque = Opaque::<u8>::new(Vec::new(), 4, false);
        opaque.extend(&[1, 2, 3, 255]);
        assert_eq!(opaque.warning(), None);
        opaque.extend(&[4, 5, 6, 254]);
        assert!(opaque.warning().unwrap().message.starts_with("1 pixels"));
        assert_eq!(opaque.samples, [1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn premultiplied_colours_are_restored() {
        let mut opaque = Opaque::<f32>::new(Vec::new(), 4, true);
        opaque.extend(&[0.2, 0.1, 0.05, 0.5, 1.0, 2.0, 3.0, 0.0]);
        assert_eq!(opaque.samples, [0.4, 0.2, 0.1, 1.0, 2.0, 3.0]);
        let mut grey = Opaque::<u16>::new(Vec::new(), 2, true);
        grey.extend(&[100, 32_768, 7, 0]);
        assert_eq!(grey.samples, [200, 7]);
    }
}
