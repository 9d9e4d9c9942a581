//! Input files: those that a folder, or a pattern of file names, stands for.

use super::stone;
use crate::batch::sidecar::TableMeta;
use crate::cli::exit_code::CliError;
use crate::cli::limits::limits;
use crate::formats;
use crate::stone::StoneSpec;
use globset::{GlobBuilder, GlobMatcher};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

/// Every file below `folder`, in the order of their names, but for hidden ones: they are someone's
/// notes, or a file in the making. Links to folders are not followed: they may lead round in a circle.
///
/// - `skipped`: a folder, in canonical form, that is not searched
///
/// A folder below that cannot be listed is given in place of its files: whoever reads it says why not.
pub fn files(folder: &Path, skipped: Option<&Path>) -> Result<Vec<PathBuf>, CliError> {
    let fail = |cause: std::io::Error| CliError::reading(&stone::display_name(folder), &cause);
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
pub fn expanded(arguments: &[OsString]) -> Result<Vec<OsString>, CliError> {
    let mut all = Vec::new();
    for argument in arguments {
        let spec = StoneSpec::parse_within(argument, limits())?;
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

/// The tables that `merge` joins: of what a pattern matches, neither sidecars nor whole tables.
pub fn parts(arguments: &[OsString]) -> Result<Vec<PathBuf>, CliError> {
    let is_whole = |table: &Path| {
        TableMeta::read(&TableMeta::find_for(table), limits()).is_ok_and(|meta| meta.shard.is_none())
    };
    let mut all = Vec::new();
    for argument in arguments {
        if is_pattern(argument) {
            let mut found = matching(argument)?;
            found.retain(|table| !TableMeta::is_sidecar(table) && !is_whole(table));
            if found.is_empty() {
                let pattern = stone::display_name(argument);
                return Err(CliError::input(format!("no part of a table matches {pattern}")));
            }
            all.extend(found);
        } else {
            all.push(argument.into());
        }
    }
    Ok(all)
}

/// Whether an argument is a pattern of file names, and not the name of a file.
fn is_pattern(argument: &OsStr) -> bool {
    has_wildcard(argument) && fs::symlink_metadata(argument).is_err()
}

fn has_wildcard(name: &OsStr) -> bool {
    name.as_encoded_bytes().iter().any(|b| b"*?[".contains(b))
}

/// What matches a pattern, by name. `*` and `?` stand for what is no `/`, `**` for folders below; names
/// need not be UTF-8.
fn matching(pattern: &OsStr) -> Result<Vec<PathBuf>, CliError> {
    let shown = stone::display_name(pattern);
    let text = pattern.to_str().ok_or_else(|| CliError::input(format!("{shown}: a pattern is UTF-8")))?;
    let path: PathBuf = Path::new(text).components().collect(); // without `//` and `/./`
    let glob =
        GlobBuilder::new(&path.to_string_lossy()).literal_separator(true).backslash_escape(false).build();
    let broken = |_| {
        let why = "as a pattern of names it has a '[' or a range without its end";
        CliError::input(format!("there is no file '{shown}', and {why}"))
    };
    let glob = glob.map_err(broken)?.compile_matcher();
    let is_plain = |part: &Component| !has_wildcard(part.as_os_str());
    let base: PathBuf = path.components().take_while(is_plain).collect();
    let depth = match text.contains("**") {
        true => usize::MAX,
        false => path.components().skip_while(is_plain).count(),
    };
    let mut found = Vec::new();
    match_below(&base, depth, &glob, &mut found)
        .map_err(|(folder, cause)| CliError::reading(&stone::display_name(&folder), &cause))?;
    found.sort();
    if found.is_empty() { Err(CliError::input(format!("no file matches {shown}"))) } else { Ok(found) }
}

/// Adds what matches in a folder, and up to `depth` folders below it.
fn match_below(
    folder: &Path,
    depth: usize,
    glob: &GlobMatcher,
    found: &mut Vec<PathBuf>,
) -> Result<(), (PathBuf, std::io::Error)> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let fail = |cause| (here.to_owned(), cause);
    let entries = match fs::read_dir(here) {
        Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(()),
        entries => entries.map_err(fail)?,
    };
    for entry in entries {
        let path = folder.join(entry.map_err(fail)?.file_name());
        // links may lead round in a circle, which has an end where the pattern has one
        let goes_on = path.is_dir() && (depth != usize::MAX || !path.is_symlink());
        if goes_on && depth > 1 {
            let below = if depth == usize::MAX { depth } else { depth - 1 };
            match_below(&path, below, glob, found)?;
        }
        if glob.is_match(&path) {
            found.push(path);
        }
    }
    Ok(())
}

/// Whether a file that a folder holds is to be read as a stone: not what cutlab itself writes beside
/// one, nor a table that has its sidecar.
pub fn is_meant_as_stone(file: &Path) -> bool {
    file.is_dir()
        || (!TableMeta::is_sidecar(file)
            && formats::is_meant_as_stone(file, limits())
            && !TableMeta::exists_for(file))
}

/// The designs and meshes in a folder.
fn designs(folder: &Path) -> Result<Vec<OsString>, CliError> {
    let found: Vec<OsString> =
        files(folder, None)?.iter().filter(|f| is_meant_as_stone(f)).map(|f| as_stone(f)).collect();
    if found.is_empty() {
        return Err(CliError::input(format!("no designs and no meshes in {}", stone::display_name(folder))));
    }
    Ok(found)
}

/// The file that a STONE is read from, if it is one.
pub fn file_of(stone: &OsStr) -> Option<PathBuf> {
    StoneSpec::parse_within(stone, limits()).ok()?.file()
}
