//! A photograph as a match reads it: through the grey scale where there is one.

use std::ops::Range;

use super::MatchError;
use crate::photo::tone::ToneCurve;
use crate::photo::{Area, AreaStatistics, MatchRequest, Photo, Pixel};

/// A photograph and the curve that makes it proportional to light.
#[derive(Debug)]
pub(super) struct View<'a> {
    pub photo: &'a Photo,
    tone: Option<ToneCurve>,
}

impl<'a> View<'a> {
    /// Through the request's grey patches, if it has any. Everything that reads marks begins here, so that two outlines
    /// are refused here.
    pub fn of(photo: &'a Photo, request: &MatchRequest) -> Result<Self, MatchError> {
        if request.circle.is_some() && request.cylinder.is_some() {
            return Err(MatchError::TwoBodies);
        }
        let tone = match request.greys.as_slice() {
            [] => None,
            greys => Some(ToneCurve::through(photo, greys).ok_or(MatchError::Greys)?),
        };
        Ok(Self { photo, tone })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.photo.width, self.photo.height]
    }

    /// The pixel in a column and row; `None` outside.
    pub fn pixel(&self, column: u32, row: u32) -> Option<Pixel> {
        self.photo.pixel(column, row).map(|pixel| self.corrected(pixel))
    }

    /// Hands on the pixels of a row in some columns, from left to right; columns outside are left out.
    pub fn for_each_of_row(&self, row: u32, columns: Range<u32>, mut take: impl FnMut(Pixel)) {
        match &self.tone {
            None => self.photo.for_each_of_row(row, columns, take),
            Some(_) => self.photo.for_each_of_row(row, columns, |pixel| take(self.corrected(pixel))),
        }
    }

    fn corrected(&self, mut pixel: Pixel) -> Pixel {
        if let Some(tone) = &self.tone {
            for channel in 0..3 {
                pixel.rgb.0[channel] = tone.reflectance(channel, pixel.rgb[channel]);
            }
        }
        pixel
    }

    /// What an area holds.
    pub fn statistics(&self, area: Area) -> AreaStatistics {
        AreaStatistics::of_pixels(self.photo, area, |pixel| self.corrected(pixel))
    }

    /// True when neutral patches gave the tone curve: white is then 1.
    pub fn has_greys(&self) -> bool {
        self.tone.is_some()
    }

    /// True when the grey scale has no patch as bright as this value that was read through it.
    pub fn is_beyond_greys(&self, value: f64) -> bool {
        self.tone.as_ref().is_some_and(|tone| tone.is_extended_to(value))
    }

    /// Relative standard uncertainty of a value that was read in a channel because of the tone curve.
    pub fn tone_uncertainty(&self, channel: usize, value: f64) -> f64 {
        /// A reflectance read through a camera's unknown tone curve is known to ± 25 %.
        const ASSUMED_TONE_CURVE: f64 = 0.125;
        match &self.tone {
            Some(tone) => tone.uncertainty(channel, value),
            None if self.is_estimate() => ASSUMED_TONE_CURVE,
            None => 0.0,
        }
    }

    /// True when a tone curve may stand between the values and the light.
    pub fn is_estimate(&self) -> bool {
        self.tone.is_none() && !self.photo.is_scene_linear()
    }
}
