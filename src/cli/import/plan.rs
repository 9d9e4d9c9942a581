//! Which files an import takes, and where each is written.

use crate::cli::folders;
use crate::cli::outcome::Failure;
use crate::cli::stones;
use crate::formats;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// One file to be imported.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    /// The file, or a library stone.
    pub stone: String,
    /// Where to write it; `-` is standard output.
    pub target: PathBuf,
    /// Found in a folder and of an ending that no format has: whatever it is, nobody asked for it.
    pub by_chance: bool,
}

/// A stone and its place below the output folder, without ending.
struct Found {
    stone: String,
    below: PathBuf,
    by_chance: bool,
}

/// The jobs of an import into the folder `output`, folders taken with all that is in them.
///
/// Files that would be written to one place get their own ending into their names: `a.asc` and
/// `a.gem` become `a-asc.glb` and `a-gem.glb`. The output folder itself is not searched.
pub fn into_folder(arguments: &[String], output: &Path, ending: &str) -> Result<Vec<Job>, Failure> {
    let skipped = output.canonicalize().ok();
    let mut found = Vec::new();
    for argument in arguments {
        let path = Path::new(argument);
        if path.is_dir() {
            for file in folders::files(path, skipped.as_deref())? {
                let below = file.strip_prefix(path).unwrap_or(&file).with_extension("");
                let by_chance = !formats::has_known_ending(&file);
                found.push(Found { stone: folders::as_stone(&file), below, by_chance });
            }
        } else {
            let below = stones::file_stem(argument).into();
            found.push(Found { stone: argument.clone(), below, by_chance: false });
        }
    }
    let mut wanted: HashMap<PathBuf, usize> = HashMap::new();
    found.iter().filter(|f| !f.by_chance).for_each(|f| *wanted.entry(f.below.clone()).or_default() += 1);
    let job = |f: Found| {
        let shared = f.by_chance || wanted.get(&f.below).is_some_and(|n| *n > 1);
        let own = Path::new(&f.stone).extension().filter(|_| shared);
        let mut name = f.below.into_os_string();
        for (between, part) in [("-", own), (".", Some(ending.as_ref()))] {
            if let Some(part) = part {
                name.push(between);
                name.push(part);
            }
        }
        Job { stone: f.stone, target: output.join(name), by_chance: f.by_chance }
    };
    Ok(found.into_iter().map(job).collect())
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
        for name in ["a.asc", "a.gem", "deep/b.obj", "deep/out/c.obj", "notes.md", "a.md"] {
            fs::write(folder.join(name), "x").expect("writes");
        }
        let output = folder.join("deep/out");
        let jobs = into_folder(&[folder.display().to_string()], &output, "glb").expect("plans");
        let named: Vec<_> = jobs
            .iter()
            .map(|j| (j.target.strip_prefix(&output).expect("inside").display().to_string(), j.by_chance))
            .collect();
        let expected = [
            ("a-asc.glb", false),
            ("a-gem.glb", false),
            ("a-md.glb", true),
            ("deep/b.glb", false),
            ("notes-md.glb", true),
        ];
        assert_eq!(named, expected.map(|(n, c)| (n.to_string(), c)));
        assert!(
            into_folder(&["x/y.asc".into()], &output, "glb").expect("plans")[0].target.ends_with("y.glb")
        );
    }
}
