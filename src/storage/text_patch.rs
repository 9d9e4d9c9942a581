//! Replacing parts of a text file: every byte outside them stays as it is, in any encoding.

use super::text;
use encoding_rs::{Encoding, UTF_16BE, UTF_16LE};
use std::ops::Range;

/// The changes of a text file, by places in its decoded text.
#[derive(Debug)]
pub struct TextPatch<'b> {
    bytes: &'b [u8],
    encoding: &'static Encoding,
    text: String,
    /// For each byte of the text, and for its end: where in the file its character begins.
    starts: Vec<usize>,
    /// For each byte of the text: where in the file its character ends. Bytes that are no text may follow.
    ends: Vec<usize>,
    changes: Vec<(Range<usize>, String)>,
}

impl<'b> TextPatch<'b> {
    /// No changes yet, of the text that [`text::decode`] finds in these bytes.
    pub fn new(bytes: &'b [u8]) -> TextPatch<'b> {
        let (encoding, mark) = text::encoding_of(bytes);
        let mut decoder = encoding.new_decoder_without_bom_handling();
        let (mut text, mut starts, mut ends) = (String::new(), Vec::new(), Vec::new());
        let (mut begun, mut end) = (mark, mark);
        for at in mark..bytes.len() {
            // the longest that one byte can complete: what it ends, and what was held back
            let mut piece = [0; 16];
            let (.., written, _) = decoder.decode_to_utf8(&bytes[at..=at], &mut piece, at + 1 == bytes.len());
            if written == 0 {
                continue;
            }
            if let Some(piece) = std::str::from_utf8(&piece[..written]).ok().filter(|p| *p != "\0") {
                text += piece;
                starts.resize(text.len(), begun);
                ends.resize(text.len(), at + 1);
                end = at + 1;
            }
            begun = at + 1;
        }
        starts.push(end);
        let kept = text.trim_end_matches('\x1a').len();
        text.truncate(kept);
        starts.truncate(kept + 1);
        TextPatch { bytes, encoding, text, starts, ends, changes: Vec::new() }
    }

    /// The decoded text before the changes.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Puts `new` in the place of a part of the text, or before a place if the part is empty. Parts must not
    /// overlap; what is put before one place stands in the order of the calls.
    pub fn replace(&mut self, part: Range<usize>, new: impl Into<String>) {
        self.changes.push((part, new.into()));
    }

    /// Whether nothing was replaced.
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty()
    }

    /// The file's bytes after the changes, with the text's new parts in the file's encoding.
    pub fn finish(mut self) -> Vec<u8> {
        self.changes.sort_by_key(|(part, _)| (part.start, part.end));
        let mut out = Vec::with_capacity(self.bytes.len());
        let mut copied = 0;
        let start_of = |at: usize| self.starts.get(at).copied().unwrap_or(self.bytes.len());
        let end_of = |part: &Range<usize>| match part.is_empty() {
            true => start_of(part.start),
            false => self.ends.get(part.end - 1).copied().unwrap_or(self.bytes.len()),
        };
        for (part, new) in &self.changes {
            let (start, end) = (start_of(part.start).max(copied), end_of(part).max(copied));
            out.extend(self.bytes.get(copied..start).unwrap_or_default());
            out.extend(encoded(self.encoding, new));
            copied = end;
        }
        out.extend(self.bytes.get(copied..).unwrap_or_default());
        out
    }
}

/// The text's bytes; encoding_rs itself writes UTF-8 for UTF-16.
fn encoded(encoding: &'static Encoding, text: &str) -> Vec<u8> {
    match encoding {
        e if e == UTF_16LE => text.encode_utf16().flat_map(u16::to_le_bytes).collect(),
        e if e == UTF_16BE => text.encode_utf16().flat_map(u16::to_be_bytes).collect(),
        other => other.encode(text).0.into_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replaced(bytes: &[u8], old: &str, new: &str) -> Vec<u8> {
        let mut patch = TextPatch::new(bytes);
        assert_eq!(patch.text(), text::decode(bytes));
        let at = patch.text().find(old).expect("the text has it");
        patch.replace(at..at + old.len(), new);
        patch.finish()
    }

    #[test]
    fn every_byte_outside_stays_in_any_encoding() {
        assert_eq!(replaced(b"P\x92 40\xB0 1.5\r\n\x1A\0", "1.5", "2"), b"P\x92 40\xB0 2\r\n\x1A\0");
        assert_eq!(replaced("40° 1.5 α".as_bytes(), "1.5", "°"), "40° ° α".as_bytes());
        assert_eq!(replaced(b"\xEF\xBB\xBFa 1\0\0b", "1", "22"), b"\xEF\xBB\xBFa 22\0\0b");
        assert_eq!(replaced(b"\xFF\xFEa\0\xB0\x001\0", "1", "2\u{b0}"), b"\xFF\xFEa\0\xB0\x002\0\xB0\0");
        assert_eq!(replaced(b"\xFE\xFF\0a\0\xB0\x001", "\u{b0}", "x"), b"\xFE\xFF\0a\0x\x001");
        let japanese = b"<?xml version='1.0' encoding='shift_jis'?>\x83\x8B 1";
        assert_eq!(replaced(japanese, " 1", " 2"), [&japanese[..japanese.len() - 1], b"2"].concat());
        let mut none = TextPatch::new(b"a\x1A");
        assert!(none.is_empty());
        none.replace(1..1, "b");
        none.replace(1..1, "c");
        assert_eq!(none.finish(), b"abc\x1A");
    }
}
