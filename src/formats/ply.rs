//! PLY: polygons as text or binary in either byte order; written with `f64` corners and the facets'
//! normals, their names in comments.
//!
//! Own reader: the crates for it read a whole file into maps of values, several times its size.

mod header;
mod values;

use super::error::FormatError;
use super::input::Input;
use super::mesh_import::{Digits, PolygonMesh, stone_from_mesh};
use super::{Format, MeshExport, Parsed, Writer};
use crate::geometry::facet_recovery::Polygon;
use crate::limits;
use glam::DVec3;
use header::{Header, PlyElement, PlyScalar, Property};
use std::borrow::Cow;
use std::fmt::Write;
use std::sync::Arc;
use values::PlyValues;

/// Binary PLY.
pub static BINARY: Format = Format {
    name: "ply",
    extensions: &["ply"],
    about: "PLY mesh in binary: written with f64 corners and facets' normals",
    sniff: |source| if header::begins(source) { 97 } else { 0 },
    read,
    write: Some(Writer::Mesh(write_binary)),
    rewrite: None,
};

/// Text PLY.
pub static TEXT: Format = Format {
    name: "ply-text",
    extensions: &["ply"],
    about: "PLY mesh as text: facets' normals; written for `--to ply-text`",
    sniff: |source| if header::begins(source) && header::says_text(source) { 98 } else { 0 },
    read,
    write: Some(Writer::Mesh(write_text)),
    rewrite: None,
};

fn read(source: &Input) -> Result<Parsed, FormatError> {
    stone_from_mesh(source, &mesh(source)?)
}

/// Whether the file begins as a PLY file does.
pub(super) fn is_one(source: &Input) -> bool {
    header::begins(source)
}

/// The mesh as it stands in the file.
pub(super) fn mesh(source: &Input) -> Result<PolygonMesh, FormatError> {
    let text = if header::says_text(source) { source.text() } else { Cow::Borrowed("") };
    // text is decoded; of a binary file only a mark before it is no part of it
    let bytes = match &*text {
        "" => source.bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(source.bytes),
        text => text.as_bytes(),
    };
    let header = Header::parse(source, bytes)?;
    let mut values = PlyValues::new(source, &header, bytes);
    let mut mesh = PolygonMesh { corners: Digits::F64, normals: Digits::F64, ..PolygonMesh::default() };
    let mut total = 0;
    let fits = |n: usize, element: &PlyElement| source.within_at(element.line, &limits::CORNERS, n);
    for element in &header.elements {
        match &*element.name {
            "vertex" => {
                let places = places(source, element, ["x", "y", "z"])?;
                if places.iter().any(|p| element.properties[*p].kind == PlyScalar::F32) {
                    mesh.corners = Digits::F32;
                }
                read_elements(element, &mut values, |row, _| {
                    mesh.vertices.push(DVec3::from_array(places.map(|p| row[p])));
                    fits(mesh.vertices.len(), element)
                })?;
            }
            "face" => {
                let list = list_of_corners(source, element)?;
                let normal = places(source, element, ["nx", "ny", "nz"]).ok();
                if normal.is_some_and(|at| at.iter().any(|p| element.properties[*p].kind == PlyScalar::F32)) {
                    mesh.normals = Digits::F32;
                }
                let named = header.facet_names.len() as u64 == element.count;
                let already = mesh.polygons.len();
                source.has_at_most(&limits::POLYGONS, already.saturating_add(element.count as usize))?;
                read_elements(element, &mut values, |row, corners| {
                    let normal = normal.map(|at| DVec3::from_array(at.map(|p| row[p])));
                    let normal = normal.filter(|n| n.is_finite());
                    let corners: Vec<_> = corners[list].iter().map(|&c| c as usize).collect();
                    total += corners.len();
                    let name = header.facet_names.get(mesh.polygons.len() - already).filter(|_| named);
                    let name = name.map_or_else(Arc::default, |n| n.as_str().into());
                    mesh.polygons.push(Polygon { name, corners, normal });
                    fits(total, element)
                })?;
            }
            "tristrips" => {
                let list = list_of_corners(source, element)?;
                read_elements(element, &mut values, |_, corners| {
                    // -1 begins another strip; winding alternates, and is made consistent later
                    let strips = corners[list].split(|&c| c < 0.0);
                    let triangles = strips.flat_map(|strip| strip.windows(3));
                    mesh.polygons.extend(triangles.map(|t| Polygon {
                        corners: t.iter().map(|&c| c as usize).collect(),
                        ..Polygon::default()
                    }));
                    total += corners[list].len();
                    source.within(&limits::POLYGONS, mesh.polygons.len())?;
                    fits(total, element)
                })?;
            }
            _ => read_elements(element, &mut values, |_, _| Ok(()))?,
        }
    }
    if header.is_text() {
        (mesh.corners, mesh.normals) = (values.digits, values.digits);
    }
    mesh.warnings.extend(values.left_over());
    Ok(mesh)
}

