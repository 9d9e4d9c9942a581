//! SC_Tracer triangle list, `.asc`: the format that the original renderer's diamond is in.
//!
//! `triangle`, three places, colour, emission, then a token of the surface's kind (`T` transparent,
//! `D` diffuse, `S`, `G`). Files without token, without emission, or without either exist. They are
//! whole scenes: the stone is what is transparent, or, where no triangle has a token, what does
//! not shine.

use super::asc_triangles::{TriangleRecords, first_count, records};
use super::error::FormatError;
use super::input::Input;
use super::mesh_import::{PolygonMesh, stone_from_mesh};
use super::{Format, MeshExport, Parsed, Writer};
use crate::geometry::facet_recovery::Polygon;
use glam::DVec3;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Triangle lists with 15 numbers a triangle, or 12.
pub static FORMAT: Format = Format {
    name: "sc-tracer",
    extensions: &["asc"],
    about: "SC_Tracer scene: the transparent triangles are the stone; written for `--to sc-tracer`",
    sniff: |source| match first_count(source) {
        Some(15 | 12) => 90,
        Some(24) | None => 0,
        Some(_) => 70,
    },
    read,
    write: Some(Writer::Mesh(write)),
    rewrite: None,
};

fn read(source: &Input) -> Result<Parsed, FormatError> {
    let text = source.text();
    let (mut vertices, mut polygons) = (Vec::new(), Vec::new());
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    let TriangleRecords { all, digits } = records(source, &text)?;
    let with_kind = all.iter().any(|r| !r.after.is_empty());
    for record in &all {
        let n = &record.numbers;
        if !matches!(n.len(), 12 | 15) {
            let expected = "9 coordinates, 3 of colour and maybe 3 of emission";
            return Err(source.at_line(record.line, expected, &format!("{} numbers", n.len())));
        }
        let kind = match record.after.as_slice() {
            [] => "none",
            [kind @ ("T" | "D" | "S" | "G")] => kind,
            [other, ..] => {
                return Err(source.at_line(record.line, "one of T, D, S, G after the numbers", other));
            }
        };
        *kinds.entry(kind.into()).or_default() += 1;
        let shines = n.iter().skip(12).any(|&e| e != 0.0);
        if if with_kind { kind == "T" } else { !shines } {
            let first = vertices.len();
            vertices.extend(n[..9].chunks_exact(3).map(DVec3::from_slice));
            polygons.push(Polygon { corners: (first..first + 3).collect(), ..Polygon::default() });
        }
    }
    if polygons.is_empty() {
        let found: Vec<_> = kinds.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
        return Err(source.at_line(1, "triangles of kind T, the stone", &found.join(", ")));
    }
    let others = all.len() - polygons.len();
    let mut reading = stone_from_mesh(source, &PolygonMesh::from_text(vertices, polygons, digits))?;
    if others > 0 {
        reading.warnings.push(format!("{others} triangles of room and lights left out"));
    }
    Ok(reading)
}

/// The stone as transparent triangles of the original renderer's colour, in the full form.
fn write(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
    let mut text = String::new();
    for (_, triangle) in &surface.triangles {
        let mut start = "triangle ";
        for v in triangle.map(|corner| surface.vertices[corner]) {
            let _ = writeln!(text, "{start}{} {} {}", v.x, v.y, v.z); // a String takes every write
            start = "";
        }
        text += "0.900000 0.900000 0.900000\n0.000000 0.000000 0.000000\nT\n";
    }
    Ok(text.into_bytes())
}
