//! At what scale planes bound a solid: found first, however far away other planes lie, then carved by
//! the solid's own measure.

use super::half_space_clipper::HalfSpaceClipper;
use super::plane::Plane;
use super::polyhedron::{Face, PlaneStatus, Polyhedron, SolidError};
use glam::DVec3;

/// A corner nearer to a plane than this, times the size of the solid, lies on it. Tried in turn until
/// every cut leaves one closed outline: far above the rounding of `f64` and far below what a faceter
/// can cut. Facets nearer to each other than this are one, so it bounds how far the volume may be off.
const ON_PLANE: [f64; 5] = [1e-11, 1e-12, 1e-13, 1e-14, 3e-11];

/// The same while place and size of the solid are looked for, times the distance of the planes from
/// the origin. Planes that were recovered from nine decimals or from `f32` miss their common corners by
/// more than the first ones.
const ON_PLANE_AT_FIRST: [f64; 8] = [1e-11, 1e-12, 1e-13, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6];

/// No corner misses its planes by more than this, times the radius of the solid, or stands out of
/// others. Surfaces have at most 4π radius², so the volume is true to 5e-10 of the radius cubed.
const CLOSE_SOLUTION: f64 = 4e-11;

/// A stone that reaches further than so many times the distance of the planes is called open.
const REACH: f64 = 1e4;

/// Planes of one scale are so many times as far from the origin as each other at most.
const SCALE: f64 = 16.0;

/// So many times its own radius a solid may lie from the origin.
const MAX_DISTANCE_IN_WIDTHS: f64 = 1e5;

/// The cube of a size beyond this, or below its inverse, nears the ends of the range of `f64`.
const LARGEST: f64 = 1e90;

/// A solid of less volume than this, times the cube of its radius, is refused: a needle a thousand
/// times as long as it is wide has more.
const SLIVER: f64 = 1e-7;

/// The solid that the planes bound.
pub(super) fn bounded(planes: &[Plane]) -> Result<Polyhedron, SolidError> {
    let sizes = sizes(planes);
    // more planes leave less, and the more of them the further what is open must reach
    let (mut low, mut high) = (0, sizes.len() - 1);
    while low < high {
        let middle = (low + high) / 2;
        match solve(planes, sizes[middle]) {
            Err(SolidError::Open { .. }) => low = middle + 1,
            _ => high = middle,
        }
    }
    let size = sizes[low];
    let solid = solve(planes, size)?;
    let (centre, radius) = solid.bounding_sphere();
    let distance = centre.length();
    if !(LARGEST.recip()..LARGEST).contains(&size) {
        return Err(SolidError::Size { size });
    }
    if distance > MAX_DISTANCE_IN_WIDTHS * radius {
        return Err(SolidError::TooFarFromOrigin { radius, distance });
    }
    let is_done = low + 1 == sizes.len() && missed(&solid, planes, CLOSE_SOLUTION * radius).is_none();
    let solid = if is_done { solid } else { near(planes, centre, radius)? };
    let (volume, cube) = (solid.volume(), solid.bounding_sphere().1.powi(3));
    if volume > SLIVER * cube { Ok(solid) } else { Err(SolidError::Sliver { volume, cube }) }
}

/// The distances up to which planes are of one scale, in growing order; the last is the largest.
fn sizes(planes: &[Plane]) -> Vec<f64> {
    let mut distances: Vec<f64> = planes.iter().map(|p| p.distance.abs()).filter(|d| *d > 0.0).collect();
    distances.sort_unstable_by(f64::total_cmp);
    let mut sizes = Vec::new();
    let mut rest = &distances[..];
    while let Some(least) = rest.first() {
        let (scale, larger) = rest.split_at(rest.partition_point(|d| *d <= SCALE * least));
        sizes.extend(scale.last());
        rest = larger;
    }
    // planes that all pass through the origin have no size
    if sizes.is_empty() { vec![1.0] } else { sizes }
}

/// Roughly the solid of the planes that are not further than `size` from the origin.
fn solve(planes: &[Plane], size: f64) -> Result<Polyhedron, SolidError> {
    let near: Vec<usize> = (0..planes.len()).filter(|i| planes[*i].distance.abs() <= size).collect();
    if !(LARGEST.recip()..LARGEST).contains(&size) {
        // whether it is open at all does not depend on the unit
        let planes: Vec<Plane> = planes.iter().map(|p| Plane { distance: p.distance / size, ..*p }).collect();
        return resolved(&ON_PLANE_AT_FIRST, |on_plane| carved(&planes, &near, REACH, on_plane));
    }
    let carved = |on_plane| carved(planes, &near, size * REACH, size * on_plane);
    resolved(&ON_PLANE_AT_FIRST, carved)
}

