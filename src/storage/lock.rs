//! Locks: a file that one process at a time owns.

use std::ffi::OsString;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// No name of a hidden file is longer in bytes: file systems take 255.
const LONGEST: usize = 200;

/// `.NAME.extension` beside `path`; a name too long for that stands there as its checksum.
pub fn sidecar_path(path: &Path, extension: &str) -> PathBuf {
    let name = path.file_name().unwrap_or_default();
    let mut hidden = OsString::from(".");
    if name.len() > LONGEST {
        hidden.push(format!("{:08x}", crc32fast::hash(name.as_encoded_bytes())));
    } else {
        hidden.push(name);
    }
    hidden.push(format!(".{extension}"));
    path.with_file_name(hidden)
}

/// Opens the file at `path`, making it and its folders if they are not there, and takes its lock,
/// which ends with the process or when the file is dropped.
///
/// - `waiting`: called if another process has it, before this one waits
///
/// A link in its place is taken away, never followed: it may lead to what is another's.
/// A file system without locks has none to wait for. Checked in `tests/library/progress.rs`.
pub fn acquire(path: &Path, waiting: &dyn Fn()) -> std::io::Result<File> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    loop {
        match std::fs::symlink_metadata(path) {
            Ok(m) if m.is_symlink() => std::fs::remove_file(path)?,
            // a pipe in its place would be waited for without end
            Ok(m) if !m.is_file() => {
                let problem = format!("{} is not a regular file", super::text::display_name(path));
                return Err(Error::new(ErrorKind::InvalidInput, problem));
            }
            _ => (),
        }
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        #[cfg(unix)]
        {
            use std::os::unix::fs::OpenOptionsExt;
            options.custom_flags(rustix::fs::OFlags::NOFOLLOW.bits().cast_signed());
        }
        let file = options.open(path)?;
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            waiting();
            file.lock()?;
        }
        if still_at(&file, path) {
            return Ok(file);
        } // its owner has finished and taken it away
    }
}

/// Whether `path` still leads to this very file.
fn still_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let place = |m: std::io::Result<std::fs::Metadata>| m.ok().map(|m| (m.dev(), m.ino()));
        let here = place(file.metadata());
        here.is_some() && here == place(std::fs::symlink_metadata(path))
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        path.exists()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_names_are_told_apart_and_fit() {
        assert_eq!(sidecar_path(Path::new("a/t.csv"), "progress"), Path::new("a/.t.csv.progress"));
        let long = |c: &str| sidecar_path(Path::new(&c.repeat(250)), "partial");
        assert!(long("x") != long("y") && long("x").as_os_str().len() < 30);
    }
}
