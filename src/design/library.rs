//! The library of cuts: the TOML files of `cuts/`, embedded in the binary.

use super::design_file::{DesignFile, DocumentError};
use super::families::FAMILIES;
use super::tiers::Design;
use crate::limits::Limits;
use crate::parse;
use std::collections::BTreeMap;
use std::sync::LazyLock;

include!(concat!(env!("OUT_DIR"), "/embedded_cuts.rs"));

/// The names of all cuts, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    EMBEDDED_CUTS.iter().map(|(name, _)| *name)
}

/// The document of the cut called `name`, or none if there is no such cut.
pub fn document(name: &str) -> Option<Result<DesignFile, DocumentError>> {
    source(name).map(DesignFile::parse)
}

/// The cut called `name` with parameters overridden, or none if there is no such cut.
pub fn design(name: &str, overrides: &BTreeMap<String, f64>) -> Option<Result<Design, DocumentError>> {
    design_within(name, overrides, Limits::default())
}

/// As [`design`], within limits that may be raised.
pub fn design_within(
    name: &str,
    overrides: &BTreeMap<String, f64>,
    limits: Limits,
) -> Option<Result<Design, DocumentError>> {
    Some(document(name)?.and_then(|d| d.design_within(overrides, limits)))
}

/// The design file of the cut called `name`, as it stands in `cuts/`.
pub fn source(name: &str) -> Option<&'static str> {
    EMBEDDED_CUTS.iter().find(|(n, _)| parse::is_name(n, name)).map(|(_, text)| *text)
}

/// The cut that is the family called `family` as it comes, with no parameter changed.
pub fn plain(family: &str) -> Option<&'static str> {
    PLAIN.iter().find(|(own, _)| own == family).map(|(_, name)| *name)
}

/// The families that are cuts as they come, each with its first; found once, as every start asks for all
/// of them.
static PLAIN: LazyLock<Vec<(String, &str)>> = LazyLock::new(|| {
    // the other cuts are long, and are not parsed for this
    let names_family = |text: &str| text.lines().any(|line| line.trim_start().starts_with("family"));
    let of_family = EMBEDDED_CUTS.iter().filter(|(_, text)| names_family(text));
    let plain = of_family.filter_map(|(name, text)| {
        let document = DesignFile::parse(text).ok()?;
        Some((document.family.filter(|_| document.parameters.is_empty())?, *name))
    });
    plain.collect()
});

/// Names that no cut can have: what is asked for, why not, and the cut nearest to it.
const IMPOSSIBLE: &[(&str, &str, &str)] = &[(
    "heart",
    "its cleft is a dent, and a stone is cut by whole planes, which leave none; two convex halves side by side \
     would have a wall between them that light does not see",
    "pear",
)];

/// Why there is no cut of that name, and the nearest that there is.
pub fn impossible(name: &str) -> Option<(&'static str, &'static str)> {
    IMPOSSIBLE.iter().find(|(n, ..)| parse::is_name(n, name)).map(|(_, why, nearest)| (*why, *nearest))
}

/// The cut or family called `name` in any case, as it is written; none if there is none.
pub fn canonical_name(name: &str) -> Option<&'static str> {
    names().chain(FAMILIES.iter().map(|f| f.name)).find(|n| parse::is_name(n, name))
}

/// The cut that is probably meant by `name`, if one is near.
pub fn nearest(name: &str) -> Option<&'static str> {
    parse::nearest_name(name, names())
}
