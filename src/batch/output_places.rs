//! Places for files that are made of many stones, one each: no two the same.

use super::stone_files;
use crate::limits::Limits;
use crate::stone::{StoneError, grammar};
use crate::storage::find_files;
use crate::storage::text::display_name;
use std::collections::{HashMap, HashSet};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// A stone, and the file that is made of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    /// The STONE.
    pub stone: OsString,
    /// Where to write it; `-` is standard output.
    pub target: PathBuf,
    /// Found in a folder and no stone by its extension or content: nobody asked for it.
    pub by_chance: bool,
}

/// A stone and its place below the output folder, without extension.
struct FoundStone {
    stone: OsString,
    below: PathBuf,
    /// The name of the folder that it lies in, if that is not part of `below`.
    folder: Option<OsString>,
    by_chance: bool,
}

impl FoundStone {
    /// The place with more and more of the stone's own name in it: alone, with its extension, with its
    /// folder before it.
    fn name(&self, detail: u32) -> PathBuf {
        let with = |parts: [Option<&OsStr>; 3]| {
            let mut name = OsString::new();
            for part in parts.into_iter().flatten() {
                if !name.is_empty() {
                    name.push("-");
                }
                name.push(part);
            }
            self.below.with_file_name(name)
        };
        let stem = self.below.file_name();
        let extension = Path::new(&self.stone).extension();
        match detail {
            0 => self.below.clone(),
            1 => with([stem, extension, None]),
            2 => with([self.folder.as_deref(), stem, extension]),
            n => with([stem, extension, Some((n - 1).to_string().as_ref())]),
        }
    }
}

/// The files that are made of stones in the folder `output`, folders taken with all that is in them.
///
/// No two jobs write to one place, also where capitals make no difference. Files that would get as
/// much as needed of their own names into it: `a.asc` and `a.gem` become `a-asc.glb` and `a-gem.glb`,
/// `x/a.asc` and `y/a.asc` become `x-a-asc.glb` and `y-a-asc.glb`; what is then left gets a number. A
/// stone that is named twice is taken once. The output folder itself is not searched.
///
/// - `extension`: of all files that are made
/// - `limits`: on files that are read to tell whether they are stones
pub fn into_folder(
    arguments: &[OsString],
    output: &Path,
    extension: &str,
    limits: Limits,
) -> Result<Vec<Job>, StoneError> {
    let skipped = output.canonicalize().ok();
    let mut found: Vec<FoundStone> = Vec::new();
    for argument in arguments {
        let path = Path::new(argument);
        if path.is_dir() {
            for file in find_files::below(path, skipped.as_deref())? {
                let below = file.strip_prefix(path).unwrap_or(&file).with_extension("");
                let by_chance = !stone_files::is_meant_as_stone(&file, limits);
                found.push(FoundStone {
                    stone: stone_files::as_stone(&file),
                    below,
                    folder: None,
                    by_chance,
                });
            }
        } else {
            let folder = path.parent().and_then(Path::file_name).map(OsStr::to_owned);
            let below = grammar::file_stem(argument).into();
            found.push(FoundStone { stone: argument.clone(), below, folder, by_chance: false });
        }
    }
    let mut seen = HashSet::new();
    found.retain(|f| seen.insert(f.stone.clone()));
    let places = places(&found);
    let job = |(f, place): (FoundStone, PathBuf)| {
        let mut name = place.into_os_string();
        name.push(".");
        name.push(extension);
        Job { stone: f.stone, target: output.join(name), by_chance: f.by_chance }
    };
    Ok(found.into_iter().zip(places).map(job).collect())
}

/// A name for each stone, no two the same.
pub fn places_of(stones: &[OsString]) -> Vec<PathBuf> {
    let found = |stone: &OsString| {
        let folder = Path::new(stone).parent().and_then(Path::file_name).map(OsStr::to_owned);
        FoundStone { stone: stone.clone(), below: grammar::file_stem(stone).into(), folder, by_chance: false }
    };
    places(&stones.iter().map(found).collect::<Vec<_>>())
}

/// A place for each, no two the same: each has the shortest name that no other would have as well.
fn places(found: &[FoundStone]) -> Vec<PathBuf> {
    let key = |name: &Path| display_name(name).to_lowercase();
    let mut places: Vec<Option<PathBuf>> = found.iter().map(|f| f.by_chance.then(|| f.name(1))).collect();
    let mut taken: HashSet<String> = HashSet::new();
    let mut detail = 0;
    while places.iter().any(Option::is_none) {
        let mut wanted: HashMap<String, usize> = HashMap::new();
        let waiting = || found.iter().zip(&places).filter(|(_, place)| place.is_none());
        waiting().for_each(|(f, _)| *wanted.entry(key(&f.name(detail))).or_default() += 1);
        for (f, place) in found.iter().zip(&mut places).filter(|(_, place)| place.is_none()) {
            let name = f.name(detail);
            let alone = wanted.get(&key(&name)).is_some_and(|n| *n == 1);
            // numbers go to one after the other
            if (alone || detail > 2) && taken.insert(key(&name)) {
                *place = Some(name);
            }
        }
        detail += 1;
    }
    places.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn folders_are_searched_and_no_two_files_share_a_place() {
        let top = tempfile::tempdir().expect("a temporary folder");
        let folder = top.path().join("in");
        fs::create_dir_all(folder.join("deep/out")).expect("makes");
        for name in
            ["a.asc", "a.gem", "a-asc.obj", "deep/b.obj", "deep/out/c.obj", "notes.md", "a.md", "A.stl"]
        {
            fs::write(folder.join(name), "x").expect("writes");
        }
        let output = folder.join("deep/out");
        let jobs = into_folder(&[folder.clone().into()], &output, "glb", Limits::default()).expect("plans");
        let named: Vec<_> = jobs
            .iter()
            .map(|j| (j.target.strip_prefix(&output).expect("inside").display().to_string(), j.by_chance))
            .collect();
        let expected = [
            ("A-stl.glb", false),
            ("a-asc.glb", false), // of a-asc.obj
            ("a-asc-2.glb", false),
            ("a-gem.glb", false),
            ("a-md.glb", true),
            ("deep/b.glb", false),
            ("notes-md.glb", true),
        ];
        assert_eq!(named, expected.map(|(n, c)| (n.to_string(), c)));
    }

    #[test]
    fn stones_of_one_name_are_told_apart_by_their_folders_then_by_numbers() {
        let plan = |arguments: &[&str]| {
            let arguments: Vec<OsString> = arguments.iter().map(OsString::from).collect();
            let jobs = into_folder(&arguments, Path::new("o"), "glb", Limits::default()).expect("plans");
            jobs.iter().map(|j| j.target.display().to_string()).collect::<Vec<_>>()
        };
        assert_eq!(plan(&["x/y.asc"]), ["o/y.glb"]);
        assert_eq!(plan(&["x/s.asc", "y/s.asc"]), ["o/x-s-asc.glb", "o/y-s-asc.glb"]);
        assert_eq!(plan(&["a/x/s.asc", "b/x/s.asc"]), ["o/s-asc-2.glb", "o/s-asc-3.glb"]);
        assert_eq!(plan(&["s.asc", "s.asc", "S.ASC"]), ["o/s-asc-2.glb", "o/S-ASC-3.glb"]);
        assert_eq!(plan(&["oval:table=50", "oval:table=55", "oval"]).len(), 3);
    }
}
