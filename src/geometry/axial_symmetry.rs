//! Symmetry of planes about a vertical axis, exact but for rounding: what holds for one part of a stone and
//! then for all of it.

use super::plane::Plane;
use glam::DVec2;
use std::f64::consts::TAU;

/// Two planes differ if their normals' heights, their distances from the axis point or their azimuths do by
/// more than this (radians, and units of the planes): far above the rounding of sines and cosines, and far
/// below what changes a score.
const ALIKE: f64 = 1e-7;

/// Rotations and mirrors that leave a set of planes as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialSymmetry {
    /// The planes repeat so many times around the axis.
    pub order: usize,
    /// Azimuth of a vertical mirror plane through the axis, in radians from +x towards +y; none without one.
    pub mirror: Option<f64>,
}

impl AxialSymmetry {
    /// No symmetry.
    pub const NONE: AxialSymmetry = AxialSymmetry { order: 1, mirror: None };

    /// The symmetry of planes about the vertical axis through the origin.
    ///
    /// Planes alike in height of the normal and in distance form a class; a rotation or a mirror of all
    /// planes takes every class to itself. Horizontal planes may be turned as one likes. Checked in this
    /// file's tests, and by scores in `tests/library/objective.rs`.
    pub fn of_planes(planes: &[Plane]) -> AxialSymmetry {
        let classes = classes(planes);
        let Some(least) = classes.iter().min_by_key(|class| class.len()) else { return Self::NONE };
        let turned = |n: &usize| classes.iter().all(|class| repeats(class, *n));
        let order = (1..=least.len()).rev().filter(|n| least.len().is_multiple_of(*n)).find(turned);
        // a mirror takes the first of a class to another of it
        let mirrors = least.iter().map(|other| 0.5 * (least[0] + other));
        let mirror = mirrors.into_iter().find(|at| classes.iter().all(|class| is_mirrored(class, *at)));
        AxialSymmetry { order: order.unwrap_or(1), mirror }
    }

    /// The images of a part of the stone that make up the whole of it: as many as there are rotations, or
    /// twice as many with a mirror.
    pub fn images(&self) -> usize {
        self.order * if self.mirror.is_some() { 2 } else { 1 }
    }

    /// Vertical planes through the origin that bound a part whose images make up the whole: none, one or two.
    pub fn walls(&self) -> Vec<Plane> {
        let images = self.images();
        if images == 1 {
            return Vec::new();
        }
        let (from, wide) = (self.mirror.unwrap_or_default(), TAU / images as f64);
        let wall = |azimuth: f64, side: f64| {
            let normal = DVec2::from_angle(azimuth).perp() * side;
            Plane { normal: normal.extend(0.0), distance: 0.0 }
        };
        let mut walls = vec![wall(from, -1.0)];
        if images > 2 {
            walls.push(wall(from + wide, 1.0));
        }
        walls
    }
}

/// Azimuths of planes alike but for these, class by class, each in growing order from 0 to 2π.
fn classes(planes: &[Plane]) -> Vec<Vec<f64>> {
    let inclined = planes.iter().filter(|p| p.normal.truncate().length() > ALIKE);
    let azimuth = |p: &Plane| p.normal.y.atan2(p.normal.x).rem_euclid(TAU);
    let mut found: Vec<(f64, f64, f64)> = inclined.map(|p| (p.normal.z, p.distance, azimuth(p))).collect();
    found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut classes = Vec::new();
    for of_height in found.chunk_by_mut(|a, b| b.0 - a.0 <= ALIKE) {
        of_height.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
        for class in of_height.chunk_by(|a, b| b.1 - a.1 <= ALIKE) {
            let mut azimuths: Vec<f64> = class.iter().map(|of| of.2).collect();
            azimuths.sort_unstable_by(f64::total_cmp);
            classes.push(azimuths);
        }
    }
    classes
}

/// Whether two azimuths are alike, full turns apart or not.
fn alike(a: f64, b: f64) -> bool {
    let apart = (a - b).rem_euclid(TAU);
    apart.min(TAU - apart) <= ALIKE
}

