//! Wavefront OBJ: polygons, with a group for each facet.
//!
//! Own reader: the crates for it name no lines, make up normals where a face states none, and know neither
//! continued lines nor negative indices beyond what was seen. Of all statements only `v`, `vn`, `g`, `o` and
//! `f` make a stone; `mtllib` is never followed.

use super::error::FormatError;
use super::input::{Input, lines, number, without_comment};
use super::mesh_import::{Digits, PolygonMesh, stone_from_mesh};
use super::{Format, MeshExport, Parsed, Writer};
use crate::design::LengthUnit;
use crate::geometry::facet_recovery::Polygon;
use crate::limits;
use glam::DVec3;
use std::collections::HashMap;
use std::fmt::Write;
use std::sync::Arc;

/// OBJ meshes; one group a facet comes back as that facet, by name and to the last bit or so.
pub static FORMAT: Format = Format {
    name: "obj",
    extensions: &["obj"],
    about: "Wavefront OBJ mesh, one group a facet",
    sniff,
    read,
    write: Some(Writer::Mesh(write)),
    rewrite: None,
};

fn sniff(source: &Input) -> u8 {
    let vertex = |line: &str| {
        let mut words = line.split_whitespace();
        words.next() == Some("v") && words.next().and_then(number).is_some()
    };
    if lines(&source.beginning()).any(|(_, line)| vertex(line)) {
        return 50;
    }
    // a long comment may come first
    if source.extension() == "obj" { 10 } else { 0 }
}

fn read(source: &Input) -> Result<Parsed, FormatError> {
    stone_from_mesh(source, &mesh(source)?)
}

/// How many there are of what faces name: corners, texture, normals.
type Counts = [usize; 3];

/// What of a file comes before its faces, which may name what stands behind them.
#[derive(Default)]
struct ObjPoints {
    total: Counts,
    /// Normals; one that is none is of no use, and never needed.
    normals: Vec<Option<DVec3>>,
    /// Corners that are no points, by number, with line and word: an error if a face names them.
    odd: HashMap<usize, (usize, String)>,
    faces: usize,
}

/// Which of the [`Counts`] a statement adds to.
fn slot(kind: &str) -> Option<usize> {
    ["v", "vt", "vn"].iter().position(|&k| k == kind)
}

/// `fo` is what `f` was called once.
fn is_face(kind: &str) -> bool {
    matches!(kind, "f" | "fo")
}

/// The mesh as it stands in the file.
pub(super) fn mesh(source: &Input) -> Result<PolygonMesh, FormatError> {
    let text = source.text();
    let mut mesh = PolygonMesh { corners: Digits::TEXT, normals: Digits::TEXT, ..PolygonMesh::default() };
    let points = points(source, &text, &mut mesh)?;
    source.has_at_most(&limits::POLYGONS, points.faces)?;
    let mut seen = Counts::default();
    let (mut name, mut corners) = (Arc::<str>::default(), 0);
    for (at, line) in joined(&text) {
        let mut words = line.split_whitespace();
        let kind = words.next().unwrap_or_default();
        if let Some(kind) = slot(kind) {
            seen[kind] += 1;
        } else if matches!(kind, "g" | "o") {
            name = words.collect::<Vec<_>>().join(" ").into();
        } else if is_face(kind) {
            let mut polygon = Polygon { name: name.clone(), ..Polygon::default() };
            let mut normals = Vec::new();
            for word in words {
                let (corner, normal) = reference(word, seen, points.total).ok_or_else(|| {
                    let expected = format!("a corner from 1 to {} as in 3, 3/1 or 3//2", points.total[0]);
                    source.at_line(at, expected, word)
                })?;
                if let Some((line, word)) = points.odd.get(&corner) {
                    return Err(source.at_line(*line, "three numbers of a corner", word));
                }
                polygon.corners.push(corner);
                normals.push(normal.and_then(|n| *points.normals.get(n)?));
            }
            if polygon.corners.len() < 3 {
                return Err(source.at_line(at, "a face of at least 3 corners", line.trim()));
            }
            corners += polygon.corners.len();
            source.within_at(at, &limits::CORNERS, corners)?;
            // normals that differ from corner to corner are for shading, not the facet's
            polygon.normal = normals[0].filter(|first| normals.iter().all(|n| *n == Some(*first)));
            mesh.polygons.push(polygon);
        }
    }
    Ok(mesh)
}

