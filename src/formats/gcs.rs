//! Gem Cut Studio, `.gcs`: XML with tiers of facets by normal, depth and index angle.
//!
//! Normals are the truth; where one is missing it follows from the index angle or the corners, and a depth
//! that is missing from the corners. Indices are computed from the normals: `base`, `symmetry` and `mirror`
//! are the state of the program's window, not of the design. The frame is ours (a chiral design was compared
//! in the program itself; `tests/library/dialects/designs.rs` keeps one). No document type is accepted, so no entity can expand.

mod parser;
mod rewrite;

use super::error::{FormatError, counted};
use super::gcs_write::{FOOTERS, HEADERS, write};
use super::input::Input;
use super::{Format, Parsed, Writer};
use crate::design::Design;
use crate::limits;
use parser::{GcsFile, design_part, document};

/// Gem Cut Studio designs.
pub static FORMAT: Format = Format {
    name: "gem-cut-studio",
    extensions: &["gcs"],
    about: "Gem Cut Studio design: tiers by angle, depth and index",
    sniff: |source| if source.beginning().contains("<GemCutStudio") { 99 } else { 0 },
    read,
    write: Some(Writer::Design(write)),
    rewrite: Some(rewrite::rewrite),
};

fn read(source: &Input) -> Result<Parsed, FormatError> {
    source.is_within(&limits::XML)?;
    let text = source.text();
    let part = design_part(&text);
    let after = text.get(part.end..).unwrap_or_default();
    let document = document(source, &text[part])?;
    let file = GcsFile { source, document: &document };
    let root = document.root_element();
    if root.tag_name().name() != "GemCutStudio" {
        return Err(file.wrong(root, "an element GemCutStudio", root.tag_name().name()));
    }
    let mut reading = design(&file)?;
    if !after.trim().is_empty() {
        reading.warnings.push(format!("{} after the design passed over", counted(after.len(), "byte")));
    }
    Ok(reading)
}

fn design(file: &GcsFile) -> Result<Parsed, FormatError> {
    let root = file.document.root_element();
    let child = |name: &str| root.children().find(|n| n.has_tag_name(name));
    let mut design = Design::new(file.source.stem());
    let mut warnings = Vec::new();
    match child("index").and_then(|index| file.hint(index, "gear")).filter(|teeth| *teeth != 0.0) {
        Some(teeth) => design.gear.teeth = teeth,
        None => warnings.push("no gear is given: 96 teeth assumed".into()),
    }
    let index = child("render").and_then(|render| file.hint(render, "refractive_index"));
    design.refractive_index = index.filter(|n| *n >= 1.0);
    if let Some(info) = child("info") {
        let lines = |keys: &[&str]| {
            let mut lines: Vec<String> =
                keys.iter().map(|k| info.attribute(*k).unwrap_or_default().trim().into()).collect();
            lines.truncate(lines.iter().rposition(|l| !l.is_empty()).map_or(0, |i| i + 1));
            lines
        };
        (design.headers, design.footers) = (lines(&HEADERS), lines(&FOOTERS));
        if let Some(title) = design.headers.first().filter(|h| !h.is_empty()) {
            design.name.clone_from(title);
        }
    }
    let tiers = file.tiers(design.gear, &mut warnings)?;
    design.tiers = tiers.into_iter().map(|t| t.tier).filter(|t| !t.facets.is_empty()).collect();
    Ok(Parsed::new(design, warnings))
}
