//! What a person can ask for: each with its label, tooltip and shortcut, in this one place.

use std::path::PathBuf;

use eframe::egui::{Button, Context, Key, KeyboardShortcut, Modifiers, Response, Ui};

use super::demonstrations::{Choice, Piece, Slot};
use super::export::Writing;
use super::planner::PlanAction;
use super::recovery::LeftBehind;
use super::sheet::SheetKind;
use super::state::{Page, State};
use crate::metal::Metal;
use crate::preset::Preset;
use crate::sample::Sample;

/// Something with a menu entry, a key, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Starts a new preset.
    New,
    /// Opens a preset through the system's dialog.
    Open,
    /// Opens a preset or a photograph whose path is typed.
    OpenPath,
    /// Opens a photograph that ships with the program.
    OpenSample,
    /// Shows a folder of presets.
    OpenLibrary,
    /// Starts a preset from a measured metal.
    NewFromMetal,
    /// Saves the preset to its file.
    Save,
    /// Saves the preset to another file.
    SaveAs,
    /// Saves the preset to a path that is typed.
    SavePath,
    /// Reads what another program wrote.
    Import,
    /// Writes the preset for a renderer.
    Export,
    /// Closes the window.
    Quit,
    /// Takes back the last step.
    Undo,
    /// Makes the step again.
    Redo,
    /// Copies r as linear numbers.
    CopyR,
    /// Copies r as 8-bit sRGB.
    CopyRSrgb,
    /// Copies r as an sRGB hex code.
    CopyRHex,
    /// Copies h as linear numbers.
    CopyH,
    /// Copies h as 8-bit sRGB.
    CopyHSrgb,
    /// Copies h as an sRGB hex code.
    CopyHHex,
    /// Shows the page of the preset.
    ShowAuthor,
    /// Shows the page on which the photograph is large.
    ShowPhotograph,
    /// Shows the page of metals.
    ShowMetals,
    /// Shows the page of demonstrations.
    ShowDemonstrations,
    /// Shows the page of plans.
    ShowPlanner,
    /// Shows the page of the library.
    ShowLibrary,
    /// Chooses the measured metal to compare with.
    Compare,
    /// Compares with nothing.
    CompareNone,
    /// Shows the last 30 degrees only, or all.
    ToggleGrazing,
    /// Changes between dark and light.
    ToggleTheme,
    /// Makes everything larger.
    ZoomIn,
    /// Makes everything smaller.
    ZoomOut,
    /// Back to the size the system asks for.
    ZoomReset,
    /// Finds a command by its name.
    Find,
}

