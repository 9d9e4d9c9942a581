//! Columns of a table of scores that say what each stone is: name, proportions and weight.

use super::row_maker::RowMaker;
use super::table::TableCell;
use crate::design::proportion_catalogue::NamedProportion;
use crate::design::{LengthUnit, proportions};
use crate::materials::weight::Weight;
use crate::stone::{Stone, StoneOptions};
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
pub fn cells(spec: &OsStr, options: &StoneOptions, maker: &RowMaker) -> Vec<TableCell> {
    measured_cells(spec, options, maker).unwrap_or_else(|| vec![TableCell::Empty(()); COLUMNS.len()])
}

fn measured_cells(spec: &OsStr, options: &StoneOptions, maker: &RowMaker) -> Option<Vec<TableCell>> {
    let stone = Stone::open(spec, &options.without_size()).ok()?;
    let design = stone.design()?;
    let p = proportions::of_design(design).ok()?;
    let to_mm =
        options.size_mm.map(|mm| mm / p.width).or((design.unit == LengthUnit::Millimetre).then_some(1.0));
    let weight = Weight::new(stone.material());
    let carats = to_mm.and_then(|k| weight.carats(p.volume * k.powi(3)));
    if to_mm.is_some()
        && let Some(note) = weight.note()
    {
        let said = format!("weight of {}: {note}", stone.name());
        maker.said.note_of_one(maker.progress, &said, &note);
    }
    let number = |x: Option<f64>| x.map_or(TableCell::Empty(()), TableCell::number);
    let proportions = COLUMNS.iter().filter_map(|name| NamedProportion::by_name(name));
    let mut cells: Vec<TableCell> = vec![design.name.as_str().into(), number(to_mm.map(|k| p.width * k))];
    cells.extend(proportions.map(|proportion| number((proportion.of)(&p))));
    cells.extend([number(carats), carats.and(weight.name()).as_deref().into()]);
    Some(cells)
}
