//! The library of cuts: the TOML files of `cuts/`, embedded in the binary.

use super::design::Design;
use super::document::{Document, DocumentError};
use std::collections::BTreeMap;

include!(concat!(env!("OUT_DIR"), "/embedded_cuts.rs"));

/// The names of all cuts, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    EMBEDDED_CUTS.iter().map(|(name, _)| *name)
}

/// The design file of the cut called `name`, as it stands in `cuts/`.
pub fn source(name: &str) -> Option<&'static str> {
    EMBEDDED_CUTS.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// The document of the cut called `name`, or none if there is no such cut.
pub fn document(name: &str) -> Option<Result<Document, DocumentError>> {
    source(name).map(Document::parse)
}

/// The cut called `name` with parameters overridden, or none if there is no such cut.
pub fn design(name: &str, overrides: &BTreeMap<String, f64>) -> Option<Result<Design, DocumentError>> {
    Some(document(name)?.and_then(|d| d.design(overrides)))
}

/// Names that no cut can have: what is asked for, why not, and the cut nearest to it.
const IMPOSSIBLE: &[(&str, &str, &str)] = &[(
    "heart",
    "its cleft is a dent, and a stone is cut by whole planes, which leave none; two convex halves side by side \
     would have a wall between them that light does not see",
    "pear",
)];

/// Why there is no cut of that name, and the nearest that there is.
pub fn impossible(name: &str) -> Option<(&'static str, &'static str)> {
    IMPOSSIBLE.iter().find(|(n, ..)| *n == name).map(|(_, why, nearest)| (*why, *nearest))
}

/// The cut's name most like `name`.
pub fn nearest(name: &str) -> &'static str {
    let distance = |n: &&str| (1e6 * (1.0 - strsim::jaro_winkler(n, name))) as u64;
    names().min_by_key(distance).unwrap_or_default()
}
