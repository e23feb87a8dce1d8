//! Which graphics interface draws the window.

use std::path::Path;
use std::str::FromStr;

use crate::color::UnknownName;

/// What a person asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Renderer {
    /// By what the machine has, with the other one if the first fails.
    #[default]
    Auto,
    /// Vulkan, Metal or DirectX 12.
    Wgpu,
    /// OpenGL.
    Glow,
}

impl Renderer {
    /// Every choice.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Wgpu, Self::Glow];

    /// The word on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Wgpu => "wgpu",
            Self::Glow => "glow",
        }
    }

    /// What to try, in order.
    pub(crate) fn attempts(self) -> &'static [eframe::Renderer] {
        use eframe::Renderer::{Glow, Wgpu};
        match self {
            Self::Wgpu => &[Wgpu],
            Self::Glow => &[Glow],
            Self::Auto if draws_in_software(Path::new("/")) => &[Glow, Wgpu],
            Self::Auto => &[Wgpu, Glow],
        }
    }
}

impl FromStr for Renderer {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let named = Self::ALL.into_iter().find(|renderer| renderer.id() == text);
        named.ok_or_else(|| UnknownName::new("renderer", text, Self::ALL.map(Self::id)))
    }
}

/// True on a Linux machine without a graphics device, where software OpenGL draws a frame four to five times
/// faster than software Vulkan. Elsewhere the system itself knows better.
fn draws_in_software(root: &Path) -> bool {
    let render_nodes = || std::fs::read_dir(root.join("dev/dri")).into_iter().flatten().flatten();
    let has_render_node = || render_nodes().any(|node| node.file_name().to_string_lossy().starts_with("renderD"));
    let others = ["dev/nvidiactl", "dev/dxg"];
    cfg!(target_os = "linux") && !has_render_node() && !others.iter().any(|device| root.join(device).exists())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_parse_back() {
        for renderer in Renderer::ALL {
            assert_eq!(renderer.id().parse(), Ok(renderer));
        }
        assert!("metal".parse::<Renderer>().is_err());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_render_node_means_hardware() {
        let root = tempfile::tempdir().unwrap();
        assert!(draws_in_software(root.path()));
        std::fs::create_dir_all(root.path().join("dev/dri")).unwrap();
        std::fs::write(root.path().join("dev/dri/card0"), "").unwrap();
        assert!(draws_in_software(root.path()));
        std::fs::write(root.path().join("dev/dri/renderD128"), "").unwrap();
        assert!(!draws_in_software(root.path()));
    }
}
