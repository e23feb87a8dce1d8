//! Questions that stand before everything else: unsaved changes, a path to type, a name to find.

use std::path::{Path, PathBuf};

use eframe::egui::{Button, Id, Key, Label, Modal, Modifiers, ScrollArea, TextEdit, Ui, Vec2};

use super::command::{Action, Command};
use super::demonstrations::{Choice, Slot};
use super::file_dialog::Purpose;
use super::planner::{PlanAction, PlanMaterial};
use super::recovery::LeftBehind;
use super::state::State;
use super::theme;
use super::truth::library_colours;
use super::widgets::swatch;
use crate::metal::{Metal, metals};
use crate::preset::Preset;
use crate::sample::{Sample, samples};

/// The question on show.
#[derive(Clone, Debug)]
pub(crate) enum Prompt {
    /// What to do with unsaved changes before an action that loses them.
    Unsaved(Action),
    /// What to do with the unsaved work of a window that is gone.
    LeftBehind(Box<LeftBehind>),
    /// A path to type.
    Path {
        /// What the path is for.
        purpose: Purpose,
        /// What has been typed.
        text: String,
        /// Why a path is asked for, where that needs saying.
        reason: Option<&'static str>,
    },
    /// Whether what is to be written may take the place of the file that is there.
    Replace {
        /// The file.
        path: PathBuf,
        /// What writes it.
        then: Box<Action>,
    },
    /// Which of several imported metals to start with.
    Imported {
        /// The metals.
        presets: Vec<Preset>,
        /// What has been typed.
        text: String,
    },
    /// Something to find by its name.
    Find {
        /// Among what.
        among: Among,
        /// What has been typed.
        text: String,
        /// Which of the results is chosen.
        chosen: usize,
    },
}

/// What a person searches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Among {
    /// The commands.
    Commands,
    /// The photographs that ship with the program.
    Samples,
    /// Metals to start a preset from.
    MetalsToStartFrom,
    /// Metals to compare with.
    MetalsToCompare,
    /// Materials for a demonstration.
    Materials(Slot),
    /// Materials for a plan.
    PlanMaterials,
    /// Metals for the chart of cost against accuracy.
    TradeMetals,
    /// Metals that a reference ball may be of.
    ReferenceMetals,
}

/// What a person answered.
pub(crate) enum Answer {
    /// Nothing yet.
    None,
    /// The question is off the table.
    Cancel,
    /// Do this.
    Do(Action),
    /// Save first, then do this.
    SaveThen(Action),
    /// Do this, whatever is lost.
    Discard(Action),
    /// Ask this first.
    Ask(Prompt),
}

impl Prompt {
    pub(crate) fn find(among: Among) -> Self {
        Self::Find { among, text: String::new(), chosen: 0 }
    }

    /// Shows the question and says what was answered.
    pub(crate) fn show(&mut self, ui: &Ui, state: &State) -> Answer {
        let modal = Modal::new(Id::unique("prompt")).show(ui.ctx(), |ui| match self {
            Self::Unsaved(action) => unsaved(ui, state, action),
            Self::LeftBehind(left) => left_behind(ui, left),
            Self::Path { purpose, text, reason } => path(ui, state, *purpose, text, *reason),
            Self::Replace { path, then } => replace(ui, path, then),
            Self::Imported { presets, text } => imported(ui, presets, text),
            Self::Find { among, text, chosen } => find(ui, state, *among, text, chosen),
        });
        match modal.inner {
            Answer::None if modal.should_close() => Answer::Cancel,
            answer => answer,
        }
    }
}

fn unsaved(ui: &mut Ui, state: &State, action: &Action) -> Answer {
    ui.set_width(theme::DIALOG_WIDTH);
    ui.heading("Save changes?");
    ui.label(format!("“{}” has changes that are not on disk.", state.document.preset.name));
    ui.add_space(theme::GROUP_GAP);
    ui.horizontal(|ui| {
        let save = ui.button("Save").on_hover_text("Save, then go on");
        let discard = ui.button("Discard changes").on_hover_text("Go on without saving");
        let cancel = ui.button("Cancel").on_hover_text("Keep working on this preset");
        if save.clicked() {
            Answer::SaveThen(action.clone())
        } else if discard.clicked() {
            Answer::Discard(action.clone())
        } else if cancel.clicked() {
            Answer::Cancel
        } else {
            Answer::None
        }
    })
    .inner
}

