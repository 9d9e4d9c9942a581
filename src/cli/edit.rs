//! `cutlab edit`: a design changed by settings, shown before and after, and written.

mod options;

use super::changed_stone::{ChangedFile, ChangedText};
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::progress::BarProgress;
use crate::design::edit::{DesignChanges, EditRequest, Editor};
use crate::scoring::edit_report::EditReport;
pub use options::{EditArgs, keep};

/// Changes the stone, prints what changed and writes the result.
pub fn run(args: &EditArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let mut file = ChangedFile::new(&args.stone, &args.change.written, console)?;
    let (how, metrics) = (&args.change.how, &args.change.score);
    let stone = how.stone_args.open(&args.stone)?;
    let design = stone.convex_design().map_err(|error| CliError::needs_convex("a change", error))?;
    let editor = Editor::new(design)?;
    let mut request = EditRequest::default().keep(args.keep);
    request.settings.clone_from(&args.set);
    let edited = editor.edit(&request.settings, request.keep)?;
    file.encode(&stone, &edited.design, stone.given_material())?;
    let mut report = EditReport::new(&stone, &edited.design, DesignChanges::new(&editor, &edited))?;
    stone.warnings().iter().for_each(|warning| console.note(&format!("note: {warning}")));
    if !metrics.is_empty() {
        how.notes(metrics, false).iter().for_each(|note| console.note(note));
        report.score(&how.plan(metrics), how.size, &BarProgress::new(console))?;
    }
    file.finish(&report, &ChangedText::new(&report), console)
}
