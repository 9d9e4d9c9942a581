//! `cutlab compare`: stones beside each other, with differences and what they are worth.

mod text;

use super::args::scoring::ScoringArgs;
use super::args::{inputs, stone, tables};
use super::console::Console;
use super::exit_code::{CliError, ExitStatus};
use super::outputs::Outputs;
use crate::batch::fingerprint::Fingerprint;
use crate::batch::request::{ComparisonTable, TableRequest};
use crate::batch::sidecar::TableMeta;
use crate::batch::table::TableFormat;
use crate::render::{Record, record};
use crate::report::{ReportInput, comparison_page};
use crate::sampling::stats::Estimate;
use crate::scoring::comparison::{Comparison, RUNS, compare};
use crate::scoring::score::{ScoreInput, ScoreRequest};
use crate::storage::atomic_write;
use serde::Serialize;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use text::Compared;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab compare round-brilliant tolkowsky
  cutlab compare tolkowsky mine.asc --metrics wlr,fire_streak --error 0.0005 --json
  cutlab compare D.asc:material=quartz D.asc:material=topaz    one design in two materials
  cutlab compare designs/ --metrics iso,wlr -o all.csv  a row for each metric and stone; also .md
  cutlab compare tolkowsky scan-dn eppler -o out       and a page with pictures and tilt curves

Every stone is scored with the same random numbers in 32 runs, and the error of a difference is the
spread of the runs' differences. A difference is called significant if it is beyond three of its
errors and not negligible: more than 1e-6 of the metric's scale (1, or 100 for percentages), or 1e-4
where photons are traced, because they are followed until 1e-4 of their light is left.")]
pub struct CompareArgs {
    /// The stones, files, folders of files and patterns; differences are from the first
    #[arg(required = true, value_name = "STONE")]
    stones: Vec<OsString>,
    /// A folder for a page that shows them beside each other, which is made; or a file for the table with
    /// the proportions: .csv, .jsonl, .json or .md; - is standard output, CSV or with --json JSON
    #[arg(long, short, value_name = "DIR|FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    scoring: ScoringArgs,
}

/// One metric of all stones, for `--json`.
#[derive(Serialize)]
struct MetricEntry<'a> {
    metric: &'static str,
    unit: &'static str,
    /// `more` or `less`, if either is better by itself.
    better: Option<&'static str>,
    /// Differences up to this are never significant.
    negligible: f64,
    scores: Vec<Scored<'a>>,
    differences: Vec<Differs<'a>>,
}

#[derive(Serialize)]
struct Scored<'a> {
    stone: &'a str,
    material: &'a str,
    #[serde(flatten)]
    score: Option<Estimate>,
    /// Why there is no score.
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<&'a str>,
}

#[derive(Serialize)]
struct Differs<'a> {
    stone: &'a str,
    from: &'a str,
    #[serde(flatten)]
    difference: Option<Estimate>,
    significant: Option<bool>,
}

/// Compares the stones.
pub fn run(args: &CompareArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let plan = args.scoring.plan();
    let specs = inputs::expanded(&args.stones)?;
    if specs.len() < 2 {
        return Err(CliError::input("a comparison needs two stones or more"));
    }
    let output = args.output.as_deref().map(|path| ComparisonFormat::from_path(path, console)).transpose()?;
    let mut outputs = Outputs::reading_stones(&specs, console);
    let request = TableRequest::Compare(ComparisonTable {
        stones: args.stones.iter().map(stone::display_name).collect(),
        options: args.scoring.options(),
        scores: plan.clone(),
    });
    let record = Record::of_request(record::own_command(), &request);
    match &output {
        Some(ComparisonFormat::Page(path)) => outputs.claim(path, |there| record.matches(there))?,
        Some(ComparisonFormat::Markdown(path)) => outputs.claim(path, |there| record.matches(there))?,
        Some(ComparisonFormat::Table(path, _)) => {
            tables::claim_table(path, &|meta| meta.is_of(&request), None, false, &mut outputs)?
        }
        None => (),
    }
    let requests: Vec<ReportInput> =
        specs.iter().map(|s| report_request(s, args, console)).collect::<Result<_, _>>()?;
    let subject = |r: &ReportInput| {
        let shape = Ok(r.design.solid()?.into());
        Ok(ScoreInput { stone: r.stone.clone(), material: r.material.clone(), shape, tilt: None })
    };
    let subjects: Vec<ScoreInput> = requests.iter().map(subject).collect::<Result<_, CliError>>()?;
    args.scoring.notes(false).iter().for_each(|note| console.note(note));
    let bar = console.progress(if args.scoring.is_exact() { 1 } else { RUNS as usize }, "comparing");
    let comparison = compare(&subjects, &plan, &|| bar.inc(1));
    bar.finish_and_clear();
    let mut short = false;
    for row in &comparison.rows {
        if let Some(error) = &row.error {
            console.complain(&format!("{}: {error}", row.stone));
            short = true;
            if row.scores.iter().all(Option::is_none) {
                return Ok(ExitStatus::NoGoodInput);
            }
        }
    }
    let compared = Compared { requests: &requests, comparison: &comparison, plan: &plan };
    let table_is_printed = output.as_ref().is_some_and(|o| atomic_write::is_stdout(o.path()));
    if !table_is_printed && console.json {
        console.print_json(&entries(&comparison, &plan))?;
    } else if !table_is_printed {
        console.print(&compared.text())?;
    }
    if let Some(output) = &output {
        let path = output.path();
        match output {
            ComparisonFormat::Page(_) => {
                let bar = console.steps(comparison_page::STEPS * requests.len());
                let page = comparison_page::html(&requests, &comparison, &plan, &|what| {
                    bar.set_message(what);
                    bar.inc(1);
                });
                bar.finish_and_clear();
                atomic_write::write(path, record.in_markup(page?).as_bytes())?;
            }
            ComparisonFormat::Markdown(_) => {
                atomic_write::write(path, record.in_markup(compared.markdown()).as_bytes())?;
            }
            ComparisonFormat::Table(_, form) => {
                compared.weight_notes().iter().for_each(|said| console.note(&format!("note: {said}")));
                write_table(&compared, path, *form, &request)?;
            }
        }
        if !atomic_write::is_stdout(path) {
            console.note(&format!("wrote {}", stone::display_name(path)));
        }
    }
    Ok(if short { ExitStatus::SomeFailed } else { ExitStatus::Done })
}

