//! `docs/evidence.md`, written from the program's own measurements.

use std::fmt::{self, Write};
use std::ops::ControlFlow;

use super::{Candidate, Evidence, StudyError};
use crate::color::RgbSpace;

/// Measures everything and writes it as Markdown.
pub fn evidence_markdown(progress: &(dyn Fn(f32) -> ControlFlow<()> + Sync)) -> Result<String, StudyError> {
    Ok(Evidence::measure(progress)?.markdown())
}

impl Evidence {
    /// The measurements as the document `docs/evidence.md`.
    pub fn markdown(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("writing to a string does not fail");
        text
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        out.push_str(INTRODUCTION);
        self.write_claims(out)?;
        self.write_models(out)?;
        self.write_hard_cases(out)?;
        self.write_spread(out)?;
        out.push_str(COMPARISON);
        self.write_comparison(out)
    }

    fn write_claims(&self, out: &mut String) -> fmt::Result {
        out.push_str("\n## The paper's claims\n\n| section | claim | outcome | measured |\n|---|---|---|---|\n");
        for claim in self.claims() {
            writeln!(out, "| {} | {} | **{}** | {} |", claim.section, claim.says, claim.verdict.label(), claim.found)?;
        }
        out.push_str(NOT_MEASURED);
        Ok(())
    }

    fn write_models(&self, out: &mut String) -> fmt::Result {
        for space in RgbSpace::ALL {
            write!(out, "\n## Every model in {}\n\n{MODEL_HEADER}", space.label())?;
            for summary in self.summaries.iter().filter(|summary| summary.space == space) {
                writeln!(
                    out,
                    "| {} | {:.3} | {:.3} | {:.2} | {:.3} | {} {:.2} | {} | {} |",
                    summary.candidate.label(),
                    summary.mean_delta_e,
                    summary.median_delta_e,
                    summary.mean_max_delta_e,
                    summary.sphere_delta_e,
                    summary.worst_metal,
                    summary.worst_mean_delta_e,
                    summary.below_two,
                    summary.worse_than_schlick_text()
                )?;
            }
        }
        Ok(())
    }

    fn write_hard_cases(&self, out: &mut String) -> fmt::Result {
        let space = RgbSpace::AcesCg;
        let of = |candidate: Candidate, metal: &str| {
            self.rows_of(space, candidate).find(|row| row.metal == metal).map_or(f64::NAN, |row| row.mean_delta_e)
        };
        out.push_str(
            "\n## Where h loses\n\nThe ten largest mean errors of r and h in ACEScg, next to the alternatives.\n\n",
        );
        out.push_str(
            "| metal | r, h | largest | at | Schlick | Lazányi fitted | n, k fitted |\n|---|---|---|---|---|---|---|\n",
        );
        for row in self.hard_cases(space).into_iter().take(10) {
            writeln!(
                out,
                "| {} | {:.2} | {:.1} | {}° | {:.2} | {:.2} | {:.3} |",
                row.name,
                row.mean_delta_e,
                row.max_delta_e,
                row.angle_of_max_deg,
                of(Candidate::SCHLICK, &row.metal),
                of(Self::FITTED_LAZANYI, &row.metal),
                of(Self::FITTED_NK, &row.metal)
            )?;
        }
        Ok(())
    }

    fn write_spread(&self, out: &mut String) -> fmt::Result {
        out.push_str(SPREAD_HEADER);
        for row in &self.spread {
            writeln!(
                out,
                "| {} | {} | {} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} |",
                row.name,
                row.datasets,
                row.measured,
                row.median_r_delta_e,
                row.median_h_delta_e,
                row.max_r_delta_e,
                row.max_h_delta_e,
                row.hoffman_mean_delta_e
            )?;
        }
        Ok(())
    }

    fn write_comparison(&self, out: &mut String) -> fmt::Result {
        for (candidate, acescg, srgb) in INDEPENDENT {
            let candidate: Candidate = candidate.parse().expect("a candidate of this table, parsed by a test");
            write!(out, "| {} ", candidate.label())?;
            for (space, there) in [(RgbSpace::AcesCg, acescg), (RgbSpace::LinRec709, srgb)] {
                let (all, without) = self.mean_with_and_without_caesium(space, candidate);
                write!(out, "| {there} | {all:.3} | {without:.3} ")?;
            }
            out.push_str("|\n");
        }
        Ok(())
    }

