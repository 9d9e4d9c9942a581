//! Output paths, checked before the work: what a path leads to, and whether it can be written.

use super::atomic_write::{WriteError, is_stream};
use std::fs::OpenOptions;
use std::io::{Error, ErrorKind};
use std::path::Path;

/// A file's identity in its file system: equal for two paths that lead to one file, through links too.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct FileId(Id);

#[cfg(unix)]
type Id = (u64, u64);
#[cfg(not(unix))]
type Id = std::path::PathBuf;

impl FileId {
    /// The identity of the file that `path` leads to; none if there is no file.
    pub fn from_path(path: &Path) -> Option<FileId> {
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            path.metadata().ok().map(|m| FileId((m.dev(), m.ino())))
        }
        #[cfg(not(unix))]
        path.canonicalize().ok().map(FileId)
    }
}

/// Refuses a place that a file cannot be written to, without writing one: a folder, a link that leads
/// nowhere, a file that is read-only, a folder without permission, a name that is too long.
///
/// Whether there is a file that would be replaced. A stream is neither refused nor a file.
pub fn check_writable(path: &Path) -> Result<bool, WriteError> {
    let fail = |cause: Error| WriteError { path: path.to_owned(), cause };
    if is_stream(path) {
        return Ok(false);
    }
    let link = match path.symlink_metadata() {
        Ok(there) => there.is_symlink(),
        Err(e) if e.kind() == ErrorKind::NotFound => return new(path).map(|()| false).map_err(fail),
        Err(e) => return Err(fail(e)),
    };
    let there = path.metadata().map_err(|e| match e.kind() {
        ErrorKind::NotFound if link => fail(other("it is a link that leads nowhere")),
        _ => fail(e),
    })?;
    if there.is_dir() {
        return Err(fail(other("it is a folder")));
    }
    if there.permissions().readonly() {
        return Err(fail(other("it is read-only")));
    }
    OpenOptions::new().write(true).open(path).map_err(fail)?;
    let target = if link { path.canonicalize().map_err(fail)? } else { path.to_owned() };
    writable(folder_of(&target)).map_err(fail)?;
    Ok(true)
}

/// Refuses a path of which no file can be made, with the folders that it needs.
fn new(path: &Path) -> Result<(), Error> {
    let mut there = path.to_owned();
    let mut missing = Vec::new();
    while there.symlink_metadata().is_err_and(|e| e.kind() == ErrorKind::NotFound) {
        missing.extend(there.file_name().map(ToOwned::to_owned));
        there = folder_of(&there).to_owned();
        if there == Path::new(".") {
            break;
        }
    }
    if !there.is_dir() {
        let what = format!("{} is not a folder", super::text::display_name(there));
        return Err(Error::new(ErrorKind::NotADirectory, what));
    }
    for name in missing {
        match there.join(name).symlink_metadata() {
            Err(e) if e.kind() != ErrorKind::NotFound => return Err(e),
            _ => (),
        }
    }
    writable(&there)
}

/// Whether files can be made in a folder: makes one without a name, which is gone at once.
fn writable(folder: &Path) -> Result<(), Error> {
    tempfile::tempfile_in(folder).map(drop)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn other(what: &str) -> Error {
    Error::other(what.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn said(path: &Path) -> String {
        check_writable(path).expect_err("it cannot be written").cause.to_string()
    }

    #[test]
    fn places_are_tried_and_nothing_is_left_there() {
        let top = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| top.path().join(name);
        fs::write(at("file"), "x").expect("writes");
        assert!(check_writable(&at("file")).expect("can be replaced"));
        assert!(!check_writable(&at("a/b/new")).expect("can be made"));
        assert_eq!(said(top.path()), "it is a folder");
        assert!(said(&at("file/x")).contains("irectory"), "{}", said(&at("file/x")));
        for long in ["x".repeat(300), format!("a/{}/b", "x".repeat(300))] {
            assert!(said(&at(&long)).contains("too long"), "{}", said(&at(&long)));
        }
        let mut locked = fs::metadata(at("file")).expect("is there").permissions();
        locked.set_readonly(true);
        fs::set_permissions(at("file"), locked).expect("locks");
        assert_eq!(said(&at("file")), "it is read-only");
        assert_eq!(fs::read_dir(top.path()).expect("lists").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_to_their_end() {
        use std::os::unix::fs::symlink;
        let top = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| top.path().join(name);
        fs::write(at("file"), "x").expect("writes");
        fs::hard_link(at("file"), at("hard")).expect("links");
        for (target, link) in [("file", "link"), ("nowhere", "dangling"), ("loop", "loop")] {
            symlink(at(target), at(link)).expect("links");
        }
        assert!(check_writable(&at("link")).expect("can be replaced"));
        assert_eq!(said(&at("dangling")), "it is a link that leads nowhere");
        assert!(check_writable(&at("loop")).is_err());
        let id = |name: &str| FileId::from_path(&at(name));
        assert!(id("file").is_some() && id("link") == id("file") && id("hard") == id("file"));
        assert!(id("nowhere").is_none() && FileId::from_path(top.path()) != id("file"));
    }
}
