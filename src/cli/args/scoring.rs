//! Arguments of every command that scores: metrics, accuracy, light, material.

use super::stone::{self, StoneArgs};
use super::values;
use crate::design::USUAL_WIDTH_MM;
use crate::metrics::Metric;
use crate::optics::dispersion::{VISIBLE_NM, lines};
use crate::parse;
use crate::parse::{NumberError, NumberUnit};
use crate::scoring::score::{ScoreRequest, Target};
use crate::stone::StoneOptions;

#[derive(Debug, Clone, clap::Args)]
pub struct ScoringArgs {
    /// Scores to compute, all if not given (see `cutlab list metrics`)
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = metric)]
    pub metrics: Vec<&'static Metric>,
    #[command(flatten)]
    pub how: ScoringHow,
}

/// How to score, whatever the metrics.
#[derive(Debug, Clone, clap::Args)]
pub struct ScoringHow {
    /// Trace until every standard error is below this times the metric's scale: 1 for fractions and
    /// degrees, 100 for percentages
    #[arg(long, value_name = "E", value_parser = error)]
    error: Option<f64>,
    /// Take what beams can give from beams instead of photons; no effect on stones that absorb or are
    /// not convex
    #[arg(long)]
    exact: bool,
    /// Half-angle in degrees of the observer's dark cone, for the metrics that have an observer [each
    /// its own]
    #[arg(long, value_name = "HALF-ANGLE", value_parser = values::half_angle)]
    observer: Option<f64>,
    /// Whether light keeps its polarisation from facet to facet; off takes it as unpolarised at each
    #[arg(long, value_name = "on|off", default_value = "on", value_parser = stone::on_off, action = clap::ArgAction::Set)]
    pub polarisation: bool,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    pub seed: u64,
    #[command(flatten)]
    pub stone_args: StoneArgs,
    /// Girdle width in millimetres; the scores depend on it if the material absorbs
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    pub size: Option<f64>,
}

impl ScoringArgs {
    /// What of the material asked for is a guess ([`ScoringHow::notes`]).
    pub fn notes(&self, sized: bool) -> Vec<String> {
        self.how.notes(&self.metrics, sized)
    }

    /// The plan that was asked for.
    pub fn plan(&self) -> ScoreRequest {
        self.how.plan(&self.metrics)
    }

    /// What is asked for of every stone.
    pub fn options(&self) -> StoneOptions {
        self.how.options()
    }
}

impl ScoringHow {
    /// What of the material asked for is a guess: its index, or the size of stones that have none.
    /// Commands say it once nothing is refused any more.
    ///
    /// - `metrics`: none for all
    /// - `sized`: whether all stones have a size
    pub fn notes(&self, metrics: &[&'static Metric], sized: bool) -> Vec<String> {
        let six = self.plan(metrics).metrics.iter().any(|m| m.needs_dispersion());
        let coloured = self.stone_args.material.as_ref().is_some_and(|m| !m.is_clear());
        let (from, to) = match (coloured, six) {
            (true, _) => VISIBLE_NM,
            (false, true) => (lines::G, lines::B),
            (false, false) => (lines::D, lines::D),
        };
        let range = self.stone_args.range_note(from, to);
        let high = self.stone_args.ri.filter(|n| *n > HIGH_INDEX).map(|n| {
            format!(
                "note: light stays in a stone of n = {n} for thousands of facets: its scores take long, a tenth as \
                 long with --error 0.01"
            )
        });
        let size = (!sized && self.size.is_none() && coloured).then(|| {
            format!("note: stones without a size are taken as {USUAL_WIDTH_MM} mm wide; --size MM sets it")
        });
        range.into_iter().chain(high).chain(size).collect()
    }

    /// The plan that was asked for.
    ///
    /// - `metrics`: none for all; one that is named again is meant once
    pub fn plan(&self, metrics: &[&'static Metric]) -> ScoreRequest {
        let default = ScoreRequest::default();
        ScoreRequest {
            metrics: if metrics.is_empty() { default.metrics.clone() } else { once(metrics) },
            target: self.error.map_or(default.target, Target::Error),
            polarised: self.polarisation,
            seed: self.seed,
            exact: self.exact,
            observer: self.observer,
            ..default
        }
    }

    /// What is asked for of every stone.
    pub fn options(&self) -> StoneOptions {
        self.stone_args.options(self.size)
    }
}

/// Every metric once.
pub fn once(asked: &[&'static Metric]) -> Vec<&'static Metric> {
    let mut metrics: Vec<&'static Metric> = Vec::new();
    for metric in asked {
        if !metrics.iter().any(|m| m.name == metric.name) {
            metrics.push(metric);
        }
    }
    metrics
}

/// No material has a higher index; beyond it a score takes up to a hundred times as long as a diamond's.
const HIGH_INDEX: f64 = 4.0;

/// Value parser of `--metrics`.
pub fn metric(name: &str) -> Result<&'static Metric, String> {
    Metric::named(name).map_err(|e| e.to_string())
}

/// Tables have nine decimals.
const LEAST_ERROR: f64 = 1e-9;

/// Value parser of `--error`.
pub fn error(text: &str) -> Result<f64, String> {
    match parse::parse_number(text, NumberUnit::None) {
        Ok(e) if (LEAST_ERROR..=1e3).contains(&e) => Ok(e),
        Ok(_) | Err(NumberError::NotANumber | NumberError::Infinite) => {
            Err(format!("a standard error is a number from {LEAST_ERROR} to 1000"))
        }
        Err(error) => Err(error.to_string()),
    }
}
