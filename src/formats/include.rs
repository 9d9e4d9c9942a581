//! Included files, those that a file refers to: only from its own folder or below, and only so large.

use super::input::Input;
use super::{FormatError, read_file};
use crate::storage::{include, text};

/// The bytes of the file called `reference` in the source's folder; none if the reference leads
/// out of that folder ([`include::resolve`]) or there is no folder.
pub fn fetch(source: &Input, reference: &str) -> Option<Result<Vec<u8>, FormatError>> {
    Some(match include::resolve(source.folder?, reference)? {
        Ok(path) => read_file(&path, source.limits),
        Err((path, cause)) => Err(FormatError::Read { file: text::display_name(path), cause }),
    })
}
