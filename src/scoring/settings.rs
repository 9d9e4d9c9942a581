//! Settings, input and row of a score.

use crate::geometry::{ClosedMesh, Polyhedron};
use crate::materials::Material;
use crate::metrics::{METRICS, Metric};
use crate::sampling::stats::Estimate;
use crate::stone::Stone;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Points of the hemisphere and of the view when nothing else is asked: ±.0003 of `wlr` for a
/// round brilliant, ±.0002 of the `aset` scores.
pub const DEFAULT_SAMPLES: u64 = 1 << 18;

/// Unless the settings say otherwise no estimator is traced further than this in pursuit of an error:
/// about a minute a stone and estimator on two cores.
pub const MAX_SAMPLES: u64 = 1 << 25;

/// How far to trace.
///
/// ```
/// use cutlab::{ScoreRequest, Target};
///
/// assert_eq!(ScoreRequest::new(["wlr"]).error(1e-3).target, Target::Error(1e-3));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Target {
    /// So many points of the hemisphere and the view, fewer of dearer estimators.
    Samples(u64),
    /// Until the standard error of every metric asked for is below this times the metric's
    /// [`Metric::scale`]: a fraction, degrees for angles, hundredths of it for percentages.
    Error(f64),
}

impl Default for Target {
    fn default() -> Self {
        Target::Samples(DEFAULT_SAMPLES)
    }
}

/// How a stone is turned before viewer and light, which stay.
///
/// ```
/// use cutlab::{ScoreRequest, Stone, Tilt};
///
/// let request = ScoreRequest::new(["light_return"]).samples(1 << 10);
/// let tilted = request.run_tilted(&Stone::parse("tolkowsky")?, Some(Tilt { degrees: 15.0, azimuth: 0.0 }))?;
/// assert!(tilted["light_return"].value > 0.5);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tilt {
    /// Degrees, right-handed about the axis.
    pub degrees: f64,
    /// Azimuth of the axis, which is horizontal, in degrees from +x towards +y.
    pub azimuth: f64,
}

impl Tilt {
    /// Most degrees of a tilt: steeper, the silhouette of a flat stone has hardly any width left.
    pub const MOST_DEGREES: f64 = 89.9;
}

/// The shape of a stone.
#[derive(Debug, Clone)]
pub enum StoneShape {
    /// A convex solid: it has every score.
    Convex(Polyhedron),
    /// One closed surface with concavities: it has the scores that are sums of power ([`Metric::nonconvex`]).
    Nonconvex(Box<ClosedMesh>),
}

impl From<Polyhedron> for StoneShape {
    fn from(solid: Polyhedron) -> StoneShape {
        StoneShape::Convex(solid)
    }
}

/// A stone to score.
#[derive(Debug, Clone)]
pub struct ScoreInput {
    /// Its name in the table.
    pub stone: String,
    /// What it is made of.
    pub material: Material,
    /// Its shape, in millimetres if the material absorbs; or why it has none: the row then carries
    /// the message.
    pub shape: Result<StoneShape, String>,
    /// How it is turned; none for face-up.
    pub tilt: Option<Tilt>,
}

/// The scores of a stone.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoreRow {
    /// The stone's name.
    pub stone: String,
    /// Its material's name.
    pub material: String,
    /// Number of its facets; none if it has no shape.
    pub facets: Option<usize>,
    /// One a metric of the plan; none where the metric does not apply (see [`ScoreRow::left_out`]) or the
    /// stone failed.
    pub scores: Vec<Option<Estimate>>,
    /// Points traced, by estimator.
    pub samples: Vec<(&'static str, u64)>,
    /// What is to be said of the scores: photons that took the place of beams.
    pub note: Option<&'static str>,
    /// What went wrong: no shape, no light, or an error not reached (the scores then stand).
    pub error: Option<String>,
    /// Metrics of the plan that do not apply to the stone, with the reason: nothing went wrong.
    pub left_out: Vec<(&'static str, Cow<'static, str>)>,
}

