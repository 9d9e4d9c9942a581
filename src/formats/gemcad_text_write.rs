//! Writing GemCad text as GemCad lays it out: CRLF, lines under 80 characters that go on indented, four
//! headers and four footers, fifteen significant digits.

use super::cutting_table::{CuttingRow, at_most, footers, headers, one_line, rows, unblank};
use super::error::FormatError;
use super::frames::{for_gemcad, index_drawn_for};
use super::numbers::decimals;
use super::windows_1252::byte_of;
use crate::design::Design;
use std::fmt::Write;

/// Most bytes of a line, as GemCad breaks its own.
const WIDTH: usize = 79;

/// GemCad reads lines of under 512 bytes; room is left for the line's end.
const LONGEST: usize = 500;

/// Most bytes of a facet's name: with its index it must stand on one line.
const LONGEST_NAME: usize = 60;

/// Header lines, and as many footers.
const LINES: usize = 4;

/// The design as GemCad's text form holds it, its largest coordinate near 1.1.
///
/// - `remarks`: gets a sentence for whatever had no room
///
/// Angles have at least six decimals and distances eight, as GemCad's own, and fifteen significant digits
/// where it takes them: planes come back to rounding. Facets that were not cut by index get the index of their normal, fractional
/// where it must be. Bytes are Windows-1252, or UTF-8 if that cannot hold the texts. Checked in
/// `tests/library/receivers.rs`.
pub fn write(design: &Design, remarks: &mut Vec<String>) -> Result<Vec<u8>, FormatError> {
    let design = &*for_gemcad(design)?;
    let (order, mirror) = design.symmetry.unwrap_or((1, false));
    let mut lines = vec![
        "GemCad 5.0".to_owned(),
        format!("g {} {}", decimals(design.gear.teeth, 0), decimals(design.gear.offset, 1)),
        format!("y {order} {}", if mirror { "y" } else { "n" }),
        format!("I {}", decimals(index_drawn_for(design), 2)),
    ];
    let mut cut_names = Vec::new();
    lines.extend(at_most(LINES, &headers(design)).iter().map(|said| text('H', said, remarks)));
    rows(design).iter().for_each(|row| tier(row, &mut lines, &mut cut_names));
    lines.extend(in_four(&footers(design)).iter().map(|said| text('F', said, remarks)));
    if !cut_names.is_empty() {
        remarks.push(format!("names are cut off after {LONGEST_NAME} bytes: {}", cut_names.join(", ")));
    }
    let all: String = lines.iter().flat_map(|line| [&**line, "\r\n"]).collect();
    let bytes: Option<Vec<u8>> = all.chars().map(byte_of).collect();
    Ok(bytes.unwrap_or_else(|| all.into_bytes()))
}

/// A header or footer.
fn text(letter: char, said: &str, remarks: &mut Vec<String>) -> String {
    let kept = cut_off(said, LONGEST);
    if kept.len() < said.len() {
        remarks.push(format!("a line of the {letter} texts is cut off after {LONGEST} bytes"));
    }
    format!("{letter} {kept}")
}

/// A tier's lines: its indices, then its instructions, on the last of these lines if there is room.
fn tier(row: &CuttingRow, lines: &mut Vec<String>, cut_names: &mut Vec<String>) {
    // for flat facets the sign of the distance tells table from culet
    let culet = row.angle_deg == 0.0 && row.angle_deg.is_sign_negative();
    let distance = if culet { -row.distance } else { row.distance };
    let mut open = format!("a {} {}", decimals(row.angle_deg, 6), decimals(distance, 8));
    for cut in &row.facets {
        let mut item = format!(" {}", decimals(cut.index, 0));
        let words: Vec<&str> = cut.name.split(|c: char| c.is_whitespace() || c.is_control()).collect();
        let name = words.join("-");
        let kept = cut_off(&name, LONGEST_NAME);
        if kept.len() < name.len() {
            cut_names.push(kept.to_owned());
        }
        if !kept.is_empty() {
            let _ = write!(item, " n {kept}"); // a String takes every write
        }
        if open.len() + item.len() > WIDTH {
            lines.push(std::mem::take(&mut open));
        }
        open += &item;
    }
    const G: &str = " G ";
    for said in in_lines(&row.tier.instructions, WIDTH - G.len()) {
        if open.contains(G) || open.len() + G.len() + said.len() > WIDTH {
            lines.push(std::mem::take(&mut open));
        }
        open = open + G + &said;
    }
    lines.push(open);
}

/// The footers in lines of [`WIDTH`], those that are over joined to the last of four.
fn in_four(texts: &[String]) -> Vec<String> {
    let wrapped = |text: &String| match in_lines(text, WIDTH - 2) {
        lines if lines.is_empty() => vec![String::new()],
        lines => lines,
    };
    let lines: Vec<String> = unblank(texts).iter().flat_map(wrapped).collect();
    at_most(LINES, &lines)
}

/// The text's words in lines of at most `most` bytes; a word that is longer has a line of its own.
fn in_lines(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace().map(one_line) {
        match lines.last_mut().filter(|l| l.len() + word.len() < most) {
            Some(line) => *line = format!("{line} {word}"),
            None => lines.push(word),
        }
    }
    lines
}

/// The beginning of the text in at most `most` bytes.
fn cut_off(text: &str, most: usize) -> &str {
    &text[..text.floor_char_boundary(most)]
}
