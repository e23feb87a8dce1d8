//! L: the pixel a perfect mirror would have in the metal's place.

use super::facing::Facing;
use super::reference::ReferenceField;
use super::solved_light::solved_light;
use super::view::View;
use super::{CardReading, MatchError};
use crate::photo::{Area, AreaStatistics, Card, LightMode, MatchRequest, Pixel};

/// √3: a tolerance ± t with nothing known inside has the standard uncertainty t/√3 (GUM 2008, 4.3.7).
const RECTANGULAR: f64 = 1.732_050_807_568_877_2;
/// A card's stated reflectance, ± 2 %.
const CARD_TOLERANCE: f64 = 0.02 / RECTANGULAR;
/// Unevenness that one card position cannot show, ± 3 %.
const SINGLE_POSITION_SPREAD: f64 = 0.03 / RECTANGULAR;
/// How well a backdrop beside the rim stands for what the rim mirrors, relative.
const BACKDROP_DIFFERENCE: f64 = 0.05;

/// The light and how well it is known.
#[derive(Debug)]
pub(super) struct Light {
    /// Linear Rec.709 of a perfect mirror; `None` for a channel in which the reference is clipped.
    pub value: [Option<f64>; 3],
    /// Relative standard uncertainty of each channel.
    pub relative_uncertainty: [f64; 3],
    /// What each card showed.
    pub cards: Vec<(Card, AreaStatistics)>,
    /// The light where it is even; 1 where it is not known, so that fits stay finite.
    even: [f64; 3],
    /// 1 over it.
    over_even: [f64; 3],
    /// The light of each spot where a reference ball shows it.
    field: Option<ReferenceField>,
}

impl Light {
    /// The light of a request's mode.
    pub fn of(view: &View, request: &MatchRequest) -> Result<Self, MatchError> {
        match request.mode {
            LightMode::FlatMirror => Err(MatchError::needs(request.mode, "a card seen directly and in the mirror")),
            LightMode::ReferenceBall => Self::from_reference(view, request),
            LightMode::Card => Self::from_cards(view, request),
            LightMode::Backdrop => Self::from_backdrop(view, request),
            LightMode::SolvedLight => solved_light(view, request),
            LightMode::ByEye => Self::by_eye(request),
        }
    }

    /// F of a pixel: pixel over light. NaN where the light is not known.
    #[inline]
    pub fn reflectance(&self, view: &View, pixel: &Pixel, facing: &Facing) -> [f64; 3] {
        let over_light = self.field.as_ref().map_or(self.over_even, |field| over(field.light(view, facing)));
        std::array::from_fn(|i| pixel.rgb[i] * over_light[i])
    }

    /// L of a spot; NaN where it is not known.
    pub fn at(&self, view: &View, facing: &Facing) -> [f64; 3] {
        self.field.as_ref().map_or(self.even, |field| field.light(view, facing))
    }

    /// What each card showed.
    pub fn readings(&self) -> Vec<CardReading> {
        self.cards.iter().map(|(card, s)| CardReading { card: *card, statistics: s.clone() }).collect()
    }

    /// An even light.
    pub fn even(value: [Option<f64>; 3], relative_uncertainty: [f64; 3]) -> Self {
        let even = value.map(|value| value.unwrap_or(1.0));
        Self { value, relative_uncertainty, cards: Vec::new(), even, over_even: over(even), field: None }
    }

    fn by_eye(request: &MatchRequest) -> Result<Self, MatchError> {
        let light = request.light.filter(|light| light.is_finite() && light.min_channel() > 0.0);
        let light = light.ok_or(MatchError::needs(request.mode, "the light itself, three numbers above 0"))?;
        Ok(Self::even(light.0.map(Some), [0.0; 3]))
    }

