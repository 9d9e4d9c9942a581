//! `cutlab show`: what a cutter or a grader reads off a stone.

mod drawings;
mod measured;
mod meets;
mod mesh;
mod options;
mod sheet;
mod shown;
mod stone_sheet;
mod stone_text;
mod tiers;

use super::args::stone;
use super::console::Console;
use super::each_stone;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use crate::batch::stone_files::expand_stones;
use crate::cli::limits::limits;
use crate::storage::atomic_write;
use drawings::Drawings;
pub use options::ShowArgs;
use shown::{Shown, ShownEntry};

/// Shows every stone.
pub fn run(args: &ShowArgs, console: &Console) -> Result<ExitStatus, CliError> {
    if [&args.beams, &args.diagram].into_iter().flatten().filter(|p| atomic_write::is_stdout(p)).count() > 1 {
        return Err(CliError::input(
            "one drawing at a time goes to standard output: name a file for the other",
        ));
    }
    let stones = expand_stones(&args.stones, limits())?;
    let mut outputs = Outputs::reading_stones(&stones, console);
    let drawings = Drawings::make(args)?;
    drawings.write(&mut outputs, console)?;
    if drawings.take_stdout() {
        return Ok(ExitStatus::Done); // standard output is the drawing
    }
    let results = each_stone::open_each(&stones, console, "reading", |spec| Shown::new(spec, args));
    if console.json {
        let names = stones.iter().map(stone::display_name);
        let entries: Vec<ShownEntry> =
            names.zip(&results).map(|(file, result)| ShownEntry::new(&file, result)).collect();
        console.print_json(&entries)?;
    } else {
        let texts: Vec<String> = results.iter().flatten().map(Shown::text).collect();
        if !texts.is_empty() {
            console.print(&texts.join("\n"))?;
        }
        results.iter().filter_map(|r| r.as_ref().err()).for_each(|f| console.complain(&f.message()));
    }
    Ok(each_stone::code(&results))
}
