//! A score over two parameters as values on a regular grid.

use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};
use std::collections::BTreeSet;

/// Values on a regular grid.
#[derive(Debug, Clone)]
pub struct ScoreSurface {
    /// First and last number across.
    pub x: (f64, f64),
    /// First and last number up.
    pub y: (f64, f64),
    /// Columns and rows.
    pub size: (usize, usize),
    /// Row by row from the first y; none where nothing is known.
    pub values: Vec<Option<f64>>,
}

/// Columns and rows of a grid on which scattered points are interpolated.
const FINE: usize = 81;

/// A point that a triangulation carries.
struct ScatteredSample {
    at: Point2<f64>,
    value: f64,
}

impl HasPosition for ScatteredSample {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.at
    }
}

impl ScoreSurface {
    /// The surface of points that form a grid; none if they have fewer than two columns or rows.
    pub fn from_grid(points: &[(f64, f64, Option<f64>)]) -> Option<ScoreSurface> {
        let bits = |x: f64| (x * 1e9).round() as i64;
        let axis = |of: fn(&(f64, f64, Option<f64>)) -> f64| {
            let set: BTreeSet<i64> = points.iter().map(|p| bits(of(p))).collect();
            set.into_iter().collect::<Vec<i64>>()
        };
        let (xs, ys) = (axis(|p| p.0), axis(|p| p.1));
        let ends = |of: &[i64]| Some((*of.first()? as f64 * 1e-9, *of.last()? as f64 * 1e-9));
        let mut values = vec![None; xs.len() * ys.len()];
        for (x, y, value) in points {
            let column = xs.binary_search(&bits(*x)).ok()?;
            let row = ys.binary_search(&bits(*y)).ok()?;
            values[row * xs.len() + column] = *value;
        }
        let size = (xs.len(), ys.len());
        (size.0 > 1 && size.1 > 1).then_some(ScoreSurface { x: ends(&xs)?, y: ends(&ys)?, size, values })
    }

    /// The surface through scattered points, by natural neighbours (R. Sibson, 1981); nothing is
    /// known outside their hull. None without three points that span it.
    pub fn from_scattered(points: &[(f64, f64, Option<f64>)]) -> Option<ScoreSurface> {
        let reach = |of: fn(&(f64, f64, Option<f64>)) -> f64| {
            let values = points.iter().map(of);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
        };
        let (x, y) = (reach(|p| p.0), reach(|p| p.1));
        // neighbourhood is judged in the plot's square, whatever the units
        let unit = |v: f64, (lo, hi): (f64, f64)| if hi > lo { (v - lo) / (hi - lo) } else { 0.0 };
        let mut net = DelaunayTriangulation::<ScatteredSample>::new();
        for (px, py, value) in points {
            if let Some(value) = *value {
                net.insert(ScatteredSample { at: Point2::new(unit(*px, x), unit(*py, y)), value }).ok()?;
            }
        }
        if net.num_inner_faces() == 0 {
            return None;
        }
        let neighbours = net.natural_neighbor();
        let along = |i: usize| i as f64 / (FINE - 1) as f64;
        let values = (0..FINE * FINE)
            .map(|i| {
                let at = Point2::new(along(i % FINE), along(i / FINE));
                neighbours.interpolate(|vertex| vertex.data().value, at)
            })
            .collect();
        Some(ScoreSurface { x, y, size: (FINE, FINE), values })
    }

    /// Distance between columns and between rows.
    pub fn steps(&self) -> (f64, f64) {
        let step = |(from, to): (f64, f64), n: usize| (to - from) / (n - 1) as f64;
        (step(self.x, self.size.0), step(self.y, self.size.1))
    }

    /// Least and greatest value.
    pub fn value_range(&self) -> Option<(f64, f64)> {
        let known = || self.values.iter().flatten().copied();
        Some((known().reduce(f64::min)?, known().reduce(f64::max)?))
    }

    /// All values, the unknown ones taken from the nearest known in their row, else `fallback`: what
    /// is drawn there is covered ([`ScoreSurface::holes`]).
    pub fn filled(&self, fallback: f64) -> Vec<f64> {
        let columns = self.size.0;
        (0..self.values.len())
            .map(|i| {
                let (row, column) = (i / columns, i % columns);
                let at = |c: usize| self.values[row * columns + c];
                let near = (0..columns)
                    .filter_map(|c| at(c).map(|v| (c.abs_diff(column), v)))
                    .min_by_key(|(distance, _)| *distance);
                near.map_or(fallback, |(_, v)| v)
            })
            .collect()
    }

    /// Column and row of the lower left corner of every cell with an unknown corner.
    pub fn holes(&self) -> Vec<(usize, usize)> {
        let (columns, rows) = self.size;
        let unknown = |c: usize, r: usize| self.values[r * columns + c].is_none();
        (0..(columns - 1) * (rows - 1))
            .map(|i| (i % (columns - 1), i / (columns - 1)))
            .filter(|&(c, r)| {
                unknown(c, r) || unknown(c + 1, r) || unknown(c, r + 1) || unknown(c + 1, r + 1)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Natural neighbours give back a plane exactly, inside the hull.
    #[test]
    fn scattered_points_of_a_plane_give_the_plane() {
        let plane = |x: f64, y: f64| 2.0 + 0.3 * x - 5.0 * y;
        let points: Vec<_> = (0..60)
            .map(|i| (f64::from(i * 37 % 60) / 6.0, f64::from(i) / 600.0))
            .map(|(x, y)| (x, y, Some(plane(x, y))))
            .collect();
        let surface = ScoreSurface::from_scattered(&points).expect("spans a plane");
        let (dx, dy) = surface.steps();
        let mut known = 0;
        for (i, value) in surface.values.iter().enumerate() {
            let x = surface.x.0 + dx * (i % FINE) as f64;
            let y = surface.y.0 + dy * (i / FINE) as f64;
            if let Some(value) = value {
                known += 1;
                assert!((value - plane(x, y)).abs() < 1e-9, "{value} at {x} {y}");
            }
        }
        assert!(known > FINE * FINE / 2, "{known}");
    }

    #[test]
    fn a_grid_keeps_its_values_and_its_holes() {
        let points: Vec<_> = (0..12)
            .map(|i| (f64::from(i / 4), 0.1 * f64::from(i % 4), (i != 5).then_some(f64::from(i))))
            .collect();
        let surface = ScoreSurface::from_grid(&points).expect("a grid");
        assert_eq!((surface.size, surface.value_range()), ((3, 4), Some((0.0, 11.0))));
        assert_eq!((surface.values[1], surface.values[3 + 1]), (Some(4.0), None));
        assert_eq!(surface.holes(), [(0, 0), (1, 0), (0, 1), (1, 1)]);
        assert!(ScoreSurface::from_grid(&points[..4]).is_none());
    }
}