    /// L = card ÷ reflectance: under an even light E a matt card sends ρE/π and a perfect mirror E/π.
    ///
    /// Without a card the grey scale serves: its curve makes white 1.
    fn from_cards(view: &View, request: &MatchRequest) -> Result<Self, MatchError> {
        let single = CARD_TOLERANCE.hypot(SINGLE_POSITION_SPREAD);
        let cards: Vec<_> = request.cards.iter().map(|card| (*card, view.statistics(card.area))).collect();
        if cards.is_empty() && view.has_greys() {
            return Ok(Self::even([Some(1.0); 3], [single; 3]));
        }
        if cards.is_empty() {
            return Err(MatchError::needs(request.mode, "a card of known reflectance"));
        }
        if cards.iter().any(|(_, statistics)| statistics.pixels == 0) {
            return Err(MatchError::NoPixels { what: "card" });
        }
        let channels: [_; 3] = std::array::from_fn(|channel| mean_of_cards(&cards, channel));
        Ok(Self { cards, ..Self::from_channels(channels, "card")? })
    }

    fn from_backdrop(view: &View, request: &MatchRequest) -> Result<Self, MatchError> {
        let area = request.backdrop.ok_or(MatchError::needs(request.mode, "an area of the backdrop beside the rim"))?;
        let statistics = view.statistics(area);
        if statistics.pixels == 0 {
            return Err(MatchError::NoPixels { what: "backdrop" });
        }
        let channel = |i: usize| {
            let uncertainty = BACKDROP_DIFFERENCE.hypot(relative_error(&statistics, i));
            (!statistics.is_clipped(i)).then_some((statistics.trimmed_mean[i], uncertainty))
        };
        Self::from_channels(std::array::from_fn(channel), "backdrop")
    }

    fn from_reference(view: &View, request: &MatchRequest) -> Result<Self, MatchError> {
        let needs = "a ball of a known metal and the ball or cylinder to measure";
        let ball = request.reference_ball.as_ref().filter(|_| request.body().is_some());
        let ball = ball.ok_or(MatchError::needs(request.mode, needs))?;
        let field = ReferenceField::of(ball)?;
        let statistics = view.statistics(Area::disc(ball.circle.x, ball.circle.y, ball.circle.ring_radius(40.0)));
        if statistics.pixels == 0 {
            return Err(MatchError::NoPixels { what: "reference ball" });
        }
        let channel = |i: usize| {
            let light = statistics.trimmed_mean[i] / field.facing_reflectance()[i];
            (!statistics.is_clipped(i)).then_some((light, ReferenceField::RELATIVE_UNCERTAINTY))
        };
        let light = Self::from_channels(std::array::from_fn(channel), "reference ball")?;
        Ok(Self { field: Some(field), ..light })
    }

    /// From the light and its relative uncertainty in each channel; `None` where the reference is clipped.
    fn from_channels(channels: [Option<(f64, f64)>; 3], what: &'static str) -> Result<Self, MatchError> {
        if channels.iter().flatten().any(|(light, _)| light.is_nan() || *light <= 0.0) {
            return Err(MatchError::DarkReference { what });
        }
        let value = channels.map(|channel| channel.map(|(light, _)| light));
        Ok(Self::even(value, channels.map(|channel| channel.map_or(0.0, |(_, uncertainty)| uncertainty))))
    }
}

fn over(light: [f64; 3]) -> [f64; 3] {
    light.map(|light| 1.0 / light)
}

/// The mean light of all positions and its relative uncertainty; `None` when a card is clipped.
fn mean_of_cards(cards: &[(Card, AreaStatistics)], channel: usize) -> Option<(f64, f64)> {
    if cards.iter().any(|(_, statistics)| statistics.is_clipped(channel)) {
        return None;
    }
    let lights: Vec<f64> =
        cards.iter().map(|(card, s)| s.trimmed_mean[channel] / card.reflectance_of(channel)).collect();
    let count = lights.len() as f64;
    let mean = lights.iter().sum::<f64>() / count;
    let spread = match lights.len() {
        1 => SINGLE_POSITION_SPREAD,
        _ => (lights.iter().map(|light| (light - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt() / mean,
    };
    let noise = cards.iter().map(|(_, s)| relative_error(s, channel).powi(2)).sum::<f64>().sqrt() / count;
    Some((mean, (CARD_TOLERANCE.powi(2) + spread.powi(2) + noise.powi(2)).sqrt()))
}

/// Standard error over value; 0 where the area is a single tile and shows none.
pub(super) fn relative_error(statistics: &AreaStatistics, channel: usize) -> f64 {
    let relative = statistics.standard_error[channel] / statistics.trimmed_mean[channel];
    if relative.is_finite() { relative.abs() } else { 0.0 }
}
