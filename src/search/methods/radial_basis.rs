//! Radial basis functions: smooth functions through values at scattered points.

use nalgebra::DMatrix;

/// Cubic radial basis functions with a linear polynomial: Σ wᵢ |x − xᵢ|³ + b·x + a, through the values at all
/// points, for several functions at once.
///
/// They need no length scale, and a prediction costs one pass over the points, whatever the number of
/// functions (M. J. D. Powell, in: Advances in Numerical Analysis II (1992) 105; as models of costly functions
/// R. Regis and C. Shoemaker, INFORMS J. Comput. 19 (2007) 497).
pub struct RadialBasis {
    points: Vec<Vec<f64>>,
    functions: usize,
    /// A row for each point, then for each variable, then the constant; a column for each function.
    weights: DMatrix<f64>,
}

impl RadialBasis {
    /// The functions with these values; none, if the points do not determine them: fewer than variables plus
    /// one, all in one plane, or two the same.
    ///
    /// - `points`: of the unit cube
    /// - `values`: at each point one of each function
    pub fn fit(points: Vec<Vec<f64>>, values: &[Vec<f64>]) -> Option<RadialBasis> {
        let (count, variables) = (points.len(), points.first()?.len());
        let functions = values.first()?.len();
        let rows = count + variables + 1;
        let linear = |point: usize, column: usize| points[point].get(column).copied().unwrap_or(1.0);
        let matrix = DMatrix::from_fn(rows, rows, |i, j| match (i < count, j < count) {
            (true, true) => cubed_distance(&points[i], &points[j]),
            (true, false) => linear(i, j - count),
            (false, true) => linear(j, i - count),
            (false, false) => 0.0,
        });
        let right = DMatrix::from_fn(rows, functions, |i, j| if i < count { values[i][j] } else { 0.0 });
        let weights = matrix.lu().solve(&right)?;
        weights.iter().all(|w| w.is_finite()).then_some(RadialBasis { points, functions, weights })
    }

    /// The value of each function at a point.
    pub fn at(&self, x: &[f64]) -> Vec<f64> {
        let count = self.points.len();
        let mut values: Vec<f64> = (0..self.functions).map(|j| self.weights[(count + x.len(), j)]).collect();
        let distances: Vec<f64> = self.points.iter().map(|point| cubed_distance(point, x)).collect();
        for (j, value) in values.iter_mut().enumerate() {
            let column = self.weights.column(j);
            *value += distances.iter().chain(x).zip(column.iter()).map(|(d, w)| d * w).sum::<f64>();
        }
        values
    }
}

/// The third power of the distance of two points.
fn cubed_distance(a: &[f64], b: &[f64]) -> f64 {
    let squared: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    squared * squared.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::methods::random::point;

    #[test]
    fn values_are_met_and_planes_are_exact() {
        let points: Vec<Vec<f64>> = (0..40).map(|i| point(3, 7, i)).collect();
        let plane = |x: &[f64]| 2.0 - x[0] + 3.0 * x[1] + 0.5 * x[2];
        let wave = |x: &[f64]| (4.0 * x[0]).sin() * x[1];
        let values: Vec<Vec<f64>> = points.iter().map(|x| vec![plane(x), wave(x)]).collect();
        let model = RadialBasis::fit(points.clone(), &values).expect("40 points in general position");
        for (x, value) in points.iter().zip(&values) {
            let found = model.at(x);
            assert!((found[0] - value[0]).abs() < 1e-9 && (found[1] - value[1]).abs() < 1e-9);
        }
        // [D] a plane is its own interpolant; the wave's second derivative is at most 16, and 40 points of the
        // cube have another within about 0.3 of any place in it, but at its corners
        for i in 1000..1100 {
            let x: Vec<f64> = point(3, 7, i).iter().map(|u| 0.2 + 0.6 * u).collect();
            let found = model.at(&x);
            assert!((found[0] - plane(&x)).abs() < 1e-8 && (found[1] - wave(&x)).abs() < 0.5, "{found:?}");
        }
    }

    #[test]
    fn points_that_determine_nothing_give_no_model() {
        let flat = vec![vec![0.1, 0.5], vec![0.4, 0.5], vec![0.9, 0.5]];
        assert!(RadialBasis::fit(flat, &[vec![1.0], vec![2.0], vec![3.0]]).is_none());
        assert!(RadialBasis::fit(vec![vec![0.1, 0.5]], &[vec![1.0]]).is_none());
        assert!(RadialBasis::fit(Vec::new(), &[]).is_none());
    }
}