/// What `-o` asks for, by its extension.
enum ComparisonFormat {
    /// A page in a folder.
    Page(PathBuf),
    /// The table for people.
    Markdown(PathBuf),
    /// The table with a row for each metric and stone.
    Table(PathBuf, TableFormat),
}

impl ComparisonFormat {
    fn from_path(path: &Path, console: &Console) -> Result<ComparisonFormat, CliError> {
        let path = path.to_owned();
        let is_markdown = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("md"));
        if atomic_write::is_stream(&path) && !is_markdown {
            let form = tables::format_of(&path, console)?;
            return Ok(ComparisonFormat::Table(path, form));
        }
        let extension = path.extension().filter(|_| !path.is_dir());
        Ok(match extension {
            Some(_) if is_markdown => ComparisonFormat::Markdown(path),
            Some(_) => {
                let form = TableFormat::from_path(&path).map_err(|_| {
                    let path = stone::display_name(&path);
                    CliError::input(format!("{path}: a comparison is .csv, .jsonl, .json, .md or a folder"))
                })?;
                ComparisonFormat::Table(path, form)
            }
            None => ComparisonFormat::Page(path.join("index.html")),
        })
    }

    fn path(&self) -> &Path {
        match self {
            ComparisonFormat::Page(path)
            | ComparisonFormat::Markdown(path)
            | ComparisonFormat::Table(path, _) => path,
        }
    }
}

/// Writes the table, after its sidecar.
fn write_table(
    compared: &Compared,
    path: &Path,
    form: TableFormat,
    request: &TableRequest,
) -> Result<(), CliError> {
    let bytes = compared.table(form)?;
    if !atomic_write::is_stream(path) {
        let (study, columns) =
            (Fingerprint::of_request(request).hex(), text::COLUMNS.map(String::from).into());
        let crc32 = format!("{:08x}", crc32fast::hash(&bytes));
        let meta = TableMeta { crc32, ..TableMeta::new(request, study, columns) };
        let meta = meta.bytes().map_err(|e| CliError::input(e.to_string()))?;
        atomic_write::write(&TableMeta::path_for(path), &meta)?;
    }
    Ok(atomic_write::write(path, &bytes)?)
}

fn report_request(stone: &OsStr, args: &CompareArgs, console: &Console) -> Result<ReportInput, CliError> {
    let stone = args.scoring.open(stone, console)?.with_usual_width()?;
    Ok(ReportInput {
        stone: stone.name().into(),
        design: stone.convex_design()?.clone(),
        material: stone.material().clone(),
        seed: args.scoring.seed,
        command: record::command_line(),
    })
}

fn entries<'a>(comparison: &'a Comparison, plan: &ScoreRequest) -> Vec<MetricEntry<'a>> {
    let rows = &comparison.rows;
    let entry = |(m, metric): (usize, &&'static crate::metrics::Metric)| MetricEntry {
        metric: metric.name,
        unit: metric.unit,
        better: Some(metric.better.word()).filter(|word| !word.is_empty()),
        negligible: comparison.negligible[m],
        scores: rows
            .iter()
            .map(|r| Scored {
                stone: &r.stone,
                material: &r.material,
                score: r.scores[m],
                left_out: r.why_left_out(metric),
            })
            .collect(),
        differences: rows[1..]
            .iter()
            .enumerate()
            .map(|(other, row)| Differs {
                stone: &row.stone,
                from: &rows[0].stone,
                difference: comparison.differences[other][m],
                significant: comparison.is_significant(other, m),
            })
            .collect(),
    };
    plan.metrics.iter().enumerate().map(entry).collect()
}
