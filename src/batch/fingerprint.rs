//! Fingerprint of a table: a hash of everything that it depends on.

use crate::formats;
use crate::limits::{self, Limits};
use crate::storage::stdin;
use crate::storage::text;
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Identifier of the sources that this program was built from: the same for every build of them, on
/// any machine; another for any other, also of the same version.
pub const BUILD: &str = env!("CUTLAB_BUILD");

/// A digest of everything that a result depends on: program, request, inputs' contents.
/// Two results with one fingerprint have the same bytes.
#[derive(Clone)]
pub struct Fingerprint(Sha256);

/// A digest of what a file holds, of one that may include others also of what it comes to with them;
/// none if it cannot be read. Checked in `tests/program/score_batches.rs`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FileDigest(Option<[u8; 32]>);

impl FileDigest {
    /// What the file at `path` holds now.
    pub fn of_file(path: &Path, limits: Limits) -> FileDigest {
        let mut content = Vec::new();
        let most = limits.max(&limits::FILE) + 1;
        let read = File::open(path).and_then(|f| f.take(most).read_to_end(&mut content));
        if read.is_ok() && formats::may_include(&text::display_name(path), &content) {
            content.extend(format!("{:?}", formats::read_content(path, limits)).bytes());
        }
        FileDigest(read.is_ok().then(|| Sha256::digest(&content).into()))
    }

    /// What standard input holds.
    pub fn of_standard_input(limits: Limits) -> FileDigest {
        let bytes = stdin::bytes(limits).ok().and_then(Result::ok);
        FileDigest(bytes.map(|bytes| Sha256::digest(&bytes).into()))
    }

    /// Whether the file could be read.
    pub fn is_readable(self) -> bool {
        self.0.is_some()
    }
}

impl Fingerprint {
    /// The fingerprint of what this build makes of a request: that of the request's canonical JSON, in which
    /// every field is, its keys sorted.
    pub fn of_request(request: &impl Serialize) -> Fingerprint {
        Fingerprint::with_build(request, BUILD)
    }

    fn with_build(request: &impl Serialize, build: &str) -> Fingerprint {
        let mut identity = Fingerprint(Sha256::new());
        identity.add(env!("CARGO_PKG_VERSION"));
        identity.add(build);
        identity.add(canonical(request).to_string());
        identity
    }

    /// Adds an input that is no file, or a file's name.
    pub fn add(&mut self, text: impl AsRef<[u8]>) {
        self.0.update((text.as_ref().len() as u64).to_le_bytes());
        self.0.update(text);
    }

    /// Adds what a file holds.
    pub fn add_file(&mut self, held: &FileDigest) {
        self.0.update(held.0.unwrap_or_default());
    }

    /// Thirty-two hexadecimal digits.
    pub fn hex(self) -> String {
        self.0.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    }
}

/// Hash of a request, of its canonical JSON alone: thirty-two hexadecimal digits. Every build gives the same, so that
/// a newer cutlab knows the files that an older one made of the request.
pub fn request_hash(request: &impl Serialize) -> String {
    let mut hash = Fingerprint(Sha256::new());
    hash.add(canonical(request).to_string());
    hash.hex()
}

/// A request as JSON with sorted keys. What has no JSON (a key that is no text) is a mistake of its type and
/// shows in the first test that uses it: it is the same for all.
pub fn canonical(request: &impl Serialize) -> Value {
    serde_json::to_value(request).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_builds_never_share_an_identity() {
        assert!(BUILD.len() == 12 && BUILD.bytes().all(|b| b.is_ascii_hexdigit()), "{BUILD}");
        let of = |build| Fingerprint::with_build(&"cutlab score", build).hex();
        assert_eq!(of(BUILD), Fingerprint::of_request(&"cutlab score").hex());
        assert_ne!(of(BUILD), of("0123456789ab"));
        // [D] SHA-256 of the length of the JSON, eight bytes, and the JSON `true`
        assert_eq!(request_hash(&true), "46d058fc4ef77f3fd874fde10d5335b2");
    }
}
