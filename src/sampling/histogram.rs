//! Weighted histogram with classes of equal width.

use super::stats::Accumulate;

/// A value below this share of a class's width is 0 to rounding.
const NOTHING: f64 = 0.02;

/// How much weight lies in each class of a quantity that is not negative. Values of 0 are kept apart,
/// so that they do not count as spread over the first class.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Histogram {
    zero: f64,
    weights: Vec<f64>,
}

impl Histogram {
    /// Adds a weight to the class of `value`, counted in classes.
    pub fn insert(&mut self, value: f64, weight: f64) {
        if value < NOTHING {
            self.zero += weight;
            return;
        }
        let class = value as usize;
        if class >= self.weights.len() {
            self.weights.resize(class + 1, 0.0);
        }
        self.weights[class] += weight;
    }

    /// The weight at or below each class's lower edge, and at or below the last class's upper one.
    pub fn cumulative(&self) -> CumulativeHistogram {
        let mut sum = self.zero;
        let rest = self.weights.iter().map(|weight| {
            sum += weight;
            sum
        });
        CumulativeHistogram(std::iter::once(self.zero).chain(rest).collect())
    }
}

impl Accumulate for Histogram {
    fn accumulate(&mut self, other: &Histogram) {
        self.zero += other.zero;
        if self.weights.len() < other.weights.len() {
            self.weights.resize(other.weights.len(), 0.0);
        }
        self.weights.iter_mut().zip(&other.weights).for_each(|(a, b)| *a += b);
    }
}

/// A [`Histogram`]'s weight up to each edge of its classes; never empty.
#[derive(Debug, Clone)]
pub struct CumulativeHistogram(Vec<f64>);

impl CumulativeHistogram {
    /// All weight.
    pub fn total(&self) -> f64 {
        self.0.last().copied().unwrap_or(0.0)
    }

    /// Number of classes up to the last that has any weight.
    pub fn classes(&self) -> usize {
        self.0.len() - 1
    }

    /// The weight at or below `value`, counted in classes; each class's as spread evenly over it.
    pub fn below(&self, value: f64) -> f64 {
        let class = value as usize;
        match (self.0.get(class), self.0.get(class + 1)) {
            (Some(from), Some(to)) => from + (to - from) * (value - class as f64),
            _ => self.total(),
        }
    }

    /// The median of grouped data, in classes: where half the weight lies below, each class's taken
    /// as spread evenly over it. None without any weight.
    pub fn median(&self) -> Option<f64> {
        let half = 0.5 * self.total();
        if half <= 0.0 {
            return None;
        }
        let edge = self.0.partition_point(|below| *below < half);
        let Some(class) = edge.checked_sub(1) else { return Some(0.0) };
        let (from, to) = (self.0[class], self.0.get(edge).copied().unwrap_or(half));
        Some(class as f64 + (half - from) / (to - from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_halves_the_weight() {
        let median = |h: &Histogram| h.cumulative().median();
        assert_eq!(median(&Histogram::default()), None);
        let mut h = Histogram::default();
        h.insert(2.5, 1.0);
        assert_eq!(median(&h), Some(2.5));
        h.insert(7.1, 3.0);
        // one below, one of the three of class 7
        let at = median(&h).expect("has weight");
        assert!((at - (7.0 + 1.0 / 3.0)).abs() < 1e-12);
        assert!((h.cumulative().below(at) - 2.0).abs() < 1e-12);
        let mut both = Histogram::default();
        Accumulate::accumulate(&mut both, &h);
        assert_eq!(both, h);
    }

    #[test]
    fn what_is_nothing_is_not_half_a_class() {
        let mut h = Histogram::default();
        h.insert(0.0, 2.0);
        h.insert(1e-4, 2.0);
        h.insert(5.5, 1.0);
        assert_eq!(h.cumulative().median(), Some(0.0));
        // half of it above 0: four of 18 lie at 0, five of fourteen below the median
        h.insert(5.2, 13.0);
        let at = h.cumulative().median().expect("has weight");
        assert!((at - (5.0 + 5.0 / 14.0)).abs() < 1e-12, "{at}");
    }
}
