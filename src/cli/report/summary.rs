//! The numbers of a report that matter, on standard output.

use crate::cli::args::stone;
use crate::cli::terminal_table;
use crate::report::page::Section;
use crate::report::stone_report::StoneReport;
use crate::sampling::stats::Estimate;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// The numbers that matter, for `--json`.
#[derive(Serialize)]
pub struct ReportSummary {
    folder: String,
    files: Vec<String>,
    scores: BTreeMap<&'static str, BTreeMap<String, Option<Estimate>>>,
    /// `more` or `less` for scores of which either is better by itself.
    better: BTreeMap<String, &'static str>,
    /// Why scores that are null are.
    left_out: BTreeMap<String, String>,
}

impl ReportSummary {
    /// Of a report that was written into a folder.
    pub fn new(bundle: &StoneReport, folder: &Path) -> ReportSummary {
        let scores = bundle
            .sections
            .iter()
            .map(|s| (s.head, s.scores.iter().map(|score| (score.name.clone(), score.value)).collect()));
        let every = bundle.sections.iter().flat_map(|s| &s.scores);
        let better = every.clone().map(|score| (score.name.clone(), score.better.word()));
        let left_out = every.filter_map(|score| Some((score.name.clone(), score.left_out.clone()?)));
        ReportSummary {
            better: better.filter(|(_, word)| !word.is_empty()).collect(),
            left_out: left_out.collect(),
            folder: stone::display_name(folder),
            files: bundle.files.iter().map(|(name, _)| stone::display_name(folder.join(name))).collect(),
            scores: scores.collect(),
        }
    }
}

/// The numbers that matter, and the files.
pub fn text(bundle: &StoneReport, folder: &Path) -> String {
    let mut lines: Vec<(String, String)> = Vec::new();
    for section in bundle.sections.iter().filter(|s| s.large > 0) {
        lines.push((section.head.into(), String::new()));
        for score in section.scores.iter().take(section.large) {
            let unit = if score.unit.is_empty() { String::new() } else { format!(" {}", score.unit) };
            let value = match score.value.map(Estimate::text) {
                Some((value, Some(error))) => format!("{value}{unit} ± {error}"),
                Some((value, None)) => format!("{value}{unit}"),
                None => terminal_table::NONE.into(),
            };
            let better = match score.better.said() {
                "" => String::new(),
                said => format!("  ({said})"),
            };
            lines.push((format!("  {}", score.name), value + &better));
        }
    }
    let mut text = terminal_table::labelled(lines, 0, 0);
    for said in bundle.sections.iter().filter_map(Section::omissions) {
        text += &format!("{said}\n");
    }
    let names: Vec<&str> = bundle.files.iter().rev().map(|(name, _)| *name).collect();
    text + &format!("{}: {}", stone::display_name(folder), names.join(", "))
}
