//! Writing Gem Cut Studio files. All but ASCII is written as character references, so that no
//! reader can take the encoding wrong.

use super::cutting_table::{at_most, footers, headers, one_line, rows};
use super::error::FormatError;
use super::frames::{for_gem_cut_studio, index_drawn_for};
use crate::design::Design;
use crate::geometry::polyhedron::PlaneStatus;
use glam::DVec3;
use std::fmt::Write;

/// The design as Gem Cut Studio holds it, with max(|x|, |y|) = 1 and z from −h to h: normals, depths and
/// corners to the last bit; facets by tier, without names of their own. A design drawn for no index of
/// refraction gets diamond's. Checked in `tests/library/receivers.rs`.
pub fn write(design: &Design, _: &mut Vec<String>) -> Result<Vec<u8>, FormatError> {
    let design = &for_gem_cut_studio(design)?;
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
    let (order, mirror) = design.symmetry.unwrap_or((1, false));
    let mut text = format!(
        "<GemCutStudio version=\"1000\">\n  <index gear=\"{}\" base=\"{}\" symmetry=\"{order}\" mirror=\"{}\" />\n",
        design.gear.teeth,
        design.gear.offset,
        u8::from(mirror),
    );
    for row in rows(design) {
        let polar = if row.angle_deg.is_sign_negative() { 180.0 + row.angle_deg } else { row.angle_deg };
        let name = row.facets.iter().map(|c| c.name).find(|n| !n.is_empty()).unwrap_or(&row.tier.name);
        // a String takes every write, here and below
        let _ = writeln!(
            text,
            "  <tier angle=\"{polar}\" depth=\"{}\" name=\"{}\" instructions=\"{}\" visible=\"true\" guide=\"false\">",
            row.distance,
            quoted(name),
            quoted(&row.tier.instructions),
        );
        for cut in &row.facets {
            let n = cut.plane.normal;
            let index_angle = index_angle(n, polar);
            let _ = writeln!(
                text,
                "    <facet nx=\"{}\" ny=\"{}\" nz=\"{}\" index_angle=\"{index_angle}\">",
                n.x, n.y, n.z
            );
            if let PlaneStatus::Facet(face) = solid.plane_status[cut.number] {
                for &corner in solid.faces[face].corners.iter().rev() {
                    let v = solid.vertices[corner];
                    let _ = writeln!(text, "      <vertex x=\"{}\" y=\"{}\" z=\"{}\" />", v.x, v.y, v.z);
                }
            }
            text += "    </facet>\n";
        }
        text += "  </tier>\n";
    }
    let _ = writeln!(text, "  <render refractive_index=\"{}\" />", index_drawn_for(design));
    text += "  <info";
    for (keys, lines) in [(&HEADERS[..], headers(design)), (&FOOTERS[..], footers(design))] {
        for (key, line) in keys.iter().zip(at_most(keys.len(), &lines)) {
            let _ = write!(text, " {key}=\"{}\"", quoted(&line));
        }
    }
    text += " />\n</GemCutStudio>\n";
    Ok(text.into_bytes())
}

/// The index angle in degrees of a facet with that normal: counted from −y, counter-clockwise on the crown and
/// clockwise on pavilion and girdle.
///
/// - `polar`: the facet's angle from +z
pub fn index_angle(n: DVec3, polar: f64) -> f64 {
    let around = n.y.atan2(n.x).to_degrees();
    if polar < 90.0 { 90.0 + around } else { 270.0 - around }.rem_euclid(360.0)
}

/// The text as an attribute's value.
fn quoted(text: &str) -> String {
    let mut out = String::new();
    for c in one_line(text).chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            ' '..='~' => out.push(c),
            // XML has no place for these two
            '\u{FFFE}' | '\u{FFFF}' => out.push('?'),
            _ => {
                let _ = write!(out, "&#{};", u32::from(c)); // a String takes every write
            }
        }
    }
    out
}

/// Attributes of `info` that are headers and footers, in their order.
pub const HEADERS: [&str; 5] = ["title", "header2", "header3", "author", "date"];

/// As [`HEADERS`].
pub const FOOTERS: [&str; 4] = ["footer1", "footer2", "footer3", "footer4"];
