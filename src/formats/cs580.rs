//! CS580 triangle list, `.asc`: per corner place, normal and texture coordinates.
//!
//! A word `triangle…`, then three times `x y z nx ny nz u v`; line ends are often lone CR, and some
//! files hold a line `object`. The normals are for shading and not used.

use super::asc_triangles::{first_count, records};
use super::error::FormatError;
use super::input::Input;
use super::mesh_import::{PolygonMesh, stone_from_mesh};
use super::{Format, MeshExport, Parsed, Writer};
use crate::geometry::facet_recovery::Polygon;
use glam::DVec3;
use std::fmt::Write;

/// Triangle lists with 24 numbers a triangle.
pub static FORMAT: Format = Format {
    name: "cs580",
    extensions: &["asc"],
    about: "CS580 triangle list: place, normal and texture of each corner; written for `--to cs580`",
    sniff: |source| if first_count(source) == Some(24) { 90 } else { 0 },
    read,
    write: Some(Writer::Mesh(write)),
    rewrite: None,
};

fn read(source: &Input) -> Result<Parsed, FormatError> {
    let text = source.text();
    let mut vertices = Vec::new();
    let mut polygons = Vec::new();
    let records = records(source, &text)?;
    for record in &records.all {
        if record.numbers.len() != 24 {
            let found = format!("{} numbers", record.numbers.len());
            return Err(source.at_line(record.line, "24 numbers after 'triangle'", &found));
        }
        let first = vertices.len();
        vertices.extend(record.numbers.chunks_exact(8).map(|c| DVec3::new(c[0], c[1], c[2])));
        polygons.push(Polygon { corners: (first..first + 3).collect(), ..Polygon::default() });
    }
    stone_from_mesh(source, &PolygonMesh::from_text(vertices, polygons, records.digits))
}

/// Every triangle with its facet's normal at all three corners, without texture.
fn write(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
    let mut text = String::new();
    for (facet, triangle) in &surface.triangles {
        let n = surface.facets[*facet].1;
        text += "triangle\n";
        for v in triangle.map(|corner| surface.vertices[corner]) {
            // a String takes every write
            let _ = writeln!(text, "{} {} {} {} {} {} 0 0", v.x, v.y, v.z, n.x, n.y, n.z);
        }
    }
    Ok(text.into_bytes())
}
