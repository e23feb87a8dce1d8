//! The dialog of an export: choose a target, look at its file and its curve, say where it goes.

use std::path::PathBuf;

use eframe::egui::{
    Button, ComboBox, Context, Grid, Id, Key, Label, Modal, RichText, ScrollArea, TextEdit, TextStyle, Ui, Vec2,
};
use egui_plot::LineStyle;

use super::Asked;
use super::preview::{Preview, preview};
use crate::color::RgbSpace;
use crate::export::Target;
use crate::gui::job::Follower;
use crate::gui::theme::{self, Palette};
use crate::gui::widgets::{CurvePlot, PlotLine, channel_names, line_sample};
use crate::preset::Preset;

/// Dashes of what the target shows, over the preset.
const SHOWN: LineStyle = LineStyle::Dashed { length: 7.0 };

/// The dialog while it is open.
pub(crate) struct ExportDialog {
    target: Target,
    /// The space a person wants; a target that does not know it takes its first.
    space: RgbSpace,
    path: String,
    /// True once a person has typed a path: it then stays when the target changes.
    is_path_typed: bool,
    /// The folder that files are offered to be written into.
    folder: Option<PathBuf>,
    previews: Follower<Asked, Result<Preview, String>>,
    shown: Option<(Asked, Result<Preview, String>)>,
    /// The last thing that was done or failed.
    status: Option<Result<String, String>>,
}

/// What a person asked for.
pub(crate) enum Answer {
    /// Nothing yet.
    None,
    /// The dialog is done with.
    Close,
    /// Choose a file in the system's dialog.
    Choose(Asked, String),
    /// Do not wait for that dialog any longer.
    StopWaiting,
    /// Write to the path that was typed.
    Write(Asked, PathBuf),
    /// Put the text on the clipboard.
    Copy(String),
}

impl ExportDialog {
    /// A dialog for a preset in some space, offering to write into a folder.
    pub(crate) fn new(space: RgbSpace, folder: Option<PathBuf>) -> Self {
        Self {
            target: Target::OpenPbr,
            space,
            path: String::new(),
            is_path_typed: false,
            folder,
            previews: Follower::default(),
            shown: None,
            status: None,
        }
    }

    /// True while a preview is on its way.
    pub(crate) fn is_busy(&self) -> bool {
        self.previews.is_busy()
    }

    /// Says what came of a write.
    pub(crate) fn say(&mut self, status: Result<String, String>) {
        self.status = Some(status);
    }

    fn asked(&self, preset: &Preset) -> Asked {
        let spaces = self.target.spaces();
        let space = if spaces.contains(&self.space) { self.space } else { spaces[0] };
        Asked { preset: preset.clone(), target: self.target, space }
    }

    fn follow(&mut self, ctx: &Context, asked: &Asked) {
        let done = self.previews.follow(ctx, "preview an export", asked.clone(), |asked, _| {
            preview(&asked).map_err(|error| error.to_string())
        });
        if let Some(done) = done {
            self.shown = Some(done);
            self.offer_path();
        }
    }

    /// The usual name in the folder, unless a person has typed another.
    fn offer_path(&mut self) {
        if let (false, Some((_, Ok(preview)))) = (self.is_path_typed, &self.shown) {
            let name = PathBuf::from(&preview.file_name);
            let path = self.folder.as_ref().map_or(name.clone(), |folder| folder.join(&name));
            self.path = path.display().to_string();
        }
    }

    /// Shows the dialog.
    pub(crate) fn show(&mut self, ui: &Ui, preset: &Preset, is_waiting: bool) -> Answer {
        let asked = self.asked(preset);
        self.follow(ui.ctx(), &asked);
        let modal = Modal::new(Id::unique("export")).show(ui.ctx(), |ui| {
            ui.set_width(theme::EXPORT_SIZE[0]);
            ui.set_height(theme::EXPORT_SIZE[1]);
            ui.heading(format!("Export “{}”", preset.name));
            ui.add_space(theme::GAP);
            ui.horizontal_top(|ui| {
                ui.allocate_ui(Vec2::new(theme::TARGET_LIST, ui.available_height()), |ui| self.targets(ui));
                ui.add_space(theme::GROUP_GAP - theme::GAP);
                ui.vertical(|ui| self.right(ui, &asked, is_waiting)).inner
            })
            .inner
        });
        match modal.inner {
            Answer::None if modal.should_close() => Answer::Close,
            answer => answer,
        }
    }

