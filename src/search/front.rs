//! Candidates in order: the best first, those that none dominates, those that differ, and the hypervolume they
//! cover.

use super::problem::{Candidate, Problem};
use genoxide::Objective;
use genoxide::multi::indicator;
use std::cmp::Ordering;

/// The numbers of all candidates, from the best: feasible before infeasible, then the smaller violation, then
/// the larger first objective, then the next, then the earlier.
pub fn ranked(candidates: &[Candidate]) -> Vec<usize> {
    let mut numbers: Vec<usize> = (0..candidates.len()).collect();
    let order = |a: &Candidate, b: &Candidate| {
        let (a, b) = (&a.outcome, &b.outcome);
        let objectives = b.objectives.iter().zip(&a.objectives).map(|(b, a)| b.total_cmp(a));
        a.violation.total_cmp(&b.violation).then(objectives.fold(Ordering::Equal, Ordering::then))
    };
    numbers.sort_by(|&i, &j| order(&candidates[i], &candidates[j]));
    numbers
}

/// The numbers of the feasible candidates that none dominates, by the first objective from the best. Of
/// several with the same objectives it has the earliest.
pub fn front(candidates: &[Candidate]) -> Vec<usize> {
    let mut front: Vec<usize> = Vec::new();
    // none that comes later in this order dominates one before it
    for number in ranked(candidates) {
        let outcome = &candidates[number].outcome;
        let is_covered = |&other: &usize| {
            let other = &candidates[other].outcome;
            other.dominates(outcome) || other.objectives == outcome.objectives
        };
        if outcome.is_feasible() && !front.iter().any(is_covered) {
            front.push(number);
        }
    }
    front
}

/// The numbers of the best feasible candidates that differ, from the best: at most `count`, any two of them
/// at least `distance` apart.
///
/// - `distance`: the largest difference of two coordinates in the unit cube, a share of a variable's range
pub fn best_distinct(problem: &Problem, candidates: &[Candidate], count: usize, distance: f64) -> Vec<usize> {
    let mut best: Vec<(usize, Vec<f64>)> = Vec::new();
    for number in ranked(candidates) {
        if best.len() == count || !candidates[number].outcome.is_feasible() {
            break;
        }
        let unit = problem.to_unit(&candidates[number].values);
        let apart = |other: &[f64]| unit.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if best.iter().all(|(_, other)| apart(other) >= distance) {
            best.push((number, unit));
        }
    }
    best.into_iter().map(|(number, _)| number).collect()
}

/// The volume of what points dominate above a reference: the measure of a front (E. Zitzler and L. Thiele,
/// IEEE Trans. Evol. Comput. 3 (1999) 257), exact. More is better; points that do not exceed the reference in
/// every objective add nothing.
///
/// - `points`: values of objectives, to be maximised, in any order
/// - `reference`: a value for each objective, from one to [`MOST_OBJECTIVES`](super::MOST_OBJECTIVES)
pub fn hypervolume(points: &[Vec<f64>], reference: &[f64]) -> f64 {
    match reference.len() {
        1 => hypervolume_of::<1>(points, reference),
        2 => hypervolume_of::<2>(points, reference),
        3 => hypervolume_of::<3>(points, reference),
        4 => hypervolume_of::<4>(points, reference),
        5 => hypervolume_of::<5>(points, reference),
        _ => 0.0,
    }
}

fn hypervolume_of<const M: usize>(points: &[Vec<f64>], reference: &[f64]) -> f64 {
    let of_point = |point: &[f64]| <[f64; M]>::try_from(point).ok();
    let points: Vec<[f64; M]> = points.iter().filter_map(|point| of_point(point)).collect();
    let reference = of_point(reference).unwrap_or([f64::NAN; M]);
    indicator::hypervolume(&points, &reference, &[Objective::Maximize; M])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::problem::Outcome;

    fn candidate(x: f64, objectives: &[f64], violation: f64) -> Candidate {
        Candidate { values: vec![x], outcome: Outcome { objectives: objectives.to_vec(), violation } }
    }

    #[test]
    fn feasible_candidates_come_before_others() {
        let candidates = [
            candidate(0.0, &[9.0], 0.5),
            candidate(0.1, &[1.0], 0.0),
            Candidate { values: vec![0.2], outcome: Outcome::nothing() },
            candidate(0.3, &[3.0], 0.0),
            candidate(0.4, &[5.0], 0.1),
            candidate(0.5, &[3.0], 0.0),
        ];
        assert_eq!(ranked(&candidates), [3, 5, 1, 4, 0, 2]);
        assert_eq!(front(&candidates), [3]);
        let problem = Problem::new(vec![0.0..=1.0], vec![0.0], 1).expect("a problem");
        assert_eq!(best_distinct(&problem, &candidates, 5, 0.15), [3, 5, 1], "all feasible ones");
        assert_eq!(best_distinct(&problem, &candidates, 5, 0.25), [3], "0.1 and 0.5 are within 0.25 of 0.3");
    }

    #[test]
    fn the_front_has_what_none_dominates() {
        let values = [[1.0, 3.0], [2.0, 2.0], [1.5, 1.5], [3.0, 1.0], [2.0, 2.0], [0.5, 3.0]];
        let candidates: Vec<Candidate> =
            values.iter().enumerate().map(|(i, v)| candidate(i as f64, v, 0.0)).collect();
        assert_eq!(front(&candidates), [3, 1, 0]);
        assert_eq!(front(&[candidate(0.0, &[1.0, 1.0], 0.1)]), [] as [usize; 0]);
    }

    /// [D] Boxes above the reference: unions of unit squares and cubes.
    #[test]
    fn hypervolumes_are_those_of_unions_of_boxes() {
        let points = vec![vec![1.0, 3.0], vec![2.0, 2.0], vec![3.0, 1.0], vec![-1.0, 9.0]];
        assert_eq!(hypervolume(&points, &[0.0, 0.0]), 6.0);
        let points = vec![vec![1.0, 1.0, 2.0], vec![2.0, 1.0, 1.0]];
        assert_eq!(hypervolume(&points, &[0.0, 0.0, 0.0]), 3.0);
        assert_eq!(hypervolume(&[vec![4.0], vec![2.5]], &[1.0]), 3.0);
        assert_eq!(hypervolume(&[], &[0.0, 0.0]), 0.0);
    }
}
