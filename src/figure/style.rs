//! Colours, sizes and dashes of figures, in a light and a dark variant.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::color::UnknownName;

/// A colour to draw with: 8-bit sRGB and opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// 8-bit sRGB.
    pub rgb: [u8; 3],
    /// Opacity, 0–1.
    pub alpha: f64,
}

impl Ink {
    /// An opaque colour from `0xrrggbb`.
    pub const fn hex(code: u32) -> Self {
        Self { rgb: [(code >> 16) as u8, (code >> 8) as u8, code as u8], alpha: 1.0 }
    }

    /// An opaque colour.
    pub const fn opaque(rgb: [u8; 3]) -> Self {
        Self { rgb, alpha: 1.0 }
    }

    /// The same colour at another opacity.
    pub const fn alpha(self, alpha: f64) -> Self {
        Self { alpha, ..self }
    }
}

/// Which of the two looks a figure has. Both grounds are neutral, so that swatches are judged against grey.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FigureTheme {
    /// Dark ink on white: print and slides.
    #[default]
    Light,
    /// Light ink on near-black.
    Dark,
}

/// The colours of a theme.
#[derive(Clone, Copy, Debug)]
pub struct Palette {
    /// Behind everything.
    pub ground: Ink,
    /// Titles and values.
    pub ink: Ink,
    /// Captions, ticks.
    pub muted: Ink,
    /// Grid lines.
    pub grid: Ink,
    /// Lines that mark a value: F = 1, θ_max.
    pub mark: Ink,
    /// The red, green and blue channel; they differ in lightness too, for eyes that confuse red and green.
    pub channels: [Ink; 3],
    /// Models, in order.
    pub models: [Ink; 6],
}

impl FigureTheme {
    /// Both themes.
    pub const ALL: [Self; 2] = [Self::Light, Self::Dark];

    /// The stable identifier used on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Dark => "dark",
        }
    }

    /// The colours of the theme.
    pub const fn palette(self) -> Palette {
        let hex = Ink::hex;
        match self {
            Self::Light => Palette {
                ground: hex(0xffffff),
                ink: hex(0x1c1c1c),
                muted: hex(0x6a6a6a),
                grid: hex(0xe6e6e6),
                mark: hex(0x9a9a9a),
                channels: [hex(0xc62f3b), hex(0x27a35a), hex(0x2a53c7)],
                models: [hex(0x6f3fc0), hex(0xd9780f), hex(0x0f8796), hex(0xc23a86), hex(0x7c8419), hex(0x59636e)],
            },
            Self::Dark => Palette {
                ground: hex(0x191919),
                ink: hex(0xf0f0f0),
                muted: hex(0xa2a2a2),
                grid: hex(0x303030),
                mark: hex(0x767676),
                channels: [hex(0xff6f73), hex(0x53d68c), hex(0x7699ff)],
                models: [hex(0xb394f5), hex(0xf5a855), hex(0x55c7d6), hex(0xf08abd), hex(0xc3cb5b), hex(0xa6b1bd)],
            },
        }
    }
}

impl FromStr for FigureTheme {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let found = Self::ALL.into_iter().find(|theme| theme.id() == text);
        found.ok_or_else(|| UnknownName::new("figure theme", text, Self::ALL.map(Self::id)))
    }
}

/// Em sizes of the four kinds of text.
pub mod em {
    /// Figure titles.
    pub const TITLE: f64 = 20.0;
    /// Subtitles.
    pub const SUBTITLE: f64 = 12.5;
    /// Names and values.
    pub const LABEL: f64 = 12.0;
    /// Ticks and notes.
    pub const SMALL: f64 = 11.0;
}

/// Lengths of dash, gap, dash, …; empty for a solid line.
pub type Dashes = &'static [f64];

/// A solid line.
pub const SOLID: Dashes = &[];

/// The dashes of model number `index`: the truth alone is solid.
pub const fn model_dashes(index: usize) -> Dashes {
    match index % 6 {
        0 => &[7.0, 4.0],
        1 => &[1.6, 3.4],
        2 => &[9.0, 3.5, 1.6, 3.5],
        3 => &[14.0, 4.0],
        4 => &[3.5, 3.5],
        _ => &[9.0, 3.0, 1.6, 3.0, 1.6, 3.0],
    }
}
