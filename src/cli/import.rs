//! `cutlab import`: any format in, any format out, whole folders at once.

mod one_file;
mod options;
mod rows;

use super::args::stone;
use super::console::Console;
use super::each_stone;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::interrupt;
use super::outputs::Outputs;
use crate::batch::output_places::{self, Job};
use crate::cli::limits::limits;
use crate::report::target_format::TargetFormat;
use crate::stone::StoneError;
use crate::storage::{atomic_write, output_path};
pub use options::{GenerateSettings, ImportArgs};
use rows::{ImportRow, PASSED_OVER, THERE, WRITTEN};
use std::ffi::OsString;
use std::path::Path;

/// Reads every file and writes it again.
pub fn run(args: &ImportArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let to_output = atomic_write::is_stdout(&args.output);
    let (jobs, form) = plan(args)?;
    let outputs = Outputs::reading_stones(jobs.iter().map(|job| &job.stone), console);
    if !to_output {
        if let Some(job) = jobs.first() {
            // nothing is read for a place where nothing can be written
            output_path::check_writable(&job.target.with_file_name(".cutlab-import"))?;
        }
        interrupt::mark_resumable();
    }
    let work = |job: &Job| one_file::import(job, args, form, &outputs, console);
    let mut results = each_stone::open_each(&jobs, console, "importing", work);
    let row = |(job, result): (&Job, &Result<ImportRow, CliError>)| match result {
        Ok(row) => row.clone(),
        Err(failure) => ImportRow::failed(&job.stone, failure),
    };
    let rows: Vec<ImportRow> = jobs.iter().zip(&results).map(row).collect();
    rows.iter().for_each(|r| r.warnings.iter().for_each(|w| console.note(&format!("{}: note: {w}", r.file))));
    results.retain(|r| r.as_ref().map_or(true, |row| row.outcome != PASSED_OVER));
    if console.json && !to_output {
        console.print_json(&rows)?;
    } else {
        rows.iter().filter_map(|r| r.error.as_ref()).for_each(|e| console.complain(e));
        if to_output {
            rows::table(&rows).lines().for_each(|line| console.note(line));
        } else if rows.iter().any(|r| [WRITTEN, THERE].contains(&r.outcome)) {
            console.tell(&rows::table(&rows))?;
        }
    }
    if results.is_empty() {
        let place = args.files.iter().map(stone::display_name).collect::<Vec<_>>().join(", ");
        return Err(StoneError::NoStones { place }.into());
    }
    Ok(each_stone::code(&results))
}

/// What is to be imported, and the format to write it in.
fn plan(args: &ImportArgs) -> Result<(Vec<Job>, TargetFormat), CliError> {
    let alone = args.files.len() == 1 && !Path::new(&args.files[0]).is_dir();
    let is_folder =
        args.output.is_dir() || (args.output.extension().is_none() && !atomic_write::is_stream(&args.output));
    let to_file = !is_folder;
    if to_file && !alone {
        return Err(CliError::input(format!(
            "several stones do not fit into the one file {}: give a folder and --to FORMAT",
            stone::display_name(&args.output)
        )));
    }
    let to = args.to.as_deref();
    let form = match to_file && !atomic_write::is_stream(&args.output) {
        true => TargetFormat::from_path(&args.output, to)?,
        false => TargetFormat::for_stream(&args.output, to, "toml")?,
    };
    if to_file {
        let job =
            |stone: &OsString| Job { stone: stone.clone(), target: args.output.clone(), by_chance: false };
        return Ok((args.files.iter().map(job).collect(), form));
    }
    Ok((output_places::into_folder(&args.files, &args.output, form.extension(), limits())?, form))
}
