//! Atomic writes: a reader sees the old file or the complete new one, never a part.

use super::lock;
use super::terminal::Terminal;
use super::text::display_name;
use std::ffi::{OsStr, OsString};
use std::fs::{File, Metadata};
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use tempfile::TempPath;

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {cause}", display_name(.path))]
pub struct WriteError {
    /// The file that was asked for.
    pub path: PathBuf,
    /// What the operating system said.
    pub cause: std::io::Error,
}

/// Whether `path` is something to be written to as it comes: standard output (`-`, `/dev/stdout`),
/// another open file of this process (`/dev/fd/3`), a pipe, a device.
pub fn is_stream(path: &Path) -> bool {
    is_stdout(path)
        || descriptor(path).is_some()
        || path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// Whether `path` is standard output, under any of its names and wherever the shell sends it.
pub fn is_stdout(path: &Path) -> bool {
    path == Path::new("-") || descriptor(path).as_deref() == Some(OsStr::new("1"))
}

/// The number of the open file that `path` leads to, if it is a name of one: of `/dev/stdout`,
/// `/dev/fd/1` and `/proc/self/fd/1` the `1`. What the shell opened is neither renamed nor replaced.
fn descriptor(path: &Path) -> Option<OsString> {
    /// More links in a row than any system has.
    const LINKS: usize = 40;
    let mut at = path.to_owned();
    for _ in 0..LINKS {
        let folder = at.parent()?;
        let real = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let of_process = real.starts_with("/proc") && real.ends_with("fd");
        if of_process || real == Path::new("/dev/fd") {
            return at.file_name().map(ToOwned::to_owned);
        }
        at = folder.join(std::fs::read_link(&at).ok()?);
    }
    None
}

/// Opens what [`is_stream`].
pub fn open_stream(path: &Path) -> Result<Box<dyn Write + Send>, WriteError> {
    if is_stdout(path) {
        let stdout = std::io::stdout();
        return Ok(if stdout.is_terminal() { Box::new(Terminal::new(stdout)) } else { Box::new(stdout) });
    }
    // what another program has written to it stays
    let opened = std::fs::OpenOptions::new().append(true).open(path);
    Ok(Box::new(opened.map_err(|cause| WriteError { path: path.to_owned(), cause })?))
}

/// Writes `bytes` to `path`: into a hidden file beside it, flushed to disk, then renamed over it.
///
/// Missing parent folders are made, links are followed, the mode of a file that is replaced is kept;
/// another hard link to it keeps what it held. What [`is_stream`] is written to as it is. On
/// any error an existing file at `path` is left as it was. Checked in this file's tests, in `tests/program/cli.rs` and, by
/// killing it, in `tests/program/kills.rs`.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let fail = |cause| WriteError { path: path.to_owned(), cause };
    stream(path, |out| out.write_all(bytes).map_err(fail))
}

/// As [`write()`], but never over a file that exists: whether it was written.
pub fn create(path: &Path, bytes: &[u8]) -> Result<bool, WriteError> {
    let fail = |cause| WriteError { path: path.to_owned(), cause };
    if is_stream(path) {
        return write(path, bytes).map(|()| true);
    }
    let partial = Partial::filled(path, |out| out.write_all(bytes).map_err(fail))?;
    match partial.name.persist_noclobber(path) {
        Ok(()) => Ok(true),
        Err(e) if e.error.kind() == std::io::ErrorKind::AlreadyExists => Ok(false),
        Err(e) => Err(fail(e.error)),
    }
}

/// As [`write()`], for what is made bit by bit and too large for memory: `fill` writes it.
pub fn stream(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    if is_stream(path) {
        let mut out = std::io::BufWriter::new(open_stream(path)?);
        fill(&mut out)?;
        return out.flush().map_err(|cause| WriteError { path: path.to_owned(), cause });
    }
    let target = if path.is_symlink() { path.canonicalize() } else { Ok(path.to_owned()) };
    let target = target.map_err(|cause| WriteError { path: path.to_owned(), cause })?;
    let partial = Partial::filled(&target, fill)?;
    if let Ok(old) = target.metadata() {
        partial.takes_after(&old).map_err(|cause| WriteError { path: path.to_owned(), cause })?;
    }
    partial.name.persist(&target).map_err(|e| WriteError { path: path.to_owned(), cause: e.error })
}

/// `.NAME.partial` in the folder of a file to be, complete and on disk. It is locked: of several
/// processes that write the same file each waits for the one before. What a kill left there is
/// thrown away by the next.
struct Partial {
    /// Removes the file when dropped.
    name: TempPath,
    /// Holds the lock until the file is in its place.
    file: File,
}

impl Partial {
    /// Gives the file the mode of the one that it replaces, and its owner where that is allowed.
    fn takes_after(&self, old: &Metadata) -> std::io::Result<()> {
        #[cfg(unix)]
        {
            use std::os::unix::fs::{MetadataExt, fchown};
            let _ = fchown(&self.file, Some(old.uid()), Some(old.gid()));
        }
        self.file.set_permissions(old.permissions())
    }

