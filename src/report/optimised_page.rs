//! Page of an optimisation: what was found, the front, stones before and after, what was paid for what, tilt curves,
//! diagrams and tiers.

mod headline;
mod kept;
mod pictures;
mod price;
mod search_plots;
mod tiers;
mod tilts;

use super::html::HtmlPage;
use super::page::tilt_section;
use super::stone_report::ReportError;
use crate::design::edit::Editor;
use crate::optimise::{OptimiseRequest, Optimised};
use crate::progress::Progress;
use crate::scoring::score::ScoreRequest;
use crate::stone::Stone;
use kept::KeptDesign;
use maud::html;
use price::OtherScores;

const OWN_STYLE: &str =
    concat!(include_str!("comparison_page.css"), include_str!("optimised_page/optimised_page.css"));

/// Pixels across each picture unless asked otherwise.
pub const USUAL_SIDE: u32 = 320;

/// Points of the hemisphere and of the view for each stone in the table of what was paid: ±.0004 of `wlr`.
const SAMPLES: u64 = 1 << 17;

/// What a page shows.
///
/// ```
/// use cutlab::advanced::report::optimised_page::OptimisedPage;
/// use cutlab::advanced::scoring::Objective;
/// use cutlab::{OptimiseRequest, Stone};
///
/// let stone = Stone::parse("classic:ri=1.54")?;
/// let request = OptimiseRequest::new([Objective::maximise("iso".parse()?)]).evaluations(8);
/// let optimisation = request.prepared(&stone)?;
/// let found = optimisation.run(Vec::new(), &|_| (), &())?;
/// let mut page = OptimisedPage::new(&stone, &request, &optimisation.editor, &found);
/// (page.side, page.samples) = (32, 1 << 12);
/// assert!(page.html(&())?.contains("better than the start"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
pub struct OptimisedPage<'a> {
    /// The stone as it was.
    pub stone: &'a Stone,
    /// What was asked for.
    pub request: &'a OptimiseRequest,
    /// The design as it was.
    pub editor: &'a Editor,
    /// What was found.
    pub found: &'a Optimised,
    /// Files of the designs beside the page, in their order; none of those that were not written.
    pub files: Vec<String>,
    /// The command, for the foot of the page.
    pub command: String,
    /// Pixels across each picture.
    pub side: u32,
    /// Points of the hemisphere and of the view for each score that was no objective, fewer of dearer estimators.
    pub samples: u64,
}

impl<'a> OptimisedPage<'a> {
    /// Of what was found, without files or a command, with pictures of the usual size.
    ///
    /// - `editor`: of the stone's design ([`crate::optimise::Optimisation::editor`])
    pub fn new(
        stone: &'a Stone,
        request: &'a OptimiseRequest,
        editor: &'a Editor,
        found: &'a Optimised,
    ) -> OptimisedPage<'a> {
        let (files, command) = (Vec::new(), String::new());
        OptimisedPage { stone, request, editor, found, files, command, side: USUAL_SIDE, samples: SAMPLES }
    }

    /// The page, which needs nothing beside it but the files that it links to.
    ///
    /// Objectives are as [`Optimised`] has them. Other scores, pictures and tilt curves are made here, with random
    /// numbers that the search had not seen. The same page comes of any number of threads. Errors: a stone that
    /// cannot be seen through, or work that was ended by [`Progress::is_cancelled`]. Checked in
    /// `tests/library/optimised_page.rs`.
    pub fn html(&self, progress: &dyn Progress) -> Result<String, ReportError> {
        let (request, found) = (self.request, self.found);
        let effort = request.effort;
        let start = self.stone.clone().with_width(effort.size_mm)?;
        let kept = kept::kept(self.stone, self.editor, found, &self.files, effort.size_mm)?;
        let plan = ScoreRequest { observer: headline::observer(request), ..ScoreRequest::default() }
            .seed(!effort.seed)
            .polarised(effort.polarised);
        let stones: Vec<&Stone> = std::iter::once(&start).chain(kept.iter().map(|k| &k.stone)).collect();

        let before = (self.stone.material(), &self.editor.solid);

        progress.begin("page", stones.len() as u64 + 2);
        let others = OtherScores::of(request, &kept, before, self.samples);
        step_done(progress)?;
        let mut seen = Vec::new();
        for stone in &stones {
            seen.push(pictures::of_stone(stone, &plan, self.side)?);
            step_done(progress)?;
        }
        let curves = tilts::plots(request, before, &tilts::drawn(&kept));
        step_done(progress)?;
        progress.end();

        let content = html! {
            (headline::verdicts(request, &kept))
            (headline::request(request, found))
            (search_plots::section(request, found, &kept))
            (headline::variables(found, &kept))
            (pictures::section(&seen, &kept))
            (price::section(request, &kept, &others))
            (tilt_section(&curves))
            (tiers::section(&kept, self.stone.material().index_d())?)
        };
        let page = HtmlPage {
            title: &format!("{}, optimised", self.stone.name()),
            subtitle: &self.subtitle(&kept),
            style: OWN_STYLE,
            content,
            footer: html! {},
            command: &self.command,
        };
        Ok(page.html())
    }

    /// Objectives, material, and how many designs are kept.
    fn subtitle(&self, kept: &[KeptDesign]) -> String {
        let material = self.stone.material();
        let designs = match (kept.len(), self.found.finalists.len()) {
            (1, 1) => "1 design kept".to_owned(),
            (shown, all) if shown < all => format!("{all} designs kept, the first {shown} shown"),
            (_, all) => format!("{all} designs kept"),
        };
        format!(
            "for {} · {}, n {:.4} (D line) · {} candidates · {designs}",
            headline::objectives(self.request),
            material.name,
            material.index_d(),
            self.found.candidates.len()
        )
    }
}

/// A step of the work is done; whether there is to be another.
fn step_done(progress: &dyn Progress) -> Result<(), ReportError> {
    progress.advance(1);
    if progress.is_cancelled() { Err(ReportError::Cancelled) } else { Ok(()) }
}
