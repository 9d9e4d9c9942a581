//! cutlab's own TOML form, which keeps everything a design knows; see [`crate::design::design_file`].

pub mod rewrite;
mod tier_place;

use super::error::{FormatError, quoted_excerpt};
use super::input::{Input, lines};
use super::{Format, Parsed, Writer};
use crate::design::Design;
use crate::design::design_file::{DesignFile, DocumentError};
use crate::limits;
use crate::parse::plain;
use crate::storage::text;
use std::collections::BTreeMap;

/// Design files as in `cuts/`.
pub static FORMAT: Format = Format {
    name: "cutlab",
    extensions: &["toml"],
    about: "cutlab's own design file: tiers, or a family and its parameters",
    sniff,
    read,
    write: Some(Writer::Design(write)),
    rewrite: Some(rewrite::rewrite),
};

fn sniff(source: &Input) -> u8 {
    let start = source.beginning();
    let said = lines(&start).map(|(_, l)| l.trim()).find(|l| !l.is_empty() && !l.starts_with('#'));
    let key = |line: &str| {
        let key = line.split_once('=')?.0.trim_end();
        key.chars().all(|c| c.is_ascii_alphanumeric() || "-_.\"".contains(c)).then_some(key.len())
    };
    match said {
        Some(line) if line.starts_with("[[tier]]") || line.starts_with("[parameters]") => 90,
        Some(line) if key(line).is_some_and(|n| n > 0) => 80,
        _ => 0,
    }
}

/// Whether TOML is meant as a design, whatever is wrong with it: it has tiers or a family. A scene, or
/// another program's settings, has neither.
pub fn looks_like_cutlab_toml(source: &Input) -> bool {
    const KEYS: [&str; 2] = ["tier", "family"];
    let text = text::decode_lines(source.bytes);
    match toml::from_str::<toml::Table>(&text) {
        Ok(table) => KEYS.iter().any(|key| table.contains_key(*key)),
        Err(_) => lines(&text).any(|(_, line)| {
            let word = line.trim().trim_start_matches('[');
            KEYS.iter().any(|key| word.split([']', '=', ' ']).next() == Some(key))
        }),
    }
}

fn read(source: &Input) -> Result<Parsed, FormatError> {
    source.is_within(&limits::TOML_DESIGN)?;
    let text = text::decode_lines(source.bytes);
    let mut design = document(source, &text)?
        .design_within(&BTreeMap::new(), source.limits)
        .map_err(|cause| FormatError::Cut { file: source.name.into(), cause })?;
    if design.name.is_empty() {
        design.name = source.stem();
    }
    Ok(Parsed::new(design, Vec::new()))
}

/// The document; TOML's own several-line complaint is brought into one line.
fn document(source: &Input, text: &str) -> Result<DesignFile, FormatError> {
    DesignFile::parse(text).map_err(|error| match error {
        DocumentError::Syntax(syntax) => {
            let at = syntax.span().map_or(0, |s| s.start).min(text.len());
            let before = text.as_bytes()[..at].iter().filter(|&&b| b == b'\n').count();
            let found = text.lines().nth(before).unwrap_or_default().trim();
            FormatError::Line {
                file: source.name.into(),
                line: before + 1,
                expected: format!("a design ({})", plain::toml(syntax.message(), found)),
                found: quoted_excerpt(found),
            }
        }
        cause => FormatError::Cut { file: source.name.into(), cause },
    })
}

fn write(design: &Design, _: &mut Vec<String>) -> Result<Vec<u8>, FormatError> {
    Ok(DesignFile::from_design(design).to_toml().into_bytes())
}