    fn filled(
        path: &Path,
        fill: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
    ) -> Result<Partial, WriteError> {
        let fail = |cause| WriteError { path: path.to_owned(), cause };
        let at = lock::sidecar_path(path, "partial");
        let file = loop {
            let file = lock::acquire(&at, &|| ()).map_err(fail)?;
            if file.metadata().map_err(fail)?.len() == 0 {
                break file;
            }
            std::fs::remove_file(&at).map_err(fail)?;
        };
        let name = TempPath::try_from_path(at).map_err(fail)?;
        let mut out = std::io::BufWriter::new(file);
        fill(&mut out)?;
        let file = out.into_inner().map_err(|e| fail(e.into_error()))?;
        file.sync_all().map_err(fail)?;
        Ok(Partial { name, file })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("lists");
        let mut names: Vec<String> =
            entries.map(|e| e.expect("lists").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn replaces_whole_files_and_leaves_nothing_beside_them() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("new/folder/file.txt");
        write(&path, b"one").expect("writes");
        write(&path, b"two").expect("replaces");
        assert_eq!(std::fs::read(&path).expect("reads"), b"two");
        assert!(!create(&path, b"three").expect("looks"));
        assert_eq!(std::fs::read(&path).expect("reads"), b"two");
        assert_eq!(names(&dir.path().join("new/folder")), ["file.txt"]);
    }

    #[test]
    fn what_a_kill_left_is_thrown_away() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let (path, left) = (dir.path().join("file.txt"), dir.path().join(".file.txt.partial"));
        std::fs::write(&left, "half of another thing").expect("writes");
        write(&path, b"one").expect("writes");
        assert_eq!((std::fs::read(&path).expect("reads"), left.exists()), (b"one".to_vec(), false));
        // killed between a link and the removal of its other name: the file is not touched by it
        std::fs::hard_link(&path, &left).expect("links");
        let failed = stream(&path, |_| {
            Err(WriteError { path: path.clone(), cause: std::io::ErrorKind::Other.into() })
        });
        assert!(failed.is_err());
        assert_eq!((std::fs::read(&path).expect("reads"), left.exists()), (b"one".to_vec(), false));
    }

    #[test]
    fn a_folder_in_the_way_is_an_error_that_names_it() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("folder");
        std::fs::create_dir(&path).expect("makes");
        let error = write(&path, b"x").expect_err("a folder cannot be replaced by a file");
        assert!(error.to_string().contains(&path.display().to_string()));
        assert_eq!(names(dir.path()), ["folder"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_stay_devices() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let (real, link) = (dir.path().join("real.txt"), dir.path().join("link.txt"));
        std::fs::write(&real, "old").expect("writes");
        std::os::unix::fs::symlink(&real, &link).expect("links");
        write(&link, b"new").expect("writes");
        assert!(link.is_symlink() && std::fs::read(&real).expect("reads") == b"new");
        assert!(!create(&link, b"newer").expect("looks"));
        let null = dir.path().join("null");
        std::os::unix::fs::symlink("/dev/null", &null).expect("links");
        write(&null, b"lost").expect("writes");
        assert!(null.is_symlink() && is_stream(&null));
    }

    #[cfg(unix)]
    #[test]
    fn modes_are_kept_and_a_link_in_the_place_of_a_part_is_not_followed() {
        use std::os::unix::fs::PermissionsExt;
        let dir = tempfile::tempdir().expect("a temporary folder");
        let (path, victim) = (dir.path().join("t.csv"), dir.path().join("victim"));
        std::fs::write(&path, "old").expect("writes");
        for mode in [0o600, 0o640, 0o664] {
            std::fs::set_permissions(&path, PermissionsExt::from_mode(mode)).expect("sets");
            write(&path, b"new").expect("writes");
            assert_eq!(path.metadata().expect("there").permissions().mode() & 0o777, mode);
        }
        for there in [false, true] {
            if there {
                std::fs::write(&victim, "").expect("writes");
            }
            std::os::unix::fs::symlink(&victim, dir.path().join(".t.csv.partial")).expect("links");
            write(&path, b"newer").expect("writes");
            assert_eq!((victim.exists(), path.is_symlink()), (there, false));
            assert_eq!(std::fs::read(&path).expect("reads"), b"newer");
        }
        assert_eq!(std::fs::read(&victim).expect("reads"), b"", "nothing went through the link");
        assert_eq!(names(dir.path()), ["t.csv", "victim"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn names_of_open_files_are_streams_wherever_they_lead() {
        for name in ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"] {
            assert!(is_stdout(Path::new(name)) && is_stream(Path::new(name)), "{name}");
        }
        let dir = tempfile::tempdir().expect("a temporary folder");
        let (path, link) = (dir.path().join("f"), dir.path().join("out"));
        let file = File::create(&path).expect("creates");
        let name = format!("/dev/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&file));
        std::os::unix::fs::symlink(&name, &link).expect("links");
        assert!(is_stream(&link) && !is_stdout(&link) && !is_stream(&path));
        write(&link, b"one").expect("writes");
        write(Path::new(&name), b"two").expect("writes");
        assert_eq!(std::fs::read(&path).expect("reads"), b"onetwo");
        assert_eq!(names(dir.path()), ["f", "out"]);
    }
}
