//! What a table is a function of, in one short word.

use crate::formats;
use crate::store::limits;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A digest of everything that a table depends on: program version, settings, inputs' contents.
/// Two tables with one identity have the same bytes.
#[derive(Clone)]
pub struct Identity(Sha256);

impl Identity {
    /// The identity of what `command`, with all its settings spelled out, makes with this version.
    pub fn of(command: &str) -> Identity {
        let mut identity = Identity(Sha256::new());
        identity.add(env!("CARGO_PKG_VERSION"));
        identity.add(command);
        identity
    }

    /// Adds an input that is no file, or a file's name.
    pub fn add(&mut self, text: &str) {
        self.0.update((text.len() as u64).to_le_bytes());
        self.0.update(text);
    }

    /// Adds a file's content; a file that cannot be read counts as none. Of one that may include others,
    /// also what it comes to with them. Checked in `tests/score_batches.rs`.
    pub fn add_file(&mut self, path: &Path) {
        let mut content = Vec::new();
        let read = File::open(path).and_then(|f| f.take(limits::FILE.most() + 1).read_to_end(&mut content));
        self.0.update(read.map_or(u64::MAX, |n| n as u64).to_le_bytes());
        self.0.update(&content);
        if formats::may_include(&path.display().to_string(), &content) {
            self.add(&format!("{:?}", formats::read(path)));
        }
    }

    /// Thirty-two hexadecimal digits.
    pub fn hex(self) -> String {
        self.0.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    }
}
