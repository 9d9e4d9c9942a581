//! Which files a folder, or a pattern of file names, stands for.

use super::outcome::Failure;
use super::stones;
use crate::formats::stone::{self, STANDARD_INPUT};
use crate::formats::{self, FormatError};
use std::fs;
use std::path::{Path, PathBuf};

/// Every file below `folder`, in the order of their names, but for hidden ones: they are someone's
/// notes, or a file in the making. Links to folders are not followed: they may lead round in a circle.
///
/// - `skipped`: a folder, in canonical form, that is not searched
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
                found.extend(files(&path, skipped)?);
            }
        } else if path.is_file() {
            found.push(path);
        }
    }
    Ok(found)
}

/// The STONE that a file is: a file with the name of a cut is meant as the file.
pub fn as_stone(file: &Path) -> String {
    let here = Path::new(".").join(file);
    if file.components().count() == 1 { here.display().to_string() } else { file.display().to_string() }
}

/// The stones of a command: folders replaced by their designs and meshes, patterns (`*.asc`) by what
/// they match. What is in a folder and of no format is passed over.
pub fn expanded(arguments: &[String]) -> Result<Vec<String>, Failure> {
    let mut all = Vec::new();
    for argument in arguments {
        if is_pattern(argument) {
            for found in matching(argument)? {
                if found.is_dir() { all.extend(designs(&found)?) } else { all.push(as_stone(&found)) }
            }
        } else if Path::new(argument).is_dir() {
            all.extend(designs(Path::new(argument))?);
        } else {
            all.push(argument.clone());
        }
    }
    Ok(all)
}

/// Files, with patterns replaced by what they match.
pub fn matched(arguments: &[String]) -> Result<Vec<PathBuf>, Failure> {
    let each = |a: &String| if is_pattern(a) { matching(a) } else { Ok(vec![PathBuf::from(a)]) };
    Ok(arguments.iter().map(each).collect::<Result<Vec<_>, _>>()?.concat())
}

/// Whether an argument is a pattern of file names, and not the name of a file.
fn is_pattern(argument: &str) -> bool {
    argument.contains(['*', '?', '[']) && fs::symlink_metadata(argument).is_err()
}

/// What matches a pattern, by name.
fn matching(pattern: &str) -> Result<Vec<PathBuf>, Failure> {
    let paths = glob::glob(pattern).map_err(|e| Failure::input(format!("{pattern}: {e}")))?;
    let fail = |e: glob::GlobError| Failure::reading(&e.path().display().to_string(), e.error());
    let found: Vec<PathBuf> = paths.collect::<Result<_, _>>().map_err(fail)?;
    if found.is_empty() { Err(Failure::input(format!("no file matches {pattern}"))) } else { Ok(found) }
}

/// The designs and meshes in a folder.
fn designs(folder: &Path) -> Result<Vec<String>, Failure> {
    let is_design = |file: &PathBuf| {
        let none = |e| {
            matches!(
                e,
                FormatError::Unrecognised { .. } | FormatError::TooLarge { .. } | FormatError::Empty { .. }
            )
        };
        formats::has_known_ending(file) || !stone::open(&as_stone(file)).is_err_and(none)
    };
    let found: Vec<String> =
        files(folder, None)?.iter().filter(|f| is_design(f)).map(|f| as_stone(f)).collect();
    if found.is_empty() {
        return Err(Failure::input(format!("no designs and no meshes in {}", folder.display())));
    }
    Ok(found)
}

/// The file that a STONE is read from, if it is one.
pub fn file_of(stone: &str) -> Option<&Path> {
    Some(Path::new(stone)).filter(|path| stone != STANDARD_INPUT && !stones::is_cut(stone) && path.is_file())
}
