//! Reading whole files, within the limits on what is read.

use crate::limits::{Exceeded, Limit, Limits};
use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// The bytes at `path`, if the operating system gives them and they are not more than the limit. It may be
/// a pipe or a device: so only for what is named on the command line.
pub fn read(path: &Path, limits: Limits, limit: &Limit) -> Result<Result<Vec<u8>, Exceeded>, Error> {
    read_from(File::open(path)?, limits, limit)
}

/// As [`read`], but only of a regular file.
pub fn read_regular(path: &Path, limits: Limits, limit: &Limit) -> Result<Result<Vec<u8>, Exceeded>, Error> {
    read_from(open_regular(path)?, limits, limit)
}

fn read_from(file: File, limits: Limits, limit: &Limit) -> Result<Result<Vec<u8>, Exceeded>, Error> {
    // a file says how large it is; pipes and devices say 0
    if let Err(exceeded) = limits.check_all(limit, file.metadata()?.len()) {
        return Ok(Err(exceeded));
    }
    let mut bytes = Vec::new();
    file.take(limits.max(limit).saturating_add(1)).read_to_end(&mut bytes)?;
    Ok(limits.check(limit, bytes.len()).map(|()| bytes))
}

/// Opens the file at `path` to be read, if it is one or a link to one: a pipe may never end, a device
/// may do anything, and whoever named it may be a stranger.
pub fn open_regular(path: &Path) -> Result<File, Error> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not a regular file"));
    }
    File::open(path)
}
