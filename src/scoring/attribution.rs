//! Attribution: what a degree of each tier's angle does to scores, through which facets light is lost, and what to
//! change first.

mod first_change;
mod turns;

use super::effort::Effort;
use super::evaluator::Evaluator;
use super::objective::{Aim, Objective, ObjectiveError, TiltedMetric};
use super::tier_effects::TierSlope;
use crate::design::Design;
use crate::design::edit::{EditError, Editor, Keep};
use crate::estimators::facet_leakage::FacetLeakage;
use crate::materials::Material;
use crate::metrics::{Better, Metric};
use crate::progress::Progress;
use crate::sampling::stats::Estimate;
use crate::stone::{Stone, StoneError};
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, Ordering};
use turns::Turn;

pub use first_change::{FirstChange, HALF_DEGREE};

/// Where an error is asked for, the samples to begin with: enough for the noise to be known to a fifth.
const FIRST_SAMPLES: u64 = 1 << 13;

/// No more samples than this are traced in pursuit of an error: about a minute for ten tiers on two cores.
const MOST_SAMPLES: u64 = 1 << 22;

/// What is asked about the tiers of a design.
///
/// ```
/// use cutlab::{AttributionRequest, Stone};
///
/// let request = AttributionRequest::new(["iso"])?;
/// let found = request.run(&Stone::parse("classic:ri=1.54")?, &())?;
/// let first = found.objectives[0].first.as_ref().expect("its angles are not the best");
/// assert!(first.degrees.abs() == 0.5 && first.scored.value > 0.0);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct AttributionRequest {
    /// The scores, with the values that are wanted.
    pub objectives: Vec<Objective>,
    /// What a turned tier leaves as it is. None keeps the other angles ([`Keep::Angles`]), and where that cannot be
    /// lets them follow ([`Keep::Meets`]).
    pub keep: Option<Keep>,
    /// How finely scores with noise are traced.
    pub effort: Effort,
    /// The greatest noise that a change per degree may have, times the metric's scale, in place of the samples
    /// of `effort`; none keeps these.
    pub error: Option<f64>,
}

/// What each tier of a design does.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Attribution {
    /// The stone as it is named.
    pub stone: String,
    /// What it is made of.
    pub material: String,
    /// What was asked for, and what to change first for it.
    pub objectives: Vec<AttributedObjective>,
    /// The share of what is seen face-up that is light from below, all facets together: the metric `aset_leak`.
    pub leakage: Estimate,
    /// The tiers in cutting order.
    pub tiers: Vec<TierAttribution>,
    /// What is to be said of it: an error that was not reached.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// An objective, and what to change first for it.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct AttributedObjective {
    /// The metric with its tilts.
    pub name: String,
    /// The metric's unit; may be empty.
    pub unit: &'static str,
    /// Which values are wanted.
    pub aim: Aim,
    /// The score of the stone as it is.
    pub value: Estimate,
    /// The places of the tiers that can be turned, the greatest change per degree first.
    pub order: Vec<String>,
    /// The change to make first: of the first three tiers of `order` the one of which half a degree gains most when
    /// it is scored; none if none gains significantly.
    pub first: Option<FirstChange>,
}

/// What a tier does.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct TierAttribution {
    /// Its place: `P1`, `C2`, `G1`.
    pub place: String,
    /// Its name; empty if it has none.
    pub name: String,
    /// Where its facets are.
    pub zone: &'static str,
    /// Its angle from the girdle plane in degrees, without sign.
    pub angle_deg: f64,
    /// Number of its facets.
    pub facets: usize,
    /// What was kept when it was turned; none if it cannot be.
    pub keep: Option<Keep>,
    /// The places of tiers whose angles follow when it is turned.
    pub followed: Vec<String>,
    /// One an objective; empty if it cannot be turned.
    pub changes: Vec<ChangePerDegree>,
    /// Why there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<String>,
    /// The share of what is seen face-up that is light from below through its facets.
    pub leakage: Estimate,
    /// The same facet by facet.
    pub leakage_by_facet: Vec<FacetShare>,
}

/// The change of a score with the angle of a tier.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct ChangePerDegree {
    /// The metric with its tilts.
    pub objective: String,
    /// The change per degree by which the tier is steeper, in the metric's unit.
    pub per_degree: Estimate,
    /// Whether it is beyond chance and not negligible.
    pub significant: bool,
}

/// The share of one facet.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct FacetShare {
    /// The facet: its tier with its index or number there.
    pub facet: String,
    /// Its share.
    pub leakage: Estimate,
}