/// Whether a class stays the same when it is turned by a part of a full turn.
fn repeats(class: &[f64], order: usize) -> bool {
    let n = class.len();
    let (step, turn) = (n / order, TAU / order as f64);
    n.is_multiple_of(order) && (0..n).all(|i| alike(class[(i + step) % n], class[i] + turn))
}

/// Whether a class stays the same when it is mirrored at an azimuth.
fn is_mirrored(class: &[f64], at: f64) -> bool {
    let n = class.len();
    let image = |i: usize| 2.0 * at - class[i];
    // the images come in the opposite order, from the one that the first goes to
    let first = (0..n).find(|j| alike(class[*j], image(0)));
    first.is_some_and(|first| (0..n).all(|i| alike(class[(first + n - i) % n], image(i))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Planes at azimuths in degrees, all of one height and distance.
    fn ring(z: f64, distance: f64, azimuths: impl IntoIterator<Item = f64>) -> Vec<Plane> {
        let plane = |azimuth: f64| {
            let across = DVec2::from_angle(azimuth.to_radians());
            Plane { normal: (across * (1.0 - z * z).sqrt()).extend(z), distance }
        };
        azimuths.into_iter().map(plane).collect()
    }

    #[test]
    fn rotations_and_mirrors_are_found_as_the_planes_have_them() {
        let table = Plane { normal: DVec3::Z, distance: 0.4 };
        let around = |n: usize, from: f64| (0..n).map(move |i| from + 360.0 * i as f64 / n as f64);
        let mut planes = ring(0.5, 1.0, around(8, 3.0));
        planes.push(table);
        let eight = AxialSymmetry::of_planes(&planes);
        assert_eq!((eight.order, eight.mirror.is_some(), eight.images()), (8, true, 16));
        // half girdles beside every main, on both sides or on one
        planes.extend(ring(0.3, 1.1, around(8, 3.0 + 7.0).chain(around(8, 3.0 - 7.0))));
        assert_eq!(AxialSymmetry::of_planes(&planes).images(), 16);
        planes.extend(ring(0.2, 1.2, around(8, 3.0 + 5.0)));
        assert_eq!(AxialSymmetry::of_planes(&planes), AxialSymmetry { order: 8, mirror: None });
        planes.extend(ring(-0.7, 0.9, around(4, 3.0)));
        assert_eq!(AxialSymmetry::of_planes(&planes).order, 4);
        planes.extend(ring(-0.6, 0.9, [17.0]));
        assert_eq!(AxialSymmetry::of_planes(&planes), AxialSymmetry::NONE);
        // one plane a hundredth of a degree off
        let mut bent = ring(0.5, 1.0, around(6, 0.0));
        bent[2] = ring(0.5, 1.0, [120.01])[0];
        assert_eq!(AxialSymmetry::of_planes(&bent).order, 1);
        let oval = [ring(0.5, 1.0, [20.0, 160.0, 200.0, 340.0]), ring(0.5, 1.3, [0.0, 180.0])].concat();
        let oval = AxialSymmetry::of_planes(&oval);
        assert_eq!((oval.order, oval.images()), (2, 4));
        assert_eq!(AxialSymmetry::of_planes(&[table]), AxialSymmetry::NONE);
    }

    #[test]
    fn walls_hold_the_share_of_the_circle_that_the_images_make_whole() {
        let at = |degrees: f64| DVec2::from_angle(degrees.to_radians()).extend(0.3);
        for (order, mirror) in
            [(1, None), (1, Some(0.3)), (2, None), (2, Some(1.0)), (3, None), (8, Some(0.2))]
        {
            let symmetry = AxialSymmetry { order, mirror };
            let walls = symmetry.walls();
            let inside = (0..3600).filter(|i| {
                let p = at(f64::from(*i) * 0.1 + 0.05);
                walls.iter().all(|wall| wall.signed_distance(p) <= 0.0)
            });
            let inside = inside.count() * symmetry.images();
            assert!(inside.abs_diff(3600) <= symmetry.images(), "{symmetry:?}: {inside}");
        }
    }
}
