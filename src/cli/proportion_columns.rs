//! Columns of a table of scores that say what each stone is: name, proportions and weight.

use super::console::Console;
use super::scoring::{self, Scoring};
use super::stones;
use crate::cut::{Unit, proportions};
use crate::optics::weight::Weight;
use crate::study::table::Cell;
use std::ffi::OsStr;

/// The columns: percentages of the girdle width, degrees, and the weight where the stone's size is known.
pub const COLUMNS: [&str; 12] = [
    "name",
    "width_mm",
    "length_to_width",
    "table_percent",
    "crown_angle_deg",
    "crown_height_percent",
    "pavilion_angle_deg",
    "pavilion_depth_percent",
    "girdle_percent",
    "depth_percent",
    "carats",
    "weighed_as",
];

/// The cells of [`COLUMNS`]; empty where the stone is none, or has no such measure.
pub fn cells(spec: &OsStr, scoring: &Scoring, console: &Console) -> Vec<Cell> {
    of(spec, scoring, console).unwrap_or_else(|| vec![Cell::Empty(()); COLUMNS.len()])
}

fn of(spec: &OsStr, scoring: &Scoring, console: &Console) -> Option<Vec<Cell>> {
    let design = stones::open(spec).ok()?.design;
    let material = scoring.substance.within(spec).ok()?.of(&design);
    let p = proportions::of(&design).ok()?;
    let to_mm = scoring.size.map(|mm| mm / p.width).or((design.unit == Unit::Millimetre).then_some(1.0));
    let weight = Weight::of(&material);
    let carats = to_mm.and_then(|k| weight.carats(p.volume * k.powi(3)));
    if to_mm.is_some()
        && let Some(note) = weight.note()
    {
        scoring::once(&format!("weight of {}: {note}", stones::shown(spec)), &note, console);
    }
    let number = |x: Option<f64>| x.map_or(Cell::Empty(()), Cell::number);
    Some(vec![
        design.name.as_str().into(),
        number(to_mm.map(|k| p.width * k)),
        Cell::number(p.length / p.width),
        number(p.table_percent),
        number(p.crown_angle_deg),
        Cell::number(p.crown_height_percent),
        number(p.pavilion_angle_deg),
        Cell::number(p.pavilion_depth_percent),
        Cell::number(p.girdle_percent),
        Cell::number(p.depth_percent),
        number(carats),
        carats.and(weight.name()).as_deref().into(),
    ])
}
