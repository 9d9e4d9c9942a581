//! `cutlab sweep`: scores over a grid of parameters, or over scattered points.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::outputs::Outputs;
use super::parameters::Parameters;
use super::plots::{Look, Plots};
use super::scoring::{self, Inputs, Scoring};
use super::stones;
use super::tables::{self, Study, Table};
use super::words::quoted;
use crate::math::typed;
use crate::optics::weight::Weight;
use crate::store::replace;
use crate::study::batch::Line;
use crate::study::meta::Layout;
use crate::study::sweep::{MOST_SCATTERED, Sweep, Varied};
use crate::study::table::{self, Cell};
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

/// Keys that every stone has.
const SIZE: &str = "size";
const INDEX: &str = "ri";

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab sweep round-brilliant --vary crown-angle=20:45:0.5 --metrics wlr -o sweep.csv --plot wlr.svg
  cutlab sweep tolkowsky --vary crown-angle=30:38:0.5 --vary pavilion-angle=40:42:0.1 \\
      --metrics wlr,fire_streak --error 0.001 -o sweep.csv --plot wlr.svg --plot fire_streak.png
  cutlab sweep round-brilliant --vary table=50:65:1 --vary ri=1.5:2.5:0.1 --scatter 200 -o s.csv

Every point is scored with the same random numbers: the error of a difference between two points
is less than the errors of the two together. Common are seed, points of the outline or crown and
directions as shares of what each stone has; paths differ as the stones do.")]
pub struct Args {
    /// The stone: a name from `cutlab list cuts`, with parameters or not
    stone: OsString,
    /// A parameter of the stone, or size or ri, and what it runs through; may be given several times
    #[arg(long, value_name = "KEY=FROM:TO:STEP", required = true)]
    vary: Vec<Varied>,
    /// So many points spread evenly between the ends of the ranges, in place of the grid
    #[arg(long, value_name = "N", value_parser = scattered)]
    scatter: Option<u64>,
    /// Draw a curve (one --vary) or a map (two), .svg, .pdf or .png; a file called METRIC.svg shows that
    /// metric, of any other name one is drawn for each, NAME-METRIC.svg
    #[arg(long, value_name = "FILE")]
    plot: Vec<PathBuf>,
    #[command(flatten)]
    look: Look,
    #[command(flatten)]
    table: Table,
    #[command(flatten)]
    scoring: Scoring,
}

/// Value parser of `--scatter`.
fn scattered(text: &str) -> Result<u64, String> {
    typed::whole(text, 1..=1_000_000_000, "--scatter takes a whole number of points")
}

/// Scores every point and writes the table.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let plan = args.scoring.plan();
    let sweep = Sweep { varied: args.vary.clone(), scatter: args.scatter, seed: args.scoring.seed };
    check(args)?;
    let mut command = format!("cutlab sweep {}", quoted(&stones::shown(&args.stone)));
    for varied in &sweep.varied {
        command += &format!(" --vary {}={}", varied.key, varied.steps);
    }
    if let Some(n) = sweep.scatter {
        command += &format!(" --scatter {n}");
    }
    command += &args.scoring.words();
    let mut leading: Vec<&str> = sweep.varied.iter().map(|v| v.key.as_str()).collect();
    leading.push("facets");
    let columns = table::columns(&leading, &plan.metrics);
    let total = sweep.count().ok_or_else(|| Failure::input("the grid has too many points to count"))?;
    let axes: Vec<String> = sweep.varied.iter().map(|v| v.key.clone()).collect();
    let plots = Plots::of(&args.plot, &plan.metrics, &args.look, &axes)?;
    let layout = Layout {
        stone: stones::shown(&args.stone),
        is_diamond: is_diamond(args)?,
        axes,
        curves: Vec::new(),
        scattered: sweep.scatter.is_some(),
    };
    let inputs = Inputs::of(&command, [args.stone.as_os_str()].into_iter());
    let study = Study {
        identity: inputs.identity.clone(),
        command,
        plan: &plan,
        total,
        layout: Some(layout),
        order: None,
        notes: args.scoring.notes(args.vary.iter().any(|v| v.key == SIZE)),
        what: "sweeping",
        line: &|i, form| {
            let point = sweep.point(i);
            let (spec, scoring) = at(args, &point);
            let (row, outcome) = inputs.checked(&args.stone, scoring.score(&spec, None, &plan));
            let shown = stones::shown(&spec);
            scoring::tell(&shown, &row, console);
            let mut leading: Vec<Cell> = point.iter().map(|x| Cell::number(*x)).collect();
            leading.push(row.facets.into());
            Ok(Line {
                outcome,
                samples: row.samples.iter().map(|(of, n)| (of.to_string(), *n)).collect(),
                key: None,
                text: form.row(&columns, &table::cells(leading, &row))?,
                complaint: tables::complaint(&shown, &row),
                note: row.omissions(),
            })
        },
        columns: columns.clone(),
    };
    study.run(&args.table, &plots, &mut Outputs::beside([&args.stone], console), console)
}

