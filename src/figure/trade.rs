//! Cost against accuracy as a figure.

use super::scatter::{ScatterFigure, ScatterPoint};
use crate::study::{TradeOptions, TradeRow, Variant};

/// One point for each variant; what is by definition the truth has no error and no place on the vertical axis.
pub fn trade_figure(material: &str, rows: &[TradeRow], options: &TradeOptions) -> ScatterFigure {
    let point = |row: &TradeRow| {
        Some(ScatterPoint {
            label: short_name(row.variant),
            x: options.costs.of(row.variant).on(options.cost)?,
            y: row.error(options.measure),
            series: family(row.variant),
            is_on_front: row.is_on_front,
        })
    };
    let exact = rows.iter().find(|row| row.variant == Variant::Exact);
    let exact = exact.and_then(|row| options.costs.of(row.variant).on(options.cost));
    let unit = options.cost.unit();
    let dearest = exact.map(|cost| format!("; the exact spectral sum, ΔE 0, costs {cost:.0} {unit}"));
    let dearest = dearest.unwrap_or_default();
    ScatterFigure {
        title: format!("{material}: accuracy for cost"),
        subtitle: format!("{}, {} over 0–90°{dearest}", options.space.label(), options.measure.label()),
        x_name: options.cost.label().to_owned(),
        y_name: format!("{}2000", capitalised(options.measure.label())),
        is_x_log: true,
        is_y_log: true,
        series: FAMILIES.map(str::to_owned).into(),
        points: rows.iter().filter(|row| row.error(options.measure) > 0.0).filter_map(point).collect(),
        front_name: "Nothing as cheap is nearer to the truth".to_owned(),
    }
}

const FAMILIES: [&str; 4] = ["Two colours and less", "Fitted to one metal", "n and k", "Spectral"];

const fn family(variant: Variant) -> usize {
    use crate::fresnel::ModelKind as K;
    match variant {
        Variant::Model(K::Constant | K::Schlick | K::Hoffman | K::F82Tint | K::GeneralizedSchlick, _) => 0,
        Variant::Model(K::Lazanyi, _) | Variant::Series(_) | Variant::Polynomial(_) | Variant::Table(_) => 1,
        Variant::Model(K::Gulbrandsen | K::Conductor, _) => 2,
        Variant::Spectral(_) | Variant::Exact => 3,
    }
}

/// A name that fits beside a dot.
fn short_name(variant: Variant) -> String {
    use crate::fit::Method;
    use crate::fresnel::ModelKind as K;
    match variant {
        Variant::Model(kind, method) => {
            let name = match kind {
                K::Constant => "Constant",
                K::Schlick => "Schlick",
                K::Lazanyi => "Lazányi",
                K::Hoffman => "r, h",
                K::F82Tint => "F82-tint",
                K::GeneralizedSchlick => "Generalized Schlick",
                K::Gulbrandsen => "r, g",
                K::Conductor => "n, k",
            };
            match method {
                Method::LeastSquares => format!("{name} fitted"),
                Method::ColourMatching => format!("{name} weighted"),
                Method::Points(_) => format!("{name} sampled"),
                _ => name.to_owned(),
            }
        }
        Variant::Spectral(count) => format!("{count} wavelengths"),
        other => other.label(),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::check::assert_texts_are_legible;
    use crate::figure::{Figure, FigureTheme};
    use crate::metal::metal_by_name;
    use crate::study::{CostAxis, Measure, Subject, no_progress, trade};

    #[test]
    fn every_variant_but_the_truth_has_a_point() {
        let gold = [Subject::Metal(metal_by_name("gold").unwrap())];
        for cost in [CostAxis::ShaderOperations, CostAxis::ParameterBytes] {
            for measure in Measure::ALL {
                let options = TradeOptions { cost, measure, ..TradeOptions::default() };
                let figure = trade_figure("Gold", &trade(&gold, &options, &no_progress).unwrap(), &options);
                assert_eq!(figure.points.len(), Variant::ALL.len() - 1);
                assert!(figure.subtitle.ends_with(&format!(" {}", cost.unit())), "{}", figure.subtitle);
                assert_texts_are_legible(&figure.drawing(FigureTheme::Light));
            }
        }
    }
}
