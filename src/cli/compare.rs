//! `cutlab compare`: stones beside each other, with differences and what they are worth.

mod written;

use super::console::Console;
use super::outcome::{Code, Failure};
use super::outputs::{Outputs, record};
use super::scoring::Scoring;
use super::{folders, standing, stones, tables, words};
use crate::cut::Unit;
use crate::math::stats::Estimate;
use crate::report::{Request, versus};
use crate::store::replace;
use crate::study::compare::{Comparison, RUNS, compare};
use crate::study::identity::Identity;
use crate::study::meta::Meta;
use crate::study::score::{Plan, Subject};
use crate::study::table::Form;
use serde::Serialize;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use written::Compared;

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
pub struct Args {
    /// The stones, files, folders of files and patterns; differences are from the first
    #[arg(required = true, value_name = "STONE")]
    stones: Vec<OsString>,
    /// A folder for a page that shows them beside each other, which is made; or a file for the table with
    /// the proportions: .csv, .jsonl, .json or .md; - is standard output, CSV or with --json JSON
    #[arg(long, short, value_name = "DIR|FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    scoring: Scoring,
}

/// One metric of all stones, for `--json`.
#[derive(Serialize)]
struct Entry<'a> {
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
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let plan = args.scoring.plan();
    let specs = folders::expanded(&args.stones)?;
    if specs.len() < 2 {
        return Err(Failure::input("a comparison needs two stones or more"));
    }
    let output = args.output.as_deref().map(|path| Output::of(path, console)).transpose()?;
    let mut outputs = Outputs::beside(&specs, console);
    let command = record::own_command();
    match &output {
        Some(Output::Page(path)) => outputs.claim(path, |there| record::is_of(there, &command))?,
        Some(Output::Markdown(path)) => outputs.claim(path, |there| record::is_of(there, &command))?,
        Some(Output::Table(path, _)) => tables::claim_table(path, &command, None, false, &mut outputs)?,
        None => (),
    }
    let requests: Vec<Request> = specs.iter().map(|s| request(s, args)).collect::<Result<_, _>>()?;
    let subject = |r: &Request| {
        let shape = Ok(r.design.solid()?.into());
        Ok(Subject { stone: r.stone.clone(), material: r.material.clone(), shape, tilt: None })
    };
    let subjects: Vec<Subject> = requests.iter().map(subject).collect::<Result<_, Failure>>()?;
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
                return Ok(Code::NoGoodInput);
            }
        }
    }
    let compared = Compared { requests: &requests, comparison: &comparison, plan: &plan };
    let table_is_printed = output.as_ref().is_some_and(|o| replace::is_stdout(o.path()));
    if !table_is_printed && console.json {
        console.print_json(&entries(&comparison, &plan))?;
    } else if !table_is_printed {
        console.print(&compared.text())?;
    }
    if let Some(output) = &output {
        let path = output.path();
        match output {
            Output::Page(_) => {
                let bar = console.steps(versus::STEPS * requests.len());
                let page = versus::html(&requests, &comparison, &plan, &|what| {
                    bar.set_message(what);
                    bar.inc(1);
                });
                bar.finish_and_clear();
                replace::write(path, record::recorded(page?, &command).as_bytes())?;
            }
            Output::Markdown(_) => {
                replace::write(path, record::recorded(compared.markdown(), &command).as_bytes())?;
            }
            Output::Table(_, form) => {
                compared.weight_notes().iter().for_each(|said| console.note(&format!("note: {said}")));
                write_table(&compared, path, *form, command)?;
            }
        }
        if !replace::is_stdout(path) {
            console.note(&format!("wrote {}", stones::shown(&path)));
        }
    }
    Ok(if short { Code::SomeFailed } else { Code::Done })
}

/// What `-o` asks for, by its ending.
enum Output {
    /// A page in a folder.
    Page(PathBuf),
    /// The table for people.
    Markdown(PathBuf),
    /// The table with a row for each metric and stone.
    Table(PathBuf, Form),
}

impl Output {
    fn of(path: &Path, console: &Console) -> Result<Output, Failure> {
        let path = path.to_owned();
        let is_markdown = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("md"));
        if replace::is_stream(&path) && !is_markdown {
            let form = tables::form_of(&path, console)?;
            return Ok(Output::Table(path, form));
        }
        let ending = path.extension().filter(|_| !path.is_dir());
        Ok(match ending {
            Some(_) if is_markdown => Output::Markdown(path),
            Some(_) => {
                let form = Form::of(&path).map_err(|_| {
                    let path = stones::shown(&path);
                    Failure::input(format!("{path}: a comparison is .csv, .jsonl, .json, .md or a folder"))
                })?;
                Output::Table(path, form)
            }
            None => Output::Page(path.join("index.html")),
        })
    }

    fn path(&self) -> &Path {
        match self {
            Output::Page(path) | Output::Markdown(path) | Output::Table(path, _) => path,
        }
    }
}

/// Writes the table, after its companion.
fn write_table(compared: &Compared, path: &Path, form: Form, command: String) -> Result<(), Failure> {
    let bytes = compared.table(form)?;
    if !replace::is_stream(path) {
        let (study, columns) = (Identity::of(&command).hex(), written::COLUMNS.map(String::from).into());
        let crc32 = format!("{:08x}", crc32fast::hash(&bytes));
        let meta = Meta { crc32, ..Meta::new(compared.plan, command, study, columns) };
        let meta = meta.bytes().map_err(|e| Failure::input(e.to_string()))?;
        replace::write(&Meta::beside(path), &meta)?;
    }
    Ok(replace::write(path, &bytes)?)
}

fn request(stone: &OsStr, args: &Args) -> Result<Request, Failure> {
    let imported = stones::open(stone)?;
    standing::note(&stones::shown(stone), &imported);
    let design = imported.design;
    let material = args.scoring.substance.within(stone)?.of(&design);
    let size = args.scoring.size.or((design.unit == Unit::Free).then_some(stones::USUAL_SIZE));
    let design = stones::sized(design, size)?;
    Ok(Request {
        stone: stones::shown(stone),
        design,
        material,
        seed: args.scoring.seed,
        command: words::typed(),
    })
}

fn entries<'a>(comparison: &'a Comparison, plan: &Plan) -> Vec<Entry<'a>> {
    let rows = &comparison.rows;
    let entry = |(m, metric): (usize, &&'static crate::metrics::Metric)| Entry {
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
