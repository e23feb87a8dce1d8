//! A coarse copy of a photograph that is there before the photograph is.

use super::Preview;

/// What a person sees while a large file is still being decoded. Nothing is to be measured in it.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstLook {
    /// Width of the photograph in pixels, after orientation.
    pub width: u32,
    /// Height of the photograph in pixels, after orientation.
    pub height: u32,
    /// The coarse copy: an eighth of the size or less.
    pub preview: Preview,
}
