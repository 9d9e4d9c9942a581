//! Evaluator: what a candidate of a search is worth: its objectives and constraints, with errors.

use super::comparison::RUNS;
use super::constraint::{Bound, BrokenBound, Constraint, Quantity};
use super::effort::Effort;
use super::objective::{Objective, ObjectiveError};
use super::paired_runs::PairedRuns;
use super::score::score_candidate;
use super::settings::ScoreRequest;
use super::views::{self, Places, View};
use crate::design::proportions;
use crate::geometry::Polyhedron;
use crate::materials::Material;
use crate::sampling::stats::Estimate;
use crate::trace::ConvexStone;

/// What a constraint bounds.
enum Bounded {
    Score(Places),
    Proportion(fn(&proportions::Proportions) -> Option<f64>),
}

/// What a candidate is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    /// One an objective, in the metric's unit.
    pub objectives: Vec<Estimate>,
    /// One a constraint, in the quantity's unit.
    pub constraints: Vec<Estimate>,
    /// By how much bounds are missed together, in parts of the quantities' scales; 0 for a candidate that
    /// keeps them all.
    pub violation: f64,
}

/// A design's objectives and constraints, ready to be computed for many candidates.
///
/// A pure function of the candidate: the number of threads shows in no bit. Checked in
/// `tests/library/objective.rs`.
///
/// ```
/// use cutlab::advanced::scoring::{Effort, Evaluator, Objective, constraint::Constraint};
/// use cutlab::{Material, Stone};
///
/// let [start, other] = ["tolkowsky", "eppler"].map(|name| Stone::parse(name).unwrap());
/// let diamond = Material::named("diamond")?;
/// let evaluator = Evaluator::new(
///     vec![Objective::maximise("iso".parse()?)],
///     vec![Constraint::at_least("weight_ratio=0.9*start")?],
///     &diamond,
///     Effort::default(),
///     start.solid().unwrap(),
/// )?;
/// let values = evaluator.values(other.solid().unwrap())?;
/// assert!(values.objectives[0].value > 60.0 && values.violation == 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Evaluator {
    /// The objectives.
    pub objectives: Vec<Objective>,
    /// The constraints.
    pub constraints: Vec<Constraint>,
    effort: Effort,
    views: Vec<View>,
    of_objectives: Vec<Places>,
    of_constraints: Vec<Bounded>,
    /// Bounds as numbers.
    bounds: Vec<f64>,
    start: Values,
}

impl Evaluator {
    /// Objectives and constraints of stones of a material.
    ///
    /// - `start`: the design before it is changed: bounds may be parts of what it has
    ///
    /// Refuses names, tilts and materials that do not exist, and what the start has no value of.
    pub fn new(
        objectives: Vec<Objective>,
        constraints: Vec<Constraint>,
        material: &Material,
        effort: Effort,
        start: &Polyhedron,
    ) -> Result<Evaluator, ObjectiveError> {
        if objectives.is_empty() {
            return Err(ObjectiveError::Nothing);
        }
        let mut views = Vec::new();
        let mut of_objectives = Vec::new();
        for objective in &objectives {
            of_objectives.push(views::places(&mut views, &objective.of, objective.aim, material)?);
        }
        let mut of_constraints = Vec::new();
        for constraint in &constraints {
            of_constraints.push(match &constraint.of {
                Quantity::Score(of) => {
                    Bounded::Score(views::places(&mut views, of, constraint.aim(), material)?)
                }
                Quantity::Proportion(of) => Bounded::Proportion(of.of),
            });
        }
        let nothing = Values { objectives: Vec::new(), constraints: Vec::new(), violation: 0.0 };
        let bounds = vec![f64::NAN; constraints.len()];
        let mut evaluator = Evaluator {
            objectives,
            constraints,
            effort,
            views,
            of_objectives,
            of_constraints,
            bounds,
            start: nothing,
        };
        let mut values = evaluator.values(start)?;
        for (i, constraint) in evaluator.constraints.iter().enumerate() {
            evaluator.bounds[i] = match constraint.bound {
                Bound::Value(bound) => bound,
                Bound::OfStart(times) => times * values.constraints[i].value,
            };
        }
        values.violation = evaluator.violation(&values.constraints);
        evaluator.start = values;
        Ok(evaluator)
    }

