//! Where a photograph is read from.

use std::path::PathBuf;

use crate::gui::job::Progress;
use crate::photo::{FirstLook, OpenOptions, Photo, Preview};
use crate::sample::Sample;

/// A file, or a photograph that ships with the program.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    /// A file of the person.
    File(PathBuf),
    /// A built-in photograph, which was rendered.
    Sample(&'static Sample),
}

/// A photograph that has been read, and a small copy of it for the screen.
pub(crate) struct Loaded {
    /// The full data; everything is measured in it.
    pub photo: Photo,
    /// What is shown.
    pub preview: Preview,
}

/// Longer side of the copy that is shown: twice the widest panel, so that it can be zoomed.
const PREVIEW_SIDE: u32 = 1400;

impl Source {
    /// What to call it while it is being read.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Self::Sample(sample) => sample.facts.title.clone(),
        }
    }

    /// Reads it, and shows `look` a coarse copy of a large one on the way; the sentence of a failure names the file.
    pub(crate) fn load(&self, look: &mut (dyn FnMut(FirstLook) + Send), progress: &Progress) -> Result<Loaded, String> {
        let mut report = |fraction| progress.report(fraction * 0.9);
        let photo = match self {
            Self::File(path) => Photo::open_showing(path, &OpenOptions::default(), look, &mut report),
            Self::Sample(sample) => Photo::from_bytes(&sample.facts.file, sample.bytes, &mut report),
        };
        let photo = photo.map_err(|error| error.to_string())?;
        let preview = photo.preview(PREVIEW_SIDE);
        Ok(Loaded { photo, preview })
    }
}
