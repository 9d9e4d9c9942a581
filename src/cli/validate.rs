//! `cutlab validate`: published and derivable figures against what this program computes.

use super::args::stone;
use super::args::values;
use super::console::Console;
use super::exit_code::{CliError, ExitStatus};
use super::outputs::Outputs;
use super::terminal_table;
use crate::batch::validate;
use crate::batch::validate::{CheckContext, CheckReport, FigureOutcome, Verdict};
use crate::cli::limits::limits;
use crate::render::{Record, record};
use crate::report::validation::{self, count, expectation, written};
use crate::storage::atomic_write;
use serde::Serialize;
use std::path::PathBuf;

/// Where the table and the page go unless a folder is named.
const FOLDER: &str = "reports";

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab validate                       all figures, a minute; reports/validation.csv and .html
  cutlab validate --only leakage        those whose subject or name says leakage, on the screen alone
  CUTLAB_CORPUS=../corpus cutlab validate   with the figures that need real files

A figure passes if ours lies within its tolerance and 3 standard errors of ours. All are expected to:
exit code 0 if they do, 1 if some failed, which stay in the table with what may explain them. Figures
that need files which are not there are skipped, and count as neither.")]
pub struct ValidateArgs {
    /// A folder for validation.csv and validation.html; it is made [reports; none with --only]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Only figures computed with one whose subject or name has this in it
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    seed: u64,
}

/// A figure, for `--json`.
#[derive(Serialize)]
struct FigureEntry<'a> {
    subject: &'a str,
    figure: &'a str,
    source: &'a str,
    kind: String,
    relation: &'a str,
    expected: f64,
    tolerance: Option<f64>,
    unit: &'a str,
    ours: Option<f64>,
    ours_se: Option<f64>,
    verdict: String,
    why: &'a str,
}

/// Runs the checks and writes what they give.
pub fn run(args: &ValidateArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let mut checks = validate::catalogue();
    if let Some(part) = &args.only {
        checks = validate::only(checks, part);
        if checks.is_empty() {
            return Err(CliError::input(format!(
                "no figure has '{part}' in its name; cutlab validate lists them all"
            )));
        }
    }
    let folder = args.output.clone().or_else(|| args.only.is_none().then(|| FOLDER.into()));
    let record = Record::of_command(record::own_command());
    if let Some(folder) = &folder {
        let is_own = record.matches(&folder.join("validation.html"));
        let mut outputs = Outputs::new(console);
        ["validation.csv", "validation.html"]
            .iter()
            .try_for_each(|name| outputs.claim(&folder.join(name), |_| is_own))?;
    }
    let corpus = std::env::var_os("CUTLAB_CORPUS").map(PathBuf::from);
    let lab = CheckContext { seed: args.seed, corpus, limits: limits() };
    let bar = console.progress(checks.len(), "validating");
    let run = |check: validate::Check| {
        let report = check.run(&lab);
        bar.inc(1);
        report
    };
    let reports: Vec<CheckReport> = checks.into_iter().map(run).collect();
    bar.finish_and_clear();
    let outcomes = || reports.iter().flat_map(|r| &r.outcomes);
    if console.json {
        console.print_json(&outcomes().map(entry).collect::<Vec<_>>())?;
    } else {
        console.print(&text(&reports))?;
    }
    if let Some(folder) = folder {
        let page = record.in_markup(validation::html(&reports, args.seed, &record::command_line()));
        let table = validate::csv(outcomes()).map_err(|e| CliError::input(e.to_string()))?;
        for (name, bytes) in [("validation.csv", &table[..]), ("validation.html", page.as_bytes())] {
            let path = folder.join(name);
            atomic_write::write(&path, bytes)?;
            console.note(&format!("wrote {}", stone::display_name(&path)));
        }
    }
    Ok(if count(&reports, Verdict::Failed) == 0 { ExitStatus::Done } else { ExitStatus::SomeFailed })
}

fn entry(o: &FigureOutcome) -> FigureEntry<'_> {
    FigureEntry {
        subject: o.subject,
        figure: &o.figure.name,
        source: o.figure.source.name,
        kind: o.figure.source.kind.to_string(),
        relation: o.figure.expected.relation(),
        expected: o.figure.expected.value(),
        tolerance: o.figure.expected.tolerance(),
        unit: o.figure.unit,
        ours: o.ours.map(|e| e.value),
        ours_se: o.ours.map(|e| e.error),
        verdict: o.verdict.to_string(),
        why: &o.why,
    }
}

/// The table for people; under it what explains the figures that did not come out.
fn text(reports: &[CheckReport]) -> String {
    let outcomes = || reports.iter().flat_map(|r| &r.outcomes);
    let mut table = terminal_table::new();
    table.set_header(["figure", "kind", "expected", "ours", "", "verdict", "source"]);
    table.add_rows(outcomes().map(|o| {
        let ours = o.ours.map_or("–".into(), |e| written(e, o.figure.expected.tolerance()));
        let f = &o.figure;
        [
            f.name.clone(),
            f.source.kind.to_string(),
            expectation(f),
            ours,
            f.unit.into(),
            o.verdict.to_string(),
            f.source.name.into(),
        ]
    }));
    let mut out = terminal_table::lines(&table);
    out += "\n";
    for o in outcomes().filter(|o| o.verdict == Verdict::Failed && !o.why.is_empty()) {
        out += &format!("{}: {}\n", o.figure.name, o.why);
    }
    let mut skipped: Vec<&str> =
        outcomes().filter(|o| o.verdict == Verdict::Skipped).map(|o| o.why.as_str()).collect();
    skipped.dedup();
    skipped.iter().for_each(|why| out += &format!("skipped: {why}\n"));
    let [passed, failed, skipped] =
        [Verdict::Passed, Verdict::Failed, Verdict::Skipped].map(|v| count(reports, v));
    out + &format!("{passed} passed, {failed} failed, {skipped} skipped\n{}\n", validation::rule())
}
