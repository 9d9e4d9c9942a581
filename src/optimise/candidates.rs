//! Candidates: designs with some values of the variables, and what they are worth.

use super::guards::GuardedStone;
use super::variable::Degree;
use crate::design::cutting_error;
use crate::design::edit::{EditError, Edited, Editor, Keep, Setting};
use crate::geometry::{Polyhedron, SolidError};
use crate::parallel;
use crate::progress::Progress;
use crate::sampling::stats::Estimate;
use crate::scoring::evaluator::Evaluator;
use crate::scoring::objective::Objective;
use crate::search::{Evaluate, Outcome};

/// The candidates of a design.
pub struct Candidates<'a> {
    /// The design as it is.
    pub editor: &'a Editor,
    /// What varies.
    pub degrees: &'a [Degree],
    /// What a change leaves as it is.
    pub keep: Keep,
    /// Bounds that are always on.
    pub guards: &'a GuardedStone,
    /// What a stone is worth.
    pub evaluator: &'a Evaluator,
    /// By how many degrees the angle of a tier may be off when the stone is cut; 0 for stones cut as they are drawn.
    pub tolerance_deg: f64,
    /// Whether to go on.
    pub progress: &'a dyn Progress,
}

impl Candidates<'_> {
    /// The settings of a candidate.
    ///
    /// - `values`: one a variable, in its unit
    pub fn settings(&self, values: &[f64]) -> Vec<Setting> {
        self.degrees.iter().zip(values).map(|(degree, value)| degree.setting(*value)).collect()
    }

    /// The design of a candidate. The error says what cannot be.
    pub fn edited(&self, values: &[f64]) -> Result<Edited, EditError> {
        let is_start = self.degrees.iter().zip(values).all(|(degree, value)| degree.start == *value);
        if is_start {
            self.editor.edit(&[], self.keep)
        } else {
            self.editor.edit(&self.settings(values), self.keep)
        }
    }

    /// The stones that may come of a design within the tolerance ([`cutting_error::stones`]); none without one.
    pub fn stones(&self, edited: &Edited) -> Result<Option<Vec<Polyhedron>>, SolidError> {
        let stones = || cutting_error::stones(&edited.design, &edited.solid, self.tolerance_deg);
        (self.tolerance_deg > 0.0).then(stones).transpose()
    }

    fn outcome(&self, values: &[f64]) -> Outcome {
        let Ok(edited) = self.edited(values) else { return Outcome::nothing() };
        let values = match self.stones(&edited) {
            Ok(None) => self.evaluator.values(&edited.solid),
            Ok(Some(stones)) => self.evaluator.values_over(&edited.solid, &stones),
            Err(_) => return Outcome::nothing(),
        };
        let Ok(values) = values else { return Outcome::nothing() };
        let signed = |(of, value): (&Objective, &Estimate)| of.aim.sign() * value.value;
        Outcome {
            objectives: self.evaluator.objectives.iter().zip(&values.objectives).map(signed).collect(),
            violation: values.violation + self.guards.violation(&edited.solid),
        }
    }
}

impl Evaluate for Candidates<'_> {
    /// On all threads, candidate by candidate; none of a batch once the work is to end.
    fn evaluate(&self, batch: &[Vec<f64>]) -> Vec<Outcome> {
        let outcomes =
            parallel::map(batch.len(), |i| (!self.progress.is_cancelled()).then(|| self.outcome(&batch[i])));
        outcomes.into_iter().map_while(|outcome| outcome).collect()
    }
}
