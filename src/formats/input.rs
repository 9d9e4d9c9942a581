//! Input of a reader: a file's bytes, its name for errors, and the text in it.

use super::error::{FormatError, quoted_excerpt, shortened};
use crate::geometry::facet_recovery::RecoverError;
use crate::limits::{Limit, Limits};
pub use crate::parse::MINUS_SIGNS;
use crate::storage::text;
use std::borrow::Cow;
use std::path::Path;

/// A file to be read.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The file's name, as errors show it.
    pub name: &'a str,
    /// All its bytes.
    pub bytes: &'a [u8],
    /// The folder that files it refers to must lie in; none refuses them all.
    pub folder: Option<&'a Path>,
    /// The most that is read of anything.
    pub limits: Limits,
}

impl<'a> Input<'a> {
    /// The text, as [`text::decode`] says.
    pub fn text(&self) -> Cow<'a, str> {
        text::decode(self.bytes)
    }

    /// The first 65,536 bytes as text, for telling formats apart: a long comment may come first.
    pub fn beginning(&self) -> String {
        text::beginning(self.bytes, 1 << 16)
    }

    /// Whether the bytes are those of no text: control characters among the first, or NUL before others.
    pub fn is_binary(&self) -> bool {
        let start = &self.bytes[..self.bytes.len().min(4096)];
        let end = start.iter().rposition(|b| *b != 0).map_or(0, |last| last + 1);
        let is_odd = |b: &u8| b.is_ascii_control() && !b"\t\n\x0b\x0c\r\x1a\x1b".contains(b);
        !text::is_marked(self.bytes) && start[..end].iter().any(is_odd)
    }

    /// The file's name without folder and extension.
    pub fn stem(&self) -> String {
        Path::new(self.name).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned())
    }

    /// The file's extension, in lower case.
    pub fn extension(&self) -> String {
        Path::new(self.name).extension().map_or_else(String::new, |s| s.to_string_lossy().to_lowercase())
    }

    /// An error at a line (from 1).
    pub fn at_line(&self, line: usize, expected: impl Into<String>, found: &str) -> FormatError {
        FormatError::Line {
            file: self.name.into(),
            line,
            expected: expected.into(),
            found: quoted_excerpt(found),
        }
    }

    /// An error of a mesh that is no convex stone.
    pub fn no_stone(&self, cause: RecoverError) -> FormatError {
        FormatError::Mesh { file: self.name.into(), cause }
    }

    /// Refuses a file with `n` of something in all, if that is more than its limit.
    pub fn has_at_most(&self, limit: &Limit, n: usize) -> Result<(), FormatError> {
        self.limits.check_all(limit, n).map_err(|cause| FormatError::Limit { place: self.name.into(), cause })
    }

    /// As [`Input::has_at_most`], where the first that is too many stands at a line (from 1).
    pub fn has_at_most_at(&self, line: usize, limit: &Limit, n: usize) -> Result<(), FormatError> {
        let place = || format!("{}, line {line}", self.name);
        self.limits.check_all(limit, n).map_err(|cause| FormatError::Limit { place: place(), cause })
    }

    /// Refuses `n` of something, counted so far, if that is more than its limit.
    pub fn within(&self, limit: &Limit, n: usize) -> Result<(), FormatError> {
        self.limits.check(limit, n).map_err(|cause| FormatError::Limit { place: self.name.into(), cause })
    }

    /// As [`Input::within`], for what stands at a line (from 1).
    pub fn within_at(&self, line: usize, limit: &Limit, n: usize) -> Result<(), FormatError> {
        let place = || format!("{}, line {line}", self.name);
        self.limits.check(limit, n).map_err(|cause| FormatError::Limit { place: place(), cause })
    }

    /// Refuses a file of more bytes than `limit`.
    pub fn is_within(&self, limit: &Limit) -> Result<(), FormatError> {
        let too_large = |cause| FormatError::TooLarge { file: self.name.into(), cause };
        self.limits.check_all(limit, self.bytes.len()).map_err(too_large)
    }

    /// An error at a byte.
    pub fn at_byte(
        &self,
        offset: usize,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> FormatError {
        let found = shortened(&found.into());
        FormatError::Byte { file: self.name.into(), offset, expected: expected.into(), found }
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

/// White-space separated words with the numbers of their lines, without comments.
pub fn words(text: &str) -> impl Iterator<Item = (usize, &str)> {
    lines(text).flat_map(|(n, line)| without_comment(line).split_whitespace().map(move |w| (n, w)))
}

/// The line up to its comment: a `#` where a word begins, and all after it. Within a word, as in
/// `Facet#1`, it is a letter like others.
pub fn without_comment(line: &str) -> &str {
    let starts = |at: usize| line[..at].chars().next_back().is_none_or(char::is_whitespace);
    let comment = line.match_indices('#').map(|(at, _)| at).find(|at| starts(*at));
    &line[..comment.unwrap_or(line.len())]
}

/// A finite number; the minus sign may be one of [`MINUS_SIGNS`].
pub fn number(word: &str) -> Option<f64> {
    let value = match word.strip_prefix(MINUS_SIGNS) {
        Some(rest) => format!("-{rest}").parse::<f64>(),
        None => word.parse::<f64>(),
    };
    value.ok().filter(|v| v.is_finite())
}

/// Whether the word is how some library writes a value that is no number: `nan`, `-inf`, `1.#QNAN`.
pub fn is_no_value(word: &str) -> bool {
    let word = word.to_ascii_lowercase();
    ["nan", "inf", "1.#ind", "1.#qnan", "1.#snan"].iter().any(|said| word.contains(said))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_words_and_numbers_are_read() {
        let split: Vec<_> = lines("a\r\nb\rc\n\nd").collect();
        assert_eq!(split, [(1, "a"), (2, "b"), (3, "c"), (4, ""), (5, "d")]);
        assert_eq!(number("\u{2212}42.5"), Some(-42.5));
        assert_eq!(number("nan"), None);
        assert!(["NaN", "-inf", "-1.#IND00", "1.#QNAN"].into_iter().all(is_no_value) && !is_no_value("1.5"));
        let said: Vec<_> = words("# all\ng Facet#1 2 # one\n\t#\u{a0}x\x0b3").map(|(_, w)| w).collect();
        assert_eq!(said, ["g", "Facet#1", "2"]);
    }
}
