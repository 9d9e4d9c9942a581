//! The girdle's flats, set apart: few rays end there, and those have no height to care for.

use super::packet::{LANES, Lanes, NO_FACET};
use crate::solid::Plane;
use glam::Vec3;

/// Fewer flats cost less than finding out which rays need them.
const FLATS_WORTH_SKIPPING: usize = 8;

/// Flats of a design are vertical to rounding; the cylinder inside them needs no more slack.
const VERTICAL: f64 = 1e-9;

/// A hair that the cylinder keeps from the nearest flat, for the rounding of a ray's end.
const HAIR: f64 = 1e-5;

/// The vertical facets of a stone.
#[derive(Debug, Clone)]
pub(super) struct Belt {
    /// Square of the radius about the frame's axis within which no flat is met.
    pub radius2: f32,
    pub flats: Vec<Planes>,
}

/// Sixteen planes side by side, or fewer and some that nothing meets.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(super) struct Planes {
    pub nx: Lanes,
    pub ny: Lanes,
    pub nz: Lanes,
    pub d: Lanes,
    pub facet: [u32; LANES],
}

impl Belt {
    /// The belt of the planes, if it is worth a look of its own.
    pub fn of(planes: &[Plane]) -> Option<Belt> {
        let flats: Vec<usize> = (0..planes.len()).filter(|f| Self::holds(&planes[*f])).collect();
        let radius = flats.iter().map(|f| planes[*f].distance).fold(f64::INFINITY, f64::min) - HAIR;
        (flats.len() >= FLATS_WORTH_SKIPPING && radius > 0.0)
            .then(|| Belt { radius2: (radius * radius) as f32, flats: Planes::all(planes, &flats) })
    }

    /// Whether a plane is a flat.
    pub fn holds(plane: &Plane) -> bool {
        plane.normal.z.abs() < VERTICAL
    }

    /// Whether a point is well inside all flats.
    pub fn surrounds(&self, point: Vec3) -> bool {
        point.truncate().length_squared() < self.radius2
    }
}

impl Planes {
    /// The planes of these numbers.
    pub fn all(planes: &[Plane], numbers: &[usize]) -> Vec<Planes> {
        numbers.chunks(LANES).map(|numbers| Self::of(planes, numbers)).collect()
    }

    fn of(planes: &[Plane], numbers: &[usize]) -> Planes {
        let zero = [0.0; LANES];
        let mut side = Planes { nx: zero, ny: zero, nz: zero, d: [1.0; LANES], facet: [NO_FACET; LANES] };
        for (l, &f) in numbers.iter().enumerate() {
            [side.nx[l], side.ny[l], side.nz[l]] = planes[f].normal.as_vec3().into();
            side.d[l] = planes[f].distance as f32;
            side.facet[l] = f as u32;
        }
        side
    }
}