fn left_behind(ui: &mut Ui, left: &LeftBehind) -> Answer {
    ui.set_width(theme::DIALOG_WIDTH);
    ui.heading("Open unsaved work?");
    let sentence =
        format!("A window that ended unexpectedly had changes to “{}” that are on no disk.", left.preset.name);
    ui.add(Label::new(sentence).wrap());
    ui.add_space(theme::GROUP_GAP);
    ui.horizontal(|ui| {
        let open = ui.button("Open it").on_hover_text("Go on with it; it still has to be saved");
        let delete = ui.button("Delete it").on_hover_text("Delete the copy for good");
        let later = ui.button("Later").on_hover_text("Ask again when a window is opened");
        if open.clicked() {
            Answer::Do(Action::Recover(Box::new(left.clone())))
        } else if delete.clicked() {
            Answer::Do(Action::Forget(Box::new(left.clone())))
        } else if later.clicked() {
            Answer::Cancel
        } else {
            Answer::None
        }
    })
    .inner
}

fn path(ui: &mut Ui, state: &State, purpose: Purpose, text: &mut String, reason: Option<&str>) -> Answer {
    ui.set_width(theme::DIALOG_WIDTH);
    let (title, verb) = match purpose {
        Purpose::Open => ("Open a preset or a photograph".to_owned(), "Open"),
        Purpose::Save => ("Save the preset".to_owned(), "Save"),
        Purpose::SavePiece(_) => ("Export the demonstration".to_owned(), "Export"),
        Purpose::Plan(file) => (file.question().to_owned(), file.verb()),
        Purpose::Library => ("Show a folder of presets".to_owned(), "Show"),
        Purpose::Import => ("Import what another program wrote".to_owned(), "Import"),
        Purpose::Export(target) => (target.label().to_owned(), "Export"),
        Purpose::SaveSheet(kind) => (format!("Save the {} as .{}", kind.label(), kind.endings().join(" or .")), "Save"),
    };
    ui.heading(title);
    if let Some(reason) = reason {
        ui.add(Label::new(reason).wrap());
    }
    let field = TextEdit::singleline(text).desired_width(f32::INFINITY).hint_text("/path/to/file");
    let response = ui.add(field).accessible_name("Path");
    if !response.lost_focus() {
        response.request_focus();
    }
    let is_entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    ui.add_space(theme::GAP);
    ui.horizontal(|ui| {
        let path = text.trim();
        let is_chosen = ui.add_enabled(!path.is_empty(), Button::new(verb)).clicked();
        if (is_chosen || is_entered) && !path.is_empty() {
            return entered(state, purpose, PathBuf::from(path));
        }
        if ui.button("Cancel").clicked() { Answer::Cancel } else { Answer::None }
    })
    .inner
}

/// What a path leads to. The system's dialog asks itself before a file is lost; for a path that was typed nobody has.
fn entered(state: &State, purpose: Purpose, path: PathBuf) -> Answer {
    let is_own = purpose == Purpose::Save && state.document.file() == Some(path.as_path());
    let there = path.clone();
    let action = match purpose {
        Purpose::Open => Action::Load(path),
        Purpose::Save => Action::SaveTo(path),
        Purpose::SavePiece(piece) => Action::SavePieceTo(piece, path),
        Purpose::Plan(file) => Action::Plan(PlanAction::Take(file, path)),
        Purpose::Library => Action::OpenLibrary(path),
        Purpose::Import => Action::Import(path),
        // An export has a field for the path in its own dialog.
        Purpose::Export(_) => return Answer::Cancel,
        Purpose::SaveSheet(kind) => Action::SaveSheetTo(kind, path),
    };
    if purpose.writes_a_file() && !is_own && there.is_file() {
        return Answer::Ask(Prompt::Replace { path: there, then: Box::new(action) });
    }
    Answer::Do(action)
}

fn replace(ui: &mut Ui, path: &Path, then: &Action) -> Answer {
    ui.set_width(theme::DIALOG_WIDTH);
    ui.heading("Replace the file?");
    ui.add(Label::new(format!("{} is there already.", path.display())).wrap());
    ui.add_space(theme::GROUP_GAP);
    ui.horizontal(|ui| {
        let replace = ui.button("Replace").on_hover_text("The file that is there is lost");
        let cancel = ui.button("Cancel").on_hover_text("Leave the file as it is");
        if replace.clicked() {
            Answer::Do(then.clone())
        } else if cancel.clicked() {
            Answer::Cancel
        } else {
            Answer::None
        }
    })
    .inner
}

