//! Formats of designs and meshes: one a file, one error type.
//!
//! The bytes decide which reader is used; only for writing does the file's extension decide.

mod asc_triangles;
mod changed_design;
mod changed_polygon;
mod cs580;
mod cutlab_toml;
mod cutting_table;
pub mod error;
mod format;
mod frames;
mod gcs;
mod gcs_write;
mod gem;
mod gem_write;
mod gemcad_text;
mod gemcad_text_write;
mod glb;
mod glb_write;
mod include;
pub mod input;
pub mod mesh_export;
pub mod mesh_facts;
mod mesh_import;
mod numbers;
mod obj;
mod perfect_diamond;
mod ply;
mod sc_tracer;
mod stl;
pub mod triangle_mesh;
mod unsupported;
mod windows_1252;
pub mod write_back;

use crate::storage::text;
pub use error::FormatError;
pub use format::{Format, Parsed, ParsedShape, Writer};
use format::{ReadOutcome, read_file, within_limit};
pub use input::Input;
pub use mesh_export::MeshExport;
pub use mesh_facts::MeshFacts;

use crate::design::{Design, LengthUnit, USUAL_WIDTH_MM};
use crate::geometry::ClosedMesh;
use crate::geometry::polyhedron::PlaneStatus;
use crate::limits::{self, Limits};
use crate::materials::Material;
use crate::storage::{atomic_write, bounded_read, stdin};
use std::collections::BTreeSet;
use std::path::Path;

/// Every format that is read.
pub static FORMATS: &[&Format] = &[
    &cutlab_toml::FORMAT,
    &gemcad_text::FORMAT,
    &gem::FORMAT,
    &gcs::FORMAT,
    &obj::FORMAT,
    &stl::BINARY,
    &stl::TEXT,
    &ply::BINARY,
    &ply::TEXT,
    &glb::GLB,
    &glb::GLTF,
    &sc_tracer::FORMAT,
    &cs580::FORMAT,
    &perfect_diamond::SCENE,
    &perfect_diamond::LIST,
];

/// What a file of a stone holds.
#[derive(Debug)]
pub enum Content {
    /// A convex stone, as a design.
    Design(Loaded),
    /// A closed mesh that is no convex stone.
    Mesh(LoadedMesh),
}

/// A closed mesh from outside that is no convex stone: it has concavities, or comes in several parts.
#[derive(Debug)]
pub struct LoadedMesh {
    /// The surface.
    pub mesh: Box<ClosedMesh>,
    /// Its unit of length.
    pub unit: LengthUnit,
    /// Name of the format it came in.
    pub format: &'static str,
    /// What had to be overlooked, one line each.
    pub warnings: Vec<String>,
    /// Why it is no convex stone: the error of whoever needs one.
    pub problem: FormatError,
}

impl Content {
    /// The design of a convex stone; for other meshes the error says why they are none.
    pub fn into_design(self) -> Result<Loaded, FormatError> {
        match self {
            Content::Design(loaded) => Ok(loaded),
            Content::Mesh(mesh) => Err(mesh.problem),
        }
    }
}

/// A design from outside.
#[derive(Debug)]
pub struct Loaded {
    /// The design. Its planes are known to bound a solid.
    pub design: Design,
    /// Name of the format it came in, or `library`.
    pub format: &'static str,
    /// What had to be overlooked or may surprise, one line each.
    pub warnings: Vec<String>,
}

/// Reads the design in the file at `path`, whatever its extension. It may be a pipe.
///
/// Errors name the file and the place in it. Checked in `tests/library/formats.rs` and `tests/program/corpus.rs`.
pub fn read(path: &Path) -> Result<Loaded, FormatError> {
    read_content(path, Limits::default())?.into_design()
}

/// As [`read`], for what a file names, within limits: only a regular file is read.
pub fn read_regular(path: &Path, limits: Limits) -> Result<Loaded, FormatError> {
    content_of(path, bounded_read::read_regular(path, limits, &limits::FILE), limits)?.into_design()
}

