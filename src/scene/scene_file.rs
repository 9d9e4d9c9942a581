//! Scene files: TOML, from the user or from the catalogue.
//!
//! Their grammar is in [`crate::manual::scenes`]. Files that a scene names are
//! looked for beside it, and lie in its folder or below unless [`SceneOverrides::allow_outside`].

use super::build_context::GREATEST;
pub use super::build_context::{BuildContext, SceneOverrides};
use super::file_access::Files;
use super::light_schema::LightEntry;
use super::schema::{CameraEntry, FieldError, StoneEntry, field_error};
use super::surface_schema::SurfaceEntry;
use super::{Camera, Light, PlacedStone, Scene, Surface};
use crate::limits::{self, Exceeded, Limits};
use crate::parse::plain;
use crate::storage::{bounded_read, text};
use glam::Vec3;
use serde::Deserialize;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A scene that cannot be set up. Each error is one line.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The file cannot be read.
    #[error("cannot read the scene {}: {cause}", text::display_name(.path))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        cause: std::io::Error,
    },
    /// Something in the file is wrong.
    #[error("{file}, line {line}: {problem}")]
    Line {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
    /// More of something than is read.
    #[error("{file}: {cause}")]
    Limit {
        /// The file.
        file: String,
        /// The limit.
        cause: Exceeded,
    },
    /// More stones than the scene has places for.
    #[error("the scene '{scene}' has places for {places} stone(s), not for {given}")]
    StoneCount {
        /// The scene.
        scene: String,
        /// `[[stone]]` entries.
        places: usize,
        /// Stones named.
        given: usize,
    },
}

#[derive(Debug, Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum SceneUnit {
    Stone,
    Mm,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneDocument {
    #[serde(default)]
    about: String,
    unit: SceneUnit,
    #[serde(default)]
    picture: Option<Spanned<[u32; 2]>>,
    #[serde(default)]
    depth: Option<u32>,
    #[serde(default)]
    polarisation: Option<bool>,
    camera: Spanned<CameraEntry>,
    #[serde(default)]
    stone: Vec<Spanned<StoneEntry>>,
    #[serde(default)]
    surface: Vec<Spanned<SurfaceEntry>>,
    light: Vec<Spanned<LightEntry>>,
}

/// A scene as written.
///
/// ```
/// use cutlab::SceneFile;
///
/// let text = r#"
///     unit = "stone"
///     camera = { at = [0, -6, 5], field = 30 }
///     stone = [{ pose = "lying" }]
///     light = [{ kind = "square", at = [2, -1, 8], to = [0, 0, 0], side = 3, radiance = 8 }]
/// "#;
/// let file = SceneFile::parse("mine", "mine.toml", text, "".as_ref()).unwrap();
/// assert_eq!((file.stone_count(), file.picture()), (1, (640, 480)));
/// let scene = file.build(&Default::default(), 4.0 / 3.0).unwrap();
/// assert_eq!((scene.stones.len(), scene.lights.len()), (1, 1));
/// ```
#[derive(Debug, Clone)]
pub struct SceneFile {
    /// Its name: of the catalogue, or the file's without folder and extension.
    pub name: String,
    file: String,
    text: String,
    folder: PathBuf,
    document: SceneDocument,
}

impl SceneFile {
    /// Reads a scene file.
    pub fn open(path: &Path, limits: Limits) -> Result<SceneFile, SceneError> {
        let fail = |cause| SceneError::Read { path: path.to_owned(), cause };
        let many = |cause| SceneError::Limit { file: text::display_name(path), cause };
        let bytes = bounded_read::read(path, limits, &limits::SCENE).map_err(fail)?.map_err(many)?;
        let name = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        Self::parse_within(
            &name,
            &text::display_name(path),
            &text::decode_lines(&bytes),
            path.parent().unwrap_or(Path::new("")),
            limits,
        )
    }

    /// Understands the text of a scene.
    ///
    /// - `file`: what errors call it; `folder`: where files that it names are looked for
    pub fn parse(name: &str, file: &str, text: &str, folder: &Path) -> Result<SceneFile, SceneError> {
        Self::parse_within(name, file, text, folder, Limits::default())
    }

