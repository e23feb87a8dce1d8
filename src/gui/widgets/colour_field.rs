//! One colour, in every way people write colours down.

use eframe::egui::{Align, Id, Layout, Response, RichText, TextEdit, TextStyle, Ui, Vec2};

use super::{NumberField, colour_slider, colour32, swatch};
use crate::color::{
    Rgb, RgbSpace, hex_from_srgb8, linear_from_srgb8, oklch_from_rgb, rgb_from_oklch, srgb_decode, srgb_encode, srgb8,
    srgb8_from_hex,
};
use crate::gui::theme;

/// The channels of every RGB space.
pub(crate) const fn channel_names() -> [&'static str; 3] {
    ["red", "green", "blue"]
}

/// Below this chroma a hue means nothing, and the last one is kept so that it comes back with the chroma.
const LEAST_CHROMA: f64 = 1e-4;
/// The most chroma a slider offers; any in sRGB has less.
const MOST_CHROMA: f64 = 0.33;

/// An editor of one colour. Nothing is clamped: a value beyond a slider stays and is shown in the fields.
pub(crate) struct ColourField<'a> {
    /// The paper's symbol.
    pub symbol: &'static str,
    /// What it is, and at which angle.
    pub title: &'static str,
    /// The colour, linear in `space`.
    pub colour: &'a mut Rgb,
    /// The space of the preset.
    pub space: RgbSpace,
}

/// What the sliders move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Sliders {
    /// The channels, by the sRGB curve so that equal steps look alike.
    #[default]
    Channels,
    /// Lightness, chroma and hue.
    Oklch,
}

impl ColourField<'_> {
    /// Shows it; true when the colour was changed.
    pub(crate) fn show(mut self, ui: &mut Ui) -> bool {
        let before = *self.colour;
        ui.push_id(self.symbol, |ui| {
            let sliders = self.header(ui);
            ui.horizontal(|ui| {
                swatch(ui, *self.colour, self.space, Vec2::splat(theme::SWATCH));
                ui.vertical(|ui| match sliders {
                    Sliders::Channels => self.channel_sliders(ui),
                    Sliders::Oklch => self.oklch_sliders(ui),
                });
            });
            self.linear_row(ui);
            self.srgb_row(ui);
            self.oklch_row(ui);
        });
        *self.colour != before
    }

    fn header(&self, ui: &mut Ui) -> Sliders {
        let id = ui.scope_id().with("sliders");
        let mut sliders = ui.data(|data| data.get_temp::<Sliders>(id)).unwrap_or_default();
        ui.horizontal(|ui| {
            ui.heading(self.symbol);
            ui.label(theme::title(self.title));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let choices = [
                    (Sliders::Oklch, "LCH", "OKLCH lightness, chroma and hue"),
                    (Sliders::Channels, "RGB", "the channels, sRGB-encoded"),
                ];
                for (choice, label, what) in choices {
                    ui.selectable_value(&mut sliders, choice, label)
                        .on_hover_text(format!("The sliders move {what}"))
                        .accessible_name(format!("{} sliders move {what}", self.symbol));
                }
            });
        });
        ui.data_mut(|data| data.insert_temp(id, sliders));
        sliders
    }

    fn channel_sliders(&mut self, ui: &mut Ui) {
        let (colour, space) = (*self.colour, self.space);
        for (channel, name) in channel_names().into_iter().enumerate() {
            let with = |encoded: f64| {
                let mut changed = colour;
                changed.0[channel] = srgb_decode(encoded);
                changed
            };
            let mut encoded = srgb_encode(colour[channel]);
            let name = format!("{} {name}, sRGB-encoded {}", self.symbol, space.label());
            ui.horizontal(|ui| {
                let colour_at = |encoded| colour32(with(encoded), space).0;
                let slid =
                    colour_slider(ui, &mut encoded, 0.0..=1.0, &format!("{name} slider"), slider_width(ui), colour_at);
                let field = NumberField::new(&mut encoded, name).precision(3, 0.002).width(VALUE_WIDTH);
                if field.show(ui).changed() || slid.changed() {
                    self.colour.0[channel] = srgb_decode(encoded);
                }
            });
        }
    }

    fn oklch_sliders(&mut self, ui: &mut Ui) {
        let space = self.space;
        let oklch = self.oklch(ui);
        for (index, part) in OKLCH_PARTS.into_iter().enumerate() {
            let mut value = oklch[index];
            let with = |value: f64| {
                let mut changed = oklch;
                changed[index] = value;
                rgb_from_oklch(changed, space)
            };
            let name = format!("{} {} slider", self.symbol, part.name);
            ui.horizontal(|ui| {
                let colour_at = |value| colour32(with(value), space).0;
                let slid = colour_slider(ui, &mut value, 0.0..=part.most, &name, slider_width(ui), colour_at);
                ui.label(theme::number(format!("{value:.*}", part.decimals)));
                if slid.changed() {
                    self.set_oklch(ui, index, value);
                }
            });
        }
    }

    fn linear_row(&mut self, ui: &mut Ui) {
        let space = self.space;
        row(ui, space_words(space), "Linear numbers of the preset's space, unclamped", |ui| {
            for (channel, name) in channel_names().into_iter().enumerate() {
                let name = format!("{} {name}, linear {}", self.symbol, space.label());
                NumberField::new(&mut self.colour.0[channel], name).width(third(ui, channel)).show(ui);
            }
        });
    }

    fn srgb_row(&mut self, ui: &mut Ui) {
        let (code, is_clipped) = srgb8(*self.colour, self.space);
        let what = if is_clipped {
            "8-bit sRGB of the nearest colour that sRGB has; changing it gives up what lies outside"
        } else {
            "8-bit sRGB, and the same as a hex code"
        };
        row(ui, "sRGB 8-bit", what, |ui| {
            let mut changed = None;
            for (channel, name) in channel_names().into_iter().enumerate() {
                let mut value = f64::from(code[channel]);
                let name = format!("{} {name}, sRGB 8-bit", self.symbol);
                let field = NumberField::new(&mut value, name).precision(0, 0.3).range(0.0..=255.0).width(42.0);
                if field.show(ui).changed() {
                    let mut code = code;
                    code[channel] = value.round() as u8;
                    changed = Some(code);
                }
            }
            changed = changed.or_else(|| self.hex_field(ui, code));
            if let Some(code) = changed {
                *self.colour = RgbSpace::LinRec709.convert(linear_from_srgb8(code), self.space);
            }
        });
    }

    /// The hex code; what is typed counts once it is complete and the field is left.
    fn hex_field(&self, ui: &mut Ui, code: [u8; 3]) -> Option<[u8; 3]> {
        let id = ui.scope_id().with("hex");
        let current = hex_from_srgb8(code);
        let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| current.clone());
        let response = ui
            .add(
                TextEdit::singleline(&mut text)
                    .id(id.with("field"))
                    .font(TextStyle::Monospace)
                    .char_limit(9)
                    .desired_width(f32::INFINITY),
            )
            .on_hover_text("sRGB hex code, such as #c89b6e");
        let response = response.accessible_name(format!("{} sRGB hex code", self.symbol));
        if response.has_focus() {
            ui.data_mut(|data| data.insert_temp(id, text));
            return None;
        }
        ui.data_mut(|data| data.remove::<String>(id));
        let typed = response.lost_focus().then(|| srgb8_from_hex(&text).ok()).flatten();
        typed.filter(|typed| *typed != code)
    }

    fn oklch_row(&mut self, ui: &mut Ui) {
        let oklch = self.oklch(ui);
        row(ui, "OKLCH", "Lightness, chroma and hue by Ottosson 2020", |ui| {
            for (index, part) in OKLCH_PARTS.into_iter().enumerate() {
                let mut value = oklch[index];
                let name = format!("{} {}", self.symbol, part.name);
                let field = NumberField::new(&mut value, name)
                    .precision(part.decimals, part.most / 400.0)
                    .suffix(part.suffix)
                    .width(third(ui, index));
                if field.show(ui).changed() {
                    self.set_oklch(ui, index, value);
                }
            }
        });
    }

    /// OKLCH, with the last hue that meant something where this one does not.
    fn oklch(&self, ui: &Ui) -> [f64; 3] {
        let [lightness, chroma, hue_deg] = oklch_from_rgb(*self.colour, self.space);
        let id = self.hue_id();
        if chroma > LEAST_CHROMA {
            ui.data_mut(|data| data.insert_temp(id, hue_deg));
            return [lightness, chroma, hue_deg];
        }
        [lightness, chroma, ui.data(|data| data.get_temp(id)).unwrap_or(hue_deg)]
    }

    fn set_oklch(&mut self, ui: &Ui, index: usize, value: f64) {
        let mut oklch = self.oklch(ui);
        oklch[index] = if index == 2 { value.rem_euclid(360.0) } else { value };
        ui.data_mut(|data| data.insert_temp(self.hue_id(), oklch[2]));
        *self.colour = rgb_from_oklch(oklch, self.space);
    }

    fn hue_id(&self) -> Id {
        Id::unique((self.symbol, "hue"))
    }
}