    fn targets(&mut self, ui: &mut Ui) {
        ui.vertical(|ui| {
            ui.set_width(theme::TARGET_LIST);
            ui.spacing_mut().item_spacing.y = 2.0;
            for target in Target::ALL {
                let extension = theme::hint(format!(".{}", target.extension()));
                let button = Button::selectable(self.target == target, target.label()).right_text(extension);
                let button = ui.add(button.min_size(Vec2::new(theme::TARGET_LIST, theme::ROW)).truncate());
                if button.on_hover_text(target.note()).accessible_name(target.label()).clicked() {
                    self.target = target;
                    self.status = None;
                }
            }
        });
    }

    fn right(&mut self, ui: &mut Ui, asked: &Asked, is_waiting: bool) -> Answer {
        ui.set_width(ui.available_width());
        ui.label(theme::title(asked.target.label()));
        ui.add(Label::new(RichText::new(asked.target.note()).small()).wrap());
        self.spaces(ui, asked);
        ui.add_space(theme::GAP);
        let Some((of, preview)) = &self.shown else {
            ui.label(theme::hint("Making the file…"));
            return self.buttons(ui, asked, None, is_waiting);
        };
        // What is shown may still be of the target before; its curve and text belong together.
        let is_current = of == asked;
        match preview {
            Ok(preview) => {
                let preview = preview.clone();
                curves_and_losses(ui, &preview);
                ui.add_space(theme::GAP);
                file(ui, &preview);
                self.buttons(ui, asked, Some(&preview).filter(|_| is_current), is_waiting)
            }
            Err(reason) => {
                let reason = RichText::new(reason).color(Palette::of(ui).error);
                ui.add(Label::new(reason).wrap());
                self.buttons(ui, asked, None, is_waiting)
            }
        }
    }

    fn spaces(&mut self, ui: &mut Ui, asked: &Asked) {
        ui.horizontal(|ui| {
            ui.label("Working space of the scene");
            let spaces = asked.target.spaces();
            let choice = |ui: &mut Ui| {
                for &space in spaces {
                    ui.selectable_value(&mut self.space, space, space.label());
                }
            };
            ui.add_enabled_ui(spaces.len() > 1, |ui| {
                let combo = ComboBox::from_id_salt("export space").selected_text(asked.space.label());
                combo.show_ui(ui, choice).response.accessible_name("Working space of the export");
            });
            if spaces.len() == 1 {
                ui.label(theme::hint("the only one this format has"));
            } else if asked.space != self.space {
                ui.label(theme::hint(format!("it does not know {}", self.space.label())));
            }
        });
    }

    fn buttons(&mut self, ui: &mut Ui, asked: &Asked, preview: Option<&Preview>, is_waiting: bool) -> Answer {
        ui.add_space(theme::GAP);
        let mut answer = Answer::None;
        ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut self.path).hint_text("/path/to/file or folder");
            let field = ui.add(field.desired_width(ui.available_width() - WRITE_WIDTH));
            let field = field.accessible_name("Path to write to");
            if field.changed() {
                self.is_path_typed = true;
            }
            let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let can_write = preview.is_some() && !self.path.trim().is_empty();
            let write = ui.add_enabled(can_write, Button::new("Write")).on_hover_text("Write to this path");
            if (write.clicked() || is_entered) && can_write {
                answer = Answer::Write(asked.clone(), PathBuf::from(self.path.trim()));
            }
        });
        ui.horizontal(|ui| {
            if is_waiting {
                ui.label("Waiting for the system's file dialog");
                if ui.button("Stop waiting").clicked() {
                    answer = Answer::StopWaiting;
                }
                return;
            }
            let choose = ui.add_enabled(preview.is_some(), Button::new("Choose a file…"));
            if choose.on_hover_text("Choose where to write in the system's dialog").clicked() {
                let name = preview.map(|preview| preview.file_name.clone()).unwrap_or_default();
                answer = Answer::Choose(asked.clone(), name);
            }
            let text = preview.filter(|preview| preview.is_whole).map(|preview| &preview.text);
            let copy = ui.add_enabled(text.is_some(), Button::new("Copy the text"));
            if copy.on_hover_text("Copy the whole file to the clipboard").clicked() {
                answer = text.cloned().map_or(Answer::None, Answer::Copy);
            }
            if ui.button("Close").clicked() {
                answer = Answer::Close;
            }
            self.status(ui);
        });
        answer
    }

    fn status(&self, ui: &mut Ui) {
        let palette = Palette::of(ui);
        let (text, colour) = match &self.status {
            None => return,
            Some(Ok(text)) => (text, palette.good),
            Some(Err(text)) => (text, palette.error),
        };
        ui.add(Label::new(RichText::new(text).small().color(colour)).truncate()).on_hover_text(text);
    }
}