/// A list of metals that came together; one of them becomes the preset.
fn imported(ui: &mut Ui, presets: &[Preset], text: &mut String) -> Answer {
    ui.set_width(theme::FINDER_WIDTH);
    ui.heading(format!("{} metals were found", presets.len()));
    let hint = "Search the imported metals";
    ui.add(TextEdit::singleline(text).desired_width(f32::INFINITY).hint_text(hint)).accessible_name(hint);
    let typed = text.trim().to_lowercase();
    let found: Vec<&Preset> = presets.iter().filter(|preset| preset.name.to_lowercase().contains(&typed)).collect();
    let mut answer = Answer::None;
    let list = ScrollArea::vertical().max_height(theme::FINDER_HEIGHT).auto_shrink([false, true]);
    list.show_rows(ui, theme::ROW, found.len(), |ui, rows| {
        for preset in &found[rows] {
            ui.horizontal(|ui| {
                for colour in [preset.r, preset.h] {
                    swatch(ui, colour, preset.space, Vec2::splat(16.0));
                }
                let button = Button::selectable(false, &preset.name).right_text(theme::hint(preset.space.label()));
                let button = ui.add(button.min_size(Vec2::new(ui.available_width(), theme::ROW)).truncate());
                if button.accessible_name(format!("Start with {}", preset.name)).clicked() {
                    answer = Answer::Do(Action::StartWith(Box::new((*preset).clone())));
                }
            });
        }
    });
    if ui.button("Cancel").clicked() { Answer::Cancel } else { answer }
}

fn find(ui: &mut Ui, state: &State, among: Among, text: &mut String, chosen: &mut usize) -> Answer {
    ui.set_width(theme::FINDER_WIDTH);
    let hint = match among {
        Among::Commands => "Find a command",
        Among::Samples => "Open a sample photograph",
        Among::MetalsToStartFrom => "Start from a metal",
        Among::MetalsToCompare => "Compare with a metal",
        Among::Materials(_) => "Choose a material",
        Among::PlanMaterials => "Add a material to the plan",
        Among::TradeMetals => "Metal of the chart",
        Among::ReferenceMetals => "Metal of the reference ball",
    };
    let step = ui.input_mut(|input| {
        let mut pressed = |key| input.consume_key(Modifiers::NONE, key);
        i32::from(pressed(Key::ArrowDown)) - i32::from(pressed(Key::ArrowUp))
    });
    let field = TextEdit::singleline(text).desired_width(f32::INFINITY).hint_text(hint);
    let response = ui.add(field).accessible_name(hint);
    let is_entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    response.request_focus();
    if response.changed() {
        *chosen = 0;
    }
    let found = found(state, among, text);
    *chosen = chosen.saturating_add_signed(step as isize).min(found.len().saturating_sub(1));
    let mut answer = Answer::None;
    ScrollArea::vertical().max_height(theme::FINDER_HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
        if found.is_empty() {
            ui.label(theme::hint("Nothing by that name"));
        }
        for (index, entry) in found.iter().enumerate() {
            let response = entry.show(ui, state, index == *chosen);
            if index == *chosen && step != 0 {
                response.scroll_to_me(None);
            }
            if response.clicked() || (is_entered && index == *chosen) {
                answer = Answer::Do(entry.action(among));
            }
        }
    });
    answer
}

