//! Wavefront OBJ: polygons, with a group for each facet.
//!
//! Read by `tobj`, which names no lines, makes up normals where a face states none, adds indices
//! unchecked and knows neither continued lines nor comments after a statement. So the text is
//! checked line by line first, and only what a stone is made of is handed on. `mtllib` is never
//! followed.

use super::error::FormatError;
use super::shell::{STATED_IN_F64, design_of_mesh};
use super::source::{Source, lines, number};
use super::{Format, Reading, Surface, Writer};
use crate::cut::Unit;
use crate::solid::recover::Polygon;
use crate::store::limits;
use glam::DVec3;
use std::fmt::Write;
use std::sync::Arc;

/// What `tobj` calls the group of faces that have none.
const NO_GROUP: &str = "unnamed_object";

/// OBJ meshes; one group a facet comes back as that facet, by name and to the last bit or so.
pub static FORMAT: Format = Format {
    name: "obj",
    extensions: &["obj"],
    about: "Wavefront OBJ mesh, one group a facet",
    sniff,
    read,
    write: Some(Writer::Mesh(write)),
};

fn sniff(source: &Source) -> u8 {
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

fn read(source: &Source) -> Result<Reading, FormatError> {
    let (vertices, polygons) = polygons(source)?;
    design_of_mesh(source, &vertices, &polygons, STATED_IN_F64)
}

/// The mesh as it stands in the file.
pub(super) fn polygons(source: &Source) -> Result<(Vec<DVec3>, Vec<Polygon>), FormatError> {
    let Checked { text, stated } = checked(source)?;
    let options = tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..Default::default() };
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok(Default::default()))
        .map_err(|cause| source.at_byte(0, "an OBJ mesh", cause.to_string()))?;
    let (mut vertices, mut polygons) = (Vec::new(), Vec::with_capacity(stated.len()));
    for tobj::Model { mesh, name } in models {
        let name: Arc<str> = if name == NO_GROUP { Arc::default() } else { name.into() };
        let (base, mut end) = (vertices.len(), 0);
        vertices.extend(mesh.positions.chunks_exact(3).map(DVec3::from_slice));
        // no arities: all are triangles
        let triangles = if mesh.face_arities.is_empty() { mesh.indices.len() / 3 } else { 0 };
        for arity in mesh.face_arities.iter().copied().chain(std::iter::repeat_n(3, triangles)) {
            let its = end..end + arity as usize;
            end = its.end;
            let corners = mesh.indices[its.clone()].iter().map(|&i| base + i as usize).collect();
            let normals = if stated[polygons.len()] { &mesh.normal_indices[its] } else { &[] };
            let mut normals = normals.iter().map(|&n| DVec3::from_slice(&mesh.normals[3 * n as usize..]));
            // normals that differ from corner to corner are for shading, not the facet's
            let normal = normals.next().filter(|first| normals.all(|n| n == *first));
            polygons.push(Polygon { name: name.clone(), corners, normal });
        }
    }
    Ok((vertices, polygons))
}

/// An OBJ text that holds only sound `v`, `vn`, `g` and `f` statements, points first.
#[derive(Default)]
struct Checked {
    text: String,
    /// Whether every corner of a face states a normal, in the order of the faces.
    stated: Vec<bool>,
}

/// Checks every statement that matters and leaves out the others. Of `v` only the place is kept:
/// a fourth number is a weight for curves, three more are a colour. Indices become positive ones.
fn checked(source: &Source) -> Result<Checked, FormatError> {
    let text = source.text();
    let slot = |kind: &str| ["v", "vt", "vn"].iter().position(|&k| k == kind);
    let (mut seen, mut total) = ([0usize; 3], [0usize; 3]);
    joined(&text)
        .filter_map(|(_, line)| slot(line.split_whitespace().next()?))
        .for_each(|kind| total[kind] += 1);
    let (mut out, mut faces, mut corners) = (Checked::default(), String::new(), 0);
    for (at, line) in joined(&text) {
        let mut words = line.split_whitespace();
        let Some(kind) = words.next() else { continue };
        if let Some(kind) = slot(kind) {
            seen[kind] += 1;
        }
        match kind {
            "v" | "vn" => {
                out.text += kind;
                for _ in 0..3 {
                    let word = words.next().unwrap_or_default();
                    let what = if kind == "v" { "corner" } else { "normal" };
                    // the normal of a face without area may be nan: 0 is as good as none
                    let none = kind == "vn" && word.to_ascii_lowercase().contains("nan");
                    let word = if none { "0" } else { word };
                    number(word)
                        .ok_or_else(|| source.at_line(at, format!("three numbers of a {what}"), word))?;
                    out.text.push(' ');
                    out.text += &word.replace('\u{2212}', "-");
                }
                out.text.push('\n');
            }
            "g" | "o" => {
                faces.push('g');
                words.for_each(|word| faces.extend([" ", word]));
                faces.push('\n');
            }
            "f" => {
                let before = corners;
                let mut stated = true;
                faces.push('f');
                for word in words {
                    let (corner, normal) = reference(word, seen, total).ok_or_else(|| {
                        let expected = format!("a corner from 1 to {} as in 3, 3/1 or 3//2", total[0]);
                        source.at_line(at, expected, word)
                    })?;
                    let _ = write!(faces, " {corner}"); // a String takes every write
                    if let Some(normal) = normal {
                        let _ = write!(faces, "//{normal}");
                    }
                    stated &= normal.is_some();
                    corners += 1;
                }
                faces.push('\n');
                out.stated.push(stated);
                source.within_at(at, &limits::POLYGONS, out.stated.len())?;
                if corners - before < 3 {
                    return Err(source.at_line(at, "a face of at least 3 corners", line.trim()));
                }
                source.within_at(at, &limits::CORNERS, corners)?;
            }
            _ => {}
        }
    }
    out.text += &faces;
    Ok(out)
}

/// Lines without comments, those that end in a backslash joined with the next.
fn joined(text: &str) -> impl Iterator<Item = (usize, String)> {
    let mut all = lines(text);
    std::iter::from_fn(move || {
        let (at, line) = all.next()?;
        let mut whole = line.to_owned();
        while whole.ends_with('\\') {
            whole.pop();
            whole.push(' ');
            whole += all.next()?.1;
        }
        whole.truncate(whole.find('#').unwrap_or(whole.len()));
        Some((at, whole))
    })
}

/// Corner and normal, from 1, of `v`, `v/t`, `v//n` or `v/t/n`; negative ones count back from the
/// last one seen.
fn reference(word: &str, seen: [usize; 3], total: [usize; 3]) -> Option<(usize, Option<usize>)> {
    let mut found = [None; 3];
    for (k, part) in word.split('/').enumerate() {
        let slot = found.get_mut(k)?;
        // a stone has no texture, and some files name one that they do not hold
        if k == 1 || (part.is_empty() && k > 0) {
            continue;
        }
        let n: i64 = part.parse().ok()?;
        let index = if n < 0 { n.checked_add(seen[k] as i64 + 1)? } else { n };
        *slot = Some((1..=total[k] as i64).contains(&index).then_some(index as usize)?);
    }
    Some((found[0]?, found[2]))
}

fn write(surface: &Surface) -> Result<Vec<u8>, FormatError> {
    let unit = match surface.unit {
        Unit::Millimetre => "mm",
        Unit::Free => "none, only the shape is known",
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
