//! `cutlab report`: everything about one stone, on one page.

mod options;
mod summary;

use super::args::stone;
use super::console::Console;
use super::each_stone;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use crate::batch::output_places;
use crate::batch::stone_files::expand_stones;
use crate::cli::limits::limits;
use crate::optics::dispersion::VISIBLE_NM;
use crate::render::{Record, record};
use crate::report::stone_report::{self, STEPS};
use crate::report::{self, ReportRequest};
use crate::storage::journal::Journal;
pub use options::ReportArgs;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use summary::ReportSummary;

/// Makes the reports and writes them.
pub fn run(args: &ReportArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let request = ReportRequest {
        stones: args.stones.iter().map(stone::display_name).collect(),
        options: args.stone_args.options(args.size),
        polarised: args.polarisation,
        seed: args.seed,
        error: args.error,
        width: args.width,
    };
    let specs = expand_stones(&args.stones, limits())?;
    let folders: Vec<PathBuf> = match &args.stones[..] {
        [stone] if specs.len() == 1 && specs[0] == *stone => vec![args.output.clone()],
        _ => output_places::places_of(&specs).into_iter().map(|place| args.output.join(place)).collect(),
    };
    let mut outputs = Outputs::reading_stones(&specs, console);
    let identity = format!("report {}", request.identity(&specs));
    // every place is tried before the first report, which takes half a minute
    let record = Record::of_request(record::own_command(), &request);
    for folder in &folders {
        claim(folder, &identity, &record, &mut outputs)?;
    }
    let range = args.stone_args.range_note(VISIBLE_NM.0, VISIBLE_NM.1);
    range.iter().for_each(|note| console.note(note));
    let mut results: Vec<Result<ReportSummary, CliError>> = Vec::new();
    for (stone, folder) in specs.iter().zip(&folders) {
        let result = one(stone, folder, (&request, &identity), console);
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
    Ok(each_stone::code(&results))
}

/// Takes the places of all files of the report in a folder.
///
/// - `identity`: what is kept of a report while its files are written
fn claim(folder: &Path, identity: &str, record: &Record, outputs: &mut Outputs) -> Result<(), CliError> {
    let page = folder.join("index.html");
    let begun = Journal::belongs_to(&Journal::path_for(&page), identity);
    let is_own = begun || record.matches(&page);
    stone_report::files().iter().try_for_each(|name| outputs.claim(&folder.join(name), |_| is_own))
}

/// Makes the report of one stone.
fn one(
    stone: &OsStr,
    folder: &Path,
    (request, identity): (&ReportRequest, &str),
    console: &Console,
) -> Result<ReportSummary, CliError> {
    let stone = request.open(stone).map_err(|error| CliError::needs_convex("a report", error))?;
    stone.warnings().iter().for_each(|w| console.note(&format!("note: {w}")));
    let input = request.input(&stone, record::command_line())?;
    let bar = console.steps(STEPS);
    let bundle = report::make(&input, &|what| {
        bar.set_message(what);
        bar.inc(1);
    });
    bar.finish_and_clear();
    let mut bundle = bundle?;
    for (name, bytes) in &mut bundle.files {
        if *name == "index.html" {
            bytes.extend(Record::of_request(record::own_command(), request).behind().bytes());
        }
    }
    // what a kill leaves of the files is known as this command's
    let progress = Journal::path_for(&folder.join("index.html"));
    let progress = Journal::open(&progress, identity, &|_| ())?;
    bundle.write(folder)?;
    progress.finish()?;
    if !console.json {
        console.print(&summary::text(&bundle, folder))?;
    }
    Ok(ReportSummary::new(&bundle, folder))
}
