//! The data set as a pbrt scene: the triangle meshes with the transforms that apply to them.
//!
//! Matrices are written column after column, as pbrt's own files are. pbrt's frame is left-handed
//! and so may be the data: whether the stone is its own mirror image is part of what is unverified.

use super::words::{PbrtWord, words};
use super::{PolygonShape, PolygonShapes};
use crate::formats::error::FormatError;
use crate::formats::include;
use crate::formats::input::{Input, is_no_value};
use crate::formats::mesh_import::Digits;
use crate::geometry::facet_recovery::Polygon;
use crate::limits;
use crate::storage::text;
use glam::{DMat4, DVec3};
use std::iter::Peekable;

/// How surely this is a pbrt scene.
pub fn sniff(source: &Input) -> u8 {
    let start = source.beginning();
    let mut sure = 0;
    for (_, word) in words(&start) {
        sure = sure.max(match word {
            PbrtWord::Text("trianglemesh") => 95,
            PbrtWord::Name("Shape" | "WorldBegin" | "LookAt" | "AttributeBegin" | "TransformBegin") => 85,
            PbrtWord::Name("Include" | "ConcatTransform") => 60,
            _ => 0,
        });
    }
    sure
}

/// Every triangle mesh of the scene, in the scene's frame.
pub fn meshes(source: &Input) -> Result<PolygonShapes, FormatError> {
    let mut scene =
        PbrtScene { at: DMat4::IDENTITY, saved: Vec::new(), meshes: Vec::new(), bytes: 0, included: 0 };
    scene.file(source, 0)?;
    if scene.meshes.is_empty() {
        return Err(source.at_line(1, "a Shape \"trianglemesh\"", "no such shape"));
    }
    // pbrt of that time works in f32, and so did what wrote for it
    Ok((scene.meshes, Digits::F32))
}

struct PbrtScene {
    at: DMat4,
    saved: Vec<DMat4>,
    meshes: Vec<PolygonShape>,
    /// Bytes of all files so far.
    bytes: usize,
    included: usize,
}

impl PbrtScene {
    fn file(&mut self, source: &Input, depth: usize) -> Result<(), FormatError> {
        self.bytes += source.bytes.len();
        let too_large = |cause| FormatError::TooLarge { file: source.name.into(), cause };
        source.limits.check(&limits::FILE, self.bytes).map_err(too_large)?;
        let text = source.text();
        let mut words = words(&text).peekable();
        while let Some((line, word)) = words.next() {
            let PbrtWord::Name(directive) = word else { continue };
            let mut take = |n: usize| numbers(source, line, directive, &mut words, n);
            let step = match directive {
                "Identity" | "WorldBegin" => {
                    self.at = DMat4::IDENTITY;
                    continue;
                }
                "AttributeBegin" | "TransformBegin" => {
                    source.within_at(line, &limits::BLOCKS, self.saved.len() + 1)?;
                    self.saved.push(self.at);
                    continue;
                }
                "AttributeEnd" | "TransformEnd" => {
                    let missing = || source.at_line(line, "a block begun before its end", directive);
                    self.at = self.saved.pop().ok_or_else(missing)?;
                    continue;
                }
                "Include" => {
                    let Some((_, PbrtWord::Text(name))) = words.next() else {
                        return Err(source.at_line(line, "a file name in quotes", directive));
                    };
                    self.include(source, line, name, depth)?;
                    continue;
                }
                "Shape" => {
                    self.shape(source, line, &mut words)?;
                    continue;
                }
                "Translate" => DMat4::from_translation(DVec3::from_slice(&take(3)?)),
                "Scale" => DMat4::from_scale(DVec3::from_slice(&take(3)?)),
                "Rotate" => {
                    let n = take(4)?;
                    let axis = DVec3::from_slice(&n[1..]).normalize_or_zero();
                    DMat4::from_axis_angle(axis, n[0].to_radians())
                }
                "LookAt" => look_at(&take(9)?),
                "ConcatTransform" => DMat4::from_cols_slice(&take(16)?),
                "Transform" => {
                    self.at = DMat4::from_cols_slice(&take(16)?);
                    continue;
                }
                _ => continue, // lights, cameras, materials: their parameters are no names
            };
            self.at *= step;
        }
        Ok(())
    }

    fn include(&mut self, source: &Input, line: usize, name: &str, depth: usize) -> Result<(), FormatError> {
        source.within_at(line, &limits::INCLUDES, depth + 1)?;
        self.included += 1;
        source.within_at(line, &limits::INCLUDED, self.included)?;
        let bytes = include::fetch(source, name)
            .ok_or_else(|| source.at_line(line, "a file in the scene's own folder", name))??;
        let path = source.folder.map_or_else(|| name.to_owned(), |f| text::display_name(f.join(name)));
        self.file(&Input { name: &path, bytes: &bytes, ..*source }, depth + 1)
    }

