//! The data set as a plain list: corners, then faces of three or more corner numbers from 0 or 1.
//!
//! Rows may begin with `v` and `f` or not; lines of counts before the rows are passed over.

use super::PolygonShapes;
use crate::formats::error::FormatError;
use crate::formats::input::{Input, lines, number, without_comment};
use crate::formats::mesh_import::Digits;
use crate::geometry::facet_recovery::Polygon;
use crate::limits;
use glam::DVec3;

/// One row: its line, its letter if any, its numbers, and whether all are written as whole ones.
struct ListRow {
    line: usize,
    letter: Option<char>,
    numbers: Vec<f64>,
    whole: bool,
    digits: Digits,
}

/// How surely this is such a list: surely for `v` and `f` rows that count from 0, which OBJ cannot;
/// faintly for bare numbers.
pub fn sniff(source: &Input) -> u8 {
    let start = source.beginning();
    let mut rows = lines(&start).filter_map(|(at, line)| row(at, line)).take(8).peekable();
    if rows.peek().is_none() || rows.any(|r| r.is_none()) {
        return 0;
    }
    let text = source.text();
    let counts_from_0 = |line: &str| line.starts_with('f') && line.split_whitespace().any(|w| w == "0");
    if lines(&text).any(|(_, line)| counts_from_0(line)) { 70 } else { 20 }
}

/// The row on a line: none for an empty line, none within for one that is no row.
fn row(line: usize, text: &str) -> Option<Option<ListRow>> {
    let said = without_comment(text);
    let mut words = said.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty()).peekable();
    let letter = match *words.peek()? {
        "v" | "vertex" => Some('v'),
        "f" | "face" => Some('f'),
        _ => None,
    };
    if letter.is_some() {
        words.next();
    }
    let (mut numbers, mut whole, mut digits) = (Vec::new(), true, Digits::TEXT);
    for word in words {
        match number(word) {
            Some(x) => numbers.push(x),
            None => return Some(None),
        }
        digits.see(word);
        whole &= word.bytes().all(|b| b.is_ascii_digit());
    }
    Some(Some(ListRow { line, letter, numbers, whole, digits }))
}

/// The mesh of the list.
pub fn mesh(source: &Input) -> Result<PolygonShapes, FormatError> {
    let text = source.text();
    let mut rows = Vec::new();
    for (at, line) in lines(&text) {
        match row(at, line) {
            None => {}
            Some(Some(row)) => {
                rows.push(row);
                source.within_at(at, &limits::CORNERS, rows.len())?;
            }
            Some(None) => return Err(source.at_line(at, "a row of numbers, 'v …' or 'f …'", line.trim())),
        }
    }
    // without letters, the faces are the rows of whole numbers at the end
    let bare_faces = rows.iter().rev().take_while(|r| r.whole && r.letter.is_none()).count();
    let first_face = rows.len() - bare_faces;
    let (mut vertices, mut faces, mut digits) = (Vec::new(), Vec::new(), Digits::TEXT);
    for (i, row) in rows.iter().enumerate() {
        let face = row.letter == Some('f') || (row.letter.is_none() && i >= first_face);
        match (face, row.numbers.len()) {
            (false, 3) => {
                vertices.push(DVec3::from_slice(&row.numbers));
                digits = digits.or(row.digits);
            }
            (true, 3..) if row.whole => {
                faces.push(row);
                source.within_at(row.line, &limits::POLYGONS, faces.len())?;
            }
            (_, 0..=2) if row.whole && row.letter.is_none() => {} // counts
            (false, n) => return Err(source.at_line(row.line, "three coordinates", &format!("{n} numbers"))),
            (true, n) => {
                return Err(source.at_line(
                    row.line,
                    "three or more corner numbers",
                    &format!("{n} numbers"),
                ));
            }
        }
    }
    if vertices.is_empty() || faces.is_empty() {
        let found = format!("{} corners and {} faces", vertices.len(), faces.len());
        return Err(source.at_line(rows.last().map_or(1, |r| r.line), "corners, then faces", &found));
    }
    let from_0 = faces.iter().any(|f| f.numbers.contains(&0.0));
    let base = if from_0 { 0.0 } else { 1.0 };
    let mut polygons = Vec::with_capacity(faces.len());
    for face in faces {
        let mut corners = Vec::with_capacity(face.numbers.len());
        for &n in &face.numbers {
            if n - base >= vertices.len() as f64 {
                let expected = format!("corners from {base} to {}", vertices.len() as f64 + base - 1.0);
                return Err(source.at_line(face.line, expected, &n.to_string()));
            }
            corners.push((n - base) as usize);
        }
        polygons.push(Polygon { corners, ..Polygon::default() });
    }
    Ok((vec![(vertices, polygons)], digits))
}
