//! Discrete distribution: draws an entry of a list in proportion to its weight.

/// The running sums of a list of weights.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscreteCdf {
    /// Sum of the weights up to and including each; the last is the total.
    cumulative: Vec<f64>,
}

impl DiscreteCdf {
    /// Entries of these weights, none of which is negative.
    pub fn new(weights: impl IntoIterator<Item = f64>) -> DiscreteCdf {
        let mut sum = 0.0;
        let add = |weight: f64| {
            sum += weight;
            sum
        };
        DiscreteCdf { cumulative: weights.into_iter().map(add).collect() }
    }

    /// Entries of given running sums, which do not fall.
    pub fn from_cumulative(cumulative: Vec<f64>) -> DiscreteCdf {
        DiscreteCdf { cumulative }
    }

    /// The same distribution with weights that add up to 1.
    pub fn normalised(mut self) -> DiscreteCdf {
        let total = self.total();
        self.cumulative.iter_mut().for_each(|sum| *sum /= total);
        self
    }

    /// Sum of the weights; 0 of an empty list.
    pub fn total(&self) -> f64 {
        self.cumulative.last().copied().unwrap_or(0.0)
    }

    /// The weight of entry `i`, as the difference of two sums; 0 if there is none.
    pub fn weight(&self, i: usize) -> f64 {
        self.cumulative.get(i).map_or(0.0, |sum| sum - self.before(i))
    }

    /// Draws an entry, and hands back what is left of the uniform number, again uniform in 0..=1. Of an
    /// empty list it is number 0.
    ///
    /// - `u`: uniform in 0..1
    pub fn sample(&self, u: f64) -> (usize, f64) {
        let x = u * self.total();
        let last = self.cumulative.len().saturating_sub(1);
        let i = self.cumulative.partition_point(|sum| *sum <= x).min(last);
        // at u = 1 the last entry may have no weight
        let rest = (x - self.before(i)) / self.weight(i).max(f64::MIN_POSITIVE);
        (i, rest.clamp(0.0, 1.0))
    }

    fn before(&self, i: usize) -> f64 {
        if i == 0 { 0.0 } else { self.cumulative[i - 1] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_drawn_in_proportion_and_the_rest_is_uniform() {
        let weights = [0.5, 0.0, 2.0, 1.5, 0.0];
        for cdf in [DiscreteCdf::new(weights), DiscreteCdf::new(weights).normalised()] {
            let n = 8000;
            let (mut counts, mut rests) = ([0; 5], [0.0; 5]);
            for k in 0..n {
                let (i, rest) = cdf.sample((f64::from(k) + 0.5) / f64::from(n));
                counts[i] += 1;
                rests[i] += rest;
            }
            assert_eq!(counts, [1000, 0, 4000, 3000, 0]);
            for i in [0, 2, 3] {
                assert!((rests[i] / f64::from(counts[i]) - 0.5).abs() < 1e-9, "{rests:?}");
                assert!((cdf.weight(i) / cdf.total() - weights[i] / 4.0).abs() < 1e-15);
            }
            assert_eq!(cdf.sample(0.0), (0, 0.0));
            assert_eq!(cdf.sample(1.0).0, 4, "the last entry, though it has no weight");
            assert!(cdf.sample(1.0).1.is_finite());
        }
        let nothing = DiscreteCdf::new([]);
        assert_eq!((nothing.total(), nothing.sample(0.5)), (0.0, (0, 0.0)));
    }
}
