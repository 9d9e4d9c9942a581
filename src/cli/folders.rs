//! Which files a folder, or a pattern of file names, stands for.

use super::outcome::Failure;
use super::stones::{self, Spec};
use crate::formats;
use crate::store::place::FileId;
use crate::study::meta::Meta;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};

/// Every file below `folder`, in the order of their names, but for hidden ones: they are someone's
/// notes, or a file in the making. Links to folders are not followed: they may lead round in a circle.
///
/// - `skipped`: a folder, in canonical form, that is not searched
///
/// A folder below that cannot be listed is given in place of its files: whoever reads it says why not.
pub fn files(folder: &Path, skipped: Option<&Path>) -> Result<Vec<PathBuf>, Failure> {
    let fail = |cause: std::io::Error| Failure::reading(&folder.display().to_string(), &cause);
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
                match files(&path, skipped) {
                    Ok(below) => found.extend(below),
                    Err(_) => found.push(path),
                }
            }
        } else if path.is_file() {
            found.push(path);
        }
    }
    Ok(found)
}

/// The STONE that a file is: a file with the name of a cut is meant as the file.
pub fn as_stone(file: &Path) -> OsString {
    if file.components().count() == 1 { Path::new(".").join(file).into() } else { file.into() }
}

/// The stones of a command: folders replaced by their designs and meshes, patterns (`*.asc`) by what
/// they match. What is in a folder and is no stone is passed over.
pub fn expanded(arguments: &[OsString]) -> Result<Vec<OsString>, Failure> {
    let mut all = Vec::new();
    for argument in arguments {
        let spec = Spec::of(argument)?;
        let name = spec.base();
        let mut found = Vec::new();
        if is_pattern(name) {
            for path in matching(name)? {
                if path.is_dir() { found.extend(designs(&path)?) } else { found.push(as_stone(&path)) }
            }
        } else if Path::new(name).is_dir() {
            found.extend(designs(Path::new(name))?);
        } else {
            all.push(argument.clone());
        }
        all.extend(found.into_iter().map(|file| spec.applied_to(file)));
    }
    Ok(all)
}

/// The tables that `merge` joins into `output`: what a pattern matches, without companions and without
/// the whole that an earlier merge made.
pub fn parts(arguments: &[OsString], output: &Path) -> Result<Vec<PathBuf>, Failure> {
    let is_whole = |table: &PathBuf| {
        let is_output = FileId::of(table).is_some() && FileId::of(table) == FileId::of(output);
        is_output && Meta::read(&Meta::found_beside(table)).is_ok_and(|meta| meta.shard.is_none())
    };
    let mut all = Vec::new();
    for argument in arguments {
        if is_pattern(argument) {
            let found = matching(argument)?.into_iter();
            all.extend(found.filter(|table| !Meta::is_companion(table) && !is_whole(table)));
        } else {
            all.push(argument.into());
        }
    }
    Ok(all)
}

/// Whether an argument is a pattern of file names, and not the name of a file.
fn is_pattern(argument: &OsStr) -> bool {
    let has_wildcard = argument.as_encoded_bytes().iter().any(|b| b"*?[".contains(b));
    has_wildcard && fs::symlink_metadata(argument).is_err()
}

/// What matches a pattern, by name.
fn matching(pattern: &OsStr) -> Result<Vec<PathBuf>, Failure> {
    let shown = stones::shown(pattern);
    let text = pattern.to_str().ok_or_else(|| Failure::input(format!("{shown}: a pattern is UTF-8")))?;
    let paths = glob::glob(text).map_err(|e| Failure::input(format!("{shown}: {e}")))?;
    let fail = |e: glob::GlobError| Failure::reading(&e.path().display().to_string(), e.error());
    let found: Vec<PathBuf> = paths.collect::<Result<_, _>>().map_err(fail)?;
    if found.is_empty() { Err(Failure::input(format!("no file matches {shown}"))) } else { Ok(found) }
}

/// Whether a file that a folder holds is to be read as a stone: not what cutlab itself writes beside
/// one, nor a table that has its companion.
pub fn is_meant_as_stone(file: &Path) -> bool {
    file.is_dir() || (!Meta::is_companion(file) && formats::is_meant_as_stone(file) && !Meta::is_beside(file))
}

/// The designs and meshes in a folder.
fn designs(folder: &Path) -> Result<Vec<OsString>, Failure> {
    let found: Vec<OsString> =
        files(folder, None)?.iter().filter(|f| is_meant_as_stone(f)).map(|f| as_stone(f)).collect();
    if found.is_empty() {
        return Err(Failure::input(format!("no designs and no meshes in {}", folder.display())));
    }
    Ok(found)
}

/// The file that a STONE is read from, if it is one.
pub fn file_of(stone: &OsStr) -> Option<PathBuf> {
    let spec = Spec::of(stone).ok()?;
    let path = PathBuf::from(spec.base());
    (!stones::is_cut(spec.base()) && path.is_file()).then_some(path)
}