/// Why there is no attribution.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AttributionError {
    /// A mesh that is no convex stone.
    #[error(transparent)]
    Stone(#[from] StoneError),
    /// Planes that bound no stone.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// A score that there is not, or that the stone does not have.
    #[error(transparent)]
    Objective(#[from] ObjectiveError),
    /// Ended early.
    #[error("cancelled")]
    Cancelled,
}

impl Default for AttributionRequest {
    /// `iso` and `wlr`, which beams and rays give: the faceters' score and the light return of the laboratories.
    fn default() -> AttributionRequest {
        let metrics = ["iso", "wlr"].iter().filter_map(|name| Metric::by_name(name));
        AttributionRequest {
            objectives: metrics.map(|metric| wanted(TiltedMetric::new(metric))).collect(),
            keep: None,
            effort: Effort::default(),
            error: None,
        }
    }
}

/// An objective that wants what is better of a metric; of one of which neither is, more.
pub fn wanted(of: TiltedMetric) -> Objective {
    match of.metric.better {
        Better::Less => Objective::minimise(of),
        Better::More | Better::Neither => Objective::maximise(of),
    }
}

impl AttributionRequest {
    /// About these metrics, as they are typed: `iso`, `windowing@0,15`. Of each the better values are wanted.
    pub fn new<S: AsRef<str>>(
        metrics: impl IntoIterator<Item = S>,
    ) -> Result<AttributionRequest, ObjectiveError> {
        let objectives: Result<_, ObjectiveError> =
            metrics.into_iter().map(|name| Ok(wanted(name.as_ref().parse()?))).collect();
        Ok(AttributionRequest { objectives: objectives?, ..AttributionRequest::default() })
    }

    /// About these objectives.
    pub fn objectives(mut self, objectives: impl IntoIterator<Item = Objective>) -> AttributionRequest {
        self.objectives = objectives.into_iter().collect();
        self
    }

    /// With one thing kept, whichever tier is turned.
    pub fn keep(mut self, keep: Keep) -> AttributionRequest {
        self.keep = Some(keep);
        self
    }

    /// With an effort.
    pub fn effort(mut self, effort: Effort) -> AttributionRequest {
        self.effort = effort;
        self
    }

    /// With a greatest noise of changes per degree, times the metric's scale.
    pub fn error(mut self, error: f64) -> AttributionRequest {
        self.error = Some(error);
        self
    }

    /// What the tiers of a stone do.
    pub fn run(&self, stone: &Stone, progress: &dyn Progress) -> Result<Attribution, AttributionError> {
        self.of_design(stone.name(), stone.convex_design()?, stone.material(), progress)
    }

    /// What the tiers of a design do, in a material.
    ///
    /// - `name`: of the stone
    pub fn of_design(
        &self,
        name: &str,
        design: &Design,
        material: &Material,
        progress: &dyn Progress,
    ) -> Result<Attribution, AttributionError> {
        let editor = Editor::new(design)?;
        let turns = turns::of_tiers(&editor, self.keep);
        let faces: Vec<Vec<usize>> =
            editor.tiers.tiers.iter().map(|tier| faces(&editor, &tier.facets)).collect();
        let mut effort = self.effort;
        if self.error.is_some() {
            effort.samples = FIRST_SAMPLES;
        }
        loop {
            let evaluator =
                Evaluator::new(self.objectives.clone(), Vec::new(), material, effort, &editor.solid)?;
            let leakage = evaluator.leakage(&editor.solid, material)?;
            let found = measured(&evaluator, &editor, &turns, &faces, &leakage, progress)?;
            let noise = found.iter().flatten().flatten().zip(self.objectives.iter().cycle());
            let noise = noise.map(|(slope, of)| slope.noise / of.of.metric.scale).fold(0.0, f64::max);
            let too_much = self.error.map_or(0.0, |error| noise / error);
            if too_much > 1.0 && effort.samples < MOST_SAMPLES {
                let needed = (effort.samples as f64 * too_much * too_much * 1.2).min(MOST_SAMPLES as f64);
                effort.samples = (needed as u64).next_power_of_two().clamp(2 * effort.samples, MOST_SAMPLES);
                continue;
            }
            let all = All { editor: &editor, evaluator: &evaluator, turns: &turns, faces: &faces, leakage };
            let mut attribution = all.attribution(name, material, found);
            if too_much > 1.0 {
                let said = "the changes per degree have more noise than --error asks for, after";
                attribution.warnings.push(format!("{said} {MOST_SAMPLES} samples a stone"));
            }
            return Ok(attribution);
        }
    }
}

/// For each tier the change of each objective with its angle, or why there is none.
fn measured(
    evaluator: &Evaluator,
    editor: &Editor,
    turns: &[Result<Turn, EditError>],
    faces: &[Vec<usize>],
    leakage: &FacetLeakage,
    progress: &dyn Progress,
) -> Result<Vec<Result<Vec<TierSlope>, String>>, AttributionError> {
    /// Stones of a tier: two steps to both sides.
    const STONES: u64 = 4;
    let is_cancelled = AtomicBool::new(false);
    progress.begin("turning tiers", STONES * turns.iter().flatten().count() as u64);
    let turned = |tier: usize, degrees: f64| {
        let turn = turns[tier].as_ref().map_err(ToString::to_string)?;
        if progress.is_cancelled() {
            is_cancelled.store(true, Ordering::Relaxed);
            return Err(String::new());
        }
        progress.advance(1);
        turn.edited(editor, degrees).map(|edited| edited.solid).map_err(|why| why.to_string())
    };
    let effects = evaluator.tier_effects(faces, turned, leakage);
    progress.end();
    match is_cancelled.into_inner() {
        true => Err(AttributionError::Cancelled),
        false => Ok(effects.into_iter().map(|effect| effect.slopes).collect()),
    }
}

/// The faces of the solid that stand in facets of the design.
fn faces(editor: &Editor, facets: &[usize]) -> Vec<usize> {
    let faces = editor.solid.faces.iter().enumerate();
    faces.filter(|(_, face)| facets.contains(&face.plane)).map(|(number, _)| number).collect()
}

/// Everything that an attribution is put together from.
struct All<'a> {
    editor: &'a Editor,
    evaluator: &'a Evaluator,
    turns: &'a [Result<Turn, EditError>],
    /// The faces of each tier.
    faces: &'a [Vec<usize>],
    leakage: FacetLeakage,
}

