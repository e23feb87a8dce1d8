//! How much of a preset's curve a file says: all of it, or only what a scene requires.

use super::Target;

/// What a file says of the curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Kept {
    /// r and h.
    #[default]
    Whole,
    /// r, with Schlick's edge: the file has no h, no tint and no code for them.
    Schlick,
    /// r at every angle.
    Constant,
}

impl Kept {
    /// All, what says least last.
    pub const ALL: [Self; 3] = [Self::Whole, Self::Schlick, Self::Constant];
}

impl Target {
    /// Whether files of this target can say so little.
    pub const fn can_keep(self, kept: Kept) -> bool {
        match kept {
            Kept::Whole => true,
            Kept::Constant => {
                matches!(self, Self::Csv | Self::Glsl | Self::Hlsl | Self::Wgsl | Self::Osl | Self::Cube | Self::Exr)
            }
            // The others name h or g whatever the curve is, or have it for its colour.
            Kept::Schlick => !matches!(
                self,
                Self::Json
                    | Self::StandardSurface
                    | Self::Mitsuba
                    | Self::MitsubaPlugin
                    | Self::Gpl
                    | Self::Ase
                    | Self::Aco
            ),
        }
    }
}
