//! `cutlab sweep`: scores over a grid of parameters, or over scattered points.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::parameters::Parameters;
use super::scoring::{Inputs, Scoring};
use super::stones;
use super::tables::{self, Study, Table};
use super::words::quoted;
use crate::math::typed;
use crate::report::plot::{self, Axis};
use crate::report::raster;
use crate::store::replace;
use crate::study::batch::Line;
use crate::study::sweep::{MOST_SCATTERED, Sweep, Varied};
use crate::study::table::{self, Cell, Form};
use std::path::{Path, PathBuf};

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
    stone: String,
    /// A parameter of the stone, or size or ri, and what it runs through; may be given several times
    #[arg(long, value_name = "KEY=FROM:TO:STEP", required = true)]
    vary: Vec<Varied>,
    /// So many points spread evenly between the ends of the ranges, in place of the grid
    #[arg(long, value_name = "N", value_parser = scattered)]
    scatter: Option<u64>,
    /// Draw a curve (one --vary) or a map (two), .svg or .png; a file called METRIC.svg shows that
    /// metric, of any other name one is drawn for each, NAME-METRIC.svg
    #[arg(long, value_name = "FILE")]
    plot: Vec<PathBuf>,
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
    // a size that is varied is not a size that nobody gave
    let size = args.vary.iter().find(|v| v.key == SIZE);
    size.map_or(args.scoring.clone(), |v| args.scoring.clone().with_size(v.steps.from)).notes(console);
    let mut command = format!("cutlab sweep {}", quoted(&args.stone));
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
    let inputs = Inputs::of(&command, [args.stone.as_str()].into_iter());
    let study = Study {
        identity: inputs.identity.clone(),
        command,
        plan: &plan,
        total,
        what: "sweeping",
        line: &|i, form| {
            let point = sweep.point(i);
            let (spec, scoring) = at(args, &point);
            let (row, outcome) = inputs.checked(&args.stone, scoring.score(&spec, None, &plan));
            let mut leading: Vec<Cell> = point.iter().map(|x| Cell::number(*x)).collect();
            leading.push(row.facets.into());
            Ok(Line {
                outcome,
                samples: row.samples.iter().map(|(of, n)| (of.to_string(), *n)).collect(),
                text: form.row(&columns, &table::cells(leading, &row))?,
                complaint: tables::complaint(&spec, &row),
            })
        },
        columns: columns.clone(),
    };
    let draw = |bytes: &[u8], form: Form| plots(args, &sweep, &plan.metrics, bytes, form);
    study.run(&args.table, console, if args.plot.is_empty() { None } else { Some(&draw) })
}

/// The stone at a point, and how to score it.
fn at(args: &Args, point: &[f64]) -> (String, Scoring) {
    let has_size = has(&args.stone, SIZE);
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
    (given.applied_to(&args.stone), scoring)
}

/// Whether the stone's family has the parameter `key`.
fn has(stone: &str, key: &str) -> bool {
    stones::family(stone).is_some_and(|f| f.parameters.iter().any(|p| p.key == key))
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
            let own = stones::family(&args.stone).map_or(&[][..], |f| f.parameters);
            let mut known: Vec<&str> = own.iter().map(|p| p.key).filter(|k| *k != SIZE).collect();
            known.extend([SIZE, INDEX]);
            return Err(Failure::input(format!(
                "{} has no parameter '{key}': --vary takes {}",
                args.stone,
                known.join(", ")
            )));
        }
        let (from, to) = (varied.steps.from, varied.steps.to);
        if key == INDEX && (args.scoring.substance.material.is_some() || args.scoring.substance.ri.is_some())
        {
            return Err(Failure::input("--vary ri does not go with --material and --ri"));
        }
        if key == INDEX && !(1.0..=10.0).contains(&from.min(to)) {
            return Err(Failure::input("a refractive index is a number from 1 to 10"));
        }
    }
    if args.scatter.is_some() && args.vary.len() > MOST_SCATTERED {
        return Err(Failure::input(format!("--scatter takes up to {MOST_SCATTERED} varied parameters")));
    }
    let Some(first) = args.plot.first() else { return Ok(()) };
    if args.vary.len() > 2 {
        return Err(Failure::input(format!(
            "{}: a plot has one or two varied parameters; of more the table alone is written",
            first.display()
        )));
    }
    if args.table.shard.of > 1 || replace::is_stream(&args.table.output) {
        return Err(Failure::input("--plot needs the whole table in a file: give -o FILE, without --shard"));
    }
    match args.plot.iter().find(|p| picture(p).is_none()) {
        Some(p) => Err(Failure::input(format!("{}: plots are .svg or .png", p.display()))),
        None => Ok(()),
    }
}

/// `svg` or `png`, by the file's ending.
fn picture(path: &Path) -> Option<&'static str> {
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    ["svg", "png"].into_iter().find(|e| *e == ending)
}

/// Draws the plots asked for; their files.
fn plots(
    args: &Args,
    sweep: &Sweep,
    metrics: &[&'static crate::metrics::Metric],
    bytes: &[u8],
    form: Form,
) -> Result<Vec<PathBuf>, Failure> {
    let family = stones::family(&args.stone);
    let axes: Vec<Axis> = sweep.varied.iter().map(|v| Axis::of(&v.key, family)).collect();
    let mut written = Vec::new();
    for path in &args.plot {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let own: Vec<_> = metrics.iter().filter(|m| m.name == stem).collect();
        let all = own.is_empty() && metrics.len() > 1;
        let wanted = if own.is_empty() { metrics.iter().collect() } else { own };
        for metric in wanted {
            let drawing = plot::Drawing { metric, axes: &axes, stone: &args.stone, family, own: None };
            let svg = drawing.svg(&table::Numbers::read(bytes, form)?, sweep.scatter.is_some());
            let ending = picture(path).unwrap_or("svg");
            let target = if all {
                path.with_file_name(format!("{stem}-{}.{ending}", metric.name))
            } else {
                path.clone()
            };
            if ending == "svg" {
                replace::write(&target, svg.as_bytes())?;
            } else {
                let png = raster::png(&svg, plot::PIXELS).map_err(|e| Failure::input(e.to_string()))?;
                replace::write(&target, &png)?;
            }
            written.push(target);
        }
    }
    Ok(written)
}
