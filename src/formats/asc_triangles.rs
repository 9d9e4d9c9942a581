//! Triangle records of the two `.asc` lists: records that begin with a word `triangle…`.

use super::error::FormatError;
use super::input::{Input, is_no_value, number, words};
use super::mesh_import::Digits;
use crate::limits;

/// Of words after the numbers no reader knows more than one; two are enough to complain.
const MOST_AFTER: usize = 2;

/// One record: the numbers after `triangle`, and the words after the numbers.
pub struct TriangleRecord<'t> {
    /// The line of its word `triangle`.
    pub line: usize,
    /// The numbers up to the next word.
    pub numbers: Vec<f64>,
    /// What follows up to the next record (a type token, `object`).
    pub after: Vec<&'t str>,
}

/// Whether `word` begins a record: `triangle`, `triangle1`, `triangle-----`.
fn begins(word: &str) -> bool {
    word.get(..8).is_some_and(|start| start.eq_ignore_ascii_case("triangle"))
}

/// The records of a file, and the digits of their numbers.
pub struct TriangleRecords<'t> {
    pub all: Vec<TriangleRecord<'t>>,
    pub digits: Digits,
}

/// All records of the text. Words before the first are passed over. A number that is none, as normals and
/// colours may be, is nan.
pub fn records<'t>(source: &Input, text: &'t str) -> Result<TriangleRecords<'t>, FormatError> {
    let mut records: Vec<TriangleRecord> = Vec::new();
    let mut digits = Digits::TEXT;
    source.has_at_most(&limits::POLYGONS, words(text).filter(|(_, w)| begins(w)).count())?;
    for (line, word) in words(text) {
        let last = records.last_mut();
        let value = number(word).or(is_no_value(word).then_some(f64::NAN));
        match (value, last) {
            _ if begins(word) => {
                records.push(TriangleRecord { line, numbers: Vec::new(), after: Vec::new() });
            }
            (Some(value), Some(record)) if record.after.is_empty() => {
                digits.see(word);
                record.numbers.push(value);
            }
            (Some(_), _) => return Err(source.at_line(line, "the word 'triangle'", word)),
            (None, Some(record)) if record.after.len() < MOST_AFTER => record.after.push(word),
            (None, _) => {}
        }
    }
    Ok(TriangleRecords { all: records, digits })
}

/// How many numbers the first record has, if the file begins as such a list does; the record may
/// break off at the end of the file.
pub fn first_count(source: &Input) -> Option<usize> {
    let start = source.beginning();
    let mut all = words(&start).map(|(_, w)| w).skip_while(|w| w.eq_ignore_ascii_case("object"));
    begins(all.next()?).then(|| all.take_while(|w| number(w).is_some() || is_no_value(w)).count())
}
