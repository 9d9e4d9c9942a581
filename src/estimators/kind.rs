//! Kinds of estimators: the light that each stands for, the methods by which its sums are found of a stone,
//! and its metrics.

use super::batches::Estimator;
use super::viewer_lighting::ObserverDome;
use super::weighted_exits::BeamEffort;
use super::{EstimatorError, TraceOptics, ViewFrame};
use crate::geometry::Polyhedron;
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally};
use crate::trace::ConvexStone;
use crate::trace::beams::Beams;
use serde::{Serialize, Serializer};
use std::fmt;

/// The light of most estimators, in the words of definitions.
pub const LIGHT: &str = "unpolarised light, Fresnel with its polarisation followed inside (scalar with \
    --polarisation off), D line (for a stone that absorbs, luminance under D65).";

/// One score: a row of its estimator's table. Rows are written as changes of the estimator's own first row,
/// or of [`Metric::of`].
///
/// ```
/// use cutlab::Metric;
/// use cutlab::advanced::metrics::Better;
///
/// let leakage = Metric::by_name("leakage").unwrap();
/// assert_eq!((leakage.range, leakage.better), ((0.0, 1.0), Better::Less));
/// println!("{}", leakage.definition()); // the light, what counts, over what
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Metric {
    /// Its name on the command line and in tables.
    pub name: &'static str,
    /// What it tells, in one line for people.
    pub about: &'static str,
    /// Its unit; empty for a fraction.
    pub unit: &'static str,
    /// Least and greatest value it can take.
    pub range: (f64, f64),
    /// What an error asked for is measured against: 1 for fractions and degrees, 100 for percentages.
    pub scale: f64,
    /// Whether a stone is the better for more of it.
    pub better: Better,
    /// Half-angle in degrees of the observer's dark cone, for a metric that has one; a plan may set
    /// another.
    pub observer: Option<f64>,
    /// Whether beams give it too (`--exact`).
    pub by_beams: bool,
    /// Whether stones that are not convex have it too: a sum of power.
    pub nonconvex: bool,
    /// Parts of [`Metric::definition`]: those that the estimator's metrics share stand once, as constants.
    pub definition: &'static [&'static str],
    /// Where the definition is from.
    pub source: &'static str,
    /// The kind of estimator whose sums it reads.
    pub estimator: &'static dyn EstimatorKind,
    /// What of them.
    pub read_from: MetricSource,
}

/// Which of two values of a score is the better, all else alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// The greater.
    More,
    /// The less.
    Less,
    /// Neither by itself: a matter of balance with others, of taste, or of no merit at all.
    Neither,
}

impl Better {
    /// In one word; empty for neither.
    pub fn word(self) -> &'static str {
        match self {
            Better::More => "more",
            Better::Less => "less",
            Better::Neither => "",
        }
    }

    /// `more is better`; empty for neither.
    pub fn said(self) -> &'static str {
        match self {
            Better::More => "more is better",
            Better::Less => "less is better",
            Better::Neither => "",
        }
    }
}

/// A score as a function. None but `scintillation`, whose axes stay, changes when the stone is turned about
/// its own axis.
#[derive(Debug, Clone, Copy)]
pub enum MetricSource {
    /// Of the sums of its estimator.
    Sums(Statistic),
    /// Of the solid itself: a closed form.
    Solid(fn(&Polyhedron) -> Option<f64>),
}

impl Metric {
    /// A fraction that photons give of convex stones, with nothing told of it yet.
    pub const fn of(estimator: &'static dyn EstimatorKind, read_from: MetricSource) -> Metric {
        Metric {
            name: "",
            about: "",
            unit: "",
            range: (0.0, 1.0),
            scale: 1.0,
            better: Better::Neither,
            observer: None,
            by_beams: false,
            nonconvex: false,
            definition: &[],
            source: "defined by cutlab",
            estimator,
            read_from,
        }
    }

    /// Illumination, observer, polarisation, wavelengths, what counts, normalisation.
    pub fn definition(&self) -> String {
        self.definition.join(" ")
    }

    /// Whether the score speaks of colours, and so means nothing for a material without dispersion.
    pub fn needs_dispersion(&self) -> bool {
        self.estimator.needs_dispersion()
    }

    /// Whether it reads the sums of this kind of estimator.
    pub fn is_of(&self, kind: &dyn EstimatorKind) -> bool {
        self.estimator.name() == kind.name()
    }
}

