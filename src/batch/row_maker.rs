//! Rows of a table: each stone opened and scored, and what is to be said of it said once.

use super::input_files::InputFiles;
use super::table::{self, TableCell, TableError, TableFormat};
use super::table_job::{FinishedRow, RowStatus};
use crate::progress::{Progress, SaidOnce};
use crate::scoring::score::{ScoreInput, ScoreRequest, ScoreRow, Tilt, score};
use crate::stone::{Stone, StoneError, StoneOptions, StoneSpec};
use crate::storage::terminal::one_line;
use crate::storage::text::display_name;
use std::ffi::OsStr;

/// Makes the rows of a table.
pub struct RowMaker<'a> {
    /// What is scored, and how.
    pub scores: &'a ScoreRequest,
    /// The stones' files.
    pub inputs: InputFiles,
    /// All columns of the table.
    pub columns: Vec<String>,
    /// Hears what is to be said of stones.
    pub progress: &'a dyn Progress,
    /// What of them has been said.
    pub said: SaidOnce,
}

impl<'a> RowMaker<'a> {
    /// Of a table with some columns before its scores.
    pub fn new(
        leading: &[&str],
        scores: &'a ScoreRequest,
        inputs: InputFiles,
        progress: &'a dyn Progress,
    ) -> RowMaker<'a> {
        let columns = table::columns(leading, &scores.metrics);
        RowMaker { scores, inputs, columns, progress, said: SaidOnce::default() }
    }

    /// The stone that STONE names: as large as it is asked for, or as its colour needs it.
    fn open(&self, spec: &OsStr, options: &StoneOptions) -> Result<Stone, StoneError> {
        let stone = Stone::open(spec, options)?;
        if let Some(doubt) = stone.orientation_doubt() {
            self.said.note(self.progress, &format!("note: {}: {doubt}", stone.name()), stone.name());
        }
        stone.with_width_for_colour()
    }

    /// Scores the STONE `spec`, whatever becomes of its file meanwhile.
    ///
    /// - `file`: the STONE of the request that it is made of
    pub fn score(
        &self,
        spec: &OsStr,
        file: &OsStr,
        options: &StoneOptions,
        tilt: Option<Tilt>,
    ) -> (ScoreRow, RowStatus) {
        let (row, failure) = match self.open(spec, options) {
            Ok(stone) => (score(&ScoreInput::from_stone(&stone, tilt), self.scores), None),
            Err(failure) => {
                let own = StoneSpec::parse_within(spec, options.limits)
                    .ok()
                    .and_then(|parts| parts.material().cloned());
                let material = own.or(options.asked_material().ok().flatten()).map(|m| m.name.to_string());
                let why = one_line(&failure.to_string());
                let row =
                    ScoreRow::failed(display_name(spec), material.unwrap_or_default(), why, self.scores);
                (row, Some(failure))
            }
        };
        let outcome = match (&row.error, failure) {
            (None, _) => RowStatus::Ok,
            (Some(_), _) if row.scores.iter().any(Option::is_some) => RowStatus::TargetMissed,
            (Some(_), Some(failure)) if failure.is_io() => RowStatus::IoError,
            (Some(_), _) => RowStatus::Failed,
        };
        let (row, outcome) = self.inputs.checked(file, (row, outcome));
        if let Some(note) = row.note {
            self.said.note_of_one(self.progress, &format!("{}: {note}", display_name(spec)), note);
        }
        (row, outcome)
    }

    /// The row as it is kept and written.
    ///
    /// - `leading`: the cells before the scores; `key`: the number that rows are sorted by
    pub fn finished(
        &self,
        (row, outcome): (ScoreRow, RowStatus),
        leading: Vec<TableCell>,
        key: Option<f64>,
        form: TableFormat,
    ) -> Result<FinishedRow, TableError> {
        let complaint = row.error.as_ref().map(|error| {
            if error.contains(&row.stone) { error.clone() } else { format!("{}: {error}", row.stone) }
        });
        Ok(FinishedRow {
            outcome,
            samples: row.samples.iter().map(|(of, n)| (of.to_string(), *n)).collect(),
            key,
            text: form.row(&self.columns, &table::cells(leading, &row))?,
            complaint,
            note: row.omissions(),
        })
    }
}
