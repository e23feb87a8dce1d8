//! Why a photograph could not be read: one sentence that names the file.

use thiserror::Error;

/// A photograph that could not be read, and why.
#[derive(Debug, Error)]
#[error("{name}: {kind}")]
pub struct PhotoError {
    /// The file, as the person named it.
    pub name: String,
    /// What stands in the way.
    #[source]
    pub kind: PhotoErrorKind,
}

/// The reasons, each a sentence that says what to do where something can be done.
#[derive(Debug, Error)]
pub enum PhotoErrorKind {
    /// There is no such file.
    #[error("there is no such file")]
    Missing,
    /// A folder, a pipe, a device.
    #[error("this is {0}, not a file")]
    NotAFile(&'static str),
    /// The file has no bytes.
    #[error("the file is empty")]
    Empty,
    /// The operating system refused.
    #[error("the file cannot be read ({0})")]
    Io(#[from] std::io::Error),
    /// A camera's raw file, by its name.
    #[error(
        "this is a camera raw file ({0}), which Edgewise does not develop; save a 16-bit linear TIFF or an EXR \
         without a tone curve from the raw converter and open that"
    )]
    Raw(&'static str),
    /// A known format that is not read.
    #[error("{0} is not read here; save it as PNG, TIFF or EXR and open that")]
    OtherFormat(&'static str),
    /// No known format.
    #[error("this is no picture known here; PNG, JPEG, TIFF, WebP, OpenEXR and Radiance HDR are read")]
    UnknownFormat,
    /// A format that is read, with content that is not.
    #[error("{what} is not read here; {advice}")]
    Unsupported {
        /// What the file holds.
        what: String,
        /// What to do instead.
        advice: &'static str,
    },
    /// The picture has no pixels.
    #[error("the picture is {width} × {height} pixels large, so there is nothing to measure")]
    NoPixels {
        /// Width in the header.
        width: u64,
        /// Height in the header.
        height: u64,
    },
    /// More than a limit allows.
    #[error("{what} is beyond the limit of {limit}")]
    TooLarge {
        /// What is too large, with its size.
        what: String,
        /// The limit, with its unit.
        limit: String,
    },
    /// The picture is damaged or ends early.
    #[error("the {format} file is damaged or incomplete ({reason})")]
    Damaged {
        /// The format.
        format: &'static str,
        /// What the decoder says.
        reason: String,
    },
    /// An EXR whose colour lies in named layers only, of which none was chosen.
    #[error("the colours are in named layers; choose one of: {}", .layers.join(", "))]
    ChooseLayer {
        /// The layers with colour.
        layers: Vec<String>,
    },
    /// The chosen layer is not there.
    #[error("there is no layer “{wanted}”; {}", described(.layers))]
    NoSuchLayer {
        /// What was asked for.
        wanted: String,
        /// The layers with colour.
        layers: Vec<String>,
    },
    /// The progress closure asked to stop.
    #[error("reading was cancelled")]
    Cancelled,
}

impl PhotoErrorKind {
    /// Damage of a format as its decoder describes it, cut to one line.
    pub(super) fn damaged(format: &'static str) -> impl Fn(&dyn std::fmt::Display) -> Self {
        move |error| Self::Damaged { format, reason: first_line(&error.to_string()) }
    }

    /// The error of a file.
    pub(super) fn of(self, name: &str) -> PhotoError {
        PhotoError { name: name.to_owned(), kind: self }
    }
}

fn described(layers: &[String]) -> String {
    match layers {
        [] => "the file has no named layer".to_owned(),
        _ => format!("the layers are: {}", layers.join(", ")),
    }
}

/// The first line of what a decoder says, short enough for one sentence.
/// What a decoder says, cut to one line of at most 160 characters.
pub(super) fn first_line(text: &str) -> String {
    const LONGEST: usize = 160;
    let line = text.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("no reason given");
    let line = line.trim_end_matches('.');
    match line.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line.to_owned(),
    }
}
