//! A finished row of a table, and its record while the table is made.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// How a row came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RowStatus {
    /// As asked for.
    Ok,
    /// It has scores, and an error that says what is short about them.
    TargetMissed,
    /// No scores: the stone is none, or cannot be lit.
    Failed,
    /// No scores: the file could not be read.
    IoError,
}

/// One finished row.
#[derive(Debug, Clone, PartialEq)]
pub struct FinishedRow {
    /// How it came out.
    pub outcome: RowStatus,
    /// Points traced for it, by estimator.
    pub samples: Vec<(String, u64)>,
    /// The number that rows are sorted by, if they are.
    pub key: Option<f64>,
    /// The row as it stands in the table, without the line's end.
    pub text: Vec<u8>,
    /// What to say when it is done, if something went wrong.
    pub complaint: Option<String>,
    /// What to say once, however many rows say it: scores that do not apply.
    pub note: Option<String>,
}

/// The first line of a row's record: all of [`FinishedRow`] that the table does not show.
#[derive(Serialize, Deserialize)]
struct RecordHead<'a> {
    outcome: RowStatus,
    #[serde(borrow)]
    samples: Vec<(Cow<'a, str>, u64)>,
    key: Option<f64>,
}

impl FinishedRow {
    /// The record of progress: its head as one line of JSON, which has no line end inside, then the
    /// row's text.
    pub(super) fn record(&self) -> std::io::Result<Vec<u8>> {
        let samples = self.samples.iter().map(|(of, n)| (Cow::from(of), *n)).collect();
        let mut record = serde_json::to_vec(&RecordHead { outcome: self.outcome, samples, key: self.key })?;
        record.push(b'\n');
        record.extend_from_slice(&self.text);
        Ok(record)
    }

    /// The row that [`FinishedRow::record`] was made of, without its complaint, which was made already.
    pub(super) fn parse(record: &[u8]) -> std::io::Result<FinishedRow> {
        let end = record.iter().position(|b| *b == b'\n').ok_or(std::io::ErrorKind::InvalidData)?;
        let head: RecordHead = serde_json::from_slice(&record[..end])?;
        let samples = head.samples.into_iter().map(|(of, n)| (of.into_owned(), n)).collect();
        let text = record[end + 1..].to_vec();
        Ok(FinishedRow { outcome: head.outcome, samples, key: head.key, text, complaint: None, note: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names of estimators and rows hold whatever they hold: blanks, quotes, `=`, line ends.
    #[test]
    fn a_record_gives_its_row_back_whatever_is_in_it() {
        for outcome in [RowStatus::Ok, RowStatus::TargetMissed, RowStatus::Failed, RowStatus::IoError] {
            for name in
                ["view", "view by beams", "a=b = 3", "line\nend\r\n", "\"quoted\" \\", "", "é\u{2028}"]
            {
                let samples = vec![(name.to_owned(), u64::MAX), ("other".to_owned(), 0)];
                let text = format!("\"{name}\",1\n2").into_bytes();
                let line =
                    FinishedRow { outcome, samples, key: Some(-0.1), text, complaint: None, note: None };
                let record = line.record().expect("a record");
                assert_eq!(FinishedRow::parse(&record).expect("its row"), line);
            }
        }
        for old in ["good view by beams=3\nrow", "good\nrow", "", "{}\n", "{\"outcome\":\"good\"}\nrow"] {
            assert!(FinishedRow::parse(old.as_bytes()).is_err(), "{old}");
        }
    }
}
