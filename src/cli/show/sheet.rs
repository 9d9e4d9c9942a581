//! The lines of a stone's or a mesh's sheet.

use crate::cli::terminal_table;

/// Length of the longest label.
const LABEL: u16 = "critical angle".len() as u16;

/// Labels with their texts, the texts of all sheets below each other.
pub fn text(lines: Vec<(&str, String)>) -> String {
    terminal_table::labelled(lines, 2, LABEL)
}
