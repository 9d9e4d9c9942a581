//! `cutlab score`: a table of scores, one row a stone.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::stones::{self, DEFAULT_STONE};
use crate::metrics::{METRICS, Metric};
use crate::optics::Material;
use crate::optics::dispersion::lines;
use crate::store::replace;
use crate::study::score::{Effort, Plan, Row, Subject, score};
use crate::study::table;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab score                                       the reference brilliant, CSV to standard output
  cutlab score designs/ -o scores.csv                every file of a folder
  cutlab score tolkowsky --metrics wlr,fire_streak --error 0.001")]
pub struct Args {
    /// Stones: names from `cutlab list cuts`, with parameters or not, files, or folders of files
    #[arg(default_value = DEFAULT_STONE, value_name = "STONE")]
    stones: Vec<String>,
    /// Where to write the table; - is standard output
    #[arg(long, short, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    /// Scores to compute, all if not given (see `cutlab list metrics`)
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = metric)]
    metrics: Vec<&'static Metric>,
    /// Trace until every standard error is below this, in the metric's unit
    #[arg(long, value_name = "E", value_parser = error)]
    error: Option<f64>,
    /// Whether light keeps its polarisation from facet to facet; off takes it as unpolarised at each
    #[arg(long, value_name = "on|off", default_value = "on", value_parser = stones::on_off, action = clap::ArgAction::Set)]
    polarisation: bool,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    substance: stones::Substance,
    /// Girdle width in millimetres; the scores depend on it if the material absorbs
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
}

/// Scores every stone and writes the table.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let mut plan = Plan { seed: args.seed, polarised: args.polarisation, ..Plan::default() };
    if !args.metrics.is_empty() {
        plan.metrics.clone_from(&args.metrics);
    }
    if let Some(error) = args.error {
        plan.effort = Effort::Error(error);
    }
    let six = plan.metrics.iter().any(|m| m.needs_dispersion());
    let (from, to) = if six { (lines::G, lines::B) } else { (lines::D, lines::D) };
    args.substance.note_range(from, to, console);
    let specs = expanded(&args.stones)?;
    let bar = console.progress(specs.len(), "scoring");
    let rows: Vec<(Row, Option<Code>)> = specs
        .iter()
        .map(|spec| {
            let row = row(spec, args, &plan, console);
            bar.inc(1);
            row
        })
        .collect();
    bar.finish_and_clear();
    let (rows, codes): (Vec<Row>, Vec<Option<Code>>) = rows.into_iter().unzip();

    let text = if console.json {
        let rows: Vec<JsonRow> = rows.iter().map(|row| JsonRow::of(row, &plan)).collect();
        serde_json::to_vec_pretty(&rows).map_err(|e| Failure::input(e.to_string()))?
    } else {
        table::csv(&plan.metrics, &rows).map_err(|e| Failure::input(e.to_string()))?
    };
    replace::write(&args.output, &text)?;
    if args.output != Path::new("-") {
        console.note(&format!("wrote {}: {} stones", args.output.display(), rows.len()));
    }
    for row in &rows {
        if let Some(error) = &row.error {
            console.complain(&format!("{}: {error}", row.stone));
        }
    }
    Ok(code(&rows, &codes))
}

/// Scores one stone; with the code if it could not be opened.
fn row(spec: &str, args: &Args, plan: &Plan, console: &Console) -> (Row, Option<Code>) {
    let opened = stones::open(spec).and_then(|imported| {
        let material = args.substance.of(&imported.design);
        let design = stones::sized_for_colour(imported.design, args.size, &material, console)?;
        Ok((material, design.solid()?))
    });
    let (material, solid, code) = match opened {
        Ok((material, solid)) => (material, Ok(solid), None),
        Err(failure) => {
            let material = args
                .substance
                .material
                .cloned()
                .unwrap_or_else(|| Material::of_index(args.substance.ri.unwrap_or(1.0)));
            (material, Err(failure.message()), Some(failure.code()))
        }
    };
    let known = solid.is_ok() || args.substance.material.is_some() || args.substance.ri.is_some();
    let mut row = score(&Subject { stone: spec.into(), material, solid }, plan);
    if !known {
        row.material.clear();
    }
    (row, code)
}

/// Done, or how many failed: a row whose error was not reached still has its scores.
fn code(rows: &[Row], codes: &[Option<Code>]) -> Code {
    let failed = rows.iter().filter(|r| r.error.is_some()).count();
    let useless = |r: &Row| r.error.is_some() && r.scores.iter().all(Option::is_none);
    match failed {
        0 => Code::Done,
        _ if !rows.iter().all(useless) => Code::SomeFailed,
        _ if codes.iter().all(|c| *c == Some(Code::Io)) => Code::Io,
        _ => Code::NoGoodInput,
    }
}

/// The stones with every folder replaced by its files, by name.
fn expanded(stones: &[String]) -> Result<Vec<String>, Failure> {
    let mut all = Vec::new();
    for stone in stones {
        if !Path::new(stone).is_dir() {
            all.push(stone.clone());
            continue;
        }
        let entries = std::fs::read_dir(stone).and_then(|entries| entries.collect::<Result<Vec<_>, _>>());
        let entries = entries.map_err(|cause| Failure::reading(stone, &cause))?;
        let mut files: Vec<String> = entries
            .iter()
            .map(std::fs::DirEntry::path)
            .filter(|path| path.is_file())
            .map(|path| path.to_string_lossy().into_owned())
            .collect();
        if files.is_empty() {
            return Err(Failure::input(format!("{stone} is a folder without files")));
        }
        files.sort();
        all.extend(files);
    }
    Ok(all)
}

/// Value parser of `--metrics`.
fn metric(name: &str) -> Result<&'static Metric, String> {
    Metric::named(name).ok_or_else(|| {
        let near = stones::nearest(name, METRICS.iter().map(|m| m.name));
        format!("no metric is called '{name}', the nearest is '{near}' (all: cutlab list metrics)")
    })
}

/// Value parser of `--error`.
fn error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(e) if e > 0.0 && e.is_finite() => Ok(e),
        _ => Err("a standard error is a number above 0".into()),
    }
}

/// A row as JSON.
#[derive(Serialize)]
struct JsonRow<'a> {
    stone: &'a str,
    material: &'a str,
    facets: Option<usize>,
    scores: BTreeMap<&'static str, Option<crate::math::stats::Estimate>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

impl<'a> JsonRow<'a> {
    fn of(row: &'a Row, plan: &Plan) -> JsonRow<'a> {
        JsonRow {
            stone: &row.stone,
            material: &row.material,
            facets: row.facets,
            scores: plan.metrics.iter().map(|m| m.name).zip(row.scores.iter().copied()).collect(),
            error: row.error.as_deref(),
        }
    }
}
