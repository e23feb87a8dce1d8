//! Which quality the pictures on show have, and what that costs, in words.

use super::preview::{Off, Quality};

/// The pictures on show beside the finished ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Standing {
    /// The quality they have.
    pub quality: Quality,
    /// True where one is of a metal, for which wavelengths count.
    pub has_metal: bool,
    /// Milliseconds they took.
    pub took_ms: f64,
    /// How far pictures of this quality are from the finished ones, as measured when the hand rested last; `None` where
    /// it has not been yet.
    pub off: Option<Off>,
}

impl Standing {
    /// True where nothing better follows.
    pub(crate) fn is_finished(&self) -> bool {
        self.quality == Quality::FULL
    }

    /// What is shown, and that it took too long where it did: `Coarse: every 2nd pixel, every nanometre`.
    pub(crate) fn what(&self, budget_ms: f64) -> String {
        let word = if self.is_finished() { "Finished" } else { "Coarse" };
        let spectrum = if self.has_metal { format!(", {}", self.quality.spectrum()) } else { String::new() };
        let is_late = !self.is_finished() && self.took_ms > budget_ms;
        let late = if is_late { format!("; took {}", over(self.took_ms, budget_ms)) } else { String::new() };
        format!("{word}: {}{spectrum}{late}", self.quality.pixels())
    }

    /// How far that is from the finished picture; nothing where it is the finished one.
    pub(crate) fn cost(&self) -> String {
        match self.off {
            _ if self.is_finished() => String::new(),
            Some(off) => format!("ΔE ≈ {:.2} off the finished picture, at most ≈ {:.1}", off.mean, off.max),
            None => "How far off the finished picture is not measured yet".to_owned(),
        }
    }
}

/// A time beside the budget that it does not keep: `4.2 ms, over the budget of 1 ms`.
pub(crate) fn over(took_ms: f64, budget_ms: f64) -> String {
    format!("{took_ms:.1} ms, over the budget of {budget_ms:.0} ms")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_coarse_says_so_and_what_it_costs() {
        let off = Some(Off { mean: 1.234, max: 14.06 });
        let coarse = Standing { quality: Quality::LADDER[3], has_metal: true, took_ms: 4.23, off };
        assert_eq!(coarse.what(16.0), "Coarse: every 2nd pixel, 16 wavelengths");
        assert_eq!(coarse.what(1.0), "Coarse: every 2nd pixel, 16 wavelengths; took 4.2 ms, over the budget of 1 ms");
        assert_eq!(coarse.cost(), "ΔE ≈ 1.23 off the finished picture, at most ≈ 14.1");
        let unknown = Standing { off: None, has_metal: false, ..coarse };
        assert_eq!(unknown.what(5.0), "Coarse: every 2nd pixel");
        assert!(unknown.cost().contains("not measured yet"));
    }

    #[test]
    fn what_is_finished_is_never_late() {
        let finished = Standing { quality: Quality::FULL, has_metal: true, took_ms: 99.0, off: None };
        assert_eq!(finished.what(1.0), "Finished: every pixel, every nanometre");
        assert_eq!(finished.cost(), "");
    }
}
