//! `docs/performance.md`, written from the program's own measurements.

use std::fmt::{self, Write};

use super::evidence::{BuildTimes, Instructions, Machine, PythonTimes, StandIn};
use super::kernels::{BOUND, MATERIAL, OURS, PAIR, PALETTE, PICTURE, PIXEL, TABLE};
use super::{BarVerdict, SpeedEvidence, SpeedRow, bars};

impl SpeedEvidence {
    /// The measurements as the document `docs/performance.md`.
    pub fn markdown(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("writing to a string does not fail");
        text
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        out.push_str(INTRODUCTION);
        writeln!(out, "\n{}", self.machine.sentence(self.rounds))?;
        self.write_bars(out)?;
        self.write_rows(out)?;
        self.write_bounds(out)?;
        self.write_instructions(out)?;
        self.write_beside(out)?;
        self.write_stand_ins(out)?;
        self.write_python(out)?;
        self.write_builds(out)
    }

    fn write_bars(&self, out: &mut String) -> fmt::Result {
        let bars = self.bars();
        out.push_str("\n## What is aimed at\n\n| | aim | measured | |\n|---|---|---|---|\n");
        for bar in &bars {
            writeln!(out, "| {} | {} | {} | {} |", bar.what, bar.limit, bar.measured, bar.verdict.label())?;
        }
        let of = |verdict| bars.iter().filter(move |bar| bar.verdict == verdict);
        let missed: Vec<&str> = of(BarVerdict::Missed).map(|bar| bar.what).collect();
        writeln!(
            out,
            "\n{} of {} aims are met, {} not measured. Missed: {}.",
            of(BarVerdict::Met).count(),
            bars.len(),
            of(BarVerdict::NotMeasured).count(),
            if missed.is_empty() { "none".to_owned() } else { missed.join("; ") }
        )
    }

    fn write_rows(&self, out: &mut String) -> fmt::Result {
        for (per, title) in PARTS {
            let rows: Vec<&SpeedRow> = self.rows.iter().filter(|row| row.per == per).collect();
            if rows.is_empty() {
                continue;
            }
            let (unit, scale) = if matches!(per, TABLE | PICTURE) { ("ms", 1e-6) } else { ("ns", 1.0) };
            write!(
                out,
                "\n## {title}\n\n| kernel | kind | shortest, {unit} | middle, {unit} | × Schlick | bytes | operations |\n"
            )?;
            out.push_str("|---|---|---|---|---|---|---|\n");
            for row in rows {
                writeln!(
                    out,
                    "| {} | {} | {:.3} | {:.3} | {} | {} | {} |",
                    row.kernel,
                    row.kind,
                    row.min_ns * scale,
                    row.median_ns * scale,
                    row.times_schlick.map(|times| format!("{times:.2}")).unwrap_or_default(),
                    row.parameter_bytes.map(|bytes| bytes.to_string()).unwrap_or_default(),
                    operations(row)
                )?;
            }
        }
        Ok(())
    }

    /// Ours against what they cannot do without, in the kernels that aims name and in those that none does.
    fn write_bounds(&self, out: &mut String) -> fmt::Result {
        out.push_str(BOUNDS);
        for bound in self.rows.iter().filter(|row| row.kind == BOUND) {
            let kernel = bound.kernel.as_str();
            let ratio = bars::ratio(&self.rows, (kernel, OURS, bound.per), (kernel, BOUND, bound.per));
            if let Some(ratio) = ratio {
                writeln!(out, "| {kernel} | {ratio:.2} |")?;
            }
        }
        Ok(())
    }

    fn write_instructions(&self, out: &mut String) -> fmt::Result {
        out.push_str("\n## Instructions on AVX2\n\n");
        let rows = &self.elsewhere.instructions;
        if rows.is_empty() {
            return writeln!(out, "Not counted: `scripts/count_instructions.sh` does.");
        }
        out.push_str(INSTRUCTIONS);
        for Instructions { kernel, per, instructions } in rows {
            writeln!(out, "| {kernel} | {per} | {instructions:.2} |")?;
        }
        Ok(())
    }

