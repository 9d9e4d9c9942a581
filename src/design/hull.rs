//! How far a convex outline reaches in a direction, found by halving: outlines of thousands of corners are
//! asked in every direction between two of them.

use crate::geometry::measure::convex_hull;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The convex hull of some points.
pub(super) struct Hull {
    /// Counter-clockwise.
    corners: Vec<DVec2>,
    /// Direction of the edge after the first corner, an angle.
    first: f64,
    /// How far the edge after each corner has turned from that, growing from 0 to below 2π.
    turned: Vec<f64>,
}

impl Hull {
    pub fn new(points: &[DVec2]) -> Hull {
        let corners = convex_hull(points.to_vec());
        let edge = |i: usize| (corners[(i + 1) % corners.len()] - corners[i]).to_angle();
        let first = if corners.is_empty() { 0.0 } else { edge(0) };
        let turned = (0..corners.len()).map(|i| (edge(i) - first).rem_euclid(TAU)).collect();
        Hull { corners, first, turned }
    }

    /// The greatest `p · direction` of its points.
    fn support(&self, direction: DVec2) -> f64 {
        let n = self.corners.len();
        // the farthest corner is where edges turn past the right angle
        let past = (direction.to_angle() + FRAC_PI_2 - self.first).rem_euclid(TAU);
        let at = self.turned.partition_point(|t| *t < past);
        // by the rounding of angles it may be a neighbour
        let near = (at + n).saturating_sub(1)..at + n + 2;
        near.filter_map(|i| self.corners.get(i % n.max(1)))
            .map(|p| p.dot(direction))
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// The extent along a direction.
    pub fn extent(&self, direction: DVec2) -> f64 {
        self.support(direction) + self.support(-direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};

    #[test]
    fn the_reach_of_a_hull_is_that_of_its_points() {
        let mut stream = Stream::new(3, Purpose::TEST, 0);
        for n in [2, 3, 4, 5, 40, 600] {
            let mut draw = || DVec2::new(2.0 * stream.unit64() - 1.0, 2.0 * stream.unit64() - 1.0);
            let mut points: Vec<DVec2> = (0..n).map(|_| draw()).collect();
            if n == 4 {
                points = vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
            }
            let hull = Hull::new(&points);
            for k in 0..400 {
                let d = if k < 8 { DVec2::from_angle(TAU / 8.0 * f64::from(k)) } else { draw() };
                let (low, high) = points
                    .iter()
                    .fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.dot(d)), high.max(p.dot(d))));
                assert!((hull.extent(d) - (high - low)).abs() < 1e-14, "{n} points along {d}");
            }
        }
    }
}