/// Reads every row of an element: single values, and the values of lists, by property.
fn read_elements(
    element: &PlyElement,
    values: &mut PlyValues,
    mut row: impl FnMut(&[f64], &[Vec<f64>]) -> Result<(), FormatError>,
) -> Result<(), FormatError> {
    // an element without properties has rows without bytes
    if element.properties.is_empty() {
        return Ok(());
    }
    let mut single = vec![0.0; element.properties.len()];
    let mut lists = vec![Vec::new(); element.properties.len()];
    for _ in 0..element.count {
        for (i, property) in element.properties.iter().enumerate() {
            match property.length {
                None => single[i] = values.next_value(property.kind, &property.name)?,
                Some(length) => {
                    let count = values.count(length, &property.name)?;
                    lists[i].clear();
                    for _ in 0..count {
                        lists[i].push(values.next_value(property.kind, &property.name)?);
                    }
                    if is_corners(property) {
                        values.check_corners(&lists[i], element.name == "tristrips")?;
                    }
                }
            }
        }
        row(&single, &lists)?;
    }
    Ok(())
}

/// Where three properties stand in their element.
fn places(source: &Input, element: &PlyElement, names: [&str; 3]) -> Result<[usize; 3], FormatError> {
    let at = |name: &str| element.properties.iter().position(|p| p.name == name && p.length.is_none());
    match names.map(at) {
        [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
        _ => Err(source.at_line(
            element.line,
            format!("properties {} of {}", names.join(", "), element.name),
            "others",
        )),
    }
}

fn is_corners(property: &Property) -> bool {
    property.length.is_some() && matches!(&*property.name, "vertex_indices" | "vertex_index")
}

fn list_of_corners(source: &Input, element: &PlyElement) -> Result<usize, FormatError> {
    let expected = format!("property list … vertex_indices of {}", element.name);
    let list = element.properties.iter().position(is_corners);
    list.ok_or_else(|| source.at_line(element.line, expected, "none"))
}

/// Triangles, as some readers know no polygons of several lengths in one file.
fn header_of(surface: &MeshExport, storage: &str) -> String {
    let ascii = |text: &str| text.replace(|c| !(' '..='~').contains(&c), "?");
    let name = |(facet, _): &(usize, [usize; 3])| ascii(&surface.facets[*facet].0);
    let names: String = surface.triangles.iter().map(|t| format!("comment facet {}\n", name(t))).collect();
    format!(
        "ply\nformat {storage} 1.0\ncomment cutlab: {}\n{names}element vertex {}\n\
         property double x\nproperty double y\nproperty double z\nelement face {}\n\
         property list uchar int vertex_indices\n\
         property double nx\nproperty double ny\nproperty double nz\nend_header\n",
        ascii(&surface.name),
        surface.vertices.len(),
        surface.triangles.len()
    )
}

fn write_binary(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
    let mut bytes = header_of(surface, "binary_little_endian").into_bytes();
    let put = |p: DVec3| p.to_array().into_iter().flat_map(f64::to_le_bytes);
    surface.vertices.iter().for_each(|&v| bytes.extend(put(v)));
    for (facet, corners) in &surface.triangles {
        bytes.push(3);
        corners.iter().for_each(|&c| bytes.extend((c as i32).to_le_bytes()));
        bytes.extend(put(surface.facets[*facet].1));
    }
    Ok(bytes)
}

fn write_text(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
    let mut text = header_of(surface, "ascii");
    // a String takes every write
    for v in &surface.vertices {
        let _ = writeln!(text, "{} {} {}", v.x, v.y, v.z);
    }
    for (facet, [a, b, c]) in &surface.triangles {
        let n = surface.facets[*facet].1;
        let _ = writeln!(text, "3 {a} {b} {c} {} {} {}", n.x, n.y, n.z);
    }
    Ok(text.into_bytes())
}
