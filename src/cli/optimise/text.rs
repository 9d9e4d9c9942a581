//! What an optimisation has found, for people, as a table and as JSON.

use crate::cli::changed_stone::ChangedText;
use crate::cli::error::CliError;
use crate::cli::terminal_table::{self, format_estimate};
use crate::design::edit::{DesignChanges, Editor};
use crate::optimise::{Finalist, OptimiseRequest, Optimised};
use crate::parse::format_number;
use crate::report::estimates::plus;
use crate::sampling::stats::Estimate;
use crate::scoring::edit_report::EditReport;
use crate::scoring::gain::Gain;
use crate::scoring::objective::Objective;
use crate::stone::Stone;
use crate::storage::terminal::in_line;
use serde::Serialize;
use std::collections::BTreeMap;

/// What was found, with what it was found for.
pub struct OptimisedText<'a> {
    pub stone: &'a Stone,
    pub request: &'a OptimiseRequest,
    /// The design as it was.
    pub editor: &'a Editor,
    pub found: &'a Optimised,
}

/// An optimisation as JSON.
#[derive(Serialize)]
pub struct OptimisedEntry<'a> {
    stone: &'a str,
    material: String,
    candidates: usize,
    front: usize,
    finalists: Vec<FinalistEntry<'a>>,
    files: &'a [String],
}

#[derive(Serialize)]
struct FinalistEntry<'a> {
    candidate: usize,
    values: BTreeMap<&'a str, f64>,
    objectives: BTreeMap<String, GainEntry>,
    /// The same of stones cut within the tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    within_tolerance: Option<BTreeMap<String, GainEntry>>,
    followed: &'a [String],
}

#[derive(Serialize)]
struct GainEntry {
    start: Estimate,
    value: Estimate,
    gain: Estimate,
    significant: bool,
}

impl<'a> OptimisedText<'a> {
    /// As JSON.
    pub fn entries(&'a self, files: &'a [String]) -> OptimisedEntry<'a> {
        let gain = |(of, gain): (&Objective, &Gain)| {
            let Gain { start, value, gain, is_significant: significant, .. } = *gain;
            (of.name(), GainEntry { start, value, gain, significant })
        };
        let objectives = |gains: &[Gain]| self.request.objectives.iter().zip(gains).map(gain).collect();
        let finalist = |f: &'a Finalist| FinalistEntry {
            candidate: f.candidate,
            values: self
                .found
                .degrees
                .iter()
                .map(|d| d.name.as_str())
                .zip(f.values.iter().copied())
                .collect(),
            objectives: objectives(&f.gains),
            within_tolerance: f.tolerant_gains.as_deref().map(objectives),
            followed: &f.edited.followed,
        };
        OptimisedEntry {
            stone: self.stone.name(),
            material: self.stone.material().name.to_string(),
            candidates: self.found.candidates.len(),
            front: self.found.front.len(),
            finalists: self.found.finalists.iter().map(finalist).collect(),
            files,
        }
    }

    /// For people.
    pub fn text(&self) -> Result<String, CliError> {
        let found = self.found;
        let mut text = format!("{} ({})\n", in_line(self.stone.name()), self.stone.material().name);
        let Some(best) = found.finalists.first() else {
            return Ok(text + "no design keeps the bounds\n");
        };
        let mut table = terminal_table::new();
        table.set_header(["", "start", "range", "best"]);
        for (degree, value) in found.degrees.iter().zip(&best.values) {
            let (from, to) = (degree.range.start(), degree.range.end());
            let range = format!("{} to {}", format_number(*from), format_number(*to));
            table.add_row([degree.name.clone(), rounded(degree.start), range, rounded(*value)]);
        }
        text += &terminal_table::lines(&table);
        let mut table = terminal_table::new();
        table.set_header(["", "start", "best", "gain", ""]);
        let objectives = || self.request.objectives.iter();
        let within = objectives().zip(best.tolerant_gains.iter().flatten());
        let within = within.map(|(of, gain)| (self.request.searched_name(of), gain));
        let as_drawn = objectives().zip(&best.gains).map(|(of, gain)| (of.name(), gain));
        for (name, gain) in within.chain(as_drawn) {
            table.add_row([
                name,
                format_estimate(gain.start),
                format_estimate(gain.value),
                format!("{}{}", plus(gain.gain), format_estimate(gain.gain)),
                gain.said().to_owned(),
            ]);
        }
        text += &format!("\n{}", terminal_table::lines(&table));
        if found.finalists.len() > 1 {
            text += &format!("\n{}", self.others());
        }
        let changes = DesignChanges::new(self.editor, &best.edited);
        let report = EditReport::new(self.stone, &best.edited.design, changes)?;
        text += &format!("\nbest: {}", ChangedText::new(&report).text());
        text += &format!(
            "{} candidates; gains by fresh random numbers, after ± one standard error\n",
            found.candidates.len()
        );
        Ok(text)
    }

    /// The designs that are kept, one a line.
    fn others(&self) -> String {
        let mut table = terminal_table::new();
        let names = self.request.objectives.iter().map(|of| self.request.searched_name(of));
        let heads =
            ["".to_owned()].into_iter().chain(names).chain(self.found.degrees.iter().map(|d| d.name.clone()));
        table.set_header(heads);
        for (i, finalist) in self.found.finalists.iter().enumerate() {
            let gains = finalist.searched_gains().iter().map(|g| format_estimate(g.value));
            let values = finalist.values.iter().map(|v| rounded(*v));
            table.add_row([(i + 1).to_string()].into_iter().chain(gains).chain(values));
        }
        terminal_table::lines(&table)
    }
}

/// A value of a variable as people read it.
fn rounded(value: f64) -> String {
    format_number((value * 1e4).round() / 1e4)
}

/// The candidates of the front as CSV: variables, then objectives as the search saw them.
pub fn front_table(found: &Optimised, request: &OptimiseRequest) -> Result<Vec<u8>, CliError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let names = request.objectives.iter().map(|of| request.searched_name(of));
    let head =
        ["candidate".to_owned()].into_iter().chain(found.degrees.iter().map(|d| d.name.clone())).chain(names);
    let failed = |error: csv::Error| CliError::input(error.to_string());
    table.write_record(head).map_err(failed)?;
    for &number in &found.front {
        let candidate = &found.candidates[number];
        let signed = request.objectives.iter().zip(&candidate.outcome.objectives);
        let values = candidate.values.iter().copied().chain(signed.map(|(of, value)| of.aim.sign() * value));
        let row = [number.to_string()].into_iter().chain(values.map(|value| format!("{value:.9}")));
        table.write_record(row).map_err(failed)?;
    }
    table.into_inner().map_err(|error| CliError::input(error.to_string()))
}