    fn parse_within(
        name: &str,
        file: &str,
        text: &str,
        folder: &Path,
        limits: Limits,
    ) -> Result<SceneFile, SceneError> {
        let at = |byte: usize, problem: String| SceneError::Line {
            file: file.into(),
            line: line_at(text, byte),
            problem,
        };
        let syntax = |e: toml::de::Error| {
            let byte = e.span().map_or(0, |s| s.start);
            let line = text.lines().nth(line_at(text, byte) - 1).unwrap_or_default();
            at(byte, plain::toml(e.message(), line))
        };
        let table = DeTable::parse(text).map_err(syntax)?;
        for value in table.get_ref().values() {
            sensible(value)
                .map_err(|span| at(span.start, format!("a number beyond ±{GREATEST:e}, or none")))?;
        }
        let document: SceneDocument = toml::from_str(text).map_err(syntax)?;
        for (limit, n) in [
            (&limits::STONES, document.stone.len()),
            (&limits::SURFACES, document.surface.len()),
            (&limits::LIGHTS, document.light.len()),
        ] {
            limits.check(limit, n).map_err(|cause| SceneError::Limit { file: file.into(), cause })?;
        }
        if let Some(picture) = &document.picture
            && picture.get_ref().iter().any(|side| !(1..=MOST_PIXELS).contains(side))
        {
            let problem = format!("a picture is from 1 to {MOST_PIXELS} pixels wide and high");
            return Err(at(picture.span().start, problem));
        }
        if document.depth == Some(0) {
            let problem = "a depth of 0 lets no light through: it is a number of segments from 1".into();
            let line = text.lines().position(|l| l.trim_start().starts_with("depth")).unwrap_or(0) + 1;
            return Err(SceneError::Line { file: file.into(), line, problem });
        }
        Ok(SceneFile {
            name: name.into(),
            file: file.into(),
            text: text.into(),
            folder: folder.into(),
            document,
        })
    }

    /// One line about it.
    pub fn about(&self) -> &str {
        &self.document.about
    }

    /// The first stone's STONE, by which a picture is called.
    pub fn first_cut(&self) -> Option<&str> {
        self.document.stone.first().map(|s| s.get_ref().cut())
    }

    /// Width and height of its picture.
    pub fn picture(&self) -> (u32, u32) {
        self.document.picture.as_ref().map_or((640, 480), |p| (*p.get_ref()).into())
    }

    /// How many stones it has places for.
    pub fn stone_count(&self) -> usize {
        self.document.stone.len()
    }

    /// Whether one of its lights shows a panorama.
    pub fn has_panorama(&self) -> bool {
        self.document.light.iter().any(|l| l.get_ref().has_panorama())
    }

    /// The files that it may read, where they are looked for.
    pub fn files(&self) -> Vec<PathBuf> {
        let document = &self.document;
        let cuts = document.stone.iter().map(|entry| entry.get_ref().cut());
        let meshes = document.surface.iter().filter_map(|entry| entry.get_ref().mesh.as_deref());
        let panoramas = document.light.iter().filter_map(|entry| entry.get_ref().panorama.as_deref());
        let materials = document.stone.iter().filter_map(|entry| entry.get_ref().material());
        let spectra = document.light.iter().filter_map(|entry| entry.get_ref().spectrum.as_deref());
        let white = document.camera.get_ref().white();
        let named = cuts.chain(meshes).chain(panoramas).chain(materials).chain(spectra).chain(white);
        named.map(|name| self.folder.join(name)).collect()
    }

