//! STL: bare triangles, binary (in `f32`) or text, without unit.
//!
//! A binary file is one whose size is 84 + 50 n, whatever its header says: many begin with `solid`.

use super::error::FormatError;
use super::shell::{STATED_IN_F32, design_of_mesh};
use super::source::{Source, lines, number};
use super::{Format, Reading, Surface, Writer};
use crate::solid::recover::Polygon;
use crate::store::limits;
use glam::{DVec3, Vec3};
use std::fmt::Write;

/// Binary STL.
pub static BINARY: Format = Format {
    name: "stl",
    extensions: &["stl"],
    about: "STL mesh in binary: triangles in f32",
    sniff: |source| if count_of_binary(source.bytes).is_some_and(|n| n > 0) { 95 } else { 0 },
    read: read_binary,
    write: Some(Writer::Mesh(write_binary)),
};

/// Text STL.
pub static TEXT: Format = Format {
    name: "stl-text",
    extensions: &["stl"],
    about: "STL mesh as text: triangles; written for `--to stl-text`",
    sniff: sniff_text,
    read: read_text,
    write: Some(Writer::Mesh(write_text)),
};

const HEADER: usize = 80;
const TRIANGLE: usize = 50;

/// Number of triangles, if the size is that of a binary file.
fn count_of_binary(bytes: &[u8]) -> Option<usize> {
    let count: [u8; 4] = bytes.get(HEADER..HEADER + 4)?.try_into().ok()?;
    let count = u32::from_le_bytes(count) as usize;
    let needed = count.checked_mul(TRIANGLE)?.checked_add(HEADER + 4)?;
    // some writers pad the end with zeros
    let padded = || bytes.get(needed..).is_some_and(|rest| count > 0 && rest.iter().all(|b| *b == 0));
    (needed == bytes.len() || padded()).then_some(count)
}

fn sniff_text(source: &Source) -> u8 {
    let start = source.beginning().to_ascii_lowercase();
    let mut words = start.split_whitespace();
    match words.next() {
        Some("solid") if words.any(|w| w == "facet") => 90,
        Some("solid") => 20,
        Some("facet") => 60,
        _ => 0,
    }
}

/// Corners and triangles as a mesh reader has them.
type Polygons = (Vec<DVec3>, Vec<Polygon>);

fn read_binary(source: &Source) -> Result<Reading, FormatError> {
    let (corners, polygons) = polygons_of_binary(source)?;
    design_of_mesh(source, &corners, &polygons, STATED_IN_F32)
}

fn polygons_of_binary(source: &Source) -> Result<Polygons, FormatError> {
    let count = count_of_binary(source.bytes).unwrap_or_default();
    source.within(&limits::POLYGONS, count)?;
    let (mut corners, mut normals) = (Vec::with_capacity(3 * count), Vec::with_capacity(count));
    let records = source.bytes.get(HEADER + 4..).unwrap_or_default();
    for record in records.chunks_exact(TRIANGLE).take(count) {
        let float = |i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|k| record[4 * i + k])) as f64;
        let point = |i: usize| DVec3::new(float(3 * i), float(3 * i + 1), float(3 * i + 2));
        normals.push(point(0));
        corners.extend([1, 2, 3].map(point));
    }
    Ok(triangles(corners, &normals))
}

fn read_text(source: &Source) -> Result<Reading, FormatError> {
    let (corners, polygons) = polygons_of_text(source)?;
    design_of_mesh(source, &corners, &polygons, STATED_IN_F32)
}

fn polygons_of_text(source: &Source) -> Result<Polygons, FormatError> {
    let (mut corners, mut normals) = (Vec::new(), Vec::new());
    text_triangles(source, &mut corners, &mut normals)?;
    source.within(&limits::POLYGONS, normals.len())?;
    Ok(triangles(corners, &normals))
}

/// Corners and triangles of an STL file, binary or text; none if it is not one.
pub(super) fn polygons(source: &Source) -> Option<Result<Polygons, FormatError>> {
    if (BINARY.sniff)(source) > 0 {
        Some(polygons_of_binary(source))
    } else {
        ((TEXT.sniff)(source) > 0).then(|| polygons_of_text(source))
    }
}

fn triangles(corners: Vec<DVec3>, normals: &[DVec3]) -> Polygons {
    let polygon = |(i, n): (usize, &DVec3)| Polygon {
        corners: vec![3 * i, 3 * i + 1, 3 * i + 2],
        normal: Some(*n),
        ..Polygon::default()
    };
    (corners, normals.iter().enumerate().map(polygon).collect())
}

/// Reads `normal` and `vertex` rows; the words between them say nothing more.
fn text_triangles(
    source: &Source,
    corners: &mut Vec<DVec3>,
    normals: &mut Vec<DVec3>,
) -> Result<(), FormatError> {
    let text = source.text();
    let mut last = 1;
    for (at, line) in lines(&text) {
        last = at;
        let mut words = line.split_whitespace();
        let is = |word: Option<&str>, name: &str| word.is_some_and(|w| w.eq_ignore_ascii_case(name));
        let is_normal = match words.next() {
            first if is(first, "facet") && is(words.clone().next(), "normal") => {
                words.next();
                true
            }
            first if is(first, "vertex") => false,
            _ => continue,
        };
        if !is_normal && corners.len() >= 3 * normals.len() {
            return Err(source.at_line(at, "'facet normal' before another vertex", line.trim()));
        }
        let mut p = DVec3::ZERO;
        for k in 0..3 {
            let word = words.next().unwrap_or_default();
            // a triangle without area may state nan as its normal: 0 is as good as none
            let none = is_normal && word.to_ascii_lowercase().contains("nan");
            let value = if none { Some(0.0) } else { number(word) };
            p[k] = value.ok_or_else(|| source.at_line(at, "three numbers", word))?;
        }
        if is_normal { normals.push(p) } else { corners.push(p) }
    }
    if corners.len() == 3 * normals.len() && !normals.is_empty() {
        return Ok(());
    }
    let found = format!("{} normals, {} vertices", normals.len(), corners.len());
    Err(source.at_line(last, "three vertices to every normal", &found))
}

fn write_binary(surface: &Surface) -> Result<Vec<u8>, FormatError> {
    let mut bytes: Vec<u8> = format!("cutlab: {}", surface.name).into_bytes();
    bytes.resize(HEADER, b' ');
    bytes.extend((surface.triangles.len() as u32).to_le_bytes());
    let put = |p: Vec3| p.to_array().iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    for (facet, triangle) in &surface.triangles {
        bytes.extend(put(surface.facets[*facet].1.as_vec3()));
        for &corner in triangle {
            bytes.extend(put(surface.vertices[corner].as_vec3()));
        }
        bytes.extend([0, 0]);
    }
    Ok(bytes)
}

/// Numbers with all their digits; the name in ASCII, as some readers know nothing else.
fn write_text(surface: &Surface) -> Result<Vec<u8>, FormatError> {
    let name = surface.name.replace(|c| !(' '..='~').contains(&c), "?");
    let mut text = format!("solid {name}\n");
    // a String takes every write
    for (facet, triangle) in &surface.triangles {
        let n = surface.facets[*facet].1;
        let _ = writeln!(text, "facet normal {} {} {}\nouter loop", n.x, n.y, n.z);
        for v in triangle.map(|corner| surface.vertices[corner]) {
            let _ = writeln!(text, "vertex {} {} {}", v.x, v.y, v.z);
        }
        text += "endloop\nendfacet\n";
    }
    let _ = writeln!(text, "endsolid {name}");
    Ok(text.into_bytes())
}
