//! Writing GemCad text as GemCad lays it out: CRLF, lines under 80 characters that go on indented, four
//! headers and four footers, ten significant digits.

use super::cutting_table::{CuttingRow, at_most, footers, headers, one_line, rows, unblank};
use super::error::FormatError;
use super::frames::{for_gemcad, index_drawn_for};
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

/// Significant digits of a number: two more than GemCad's own distances have.
const DIGITS: i32 = 10;

/// The design as GemCad's text form holds it, its largest coordinate near 1.1.
///
/// - `remarks`: gets a sentence for whatever had no room
///
/// Angles have at least six decimals and distances eight, as GemCad's own, and ten significant digits
/// where it takes them. Facets that were not cut by index get the index of their normal, fractional
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

/// The number with `least` decimals, or with more if it takes them for [`DIGITS`] significant digits.
fn decimals(x: f64, least: usize) -> String {
    let magnitude = if x == 0.0 { 0 } else { x.abs().log10().floor() as i32 };
    let most = (DIGITS - 1 - magnitude).clamp(least as i32, 17) as usize;
    let mut text = format!("{x:.most$}");
    let spare = text.bytes().rev().take(most - least).take_while(|b| *b == b'0').count();
    text.truncate(text.len() - spare);
    if text.ends_with('.') {
        text.pop();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_they_need_and_no_more_than_ten() {
        assert_eq!(decimals(-42.5, 6), "-42.500000");
        assert_eq!(decimals(-0.0, 6), "-0.000000");
        assert_eq!(decimals(1.0 / 3.0, 6), "0.3333333333");
        assert_eq!(decimals(0.8814711600000001, 8), "0.88147116");
        assert_eq!(decimals(-42.01339541369781, 6), "-42.01339541");
        assert_eq!(decimals(96.0, 0), "96");
        assert_eq!(decimals(2.5, 0), "2.5");
        assert_eq!(decimals(14.523285922140165, 0), "14.52328592");
        assert_eq!(decimals(1.54, 2), "1.54");
        assert_eq!(decimals(0.001234567890123, 8), "0.00123456789");
    }
}
