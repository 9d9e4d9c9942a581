//! `cutlab retarget`: a design made for a stone of another refractive index.

mod options;
mod text;

use super::changed_stone::{ChangedFile, ChangedText};
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::progress::BarProgress;
use crate::design::edit::{DesignChanges, Editor};
use crate::design::retarget::{RetargetError, RetargetFigures, RetargetRequest, RuleTrial};
use crate::metrics::Metric;
use crate::scoring::edit_report::EditReport;
use crate::stone::{Stone, StoneOptions};
use options::Choice;
pub use options::RetargetArgs;
use serde::Serialize;

/// What is scored unless it is said: light that falls through, what a faceter sees, and what leaves where.
const USUAL_METRICS: [&str; 4] = ["windowing", "iso", "wlr", "leakage"];

/// A report with the figures by which the design was made.
#[derive(Serialize)]
struct RetargetReport<'a> {
    #[serde(flatten)]
    report: &'a EditReport,
    retarget: RetargetEntry<'a>,
}

/// How a design was made, with the rules that were tried.
#[derive(Serialize)]
struct RetargetEntry<'a> {
    #[serde(flatten)]
    figures: &'a RetargetFigures,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    trials: &'a [RuleTrial],
}

/// Makes the design for its new index, prints what changed and writes the result.
pub fn run(args: &RetargetArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let how = &args.change.how;
    let asked = how.stone_args.options(None);
    let material = asked.asked_material().map_err(CliError::input)?;
    let material = material
        .ok_or_else(|| CliError::input("a design is made for a new stone: say --material NAME or --ri N"))?;
    let mut file = ChangedFile::new(&args.stone, &args.change.written, console)?;
    // as the stone is before: of its own material
    let own = StoneOptions { material: None, ri: None, opened_material: None, ..asked };
    let stone = Stone::open(&args.stone, &own)?;
    let design = stone.convex_design().map_err(|error| CliError::needs_convex("a change", error))?;
    let editor = Editor::new(design)?;
    let from = args.from.unwrap_or_else(|| stone.material().index_d());
    let mut request = RetargetRequest::new(material.index_d()).from(from);
    request.pavilion = args.pavilion.and_then(Choice::rule);
    request.crown = args.crown.and_then(Choice::rule);
    let made = request.edit(&editor).map_err(|error| match error {
        RetargetError::NoRange(_) | RetargetError::Beyond { .. } => {
            CliError::input(format!("{error}: --pavilion range, keep or DEGREES, with --crown keep or RATIO"))
        }
        error => error.into(),
    })?;
    file.encode(&stone, &made.edited.design, Some(&material))?;
    stone.warnings().iter().for_each(|warning| console.note(&format!("note: {warning}")));
    if args.from.is_none() && design.refractive_index.is_none() {
        let name = &stone.material().name;
        console.note(&format!("note: the design says no index: it is taken as drawn for {name}; --from N"));
    }
    let changes = DesignChanges::new(&editor, &made.edited);
    let mut report = EditReport::new(&stone.clone().with_material(material), &made.edited.design, changes)?;
    let metrics = metrics(args);
    how.notes(&metrics, false).iter().for_each(|note| console.note(note));
    report.score(&how.plan(&metrics), how.size, &BarProgress::new(console))?;
    let mut shown = ChangedText::new(&report);
    shown.head = text::head(&made);
    let retarget = RetargetEntry { figures: &made.figures, trials: &made.trials };
    file.finish(&RetargetReport { report: &report, retarget }, &shown, console)
}

fn metrics(args: &RetargetArgs) -> Vec<&'static Metric> {
    match args.change.score.is_empty() {
        true => USUAL_METRICS.iter().filter_map(|name| Metric::by_name(name)).collect(),
        false => args.change.score.clone(),
    }
}
