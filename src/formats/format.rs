//! A format: its name and extensions, how its files are known, read and written.

use super::changed_design::ChangedDesign;
use super::error::FormatError;
use super::input::Input;
use super::mesh_export::MeshExport;
use crate::design::{Design, LengthUnit};
use crate::geometry::ClosedMesh;
use crate::geometry::facet_recovery::RecoverError;
use crate::limits::{self, Limits};
use crate::storage::{bounded_read, text};
use std::path::Path;

/// Makes a file's bytes.
#[derive(Debug, Clone, Copy)]
pub enum Writer {
    /// Of a design's planes, tiers and texts; sentences about what had no room go to the list.
    Design(fn(&Design, &mut Vec<String>) -> Result<Vec<u8>, FormatError>),
    /// Of a surface, whose planes need not bound it.
    Mesh(fn(&MeshExport) -> Result<Vec<u8>, FormatError>),
}

/// Puts a changed design into the file it was read from: a file's bytes, and sentences about what could not be kept.
pub type Rewriter = fn(&Input, &ChangedDesign, &mut Vec<String>) -> Result<Vec<u8>, FormatError>;

/// A file format.
pub struct Format {
    /// Its name, as in `--to NAME` and in reports.
    pub name: &'static str,
    /// File extensions in lower case, the usual one first.
    pub extensions: &'static [&'static str],
    /// One line of help.
    pub about: &'static str,
    /// How surely a file is of this format, 0 (not at all) to 100 (a magic number).
    pub sniff: fn(&Input) -> u8,
    /// Reads a stone.
    pub read: fn(&Input) -> Result<Parsed, FormatError>,
    /// Writes a design, if the format can be written.
    pub write: Option<Writer>,
    /// Writes a changed design back into its file, if the format can; else it is written anew.
    pub rewrite: Option<Rewriter>,
}

/// A stone as a reader found it, and what it had to overlook.
#[derive(Debug)]
pub struct Parsed {
    /// Its shape.
    pub shape: ParsedShape,
    /// One line each.
    pub warnings: Vec<String>,
}

/// The shape of a stone as a reader found it.
#[derive(Debug)]
pub enum ParsedShape {
    /// Facets of a convex stone.
    Design(Design),
    /// A closed mesh that is no convex stone.
    Mesh {
        /// The surface.
        mesh: Box<ClosedMesh>,
        /// Its unit of length.
        unit: LengthUnit,
        /// Why it is no convex stone.
        reason: RecoverError,
    },
}

impl Parsed {
    /// A design that was read.
    pub fn new(design: Design, warnings: Vec<String>) -> Parsed {
        Parsed { shape: ParsedShape::Design(design), warnings }
    }

    /// The same in another unit of length: of its numbers as they are.
    pub fn in_unit(mut self, known: LengthUnit) -> Parsed {
        match &mut self.shape {
            ParsedShape::Design(design) => design.unit = known,
            ParsedShape::Mesh { unit, .. } => *unit = known,
        }
        self
    }
}

/// The bytes of a regular file, if they are not more than [`limits::FILE`]. What a reader allots is
/// bounded by the bytes it was given and by the other [`limits`].
pub(super) fn read_file(path: &Path, limits: Limits) -> Result<Vec<u8>, FormatError> {
    within_limit(path, bounded_read::read_regular(path, limits, &limits::FILE))
}

/// What [`bounded_read::read`] gives.
pub(super) type ReadOutcome = std::io::Result<Result<Vec<u8>, limits::Exceeded>>;

pub(super) fn within_limit(path: &Path, bytes: ReadOutcome) -> Result<Vec<u8>, FormatError> {
    let file = || text::display_name(path);
    let bytes = bytes.map_err(|cause| FormatError::Read { file: file(), cause })?;
    bytes.map_err(|cause| FormatError::TooLarge { file: file(), cause })
}

impl std::fmt::Debug for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}
