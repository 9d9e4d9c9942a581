//! `cutlab compare`: stones beside each other, with differences and what they are worth.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::scoring::Scoring;
use super::{stones, words};
use crate::cut::Unit;
use crate::math::stats::Estimate;
use crate::report::page::number;
use crate::report::{Request, versus};
use crate::store::replace;
use crate::study::compare::{Comparison, RUNS, compare, is_significant};
use crate::study::score::{Plan, Subject};
use serde::Serialize;
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab compare round-brilliant tolkowsky
  cutlab compare tolkowsky mine.asc --metrics wlr,fire_streak --error 0.0005 --json
  cutlab compare tolkowsky scan-dn eppler -o out       and a page with pictures and tilt curves

Every stone is scored with the same random numbers in 32 runs, and the error of a difference is the
spread of the runs' differences. A difference beyond three of its errors is called significant.")]
pub struct Args {
    /// The stones; differences are from the first
    #[arg(required = true, num_args = 2.., value_name = "STONE")]
    stones: Vec<OsString>,
    /// A folder for a page that shows them beside each other; it is made
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    scoring: Scoring,
}

/// One metric of all stones, for `--json`.
#[derive(Serialize)]
struct Entry<'a> {
    metric: &'static str,
    unit: &'static str,
    scores: Vec<Scored<'a>>,
    differences: Vec<Differs<'a>>,
}

#[derive(Serialize)]
struct Scored<'a> {
    stone: &'a str,
    #[serde(flatten)]
    score: Option<Estimate>,
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
    args.scoring.notes(console);
    let requests: Vec<Request> = args.stones.iter().map(|s| request(s, args)).collect::<Result<_, _>>()?;
    let subject = |r: &Request| {
        let shape = Ok(r.design.solid()?.into());
        Ok(Subject { stone: r.stone.clone(), material: r.material.clone(), shape, tilt: None })
    };
    let subjects: Vec<Subject> = requests.iter().map(subject).collect::<Result<_, Failure>>()?;
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
    if console.json {
        console.print_json(&entries(&comparison, &plan))?;
    } else {
        console.print(&text(&comparison, &plan))?;
    }
    if let Some(folder) = &args.output {
        let bar = console.steps(versus::STEPS * requests.len());
        let page = versus::html(&requests, &comparison, &plan, &|what| {
            bar.set_message(what);
            bar.inc(1);
        });
        bar.finish_and_clear();
        let path = folder.join("index.html");
        replace::write(&path, page?.as_bytes())?;
        console.note(&format!("wrote {}", path.display()));
    }
    Ok(if short { Code::SomeFailed } else { Code::Done })
}

fn request(stone: &OsStr, args: &Args) -> Result<Request, Failure> {
    let design = stones::open(stone)?.design;
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
        scores: rows.iter().map(|r| Scored { stone: &r.stone, score: r.scores[m] }).collect(),
        differences: rows[1..]
            .iter()
            .zip(&comparison.differences)
            .map(|(row, d)| Differs {
                stone: &row.stone,
                from: &rows[0].stone,
                difference: d[m],
                significant: d[m].map(is_significant),
            })
            .collect(),
    };
    plan.metrics.iter().enumerate().map(entry).collect()
}

/// The table for people.
fn text(comparison: &Comparison, plan: &Plan) -> String {
    let rows = &comparison.rows;
    let shown = |value: Option<Estimate>| match value.map(number) {
        Some((value, Some(error))) => format!("{value} ± {error}"),
        Some((value, None)) => value,
        None => "–".into(),
    };
    let names: Vec<&str> = rows.iter().map(|r| r.stone.as_str()).collect();
    let labels = versus::labels(&names);
    let mut head = vec![String::new()];
    head.extend(labels.iter().cloned());
    head.extend(labels[1..].iter().map(|label| format!("{label} less {}", labels[0])));
    let mut lines = vec![head];
    for (m, metric) in plan.metrics.iter().enumerate() {
        let mut line = vec![metric.name.to_string()];
        line.extend(rows.iter().map(|r| shown(r.scores[m])));
        line.extend(comparison.differences.iter().map(|d| {
            let mark = if d[m].is_some_and(is_significant) { " *" } else { "" };
            let sign = if d[m].is_some_and(|e| e.value > 0.0) { "+" } else { "" };
            format!("{sign}{}{mark}", shown(d[m]))
        }));
        lines.push(line);
    }
    let widths: Vec<usize> =
        (0..lines[0].len()).map(|c| lines.iter().map(|l| l[c].chars().count()).max().unwrap_or(0)).collect();
    let mut out = String::new();
    for line in &lines {
        let cells: Vec<String> =
            line.iter().zip(&widths).map(|(cell, w)| format!("{cell:<w$}", w = *w)).collect();
        out += cells.join("  ").trim_end();
        out += "\n";
    }
    for line in versus::explained(&names) {
        out += &format!("{line}\n");
    }
    out + "after ± one standard error; * a difference beyond three of its errors\n"
}