/// Room for the button beside the path.
const WRITE_WIDTH: f32 = 58.0;

/// The curve of the target over that of the preset, and beside it what is lost.
fn curves_and_losses(ui: &mut Ui, preview: &Preview) {
    ui.horizontal_top(|ui| {
        ui.allocate_ui(theme::EXPORT_PLOT, |ui| {
            ui.vertical(|ui| {
                ui.set_width(theme::EXPORT_PLOT.x);
                curves(ui, preview);
            });
        });
        ui.add_space(theme::GROUP_GAP - theme::GAP);
        ui.vertical(|ui| losses(ui, preview));
    });
}

fn curves(ui: &mut Ui, preview: &Preview) {
    ui.horizontal(|ui| {
        line_sample(ui, LineStyle::Solid, theme::TRUTH_CURVE, 0.4);
        ui.label(theme::hint("preset"));
        ui.add_space(theme::GAP);
        line_sample(ui, SHOWN, theme::CURVE, 1.0);
        ui.label(theme::hint("what the target will show"));
    });
    let line = |name, curve, style, width, opacity| PlotLine { name, curve, style, width, opacity };
    let lines = [
        line("preset", &preview.wanted[..], LineStyle::Solid, theme::TRUTH_CURVE, 0.4),
        line("target", &preview.shown[..], SHOWN, theme::CURVE, 1.0),
    ];
    let height = ui.available_height().min(theme::EXPORT_PLOT.y);
    let plot = CurvePlot { lines: &lines, band: None, handles: &[], range_deg: 0.0..=90.0, cursor_deg: None, height };
    plot.show(ui);
}

/// What is lost in words, then in numbers: channel by channel, and as a colour difference.
fn losses(ui: &mut Ui, preview: &Preview) {
    let palette = Palette::of(ui);
    if preview.losses.is_empty() {
        ui.label(RichText::new("Nothing is lost.").color(palette.good));
    } else {
        ui.label(theme::title("What is lost"));
    }
    ScrollArea::vertical().id_salt("losses").max_height(LOSSES_HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
        for loss in &preview.losses {
            ui.horizontal_top(|ui| {
                ui.label(RichText::new("▲").small().color(palette.warning));
                ui.add(Label::new(RichText::new(loss).small()).wrap());
            });
        }
    });
    ui.add_space(theme::GAP);
    let difference = &preview.difference;
    Grid::new("difference").num_columns(2).spacing([theme::GROUP_GAP, 3.0]).show(ui, |ui| {
        for (channel, colour) in palette.channels.into_iter().enumerate() {
            ui.label(RichText::new(format!("largest |ΔF|, {}", channel_names()[channel])).small().color(colour));
            ui.label(theme::number(format!("{:.5}", difference.delta_f[channel])));
            ui.end_row();
        }
        ui.label(theme::hint("largest ΔE2000"));
        ui.label(theme::number(format!("{:.3}", difference.max_delta_e)));
        ui.end_row();
    });
}

/// Height of the sentences about losses.
const LOSSES_HEIGHT: f32 = 96.0;

/// The text of the file.
fn file(ui: &mut Ui, preview: &Preview) {
    ui.horizontal(|ui| {
        ui.label(theme::title(&preview.file_name));
        ui.label(theme::hint(format!("{} bytes", preview.bytes)));
    });
    let height = ui.available_height() - BUTTONS_HEIGHT;
    eframe::egui::Frame::new().fill(ui.visuals().extreme_bg_color).inner_margin(theme::GAP).show(ui, |ui| {
        ScrollArea::both().id_salt("file").max_height(height).min_scrolled_height(height).auto_shrink(false).show(
            ui,
            |ui| {
                let text = RichText::new(&preview.text).text_style(TextStyle::Monospace);
                ui.add(Label::new(text).extend().selectable(true));
            },
        );
    });
}

/// Height of the path and the buttons below the text.
const BUTTONS_HEIGHT: f32 = 76.0;
