//! What cannot be swept or drawn is refused before anything is scored.

use super::options::SweepArgs;
use crate::batch::sweep::{INDEX, MOST_SCATTERED, SIZE, SweptParameter};
use crate::cli::args::stone;
use crate::cli::error::CliError;
use crate::stone::grammar;
use crate::storage::atomic_write;
use std::ffi::OsStr;

/// Refuses what cannot be swept or drawn, before anything is scored.
pub fn check(args: &SweepArgs) -> Result<(), CliError> {
    args.scoring.how.stone_args.open(&args.stone)?;
    for (i, varied) in args.vary.iter().enumerate() {
        if args.vary[..i].iter().any(|v| v.key == varied.key) {
            return Err(CliError::input(format!("--vary {} is given twice", varied.key)));
        }
        check_parameter(args, varied)?;
    }
    if args.scatter.is_some() && args.vary.len() > MOST_SCATTERED {
        return Err(CliError::input(format!("--scatter takes up to {MOST_SCATTERED} varied parameters")));
    }
    check_plots(args)
}

/// Refuses a parameter that the stone does not have, and ends of its range that it cannot take.
fn check_parameter(args: &SweepArgs, varied: &SweptParameter) -> Result<(), CliError> {
    let key = varied.key.as_str();
    if ![SIZE, INDEX].contains(&key) && !has(&args.stone, key) {
        let own = args.stone.to_str().and_then(grammar::family).map_or(&[][..], |f| f.parameters);
        let mut known: Vec<&str> = own.iter().map(|p| p.key).filter(|k| *k != SIZE).collect();
        known.extend([SIZE, INDEX]);
        return Err(CliError::input(format!(
            "{} has no parameter '{key}': --vary takes {}",
            stone::display_name(&args.stone),
            known.join(", ")
        )));
    }
    let (from, to) = (varied.steps.from, varied.steps.to);
    if key == INDEX
        && (args.scoring.how.stone_args.material.is_some() || args.scoring.how.stone_args.ri.is_some())
    {
        return Err(CliError::input("--vary ri does not go with --material and --ri"));
    }
    let (low, high, what) = match key {
        INDEX => (1.0, 10.0, "a refractive index is a number from 1 to 10"),
        SIZE => (1e-3, 1e3, "a girdle width is a number of millimetres from 0.001 to 1000"),
        _ => return Ok(()),
    };
    if !(low..=high).contains(&from.min(to)) || from.max(to) > high {
        return Err(CliError::input(format!("--vary {key}={}: {what}", varied.steps)));
    }
    Ok(())
}

/// Whether the stone's family has the parameter `key`.
fn has(stone: &OsStr, key: &str) -> bool {
    stone.to_str().and_then(grammar::family).is_some_and(|f| f.keys().any(|p| p.key == key))
}

/// Refuses plots of what has no plot.
fn check_plots(args: &SweepArgs) -> Result<(), CliError> {
    let Some(first) = args.plot.first() else { return Ok(()) };
    if args.vary.len() > 2 {
        return Err(CliError::input(format!(
            "{}: a plot has one or two varied parameters; of more the table alone is written",
            stone::display_name(first)
        )));
    }
    if args.table.shard.of > 1 || atomic_write::is_stream(&args.table.output) {
        return Err(CliError::input("--plot needs the whole table in a file: give -o FILE, without --shard"));
    }
    Ok(())
}
