//! Files that nobody names one by one: those below a folder, and those whose names match a pattern.

use super::text::display_name;
use globset::{GlobBuilder, GlobMatcher};
use std::ffi::OsStr;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

/// Files that could not be found.
#[derive(Debug, thiserror::Error)]
pub enum FindError {
    /// A folder that cannot be listed.
    #[error("cannot read {}: {cause}", display_name(.folder))]
    Read {
        /// The folder.
        folder: PathBuf,
        /// What the operating system said.
        cause: std::io::Error,
    },
    /// A pattern that is not UTF-8.
    #[error("{0}: a pattern is UTF-8")]
    NotUtf8(String),
    /// A pattern that breaks off.
    #[error("there is no file '{0}', and as a pattern of names it has a '[' or a range without its end")]
    Broken(String),
    /// A pattern that no name matches.
    #[error("no file matches {0}")]
    NoMatch(String),
}

/// Every file below `folder`, in the order of their names, but for hidden ones: they are someone's
/// notes, or a file in the making. Links to folders are not followed: they may lead round in a circle.
///
/// - `skipped`: a folder, in canonical form, that is not searched
///
/// A folder below that cannot be listed is given in place of its files: whoever reads it says why not.
pub fn below(folder: &Path, skipped: Option<&Path>) -> Result<Vec<PathBuf>, FindError> {
    let fail = |cause| FindError::Read { folder: folder.to_owned(), cause };
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .map_err(fail)?
        .map(|e| e.map(|e| e.path()))
        .collect::<Result<_, _>>()
        .map_err(fail)?;
    entries.retain(|path| !path.file_name().is_some_and(|n| n.as_encoded_bytes().starts_with(b".")));
    entries.sort();
    let mut found = Vec::new();
    for path in entries {
        let is_link = fs::symlink_metadata(&path).is_ok_and(|m| m.is_symlink());
        if path.is_dir() {
            let is_skipped = skipped.is_some() && path.canonicalize().ok().as_deref() == skipped;
            if !is_link && !is_skipped {
                match below(&path, skipped) {
                    Ok(files) => found.extend(files),
                    Err(_) => found.push(path),
                }
            }
        } else if path.is_file() {
            found.push(path);
        }
    }
    Ok(found)
}

/// Whether a name is a pattern of file names, and not the name of a file.
pub fn is_pattern(name: &OsStr) -> bool {
    has_wildcard(name) && fs::symlink_metadata(name).is_err()
}

fn has_wildcard(name: &OsStr) -> bool {
    name.as_encoded_bytes().iter().any(|b| b"*?[".contains(b))
}

/// What matches a pattern, by name: files and folders, at least one. `*` and `?` stand for what is no `/`,
/// `**` for folders below; names need not be UTF-8.
pub fn matching(pattern: &OsStr) -> Result<Vec<PathBuf>, FindError> {
    let shown = || display_name(pattern);
    let text = pattern.to_str().ok_or_else(|| FindError::NotUtf8(shown()))?;
    let path: PathBuf = Path::new(text).components().collect(); // without `//` and `/./`
    let glob =
        GlobBuilder::new(&path.to_string_lossy()).literal_separator(true).backslash_escape(false).build();
    let glob = glob.map_err(|_| FindError::Broken(shown()))?.compile_matcher();
    let is_plain = |part: &Component| !has_wildcard(part.as_os_str());
    let base: PathBuf = path.components().take_while(is_plain).collect();
    let depth = match text.contains("**") {
        true => usize::MAX,
        false => path.components().skip_while(is_plain).count(),
    };
    let mut found = Vec::new();
    match_below(&base, depth, &glob, &mut found)?;
    found.sort();
    if found.is_empty() { Err(FindError::NoMatch(shown())) } else { Ok(found) }
}

/// Adds what matches in a folder, and up to `depth` folders below it.
fn match_below(
    folder: &Path,
    depth: usize,
    glob: &GlobMatcher,
    found: &mut Vec<PathBuf>,
) -> Result<(), FindError> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let fail = |cause| FindError::Read { folder: here.to_owned(), cause };
    let entries = match fs::read_dir(here) {
        Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(()),
        entries => entries.map_err(fail)?,
    };
    for entry in entries {
        let path = folder.join(entry.map_err(fail)?.file_name());
        // links may lead round in a circle, which has an end where the pattern has one
        let goes_on = path.is_dir() && (depth != usize::MAX || !path.is_symlink());
        if goes_on && depth > 1 {
            let left = if depth == usize::MAX { depth } else { depth - 1 };
            match_below(&path, left, glob, found)?;
        }
        if glob.is_match(&path) {
            found.push(path);
        }
    }
    Ok(())
}
