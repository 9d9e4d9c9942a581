//! GemCad ASCII, `.asc`: tiers of angle, distance and gear indices.
//!
//! The grammar is that of the reader which GemCad's author publishes: words, not lines. Only `H`, `F` and `G`
//! run to the end of their line; all else may share a line with others, go on in the next, and stand
//! without a blank between keyword and number. The program's own frame is the y-mirror of ours; with the
//! formula of [`crate::design::tiers::facet_normal`] the stone comes out the right way round. Distances have no unit and the
//! origin is free.

mod parser;
mod rewrite;
mod tier_line;
mod tiers;
mod words;

use super::error::FormatError;
use super::gemcad_text_write::write;
use super::input::{Input, lines};
use super::{Format, Parsed, Writer};
use words::is_keyword_line;

/// GemCad text designs, of every version in circulation.
pub static FORMAT: Format = Format {
    name: "gemcad",
    extensions: &["asc"],
    about: "GemCad text design: tiers by angle, distance and index",
    sniff,
    read,
    write: Some(Writer::Design(write)),
    rewrite: Some(rewrite::rewrite),
};

fn sniff(source: &Input) -> u8 {
    let start = source.beginning();
    let start = start.trim_start();
    if start.get(..6).is_some_and(|s| s.eq_ignore_ascii_case("gemcad")) {
        return 100;
    }
    let tier = |line: &str| line.starts_with('a') && is_keyword_line(line);
    if lines(start).any(|(_, line)| tier(line.trim())) || words::begins(start) { 60 } else { 0 }
}

fn read(source: &Input) -> Result<Parsed, FormatError> {
    parser::parse(source, &source.text())?.design()
}
