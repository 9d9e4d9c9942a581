//! Stones in files that are not named one by one: of folders, and of patterns of names.

use super::sidecar::TableMeta;
use crate::formats;
use crate::limits::Limits;
use crate::stone::{StoneError, StoneSpec};
use crate::storage::find_files;
use crate::storage::text::display_name;
use std::ffi::{OsStr, OsString};
use std::path::Path;

/// Stones one by one: a folder is replaced by the designs and meshes in it and in the folders below, a
/// pattern (`designs/*.asc`, `**/*.gem`) by what it matches; every other STONE stays as it is. A material after the
/// colon is that of each.
///
/// Files of one argument come in the order of their names. Of a folder, hidden files are passed over and so is what
/// is no stone: tables of scores with their sidecars, notes, scenes, settings of other programs. A design that is
/// damaged is a stone that does not open. Links to folders are not followed below a folder.
///
/// - `limits`: on files that are read to tell whether they are stones
///
/// It is an error if a folder has no stone, or a pattern no match.
///
/// ```
/// use cutlab::{Limits, Stone, StoneOptions, expand_stones};
///
/// let stones = expand_stones(["tolkowsky", "cuts/e*.toml:material=topaz"], Limits::default())?;
/// assert_eq!(stones[1], "cuts/emerald.toml:material=topaz");
/// for stone in &stones[1..] {
///     assert_eq!(Stone::open(stone, &StoneOptions::default())?.material().name, "topaz");
/// }
/// # Ok::<(), cutlab::Error>(())
/// ```
pub fn expand_stones<S: AsRef<OsStr>>(
    stones: impl IntoIterator<Item = S>,
    limits: Limits,
) -> Result<Vec<OsString>, StoneError> {
    let mut all = Vec::new();
    for stone in stones {
        let stone = stone.as_ref();
        let spec = StoneSpec::parse_within(stone, limits)?;
        let name = spec.base();
        let mut found = Vec::new();
        if find_files::is_pattern(name) {
            for path in find_files::matching(name)? {
                if path.is_dir() {
                    found.extend(designs(&path, limits)?)
                } else {
                    found.push(as_stone(&path))
                }
            }
        } else if Path::new(name).is_dir() {
            found.extend(designs(Path::new(name), limits)?);
        } else {
            all.push(stone.to_owned());
        }
        all.extend(found.into_iter().map(|file| spec.applied_to(file)));
    }
    Ok(all)
}

/// The designs and meshes in a folder.
fn designs(folder: &Path, limits: Limits) -> Result<Vec<OsString>, StoneError> {
    let files = find_files::below(folder, None)?;
    let found: Vec<OsString> =
        files.iter().filter(|file| is_meant_as_stone(file, limits)).map(|file| as_stone(file)).collect();
    if found.is_empty() {
        return Err(StoneError::NoStones { place: display_name(folder) });
    }
    Ok(found)
}

/// Whether a file that a folder holds is to be read as a stone: not what cutlab itself writes beside
/// one, nor a table that has its sidecar. A folder that could not be listed is, so that reading it says why.
pub fn is_meant_as_stone(file: &Path, limits: Limits) -> bool {
    file.is_dir()
        || (!TableMeta::is_sidecar(file)
            && formats::is_meant_as_stone(file, limits)
            && !TableMeta::exists_for(file))
}

/// The STONE that a file is: a file with the name of a cut is meant as the file.
pub fn as_stone(file: &Path) -> OsString {
    if file.components().count() == 1 { Path::new(".").join(file).into() } else { file.into() }
}
