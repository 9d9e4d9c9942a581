//! What a stone is written as: a format, or the cutting diagram.

use super::args::stone;
use super::diagram_output::{self, DiagramFormat};
use super::error::CliError;
use crate::design::Design;
use crate::formats::{self, Encoded, Format, FormatError};
use crate::materials::Material;
use crate::report::diagram::Paper;
use std::path::Path;

/// A format or a drawing.
#[derive(Clone, Copy)]
pub enum TargetFormat {
    /// Of a design or a mesh.
    Format(&'static Format),
    /// The cutting diagram.
    Drawing(DiagramFormat),
}

impl TargetFormat {
    /// The one that is called so, by a name or an extension.
    pub fn by_name(name: &str) -> Result<TargetFormat, CliError> {
        match DiagramFormat::by_name(name) {
            Some(drawing) => Ok(TargetFormat::Drawing(drawing)),
            None => Ok(TargetFormat::Format(formats::writer_named(name).map_err(with_drawings)?)),
        }
    }

    /// The one of a file by its extension, or by `--to` where that goes with the extension or the extension says
    /// nothing.
    pub fn from_path(path: &Path, to: Option<&str>) -> Result<TargetFormat, CliError> {
        let by_ending = match DiagramFormat::from_path(path) {
            Some(drawing) => Ok(TargetFormat::Drawing(drawing)),
            None => formats::writer_for_path(path).map(TargetFormat::Format),
        };
        let Some(to) = to else { return by_ending.map_err(|e| with_drawings(e).into()) };
        let asked = TargetFormat::by_name(to)?;
        match by_ending {
            Ok(own) if !asked.has_extension(path) => Err(CliError::input(format!(
                "{} is {} by its ending, not {}: leave out --to {to}, or name another file",
                stone::display_name(path),
                own.name(),
                asked.name()
            ))),
            _ => Ok(asked),
        }
    }

    /// The one of a stream: by `--to`; without that by its name's extension, which a pipe may have; else the
    /// usual one.
    pub fn for_stream(path: &Path, to: Option<&str>, usual: &str) -> Result<TargetFormat, CliError> {
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
            TargetFormat::Drawing(DiagramFormat::Svg) => "svg",
            TargetFormat::Drawing(DiagramFormat::Pdf) => "pdf",
            TargetFormat::Drawing(DiagramFormat::Png) => "png",
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
    ) -> Result<Encoded, CliError> {
        match self {
            TargetFormat::Format(format) => Ok(formats::encode_as(design, material, format.name)?),
            TargetFormat::Drawing(drawing) => {
                let index = material.map(Material::index_d).or(design.refractive_index);
                Ok(Encoded { bytes: drawing.bytes(design, index, paper)?, remarks: Vec::new() })
            }
        }
    }
}

/// The same error with the extensions of diagrams among those that are written.
fn with_drawings(error: FormatError) -> FormatError {
    match error {
        FormatError::NoWriter { asked, mut known } => {
            known.extend(diagram_output::EXTENSIONS);
            FormatError::NoWriter { asked, known }
        }
        error => error,
    }
}
