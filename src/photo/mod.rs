//! From the pixels of a photograph to r and h.

mod area;
mod card;
mod census;
mod circle;
mod curve;
mod error;
mod inspect;
mod light_mode;
mod linearizer;
mod mark;
mod orientation;
mod picture;
mod pixel;
mod preview;
mod read;
mod recipe;
mod request;
mod rule;
mod samples;
mod statistics;
mod warning;

pub use area::Area;
pub use card::Card;
pub use circle::Circle;
pub use error::{PhotoError, PhotoErrorKind};
pub use inspect::{Inspection, inspect};
pub use light_mode::LightMode;
pub use mark::MarkError;
pub use picture::{OpenOptions, Photo, Untagged};
pub use pixel::{Pixel, PixelFlags};
pub use preview::Preview;
pub use recipe::Recipe;
pub use request::{MatchRequest, MirrorPair, ReferenceBall};
pub use rule::ColourRule;
pub use statistics::AreaStatistics;
pub use warning::{Warning, WarningCode};