impl ScoreInput {
    /// The input of a stone as it is, and how it is turned. A mesh of several parts has no shape that can be
    /// scored: the message says why.
    pub fn from_stone(stone: &Stone, tilt: Option<Tilt>) -> ScoreInput {
        let shape = match (stone.solid(), stone.mesh(), stone.why_not_convex()) {
            (Some(solid), ..) => Ok(StoneShape::Convex(solid.clone())),
            (_, Some(mesh), _) if mesh.shells == 1 => Ok(StoneShape::Nonconvex(Box::new(mesh.clone()))),
            (.., why) => Err(why.map_or_else(String::new, ToString::to_string)),
        };
        ScoreInput { stone: stone.name().into(), material: stone.material().clone(), shape, tilt }
    }
}

impl ScoreRow {
    /// The row of a stone of which nothing is known yet.
    pub(super) fn empty(stone: String, material: String, plan: &ScoreRequest) -> ScoreRow {
        ScoreRow {
            stone,
            material,
            facets: None,
            scores: vec![None; plan.metrics.len()],
            samples: Vec::new(),
            note: None,
            error: None,
            left_out: Vec::new(),
        }
    }

    /// The row of a stone that could not be opened.
    pub fn failed(stone: String, material: String, error: String, plan: &ScoreRequest) -> ScoreRow {
        ScoreRow { error: Some(error), ..ScoreRow::empty(stone, material, plan) }
    }

    /// Leaves the score of a metric empty, for a reason.
    pub(super) fn leave_out(&mut self, metric: &Metric, why: impl Into<Cow<'static, str>>) {
        self.left_out.push((metric.name, why.into()));
    }

    /// What is left out and why, in words: metrics of one reason together. None if every score is there.
    pub fn omissions(&self) -> Option<String> {
        let mut reasons: Vec<(&str, Vec<&str>)> = Vec::new();
        for (metric, why) in &self.left_out {
            match reasons.iter_mut().find(|(reason, _)| *reason == why.as_ref()) {
                Some((_, metrics)) => metrics.push(metric),
                None => reasons.push((why, vec![metric])),
            }
        }
        let said: Vec<String> =
            reasons.iter().map(|(why, metrics)| format!("{} left out: {why}", metrics.join(", "))).collect();
        (!said.is_empty()).then(|| said.join("; "))
    }

    /// The reason for which a metric is left out, if it is.
    pub fn why_left_out(&self, metric: &Metric) -> Option<&str> {
        self.left_out.iter().find(|(name, _)| *name == metric.name).map(|(_, why)| why.as_ref())
    }
}

/// What to score, and how. As JSON its metrics are names; fields that are left out have their defaults.
///
/// ```
/// use cutlab::{ScoreRequest, Stone};
///
/// let request = ScoreRequest::new(["windowing"]).samples(1 << 10).seed(7);
/// assert!(request.run(&Stone::parse("octahedron")?)?.get("windowing").is_some());
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct ScoreRequest {
    /// The metrics, in the order of the columns.
    pub metrics: Vec<&'static Metric>,
    /// How far to trace.
    pub target: Target,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at
    /// each (scalar Fresnel).
    pub polarised: bool,
    /// The user's seed.
    pub seed: u64,
    /// No estimator is traced further than so many samples in pursuit of an error (dearer ones
    /// fewer); where this ends one, the row says so.
    pub cap: u64,
    /// Whether metrics that beams can give are taken from beams: the effort is then theirs. Not in a
    /// stone that absorbs: the path differs across a beam; nor in one with concavities.
    pub exact: bool,
    /// Half-angle in degrees of the observer's dark cone, for the metrics that have one
    /// ([`Metric::observer`]); none leaves each its own.
    pub observer: Option<f64>,
    /// Names that were asked for and that no metric has.
    #[serde(skip)]
    pub unknown: Vec<String>,
}

impl Default for ScoreRequest {
    /// Every metric, default effort and cap, polarisation followed, seed 1, no beams, each metric's
    /// own observer.
    fn default() -> Self {
        ScoreRequest {
            metrics: METRICS.to_vec(),
            target: Target::default(),
            polarised: true,
            seed: 1,
            cap: MAX_SAMPLES,
            exact: false,
            observer: None,
            unknown: Vec::new(),
        }
    }
}
