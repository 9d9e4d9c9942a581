//! `cutlab retarget`: a design made for a stone of another refractive index.

mod options;

use super::changed_stone::{ChangedFile, ChangedText};
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::progress::BarProgress;
use crate::design::edit::{DesignChanges, Editor};
use crate::design::retarget::{RetargetError, RetargetFigures, RetargetRequest};
use crate::metrics::Metric;
use crate::scoring::edit_report::EditReport;
use crate::stone::{Stone, StoneOptions};
pub use options::RetargetArgs;
use serde::Serialize;

/// What is scored unless it is said: light that falls through, what a faceter sees, and what leaves where.
const USUAL_METRICS: [&str; 4] = ["windowing", "iso", "wlr", "leakage"];

/// A report with the figures by which the design was made.
#[derive(Serialize)]
struct RetargetReport<'a> {
    #[serde(flatten)]
    report: &'a EditReport,
    retarget: &'a RetargetFigures,
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
    let request =
        RetargetRequest::new(material.index_d()).from(from).pavilion(args.pavilion).crown(args.crown);
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
    let mut text = ChangedText::new(&report);
    text.head = head(&made.figures);
    file.finish(&RetargetReport { report: &report, retarget: &made.figures }, &text, console)
}

fn metrics(args: &RetargetArgs) -> Vec<&'static Metric> {
    match args.change.score.is_empty() {
        true => USUAL_METRICS.iter().filter_map(|name| Metric::by_name(name)).collect(),
        false => args.change.score.clone(),
    }
}

/// The figures, for people.
fn head(figures: &RetargetFigures) -> Vec<String> {
    let (n, c, p) = (figures.refractive_index, figures.critical_angle_deg, figures.pavilion_angle_deg);
    vec![
        format!("n {:.4} → {:.4}, critical angle {:.2}° → {:.2}°", n.before, n.after, c.before, c.after),
        format!(
            "pavilion by {} {:.2}° → {:.2}°: tangents × {:.4}; crown: tangents × {:.4}",
            figures.pavilion_tier, p.before, p.after, figures.pavilion_scale, figures.crown_scale
        ),
    ]
}
