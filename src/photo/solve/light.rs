//! L: the pixel a perfect mirror would have.

use super::{CardReading, MatchError};
use crate::photo::{AreaStatistics, Card, LightMode, MatchRequest, Photo, Pixel};

/// Standard uncertainty of a card's stated reflectance, relative.
const CARD_TOLERANCE: f64 = 0.02;
/// Unevenness to expect where one card position cannot show it, relative.
const SINGLE_POSITION_SPREAD: f64 = 0.03;

/// The light and how well it is known.
#[derive(Debug)]
pub(super) struct Light {
    /// Linear Rec.709 of a perfect mirror; `None` for a channel in which the reference is clipped.
    pub value: [Option<f64>; 3],
    /// Relative standard uncertainty of each channel.
    pub relative_uncertainty: [f64; 3],
    /// What each card showed.
    pub cards: Vec<(Card, AreaStatistics)>,
    /// What divides a pixel; 1 where the light is not known, so that fits stay finite.
    divisor: [f64; 3],
}

impl Light {
    /// The light of a request's mode.
    pub fn of(photo: &Photo, request: &MatchRequest) -> Result<Self, MatchError> {
        match request.mode {
            LightMode::ByEye => Self::by_eye(request),
            LightMode::Card => Self::from_cards(photo, request),
            mode => Err(MatchError::ModeNotMarked { mode, needs: "a mode with a card, or by eye" }),
        }
    }

    /// F of a pixel: pixel over light.
    pub fn reflectance(&self, pixel: &Pixel) -> [f64; 3] {
        std::array::from_fn(|i| pixel.rgb[i] / self.divisor[i])
    }

    /// What each card showed.
    pub fn readings(&self) -> Vec<CardReading> {
        let reading =
            |(card, statistics): &(Card, AreaStatistics)| CardReading { card: *card, statistics: statistics.clone() };
        self.cards.iter().map(reading).collect()
    }

    fn new(value: [Option<f64>; 3], relative_uncertainty: [f64; 3]) -> Self {
        let divisor = value.map(|value| value.unwrap_or(1.0));
        Self { value, relative_uncertainty, cards: Vec::new(), divisor }
    }

    fn by_eye(request: &MatchRequest) -> Result<Self, MatchError> {
        let needs = "the light itself, three numbers above 0";
        let light = request.light.ok_or(MatchError::ModeNotMarked { mode: request.mode, needs })?;
        if !(light.is_finite() && light.min_channel() > 0.0) {
            return Err(MatchError::ModeNotMarked { mode: request.mode, needs });
        }
        Ok(Self::new(light.0.map(Some), [0.0; 3]))
    }

    /// L = card ÷ reflectance: under an even light E a matt card sends ρE/π and a perfect mirror E/π.
    fn from_cards(photo: &Photo, request: &MatchRequest) -> Result<Self, MatchError> {
        let needs = "a card of known reflectance";
        let cards: Vec<_> = request.cards.iter().map(|card| (*card, AreaStatistics::of(photo, card.area))).collect();
        if cards.is_empty() {
            return Err(MatchError::ModeNotMarked { mode: request.mode, needs });
        }
        if cards.iter().any(|(_, statistics)| statistics.pixels == 0) {
            return Err(MatchError::NoPixels { what: "card" });
        }
        let channels: [_; 3] = std::array::from_fn(|channel| mean_of_cards(&cards, channel));
        if channels.iter().flatten().any(|(light, _)| *light <= 0.0) {
            return Err(MatchError::DarkReference { what: "card" });
        }
        let value = channels.map(|channel| channel.map(|(light, _)| light));
        let uncertainty = channels.map(|channel| channel.map_or(0.0, |(_, uncertainty)| uncertainty));
        Ok(Self { cards, ..Self::new(value, uncertainty) })
    }
}

/// The mean light of all positions and its relative uncertainty; `None` when a card is clipped.
fn mean_of_cards(cards: &[(Card, AreaStatistics)], channel: usize) -> Option<(f64, f64)> {
    if cards.iter().any(|(_, statistics)| statistics.is_clipped(channel)) {
        return None;
    }
    let lights: Vec<f64> = cards.iter().map(|(card, s)| s.trimmed_mean[channel] / card.reflectance).collect();
    let count = lights.len() as f64;
    let mean = lights.iter().sum::<f64>() / count;
    let spread = match lights.len() {
        1 => SINGLE_POSITION_SPREAD,
        _ => (lights.iter().map(|light| (light - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt() / mean,
    };
    let noise = cards.iter().map(|(_, s)| relative_error(s, channel).powi(2)).sum::<f64>().sqrt() / count;
    mean.is_finite().then(|| (mean, (CARD_TOLERANCE.powi(2) + spread.powi(2) + noise.powi(2)).sqrt()))
}

/// Standard error over value; 0 where the area is a single tile and shows none.
fn relative_error(statistics: &AreaStatistics, channel: usize) -> f64 {
    let relative = statistics.standard_error[channel] / statistics.trimmed_mean[channel];
    if relative.is_finite() { relative.abs() } else { 0.0 }
}
