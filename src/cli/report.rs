//! `cutlab report`: everything about one stone, on one page.

use super::args::inputs;
use super::args::stone::{self, DEFAULT_STONE, StoneArgs};
use super::args::values;
use super::console::Console;
use super::exit_code::{CliError, ExitStatus};
use super::import::plan;
use super::outputs::Outputs;
use super::terminal_table;
use crate::batch::fingerprint::Fingerprint;
use crate::optics::dispersion::VISIBLE_NM;
use crate::render::{Record, record};
use crate::report::page::Section;
use crate::report::stone_report::{self, STEPS, StoneReport};
use crate::report::{self, ReportError, ReportInput, ReportRequest};
use crate::sampling::stats::Estimate;
use crate::storage::journal::Journal;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab report tolkowsky -o out       writes into out/
  cutlab report designs/ -o out        every design of a folder, each into a folder of its own in out/

index.html shows it all and needs nothing beside it, on a screen, a phone or paper: pictures, proportions,
the cutting diagram, every score beside five reference stones of the same material, scores against the
tilt, and for round brilliants their place on the map of light return. Beside it stand the pictures
(table.png, aset.png, ideal-scope.png, windows.png, brightness.png), diagram.svg, scores.csv, stone.obj and
stone.toml. Each picture from above is of the same light and stone as the scores beside it.")]
pub struct ReportArgs {
    /// Stones: names from `cutlab list cuts`, with parameters or not, files, folders of files, patterns;
    /// of several, each has a folder of its own in -o
    #[arg(default_value = DEFAULT_STONE, value_name = "STONE")]
    stones: Vec<OsString>,
    /// The folder to write into; it is made
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,
    /// Girdle width in millimetres [the stone's own, or 6.5]
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    size: Option<f64>,
    #[command(flatten)]
    stone_args: StoneArgs,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    seed: u64,
}

/// The numbers that matter, for `--json`.
#[derive(Serialize)]
struct ReportSummary {
    folder: String,
    files: Vec<String>,
    scores: BTreeMap<&'static str, BTreeMap<String, Option<Estimate>>>,
    /// `more` or `less` for scores of which either is better by itself.
    better: BTreeMap<String, &'static str>,
    /// Why scores that are null are.
    left_out: BTreeMap<String, String>,
}

/// Makes the reports and writes them.
pub fn run(args: &ReportArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let request = ReportRequest {
        stones: args.stones.iter().map(stone::display_name).collect(),
        options: args.stone_args.options(args.size),
        seed: args.seed,
    };
    let specs = inputs::expanded(&args.stones)?;
    let folders: Vec<PathBuf> = match &args.stones[..] {
        [stone] if specs.len() == 1 && specs[0] == *stone => vec![args.output.clone()],
        _ => plan::places_of(&specs).into_iter().map(|place| args.output.join(place)).collect(),
    };
    let mut outputs = Outputs::reading_stones(&specs, console);
    // every place is tried before the first report, which takes half a minute
    for folder in &folders {
        claim(folder, &request, &mut outputs)?;
    }
    let range = args.stone_args.range_note(VISIBLE_NM.0, VISIBLE_NM.1);
    range.iter().for_each(|note| console.note(note));
    let mut results: Vec<Result<ReportSummary, CliError>> = Vec::new();
    for (stone, folder) in specs.iter().zip(&folders) {
        let result = one(stone, folder, &request, console);
        if let (Err(failure), true) = (&result, specs.len() > 1) {
            console.complain(&failure.message());
        }
        results.push(result);
    }
    if results.len() == 1 {
        let summary = results.pop().unwrap_or_else(|| Err(CliError::input("no stone")))?;
        if console.json {
            console.print_json(&summary)?;
        }
        return Ok(ExitStatus::Done);
    }
    if console.json {
        console.print_json(&results.iter().flatten().collect::<Vec<_>>())?;
    }
    Ok(stone::code(&results))
}

/// What is kept of a report while its files are written.
fn identity(request: &ReportRequest) -> String {
    format!("report {}", Fingerprint::of_request(request).hex())
}

/// What the page of a report says of where it comes from.
fn own_record(request: &ReportRequest) -> Record {
    Record::of_request(record::own_command(), request)
}

/// Takes the places of all files of the report in a folder.
fn claim(folder: &Path, request: &ReportRequest, outputs: &mut Outputs) -> Result<(), CliError> {
    let page = folder.join("index.html");
    let begun = Journal::belongs_to(&Journal::path_for(&page), &identity(request));
    let is_own = begun || own_record(request).matches(&page);
    stone_report::files().iter().try_for_each(|name| outputs.claim(&folder.join(name), |_| is_own))
}

/// Makes the report of one stone.
fn one(
    stone: &OsStr,
    folder: &Path,
    request: &ReportRequest,
    console: &Console,
) -> Result<ReportSummary, CliError> {
    let stone = request.open(stone)?;
    let design = stone.convex_design()?.clone();
    stone.warnings().iter().for_each(|w| console.note(&format!("note: {w}")));
    let input = ReportInput {
        stone: stone.name().into(),
        design,
        material: stone.material().clone(),
        seed: request.seed,
        command: record::command_line(),
    };
    let bar = console.steps(STEPS);
    let bundle = report::make(&input, &|what| {
        bar.set_message(what);
        bar.inc(1);
    });
    bar.finish_and_clear();
    let mut bundle = bundle?;
    for (name, bytes) in &mut bundle.files {
        if *name == "index.html" {
            bytes.extend(own_record(request).behind().bytes());
        }
    }
    // what a kill leaves of the files is known as this command's
    let progress = Journal::path_for(&folder.join("index.html"));
    let progress = Journal::open(&progress, &identity(request), &|_| ())?;
    bundle.write(folder)?;
    progress.finish()?;
    if !console.json {
        console.print(&text(&bundle, folder))?;
    }
    let scores = bundle
        .sections
        .iter()
        .map(|s| (s.head, s.scores.iter().map(|score| (score.name.clone(), score.value)).collect()));
    let every = bundle.sections.iter().flat_map(|s| &s.scores);
    let better = every.clone().map(|score| (score.name.clone(), score.better.word()));
    let left_out = every.filter_map(|score| Some((score.name.clone(), score.left_out.clone()?)));
    Ok(ReportSummary {
        better: better.filter(|(_, word)| !word.is_empty()).collect(),
        left_out: left_out.collect(),
        folder: stone::display_name(folder),
        files: bundle.files.iter().map(|(name, _)| stone::display_name(folder.join(name))).collect(),
        scores: scores.collect(),
    })
}

/// The numbers that matter, and the files.
fn text(bundle: &StoneReport, folder: &Path) -> String {
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

impl From<ReportError> for CliError {
    fn from(error: ReportError) -> CliError {
        match error {
            ReportError::Format(error) => error.into(),
            _ => CliError::input(error.to_string()),
        }
    }
}
