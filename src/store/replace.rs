//! Whole-file replace: a reader sees the old file or the complete new one, never a part.

use std::io::Write;
use std::path::{Path, PathBuf};

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {path}: {cause}")]
pub struct WriteError {
    /// The file that was asked for.
    pub path: PathBuf,
    /// What the operating system said.
    pub cause: std::io::Error,
}

/// Writes `bytes` to `path`: a temporary file beside it, flushed to disk, then renamed over it.
///
/// Missing parent folders are made. `-` writes to standard output. On any error an existing file
/// at `path` is left as it was. Checked below and in `tests/cli.rs`.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let fail = |cause| WriteError { path: path.to_owned(), cause };
    if path == Path::new("-") {
        let mut out = std::io::stdout().lock();
        return out.write_all(bytes).and_then(|()| out.flush()).map_err(fail);
    }
    beside(path, bytes).map_err(fail)?.persist(path).map_err(|e| fail(e.error))?;
    Ok(())
}

/// As [`write()`], but never over a file that exists: whether it was written.
pub fn create(path: &Path, bytes: &[u8]) -> Result<bool, WriteError> {
    let fail = |cause| WriteError { path: path.to_owned(), cause };
    match beside(path, bytes).map_err(fail)?.persist_noclobber(path) {
        Ok(_) => Ok(true),
        Err(e) if e.error.kind() == std::io::ErrorKind::AlreadyExists => Ok(false),
        Err(e) => Err(fail(e.error)),
    }
}

/// As [`write()`], for what is made bit by bit and too large for memory: `fill` writes it.
///
/// It grows in `.NAME.partial` beside `path`: whoever calls this must be the only one who does for
/// this path ([`super::progress`] has the lock); what a kill leaves there the next start replaces.
pub fn stream(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let fail = |cause| WriteError { path: path.to_owned(), cause };
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let partial = path.with_file_name(format!(".{name}.partial"));
    let written = || {
        let mut out = std::io::BufWriter::new(std::fs::File::create(&partial).map_err(fail)?);
        fill(&mut out)?;
        let file = out.into_inner().map_err(|e| fail(e.into_error()))?;
        file.sync_all().and_then(|()| std::fs::rename(&partial, path)).map_err(fail)
    };
    written().inspect_err(|_| {
        let _ = std::fs::remove_file(&partial);
    })
}

/// A complete temporary file in the folder of `path`, on disk.
fn beside(path: &Path, bytes: &[u8]) -> std::io::Result<tempfile::NamedTempFile> {
    let folder = match path.parent() {
        Some(p) if p != Path::new("") => p,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".cutlab-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666)); // the umask still applies
    }
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_whole_files_and_leaves_nothing_beside_them() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("new/folder/file.txt");
        write(&path, b"one").expect("writes");
        write(&path, b"two").expect("replaces");
        assert_eq!(std::fs::read(&path).expect("reads"), b"two");
        assert!(!create(&path, b"three").expect("looks"));
        assert_eq!(std::fs::read(&path).expect("reads"), b"two");
        let beside = std::fs::read_dir(path.parent().expect("a parent")).expect("lists").count();
        assert_eq!(beside, 1);
    }

    #[test]
    fn a_folder_in_the_way_is_an_error_that_names_it() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let error = write(dir.path(), b"x").expect_err("a folder cannot be replaced by a file");
        assert!(error.to_string().contains(&dir.path().display().to_string()));
    }
}
