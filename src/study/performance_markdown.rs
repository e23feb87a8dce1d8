//! `docs/performance.md`, written from the program's own measurements.

use std::fmt::{self, Write};

use super::{SpeedRow, StabilityRow};

/// Speed in the cache and from memory, and stability, as the document `docs/performance.md`.
pub fn performance_markdown(cached: &[SpeedRow], from_memory: &[SpeedRow], stability: &[StabilityRow]) -> String {
    let mut text = String::new();
    write(&mut text, cached, from_memory, stability).expect("writing to a string does not fail");
    text
}

fn write(out: &mut String, cached: &[SpeedRow], from_memory: &[SpeedRow], stability: &[StabilityRow]) -> fmt::Result {
    out.push_str(INTRODUCTION);
    let instruction_set = cached.first().map_or("none", |row| row.instruction_set);
    writeln!(out, "\nInstruction set of the machine that wrote it: {instruction_set}.\n\n{SPEED_HEADER}")?;
    for row in cached {
        let memory = from_memory.iter().find(|other| other.kernel == row.kernel).map_or(f64::NAN, |row| row.min_ns);
        writeln!(
            out,
            "| {} | {} | {} | {:.3} | {:.3} | {:.2} | {:.2} | {memory:.2} | {} | {} | {} | {} |",
            row.name,
            row.kind,
            row.over,
            row.min_ns,
            row.median_ns,
            row.ratio_to_schlick,
            row.ratio_to_bound,
            row.parameter_bytes,
            row.operations,
            row.divisions,
            row.square_roots + row.powers
        )?;
    }
    out.push_str(LIMITS_HEADER);
    for Limit { says, found, limit } in limits(cached) {
        let verdict = if found <= limit { "met" } else { "**not met**" };
        writeln!(out, "| {says} | {found:.2} | {limit} | {verdict} |")?;
    }
    out.push_str(STABILITY_HEADER);
    for row in stability {
        let number = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1e}"));
        writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.quantity,
            row.kind,
            row.arithmetic,
            row.domain,
            row.points,
            number(row.max_absolute),
            row.max_absolute_at,
            number(row.max_ulp),
            row.nan,
            row.infinite,
            row.negative,
            row.above_one
        )?;
    }
    Ok(())
}

/// A ratio of two times, and the largest it should be.
struct Limit {
    says: &'static str,
    found: f64,
    limit: f64,
}

fn limits(rows: &[SpeedRow]) -> Vec<Limit> {
    let ns = |id: &str| rows.iter().find(|row| row.kernel == id).map_or(f64::NAN, |row| row.min_ns);
    let limit = |says, above: &str, below: &str, limit| Limit { says, found: ns(above) / ns(below), limit };
    // The bound is for three channels; a wavelength has one.
    let wavelengths = ns("spectral-81") / (27.0 * ns("two-roots-one-division"));
    vec![
        limit("h over Schlick", "hoffman", "schlick", 1.6),
        limit("F82-tint over Schlick", "f82-tint", "schlick", 1.6),
        limit(
            "n and k with 1 − F over two roots and a division",
            "conductor-and-absorption",
            "two-roots-one-division",
            1.15,
        ),
        Limit { says: "81 wavelengths over two roots and a division each", found: wavelengths, limit: 1.05 },
        Limit { says: "nanoseconds of a CIEDE2000 pair", found: ns("delta-e"), limit: 15.0 },
    ]
}

const INTRODUCTION: &str = "# Performance

Written by `edgewise study speed --evidence` in a release build. Do not edit it by hand; the times are one machine's.

Every kernel takes its turn in every round, so that a change of the clock or of the load meets all of them; the smallest
and the median time of all rounds are given. Compare ratios, not nanoseconds. `material` has one material's constants in
registers, `pixels` reads its parameters from a texture. Operations are those of the source of a shader for one RGB value.
";

const SPEED_HEADER: &str = "| kernel | kind | over | ns | median ns | × Schlick | × bound | ns from memory | bytes | operations | divisions | roots, powers |
|---|---|---|---|---|---|---|---|---|---|---|---|";

const LIMITS_HEADER: &str = "
## Limits

Ratios of the smallest times above, in the cache.

| what | measured | at most | |
|---|---|---|---|
";

const STABILITY_HEADER: &str = "
## Stability

Against 512 bits, as `edgewise study stability` measures it; the columns are explained in docs/cli.md.

| quantity | kind | arithmetic | domain | points | off by | at | ULP | NaN | infinite | negative | above 1 |
|---|---|---|---|---|---|---|---|---|---|---|---|
";

#[cfg(test)]
mod tests {
    use super::*;

    fn row(kernel: &'static str, min_ns: f64) -> SpeedRow {
        SpeedRow {
            kernel,
            name: kernel,
            kind: "ours",
            over: "material",
            min_ns,
            median_ns: min_ns,
            ratio_to_schlick: min_ns,
            ratio_to_bound: min_ns,
            parameter_bytes: 24,
            operations: 10,
            divisions: 0,
            square_roots: 0,
            powers: 0,
            instruction_set: "avx2",
        }
    }

    #[test]
    fn limits_are_held_against_what_was_measured() {
        let rows = [row("schlick", 1.0), row("hoffman", 1.5), row("f82-tint", 1.7)];
        let text = performance_markdown(&rows, &[], &[]);
        assert!(text.contains("| h over Schlick | 1.50 | 1.6 | met |"), "{text}");
        assert!(text.contains("| F82-tint over Schlick | 1.70 | 1.6 | **not met** |"), "{text}");
        // What was not measured is not met.
        assert!(text.contains("| nanoseconds of a CIEDE2000 pair | NaN | 15 | **not met** |"), "{text}");
    }
}
