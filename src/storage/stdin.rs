//! Standard input as a file: read to its end once, however often it is asked for.

use crate::limits::{Exceeded, FILE, Limits};
use std::io::{Error, Read};
use std::sync::Mutex;

static BYTES: Mutex<Option<Vec<u8>>> = Mutex::new(None);

/// All of standard input, if it is not more than [`FILE`] allows.
///
/// A second call gives the same bytes: a command opens its stones as often as it needs them. Checked in
/// `tests/program/words.rs`.
pub fn bytes(limits: Limits) -> Result<Result<Vec<u8>, Exceeded>, Error> {
    let mut bytes = BYTES.lock().map_err(|_| Error::other("it was given up"))?;
    if let Some(bytes) = &*bytes {
        return Ok(Ok(bytes.clone()));
    }
    let mut read = Vec::new();
    std::io::stdin().lock().take(limits.max(&FILE).saturating_add(1)).read_to_end(&mut read)?;
    Ok(limits.check(&FILE, read.len()).map(|()| bytes.insert(read).clone()))
}