/// Reads corners and normals. Of `v` only the place is kept: a fourth number is a weight for curves, three
/// more are a colour.
fn points(source: &Input, text: &str, mesh: &mut PolygonMesh) -> Result<ObjPoints, FormatError> {
    let (mut points, mut free_form) = (ObjPoints::default(), None);
    for (at, line) in joined(text) {
        let mut words = line.split_whitespace();
        let kind = words.next().unwrap_or_default();
        let mut point = |digits: &mut Digits| {
            let mut p = [0.0; 3];
            for value in &mut p {
                let word = words.next().unwrap_or_default();
                *value = number(word).ok_or(word)?;
                digits.see(word);
            }
            Ok::<_, &str>(DVec3::from_array(p))
        };
        match kind {
            "v" => {
                let place = point(&mut mesh.corners).unwrap_or_else(|word| {
                    points.odd.insert(mesh.vertices.len(), (at, word.to_owned()));
                    DVec3::NAN
                });
                mesh.vertices.push(place);
            }
            "vn" => points.normals.push(point(&mut mesh.normals).ok()),
            "surf" | "curv" => free_form = free_form.or(Some(at)),
            kind => points.faces += usize::from(is_face(kind)),
        }
        if let Some(kind) = slot(kind) {
            points.total[kind] += 1;
        }
    }
    match free_form {
        Some(at) if points.faces == 0 => Err(source.at_line(at, "faces", "free-form curves or surfaces")),
        _ => Ok(points),
    }
}

/// Lines without comments, those that end in a backslash joined with the next; a comment does not go on.
fn joined(text: &str) -> impl Iterator<Item = (usize, String)> {
    let mut all = lines(text);
    std::iter::from_fn(move || {
        let (at, line) = all.next()?;
        let mut whole = without_comment(line).to_owned();
        let mut goes_on = whole.len() == line.len();
        while goes_on && whole.trim_end().ends_with('\\') {
            whole.truncate(whole.trim_end().len() - 1);
            whole.push(' ');
            // at the end of the file nothing is left to go on with
            let Some((_, next)) = all.next() else { break };
            let said = without_comment(next);
            goes_on = said.len() == next.len();
            whole += said;
        }
        Some((at, whole))
    })
}

/// Corner and normal, from 0, of `v`, `v/t`, `v//n` or `v/t/n`; negative ones count back from the last one
/// seen. A normal that is not there is none.
fn reference(word: &str, seen: Counts, total: Counts) -> Option<(usize, Option<usize>)> {
    let mut found = [None; 3];
    for (k, part) in word.split('/').enumerate() {
        let slot = found.get_mut(k)?;
        // a stone has no texture, and some files name one that they do not hold
        if k == 1 || (part.is_empty() && k > 0) {
            continue;
        }
        let n: i64 = match part.parse() {
            Ok(n) => n,
            Err(_) if k == 2 => continue,
            Err(_) => return None,
        };
        let index = if n < 0 { n.checked_add(seen[k] as i64 + 1)? } else { n };
        *slot = (1..=total[k] as i64).contains(&index).then_some(index as usize - 1);
    }
    Some((found[0]?, found[2]))
}

fn write(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
    let unit = match surface.unit {
        LengthUnit::Millimetre => "mm",
        LengthUnit::Free => "none, only the shape is known",
    };
    let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut text =
        format!("# {}\n# unit: {unit}\n# one group a facet, its normal as vn\n", one_line(&surface.name));
    let mut row = |start: &str, p: DVec3| {
        let _ = writeln!(text, "{start} {} {} {}", p.x, p.y, p.z); // a String takes every write
    };
    surface.vertices.iter().for_each(|&v| row("v", v));
    surface.facets.iter().for_each(|(_, normal)| row("vn", *normal));
    let mut open = None;
    for (facet, corners) in &surface.polygons {
        if open.replace(facet) != Some(facet) {
            let label = surface.facets[*facet].0.replace(['#', '\\'], " ");
            let _ = writeln!(text, "g {}", one_line(&label));
        }
        text.push('f');
        for corner in corners {
            let _ = write!(text, " {}//{}", corner + 1, facet + 1);
        }
        text.push('\n');
    }
    Ok(text.into_bytes())
}
