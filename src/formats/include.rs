//! Included files, those that a file refers to: only from its own folder or below, and only so large.

use super::input::Input;
use super::{FormatError, read_file};
use crate::storage::text;
use std::path::{Component, Path};

/// The bytes of the file called `reference` in the source's folder; none if the reference leads
/// out of that folder (absolute, `..`, a link that points outside, a URL) or there is no folder.
pub fn fetch(source: &Input, reference: &str) -> Option<Result<Vec<u8>, FormatError>> {
    let folder = match source.folder? {
        here if here == Path::new("") => Path::new("."),
        folder => folder,
    };
    let relative = Path::new(reference);
    let inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    if reference.contains("://") || reference.contains('\\') || !relative.components().all(inside) {
        return None;
    }
    let path = folder.join(relative);
    match (folder.canonicalize(), path.canonicalize()) {
        (Ok(folder), Ok(real)) if !real.starts_with(&folder) => None,
        (_, Err(cause)) => Some(Err(FormatError::Read { file: text::display_name(path), cause })),
        _ => Some(read_file(&path, source.limits)),
    }
}