/// Groups of a menu, separated by lines.
type Menu = (&'static str, &'static [&'static [Command]]);

impl Command {
    /// Every command, in menu order.
    pub const ALL: [Self; 34] = [
        Self::New,
        Self::Open,
        Self::OpenPath,
        Self::OpenSample,
        Self::OpenLibrary,
        Self::NewFromMetal,
        Self::Save,
        Self::SaveAs,
        Self::SavePath,
        Self::Import,
        Self::Export,
        Self::Quit,
        Self::Undo,
        Self::Redo,
        Self::CopyR,
        Self::CopyRSrgb,
        Self::CopyRHex,
        Self::CopyH,
        Self::CopyHSrgb,
        Self::CopyHHex,
        Self::ShowAuthor,
        Self::ShowPhotograph,
        Self::ShowMetals,
        Self::ShowDemonstrations,
        Self::ShowPlanner,
        Self::ShowLibrary,
        Self::Compare,
        Self::CompareNone,
        Self::ToggleGrazing,
        Self::ToggleTheme,
        Self::ZoomIn,
        Self::ZoomOut,
        Self::ZoomReset,
        Self::Find,
    ];

    /// The menu bar.
    pub(crate) const MENUS: [Menu; 3] = [
        (
            "File",
            &[
                &[Self::New, Self::NewFromMetal],
                &[Self::Open, Self::OpenPath, Self::OpenSample, Self::OpenLibrary],
                &[Self::Save, Self::SaveAs, Self::SavePath],
                &[Self::Import, Self::Export],
                &[Self::Quit],
            ],
        ),
        (
            "Edit",
            &[
                &[Self::Undo, Self::Redo],
                &[Self::CopyR, Self::CopyRSrgb, Self::CopyRHex],
                &[Self::CopyH, Self::CopyHSrgb, Self::CopyHHex],
                &[Self::Find],
            ],
        ),
        (
            "View",
            &[
                &[
                    Self::ShowAuthor,
                    Self::ShowPhotograph,
                    Self::ShowMetals,
                    Self::ShowDemonstrations,
                    Self::ShowPlanner,
                    Self::ShowLibrary,
                ],
                &[Self::Compare, Self::CompareNone],
                &[Self::ToggleGrazing],
                &[Self::ToggleTheme],
                &[Self::ZoomIn, Self::ZoomOut, Self::ZoomReset],
            ],
        ),
    ];

    /// The name people read; “…” where it asks for more.
    pub const fn label(self) -> &'static str {
        match self {
            Self::New => "New preset",
            Self::Open => "Open…",
            Self::OpenPath => "Open path…",
            Self::OpenSample => "Open sample photograph…",
            Self::OpenLibrary => "Open library folder…",
            Self::NewFromMetal => "New from metal…",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::SavePath => "Save to path…",
            Self::Import => "Import…",
            Self::Export => "Export…",
            Self::Quit => "Quit",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::CopyR => "Copy r, linear",
            Self::CopyRSrgb => "Copy r, sRGB 8-bit",
            Self::CopyRHex => "Copy r, sRGB hex code",
            Self::CopyH => "Copy h, linear",
            Self::CopyHSrgb => "Copy h, sRGB 8-bit",
            Self::CopyHHex => "Copy h, sRGB hex code",
            Self::ShowAuthor => "Author page",
            Self::ShowPhotograph => "Photograph page",
            Self::ShowMetals => "Metals page",
            Self::ShowDemonstrations => "Demonstrations page",
            Self::ShowPlanner => "Planner page",
            Self::ShowLibrary => "Library page",
            Self::Compare => "Compare with metal…",
            Self::CompareNone => "Compare with nothing",
            Self::ToggleGrazing => "Show 60–90° only",
            Self::ToggleTheme => "Dark or light",
            Self::ZoomIn => "Larger",
            Self::ZoomOut => "Smaller",
            Self::ZoomReset => "Actual size",
            Self::Find => "Find a command…",
        }
    }

    /// One sentence about what it does.
    pub const fn tooltip(self) -> &'static str {
        match self {
            Self::New => "Start from a neutral grey metal",
            Self::Open => "Choose a preset or a photograph in the system's dialog",
            Self::OpenLibrary => "Look through the presets of a folder, with thumbnails and search",
            Self::OpenSample => "Open a photograph that ships with the program",
            Self::OpenPath => "Type the path of a preset or a photograph",
            Self::NewFromMetal => "Start from the exact r and h of a measured metal",
            Self::Save => "Write the preset to its file",
            Self::SaveAs => "Choose a file in the system's dialog",
            Self::SavePath => "Type the path to write to",
            Self::Import => "Read metals from MaterialX, glTF, tables, pasted values or palettes",
            Self::Export => "Write the preset for a renderer, and see first what it will show",
            Self::Quit => "Close the window",
            Self::Undo => "Take back the last change",
            Self::Redo => "Make the change again",
            Self::CopyR => "Copy the facing colour as linear numbers in the preset's space",
            Self::CopyRSrgb => "Copy the facing colour as three 8-bit sRGB numbers",
            Self::CopyRHex => "Copy the facing colour as an sRGB hex code",
            Self::CopyH => "Copy the edge colour as linear numbers in the preset's space",
            Self::CopyHSrgb => "Copy the edge colour as three 8-bit sRGB numbers",
            Self::CopyHHex => "Copy the edge colour as an sRGB hex code",
            Self::ShowAuthor => "Author a preset, by hand or from a photograph",
            Self::ShowPhotograph => "Mark a photograph, and hold it against the rendered match",
            Self::ShowMetals => "Look at measured metals and how far models are from them",
            Self::ShowDemonstrations => "See why r and h, on your own preset or metal",
            Self::ShowPlanner => "Find the cheapest model for each material of a scene",
            Self::ShowLibrary => "Look through a folder of presets",
            Self::Compare => "Draw the measured truth of a metal beneath the preset",
            Self::CompareNone => "Draw the preset alone",
            Self::ToggleGrazing => "Spread the angles where metals differ most over the whole plot",
            Self::ToggleTheme => "Change between the dark and the light window",
            Self::ZoomIn => "Make everything larger",
            Self::ZoomOut => "Make everything smaller",
            Self::ZoomReset => "Return to the size the system asks for",
            Self::Find => "Run any command by its name",
        }
    }

    /// Its key.
    pub const fn shortcut(self) -> Option<KeyboardShortcut> {
        const COMMAND_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);
        let (modifiers, key) = match self {
            Self::New => (Modifiers::COMMAND, Key::N),
            Self::Open => (Modifiers::COMMAND, Key::O),
            Self::OpenPath => (COMMAND_SHIFT, Key::O),
            Self::OpenSample => (COMMAND_SHIFT, Key::P),
            Self::NewFromMetal => (COMMAND_SHIFT, Key::N),
            Self::Save => (Modifiers::COMMAND, Key::S),
            Self::SaveAs => (COMMAND_SHIFT, Key::S),
            Self::Import => (Modifiers::COMMAND, Key::I),
            Self::Export => (Modifiers::COMMAND, Key::E),
            Self::Quit => (Modifiers::COMMAND, Key::Q),
            Self::Undo => (Modifiers::COMMAND, Key::Z),
            Self::Redo => (COMMAND_SHIFT, Key::Z),
            Self::CopyR => (COMMAND_SHIFT, Key::R),
            Self::CopyH => (COMMAND_SHIFT, Key::H),
            Self::ShowAuthor => (Modifiers::COMMAND, Key::Num1),
            Self::ShowPhotograph => (Modifiers::COMMAND, Key::P),
            Self::ShowMetals => (Modifiers::COMMAND, Key::Num2),
            Self::ShowDemonstrations => (Modifiers::COMMAND, Key::Num3),
            Self::ShowPlanner => (Modifiers::COMMAND, Key::Num4),
            Self::ShowLibrary => (Modifiers::COMMAND, Key::Num5),
            Self::Compare => (Modifiers::COMMAND, Key::M),
            Self::ToggleGrazing => (Modifiers::COMMAND, Key::G),
            Self::ToggleTheme => (Modifiers::COMMAND, Key::L),
            Self::ZoomIn => (Modifiers::COMMAND, Key::Plus),
            Self::ZoomOut => (Modifiers::COMMAND, Key::Minus),
            Self::ZoomReset => (Modifiers::COMMAND, Key::Num0),
            Self::Find => (Modifiers::COMMAND, Key::K),
            Self::SavePath
            | Self::OpenLibrary
            | Self::CopyRSrgb
            | Self::CopyRHex
            | Self::CopyHSrgb
            | Self::CopyHHex
            | Self::CompareNone => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

    /// Whether it can do anything now.
    pub(crate) fn is_enabled(self, state: &State) -> bool {
        match self {
            Self::Undo => state.document.can_undo(),
            Self::Redo => state.document.can_redo(),
            Self::CompareNone => state.view.metal.is_some(),
            _ => true,
        }
    }

    /// The command whose key was pressed in this frame. The text that has the focus keeps what it uses itself.
    pub(crate) fn pressed(ctx: &Context) -> Option<Self> {
        // Longest first: Ctrl+S would also answer to Ctrl+Shift+S.
        let mut by_length = Self::ALL.map(|command| (command, command.shortcut()));
        by_length.sort_by_key(|(_, shortcut)| shortcut.is_some_and(|s| !s.modifiers.shift));
        let is_typing = ctx.text_edit_focused();
        by_length.into_iter().find_map(|(command, shortcut)| {
            let is_for_text = is_typing && matches!(command, Self::Undo | Self::Redo);
            let shortcut = shortcut.filter(|_| !is_for_text)?;
            ctx.input_mut(|input| input.consume_shortcut(&shortcut)).then_some(command)
        })
    }

    /// The command that shows a page.
    pub(crate) const fn show(page: Page) -> Self {
        match page {
            Page::Author => Self::ShowAuthor,
            Page::Photograph => Self::ShowPhotograph,
            Page::Metals => Self::ShowMetals,
            Page::Demonstrations => Self::ShowDemonstrations,
            Page::Planner => Self::ShowPlanner,
            Page::Library => Self::ShowLibrary,
        }
    }

    /// A button for it, greyed out when it can do nothing.
    pub(crate) fn button(self, ui: &mut Ui, state: &State) -> Response {
        let mut button = Button::new(self.label());
        if let Some(shortcut) = self.shortcut() {
            button = button.shortcut_text(ui.ctx().format_shortcut(&shortcut));
        }
        ui.add_enabled(self.is_enabled(state), button).on_hover_text(self.tooltip())
    }
}

/// A command, or what one leads to once it has its object.
#[derive(Clone, Debug)]
pub(crate) enum Action {
    /// Runs a command.
    Run(Command),
    /// Opens a file: a preset by its extension, otherwise a photograph.
    Load(PathBuf),
    /// Writes the preset to a file.
    SaveTo(PathBuf),
    /// Reads what another program wrote.
    Import(PathBuf),
    /// Starts from a preset that came from elsewhere.
    StartWith(Box<Preset>),
    /// Writes the preset for a renderer.
    Write(Box<Writing>),
    /// Shows a folder of presets.
    OpenLibrary(PathBuf),
    /// Opens a built-in photograph.
    OpenSample(&'static Sample),
    /// Gives up the photograph that is being read.
    StopReading,
    /// Closes the photograph.
    ClosePhotograph,
    /// Starts a preset from a metal.
    StartFrom(&'static Metal),
    /// Reads a file of n and k into the library.
    AddMetal(PathBuf),
    /// Compares with a metal.
    CompareWith(&'static Metal),
    /// Opens what an earlier window left behind.
    Recover(Box<LeftBehind>),
    /// Deletes what an earlier window left behind.
    Forget(Box<LeftBehind>),
    /// Finds a material for a demonstration.
    FindMaterial(Slot),
    /// Makes a demonstration about a material.
    Demonstrate(Slot, Choice),
    /// Asks where to write a piece of the demonstration on show.
    SavePiece(Piece),
    /// Writes it.
    SavePieceTo(Piece, PathBuf),
    /// Plans for the materials of a scene.
    Plan(PlanAction),
    /// Asks which metal the reference ball is of.
    ChooseReferenceMetal,
    /// Says which metal the reference ball is of.
    SetReferenceMetal(&'static Metal),
    /// Asks where to save what the page of metals shows.
    SaveSheet(SheetKind),
    /// Saves it.
    SaveSheetTo(SheetKind, PathBuf),
}

impl From<Command> for Action {
    fn from(command: Command) -> Self {
        Self::Run(command)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn every_command_is_in_one_menu_and_has_its_own_key() {
        let in_menus: Vec<Command> = Command::MENUS.iter().flat_map(|(_, groups)| groups.concat()).collect();
        for command in Command::ALL {
            assert_eq!(in_menus.iter().filter(|&&c| c == command).count(), 1, "{command:?}");
        }
        let keys: Vec<_> = Command::ALL.iter().filter_map(|c| c.shortcut()).collect();
        assert_eq!(keys.iter().collect::<HashSet<_>>().len(), keys.len());
    }

    #[test]
    fn the_label_says_whether_it_asks_for_more() {
        for command in Command::ALL {
            assert!(!command.label().ends_with('.') && !command.tooltip().ends_with('.'), "{command:?}");
        }
    }
}
