//! File access of a scene: files in its own folder or below, so that a stranger's scene opens
//! nothing else.

use super::schema::{FieldError, field_error};
use std::path::{Component, Path, PathBuf};

/// Where files that a scene names are looked for.
#[derive(Debug, Clone)]
pub struct Files {
    /// The scene file's folder.
    pub folder: PathBuf,
    /// Whether they may lie outside that folder.
    pub anywhere: bool,
}

impl Files {
    /// The path of the file called `name`. It need not exist.
    ///
    /// - `key`: of the entry that names it
    pub(super) fn find(&self, key: &'static str, name: &str) -> Result<PathBuf, FieldError> {
        let path = self.folder.join(name);
        if self.anywhere || self.contains(Path::new(name), &path) {
            return Ok(path);
        }
        Err(field_error(
            key,
            format!("{key} = \"{name}\" is outside the scene's folder; --allow-outside lets a scene name it"),
        ))
    }

    /// Whether the path stays in the folder, links followed.
    fn contains(&self, name: &Path, path: &Path) -> bool {
        let here = if self.folder == Path::new("") { Path::new(".") } else { &self.folder };
        let inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
        match (here.canonicalize(), path.canonicalize()) {
            (Ok(folder), Ok(real)) => real.starts_with(folder),
            _ => name.components().all(inside),
        }
    }
}
