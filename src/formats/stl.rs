//! STL: bare triangles, binary or text, in `f32` and without unit.
//!
//! A binary file is one whose size is 84 + 50 n, whatever its header says: many begin with `solid`.

use super::error::FormatError;
use super::shell::{STATED_IN_F32, design_of_mesh, few_enough};
use super::source::{Source, lines, number};
use super::{Format, Reading};
use crate::cut::Design;
use crate::solid::recover::Polygon;
use glam::{DVec3, Vec3};

/// STL meshes of both kinds; written in binary.
pub static FORMAT: Format = Format {
    name: "stl",
    extensions: &["stl"],
    about: "STL mesh, text or binary: triangles in f32, written in binary",
    sniff,
    read,
    write: Some(write),
};

const HEADER: usize = 80;
const TRIANGLE: usize = 50;

/// Number of triangles, if the size is that of a binary file.
fn count_of_binary(bytes: &[u8]) -> Option<usize> {
    let count: [u8; 4] = bytes.get(HEADER..HEADER + 4)?.try_into().ok()?;
    let count = u32::from_le_bytes(count) as usize;
    (count.checked_mul(TRIANGLE)?.checked_add(HEADER + 4)? == bytes.len()).then_some(count)
}

fn sniff(source: &Source) -> u8 {
    if count_of_binary(source.bytes).is_some_and(|n| n > 0) {
        return 95;
    }
    let start = source.beginning();
    let mut words = start.split_whitespace();
    match words.next() {
        Some("solid") if words.any(|w| w == "facet") => 90,
        Some("solid") => 20,
        _ => 0,
    }
}

fn read(source: &Source) -> Result<Reading, FormatError> {
    let mut corners = Vec::new();
    let mut normals = Vec::new();
    match count_of_binary(source.bytes) {
        Some(count) => {
            few_enough(source, count)?;
            for record in source.bytes[HEADER + 4..].chunks_exact(TRIANGLE) {
                let float = |i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|k| record[4 * i + k])) as f64;
                let point = |i: usize| DVec3::new(float(3 * i), float(3 * i + 1), float(3 * i + 2));
                normals.push(point(0));
                corners.extend([1, 2, 3].map(point));
            }
        }
        None => text_triangles(source, &mut corners, &mut normals)?,
    }
    let polygons: Vec<Polygon> = normals
        .iter()
        .enumerate()
        .map(|(i, n)| Polygon {
            corners: vec![3 * i, 3 * i + 1, 3 * i + 2],
            normal: Some(*n),
            ..Polygon::default()
        })
        .collect();
    design_of_mesh(source, &corners, &polygons, STATED_IN_F32)
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
        let is_normal = match (words.next(), words.clone().next()) {
            (Some("facet"), Some("normal")) => {
                words.next();
                true
            }
            (Some("vertex"), _) => false,
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

fn write(design: &Design) -> Result<Vec<u8>, FormatError> {
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
    let (mesh, planes) = (solid.triangulate(), design.planes());
    let mut header: Vec<u8> = format!("cutlab: {}", design.name).into_bytes();
    header.resize(HEADER, b' ');
    let mut bytes = header;
    bytes.extend((mesh.triangles.len() as u32).to_le_bytes());
    let put = |p: Vec3| p.to_array().iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    for (triangle, &face) in mesh.triangles.iter().zip(&mesh.faces) {
        bytes.extend(put(planes[solid.faces[face].plane].normal.as_vec3()));
        for &corner in triangle {
            bytes.extend(put(mesh.vertices[corner].as_vec3()));
        }
        bytes.extend([0, 0]);
    }
    Ok(bytes)
}
