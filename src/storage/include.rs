//! Files that a file names: only from its own folder or below, so that a stranger's file opens nothing else.

use super::{bounded_read, text};
use crate::limits::{self, Limits};
use std::io::Error;
use std::path::{Component, Path, PathBuf};

/// The path of the file called `reference` beside a file of `folder`; none if the reference leads out of the
/// folder (absolute, `..`, a link that points outside, a URL).
pub fn resolve(folder: &Path, reference: &str) -> Option<Result<PathBuf, (PathBuf, Error)>> {
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    let relative = Path::new(reference);
    let inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    if reference.contains("://") || reference.contains('\\') || !relative.components().all(inside) {
        return None;
    }
    let path = folder.join(relative);
    match (folder.canonicalize(), path.canonicalize()) {
        (Ok(folder), Ok(real)) if !real.starts_with(&folder) => None,
        (_, Err(cause)) => Some(Err((path, cause))),
        _ => Some(Ok(path)),
    }
}

/// The text of the data file at `path`, in lines that end in LF, or why there is none.
///
/// - `regular`: whether only a regular file is read, as for one that a file names
pub fn read_text(path: &Path, regular: bool, limits: Limits) -> Result<String, String> {
    let limit = &limits::SPECTRUM;
    let read = match regular {
        true => bounded_read::read_regular(path, limits, limit),
        false => bounded_read::read(path, limits, limit),
    };
    let bytes = read.map_err(|cause| format!("cannot be read: {cause}"))?.map_err(|e| e.to_string())?;
    Ok(text::decode_lines(&bytes).into_owned())
}

/// The text of the table that a data file of `folder` names, or why there is none.
pub fn read_table(folder: &Path, reference: &str, limits: Limits) -> Result<String, String> {
    match resolve(folder, reference) {
        None => Err("it is outside the file's folder".into()),
        Some(Err((_, cause))) => Err(format!("cannot be read: {cause}")),
        Some(Ok(path)) => read_text(&path, true, limits),
    }
}
