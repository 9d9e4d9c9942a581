//! The values after a PLY header, one after the other, from words or bytes.

use super::header::{Header, PlyScalar, Storage};
use crate::formats::error::{FormatError, counted};
use crate::formats::input::{Input, is_no_value, lines, number};
use crate::formats::mesh_import::Digits;
use crate::limits;

/// Reads value after value.
pub struct PlyValues<'s> {
    source: &'s Input<'s>,
    /// The file's bytes, or those of its decoded text.
    bytes: &'s [u8],
    storage: Storage,
    /// Words with their lines, for text.
    words: Box<dyn Iterator<Item = (usize, &'s str)> + 's>,
    /// The line of the last word, or the offset of the next byte.
    at: usize,
    vertices: u64,
    /// Digits of the numbers with a fraction that were read from words.
    pub digits: Digits,
}

impl<'s> PlyValues<'s> {
    /// - `bytes`: the file's, or those of its decoded text
    pub fn new(source: &'s Input<'s>, header: &Header, bytes: &'s [u8]) -> PlyValues<'s> {
        let rest = bytes.get(header.end..).unwrap_or_default();
        let text = if header.is_text() { std::str::from_utf8(rest).unwrap_or_default() } else { "" };
        let first = header.line - 1;
        let vertices = header.elements.iter().find(|e| e.name == "vertex").map_or(0, |e| e.count);
        let words =
            lines(text).flat_map(move |(n, line)| line.split_whitespace().map(move |w| (n + first, w)));
        PlyValues {
            source,
            bytes,
            storage: header.storage,
            words: Box::new(words),
            at: if header.is_text() { header.line } else { header.end },
            vertices,
            digits: Digits::TEXT,
        }
    }

    /// A remark on what follows the last value.
    pub fn left_over(&mut self) -> Option<String> {
        let (n, what) = match self.storage {
            Storage::Text => (self.words.by_ref().count(), "word"),
            _ => {
                let rest = self.bytes.get(self.at..).unwrap_or_default();
                (if rest.iter().all(|b| matches!(b, b'\r' | b'\n' | 0)) { 0 } else { rest.len() }, "byte")
            }
        };
        (n > 0).then(|| format!("{} after the last element passed over", counted(n, what)))
    }

    fn wrong(&self, expected: String, found: &str) -> FormatError {
        match self.storage {
            Storage::Text => self.source.at_line(self.at, expected, found),
            _ => self.source.at_byte(self.at, expected, if found.is_empty() { "the end" } else { found }),
        }
    }

    /// The next value, of the property `name`; maybe not finite.
    pub fn next_value(&mut self, kind: PlyScalar, name: &str) -> Result<f64, FormatError> {
        match self.storage {
            Storage::Text => {
                let (line, word) = self.words.next().unwrap_or((self.at, ""));
                self.at = line;
                // confidence, shading normals and the like may be nan
                let none = is_no_value(word).then_some(f64::NAN);
                if word.contains('.') {
                    self.digits.see(word);
                }
                number(word).or(none).ok_or_else(|| self.wrong(format!("a number for {name}"), word))
            }
            _ => match kind {
                PlyScalar::I8 => self.bytes::<1>(name).map(|b| i8::from_le_bytes(b).into()),
                PlyScalar::U8 => self.bytes::<1>(name).map(|[b]| b.into()),
                PlyScalar::I16 => self.bytes(name).map(|b| i16::from_le_bytes(b).into()),
                PlyScalar::U16 => self.bytes(name).map(|b| u16::from_le_bytes(b).into()),
                PlyScalar::I32 => self.bytes(name).map(|b| i32::from_le_bytes(b).into()),
                PlyScalar::U32 => self.bytes(name).map(|b| u32::from_le_bytes(b).into()),
                PlyScalar::F32 => self.bytes(name).map(|b| f32::from_le_bytes(b).into()),
                PlyScalar::F64 => self.bytes(name).map(f64::from_le_bytes),
            },
        }
    }

    /// The next bytes, least first.
    fn bytes<const N: usize>(&mut self, name: &str) -> Result<[u8; N], FormatError> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let Some(bytes) = rest.first_chunk::<N>() else {
            return Err(self.wrong(format!("{N} bytes of {name}"), ""));
        };
        self.at += N;
        let mut bytes = *bytes;
        if self.storage == Storage::Big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// The length of a list.
    pub fn count(&mut self, kind: PlyScalar, name: &str) -> Result<u64, FormatError> {
        let count = self.next_value(kind, name)?;
        if count >= 0.0 && count.fract() == 0.0 {
            self.source.within(&limits::PLY_LIST, count as usize)?;
            Ok(count as u64)
        } else {
            Err(self.wrong(format!("the length of {name}"), &count.to_string()))
        }
    }

    /// Checks that a list names corners that are there.
    ///
    /// - `strips`: whether -1 may stand between them
    pub fn check_corners(&self, corners: &[f64], strips: bool) -> Result<(), FormatError> {
        let sound =
            |c: &f64| strips && *c == -1.0 || *c >= 0.0 && c.fract() == 0.0 && *c < self.vertices as f64;
        match corners.iter().find(|c| !sound(c)) {
            None => Ok(()),
            Some(c) => {
                let last = self.vertices.saturating_sub(1);
                Err(self.wrong(format!("a corner from 0 to {last}"), &c.to_string()))
            }
        }
    }
}
