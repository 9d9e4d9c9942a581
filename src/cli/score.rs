//! `cutlab score`: a table of scores, one row a stone, or one a stone and tilt.

use super::console::Console;
use super::folders;
use super::outcome::{Code, Failure};
use super::scoring::{self, Inputs, Scoring};
use super::stones::DEFAULT_STONE;
use super::tables::{self, Study, Table};
use super::values;
use super::words::quoted;
use crate::math::typed::Unit;
use crate::study::batch::Line;
use crate::study::score::Tilt;
use crate::study::sweep::Steps;
use crate::study::table::{self, Cell};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab score                                       the reference brilliant, CSV to standard output
  cutlab score designs/ '*.gem' -o scores.csv        every design of a folder, and what matches
  cutlab score tolkowsky --metrics wlr,fire_streak --error 0.001
  cutlab score tolkowsky --tilt -20:20:5 --tilt-axis 90 -o tilts.jsonl
  cutlab score designs/ --shard 2/8 -o part2.csv     the second of eight machines; cutlab merge")]
pub struct Args {
    /// Stones: names from `cutlab list cuts`, with parameters or not, files, folders of files,
    /// patterns as 'designs/*.asc'
    #[arg(default_value = DEFAULT_STONE, value_name = "STONE")]
    stones: Vec<String>,
    #[command(flatten)]
    table: Table,
    #[command(flatten)]
    scoring: Scoring,
    /// Turn the stone before viewer and light, one row a tilt, in degrees
    #[arg(long, value_name = "FROM:TO:STEP", value_parser = tilt, allow_hyphen_values = true)]
    tilt: Option<Steps>,
    /// Azimuth of the horizontal axis to tilt about, in degrees from +x
    #[arg(
        long,
        value_name = "AZIMUTH",
        default_value_t = 0.0,
        allow_hyphen_values = true,
        value_parser = values::number(Unit::Degrees),
        requires = "tilt"
    )]
    tilt_axis: f64,
}

/// Scores every stone and writes the table.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let plan = args.scoring.plan();
    let specs = folders::expanded(&args.stones)?;
    scoring::check_output(&args.table.output, specs.iter().map(String::as_str))?;
    args.scoring.notes(console);
    let mut command = "cutlab score".to_string();
    args.stones.iter().for_each(|stone| command += &format!(" {}", quoted(stone)));
    command += &args.scoring.words();
    let mut leading = table::STONE_COLUMNS.to_vec();
    if let Some(tilt) = &args.tilt {
        command += &format!(" --tilt {tilt} --tilt-axis {}", args.tilt_axis);
        leading.push("tilt_deg");
    }
    let columns = table::columns(&leading, &plan.metrics);
    let tilts = args.tilt.map_or(1, |t| t.count);
    let inputs = Inputs::of(&command, specs.iter().map(String::as_str));
    let study = Study {
        identity: inputs.identity.clone(),
        command,
        plan: &plan,
        total: specs.len() as u64 * tilts,
        what: "scoring",
        line: &|i, form| {
            let spec = &specs[(i / tilts) as usize];
            let tilt = args.tilt.map(|t| Tilt { degrees: t.value(i % tilts), azimuth: args.tilt_axis });
            let (row, outcome) = inputs.checked(spec, args.scoring.score(spec, tilt, &plan));
            let mut leading = table::stone_cells(&row);
            leading.extend(tilt.map(|t| Cell::number(t.degrees)));
            Ok(Line {
                outcome,
                samples: row.samples.iter().map(|(of, n)| (of.to_string(), *n)).collect(),
                text: form.row(&columns, &table::cells(leading, &row))?,
                complaint: tables::complaint(spec, &row),
            })
        },
        columns: columns.clone(),
    };
    study.run(&args.table, console, None)
}

/// Value parser of `--tilt`.
fn tilt(text: &str) -> Result<Steps, String> {
    let steps = Steps::read(text, Unit::Degrees)?;
    match steps.from.abs().max(steps.to.abs()) < 90.0 {
        true => Ok(steps),
        false => Err("a stone can be tilted by less than 90°".into()),
    }
}