    /// Ours against what stands in textbooks and other programs.
    fn write_beside(&self, out: &mut String) -> fmt::Result {
        out.push_str("\n## Beside others\n\n| | against | times as long as ours |\n|---|---|---|\n");
        let others = self.rows.iter().filter(|row| row.kind != OURS && row.kind != BOUND);
        for other in others {
            let kernel = other.kernel.as_str();
            let ratio = bars::ratio(&self.rows, (kernel, other.kind, other.per), (kernel, OURS, other.per));
            if let Some(ratio) = ratio {
                writeln!(out, "| {} | {} | {ratio:.2} |", other.kernel, other.kind)?;
            }
        }
        let palette = bars::ratio(&self.rows, ("delta-e", PALETTE, PAIR), ("delta-e", OURS, PAIR));
        if let Some(ratio) = palette {
            writeln!(out, "\nThe crate palette takes {ratio:.0} times as long for a ΔE2000 of 32 bits.")?;
        }
        Ok(())
    }

    fn write_stand_ins(&self, out: &mut String) -> fmt::Result {
        out.push_str(STAND_INS);
        for (name, stand_in) in [
            ("20 wavelengths with spline weights", &self.spectral_20),
            ("10 coefficients: `edgewise export --bake`", &self.polynomial_10),
        ] {
            writeln!(out, "| {name} | {:.3} | {} |", stand_in.max_delta_e, stand_in.worst())?;
        }
        Ok(())
    }

    fn write_python(&self, out: &mut String) -> fmt::Result {
        out.push_str("\n## The table of errors in Python\n\n");
        let ours = self.rows.iter().find(|row| row.is(("error-table", OURS, TABLE))).map(|row| row.min_ns / 1e6);
        let Some((PythonTimes { python, numpy, colour, curve_by_curve_ms, batched_ms, largest_difference }, ours)) =
            self.elsewhere.python.as_ref().zip(ours)
        else {
            return writeln!(out, "Not measured: `scripts/performance.sh` does.");
        };
        writeln!(
            out,
            "Python {python}, numpy {numpy}, colour-science {colour}; the same 33 metals, parameters, angles and truth \
             of 81 wavelengths. The means differ from ours by at most {largest_difference:.1e} ΔE.\n\n\
             | | ms | times as long as ours |\n|---|---|---|\n\
             | ours | {ours:.2} | 1 |\n\
             | one call for each curve | {curve_by_curve_ms:.1} | {:.0} |\n\
             | all curves in one array | {batched_ms:.1} | {:.0} |",
            curve_by_curve_ms / ours,
            batched_ms / ours
        )
    }

    fn write_builds(&self, out: &mut String) -> fmt::Result {
        out.push_str("\n## A binary for any processor and one for this\n\n");
        let Some(middle) = self.builds_median() else {
            return writeln!(out, "Not measured: `scripts/compare_builds.sh` does.");
        };
        writeln!(
            out,
            "Both built from one source, the second with `-C target-cpu=native`, and measured in turn. In the middle of \
             our kernels the first takes {middle:.3} times as long.\n\n| kernel | kind | per | ratio |\n|---|---|---|---|"
        )?;
        for row in &self.elsewhere.builds {
            let BuildTimes { kernel, kind, per, .. } = row;
            writeln!(out, "| {kernel} | {kind} | {per} | {:.2} |", row.ratio())?;
        }
        Ok(())
    }
}

/// What one evaluation is, and what the document calls it.
const PARTS: [(&str, &str); 6] = [
    (MATERIAL, "One material: nanoseconds of one RGB value"),
    (PIXEL, "Parameters from a texture: nanoseconds of one RGB value"),
    (super::kernels::COLOR, "One colour to L\\*a\\*b\\*"),
    (PAIR, "ΔE2000 of one pair"),
    (TABLE, "Tables of errors"),
    (PICTURE, "Pictures of 1024 × 1024, from the model to 8-bit sRGB"),
];