    /// Sets the scene up.
    ///
    /// - `aspect`: width over height of the picture
    pub fn build(&self, cast: &SceneOverrides, aspect: f32) -> Result<Scene, SceneError> {
        let document = &self.document;
        let (places, given) = (document.stone.len(), cast.designs.len());
        if given > places {
            return Err(SceneError::StoneCount { scene: self.name.clone(), places, given });
        }
        if places == 0 && document.unit == SceneUnit::Stone {
            let text = self.text.lines().position(|l| l.trim_start().starts_with("unit"));
            let problem = "unit is \"mm\" where there is no stone".into();
            return Err(SceneError::Line { file: self.file.clone(), line: text.unwrap_or(0) + 1, problem });
        }
        let files = Files { folder: self.folder.clone(), anywhere: cast.allow_outside };
        let mut unit = 1.0;
        let mut stones: Vec<PlacedStone> = Vec::with_capacity(places);
        for (i, entry) in document.stone.iter().enumerate() {
            let design = match cast.designs.get(i) {
                Some(design) => design.clone(),
                None => self.with_line(entry, entry.get_ref().design(&files, cast.limits))?,
            };
            let own = cast.materials.get(i).cloned().flatten();
            let of = SceneOverrides {
                material: own.or(cast.material.clone()),
                size_mm: cast.size_mm,
                ..SceneOverrides::default()
            };
            let (stone, material) = self.with_line(entry, entry.get_ref().stone(design, &of, &files))?;
            if i == 0 && document.unit == SceneUnit::Stone {
                unit = stone.unit as f32;
            }
            let polarised = cast.polarisation.or(document.polarisation).unwrap_or(true);
            let placed = self.with_line(entry, entry.get_ref().place(stone, material, unit, cast.pose))?;
            stones.push(PlacedStone { polarised, ..placed });
        }
        let centre = stones.first().map_or(Vec3::ZERO, |s| s.position);
        let panorama = cast.panorama.as_deref();
        let (limits, read) = (cast.limits, Default::default());
        let place = BuildContext { unit, files: &files, panorama, centre, limits, read };
        let camera: Camera =
            self.with_line(&document.camera, document.camera.get_ref().camera(&place, aspect))?;
        if let Some(i) = stone_around(&stones, &camera) {
            let inside = field_error("at", format!("the camera stands inside stone {}", i + 1));
            return self.with_line(&document.camera, Err(inside));
        }
        let surfaces: Result<Vec<Surface>, _> =
            document.surface.iter().map(|e| self.with_line(e, e.get_ref().surface(&place))).collect();
        let lights: Result<Vec<Light>, _> = document
            .light
            .iter()
            .map(|e| self.with_line(e, e.get_ref().light_outside(&place, &stones)))
            .collect();
        Ok(Scene {
            name: self.name.clone(),
            surfaces: surfaces?,
            lights: lights?,
            stones,
            camera,
            depth: document.depth,
            cut_out: cast.cut_out,
        })
    }

    /// Adds the line to what is wrong with an entry: that of the key, or where the entry begins.
    fn with_line<E, T>(&self, entry: &Spanned<E>, result: Result<T, FieldError>) -> Result<T, SceneError> {
        result.map_err(|wrong| {
            let span = entry.span();
            let body = self.text.get(span.start..).unwrap_or_default();
            let is_key = |line: &str| {
                let rest = line.trim_start().strip_prefix(wrong.key).unwrap_or_default();
                rest.trim_start().starts_with('=')
            };
            let down = body.lines().position(is_key).unwrap_or(0);
            let line = line_at(&self.text, span.start) + down;
            SceneError::Line { file: self.file.clone(), line, problem: wrong.problem }
        })
    }
}

/// Most pixels of a side of a picture.
pub const MOST_PIXELS: u32 = 1 << 14;

/// The number of a stone that some of the camera's rays begin in.
fn stone_around(stones: &[PlacedStone], camera: &Camera) -> Option<usize> {
    /// Places across and down that are tested.
    const GRID: u32 = 8;
    let places = (0..=GRID).flat_map(|y| (0..=GRID).map(move |x| [x, y].map(|k| k as f32 / GRID as f32)));
    let mut begin: Vec<Vec3> = places.map(|[u, v]| camera.ray_through(u, v, [u, v]).0).collect();
    begin.dedup();
    stones.iter().position(|s| begin.iter().any(|at| s.contains(*at)))
}

/// Checks that every number is one and not beyond [`GREATEST`]; the error is where one stands.
fn sensible(value: &Spanned<DeValue>) -> Result<(), Range<usize>> {
    match value.get_ref() {
        DeValue::Float(x) => {
            let x: f64 = x.as_str().parse().unwrap_or(f64::NAN);
            if x.abs() <= GREATEST { Ok(()) } else { Err(value.span()) }
        }
        DeValue::Integer(n) => {
            let n = i64::from_str_radix(n.as_str(), n.radix()).unwrap_or(i64::MAX);
            if n.unsigned_abs() as f64 <= GREATEST { Ok(()) } else { Err(value.span()) }
        }
        DeValue::Array(all) => all.iter().try_for_each(sensible),
        DeValue::Table(all) => all.values().try_for_each(sensible),
        _ => Ok(()),
    }
}

/// The number, from 1, of the line that a byte lies in.
fn line_at(text: &str, byte: usize) -> usize {
    1 + text.as_bytes()[..byte.min(text.len())].iter().filter(|b| **b == b'\n').count()
}
