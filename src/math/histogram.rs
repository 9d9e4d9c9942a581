//! Weights by value, in classes of equal width.

use super::stats::Sum;

/// How much weight lies in each class of a quantity that is not negative.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Histogram {
    weights: Vec<f64>,
}

impl Histogram {
    /// Adds a weight to the class of `value`, counted in classes.
    pub fn put(&mut self, value: f64, weight: f64) {
        let class = value.max(0.0) as usize;
        if class >= self.weights.len() {
            self.weights.resize(class + 1, 0.0);
        }
        self.weights[class] += weight;
    }

    /// The median of grouped data, in classes: where half the weight lies below, each class's taken
    /// as spread evenly over it. 0 without any weight.
    pub fn median(&self) -> f64 {
        let half = 0.5 * self.weights.iter().sum::<f64>();
        let mut below = 0.0;
        for (class, weight) in self.weights.iter().enumerate() {
            if below + weight >= half && *weight > 0.0 {
                return class as f64 + (half - below) / weight;
            }
            below += weight;
        }
        0.0
    }
}

impl Sum for Histogram {
    fn add(&mut self, other: &Histogram) {
        if self.weights.len() < other.weights.len() {
            self.weights.resize(other.weights.len(), 0.0);
        }
        self.weights.iter_mut().zip(&other.weights).for_each(|(a, b)| *a += b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_halves_the_weight() {
        assert_eq!(Histogram::default().median(), 0.0);
        let mut h = Histogram::default();
        h.put(2.5, 1.0);
        assert_eq!(h.median(), 2.5);
        h.put(7.1, 3.0);
        // one below, one of the three of class 7
        assert!((h.median() - (7.0 + 1.0 / 3.0)).abs() < 1e-12);
        let mut both = Histogram::default();
        Sum::add(&mut both, &h);
        assert_eq!(both, h);
    }
}
