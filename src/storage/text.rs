//! Text as programs of all ages and systems write it: decoded here, and nowhere else.

use encoding_rs::{Encoding, UTF_8, WINDOWS_1252};
use std::borrow::Cow;

pub use crate::parse::display_name;

/// The text that a file's bytes stand for, without NUL padding and DOS end-of-file marks.
///
/// The encoding is that of the byte-order mark (UTF-8, or UTF-16 of either byte order), else UTF-8 if the
/// bytes are that, else what an XML declaration names, else Windows-1252, in which every byte stands for
/// something.
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let text = decoded(bytes);
    let end = text.trim_end_matches(['\0', '\x1a']).len();
    match text {
        text if text[..end].contains('\0') => text[..end].replace('\0', "").into(),
        Cow::Borrowed(text) => Cow::Borrowed(&text[..end]),
        Cow::Owned(mut text) => {
            text.truncate(end);
            text.into()
        }
    }
}

/// As [`decode`], with lines that end in LF alone, for readers that take no other or count them so.
pub fn decode_lines(bytes: &[u8]) -> Cow<'_, str> {
    let text = decode(bytes);
    if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n").into() } else { text }
}

/// The first `most` bytes as text, for telling formats apart.
pub fn beginning(bytes: &[u8], most: usize) -> String {
    let cut = &bytes[..bytes.len().min(most)];
    let text = match marked(bytes) {
        Some((encoding, mark)) => encoding.decode_without_bom_handling(cut.get(mark..).unwrap_or_default()).0,
        None => String::from_utf8_lossy(cut),
    };
    text.replace('\0', "")
}

/// Whether the bytes begin with a byte-order mark, and so are text.
pub fn is_marked(bytes: &[u8]) -> bool {
    marked(bytes).is_some()
}

/// The encoding that a byte-order mark names, and the mark's length.
///
/// Binary files have no marks, but one may begin with the same two bytes: text has no NUL among its first
/// characters, and every design in binary has.
fn marked(bytes: &[u8]) -> Option<(&'static Encoding, usize)> {
    /// In bytes: a binary design's first facet ends its name's length before that.
    const NEAR: usize = 64;
    let (encoding, mark) = Encoding::for_bom(bytes)?;
    let near = encoding.decode_without_bom_handling(&bytes[mark..bytes.len().min(NEAR)]).0;
    (encoding == UTF_8 || !near.trim_end_matches('\0').contains('\0')).then_some((encoding, mark))
}

fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let (encoding, mark) = encoding_of(bytes);
    encoding.decode_without_bom_handling(&bytes[mark..]).0
}

/// The encoding of a file's text, as [`decode`] says, and the length of its byte-order mark.
pub(super) fn encoding_of(bytes: &[u8]) -> (&'static Encoding, usize) {
    marked(bytes).unwrap_or_else(|| match std::str::from_utf8(bytes) {
        Ok(_) => (UTF_8, 0),
        Err(_) => (declared(bytes).unwrap_or(WINDOWS_1252), 0),
    })
}

/// The encoding that an XML declaration names.
fn declared(bytes: &[u8]) -> Option<&'static Encoding> {
    let head = bytes.strip_prefix(b"<?xml")?;
    let head = head.split(|b| *b == b'>').next()?;
    let name = head.windows(9).position(|w| w == b"encoding=")? + 9;
    let quote = head.get(name)?;
    Encoding::for_label(head.get(name + 1..)?.split(|b| b == quote).next()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_every_age_is_read() {
        let text = |bytes| decode(bytes).into_owned();
        assert_eq!(text(b"\xEF\xBB\xBFa\0\0"), "a");
        assert_eq!(text(b"Peter\x92s 40\xB0 cut"), "Peter’s 40° cut");
        assert_eq!(text("40° cut".as_bytes()), "40° cut");
        assert_eq!(text(b"\xFF\xFEa\0\xB0\0"), "a°");
        assert_eq!(text(b"\xFE\xFF\0a\0\xB0"), "a°");
        assert_eq!(text(b"end\r\n\x1A\0"), "end\r\n");
        assert_eq!(decode_lines(b"a\r\nb\rc\n"), "a\nb\nc\n");
        assert_eq!(text(b"<?xml version='1.0' encoding='windows-1251'?>\xC0"), {
            "<?xml version='1.0' encoding='windows-1251'?>А"
        });
        assert_eq!(beginning(b"\xFF\xFEa\0b\0c\0", 6), "ab");
        // the plane, tier and name of a facet that happens to begin so
        assert!(!is_marked(b"\xFF\xFE34567890123456789012\x03\0\0\0\x02P1"));
    }
}
