//! Writing GemCad text: CRLF, short lines, four headers and four footers, all the digits needed.

use super::cutting_table::{Row, around_origin, at_most, footers, headers, one_line, rows};
use super::error::FormatError;
use super::windows_1252::byte_of;
use crate::cut::Design;
use std::fmt::Write;

/// GemCad reads lines of under 512 characters; room is left for the line's end.
const LONGEST: usize = 500;

/// Header lines, and as many footers.
const LINES: usize = 4;

/// The design as GemCad's text form holds it.
///
/// Angles have six decimals and distances eight, as GemCad's own, or as many more as it takes to
/// come back to the last bit. Facets that were not cut by index get the index of their normal,
/// fractional where it must be. Bytes are Windows-1252, or UTF-8 if that cannot hold the texts.
pub fn write(design: &Design) -> Result<Vec<u8>, FormatError> {
    let design = &*around_origin(design, 0.0)?;
    let mut text = String::from("GemCad 5.0\r\n");
    let mut line = |said: String| {
        text += &said;
        text += "\r\n";
    };
    line(format!("g {} {}", design.gear.teeth, decimals(design.gear.offset, 1)));
    let (order, mirror) = design.symmetry.unwrap_or((1, false));
    line(format!("y {order} {}", if mirror { "y" } else { "n" }));
    if let Some(index) = design.refractive_index {
        line(format!("I {}", decimals(index, 2)));
    }
    at_most(LINES, &headers(design)).iter().for_each(|h| line(format!("H {}", cut_off(h, LONGEST))));
    rows(design).iter().for_each(|row| tier(row, &mut line));
    at_most(LINES, &footers(design)).iter().for_each(|f| line(format!("F {}", cut_off(f, LONGEST))));
    let bytes: Option<Vec<u8>> = text.chars().map(byte_of).collect();
    Ok(bytes.unwrap_or_else(|| text.into_bytes()))
}

/// A tier's own line with its instructions, and lines that continue it for what has no room there.
fn tier(row: &Row, line: &mut impl FnMut(String)) {
    // for flat facets the sign of the distance tells table from culet
    let culet = row.angle_deg == 0.0 && row.angle_deg.is_sign_negative();
    let distance = if culet { -row.distance } else { row.distance };
    let mut open = format!("a {} {}", decimals(row.angle_deg, 6), decimals(distance, 8));
    let said: Vec<&str> = row.tier.instructions.split_whitespace().collect();
    let mut instructions = in_lines(&said, LONGEST / 2).into_iter();
    let mut own = instructions.next().map_or_else(String::new, |said| format!(" G {said}"));
    for cut in &row.cuts {
        let mut item = format!(" {}", decimals(cut.index, 0));
        let name: Vec<&str> = cut.name.split(|c: char| c.is_whitespace() || c.is_control()).collect();
        let name = cut_off(&name.join("-"), LONGEST / 4).to_owned();
        if !name.is_empty() {
            let _ = write!(item, " n {name}"); // a String takes every write
        }
        if open.len() + item.len() + own.len() > LONGEST {
            line(std::mem::take(&mut open) + &std::mem::take(&mut own));
        }
        open += &item;
    }
    line(open + &own);
    instructions.for_each(|said| line(format!(" G {said}")));
}

/// The words in lines of at most `most` bytes.
fn in_lines(words: &[&str], most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words {
        let word = one_line(cut_off(word, most));
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

/// The number with `least` decimals, or with as many as it takes to come back to the last bit.
fn decimals(x: f64, least: usize) -> String {
    let short = format!("{x:.least$}");
    if short.parse() == Ok(x) {
        return short;
    }
    let exact = x.to_string();
    if exact.len() < 40 { exact } else { format!("{x:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_where_they_can_be() {
        assert_eq!(decimals(-42.5, 6), "-42.500000");
        assert_eq!(decimals(-0.0, 6), "-0.000000");
        assert_eq!(decimals(1.0 / 3.0, 6), "0.3333333333333333");
        assert_eq!(decimals(96.0, 0), "96");
        assert_eq!(decimals(2.5, 0), "2.5");
        assert_eq!(decimals(1e-300, 8), "1e-300");
    }
}
