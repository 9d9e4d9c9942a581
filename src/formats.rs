//! Local stand-in until branch `formats` lands.
pub mod stone;
use crate::cut::{Design, document::Document};
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct FormatError(pub String);
pub fn write(design: &Design, path: &std::path::Path) -> Result<(), FormatError> {
    crate::store::replace::write(path, Document::of(design).text().as_bytes())
        .map_err(|e| FormatError(e.to_string()))
}
