//! Writing GemCad binary files: planes, names, polygons, then gear, index and texts.

use super::cutting_table::{at_most, footers, headers, one_line, rows};
use super::error::FormatError;
use super::frames::{for_gemcad, index_drawn_for};
use super::windows_1252::{byte_of, encoded};
use crate::design::Design;
use crate::geometry::polyhedron::PlaneStatus;
use glam::DVec3;

/// Most bytes of a facet's name, a tab and its instructions together that GemCad's author's reader takes.
const FACET_TEXT: usize = 79;

/// Most bytes of every other text, whose length is stored in one byte.
const TEXT: usize = u8::MAX as usize;

/// The design as GemCad's binary form holds it, its largest coordinate near 1.1: planes to the last bit
/// or so. A design drawn for no index of refraction gets diamond's.
///
/// - `remarks`: gets a sentence for whatever had no room
///
/// Checked in `tests/library/receivers.rs`.
pub fn write(design: &Design, remarks: &mut Vec<String>) -> Result<Vec<u8>, FormatError> {
    let design = &*for_gemcad(design)?;
    let unfit = |problem: String| FormatError::Encode { name: design.name.clone(), format: NAME, problem };
    let teeth = design.gear.teeth;
    if teeth.fract() != 0.0 || teeth.abs() > f64::from(i32::MAX) {
        return Err(unfit(format!("its gear has {teeth} teeth, and the format has room for whole ones")));
    }
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
    let mut bytes = Vec::new();
    let mut shortened: Vec<String> = Vec::new();
    for (tier, row) in rows(design).iter().enumerate() {
        for cut in &row.facets {
            bytes.extend(point(cut.plane.normal / cut.plane.distance));
            bytes.extend((tier as i32 + 1).to_le_bytes());
            let said = format!("{}\t{}", one_line(cut.name), one_line(&row.tier.instructions));
            if !text(&mut bytes, &said, FACET_TEXT) {
                let name =
                    if row.tier.name.is_empty() { (tier + 1).to_string() } else { one_line(&row.tier.name) };
                shortened.push(format!("'{name}'"));
            }
            if let PlaneStatus::Facet(face) = solid.plane_status[cut.number] {
                for corner in solid.polygon(face) {
                    bytes.extend(1i32.to_le_bytes());
                    bytes.extend(point(corner));
                }
            }
            bytes.extend(0i32.to_le_bytes());
        }
    }
    bytes.extend(END_OF_FACETS.to_le_bytes());
    let (order, mirror) = design.symmetry.unwrap_or((1, false));
    for value in [order as i32, i32::from(mirror), teeth as i32] {
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend(index_drawn_for(design).to_le_bytes());
    bytes.extend(OFFSET_FOLLOWS.to_le_bytes());
    bytes.extend(design.gear.offset.to_le_bytes());
    let mut whole = true;
    for lines in [headers(design), footers(design)] {
        let lines = at_most(LINES, &lines);
        (0..LINES).for_each(|i| whole &= text(&mut bytes, lines.get(i).map_or("", String::as_str), TEXT));
    }
    shortened.dedup();
    if !shortened.is_empty() {
        remarks.push(format!(
            "instructions are shortened to the {FACET_TEXT} bytes that GemCad takes with the facet's name: tier {}",
            shortened.join(", ")
        ));
    }
    let texts = headers(design).into_iter().chain(footers(design));
    let texts = texts.chain(design.tiers.iter().flat_map(|t| [t.name.clone(), t.instructions.clone()]));
    if texts.flat_map(|t| t.chars().collect::<Vec<_>>()).any(|c| byte_of(c).is_none()) {
        remarks.push("letters that Windows-1252 does not have are written as '?'".into());
    }
    if !whole {
        remarks.push(format!("headers or footnotes are cut off after {TEXT} bytes"));
    }
    Ok(bytes)
}

/// A point in GemCad's frame.
pub fn point(p: DVec3) -> impl Iterator<Item = u8> {
    [p.x, -p.y, p.z].into_iter().flat_map(f64::to_le_bytes)
}

/// A text after its length; what does not fit into `most` bytes is cut off, after a word if it can be.
/// Whether it did fit.
fn text(bytes: &mut Vec<u8>, text: &str, most: usize) -> bool {
    let mut said = encoded(text);
    let fits = said.len() <= most;
    if !fits {
        let word_ends = said[most] == b' ';
        said.truncate(most);
        let name_ends = said.iter().position(|b| *b == b'\t').unwrap_or(0);
        if let Some(end) = said.iter().rposition(|b| *b == b' ').filter(|end| !word_ends && *end > name_ends)
        {
            said.truncate(end);
        }
    }
    bytes.push(said.len() as u8);
    bytes.extend(said);
    fits
}

/// Stands where the next facet's plane would.
pub const END_OF_FACETS: f64 = -99999.0;

/// Says that the gear's offset follows the refractive index.
pub const OFFSET_FOLLOWS: u32 = 0x7FFF;

/// Header lines, and as many footers.
pub const LINES: usize = 4;

/// The format's name.
pub const NAME: &str = "gemcad-binary";
