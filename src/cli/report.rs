//! `cutlab report`: everything about one stone, on one page.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::stones::{self, DEFAULT_STONE};
use super::words;
use crate::cut::Unit;
use crate::math::stats::Estimate;
use crate::optics::dispersion::VISIBLE_UM;
use crate::report::bundle::STEPS;
use crate::report::page::number;
use crate::report::{self, ReportError, Request};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cutlab report tolkowsky -o out       writes into out/

index.html shows it all and needs nothing beside it, on a screen, a phone or paper: pictures, proportions,
the cutting diagram, every score beside five reference stones, scores against the tilt, and for round
brilliants their place on the map of light return. Beside it stand the pictures (table.png, aset.png,
ideal-scope.png, windows.png), diagram.svg, scores.csv, stone.obj and stone.toml.")]
pub struct Args {
    /// The stone: a name from `cutlab list cuts`, with parameters or not, or a file
    #[arg(default_value = DEFAULT_STONE)]
    stone: OsString,
    /// The folder to write into; it is made
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,
    /// Girdle width in millimetres [the stone's own, or 6.5]
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
    #[command(flatten)]
    substance: stones::Substance,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

/// The numbers that matter, for `--json`.
#[derive(Serialize)]
struct Summary {
    folder: PathBuf,
    files: Vec<PathBuf>,
    scores: BTreeMap<&'static str, BTreeMap<String, Option<Estimate>>>,
}

/// Makes the report and writes it.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let imported = stones::open(&args.stone)?;
    imported.warnings.iter().for_each(|w| console.note(&format!("note: {w}")));
    let material = args.substance.within(&args.stone)?.of(&imported.design);
    args.substance.note_range(VISIBLE_UM.0, VISIBLE_UM.1, console);
    let size = args.size.or((imported.design.unit == Unit::Free).then_some(stones::USUAL_SIZE));
    let design = stones::sized(imported.design, size)?;
    let request = Request {
        stone: stones::shown(&args.stone),
        design,
        material,
        seed: args.seed,
        command: words::typed(),
    };

    let bar = console.steps(STEPS);
    let bundle = report::make(&request, &|what| {
        bar.set_message(what);
        bar.inc(1);
    });
    bar.finish_and_clear();
    let bundle = bundle?;
    bundle.write(&args.output)?;

    if console.json {
        let scores = bundle
            .sections
            .iter()
            .map(|s| (s.head, s.scores.iter().map(|score| (score.name.clone(), score.value)).collect()));
        console.print_json(&Summary {
            folder: args.output.clone(),
            files: bundle.files.iter().map(|(name, _)| args.output.join(name)).collect(),
            scores: scores.collect(),
        })?;
        return Ok(Code::Done);
    }
    let mut text = String::new();
    for section in bundle.sections.iter().filter(|s| s.large > 0) {
        text += &format!("{}\n", section.head);
        for score in section.scores.iter().take(section.large) {
            let unit = if score.unit.is_empty() { String::new() } else { format!(" {}", score.unit) };
            let value = match score.value.map(number) {
                Some((value, Some(error))) => format!("{value}{unit} ± {error}"),
                Some((value, None)) => format!("{value}{unit}"),
                None => "does not apply: the material has no dispersion".into(),
            };
            text += &format!("  {:<16} {value}\n", score.name);
        }
    }
    let names: Vec<&str> = bundle.files.iter().rev().map(|(name, _)| *name).collect();
    text += &format!("{}: {}", args.output.display(), names.join(", "));
    console.print(&text)?;
    Ok(Code::Done)
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Failure {
        match error {
            ReportError::Format(error) => error.into(),
            _ => Failure::input(error.to_string()),
        }
    }
}
