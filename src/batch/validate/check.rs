//! Figures, what is expected of them, and checks that compute them.

use super::context::{CheckContext, CheckError};
use crate::sampling::stats::Estimate;
use serde::Deserialize;
use std::fmt;

/// A figure comes out if it lies within its tolerance and so many standard errors of ours: chance
/// alone fails 1 in 370 whose tolerance is nothing.
pub const ERRORS: f64 = 3.0;

/// What kind of figure an expectation is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SourceKind {
    /// Stands in a publication, which is named.
    Published,
    /// Follows from a definition.
    Derived,
    /// Computed by a tracer that has nothing in common with this program; not literature.
    CrossChecked,
}

impl fmt::Display for SourceKind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            SourceKind::Published => "published",
            SourceKind::Derived => "derived",
            SourceKind::CrossChecked => "cross-checked",
        })
    }
}

/// Where an expectation is from.
#[derive(Debug, Clone, Copy)]
pub struct FigureSource {
    /// Its kind.
    pub kind: SourceKind,
    /// The publication, definition or program.
    pub name: &'static str,
}

/// A tracer and a geometry program written for the project's notes alone.
pub(super) const TRACER: FigureSource =
    FigureSource { kind: SourceKind::CrossChecked, name: "independent reference tracer" };

/// What is expected of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Expected {
    /// A value within a tolerance.
    Near(f64, f64),
    /// More than this.
    Above(f64),
    /// Less than this.
    Below(f64),
}

impl Expected {
    /// Whether a number meets it: off by no more than the tolerance and [`ERRORS`] standard errors; a
    /// bound is to be kept by as many errors.
    pub fn is_met(self, ours: Estimate) -> bool {
        let slack = ERRORS * ours.error;
        match self {
            Expected::Near(value, tolerance) => (ours.value - value).abs() <= tolerance + slack,
            Expected::Above(bound) => ours.value - slack > bound,
            Expected::Below(bound) => ours.value + slack < bound,
        }
    }

    /// The value or bound.
    pub fn value(self) -> f64 {
        match self {
            Expected::Near(x, _) | Expected::Above(x) | Expected::Below(x) => x,
        }
    }

    /// The tolerance; none of a bound.
    pub fn tolerance(self) -> Option<f64> {
        if let Expected::Near(_, tolerance) = self { Some(tolerance) } else { None }
    }

    /// `=`, `>` or `<`.
    pub fn relation(self) -> &'static str {
        match self {
            Expected::Near(..) => "=",
            Expected::Above(_) => ">",
            Expected::Below(_) => "<",
        }
    }
}

/// One number and what is expected of it.
#[derive(Debug, Clone)]
pub struct Figure {
    /// What it is, in a few words.
    pub name: String,
    /// Where the expectation is from.
    pub source: FigureSource,
    /// The expectation.
    pub expected: Expected,
    /// Its unit; empty for a plain number.
    pub unit: &'static str,
    /// Where it stands along the axis of its check's plot.
    pub at: Option<f64>,
    /// What explains it if it does not come out; empty if nothing is known that would.
    pub why: &'static str,
}

impl Figure {
    pub(super) fn new(name: impl Into<String>, source: FigureSource, expected: Expected) -> Figure {
        Figure { name: name.into(), source, expected, unit: "", at: None, why: "" }
    }

    pub(super) fn near(name: impl Into<String>, source: FigureSource, value: f64, tolerance: f64) -> Figure {
        Figure::new(name, source, Expected::Near(value, tolerance))
    }

    pub(super) fn unit(self, unit: &'static str) -> Figure {
        Figure { unit, ..self }
    }

    pub(super) fn at_x(self, x: f64) -> Figure {
        Figure { at: Some(x), ..self }
    }

    pub(super) fn because(self, why: &'static str) -> Figure {
        Figure { why, ..self }
    }
}

/// What a check finds.
#[derive(Debug, Default)]
pub(super) struct Measured {
    /// One a figure, in their order.
    pub(super) ours: Vec<Estimate>,
    /// The line of its plot.
    pub(super) line: Vec<(f64, Estimate)>,
}

impl Measured {
    pub(super) fn new(ours: Vec<Estimate>) -> Measured {
        Measured { ours, line: Vec::new() }
    }

    pub(super) fn exact(ours: impl IntoIterator<Item = f64>) -> Measured {
        Measured::new(ours.into_iter().map(Estimate::exact).collect())
    }
}

/// How a check is drawn: a line of ours, and the figures that say where they stand.
#[derive(Debug, Clone, Copy)]
pub struct Axes {
    /// What it shows.
    pub title: &'static str,
    /// Along the axis.
    pub x: &'static str,
    /// Up.
    pub y: &'static str,
}

pub(super) type Measurement = Box<dyn Fn(&CheckContext) -> Result<Measured, CheckError>>;

/// Figures that are computed together.
pub struct Check {
    /// Its chapter of the table.
    pub subject: &'static str,
    /// The figures.
    pub figures: Vec<Figure>,
    /// How it is drawn, if it is.
    pub plot: Option<Axes>,
    pub(super) measure: Measurement,
}

impl Check {
    pub(super) fn new(
        subject: &'static str,
        figures: Vec<Figure>,
        measure: impl Fn(&CheckContext) -> Result<Measured, CheckError> + 'static,
    ) -> Check {
        Check { subject, figures, plot: None, measure: Box::new(measure) }
    }

    pub(super) fn drawn(self, title: &'static str, x: &'static str, y: &'static str) -> Check {
        Check { plot: Some(Axes { title, x, y }), ..self }
    }

    /// Computes the figures.
    pub fn run(self, lab: &CheckContext) -> CheckReport {
        let (found, trouble) = match (self.measure)(lab) {
            Ok(found) => (found, None),
            Err(error) => (Measured::default(), Some(error)),
        };
        let outcome = |(i, figure): (usize, Figure)| {
            let ours = found.ours.get(i).copied().filter(|e| e.value.is_finite());
            let verdict = match (ours, &trouble) {
                (Some(ours), _) if figure.expected.is_met(ours) => Verdict::Passed,
                (None, Some(CheckError::Missing(_))) => Verdict::Skipped,
                _ => Verdict::Failed,
            };
            let why = match &trouble {
                Some(error) => error.to_string(),
                None if verdict == Verdict::Failed => figure.why.to_string(),
                None => String::new(),
            };
            FigureOutcome { subject: self.subject, figure, ours, verdict, why }
        };
        let outcomes = self.figures.into_iter().enumerate().map(outcome).collect();
        CheckReport { outcomes, plot: self.plot, line: found.line }
    }
}

/// How a figure came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// As expected.
    Passed,
    /// Not as expected.
    Failed,
    /// What it needs is not there.
    Skipped,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Verdict::Passed => "passed",
            Verdict::Failed => "failed",
            Verdict::Skipped => "skipped",
        })
    }
}

/// A figure beside ours.
#[derive(Debug, Clone)]
pub struct FigureOutcome {
    /// The chapter.
    pub subject: &'static str,
    /// The figure.
    pub figure: Figure,
    /// Ours, if it could be computed.
    pub ours: Option<Estimate>,
    /// How it came out.
    pub verdict: Verdict,
    /// What explains it, or why it was skipped; may be empty.
    pub why: String,
}

/// What became of a check.
#[derive(Debug, Clone)]
pub struct CheckReport {
    /// Its figures.
    pub outcomes: Vec<FigureOutcome>,
    /// How it is drawn, if it is.
    pub plot: Option<Axes>,
    /// The line of the plot.
    pub line: Vec<(f64, Estimate)>,
}
