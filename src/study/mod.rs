//! The paper's evidence, measured: what each model costs in accuracy and robustness.