    /// What the start is worth.
    pub fn start(&self) -> &Values {
        &self.start
    }

    /// How finely candidates are scored.
    pub fn effort(&self) -> Effort {
        self.effort
    }

    /// The bounds that the start does not keep.
    pub fn broken_by_start(&self) -> Vec<BrokenBound> {
        let bounds = self.constraints.iter().zip(&self.bounds).zip(&self.start.constraints);
        let broken = bounds.filter(|((c, bound), value)| c.violation(value.value, **bound) > 0.0);
        let told = |((c, bound), value): ((&Constraint, &f64), &Estimate)| BrokenBound {
            quantity: c.of.name(),
            side: c.side,
            value: value.value,
            bound: *bound,
        };
        broken.map(told).collect()
    }

    /// What a candidate is worth; an error names what it has no value of, or why it cannot be lit.
    pub fn values(&self, candidate: &Polyhedron) -> Result<Values, ObjectiveError> {
        let stone = self.prepared(candidate);
        let Effort { error, samples, seed, .. } = self.effort;
        // half of what is left untraced may be the error
        let scores = self.scored(&stone, 2.0 * error, samples, seed, |_, _| true)?;
        let objectives = self.of_objectives.iter().map(|of| views::value(of, &scores)).collect();
        let mut constraints = Vec::with_capacity(self.of_constraints.len());
        let mut measured = None;
        for (of, constraint) in self.of_constraints.iter().zip(&self.constraints) {
            constraints.push(match of {
                Bounded::Score(of) => views::value(of, &scores),
                Bounded::Proportion(of) => {
                    let measured = measured.get_or_insert_with(|| proportions::measure(candidate));
                    let why = || not_measured(&constraint.of.name(), "the stone has no such proportion");
                    Estimate::exact(of(measured).ok_or_else(why)?)
                }
            });
        }
        let violation = self.violation(&constraints);
        Ok(Values { objectives, constraints, violation })
    }

    /// What a candidate is worth if it is cut as any of these stones: objectives over them, their mean or for an
    /// objective of the worst tilt the worst, constraints of the candidate itself.
    ///
    /// - `stones`: at least one
    pub fn values_over(
        &self,
        candidate: &Polyhedron,
        stones: &[Polyhedron],
    ) -> Result<Values, ObjectiveError> {
        let own = match self.constraints.is_empty() {
            true => Values { objectives: Vec::new(), constraints: Vec::new(), violation: 0.0 },
            false => self.values(candidate)?,
        };
        let Effort { error, samples, seed, .. } = self.effort;
        let used = |view: usize| self.of_objectives.iter().any(|of| of.uses(view));
        let scored = |stone: &Polyhedron| {
            let scores = self.scored(&self.prepared(stone), 2.0 * error, samples, seed, |i, _| used(i))?;
            Ok(self.of_objectives.iter().map(|of| views::value(of, &scores)).collect())
        };
        let each: Vec<Vec<Estimate>> = stones.iter().map(scored).collect::<Result<_, ObjectiveError>>()?;
        let over = |(i, of): (usize, &Places)| of.over(each.iter().map(|values| values[i]).collect());
        Ok(Values { objectives: self.of_objectives.iter().enumerate().map(over).collect(), ..own })
    }

    /// The objectives of a candidate so that more of each is better: the sign of those is turned of which less
    /// is wanted.
    pub fn maximised(&self, values: &Values) -> Vec<f64> {
        let each = self.objectives.iter().zip(&values.objectives);
        each.map(|(objective, found)| objective.aim.sign() * found.value).collect()
    }