/// The solid in the ball about `centre` by its own measure: seen from there, without the planes that
/// lie far beyond it.
fn near(planes: &[Plane], centre: DVec3, radius: f64) -> Result<Polyhedron, SolidError> {
    let reach = 2.0 * radius;
    let moved: Vec<Plane> = planes.iter().map(|p| p.moved(-centre)).collect();
    if let Some(plane) = moved.iter().position(|p| p.distance < -reach) {
        return Err(SolidError::Empty { plane });
    }
    let near: Vec<usize> = (0..moved.len()).filter(|i| moved[*i].distance <= reach).collect();
    let mut solid = resolved(&ON_PLANE, |on_plane| {
        let solid = carved(&moved, &near, reach, radius * on_plane)?;
        match missed(&solid, &moved, CLOSE_SOLUTION * radius) {
            Some(plane) => Err(SolidError::Degenerate { plane }),
            None => Ok(solid),
        }
    })?;
    solid.vertices.iter_mut().for_each(|v| *v += centre);
    Ok(solid)
}

/// Carved with the first tolerance that leaves every outline closed.
fn resolved(
    tolerances: &[f64],
    carved: impl Fn(f64) -> Result<Polyhedron, SolidError>,
) -> Result<Polyhedron, SolidError> {
    let mut outcome = Err(SolidError::Degenerate { plane: 0 });
    for on_plane in tolerances {
        outcome = carved(*on_plane);
        if !matches!(outcome, Err(SolidError::Degenerate { .. })) {
            break;
        }
    }
    outcome
}

/// Carved by some of the planes, whose numbers are given.
fn carved(planes: &[Plane], some: &[usize], reach: f64, on_plane: f64) -> Result<Polyhedron, SolidError> {
    let mut cut = HalfSpaceClipper::new_box(2.0 * reach, on_plane);
    let mut statuses = vec![PlaneStatus::Redundant; planes.len()];
    for &i in some {
        statuses[i] = cut.clip(i, planes)?;
    }
    cut.check_bounded(reach)?;
    let solid = cut.finish(planes, statuses);
    // what is left of a solid thinner than the tolerance
    if solid.euler() == 2 { Ok(solid) } else { Err(SolidError::Degenerate { plane: 0 }) }
}

/// A plane that a corner stands out of, or misses though it lies in it, by more than `most`.
fn missed(solid: &Polyhedron, planes: &[Plane], most: f64) -> Option<usize> {
    let stands_out = |p: &Plane| solid.vertices.iter().any(|v| p.signed_distance(*v) > most);
    let misses = |p: &Plane, c: &usize| p.signed_distance(solid.vertices[*c]) < -most;
    let missing = |f: &&Face| f.corners.iter().any(|c| misses(&planes[f.plane], c));
    let out = planes.iter().position(stands_out);
    out.or_else(|| solid.faces.iter().find(missing).map(|f| f.plane))
}

impl Polyhedron {
    /// The solid `{x : n·x ≤ d for every plane}`.
    ///
    /// - `planes`: in any order, any origin (it need not lie inside), any unit
    ///
    /// Coincident planes merge, planes that bound nothing are dropped; [`Polyhedron::plane_status`] tells.
    /// Every corner lies on its planes and under all others to some 1e-11 of the solid's radius, so the
    /// volume is the planes' own to 1e-9 of the radius cubed. Checked in `tests/library/geometry.rs` and
    /// `tests/program/hostile/degenerate.rs` (V − E + F = 2, volumes, shuffled, turned and scaled planes).
    pub fn from_planes(planes: &[Plane]) -> Result<Self, SolidError> {
        for (plane, p) in planes.iter().enumerate() {
            if !p.normal.is_finite() || !p.distance.is_finite() || (p.normal.length() - 1.0).abs() > 1e-6 {
                return Err(SolidError::NotAPlane { plane, normal: p.normal, distance: p.distance });
            }
        }
        bounded(planes)
    }
}
