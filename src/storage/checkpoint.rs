//! Checkpoints: the state of long work, written whole beside its output, so that a kill costs only what was
//! done since it was kept last.
//!
//! Layout: the magic `CUTLABKS`, u32 (little-endian) length of the work's identity, the identity, the
//! state, last a CRC-32 of everything before it.

use super::atomic_write::{self, WriteError};
use super::lock;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const MAGIC: &[u8; 8] = b"CUTLABKS";

/// The state is written again when this has passed,
const MIN_INTERVAL: Duration = Duration::from_secs(1);
/// or, if that is longer, this many times what it takes to write it.
const MIN_INTERVAL_PER_WRITE_TIME: u32 = 20;

/// Where the state of a work is kept: `.NAME.kept` beside its output.
#[derive(Debug)]
pub struct Checkpoint {
    path: PathBuf,
    identity: String,
    last: Instant,
    patience: Duration,
}

impl Checkpoint {
    /// The state of the work called `identity` that makes `output`. Nothing is read or written yet.
    pub fn for_output(output: &Path, identity: &str) -> Checkpoint {
        let path = lock::sidecar_path(output, "kept");
        Checkpoint { path, identity: identity.into(), last: Instant::now(), patience: MIN_INTERVAL }
    }

    /// The state as it was kept last; none if there is none, or one of other work, or a damaged one.
    pub fn load(&self) -> Option<Vec<u8>> {
        let mut bytes = std::fs::read(&self.path).ok().filter(|_| self.path.is_file())?;
        let crc = bytes.split_off(bytes.len().checked_sub(4)?);
        let head = self.header();
        let whole = crc == crc32fast::hash(&bytes).to_le_bytes() && bytes.starts_with(&head);
        whole.then(|| bytes.split_off(head.len()))
    }

    /// Keeps the state if it is time to.
    pub fn save(&mut self, state: impl FnOnce() -> Vec<u8>) -> Result<(), WriteError> {
        if self.last.elapsed() < self.patience {
            return Ok(());
        }
        let begun = Instant::now();
        let mut bytes = self.header();
        bytes.extend(state());
        let crc = crc32fast::hash(&bytes);
        bytes.extend(crc.to_le_bytes());
        atomic_write::write(&self.path, &bytes)?;
        self.last = Instant::now();
        self.patience = MIN_INTERVAL.max(MIN_INTERVAL_PER_WRITE_TIME * begun.elapsed());
        Ok(())
    }

    /// The work is done: takes the state away.
    pub fn remove(self) -> Result<(), WriteError> {
        match std::fs::remove_file(&self.path) {
            Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => {
                Err(WriteError { path: self.path, cause })
            }
            _ => Ok(()),
        }
    }

    fn header(&self) -> Vec<u8> {
        let length = (self.identity.len() as u32).to_le_bytes();
        [&MAGIC[..], &length, self.identity.as_bytes()].concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_whole_state_of_the_same_work_comes_back() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let output = dir.path().join("p.png");
        let of = |identity: &str| Checkpoint {
            patience: Duration::ZERO,
            ..Checkpoint::for_output(&output, identity)
        };
        let mut kept = of("render");
        assert_eq!(kept.load(), None);
        kept.save(|| b"state".to_vec()).expect("writes");
        assert_eq!(kept.load().as_deref(), Some(&b"state"[..]));
        assert_eq!(of("rende").load(), None);
        assert_eq!(of("renderstate").load(), None);
        // not yet time again
        kept.save(|| unreachable!("it was kept just now")).expect("waits");
        let path = dir.path().join(".p.png.kept");
        let whole = std::fs::read(&path).expect("reads");
        for at in 0..whole.len() {
            std::fs::write(&path, &whole[..at]).expect("writes");
            assert_eq!(kept.load(), None, "cut at {at}");
            let mut flipped = whole.clone();
            flipped[at] ^= 0x10;
            std::fs::write(&path, &flipped).expect("writes");
            assert_eq!(kept.load(), None, "flipped at {at}");
        }
        kept.remove().expect("removes");
        assert!(!path.exists());
        of("render").remove().expect("nothing to remove is done too");
    }
}