/// The stone at a point, and how to score it.
fn at(args: &Args, point: &[f64]) -> (OsString, Scoring) {
    let is_varied = |key: &str| args.vary.iter().any(|v| v.key == key);
    let has_size = args.stone.to_str().is_some_and(|stone| stones::size_is_parameter(stone, is_varied));
    let mut scoring = args.scoring.clone();
    let mut given = Parameters::default();
    for (varied, &value) in args.vary.iter().zip(point) {
        match varied.key.as_str() {
            INDEX => scoring = scoring.with_index(value),
            SIZE if !has_size => scoring = scoring.with_size(value),
            key => {
                given.0.insert(key.into(), value);
            }
        }
    }
    let spec = match args.stone.to_str() {
        Some(stone) => given.applied_to(stone).into(),
        None => args.stone.clone(), // a file, which has no parameters
    };
    (spec, scoring)
}

/// Whether the stone is of diamond at every point.
fn is_diamond(args: &Args) -> Result<bool, Failure> {
    let design = stones::open(&args.stone)?.design;
    let material = args.scoring.substance.within(&args.stone)?.of(&design);
    Ok(Weight::of(&material).is_diamond() && args.vary.iter().all(|v| v.key != INDEX))
}

/// Whether the stone's family has the parameter `key`.
fn has(stone: &OsStr, key: &str) -> bool {
    stone.to_str().and_then(stones::family).is_some_and(|f| f.keys().any(|p| p.key == key))
}

/// Refuses what cannot be swept or drawn, before anything is scored.
fn check(args: &Args) -> Result<(), Failure> {
    stones::open(&args.stone)?;
    for (i, varied) in args.vary.iter().enumerate() {
        let key = varied.key.as_str();
        if args.vary[..i].iter().any(|v| v.key == key) {
            return Err(Failure::input(format!("--vary {key} is given twice")));
        }
        if ![SIZE, INDEX].contains(&key) && !has(&args.stone, key) {
            let own = args.stone.to_str().and_then(stones::family).map_or(&[][..], |f| f.parameters);
            let mut known: Vec<&str> = own.iter().map(|p| p.key).filter(|k| *k != SIZE).collect();
            known.extend([SIZE, INDEX]);
            return Err(Failure::input(format!(
                "{} has no parameter '{key}': --vary takes {}",
                stones::shown(&args.stone),
                known.join(", ")
            )));
        }
        let (from, to) = (varied.steps.from, varied.steps.to);
        if key == INDEX && (args.scoring.substance.material.is_some() || args.scoring.substance.ri.is_some())
        {
            return Err(Failure::input("--vary ri does not go with --material and --ri"));
        }
        let (low, high, what) = match key {
            INDEX => (1.0, 10.0, "a refractive index is a number from 1 to 10"),
            SIZE => (1e-3, 1e3, "a girdle width is a number of millimetres from 0.001 to 1000"),
            _ => continue,
        };
        if !(low..=high).contains(&from.min(to)) || from.max(to) > high {
            return Err(Failure::input(format!("--vary {key}={}: {what}", varied.steps)));
        }
    }
    if args.scatter.is_some() && args.vary.len() > MOST_SCATTERED {
        return Err(Failure::input(format!("--scatter takes up to {MOST_SCATTERED} varied parameters")));
    }
    let Some(first) = args.plot.first() else { return Ok(()) };
    if args.vary.len() > 2 {
        return Err(Failure::input(format!(
            "{}: a plot has one or two varied parameters; of more the table alone is written",
            stones::shown(&first)
        )));
    }
    if args.table.shard.of > 1 || replace::is_stream(&args.table.output) {
        return Err(Failure::input("--plot needs the whole table in a file: give -o FILE, without --shard"));
    }
    Ok(())
}
