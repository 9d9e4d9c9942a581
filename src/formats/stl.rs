//! STL: bare triangles, binary (in `f32`) or text, without unit.
//!
//! A binary file is one whose size is 84 + 50 n, whatever its header says: many begin with `solid`.

use super::error::{FormatError, counted};
use super::input::{Input, lines, number, without_comment};
use super::mesh_import::{Digits, PolygonMesh, stone_from_mesh};
use super::{Format, MeshExport, Writer};
use crate::geometry::facet_recovery::Polygon;
use crate::limits;
use glam::{DVec3, Vec3};
use std::fmt::Write;

/// Binary STL.
pub static BINARY: Format = Format {
    name: "stl",
    extensions: &["stl"],
    about: "STL mesh in binary: triangles in f32",
    sniff: sniff_binary,
    read: |source| stone_from_mesh(source, &binary_mesh(source)?),
    write: Some(Writer::Mesh(write_binary)),
    rewrite: None,
};

/// Text STL.
pub static TEXT: Format = Format {
    name: "stl-text",
    extensions: &["stl"],
    about: "STL mesh as text: triangles; written for `--to stl-text`",
    sniff: sniff_text,
    read: |source| stone_from_mesh(source, &text_mesh(source)?),
    write: Some(Writer::Mesh(write_text)),
    rewrite: None,
};

/// How sure it is that a file of a binary STL's size is one: no text has its number of triangles, and hardly
/// another binary file.
pub(super) const SURE_BY_SIZE: u8 = 110;

const HEADER: usize = 80;
const TRIANGLE: usize = 50;

/// The number of triangles that a binary file states, and how many bytes it then has.
fn stated(bytes: &[u8]) -> Option<(usize, usize)> {
    let count: [u8; 4] = bytes.get(HEADER..HEADER + 4)?.try_into().ok()?;
    let count = match u32::from_le_bytes(count) {
        // as a writer leaves it that does not know yet how many there will be
        0 | u32::MAX if is_whole(bytes) && is_like_triangles(bytes) => (bytes.len() - HEADER - 4) / TRIANGLE,
        count => count as usize,
    };
    Some((count, count.checked_mul(TRIANGLE)?.checked_add(HEADER + 4)?))
}

fn sniff_binary(source: &Input) -> u8 {
    match stated(source.bytes) {
        // more certain than any beginning, which may be another format's
        Some((1.., size)) if size == source.bytes.len() => SURE_BY_SIZE,
        // what follows the triangles is of no use, if these are triangles at all
        Some((1.., size)) if size < source.bytes.len() && is_like_triangles(source.bytes) => 60,
        Some((1.., _)) if source.extension() == "stl" && source.is_binary() => 10,
        _ => 0,
    }
}

/// Whether there are nothing but triangles after the header, and more than zeros.
fn is_whole(bytes: &[u8]) -> bool {
    let rest = bytes.get(HEADER + 4..).unwrap_or_default();
    rest.len() % TRIANGLE == 0 && rest.iter().any(|b| *b != 0)
}

/// Whether the first triangles have coordinates that a mesh may have.
fn is_like_triangles(bytes: &[u8]) -> bool {
    const SOME: usize = 20;
    let first = bytes[HEADER + 4..].chunks_exact(TRIANGLE).take(SOME);
    let numbers = |t: &[u8]| t[12..48].chunks_exact(4).map(float).collect::<Vec<_>>();
    first.flat_map(numbers).all(|x| x == 0.0 || (1e-12..1e12).contains(&x.abs()))
}

fn float(bytes: &[u8]) -> f64 {
    f32::from_le_bytes([0, 1, 2, 3].map(|k| bytes.get(k).copied().unwrap_or_default())).into()
}

fn sniff_text(source: &Input) -> u8 {
    let start = source.beginning().to_ascii_lowercase();
    let mut words = start.split_whitespace();
    match words.next() {
        // a binary header may say the same
        Some("solid") if source.is_binary() => 5,
        Some("solid") if words.any(|w| w == "facet") => 90,
        Some("solid") => 20,
        Some("facet") => 60,
        _ => 0,
    }
}

/// The mesh of an STL file of either kind; none if it is none.
pub(super) fn mesh(source: &Input) -> Option<Result<PolygonMesh, FormatError>> {
    let (binary, text) = (sniff_binary(source), sniff_text(source));
    match binary.max(text) {
        0 => None,
        sure if sure == binary => Some(binary_mesh(source)),
        _ => Some(text_mesh(source)),
    }
}

