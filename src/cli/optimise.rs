//! `cutlab optimise`: the best designs for one objective, or the front of several.

mod files;
mod options;
mod page_file;
mod text;

use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::interrupt;
use super::progress::BarProgress;
use files::OptimisedFiles;
pub use options::OptimiseArgs;
use text::OptimisedText;

/// Optimises the stone, prints what was found and writes it.
pub fn run(args: &OptimiseArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let stone = args.how.stone_args.open_convex(&args.stone)?;
    let request = args.request(&stone);
    let optimisation = request.prepared(&stone)?;
    let files = OptimisedFiles::new(args, &request, &stone, console)?;
    stone.warnings().iter().for_each(|warning| console.note(&format!("note: {warning}")));
    if args.output.is_some() {
        interrupt::mark_resumable();
    }
    let (known, kept) = files.begin(console)?;
    let progress = BarProgress::new(console);
    let found = optimisation.run(known, &|new| kept.keep(new, &optimisation), &progress)?;
    kept.ended()?;
    let text =
        OptimisedText { stone: &stone, request: &request, editor: &optimisation.editor, found: &found };
    let written = files.write(&found, (&request, &optimisation.editor), kept, &progress)?;
    if console.json {
        console.print_json(&text.entries(&written))?;
    } else {
        console.print(&text.text()?)?;
    }
    match written.is_empty() {
        true => console.note("nothing is written: -o FILE or -o FOLDER writes the designs"),
        false => written.iter().for_each(|file| console.note(&format!("wrote {file}"))),
    }
    Ok(if found.finalists.is_empty() { ExitStatus::SomeFailed } else { ExitStatus::Done })
}
