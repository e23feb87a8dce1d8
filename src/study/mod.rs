//! The paper's evidence, measured: what each model costs in accuracy and robustness.
//!
//! | question | file |
//! |---|---|
//! | how far from the truth? | `accuracy`, over all metals `summary` |
//! | how far are published measurements apart? | `spread` |
//! | which of the paper's claims hold? | `claims`, from all measurements together, `evidence` |
//! | what does converting parameters as colours change? | `conversion` |
//! | what does blending parameters change? | `blending`, and on a painted sphere `painted` |
//! | what does storing them with few digits change? | `quantisation` |
//! | does one parameter leave the other's meaning alone? | `decoupling` |
//! | do equal steps of a slider look equal? | `uniformity` |
//! | which r and h are reflectances? | `feasibility` |
//! | how much accuracy is there for how much cost? | `trade`, of the variants in `variant`, `form` and `cost` |
//! | how long does it take here? | `speed` |
//! | how many digits does a model or a conversion keep? | `stability` |
//!
//! A [`Subject`] is what a demonstration is about; [`Contestants`] are its four descriptions in one space.

mod accuracy;
mod blending;
mod candidate;
mod claims;
mod conversion;
mod cost;
mod csv_text;
mod decoupling;
mod distribution;
mod evidence;
mod evidence_markdown;
mod feasibility;
mod form;
mod json_text;
mod measure;
mod painted;
mod parameters;
mod quantisation;
mod speed;
mod spread;
mod stability;
mod subject;
mod summary;
mod trade;
mod uniformity;
mod variant;

pub use accuracy::{AccuracyRow, accuracy, no_progress};
pub use blending::{
    BLEND_STEPS, Blend, BlendPair, BlendRow, BlendSummary, BlendedParameters, WorstBlend, blend_matrix,
    blend_pairs_summary, blend_spread, blend_weights, blending,
};
pub use candidate::{Candidate, CandidateError};
pub use claims::{Claim, Verdict};
pub use conversion::{
    ColourConversion, ConversionOptions, ConversionRow, ConversionSummary, ConvertedParameters, conversion,
    conversion_of, conversion_spread, conversions, conversions_summary,
};
pub use cost::{Cost, CostAxis, Costs, EQUAL_TIMES};
pub use csv_text::rows_to_csv;
pub use decoupling::{
    CrossTalkRow, Decoupling, DecouplingOptions, DecouplingRow, SWEEP_STEPS, Sweep, Swept, decoupling,
};
pub use distribution::Distribution;
pub use evidence::Evidence;
pub use evidence_markdown::evidence_markdown;
pub use feasibility::{
    BoundaryRow, MetalPoint, feasibility_boundary, feasibility_summary, metal_points, preset_points,
};
pub use form::{Form, FormOfVariant, forms, true_reflectance};
pub use json_text::rows_to_json;
pub use measure::Measure;
pub use painted::{Painted, colour_at, painted_sphere};
pub use parameters::{Pair, Parameters};
pub use quantisation::{
    Encoding, GRADIENT_COLUMNS, NK_SCALE, Quantisation, QuantisationRow, Quantised, Storage, quantisation,
};
pub use speed::{
    Bar, BarVerdict, BuildTimes, Elsewhere, ErrorTable, ErrorTableInput, ErrorTableMetal, ErrorTableModel, Errors,
    Instructions, PythonTimes, SpeedEvidence, SpeedOptions, SpeedRow, error_table_input, measured_costs, repeat, speed,
    speed_kernels, speed_summary,
};
pub use spread::{SpreadRow, spread};
pub use stability::{Fineness, StabilityRow, stability, stability_summary};
pub use subject::{Contestants, StudyError, Subject};
pub use summary::{Summary, summaries};
pub use trade::{TradeErrors, TradeOptions, TradeRow, trade, trade_summary};
pub use uniformity::{
    Reach, Slider, SliderSweep, StepRow, UniformityOptions, UniformityRow, uniformity, uniformity_summary,
};
pub use variant::{UnknownVariant, Variant};
