//! PLY: polygons as text or binary in either byte order; written with `f64` corners and the facets'
//! normals, their names in comments.
//!
//! Own reader: the crates for it read a whole file into maps of values, several times its size.

mod header;
mod values;

use super::error::FormatError;
use super::shell::{STATED_IN_F32, STATED_IN_F64, design_of_mesh};
use super::source::Source;
use super::{Format, Reading, Surface, Writer};
use crate::solid::recover::Polygon;
use crate::store::limits;
use glam::DVec3;
use header::{Element, Header, Kind, Property};
use std::fmt::Write;
use std::sync::Arc;
use values::Values;

/// Binary PLY.
pub static BINARY: Format = Format {
    name: "ply",
    extensions: &["ply"],
    about: "PLY mesh in binary: written with f64 corners and facets' normals",
    sniff: |source| if header::begins(source.bytes) { 97 } else { 0 },
    read,
    write: Some(Writer::Mesh(write_binary)),
};

/// Text PLY.
pub static TEXT: Format = Format {
    name: "ply-text",
    extensions: &["ply"],
    about: "PLY mesh as text: facets' normals; written for `--to ply-text`",
    sniff: |source| if header::begins(source.bytes) && header::says_text(source) { 98 } else { 0 },
    read,
    write: Some(Writer::Mesh(write_text)),
};

fn read(source: &Source) -> Result<Reading, FormatError> {
    let (vertices, polygons, stated_within) = polygons(source)?;
    design_of_mesh(source, &vertices, &polygons, stated_within)
}

/// Corners and faces of a PLY file, and how closely its stated normals must fit.
pub(super) fn polygons(source: &Source) -> Result<(Vec<DVec3>, Vec<Polygon>, f64), FormatError> {
    let header = Header::of(source)?;
    let mut values = Values::new(source, &header);
    let (mut vertices, mut polygons) = (Vec::new(), Vec::new());
    let (mut exact, mut total) = (true, 0);
    let fits = |n: usize, element: &Element| source.within_at(element.line, &limits::CORNERS, n);
    for element in &header.elements {
        match &*element.name {
            "vertex" => {
                let places = places(source, element, ["x", "y", "z"])?;
                exact = places.iter().all(|p| element.properties[*p].kind == Kind::F64) || header.is_text();
                each(element, &mut values, |row, _| {
                    let corner = DVec3::from_array(places.map(|p| row[p]));
                    if !corner.is_finite() {
                        let found = format!("corner {} at {corner}", vertices.len());
                        return Err(source.at_line(element.line, "finite numbers for x, y and z", &found));
                    }
                    vertices.push(corner);
                    fits(vertices.len(), element)
                })?;
            }
            "face" => {
                let list = list_of_corners(source, element)?;
                let normal = places(source, element, ["nx", "ny", "nz"]).ok();
                let named = header.facet_names.len() as u64 == element.count;
                each(element, &mut values, |row, corners| {
                    let normal = normal.map(|at| DVec3::from_array(at.map(|p| row[p])));
                    let corners: Vec<_> = corners[list].iter().map(|&c| c as usize).collect();
                    total += corners.len();
                    let name = header.facet_names.get(polygons.len()).filter(|_| named);
                    let name = name.map_or_else(Arc::default, |n| n.as_str().into());
                    polygons.push(Polygon { name, corners, normal });
                    source.within(&limits::POLYGONS, polygons.len())?;
                    fits(total, element)
                })?;
            }
            _ => each(element, &mut values, |_, _| Ok(()))?,
        }
    }
    Ok((vertices, polygons, if exact { STATED_IN_F64 } else { STATED_IN_F32 }))
}

/// Reads every row of an element: single values, and the values of lists, by property.
fn each(
    element: &Element,
    values: &mut Values,
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
                None => single[i] = values.next(property.kind, &property.name)?,
                Some(length) => {
                    let count = values.count(length, &property.name)?;
                    lists[i].clear();
                    for _ in 0..count {
                        lists[i].push(values.next(property.kind, &property.name)?);
                    }
                    if is_corners(property) {
                        values.check_corners(&lists[i])?;
                    }
                }
            }
        }
        row(&single, &lists)?;
    }
    Ok(())
}

/// Where three properties stand in their element.
fn places(source: &Source, element: &Element, names: [&str; 3]) -> Result<[usize; 3], FormatError> {
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

fn list_of_corners(source: &Source, element: &Element) -> Result<usize, FormatError> {
    element
        .properties
        .iter()
        .position(is_corners)
        .ok_or_else(|| source.at_line(element.line, "property list … vertex_indices of face", "none"))
}

/// Triangles, as some readers know no polygons of several lengths in one file.
fn header_of(surface: &Surface, storage: &str) -> String {
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

fn write_binary(surface: &Surface) -> Result<Vec<u8>, FormatError> {
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

fn write_text(surface: &Surface) -> Result<Vec<u8>, FormatError> {
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
