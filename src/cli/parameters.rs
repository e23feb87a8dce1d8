//! The parameters of a model as rows, for subcommands that print them.

use crate::fresnel::FresnelModel;

/// A parameter by the paper's symbol, with one value for each channel, or one for all.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The symbol.
    pub symbol: &'static str,
    /// Three values, or one.
    pub values: Vec<f64>,
}

/// The parameters of a model, in the order of its definition.
pub fn parameters(model: &FresnelModel) -> Vec<Parameter> {
    let of = |symbol, values: &[f64]| Parameter { symbol, values: values.to_vec() };
    match model {
        FresnelModel::Constant { r } | FresnelModel::Schlick { r } => vec![of("r", &r.0)],
        FresnelModel::Lazanyi { r, a, alpha } => vec![of("r", &r.0), of("a", &a.0), of("alpha", &[*alpha])],
        FresnelModel::Hoffman { r, h } => vec![of("r", &r.0), of("h", &h.0)],
        FresnelModel::F82Tint { r, t } => vec![of("r", &r.0), of("t", &t.0)],
        FresnelModel::GeneralizedSchlick { r0, t, r90, p } => {
            vec![of("r0", &r0.0), of("t", &t.0), of("r90", &r90.0), of("p", &[*p])]
        }
        FresnelModel::Gulbrandsen { r, g } => vec![of("r", &r.0), of("g", &g.0)],
        FresnelModel::Conductor { n, k } => vec![of("n", &n.0), of("k", &k.0)],
    }
}

/// `r=0.94;0.78;0.37 h=…`: all parameters in one cell, with this many decimals or all digits.
pub fn in_one_cell(model: &FresnelModel, decimals: Option<usize>) -> String {
    let number = |value: &f64| decimals.map_or_else(|| value.to_string(), |decimals| format!("{value:.decimals$}"));
    let one = |parameter: &Parameter| {
        let values: Vec<String> = parameter.values.iter().map(number).collect();
        format!("{}={}", parameter.symbol, values.join(";"))
    };
    parameters(model).iter().map(one).collect::<Vec<_>>().join(" ")
}
