//! From the pixels of a photograph to r and h.

mod area;
mod card;
mod circle;
mod light_mode;
mod mark;
mod picture;
mod pixel;
mod recipe;
mod request;
mod statistics;
mod warning;

pub use area::Area;
pub use card::Card;
pub use circle::Circle;
pub use light_mode::LightMode;
pub use mark::MarkError;
pub use picture::Photo;
pub use pixel::{Pixel, PixelFlags};
pub use recipe::Recipe;
pub use request::{MatchRequest, MirrorPair, ReferenceBall};
pub use statistics::AreaStatistics;
pub use warning::{Warning, WarningCode};