/// Reads a design from memory.
///
/// - `name`: shown in errors; its extension only tells apart formats that are refused
/// - `folder`: where files that it refers to must lie; none refuses them
pub fn read_bytes(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Loaded, FormatError> {
    read_content_bytes(name, bytes, folder, Limits::default())?.into_design()
}

/// As [`read`], also of a closed mesh that is no convex stone, and within limits that may be raised.
pub fn read_content(path: &Path, limits: Limits) -> Result<Content, FormatError> {
    content_of(path, bounded_read::read(path, limits, &limits::FILE), limits)
}

/// As [`read_content`], of standard input; files that it refers to are refused.
pub fn read_content_standard_input(limits: Limits) -> Result<Content, FormatError> {
    let path = Path::new("standard input");
    let bytes = within_limit(path, stdin::bytes(limits))?;
    read_content_bytes("standard input", &bytes, None, limits)
}

fn content_of(path: &Path, bytes: ReadOutcome, limits: Limits) -> Result<Content, FormatError> {
    let name = text::display_name(path);
    let bytes = within_limit(path, bytes)?;
    read_content_bytes(&name, &bytes, Some(path.parent().unwrap_or(Path::new(""))), limits)
}

/// As [`read_bytes`], also of a closed mesh that is no convex stone, and within limits that may be raised.
pub fn read_content_bytes(
    name: &str,
    bytes: &[u8],
    folder: Option<&Path>,
    limits: Limits,
) -> Result<Content, FormatError> {
    let source = Input { name, bytes, folder, limits };
    let format = format_of(&source)?;
    let Parsed { shape, mut warnings } =
        (format.read)(&source).map_err(|e| e.in_format(format.name, None))?;
    let format = format.name;
    match shape {
        ParsedShape::Design(design) => {
            let facets = design.facets().count();
            warnings.extend(check_closed(&source, &design).map_err(|e| e.in_format(format, Some(facets)))?);
            Ok(Content::Design(Loaded { design, format, warnings }))
        }
        ParsedShape::Mesh { mesh, unit, reason } => {
            let problem = source.no_stone(reason).in_format(format, Some(mesh.facets.len()));
            Ok(Content::Mesh(LoadedMesh { mesh, unit, format, warnings, problem }))
        }
    }
}

/// The format that a file's bytes show.
fn format_of(source: &Input) -> Result<&'static Format, FormatError> {
    let found = FORMATS
        .iter()
        .rev()
        .map(|f| ((f.sniff)(source), *f))
        .max_by_key(|(sure, _)| *sure)
        .filter(|(sure, _)| *sure > 0);
    // a page may quote a design: it is none all the same
    let is_page = |sure: u8| sure < stl::SURE_BY_SIZE && unsupported::is_web_page(source);
    let (sure, format) =
        found.filter(|(sure, _)| !is_page(*sure)).ok_or_else(|| unsupported::error(source))?;
    /// Below this other evidence is better: an extension, or how files of other kinds begin.
    const GUESS: u8 = 30;
    if sure < GUESS && unsupported::is_known(source) {
        return Err(unsupported::error(source));
    }
    Ok(format)
}

/// Whether a file of this content may name others, which then belong to the stone.
pub fn may_include(name: &str, bytes: &[u8]) -> bool {
    let source = Input { name, bytes, folder: None, limits: Limits::default() };
    [&glb::GLB, &glb::GLTF, &perfect_diamond::SCENE].iter().any(|f| (f.sniff)(&source) > 0)
}

/// Checks that the planes bound a solid; remarks on planes that bound nothing of it.
fn check_closed(source: &Input, design: &Design) -> Result<Vec<String>, FormatError> {
    let facets = design.facets().count();
    source.has_at_most(&limits::FACETS, facets)?;
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: source.name.into(), cause })?;
    let count = |wanted: fn(&PlaneStatus) -> bool| solid.plane_status.iter().filter(|f| wanted(f)).count();
    let mut remarks = Vec::new();
    for (n, what) in [
        (count(|f| matches!(f, PlaneStatus::Duplicate(_))), "coincide with other facets"),
        (count(|f| matches!(f, PlaneStatus::Redundant)), "do not touch the stone"),
    ] {
        if n > 0 {
            remarks.push(format!("{n} of {facets} facets {what}"));
        }
    }
    Ok(remarks)
}

/// Writes the design to `path` in the format that its extension names.
///
/// The file is replaced whole. Checked in `tests/library/formats.rs`.
pub fn write(design: &Design, path: &Path) -> Result<(), FormatError> {
    let bytes = encode(design, writer_for_path(path)?.name)?;
    Ok(atomic_write::write(path, &bytes)?)
}

/// The bytes of a file, and what of the stone had no room in it.
#[derive(Debug)]
pub struct Encoded {
    /// The file's bytes.
    pub bytes: Vec<u8>,
    /// What was left out or had to be assumed, one sentence each.
    pub remarks: Vec<String>,
}

/// The bytes of a file of the design in the format called `format`, by name or extension.
pub fn encode(design: &Design, format: &str) -> Result<Vec<u8>, FormatError> {
    Ok(encode_as(design, None, format)?.bytes)
}

