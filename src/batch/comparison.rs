//! Comparisons of stones from the names of the stones on: opened, and scored with the same random numbers.

use super::input_files::InputFiles;
use super::request::{ComparisonTable, TableRequest};
use super::stone_files::expand_stones;
use crate::progress::{Progress, SaidOnce};
use crate::sampling::stats::Estimate;
use crate::scoring::comparison::{self, Comparison};
use crate::scoring::score::{ScoreInput, ScoreRequest};
use crate::scoring::scores::ScoreError;
use crate::stone::{Stone, StoneError};
use crate::storage::text::display_name;
use std::ffi::OsString;

/// Stones that could not be compared.
///
/// ```
/// use cutlab::advanced::batch::comparison::ComparisonError;
/// use cutlab::{ComparisonTable, ScoreRequest};
///
/// let alone = ComparisonTable::new(["cube"], ScoreRequest::new(["wlr"]));
/// assert!(matches!(alone.run(&()), Err(ComparisonError::TooFew)));
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ComparisonError {
    /// One stone, or none.
    #[error("a comparison needs two stones or more")]
    TooFew,
    /// A stone that could not be opened, or is not convex.
    #[error(transparent)]
    Stone(#[from] StoneError),
    /// A name that no metric has.
    #[error(transparent)]
    Score(#[from] ScoreError),
    /// A file that another program wrote to while it was read.
    #[error("{stone}: the file was replaced since the comparison was begun: start again")]
    Replaced {
        /// The stone.
        stone: String,
    },
    /// The work was ended early by [`Progress::is_cancelled`].
    #[error("cancelled")]
    Cancelled,
}

/// The stones of a comparison, opened.
pub struct ComparedStones {
    table: ComparisonTable,
    stones: Vec<Stone>,
    identity: String,
}

/// The scores of stones beside each other, with the stones.
///
/// ```
/// use cutlab::{ComparisonTable, ScoreRequest};
///
/// let compared = ComparisonTable::new(["tolkowsky", "octahedron"], ScoreRequest::new(["spread"])).run(&())?;
/// assert_eq!(compared.stones[1].name(), "octahedron");
/// assert!(compared.difference(1, 0).is_some() && compared.is_significant(1, 0));
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct StoneComparison {
    /// What was asked for.
    pub request: TableRequest,
    /// The stones, in millimetres; differences are from the first.
    pub stones: Vec<Stone>,
    /// Their scores and differences.
    pub comparison: Comparison,
    /// Fingerprint of the request and of what the files held that it names, materials included.
    pub identity: String,
}

impl ComparisonTable {
    /// Opens the stones and compares them, as `cutlab compare` does. A stone whose size nobody says is taken as wide
    /// as stones usually are.
    ///
    /// ```
    /// use cutlab::{ComparisonTable, ScoreRequest};
    ///
    /// let compared = ComparisonTable::new(["tolkowsky", "octahedron"], ScoreRequest::new(["spread"])).run(&())?;
    /// assert_eq!(compared.comparison.is_significant(0, 0), Some(true));
    /// let octahedron_less_tolkowsky = compared.difference(1, 0).expect("both have a score");
    /// assert!(octahedron_less_tolkowsky.value.abs() > 0.1);
    /// # Ok::<(), cutlab::Error>(())
    /// ```
    pub fn run(&self, progress: &dyn Progress) -> Result<StoneComparison, ComparisonError> {
        let stones = expand_stones(&self.stones, self.options.limits)?;
        self.open(&stones, progress)?.run(progress)
    }

    /// Opens its stones.
    ///
    /// - `stones`: those of the request one by one, whose names need not be UTF-8 ([`expand_stones`])
    /// - `progress`: hears of stones that do not stand table up
    pub fn open(
        &self,
        stones: &[OsString],
        progress: &dyn Progress,
    ) -> Result<ComparedStones, ComparisonError> {
        if stones.len() < 2 {
            return Err(ComparisonError::TooFew);
        }
        self.scores.check()?;
        let request = TableRequest::Compare(self.clone());
        let files = InputFiles::new(&request, &self.options, stones.iter().map(OsString::as_os_str));
        let (said, mut opened) = (SaidOnce::default(), Vec::new());
        for spec in stones {
            let stone = Stone::open(spec, &self.options)?;
            if files.change_of(spec).is_some() {
                return Err(ComparisonError::Replaced { stone: display_name(spec) });
            }
            if let Some(doubt) = stone.orientation_doubt() {
                said.note(progress, &format!("note: {}: {doubt}", stone.name()), stone.name());
            }
            opened.push(stone.convex_in_mm()?);
        }
        Ok(ComparedStones { table: self.clone(), stones: opened, identity: files.identity })
    }
}

impl ComparedStones {
    /// Compares the stones.
    ///
    /// - `progress`: hears of each run
    pub fn run(self, progress: &dyn Progress) -> Result<StoneComparison, ComparisonError> {
        let ComparedStones { table, stones, identity } = self;
        let inputs: Vec<ScoreInput> =
            stones.iter().map(|stone| ScoreInput::from_stone(stone, None)).collect();
        progress.begin("comparing", comparison::runs(&table.scores));
        let comparison = comparison::compare_while(&inputs, &table.scores, &|| {
            progress.advance(1);
            !progress.is_cancelled()
        });
        progress.end();
        let comparison = comparison.ok_or(ComparisonError::Cancelled)?;
        Ok(StoneComparison { request: TableRequest::Compare(table), stones, comparison, identity })
    }
}

impl StoneComparison {
    /// What was scored, and how.
    pub fn scores(&self) -> &ScoreRequest {
        self.request.scores()
    }

    /// The score of a stone in a metric less that of the first stone, both by number from 0; none of the first, and
    /// where one of them has no score.
    pub fn difference(&self, stone: usize, metric: usize) -> Option<Estimate> {
        stone.checked_sub(1).and_then(|other| self.comparison.differences[other][metric])
    }

    /// Whether there is such a difference, and it is beyond chance and not negligible.
    pub fn is_significant(&self, stone: usize, metric: usize) -> bool {
        let other = stone.checked_sub(1);
        other.and_then(|other| self.comparison.is_significant(other, metric)) == Some(true)
    }
}
