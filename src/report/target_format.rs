//! What a stone is written as: a format of designs and meshes, or the cutting diagram as a drawing.

use super::diagram::{self, Paper};
use super::drawing_format::DrawingFormat;
use super::stone_report::ReportError;
use crate::design::Design;
use crate::formats::{self, Encoded, Format, FormatError};
use crate::materials::Material;
use crate::storage::text::display_name;
use std::path::Path;

/// Dots a millimetre of a diagram's PNG: 200 dpi.
const DOTS_PER_MM: f64 = 200.0 / 25.4;

/// A format or a drawing.
#[derive(Clone, Copy)]
pub enum TargetFormat {
    /// Of a design or a mesh.
    Format(&'static Format),
    /// The cutting diagram.
    Drawing(DrawingFormat),
}

impl TargetFormat {
    /// The one that is called so, by a name or an extension.
    pub fn by_name(name: &str) -> Result<TargetFormat, ReportError> {
        match DrawingFormat::by_name(name) {
            Some(drawing) => Ok(TargetFormat::Drawing(drawing)),
            None => Ok(TargetFormat::Format(formats::writer_named(name).map_err(with_drawings)?)),
        }
    }

    /// The one of a file by its extension, or by `to` where that goes with the extension or the extension says
    /// nothing.
    pub fn from_path(path: &Path, to: Option<&str>) -> Result<TargetFormat, ReportError> {
        let by_ending = match DrawingFormat::from_path(path) {
            Some(drawing) => Ok(TargetFormat::Drawing(drawing)),
            None => formats::writer_for_path(path).map(TargetFormat::Format),
        };
        let Some(to) = to else { return by_ending.map_err(|e| with_drawings(e).into()) };
        let asked = TargetFormat::by_name(to)?;
        match by_ending {
            Ok(own) if !asked.has_extension(path) => Err(ReportError::OtherEnding {
                file: display_name(path),
                own: own.name(),
                asked: asked.name(),
                to: to.into(),
            }),
            _ => Ok(asked),
        }
    }

    /// The one of a stream: by `to`; without that by its name's extension, which a pipe may have; else the
    /// usual one.
    pub fn for_stream(path: &Path, to: Option<&str>, usual: &str) -> Result<TargetFormat, ReportError> {
        match to {
            Some(to) => TargetFormat::by_name(to),
            None => TargetFormat::from_path(path, None).or_else(|_| TargetFormat::by_name(usual)),
        }
    }

    /// Its name in a sentence.
    fn name(self) -> String {
        match self {
            TargetFormat::Format(format) => format.name.into(),
            TargetFormat::Drawing(_) => format!("a diagram in {}", self.extension()),
        }
    }

    fn has_extension(self, path: &Path) -> bool {
        let extension = path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
        match self {
            TargetFormat::Format(format) => format.extensions.contains(&&*extension),
            TargetFormat::Drawing(_) => self.extension() == extension,
        }
    }

    /// The usual extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            TargetFormat::Format(format) => format.extensions.first().copied().unwrap_or(format.name),
            TargetFormat::Drawing(drawing) => drawing.extension(),
        }
    }

    /// The bytes of a file of the stone; what had no room in it is among the remarks.
    ///
    /// - `material`: what it is of, if that was asked for
    pub fn encoded(
        self,
        design: &Design,
        material: Option<&Material>,
        paper: Paper,
    ) -> Result<Encoded, ReportError> {
        match self {
            TargetFormat::Format(format) => Ok(formats::encode_as(design, material, format.name)?),
            TargetFormat::Drawing(drawing) => {
                let index = material.map(Material::index_d).or(design.refractive_index);
                let svg = diagram::draw_on(design, index, paper)?;
                let width = (DOTS_PER_MM * paper.size_mm().x).round() as u32;
                Ok(Encoded { bytes: drawing.bytes(svg, width, None)?, remarks: Vec::new() })
            }
        }
    }
}

/// The same error with the extensions of diagrams among those that are written.
fn with_drawings(error: FormatError) -> FormatError {
    match error {
        FormatError::NoWriter { asked, mut known } => {
            known.extend(DrawingFormat::ALL.map(|(name, _)| name));
            FormatError::NoWriter { asked, known }
        }
        error => error,
    }
}
