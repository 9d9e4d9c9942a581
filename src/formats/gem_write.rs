//! Writing GemCad binary files: planes, names, polygons, then gear, index and texts.

use super::cutting_table::{around_origin, at_most, footers, headers, one_line, rows};
use super::error::FormatError;
use super::gem::{END_OF_FACETS, LINES, OFFSET_FOLLOWS};
use super::windows_1252::encoded;
use crate::cut::Design;
use crate::optics::materials::MATERIALS;
use crate::solid::polyhedron::Fate;
use glam::DVec3;

/// A plane nearer to the origin than this part of the farthest has no place in the format, which
/// stores 1/distance; the origin is moved then.
const NEAREST: f64 = 1e-6;

/// The design as GemCad's binary form holds it: planes to the last bit or so. A design drawn for no
/// index of refraction gets diamond's.
pub fn write(design: &Design) -> Result<Vec<u8>, FormatError> {
    let design = &*around_origin(design, NEAREST)?;
    let unfit = |problem: String| FormatError::Encode {
        name: design.name.clone(),
        format: super::gem::FORMAT.name,
        problem,
    };
    let teeth = design.gear.teeth;
    if teeth.fract() != 0.0 || teeth.abs() > f64::from(i32::MAX) {
        return Err(unfit(format!("its gear has {teeth} teeth, and the format has room for whole ones")));
    }
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
    let mut bytes = Vec::new();
    for (tier, row) in rows(design).iter().enumerate() {
        for cut in &row.cuts {
            bytes.extend(point(cut.plane.normal / cut.plane.distance));
            bytes.extend((tier as i32 + 1).to_le_bytes());
            let name = one_line(cut.name);
            text(&mut bytes, &format!("{name}\t{}", one_line(&row.tier.instructions)));
            if let Fate::Facet(face) = solid.fates[cut.number] {
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
    bytes.extend(design.refractive_index.unwrap_or_else(|| MATERIALS[0].index_d()).to_le_bytes());
    bytes.extend(OFFSET_FOLLOWS.to_le_bytes());
    bytes.extend(design.gear.offset.to_le_bytes());
    for lines in [headers(design), footers(design)] {
        let lines = at_most(LINES, &lines);
        (0..LINES).for_each(|i| text(&mut bytes, lines.get(i).map_or("", String::as_str)));
    }
    Ok(bytes)
}

/// A point in GemCad's frame.
fn point(p: DVec3) -> impl Iterator<Item = u8> {
    [p.x, -p.y, p.z].into_iter().flat_map(f64::to_le_bytes)
}

/// A text after its length; what does not fit into 255 bytes is cut off.
fn text(bytes: &mut Vec<u8>, text: &str) {
    let mut said = encoded(text);
    said.truncate(u8::MAX.into());
    bytes.push(said.len() as u8);
    bytes.extend(said);
}