enum Entry {
    Command(Command),
    Sample(&'static Sample),
    /// A metal, by its place in the library.
    Metal(usize),
    /// A material of a demonstration that the library does not have.
    Material(Slot, Choice),
    /// A metal of a person's own.
    Own(&'static Metal),
}

impl Entry {
    fn action(&self, among: Among) -> Action {
        match (self, among) {
            (Self::Command(command), _) => Action::Run(*command),
            (Self::Sample(sample), _) => Action::OpenSample(sample),
            (Self::Metal(index), Among::MetalsToCompare) => Action::CompareWith(&metals()[*index]),
            (Self::Metal(index), Among::Materials(slot)) => Action::Demonstrate(slot, Choice::Metal(&metals()[*index])),
            (Self::Metal(index), Among::PlanMaterials) => plan_for(&metals()[*index]),
            (Self::Metal(index), Among::TradeMetals) => Action::Plan(PlanAction::Trade(&metals()[*index])),
            (Self::Metal(index), Among::ReferenceMetals) => Action::SetReferenceMetal(&metals()[*index]),
            (Self::Metal(index), _) => Action::StartFrom(&metals()[*index]),
            (Self::Material(slot, choice), _) => Action::Demonstrate(*slot, *choice),
            (Self::Own(metal), Among::TradeMetals) => Action::Plan(PlanAction::Trade(metal)),
            (Self::Own(metal), _) => plan_for(metal),
        }
    }

    fn show(&self, ui: &mut Ui, state: &State, is_chosen: bool) -> eframe::egui::Response {
        let row = |left: String, right: String| Button::selectable(is_chosen, left).right_text(right);
        match self {
            Self::Command(command) => {
                let key = command.shortcut().map(|key| ui.ctx().format_shortcut(&key)).unwrap_or_default();
                let button = row(command.label().to_owned(), key).min_size([ui.available_width(), 0.0].into());
                ui.add_enabled(command.is_enabled(state), button).on_hover_text(command.tooltip())
            }
            Self::Sample(sample) => {
                let button = row(sample.facts.title.clone(), String::new());
                let button = button.min_size([ui.available_width(), 0.0].into());
                ui.add(button).on_hover_text(&sample.facts.description)
            }
            Self::Material(_, choice) => {
                let button = row(choice.label(state), String::new());
                let button = button.min_size([ui.available_width(), 0.0].into());
                ui.add(button).on_hover_text(choice.tooltip())
            }
            Self::Own(metal) => {
                let button = row(metal.name.clone(), "your own n and k".to_owned());
                ui.add(button.min_size([ui.available_width(), 0.0].into()))
            }
            Self::Metal(index) => {
                let space = state.document.space();
                let metal = &metals()[*index];
                let (r, h) = library_colours(space)[*index];
                ui.horizontal(|ui| {
                    for colour in [r, h] {
                        swatch(ui, colour, space, Vec2::splat(16.0));
                    }
                    let source = format!("{}  {}", metal.provenance.citation(), metal.dataset);
                    let button = row(metal.name.clone(), source);
                    ui.add(button.min_size([ui.available_width(), 0.0].into()))
                })
                .inner
            }
        }
    }
}

/// What matches the typed words: names that begin with them first.
fn found(state: &State, among: Among, text: &str) -> Vec<Entry> {
    let typed = text.trim().to_lowercase();
    if among == Among::Commands {
        let matching = Command::ALL.into_iter().filter(|command| command.label().to_lowercase().contains(&typed));
        return matching.filter(|command| *command != Command::Find).map(Entry::Command).collect();
    }
    if among == Among::Samples {
        let matching = samples().iter().filter(|sample| sample.facts.title.to_lowercase().contains(&typed));
        return matching.map(Entry::Sample).collect();
    }
    let words = |metal: &Metal| format!("{} {} {}", metal.name, metal.symbol, metal.id).to_lowercase();
    let begins = |metal: &Metal| metal.name.to_lowercase().starts_with(&typed) || metal.symbol.to_lowercase() == typed;
    let mut found: Vec<usize> = (0..metals().len()).filter(|&index| words(&metals()[index]).contains(&typed)).collect();
    found.sort_by_key(|&index| !begins(&metals()[index]));
    let metals = found.into_iter().map(Entry::Metal);
    match among {
        Among::Materials(slot) => others(state, slot, &typed).into_iter().chain(metals).collect(),
        Among::PlanMaterials | Among::TradeMetals => own_metals(state, &typed).chain(metals).collect(),
        _ => metals.collect(),
    }
}

fn own_metals<'a>(state: &'a State, typed: &'a str) -> impl Iterator<Item = Entry> + 'a {
    state
        .metals
        .own
        .iter()
        .filter(move |metal| metal.name.to_lowercase().contains(typed))
        .map(|&metal| Entry::Own(metal))
}

fn plan_for(metal: &'static Metal) -> Action {
    Action::Plan(PlanAction::Add(PlanMaterial::Metal(metal)))
}

/// The materials of a demonstration that are no metals of the library, and match what is typed.
fn others(state: &State, slot: Slot, typed: &str) -> Vec<Entry> {
    let own = state.metals.own.iter().map(|&metal| Choice::Metal(metal));
    let choices = [Choice::Preset, Choice::Dielectric, Choice::Example].into_iter().chain(own);
    let matches = |choice: &Choice| choice.label(state).to_lowercase().contains(typed);
    choices.filter(matches).map(|choice| Entry::Material(slot, choice)).collect()
}
