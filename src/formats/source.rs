//! What a reader is given: a file's bytes, its name for errors, and the text in it.

use super::error::{FormatError, shown};
use super::windows_1252;
use crate::store::limits::Limit;
use std::borrow::Cow;
use std::path::Path;

/// A file to be read.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// The file's name, as errors show it.
    pub name: &'a str,
    /// All its bytes.
    pub bytes: &'a [u8],
    /// The folder that files it refers to must lie in; none refuses them all.
    pub folder: Option<&'a Path>,
}

impl<'a> Source<'a> {
    /// The text: UTF-8 if it is that, else Windows-1252; without byte-order mark and NUL padding.
    pub fn text(&self) -> Cow<'a, str> {
        let bytes = self.bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(self.bytes);
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => windows_1252::decoded(bytes).into(),
        };
        if text.contains('\0') { text.replace('\0', "").into() } else { text }
    }

    /// The first 4,096 bytes as text, for telling formats apart.
    pub fn beginning(&self) -> String {
        let cut = &self.bytes[..self.bytes.len().min(4096)];
        String::from_utf8_lossy(cut.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(cut)).replace('\0', "")
    }

    /// The file's name without folder and ending.
    pub fn stem(&self) -> String {
        Path::new(self.name).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned())
    }

    /// The file's ending, in lower case.
    pub fn extension(&self) -> String {
        Path::new(self.name).extension().map_or_else(String::new, |s| s.to_string_lossy().to_lowercase())
    }

    /// An error at a line (from 1).
    pub fn at_line(&self, line: usize, expected: impl Into<String>, found: &str) -> FormatError {
        FormatError::Line { file: self.name.into(), line, expected: expected.into(), found: shown(found) }
    }

    /// Refuses `n` of something if that is more than its limit.
    pub fn within(&self, limit: &Limit, n: usize) -> Result<(), FormatError> {
        limit.check(n).map_err(|cause| FormatError::Limit { place: self.name.into(), cause })
    }

    /// As [`Source::within`], for what stands at a line (from 1).
    pub fn within_at(&self, line: usize, limit: &Limit, n: usize) -> Result<(), FormatError> {
        let place = || format!("{}, line {line}", self.name);
        limit.check(n).map_err(|cause| FormatError::Limit { place: place(), cause })
    }

    /// Refuses a file of more bytes than `limit`.
    pub fn of_at_most(&self, limit: &Limit) -> Result<(), FormatError> {
        let too_large = |cause| FormatError::TooLarge { file: self.name.into(), cause };
        limit.check(self.bytes.len()).map_err(too_large)
    }

    /// An error at a byte.
    pub fn at_byte(
        &self,
        offset: usize,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> FormatError {
        FormatError::Byte { file: self.name.into(), offset, expected: expected.into(), found: found.into() }
    }
}

/// Lines with their numbers from 1, ended by LF, CRLF or a lone CR.
pub fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut rest = Some(text);
    let split = std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.find(['\r', '\n']) else {
            rest = None;
            return Some(text);
        };
        let after = if text[end..].starts_with("\r\n") { end + 2 } else { end + 1 };
        rest = Some(&text[after..]);
        Some(&text[..end])
    });
    split.enumerate().map(|(i, line)| (i + 1, line))
}

/// White-space separated words with the numbers of their lines, `#` to the end of a line left out.
pub fn words(text: &str) -> impl Iterator<Item = (usize, &str)> {
    lines(text).flat_map(|(n, line)| {
        let said = line.split('#').next().unwrap_or_default();
        said.split_whitespace().map(move |w| (n, w))
    })
}

/// A finite number; the minus sign may be U+2212.
pub fn number(word: &str) -> Option<f64> {
    let value = match word.strip_prefix('\u{2212}') {
        Some(rest) => format!("-{rest}").parse::<f64>(),
        None => word.parse::<f64>(),
    };
    value.ok().filter(|v| v.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_every_age_is_read() {
        let text = |bytes| Source { name: "x", bytes, folder: None }.text().into_owned();
        assert_eq!(text(b"\xEF\xBB\xBFa\0\0"), "a");
        assert_eq!(text(b"Peter\x92s 40\xB0 cut"), "Peter’s 40° cut");
        assert_eq!(text("40° cut".as_bytes()), "40° cut");
        let split: Vec<_> = lines("a\r\nb\rc\n\nd").collect();
        assert_eq!(split, [(1, "a"), (2, "b"), (3, "c"), (4, ""), (5, "d")]);
        assert_eq!(number("\u{2212}42.5"), Some(-42.5));
        assert_eq!(number("nan"), None);
    }
}
