//! Wavefront OBJ: polygons, with a group for each facet.
//!
//! Read here and not by a library, because errors must name the line and a facet's stated normal
//! must not be made up from its neighbour's. `mtllib` is never followed.

use super::error::FormatError;
use super::shell::{STATED_IN_F64, design_of_mesh, few_enough};
use super::source::{Source, lines, number};
use super::{Format, Reading, facet_labels};
use crate::cut::{Design, Unit};
use crate::solid::recover::Polygon;
use glam::DVec3;
use std::fmt::Write;
use std::sync::Arc;

/// OBJ meshes; one group a facet comes back as that facet, by name and to the last bit or so.
pub static FORMAT: Format = Format {
    name: "obj",
    extensions: &["obj"],
    about: "Wavefront OBJ mesh, one group a facet",
    sniff,
    read,
    write: Some(write),
};

fn sniff(source: &Source) -> u8 {
    let vertex = |line: &str| {
        let mut words = line.split_whitespace();
        words.next() == Some("v") && words.next().and_then(number).is_some()
    };
    if lines(&source.beginning()).any(|(_, line)| vertex(line)) { 50 } else { 0 }
}

fn read(source: &Source) -> Result<Reading, FormatError> {
    let text = source.text();
    let (mut vertices, mut normals, mut polygons) = (Vec::new(), Vec::new(), Vec::new());
    let (mut texels, mut name) = (0usize, Arc::<str>::default());
    for (at, line) in joined(&text) {
        let said = line.split('#').next().unwrap_or_default();
        let mut words = said.split_whitespace();
        match words.next() {
            Some("v") => vertices.push(point(source, at, words, "corner")?),
            Some("vn") => normals.push(point(source, at, words, "normal")?),
            Some("vt") => texels += 1,
            Some("g" | "o") => name = words.collect::<Vec<_>>().join(" ").into(),
            Some("f") => {
                let mut polygon = Polygon { name: name.clone(), ..Polygon::default() };
                for (i, word) in words.enumerate() {
                    let counts = [vertices.len(), texels, normals.len()];
                    let (corner, normal) = reference(word, counts).ok_or_else(|| {
                        let expected = format!("a corner from 1 to {} as in 3, 3/1 or 3//2", vertices.len());
                        source.at_line(at, expected, word)
                    })?;
                    polygon.corners.push(corner);
                    let normal = normal.map(|n| normals[n]);
                    // normals that differ from corner to corner are for shading, not the facet's
                    polygon.normal = if i == 0 || polygon.normal == normal { normal } else { None };
                }
                if polygon.corners.len() < 3 {
                    return Err(source.at_line(at, "a face of at least 3 corners", said.trim()));
                }
                polygons.push(polygon);
                few_enough(source, polygons.len())?;
            }
            _ => {}
        }
    }
    design_of_mesh(source, &vertices, &polygons, STATED_IN_F64)
}

/// Lines, those that end in a backslash joined with the next.
fn joined(text: &str) -> impl Iterator<Item = (usize, String)> {
    let mut all = lines(text);
    std::iter::from_fn(move || {
        let (at, line) = all.next()?;
        let mut whole = line.to_owned();
        while let Some(head) = whole.strip_suffix('\\') {
            whole = format!("{head} {}", all.next()?.1);
        }
        Some((at, whole))
    })
}

fn point<'a>(
    source: &Source,
    at: usize,
    mut words: impl Iterator<Item = &'a str>,
    what: &str,
) -> Result<DVec3, FormatError> {
    let mut p = DVec3::ZERO;
    for k in 0..3 {
        let word = words.next().unwrap_or_default();
        p[k] = number(word).ok_or_else(|| source.at_line(at, format!("three numbers of a {what}"), word))?;
    }
    Ok(p)
}

/// Corner and normal, from 0, of `v`, `v/t`, `v//n` or `v/t/n`; negative ones count from the end.
fn reference(word: &str, counts: [usize; 3]) -> Option<(usize, Option<usize>)> {
    let mut found = [None; 3];
    for (k, part) in word.split('/').enumerate() {
        let slot = found.get_mut(k)?;
        if part.is_empty() && k > 0 {
            continue;
        }
        let n: i64 = part.parse().ok()?;
        let count = counts[k] as i64;
        let index = if n < 0 { count.checked_add(n)? } else { n - 1 };
        *slot = Some((0..count).contains(&index).then_some(index as usize)?);
    }
    Some((found[0]?, found[2]))
}

fn write(design: &Design) -> Result<Vec<u8>, FormatError> {
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
    let (labels, planes) = (facet_labels(design), design.planes());
    let unit = match design.unit {
        Unit::Millimetre => "mm",
        Unit::Free => "none, only the shape is known",
    };
    let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut text =
        format!("# {}\n# unit: {unit}\n# one group a facet, its normal as vn\n", one_line(&design.name));
    let mut row = |start: &str, p: DVec3| {
        let _ = writeln!(text, "{start} {} {} {}", p.x, p.y, p.z); // a String takes every write
    };
    solid.vertices.iter().for_each(|&v| row("v", v));
    solid.faces.iter().for_each(|f| row("vn", planes[f.plane].normal));
    for (n, face) in solid.faces.iter().enumerate() {
        let _ = write!(text, "g {}\nf", one_line(&labels[face.plane].replace(['#', '\\'], " ")));
        for corner in &face.corners {
            let _ = write!(text, " {}//{}", corner + 1, n + 1);
        }
        text.push('\n');
    }
    Ok(text.into_bytes())
}