    fn shape<'t>(
        &mut self,
        source: &Input,
        line: usize,
        words: &mut Peekable<impl Iterator<Item = (usize, PbrtWord<'t>)>>,
    ) -> Result<(), FormatError> {
        let Some((_, PbrtWord::Text(kind))) = words.next() else {
            return Err(source.at_line(line, "the shape's kind in quotes", "Shape"));
        };
        let (mut points, mut indices) = (Vec::new(), Vec::new());
        while let Some(&(at, PbrtWord::Text(declared))) = words.peek() {
            words.next();
            let values = parameter(source, at, words)?;
            let mut parts = declared.split_whitespace();
            match (parts.next(), parts.next()) {
                (Some("point" | "point3"), Some("P")) => points = values,
                (Some("integer"), Some("indices")) => indices = values,
                _ => {}
            }
        }
        if kind != "trianglemesh" {
            return Ok(());
        }
        if points.is_empty() || points.len() % 3 != 0 {
            let found = format!("{} numbers", points.len());
            return Err(source.at_line(line, "three numbers a point in \"point P\"", &found));
        }
        if indices.is_empty() || indices.len() % 3 != 0 {
            let found = format!("{} numbers", indices.len());
            return Err(source.at_line(line, "three numbers a triangle in \"integer indices\"", &found));
        }
        let count = points.len() / 3;
        if let Some(i) = indices.iter().find(|&&i| !(i >= 0.0 && i.fract() == 0.0 && i < count as f64)) {
            let expected = format!("corners from 0 to {}", count - 1);
            return Err(source.at_line(line, expected, &i.to_string()));
        }
        source.within_at(line, &limits::POLYGONS, indices.len() / 3)?;
        let vertices = points.chunks_exact(3).map(|p| self.at.project_point3(DVec3::from_slice(p))).collect();
        let polygons = indices
            .chunks_exact(3)
            .map(|t| Polygon { corners: t.iter().map(|&i| i as usize).collect(), ..Polygon::default() })
            .collect();
        self.meshes.push((vertices, polygons));
        Ok(())
    }
}

/// The values of a parameter: one number or text, or a bracket of them; texts count for nothing.
fn parameter<'t>(
    source: &Input,
    line: usize,
    words: &mut Peekable<impl Iterator<Item = (usize, PbrtWord<'t>)>>,
) -> Result<Vec<f64>, FormatError> {
    let mut values = Vec::new();
    match words.next() {
        Some((_, PbrtWord::Number(x))) => values.push(x),
        Some((_, PbrtWord::Text(_) | PbrtWord::Name("true" | "false"))) => {}
        Some((_, PbrtWord::Open)) => loop {
            match words.next() {
                Some((_, PbrtWord::Number(x))) => values.push(x),
                Some((_, PbrtWord::Close)) => break,
                Some((_, PbrtWord::Text(_) | PbrtWord::Name("true" | "false" | ","))) => {}
                Some((_, PbrtWord::Name(name))) if is_no_value(name) => values.push(f64::NAN),
                Some((at, other)) => return Err(source.at_line(at, "a number or ]", &other.describe())),
                None => return Err(source.at_line(line, "] after the parameter's values", "")),
            }
        },
        Some((at, other)) => return Err(source.at_line(at, "a parameter's value", &other.describe())),
        None => return Err(source.at_line(line, "a parameter's value", "")),
    }
    Ok(values)
}

/// Exactly `n` numbers of a directive, with or without brackets.
fn numbers<'t>(
    source: &Input,
    line: usize,
    directive: &str,
    words: &mut Peekable<impl Iterator<Item = (usize, PbrtWord<'t>)>>,
    n: usize,
) -> Result<Vec<f64>, FormatError> {
    let bracket = words.next_if(|(_, w)| *w == PbrtWord::Open).is_some();
    let mut values = Vec::with_capacity(n);
    while values.len() < n {
        match words.next() {
            Some((_, PbrtWord::Number(x))) => values.push(x),
            Some((at, w)) => {
                return Err(source.at_line(at, format!("{n} numbers after {directive}"), &w.describe()));
            }
            None => return Err(source.at_line(line, format!("{n} numbers after {directive}"), "")),
        }
    }
    if bracket && words.next_if(|(_, w)| *w == PbrtWord::Close).is_none() {
        return Err(source.at_line(line, format!("] after the {n} numbers of {directive}"), "none"));
    }
    Ok(values)
}

/// The transform from world to camera, of eye, place looked at and up, in pbrt's left-handed frame.
fn look_at(n: &[f64]) -> DMat4 {
    let (eye, at, up) = (DVec3::from_slice(n), DVec3::from_slice(&n[3..]), DVec3::from_slice(&n[6..]));
    let forward = (at - eye).normalize_or_zero();
    let right = up.normalize_or_zero().cross(forward).normalize_or_zero();
    let camera = DMat4::from_cols(
        right.extend(0.0),
        forward.cross(right).extend(0.0),
        forward.extend(0.0),
        eye.extend(1.0),
    );
    camera.inverse()
}
