//! The error of every closed set that is read from text.

use thiserror::Error;

/// A name outside a closed set, with the names that would have been right.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("unknown {kind} “{name}”; one of: {}", allowed.join(", "))]
pub struct UnknownName {
    kind: &'static str,
    name: String,
    allowed: Vec<&'static str>,
}

impl UnknownName {
    /// `kind` is the noun of the set, `allowed` its members.
    pub fn new(kind: &'static str, name: &str, allowed: impl IntoIterator<Item = &'static str>) -> Self {
        Self { kind, name: name.to_owned(), allowed: allowed.into_iter().collect() }
    }
}