/// `13 = 7 + 10 − 6 + 2` is too much for a table: issue slots, and how many divisions and roots are in them.
fn operations(row: &SpeedRow) -> String {
    let Some(slots) = row.shader_operations else { return String::new() };
    let special =
        |count: Option<u32>, what: &str| count.filter(|count| *count > 0).map(|count| format!("{count} {what}"));
    let parts =
        [special(row.quotients, "÷"), special(row.roots, "√"), special(row.powers, "pow"), special(row.loads, "reads")];
    let told: Vec<String> = parts.into_iter().flatten().collect();
    if told.is_empty() { slots.to_string() } else { format!("{slots} ({})", told.join(", ")) }
}

impl Machine {
    fn sentence(&self, rounds: usize) -> String {
        let Self { architecture, instruction_set, threads, is_optimised } = self;
        let warning =
            if *is_optimised { "" } else { " The program was built without optimisation: its times mean nothing." };
        format!(
            "Measured on {architecture} with {instruction_set}, {threads} hardware threads, in {rounds} rounds of which \
             each begins with another kernel.{warning}"
        )
    }
}

impl StandIn {
    /// The metals above the aim of 0.03, or the worst one.
    fn worst(&self) -> String {
        let above = self.metals.iter().filter(|(_, off)| *off > 0.03).count();
        let told: Vec<String> =
            self.metals.iter().take(above.clamp(1, 5)).map(|(name, off)| format!("{name} {off:.3}")).collect();
        let rest = self.metals.get(above.clamp(1, 5)).map(|(_, off)| format!("; the others ≤ {off:.3}"));
        told.join(", ") + &rest.unwrap_or_default()
    }
}

const INTRODUCTION: &str = "# Performance

Written by `edgewise study speed --evidence`; `scripts/performance.sh` measures what it is held against and calls it. Do
not edit it by hand. `edgewise study speed` measures your machine.

Kernels are our formulas in vectors of 32 bits, over 1024 cosines in the first cache (256 for many wavelengths), on one
core. Times are of one run in which the kernels take turns of about 30 µs; the shortest turn is the least disturbed one,
and ratios are between shortest turns. `scalar` is the same text number by number, as a stock build has it, `64-bits` the
core, `textbook` what is printed, in the same vectors, `bound` only what a kernel cannot do without. Bytes are those of
the parameters; operations are issue slots of a shader, 1 for a product with its sum, 4 for a division, a root, a power or
a read, counted by running the formula (a test holds them against naga's form of the shaders that are exported).
";

const INSTRUCTIONS: &str = "Of one evaluation, loads, stores and the loop among them, eight values in a vector: counted by a simulator as the difference
between a long run and a longer one, so that no clock is involved.

| kernel | per | instructions |
|---|---|---|
";

const BOUNDS: &str = "
## Against their roots and divisions

How long a kernel takes as a multiple of two square roots and one division for each channel or wavelength. n and k are
gold's, where k ≥ n at every wavelength and the shorter form serves; `-any` are tungsten's, with n > k, as is the form for
a material of which one channel has k < n.

| kernel | × its roots and divisions |
|---|---|
";

const STAND_INS: &str = "
## What stands in for the spectrum

Largest ΔE2000 in linear sRGB at every half degree, over the preferred data set of each of the library's materials.

| | largest ΔE | metals |
|---|---|---|
";

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::study::speed::{Elsewhere, SpeedOptions};

    /// Built without optimisation for tests, so that only what needs no clock is looked at.
    #[test]
    fn the_document_says_every_aim_and_what_was_not_measured() {
        let options = SpeedOptions { rounds: 1, kernels: vec!["hoffman".to_owned()], ..SpeedOptions::default() };
        let evidence = SpeedEvidence::measure(&options, Elsewhere::default(), &|_| ControlFlow::Continue(())).unwrap();
        let text = evidence.markdown();
        for bar in evidence.bars() {
            assert!(text.contains(bar.what), "{}", bar.what);
        }
        assert!(text.contains("| hoffman | ours |") && text.contains("not measured"), "{text}");
        assert!(evidence.bars().iter().any(|bar| bar.verdict == BarVerdict::Met), "{text}");
    }
}
