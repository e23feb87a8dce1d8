//! Undo and redo of the document, by snapshot.

use eframe::egui::util::undoer::Undoer;

use crate::preset::Preset;

/// Snapshots of the preset: one drag is one step, and so is one pause in typing.
#[derive(Debug, Default)]
pub(crate) struct History {
    undoer: Undoer<Preset>,
    was_pointer_down: bool,
    /// A change that is not yet a step.
    pending: Option<Preset>,
}

/// Seconds without a change after which typing becomes a step; egui's default.
pub(crate) const STABLE_SECONDS: f32 = 1.0;

impl History {
    /// Starts over with a document that cannot be undone.
    pub(crate) fn restart(&mut self, preset: &Preset) {
        *self = Self::default();
        self.undoer.add_undo(preset);
    }

    /// Once a frame: sees the document, unless a button is held and it is still on its way.
    pub(crate) fn feed(&mut self, time_seconds: f64, is_pointer_down: bool, preset: &Preset) {
        if is_pointer_down {
            // What was there before the press is a step of its own.
            if let Some(pending) = self.pending.take() {
                self.undoer.add_undo(&pending);
            }
            self.was_pointer_down = true;
            return;
        }
        self.undoer.feed_state(time_seconds, preset);
        self.pending = self.undoer.is_in_flux().then(|| preset.clone());
        if std::mem::take(&mut self.was_pointer_down) {
            self.commit(time_seconds, preset);
        }
    }

    /// Ends a step now. `feed_state` comes first because `add_undo` alone would keep the redos.
    pub(crate) fn commit(&mut self, time_seconds: f64, preset: &Preset) {
        self.undoer.feed_state(time_seconds, preset);
        self.undoer.add_undo(preset);
        self.pending = None;
    }

    /// True while a change waits to become a step.
    pub(crate) fn is_waiting(&self) -> bool {
        self.undoer.is_in_flux()
    }

    pub(crate) fn can_undo(&self, preset: &Preset) -> bool {
        self.undoer.has_undo(preset)
    }

    pub(crate) fn can_redo(&self, preset: &Preset) -> bool {
        self.undoer.has_redo(preset)
    }

    pub(crate) fn undo(&mut self, preset: &mut Preset) {
        if let Some(earlier) = self.undoer.undo(preset) {
            *preset = earlier.clone();
        }
    }

    pub(crate) fn redo(&mut self, preset: &mut Preset) {
        if let Some(later) = self.undoer.redo(preset) {
            *preset = later.clone();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn with_r(r: f64) -> Preset {
        Preset { r: Rgb::splat(r), ..Preset::new_authored() }
    }

    /// Drags r through some values and lets go.
    fn drag(history: &mut History, time: &mut f64, values: &[f64]) {
        for &value in values {
            *time += 0.1;
            history.feed(*time, true, &with_r(value));
        }
        *time += 0.1;
        history.feed(*time, false, &with_r(values[values.len() - 1]));
    }

    #[test]
    fn one_drag_is_one_step_however_fast_they_follow() {
        let (mut history, mut time) = (History::default(), 0.0);
        history.restart(&with_r(0.1));
        drag(&mut history, &mut time, &[0.2, 0.3, 0.4]);
        drag(&mut history, &mut time, &[0.5, 0.6]);
        let mut preset = with_r(0.6);
        for expected in [0.4, 0.1] {
            history.undo(&mut preset);
            assert_eq!(preset, with_r(expected));
        }
        assert!(!history.can_undo(&preset));
        for expected in [0.4, 0.6] {
            history.redo(&mut preset);
            assert_eq!(preset, with_r(expected));
        }
        assert!(!history.can_redo(&preset));
    }

    #[test]
    fn a_press_ends_the_step_before_it() {
        let (mut history, mut time) = (History::default(), 0.0);
        history.restart(&with_r(0.1));
        history.feed(time, false, &with_r(0.2));
        drag(&mut history, &mut time, &[0.3, 0.4]);
        let mut preset = with_r(0.4);
        history.undo(&mut preset);
        assert_eq!(preset, with_r(0.2));
    }

    #[test]
    fn a_new_change_drops_the_redos() {
        let (mut history, mut time) = (History::default(), 0.0);
        history.restart(&with_r(0.1));
        drag(&mut history, &mut time, &[0.2]);
        let mut preset = with_r(0.2);
        history.undo(&mut preset);
        assert!(history.can_redo(&preset));
        drag(&mut history, &mut time, &[0.7]);
        assert!(!history.can_redo(&with_r(0.7)));
    }

    #[test]
    fn undo_takes_back_a_change_that_is_not_yet_a_step() {
        let mut history = History::default();
        history.restart(&with_r(0.1));
        history.feed(0.0, false, &with_r(0.2));
        assert!(history.is_waiting());
        let mut preset = with_r(0.2);
        history.undo(&mut preset);
        assert_eq!(preset, with_r(0.1));
    }
}