/// As [`encode`], of a stone of a known material.
///
/// - `material`: what the stone is made of; without it the index that the design was drawn for counts,
///   or diamond's
///
/// Checked in `tests/library/receivers.rs`.
pub fn encode_as(design: &Design, material: Option<&Material>, format: &str) -> Result<Encoded, FormatError> {
    let mut remarks = Vec::new();
    let bytes = match writer_named(format)?.write.ok_or_else(|| no_writer(format))? {
        Writer::Design(write) => match material {
            Some(material) => write(&frames::drawn_for(design, material), &mut remarks)?,
            None => write(design, &mut remarks)?,
        },
        Writer::Mesh(write) => {
            if design.unit == LengthUnit::Free && unit_mm(format).is_some() {
                remarks.push(format!("the design has no size: written {USUAL_WIDTH_MM} mm wide, in metres"));
            }
            write(&MeshExport::from_design(design, material)?)?
        }
    };
    Ok(Encoded { bytes, remarks })
}

/// Length in millimetres of the unit that every file of the format called `format` has, by name or
/// extension; none for formats without unit, which is all but glTF.
pub fn unit_mm(format: &str) -> Option<f64> {
    let metric = [&glb::GLB, &glb::GLTF].iter().any(|f| f.name == format || f.extensions.contains(&format));
    metric.then_some(glb::UNIT_MM)
}

/// The bytes of a file of a mesh that is no convex stone, in the format called `format`.
///
/// - `unit`: of the mesh's corners
///
/// Formats that hold planes refuse it. Checked in `tests/program/cli.rs`.
pub fn encode_mesh(
    name: &str,
    mesh: &ClosedMesh,
    unit: LengthUnit,
    format: &str,
) -> Result<Vec<u8>, FormatError> {
    let format = writer_named(format)?;
    match format.write {
        Some(Writer::Mesh(write)) => write(&MeshExport::from_closed_mesh(name, mesh, unit)),
        _ => {
            let meshes = FORMATS.iter().filter(|f| matches!(f.write, Some(Writer::Mesh(_))));
            let meshes: Vec<_> = meshes.map(|f| f.name).collect();
            Err(FormatError::Encode {
                name: name.into(),
                format: format.name,
                problem: format!("it is not convex, and the format holds planes; try {}", meshes.join(", ")),
            })
        }
    }
}

/// The format that is written for a file of this name, by its extension.
pub fn writer_for_path(path: &Path) -> Result<&'static Format, FormatError> {
    let extension = extension_of(path);
    find_writer(|f| f.extensions.contains(&&*extension)).ok_or_else(|| no_writer(&text::display_name(path)))
}

/// The format to write that is called `asked`, by name or extension.
pub fn writer_named(asked: &str) -> Result<&'static Format, FormatError> {
    let name = asked.trim().trim_start_matches('.').to_lowercase();
    find_writer(|f| f.name == name || f.extensions.contains(&&*name)).ok_or_else(|| no_writer(asked))
}

fn find_writer(wanted: impl Fn(&Format) -> bool) -> Option<&'static Format> {
    FORMATS.iter().copied().find(|f| f.write.is_some() && wanted(f))
}

fn no_writer(asked: &str) -> FormatError {
    let writers = FORMATS.iter().filter(|f| f.write.is_some());
    let mut known: Vec<_> = writers.filter_map(|f| f.extensions.first().copied()).collect();
    let mut seen = BTreeSet::new();
    known.retain(|extension| seen.insert(*extension));
    FormatError::NoWriter { asked: asked.into(), known }
}

/// Extensions that files of every kind have: their content alone tells whether one is a design.
const COMMON_EXTENSIONS: [&str; 2] = ["toml", "txt"];

/// Whether a file that nobody named, but that lies in a folder, is meant as a stone: by an extension that
/// only designs and meshes have, else by its content. A scene, a table with its sidecar and the
/// settings of other programs are not; a design that is damaged is.
pub fn is_meant_as_stone(path: &Path, limits: Limits) -> bool {
    /// From here on no other kind of file begins like that.
    const CERTAIN: u8 = 90;
    let extension = extension_of(path);
    let has_ending =
        FORMATS.iter().any(|f| f.extensions.contains(&&*extension)) || unsupported::has_extension(&extension);
    if has_ending && !COMMON_EXTENSIONS.contains(&&*extension) {
        return true;
    }
    let Ok(bytes) = read_file(path, limits) else { return has_ending };
    let name = text::display_name(path);
    let source = Input { name: &name, bytes: &bytes, folder: path.parent(), limits };
    let sure = FORMATS.iter().map(|f| (f.sniff)(&source)).max().unwrap_or(0);
    if sure == (cutlab_toml::FORMAT.sniff)(&source) {
        return sure > 0 && cutlab_toml::looks_like_cutlab_toml(&source);
    }
    let understood = || {
        matches!(
            read_content_bytes(&name, &bytes, path.parent(), limits).and_then(Content::into_design),
            Ok(_) | Err(FormatError::NoStone { .. } | FormatError::Limit { .. })
        )
    };
    sure >= CERTAIN || (sure > 0 && understood())
}

fn extension_of(path: &Path) -> String {
    path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase())
}