/// As its name.
impl Serialize for Metric {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

/// A kind of estimator.
pub trait EstimatorKind: fmt::Debug + Sync {
    /// Its name in tables: a name of its own.
    fn name(&self) -> &'static str;

    /// Its metrics.
    fn metrics(&self) -> &'static [Metric];

    /// The columns of its tally.
    fn columns(&self) -> &'static [Column];

    /// The methods by which rays give its metrics of a convex stone.
    ///
    /// - `asked`: those of its metrics that are wanted
    fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, asked: &[&Metric]) -> Vec<Method<'a>>;

    /// What sums would be had all the light that was given up gone one way, for each way that it may have
    /// gone: how far they may be off besides their noise. None if they hold no light.
    fn bounds_of_untraced(&self, _sums: &Tally) -> Vec<Tally> {
        Vec::new()
    }

    /// Whether its metrics speak of colours.
    fn needs_dispersion(&self) -> bool {
        false
    }

    /// Why a stone has no value of a metric that nothing was seen for.
    fn why_unseen(&self, _stone: &ConvexStone) -> &'static str {
        NOTHING_SEEN
    }
}

/// Why a score is left out that nothing was seen for: a share of no light has no value.
pub const NOTHING_SEEN: &str = "no light is seen that it could be measured on";

/// How a stone is lit, looked at and traced.
#[derive(Debug, Clone, Copy)]
pub struct Setup<'a> {
    /// What the stone is made of.
    pub medium: TraceOptics<'a>,
    /// Where the viewer stands.
    pub view_frame: ViewFrame,
    /// The share of a ray's light below which it is given up.
    pub stop_power: f32,
    /// Half-angle in degrees of the observer's dark cone; none leaves each metric its own.
    pub observer: Option<f64>,
    /// Whether beams of a symmetric stone, seen along its axis, are followed in one sector for all.
    pub by_symmetry: bool,
}

impl Setup<'_> {
    /// A stone made ready for beams.
    pub fn beams<'a>(&self, stone: &'a ConvexStone) -> Beams<'a> {
        if self.by_symmetry { Beams::by_symmetry(stone) } else { Beams::new(stone) }
    }

    /// The dome of a metric whose own observer has a cone of half-angle `own`, in degrees.
    pub fn dome(&self, own: f64) -> ObserverDome {
        ObserverDome::with_observer(self.observer.unwrap_or(own))
    }
}

/// Makes an estimator of one stone.
pub type MakeEstimator<'a> = Box<dyn FnOnce() -> Result<Box<dyn Estimator + 'a>, EstimatorError> + 'a>;

/// Gives tallies of batches that share what beams know and have photons of their own, one for all if there
/// are no photons.
pub type BeamTallies<'a> = Box<dyn Fn(&BeamEffort) -> Result<Vec<Tally>, EstimatorError> + 'a>;

/// A method by which sums of a kind of estimator are found of one stone.
pub struct Method<'a> {
    /// Its name beside its number of samples.
    pub name: &'static str,
    /// Whether it gives a metric of the kind.
    pub gives: fn(&Metric) -> bool,
    /// How.
    pub procedure: Procedure<'a>,
}

/// How a method works.
pub enum Procedure<'a> {
    /// By samples: so many points of the hemisphere are as dear as one of them.
    Samples(u64, MakeEstimator<'a>),
    /// By beams of one direction, finished by photons.
    Beams(BeamTallies<'a>),
}

impl<'a> Method<'a> {
    /// A method by samples that gives every metric of its kind.
    ///
    /// - `cost`: so many points of the hemisphere are as dear as one sample
    pub fn samples<E: Estimator + 'a>(
        name: &'static str,
        cost: u64,
        make: impl FnOnce() -> Result<E, EstimatorError> + 'a,
    ) -> Method<'a> {
        let make = || make().map(|estimator| Box::new(estimator) as Box<dyn Estimator + 'a>);
        Method { name, gives: |_| true, procedure: Procedure::Samples(cost, Box::new(make)) }
    }

    /// A method by beams that gives every metric of its kind.
    pub fn beams(
        name: &'static str,
        tallies: impl Fn(&BeamEffort) -> Result<Vec<Tally>, EstimatorError> + 'a,
    ) -> Method<'a> {
        Method { name, gives: |_| true, procedure: Procedure::Beams(Box::new(tallies)) }
    }

    /// The same for some of the metrics alone.
    pub fn giving(self, gives: fn(&Metric) -> bool) -> Method<'a> {
        Method { gives, ..self }
    }
}
