//! Names as tables and messages show them.

use std::ffi::OsStr;

/// A file's name as tables and messages show it: bytes that are not UTF-8 are written `\xff`, so that two
/// names never look alike.
pub fn display_name(name: impl AsRef<OsStr>) -> String {
    let mut text = String::new();
    for chunk in name.as_ref().as_encoded_bytes().utf8_chunks() {
        text += chunk.valid();
        chunk.invalid().iter().for_each(|byte| text += &format!("\\x{byte:02x}"));
    }
    text
}
