//! `cutlab attribute`: what each tier's angle does to scores, and what to change first.

mod options;
mod table;
mod text;

use super::args::stone::display_name;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::{self, Outputs};
use super::progress::BarProgress;
use crate::batch::table::TableFormat;
use crate::cli::args::tables;
use crate::scoring::Attribution;
use crate::storage::{atomic_write, output_path};
pub use options::AttributeArgs;
use serde::Serialize;
use std::path::Path;

/// An attribution with the file that it was written to, as JSON.
#[derive(Serialize)]
struct WithFile<'a> {
    #[serde(flatten)]
    attribution: &'a Attribution,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
}

/// Turns the tiers of the stone, prints what that does and writes the table.
pub fn run(args: &AttributeArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let mut outputs = Outputs::reading_stones([&args.stone], console);
    let format = args.output.as_deref().map(|path| place(path, &outputs, console)).transpose()?;
    let stone = args.how.stone_args.open(&args.stone)?;
    stone.convex_design().map_err(|error| CliError::needs_convex("an attribution", error))?;
    let request = args.request(&stone);
    args.notes(&stone).iter().for_each(|note| console.note(note));
    let found = request.run(&stone, &BarProgress::new(console))?;
    found.warnings.iter().for_each(|warning| console.note(&format!("note: {warning}")));
    let mut file = None;
    if let (Some(path), Some(format)) = (&args.output, format) {
        let bytes = match format {
            TableFormat::Csv => table::csv(&found)?,
            _ => table::json(&found)?,
        };
        outputs.claim(path, |there| outputs::has_bytes(there, &bytes))?;
        atomic_write::write(path, &bytes)?;
        if atomic_write::is_stdout(path) {
            return Ok(ExitStatus::Done);
        }
        file = Some(display_name(path));
    }
    match console.json {
        true => console.print_json(&WithFile { attribution: &found, file: file.clone() })?,
        false => console.print(&text::text(&found))?,
    }
    file.iter().for_each(|file| console.note(&format!("wrote {file}")));
    Ok(ExitStatus::Done)
}

/// Tries the place and the form of the table before the work.
fn place(path: &Path, outputs: &Outputs, console: &Console) -> Result<TableFormat, CliError> {
    let format = tables::format_of(path, console)?;
    if format == TableFormat::JsonLines {
        let path = display_name(path);
        return Err(CliError::input(format!("{path}: the table of an attribution is .csv or .json")));
    }
    if !atomic_write::is_stream(path) {
        output_path::check_writable(path)?;
        outputs.check_inputs(path)?;
    }
    Ok(format)
}
