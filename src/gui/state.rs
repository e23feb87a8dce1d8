//! Everything the window shows, and nothing of how it shows it.

use std::collections::BTreeSet;

use super::comparisons::{Comparison, Comparisons};
use super::demonstrations::{DemonstrationsPage, Open};
use super::document::Document;
use super::library::LibraryPage;
use super::metals::{MetalsPage, MetalsView};
use super::photograph::Session;
use super::planner::PlannerPage;
use super::spheres::Spheres;
use super::truth::TruthCurves;
use crate::metal::Metal;
use crate::photo::MatchRequest;
use crate::preset::Preset;
use crate::render::Light;

/// The state of the window.
#[derive(Debug)]
pub struct State {
    /// The open preset.
    pub document: Document,
    /// The page on show.
    pub page: Page,
    pub(crate) view: View,
    pub(crate) metals: MetalsPage,
    pub(crate) demonstrations: DemonstrationsPage,
    pub(crate) planner: PlannerPage,
    pub(crate) library: LibraryPage,
    pub(crate) photograph: Option<Session>,
    /// What is typed in the field for the path of a photograph.
    pub(crate) path: String,
    pub(crate) truth: TruthCurves,
    pub(crate) comparisons: Comparisons,
    pub(crate) spheres: Spheres,
    pub(crate) notices: Vec<Notice>,
}

impl State {
    pub(crate) fn new(preset: Preset) -> Self {
        Self {
            document: Document::new(preset, None),
            page: Page::default(),
            view: View::default(),
            metals: MetalsPage::default(),
            demonstrations: DemonstrationsPage::default(),
            planner: PlannerPage::default(),
            library: LibraryPage::default(),
            photograph: None,
            path: String::new(),
            truth: TruthCurves::default(),
            comparisons: Comparisons::default(),
            spheres: Spheres::default(),
            notices: Vec::new(),
        }
    }

    /// Shows a sentence until it is dismissed.
    pub(crate) fn notify(&mut self, kind: NoticeKind, text: impl Into<String>) {
        let notice = Notice { kind, text: text.into() };
        if !self.notices.contains(&notice) {
            self.notices.push(notice);
        }
    }

    /// True while better previews are to follow on the page that is on show.
    pub(crate) fn is_refining(&self) -> bool {
        match self.page {
            Page::Author => self.spheres.is_refining(),
            Page::Metals => self.metals.view == MetalsView::Spheres && self.metals.spheres.is_refining(),
            _ => false,
        }
    }

    /// What the demonstrations start from.
    pub(crate) fn open(&self) -> Open<'_> {
        Open { preset: &self.document.preset, metal: self.view.metal }
    }

    /// The marks of the open photograph.
    pub fn marks(&self) -> Option<&MatchRequest> {
        self.photograph.as_ref().map(|session| &session.request)
    }

    /// The sentences on show, oldest first.
    pub fn notices(&self) -> impl Iterator<Item = &str> {
        self.notices.iter().map(|notice| notice.text.as_str())
    }
}

/// The pages of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Page {
    /// A preset, by hand or from a photograph.
    #[default]
    Author,
    /// A photograph, large, with its marks and its match.
    Photograph,
    /// Measured metals and how far models are from them.
    Metals,
    /// Why r and h: the paper's argument on a person's own metal.
    Demonstrations,
    /// What a scene requires, and cost against accuracy.
    Planner,
    /// A folder of presets.
    Library,
}

impl Page {
    /// Every page, in the order of the tabs.
    pub const ALL: [Self; 6] =
        [Self::Author, Self::Photograph, Self::Metals, Self::Demonstrations, Self::Planner, Self::Library];

    /// The name on its tab.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Author => "Author",
            Self::Photograph => "Photograph",
            Self::Metals => "Metals",
            Self::Demonstrations => "Demonstrations",
            Self::Planner => "Planner",
            Self::Library => "Library",
        }
    }
}

/// How the document is looked at; no part of it.
#[derive(Debug)]
pub(crate) struct View {
    /// The measured metal beneath the preset.
    pub metal: Option<&'static Metal>,
    /// Other models of the preset.
    pub comparisons: BTreeSet<Comparison>,
    /// Only 60–90°.
    pub is_grazing_only: bool,
    /// The angle under the pointer, for the read-out.
    pub cursor_deg: Option<f64>,
    /// The light around the sphere.
    pub light: Light,
    /// Milliseconds that a preview may take while something moves.
    pub preview_ms: f64,
}

impl Default for View {
    fn default() -> Self {
        Self {
            metal: None,
            comparisons: BTreeSet::new(),
            is_grazing_only: false,
            cursor_deg: None,
            light: Light::PhotoStudio,
            preview_ms: 16.0,
        }
    }
}

/// A sentence about something that happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Notice {
    pub kind: NoticeKind,
    pub text: String,
}

/// How much a notice matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoticeKind {
    /// Something failed.
    Error,
    /// Something a person should know.
    Warning,
    /// Something asked for is done.
    Done,
}
