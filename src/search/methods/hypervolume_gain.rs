//! The hypervolume that points add to a front, and the choice of those that add most together.

use crate::search::front::hypervolume;

/// How far below the worst value of each objective the reference lies, as a share of the objective's span: so
/// the ends of a front count too.
const BELOW: f64 = 0.1;

/// The numbers of the candidates that add most hypervolume to a front, one after the other: at most `count`,
/// and none that adds nothing.
///
/// - `front`, `candidates`: values of objectives, to be maximised
pub fn most_gaining(front: &[Vec<f64>], candidates: &[Vec<f64>], count: usize) -> Vec<usize> {
    let scaled = scaled(front, candidates);
    let (front, candidates) = scaled.split_at(front.len());
    let mut covered = front.to_vec();
    // each candidate's gain when it was last computed: it never grows as the front grows, so that those with
    // the largest old gains are the only ones to compute again (M. Minoux, in: Optimization Techniques (1978) 234)
    let mut gains: Vec<(f64, usize)> =
        candidates.iter().map(|point| gain(&covered, point)).zip(0..).collect();
    let mut chosen = Vec::new();
    while chosen.len() < count {
        gains.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut best = (0.0, None);
        for (at, (known, number)) in gains.iter_mut().enumerate() {
            if *known <= best.0 {
                break;
            }
            *known = gain(&covered, &candidates[*number]);
            if *known > best.0 {
                best = (*known, Some(at));
            }
        }
        let Some(at) = best.1 else { break };
        let (_, number) = gains.swap_remove(at);
        covered.push(candidates[number].clone());
        chosen.push(number);
    }
    chosen
}

/// All values as shares of each objective's span, above a reference of zero.
fn scaled(front: &[Vec<f64>], candidates: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let all = || front.iter().chain(candidates);
    let objectives = all().next().map_or(0, Vec::len);
    let ends: Vec<(f64, f64)> = (0..objectives)
        .map(|j| {
            let values = || all().filter_map(|point| point.get(j).copied());
            (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
        })
        .collect();
    let share = |(value, (low, high)): (&f64, &(f64, f64))| {
        let span = high - low;
        BELOW + if span > 0.0 { (value - low) / span } else { 1.0 }
    };
    all().map(|point| point.iter().zip(&ends).map(share).collect()).collect()
}

/// The volume above zero that a point dominates and none of `covered` does.
fn gain(covered: &[Vec<f64>], point: &[f64]) -> f64 {
    // the part of each box that lies inside the point's own
    let mut parts: Vec<Vec<f64>> = Vec::new();
    for other in covered {
        let part: Vec<f64> = other.iter().zip(point).map(|(a, b)| a.min(*b)).collect();
        if parts.iter().any(|known| is_inside(&part, known)) {
            continue;
        }
        parts.retain(|known| !is_inside(known, &part));
        parts.push(part);
    }
    point.iter().product::<f64>() - hypervolume(&parts, &vec![0.0; point.len()])
}

/// Whether a box lies in another.
fn is_inside(inner: &[f64], outer: &[f64]) -> bool {
    inner.iter().zip(outer).all(|(a, b)| a <= b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::methods::random::point;

    #[test]
    fn gains_are_differences_of_hypervolumes() {
        let covered: Vec<Vec<f64>> = (0..30).map(|i| point(3, 5, i)).collect();
        for i in 30..60 {
            let new = point(3, 5, i);
            let with: Vec<Vec<f64>> = covered.iter().cloned().chain([new.clone()]).collect();
            let expected = hypervolume(&with, &[0.0; 3]) - hypervolume(&covered, &[0.0; 3]);
            assert!((gain(&covered, &new) - expected).abs() < 1e-12);
        }
    }

    /// The choice is the same as that of computing every gain every time.
    #[test]
    fn the_choice_is_the_greedy_one() {
        let front: Vec<Vec<f64>> = (0..10).map(|i| point(3, 6, i)).collect();
        let candidates: Vec<Vec<f64>> = (10..60).map(|i| point(3, 6, i)).collect();
        let all = scaled(&front, &candidates);
        let (mut covered, shares) = (all[..front.len()].to_vec(), &all[front.len()..]);
        let mut expected = Vec::new();
        for _ in 0..8 {
            let gains: Vec<f64> = shares.iter().map(|c| gain(&covered, c)).collect();
            let best =
                (0..gains.len()).rev().max_by(|&i, &j| gains[i].total_cmp(&gains[j])).expect("candidates");
            covered.push(shares[best].clone());
            expected.push(best);
        }
        assert_eq!(most_gaining(&front, &candidates, 8), expected);
    }

    #[test]
    fn dominated_candidates_are_not_chosen() {
        let front = [vec![1.0, 1.0]];
        assert_eq!(most_gaining(&front, &[vec![0.5, 0.5], vec![2.0, 0.1], vec![1.0, 1.0]], 3), [1]);
        assert_eq!(most_gaining(&[], &[], 3), [] as [usize; 0]);
    }
}
