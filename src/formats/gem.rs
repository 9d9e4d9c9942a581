//! GemCad binary, `.gem`: facet planes, names and polygons, little-endian and without magic number.
//!
//! A plane is the point p with p·x = 1 on the facet, in GemCad's own frame, the y-mirror of ours.
//! The stored polygons are for drawing (their winding is mixed) and not used. As nothing marks such
//! a file, its facets tell it: normals and distances that a stone may have, and names that are text. What
//! follows the facets may be missing or break off at any place, as in old files, and anything may follow it.

mod records;
mod rewrite;
mod tiers;

use super::error::FormatError;
use super::gem_write::{LINES, NAME, write};
use super::input::Input;
use super::{Format, Parsed, Writer};
use crate::design::Design;
use records::ByteReader;
use tiers::GroupedFacets;

/// GemCad binary designs.
pub static FORMAT: Format = Format {
    name: NAME,
    extensions: &["gem"],
    about: "GemCad binary design: tiers by angle, distance and index",
    sniff,
    read,
    write: Some(Writer::Design(write)),
    rewrite: Some(rewrite::rewrite),
};

fn sniff(source: &Input) -> u8 {
    match ByteReader::new(source).design() {
        Ok(raw) if !raw.facets.is_empty() => 96,
        // breaks off after good facets
        Err(_) if matches!(ByteReader::new(source).facet(), Ok(Some(_))) => 40,
        // the extension is all there is to go by: worth a complaint that says where it breaks off
        _ => u8::from(source.extension() == "gem" && source.is_binary()),
    }
}

fn read(source: &Input) -> Result<Parsed, FormatError> {
    let mut raw = ByteReader::new(source).design()?;
    if raw.facets.is_empty() {
        return Err(source.at_byte(0, "at least one facet", "the end of facets"));
    }
    let mut warnings = std::mem::take(&mut raw.remarks);
    let mut design = Design::new(source.stem());
    let lines = |range: std::ops::Range<usize>| {
        let lines = raw.lines.get(range.start.min(raw.lines.len())..range.end.min(raw.lines.len()));
        let lines = lines.unwrap_or_default();
        let last = lines.iter().rposition(|l| !l.trim().is_empty()).map_or(0, |i| i + 1);
        lines[..last].iter().map(|l| l.trim().to_owned()).collect::<Vec<_>>()
    };
    design.headers = lines(0..LINES);
    design.footers = lines(LINES..2 * LINES);
    if let Some(title) = design.headers.iter().find(|h| !h.is_empty()) {
        design.name = title.clone();
    }
    match raw.gear() {
        Some(gear) => design.gear = gear,
        None => warnings.push("no gear is given: 96 teeth assumed".into()),
    }
    let symmetry = raw.symmetry.and_then(|(order, mirror)| Some((u32::try_from(order).ok()?, mirror != 0)));
    design.symmetry = symmetry;
    if let Some(index) = raw.refractive_index.filter(|n| !(*n > 1.0 && *n <= 3.5)) {
        let done = if index >= 1.0 && index.is_finite() { "kept" } else { "left out" };
        warnings.push(format!("index of refraction {index:.4e} is not that of any gem; {done}"));
    }
    design.refractive_index = raw.refractive_index.filter(|n| *n >= 1.0 && n.is_finite());
    design.tiers = GroupedFacets::new(&raw.facets, design.gear).tiers;
    Ok(Parsed::new(design, warnings))
}