    fn mean_with_and_without_caesium(&self, space: RgbSpace, candidate: Candidate) -> (f64, f64) {
        let mean = |rows: Vec<f64>| rows.iter().sum::<f64>() / rows.len() as f64;
        let rows = self.rows_of(space, candidate);
        let without = rows.clone().filter(|row| row.name != "Caesium");
        (mean(rows.map(|row| row.mean_delta_e).collect()), mean(without.map(|row| row.mean_delta_e).collect()))
    }
}

/// Means over 40 metals that an independent program measured by the same convention: ACEScg and linear sRGB.
pub(super) const INDEPENDENT: [(&str, f64, f64); 8] = [
    ("schlick:exact", 1.06, 1.06),
    ("hoffman:exact", 0.27, 0.27),
    ("lazanyi:black-box", 0.19, 0.19),
    ("conductor:points-650-550-450", 1.83, 0.82),
    ("conductor:points-630-532-465", 2.50, 1.29),
    ("conductor:colour-matching", 0.26, 0.35),
    ("gulbrandsen:default-g", 1.26, 1.30),
    ("conductor:black-box", 0.012, 0.028),
];

const INTRODUCTION: &str = "# Evidence

Written by `edgewise study accuracy --evidence`; a test compares it with the program. Do not edit it by hand.

The comparison of Hoffman, \"Fresnel Equations Considered Harmful\": the ground truth of a measured metal is its
spectral reflectance (exact Fresnel equations, unpolarised, 380–780 nm at 1 nm), seen by the CIE 1931 2° observer under
D65 (D60 for ACEScg), adapted by Bradford to the white of the space; nothing is clipped. A model has its parameters in
the space. Differences are CIEDE2000 at 0°, 1°, …, 90°, relative to the space's white. One data set for each of the
library's materials, alkali metals and intermetallics included.
";

const NOT_MEASURED: &str = "
Not measured here, because they need people or photographs: that painting r from a photograph is more accurate than
painting g (section 5), and how artists judge either (section 6). What can be measured of section 6, decoupling and
uniformity, has its own commands: `edgewise study decoupling` and `edgewise study uniformity`.
";

const MODEL_HEADER: &str =
    "CIEDE2000: mean and median over the metals of the mean over the angles; mean over the metals of the
largest; mean over the picture of a sphere; the metal with the largest mean; number of metals with a mean below 2, and
of those for which it is worse than Schlick with the exact r.

| model | mean | median | largest | sphere | worst metal | below 2 | worse than Schlick |
|---|---|---|---|---|---|---|---|
";

const SPREAD_HEADER: &str = "
## Published measurements of one material differ more than the models

CIEDE2000 in linear sRGB: r and h of the other data sets against the preferred one (median), and between any two
(largest), next to the mean error of the model with the exact r and h.

| material | data sets | measured | r, median | h, median | r, largest | h, largest | model error |
|---|---|---|---|---|---|---|---|
";

const COMPARISON: &str = "
Two published sets of a material differ by a median of about 1.5 ΔE at r and 1.3 at h: more than r and h are wrong. (The
two of osmium are directions of one crystal, and those of permalloy the same film with and without a gold layer.)

Of iron the database has only two measurements that can be used: one more starts at 667 nm, and one by electron energy
loss has up to two and a half times the k of the others. The third set is a density functional calculation, and says so;
so do the two Brendel–Bormann fits of platinum and beryllium.

## Against an independent measurement

The same means from another program over 40 metals of the same database. Per metal and model the two programs agree
within 0.02 ΔE (`tests/model_error.rs`); the sets of metals are not the same, and a few metals dominate a mean: caesium
alone is a fifth of the mean of r and h.

| model | ACEScg, there | here | without caesium | linear sRGB, there | here | without caesium |
|---|---|---|---|---|---|---|
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_the_other_program_names_candidates() {
        for (candidate, ..) in INDEPENDENT {
            assert!(candidate.parse::<Candidate>().is_ok(), "{candidate}");
        }
    }
}
