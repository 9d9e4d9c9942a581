//! The designs that a page of an optimisation shows, each with its name, its stone and what changed.

use crate::design::edit::{DesignChanges, Editor};
use crate::optimise::{Finalist, Optimised};
use crate::report::stone_report::ReportError;
use crate::stone::Stone;

/// The most designs that a page shows.
pub(super) const MOST: usize = 8;

/// A design that was kept.
pub(super) struct KeptDesign<'a> {
    /// Its number from 1, or `best` where it is the only one.
    pub mark: String,
    /// Number and file, which stand above its column of a table.
    pub label: String,
    /// Its file, beside the page; none if it was not written.
    pub file: Option<&'a str>,
    /// What the search found of it.
    pub finalist: &'a Finalist,
    /// The stone, as wide as candidates were scored.
    pub stone: Stone,
    /// Tiers and proportions before and after.
    pub changes: DesignChanges,
}

/// The designs that are shown: the first [`MOST`].
///
/// - `stone`, `editor`: as it was; `width_mm`: girdle width
/// - `files`: of the designs in their order
pub(super) fn kept<'a>(
    stone: &Stone,
    editor: &Editor,
    found: &'a Optimised,
    files: &'a [String],
    width_mm: f64,
) -> Result<Vec<KeptDesign<'a>>, ReportError> {
    let only = found.finalists.len() == 1;
    let design = |(i, finalist): (usize, &'a Finalist)| {
        let mark = if only { "best".to_owned() } else { (i + 1).to_string() };
        let file = files.get(i).map(String::as_str);
        let label = match file {
            Some(file) if only => file.to_owned(),
            Some(file) => format!("{mark}: {file}"),
            None if only => mark.clone(),
            None => format!("design {mark}"),
        };
        let stone = stone.clone().with_design(finalist.edited.design.clone())?.with_width(width_mm)?;
        let changes = DesignChanges::new(editor, &finalist.edited);
        Ok(KeptDesign { mark, label, file, finalist, stone, changes })
    };
    found.finalists.iter().take(MOST).enumerate().map(design).collect()
}