    fn violation(&self, constraints: &[Estimate]) -> f64 {
        let each = self.constraints.iter().zip(constraints).zip(&self.bounds);
        each.map(|((c, value), bound)| c.violation(value.value, *bound)).sum()
    }

    /// Each objective in runs with fresh random numbers, the same for every stone that is given the same
    /// `seed`, and without light left untraced.
    pub(super) fn paired(&self, solid: &Polyhedron, seed: u64) -> Result<Vec<PairedRuns>, ObjectiveError> {
        let stone = self.prepared(solid);
        let closed = self.scored(&stone, 0.0, self.effort.samples, seed, |_, view| view.is_closed)?;
        let noisy = self.views.iter().any(|view| !view.is_closed);
        let mut runs = vec![closed];
        if noisy {
            let closed = runs.remove(0);
            for run in 0..RUNS {
                let seed = seed.wrapping_mul(RUNS).wrapping_add(run);
                let samples = (self.effort.samples / RUNS).max(1);
                let mut scored = self.scored(&stone, 0.0, samples, seed, |_, view| !view.is_closed)?;
                for (scored, closed) in scored.iter_mut().zip(&closed) {
                    if scored.is_empty() {
                        scored.clone_from(closed);
                    }
                }
                runs.push(scored);
            }
        }
        Ok(self.of_objectives.iter().map(|of| views::paired(of, &runs)).collect())
    }

    /// As [`Evaluator::paired`], of a candidate that is cut as any of these stones.
    pub(super) fn paired_over(
        &self,
        stones: &[Polyhedron],
        seed: u64,
    ) -> Result<Vec<PairedRuns>, ObjectiveError> {
        let each: Vec<Vec<PairedRuns>> =
            stones.iter().map(|stone| self.paired(stone, seed)).collect::<Result<_, _>>()?;
        let over =
            |(i, of): (usize, &Places)| of.paired_over(each.iter().map(|runs| runs[i].clone()).collect());
        Ok(self.of_objectives.iter().enumerate().map(over).collect())
    }

    /// A solid ready for tracing.
    fn prepared(&self, solid: &Polyhedron) -> ConvexStone {
        let absorbing = self.views.iter().map(|view| &view.material).find(|material| !material.is_clear());
        ConvexStone::new(absorbing.map_or_else(|| solid.clone(), |material| self.sized(solid, material)))
    }

    /// A solid in millimetres if its size matters.
    pub(super) fn sized(&self, solid: &Polyhedron, material: &Material) -> Polyhedron {
        let mut solid = solid.clone();
        if !material.is_clear() {
            let to_mm = self.effort.size_mm / solid.width();
            solid.vertices.iter_mut().for_each(|v| *v *= to_mm);
        }
        solid
    }

    /// The scores of the views that are asked for, one list a view; the others' are empty.
    fn scored(
        &self,
        stone: &ConvexStone,
        untraced: f64,
        samples: u64,
        seed: u64,
        asked: impl Fn(usize, &View) -> bool,
    ) -> Result<Vec<Vec<Estimate>>, ObjectiveError> {
        let one = |view: &View| {
            let plan = ScoreRequest { observer: view.observer, ..ScoreRequest::default() }
                .metrics(view.metrics.iter().copied())
                .samples(samples)
                .seed(seed)
                .polarised(self.effort.polarised);
            let row = score_candidate(stone, &view.material, view.tilt, &plan, untraced);
            let scores = view.metrics.iter().zip(&row.scores).map(|(metric, score)| {
                let why = row.why_left_out(metric).or(row.error.as_deref()).unwrap_or("it has no value");
                score.ok_or_else(|| not_measured(metric.name, why))
            });
            scores.collect()
        };
        let views = self.views.iter().enumerate();
        views.map(|(i, view)| if asked(i, view) { one(view) } else { Ok(Vec::new()) }).collect()
    }
}

fn not_measured(quantity: &str, why: &str) -> ObjectiveError {
    ObjectiveError::NotMeasured { quantity: quantity.into(), why: why.into() }
}