fn binary_mesh(source: &Input) -> Result<PolygonMesh, FormatError> {
    let (count, size) = stated(source.bytes).unwrap_or_default();
    let Some(extra) = source.bytes.len().checked_sub(size) else {
        let expected = format!("{size} bytes for {count} triangles");
        return Err(source.at_byte(HEADER, expected, format!("{} bytes", source.bytes.len())));
    };
    source.has_at_most(&limits::POLYGONS, count)?;
    let mut mesh = PolygonMesh { corners: Digits::F32, normals: Digits::F32, ..PolygonMesh::default() };
    for record in source.bytes.get(HEADER + 4..size).unwrap_or_default().chunks_exact(TRIANGLE) {
        let point = |i: usize| DVec3::from_array([0, 1, 2].map(|k| float(&record[4 * (3 * i + k)..])));
        let first = mesh.vertices.len();
        mesh.vertices.extend([1, 2, 3].map(point));
        let normal = Some(point(0)).filter(|n| n.is_finite());
        mesh.polygons.push(Polygon { corners: (first..first + 3).collect(), normal, ..Polygon::default() });
    }
    // some writers pad the end with zeros
    if source.bytes[size..].iter().any(|b| *b != 0) {
        mesh.warnings.push(format!("{} after the last triangle passed over", counted(extra, "byte")));
    }
    Ok(mesh)
}

/// Reads `normal`, `loop` and `vertex`; the words between them say nothing more. White space of any kind
/// parts words, so that a file may stand on one line.
fn text_mesh(source: &Input) -> Result<PolygonMesh, FormatError> {
    let text = source.text();
    let follows_facet =
        |word: &str| ["normal", "outer", "loop", "vertex"].iter().any(|n| word.eq_ignore_ascii_case(n));
    let facets = words_of(&text).filter(|(_, w)| w.eq_ignore_ascii_case("facet")).count();
    source.has_at_most(&limits::POLYGONS, facets)?;
    let mut mesh = PolygonMesh { corners: Digits::TEXT, normals: Digits::TEXT, ..PolygonMesh::default() };
    let is = |word: &str, name: &str| word.eq_ignore_ascii_case(name);
    let mut words = words_of(&text).peekable();
    // the polygon that has no corner yet, or is being read
    let mut open: Option<Polygon> = None;
    let mut last = 1;
    while let Some((at, word)) = words.next() {
        last = at;
        if is(word, "facet") && words.peek().is_some_and(|(_, w)| follows_facet(w)) {
            finish(source, at, &mut open, &mut mesh)?;
            open = Some(Polygon::default());
        } else if let (true, Some(polygon)) = (is(word, "normal"), &mut open) {
            let mut said = Vec::new();
            while let Some((_, word)) =
                words.next_if(|(_, w)| !["outer", "loop", "vertex"].iter().any(|n| is(w, n)))
            {
                said.push(word);
            }
            // what is no normal is as good as none
            let values: Option<Vec<f64>> = said.iter().map(|w| number(w)).collect();
            polygon.normal = values.filter(|v| v.len() == 3).map(|v| DVec3::from_slice(&v));
            said.iter().for_each(|w| mesh.normals.see(w));
        } else if is(word, "vertex")
            && open.is_none()
            && words.peek().is_none_or(|(_, w)| number(w).is_none())
        {
            // of the solid's name
        } else if is(word, "vertex") {
            let Some(polygon) = &mut open else {
                return Err(source.at_line(at, "'facet' before another vertex", word));
            };
            let mut p = [0.0; 3];
            for value in &mut p {
                let (at, word) = words.next().unwrap_or((at, ""));
                *value = number(word).ok_or_else(|| source.at_line(at, "three numbers", word))?;
                mesh.corners.see(word);
            }
            polygon.corners.push(mesh.vertices.len());
            mesh.vertices.push(DVec3::from_array(p));
        } else if is(word, "endfacet") {
            finish(source, at, &mut open, &mut mesh)?;
        }
    }
    finish(source, last, &mut open, &mut mesh)?;
    if mesh.polygons.is_empty() {
        return Err(source.at_line(last, "at least one triangle", "none"));
    }
    Ok(mesh)
}

/// Adds the polygon that was read, if there is one.
fn finish(
    source: &Input,
    at: usize,
    open: &mut Option<Polygon>,
    mesh: &mut PolygonMesh,
) -> Result<(), FormatError> {
    let Some(polygon) = open.take() else { return Ok(()) };
    if polygon.corners.len() < 3 {
        let found = format!("{} of them", polygon.corners.len());
        return Err(source.at_line(at, "three vertices to every facet", &found));
    }
    mesh.polygons.push(polygon);
    Ok(())
}

/// The words of the file without the solids' names: these end with their line, unless all stands on one.
fn words_of(text: &str) -> impl Iterator<Item = (usize, &str)> {
    lines(text).flat_map(|(at, line)| {
        let line = without_comment(line);
        let first = line.split_whitespace().next().unwrap_or_default();
        let names = ["solid", "endsolid"].iter().any(|n| first.eq_ignore_ascii_case(n));
        let next = line.split_whitespace().skip(1);
        let is_corner =
            |(word, next): (&str, &str)| word.eq_ignore_ascii_case("vertex") && number(next).is_some();
        let holds = names && line.split_whitespace().zip(next).any(is_corner);
        let said = if names && !holds { "" } else { line };
        said.split_whitespace().map(move |word| (at, word))
    })
}

fn write_binary(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
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
fn write_text(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
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