/// Width of the number behind a slider.
pub(crate) const VALUE_WIDTH: f32 = 52.0;

/// Quiet words in front of a row of fields, as wide as all of them.
pub(crate) fn row_label(ui: &mut Ui, words: &str) -> Response {
    let size = Vec2::new(theme::LABEL_WIDTH, theme::ROW);
    let layout = Layout::left_to_right(Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_size(size);
        ui.label(RichText::new(words).weak())
    })
    .inner
}

#[derive(Clone, Copy)]
struct OklchPart {
    name: &'static str,
    most: f64,
    decimals: usize,
    suffix: &'static str,
}

const OKLCH_PARTS: [OklchPart; 3] = [
    OklchPart { name: "OKLCH lightness", most: 1.0, decimals: 3, suffix: "" },
    OklchPart { name: "OKLCH chroma", most: MOST_CHROMA, decimals: 4, suffix: "" },
    OklchPart { name: "OKLCH hue", most: 360.0, decimals: 1, suffix: "°" },
];

fn slider_width(ui: &Ui) -> f32 {
    (ui.available_width() - VALUE_WIDTH - theme::GAP).max(40.0)
}

/// The width of one of three fields in the rest of a row, of which `index` are there already.
fn third(ui: &Ui, index: usize) -> f32 {
    let left = (3 - index) as f32;
    (ui.available_width() - theme::GAP * (left - 1.0)) / left
}

fn space_words(space: RgbSpace) -> &'static str {
    match space {
        RgbSpace::LinRec709 => "Linear sRGB",
        RgbSpace::LinDisplayP3 => "Linear P3",
        RgbSpace::LinRec2020 => "Linear 2020",
        RgbSpace::AcesCg => "ACEScg",
    }
}

/// A row of fields behind the words that say their space.
fn row(ui: &mut Ui, words: &str, tooltip: &str, fields: impl FnOnce(&mut Ui)) -> Response {
    ui.horizontal(|ui| {
        row_label(ui, words).on_hover_text(tooltip);
        fields(ui);
    })
    .response
}
