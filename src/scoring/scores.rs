//! The scores of one stone, by name.

use super::score::score;
use super::settings::{ScoreInput, ScoreRequest, ScoreRow, Target, Tilt};
use crate::metrics::{Metric, NoSuchMetric};
use crate::parse;
use crate::sampling::stats::Estimate;
use crate::stone::Stone;
use std::ops::Index;

/// A stone that could not be scored.
///
/// ```
/// use cutlab::{ScoreError, ScoreRequest, Stone};
///
/// let error = ScoreRequest::new(["brilliance"]).run(&Stone::parse("octahedron")?).unwrap_err();
/// assert!(matches!(error, ScoreError::NoSuchMetric { .. }));
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScoreError {
    /// A name that no metric has.
    #[error(transparent)]
    NoSuchMetric(#[from] NoSuchMetric),
    /// A stone that has none of the scores asked for, or in which nothing can be traced.
    #[error("{stone}: {why}")]
    NotScored {
        /// The stone.
        stone: String,
        /// Why.
        why: String,
    },
}

/// The scores of one stone, with their errors.
///
/// ```
/// use cutlab::advanced::scoring::{ScoreRequest, Scores};
/// use cutlab::advanced::stone::Stone;
///
/// let scores: Scores = ScoreRequest::new(["wlr", "iso"]).samples(1 << 12).run(&Stone::parse("tolkowsky")?)?;
/// assert!((scores["wlr"].value - 0.28).abs() < 0.02);
/// println!("{}", scores["wlr"]); // 0.2838 ± 0.0010
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scores {
    row: ScoreRow,
    names: Vec<&'static str>,
}

/// What is read of a score that is not there: not a number.
static NONE: Estimate = Estimate { value: f64::NAN, error: f64::NAN };

impl Scores {
    /// The score called `name`; none if it was not asked for or does not apply to the stone
    /// ([`Scores::why_left_out`]).
    pub fn get(&self, name: &str) -> Option<Estimate> {
        let place = self.names.iter().position(|n| parse::is_name(n, name))?;
        self.row.scores[place]
    }

    /// Name and score of each metric that was asked for, in that order.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, Option<Estimate>)> + '_ {
        self.names.iter().copied().zip(self.row.scores.iter().copied())
    }

    /// Why the score called `name` does not apply to the stone; none if it does.
    pub fn why_left_out(&self, name: &str) -> Option<&str> {
        let found = self.row.left_out.iter().find(|(n, _)| parse::is_name(n, name));
        found.map(|(_, why)| why.as_ref())
    }

    /// What is to be said of scores that are good all the same: an error that was not reached, photons in place of
    /// beams.
    pub fn warnings(&self) -> impl Iterator<Item = &str> {
        self.row.error.as_deref().into_iter().chain(self.row.note)
    }

    /// The row of a table that they make.
    pub fn row(&self) -> &ScoreRow {
        &self.row
    }
}

/// A score that is not there is not a number; [`Scores::get`] tells.
impl Index<&str> for Scores {
    type Output = Estimate;

    fn index(&self, name: &str) -> &Estimate {
        let place = self.names.iter().position(|n| parse::is_name(n, name));
        place.and_then(|place| self.row.scores[place].as_ref()).unwrap_or(&NONE)
    }
}

impl ScoreRequest {
    /// A request for metrics by name. A name that no metric has is an error of [`ScoreRequest::run`].
    pub fn new<S: AsRef<str>>(metrics: impl IntoIterator<Item = S>) -> ScoreRequest {
        let mut request = ScoreRequest { metrics: Vec::new(), ..ScoreRequest::default() };
        for name in metrics {
            let name = name.as_ref();
            match Metric::by_name(name) {
                Some(metric) => request.metrics.push(metric),
                None => request.unknown.push(name.into()),
            }
        }
        request
    }

    /// With one more metric: one of the catalogue, or one of your own.
    pub fn metric(mut self, metric: &'static Metric) -> ScoreRequest {
        self.metrics.push(metric);
        self
    }

    /// With these metrics in place of its own.
    pub fn metrics(mut self, metrics: impl IntoIterator<Item = &'static Metric>) -> ScoreRequest {
        self.metrics = metrics.into_iter().collect();
        self
    }

    /// Traced as far as `target` says.
    pub fn target(mut self, target: Target) -> ScoreRequest {
        self.target = target;
        self
    }

    /// Traced until every standard error is below `error` times the metric's scale: 1 for fractions and degrees, 100
    /// for percentages.
    pub fn error(mut self, error: f64) -> ScoreRequest {
        self.target = Target::Error(error);
        self
    }

    /// With no estimator traced further than so many samples in pursuit of an error, dearer ones less far.
    pub fn cap(mut self, samples: u64) -> ScoreRequest {
        self.cap = samples;
        self
    }

    /// Traced for so many points of the hemisphere and the view, fewer of dearer estimators.
    pub fn samples(mut self, samples: u64) -> ScoreRequest {
        self.target = Target::Samples(samples);
        self
    }

    /// With a seed of its random streams.
    pub fn seed(mut self, seed: u64) -> ScoreRequest {
        self.seed = seed;
        self
    }

    /// Whether what exact beams can give is taken from them.
    pub fn exact(mut self, exact: bool) -> ScoreRequest {
        self.exact = exact;
        self
    }

    /// With a half-angle in degrees of the observer's dark cone.
    pub fn observer(mut self, half_angle_deg: f64) -> ScoreRequest {
        self.observer = Some(half_angle_deg);
        self
    }

    /// Whether light keeps its polarisation from facet to facet.
    pub fn polarised(mut self, polarised: bool) -> ScoreRequest {
        self.polarised = polarised;
        self
    }

    /// Whether every metric that was asked for by name exists.
    pub fn check(&self) -> Result<(), ScoreError> {
        if let Some(name) = self.unknown.first() {
            Metric::named(name)?;
        }
        Ok(())
    }

    /// Scores a stone face-up. One whose colour depends on a size that nobody says is taken as wide as stones usually
    /// are.
    pub fn run(&self, stone: &Stone) -> Result<Scores, ScoreError> {
        self.run_tilted(stone, None)
    }

    /// As [`ScoreRequest::run`], of a stone that is tilted.
    pub fn run_tilted(&self, stone: &Stone, tilt: Option<Tilt>) -> Result<Scores, ScoreError> {
        self.check()?;
        let failed = |why: String| ScoreError::NotScored { stone: stone.name().into(), why };
        let sized = stone.clone().with_width_for_colour().map_err(|e| failed(e.to_string()))?;
        let row = score(&ScoreInput::from_stone(&sized, tilt), self);
        match &row.error {
            Some(why) if row.scores.iter().all(Option::is_none) => Err(failed(why.clone())),
            _ => Ok(Scores { row, names: self.metrics.iter().map(|m| m.name).collect() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_no_metric_has_is_an_error_when_it_is_scored() {
        let stone = Stone::parse("octahedron").expect("a cut");
        let error = ScoreRequest::new(["wrl"]).run(&stone).expect_err("no metric");
        assert_eq!(
            error.to_string(),
            "no metric is called 'wrl'; did you mean 'wlr'? (all: cutlab list metrics)"
        );
        let scores = ScoreRequest::new(["WLR"]).samples(64).run(&stone).expect("a stone");
        assert!(scores["wlr"].value > 0.0 && scores["iso"].value.is_nan() && scores.get("iso").is_none());
    }
}