impl All<'_> {
    fn attribution(
        &self,
        name: &str,
        material: &Material,
        slopes: Vec<Result<Vec<TierSlope>, String>>,
    ) -> Attribution {
        let All { editor, evaluator, turns, .. } = self;
        let orders: Vec<Vec<usize>> = (0..evaluator.objectives.len())
            .map(|objective| first_change::order(objective, &slopes))
            .collect();
        let firsts = first_change::first_changes(evaluator, editor, turns, &slopes, &orders);
        let place = |tier: &usize| editor.tiers.tiers[*tier].place.clone();
        let objectives =
            evaluator.objectives.iter().zip(&evaluator.start().objectives).zip(orders.iter().zip(firsts));
        let objectives = objectives.map(|((objective, value), (order, first))| AttributedObjective {
            name: objective.name(),
            unit: objective.of.metric.unit,
            aim: objective.aim,
            value: *value,
            order: order.iter().map(place).collect(),
            first,
        });
        Attribution {
            stone: name.into(),
            material: material.name.to_string(),
            objectives: objectives.collect(),
            leakage: self.leakage.through(0..editor.solid.faces.len()),
            tiers: slopes.into_iter().enumerate().map(|(tier, slopes)| self.tier(tier, slopes)).collect(),
            warnings: Vec::new(),
        }
    }

    fn tier(&self, number: usize, slopes: Result<Vec<TierSlope>, String>) -> TierAttribution {
        let tier = &self.editor.tiers.tiers[number];
        let turn = self.turns[number].as_ref().ok();
        let share = |face: &usize| FacetShare {
            facet: self.editor.tiers.facet_label(&self.editor.design, self.editor.solid.faces[*face].plane),
            leakage: self.leakage.by_facet[*face],
        };
        let change = |(objective, slope): (&Objective, &TierSlope)| ChangePerDegree {
            objective: objective.name(),
            per_degree: slope.per_degree,
            significant: slope.is_significant,
        };
        let measured = slopes.as_deref().unwrap_or_default();
        TierAttribution {
            place: tier.place.clone(),
            name: tier.name.clone(),
            zone: tier.zone.name(),
            angle_deg: self.editor.angle_deg(tier),
            facets: tier.facets.len(),
            keep: turn.filter(|_| slopes.is_ok()).map(|turn| turn.keep),
            followed: turn.filter(|_| slopes.is_ok()).map_or_else(Vec::new, |turn| turn.followed.clone()),
            changes: self.evaluator.objectives.iter().zip(measured).map(change).collect(),
            leakage: self.leakage.through(self.faces[number].iter().copied()),
            leakage_by_facet: self.faces[number].iter().map(share).collect(),
            left_out: slopes.err(),
        }
    }
}

impl TierAttribution {
    /// What it is called: its name, else its place.
    pub fn label(&self) -> &str {
        if self.name.is_empty() { &self.place } else { &self.name }
    }
}
