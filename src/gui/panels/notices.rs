//! Sentences about what failed or should be known, until they are dismissed.

use eframe::egui::{Align, Frame, Label, Layout, Margin, RichText, Ui};

use crate::gui::state::{NoticeKind, State};
use crate::gui::theme::Palette;

/// Shows the notices, if there are any.
pub(crate) fn show(ui: &mut Ui, state: &mut State) {
    let mut dismissed = None;
    for (index, notice) in state.notices.iter().enumerate() {
        let palette = Palette::of(ui);
        let (word, colour) = match notice.kind {
            NoticeKind::Error => ("Error", palette.error),
            NoticeKind::Warning => ("Note", palette.warning),
            NoticeKind::Done => ("Done", palette.good),
        };
        Frame::new().inner_margin(Margin::symmetric(4, 2)).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new(word).color(colour).strong());
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let button = ui.small_button("Dismiss");
                    if button.accessible_name(format!("Dismiss: {}", notice.text)).clicked() {
                        dismissed = Some(index);
                    }
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                        ui.add(Label::new(&notice.text).wrap());
                    });
                });
            });
        });
    }
    if let Some(index) = dismissed {
        state.notices.remove(index);
    }
}
