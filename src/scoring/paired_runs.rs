//! Paired runs: one quantity of several stones by the same random numbers, so that differences have less noise
//! than the values.

use crate::sampling::stats::{self, Estimate};

/// The values of a quantity of one stone in runs with random numbers of their own; the same for every stone.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PairedRuns {
    /// One a run; a single one of a quantity without noise.
    values: Vec<f64>,
    /// By how much each may be off besides, in the same sense or not.
    bound: f64,
}

impl PairedRuns {
    /// Values of runs, and by how much each may be off.
    pub fn new(values: Vec<f64>, bound: f64) -> PairedRuns {
        PairedRuns { values, bound }
    }

    /// Σ weight × quantity over stones, with the error that is left of their noise.
    pub fn combined<'a>(parts: impl IntoIterator<Item = (f64, &'a PairedRuns)> + Clone) -> PairedRuns {
        let runs = parts.clone().into_iter().map(|(_, part)| part.values.len()).max().unwrap_or(0);
        let value = |run: usize| parts.clone().into_iter().map(|(weight, part)| weight * part.at(run)).sum();
        let bound = parts.clone().into_iter().map(|(weight, part)| weight.abs() * part.bound).sum();
        PairedRuns { values: (0..runs).map(value).collect(), bound }
    }

    /// Whether there is no noise.
    pub fn is_closed(&self) -> bool {
        self.values.len() == 1
    }

    /// The value in a run.
    fn at(&self, run: usize) -> f64 {
        self.values.get(run).or(self.values.first()).copied().unwrap_or(f64::NAN)
    }

    /// The mean over the runs.
    pub fn value(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// The mean over the runs with its error: the spread of the runs and what each may be off.
    pub fn estimate(&self) -> Estimate {
        let is_one = self.values.windows(2).all(|pair| pair[0] == pair[1]);
        match is_one {
            true => Estimate { value: self.at(0), error: self.bound },
            false => {
                let spread = stats::ratio(self.values.iter().map(|value| (*value, 1.0)));
                Estimate { error: spread.error.hypot(self.bound), ..spread }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};

    /// Two quantities with noise in common and a little of their own: their difference lies within 1.96 of
    /// its errors in 95 of 100 cases, and its error is that of what is not in common.
    #[test]
    fn the_error_of_a_difference_covers_the_truth_as_often_as_it_says() {
        let (cases, runs) = (2000, 32);
        let (mut held, mut errors, mut singly) = (0, 0.0, 0.0);
        for case in 0..cases {
            let mut stream = Stream::new(5, Purpose::TEST, case);
            let mut noise = |size: f64| (stream.unit64() - 0.5) * 12f64.sqrt() * size;
            let both: Vec<(f64, f64)> = (0..runs)
                .map(|_| {
                    let common = noise(1.0);
                    (2.0 + common + noise(0.1), 1.7 + common + noise(0.1))
                })
                .collect();
            let [a, b] = [0, 1].map(|i| {
                PairedRuns::new(both.iter().map(|pair| if i == 0 { pair.0 } else { pair.1 }).collect(), 0.0)
            });
            let difference = PairedRuns::combined([(1.0, &a), (-1.0, &b)]).estimate();
            held += i32::from((difference.value - 0.3).abs() <= 1.96 * difference.error);
            errors += difference.error / cases as f64;
            singly += a.estimate().error / cases as f64;
        }
        let share = f64::from(held) / cases as f64;
        assert!((0.935..0.965).contains(&share), "{share}");
        assert!((errors / (0.1 * 2f64.sqrt() / (runs as f64).sqrt()) - 1.0).abs() < 0.1, "{errors}");
        assert!(singly > 5.0 * errors, "{singly} {errors}");
    }

    #[test]
    fn bounds_add_up_whatever_the_signs_and_closed_values_meet_runs() {
        let (closed, noisy) = (PairedRuns::new(vec![2.0], 0.1), PairedRuns::new(vec![1.0, 3.0], 0.0));
        let difference = PairedRuns::combined([(1.0, &noisy), (-0.5, &closed)]);
        assert_eq!((difference.value(), difference.bound), (1.0, 0.05));
        assert_eq!(closed.estimate(), Estimate { value: 2.0, error: 0.1 });
        assert!(difference.estimate().error > 1.0);
    }
}
