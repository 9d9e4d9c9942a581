//! What a stone is written as: a format, or the cutting diagram.

use super::drawing::{self, Drawing};
use super::outcome::Failure;
use super::stones;
use crate::cut::Design;
use crate::formats::{self, Encoded, Format, FormatError};
use crate::optics::Material;
use crate::report::diagram::Paper;
use std::path::Path;

/// A format or a drawing.
#[derive(Clone, Copy)]
pub enum Form {
    /// Of a design or a mesh.
    Format(&'static Format),
    /// The cutting diagram.
    Drawing(Drawing),
}

impl Form {
    /// The one that is called so, by a name or an ending.
    pub fn named(name: &str) -> Result<Form, Failure> {
        match Drawing::named(name) {
            Some(drawing) => Ok(Form::Drawing(drawing)),
            None => Ok(Form::Format(formats::written_as(name).map_err(with_drawings)?)),
        }
    }

    /// The one of a file by its ending, or by `--to` where that goes with the ending or the ending says
    /// nothing.
    pub fn of(path: &Path, to: Option<&str>) -> Result<Form, Failure> {
        let by_ending = match Drawing::of(path) {
            Some(drawing) => Ok(Form::Drawing(drawing)),
            None => formats::written_to(path).map(Form::Format),
        };
        let Some(to) = to else { return by_ending.map_err(|e| with_drawings(e).into()) };
        let asked = Form::named(to)?;
        match by_ending {
            Ok(own) if !asked.has_ending(path) => Err(Failure::input(format!(
                "{} is {} by its ending, not {}: leave out --to {to}, or name another file",
                stones::shown(path),
                own.name(),
                asked.name()
            ))),
            _ => Ok(asked),
        }
    }

    /// The one of a stream: by `--to`; without that by its name's ending, which a pipe may have; else the
    /// usual one.
    pub fn for_stream(path: &Path, to: Option<&str>, usual: &str) -> Result<Form, Failure> {
        match to {
            Some(to) => Form::named(to),
            None => Form::of(path, None).or_else(|_| Form::named(usual)),
        }
    }

    /// Its name in a sentence.
    fn name(self) -> String {
        match self {
            Form::Format(format) => format.name.into(),
            Form::Drawing(_) => format!("a diagram in {}", self.ending()),
        }
    }

    fn has_ending(self, path: &Path) -> bool {
        let ending = path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
        match self {
            Form::Format(format) => format.extensions.contains(&&*ending),
            Form::Drawing(_) => self.ending() == ending,
        }
    }

    /// The usual ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            Form::Format(format) => format.extensions.first().copied().unwrap_or(format.name),
            Form::Drawing(Drawing::Svg) => "svg",
            Form::Drawing(Drawing::Pdf) => "pdf",
            Form::Drawing(Drawing::Png) => "png",
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
    ) -> Result<Encoded, Failure> {
        match self {
            Form::Format(format) => Ok(formats::encode_as(design, material, format.name)?),
            Form::Drawing(drawing) => {
                let index = material.map(Material::index_d).or(design.refractive_index);
                Ok(Encoded { bytes: drawing.bytes(design, index, paper)?, remarks: Vec::new() })
            }
        }
    }
}

/// The same error with the endings of diagrams among those that are written.
fn with_drawings(error: FormatError) -> FormatError {
    match error {
        FormatError::NoWriter { asked, mut known } => {
            known.extend(drawing::ENDINGS);
            FormatError::NoWriter { asked, known }
        }
        error => error,
    }
}
