//! The girdle's flats, set apart: few rays end there, and those have no height to care for.

use super::packet::{LANES, Lanes, NO_FACET};
use crate::solid::Plane;
use glam::{DVec2, Vec3};

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
    /// By azimuth, all around.
    pub flats: Vec<Planes>,
    /// For each sector of azimuth, which of the sixteens faces it.
    facing: [u16; SECTORS],
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
    /// The last one that something can meet.
    pub last: u32,
}

impl Belt {
    /// The belt of the planes, if it is worth a look of its own.
    pub fn of(planes: &[Plane]) -> Option<Belt> {
        let mut flats: Vec<usize> = (0..planes.len()).filter(|f| Self::holds(&planes[*f])).collect();
        let azimuth = |f: &usize| planes[*f].normal.y.atan2(planes[*f].normal.x);
        flats.sort_by(|a, b| azimuth(a).total_cmp(&azimuth(b)));
        let radius = flats.iter().map(|f| planes[*f].distance).fold(f64::INFINITY, f64::min) - HAIR;
        if flats.len() < FLATS_WORTH_SKIPPING || radius <= 0.0 {
            return None;
        }
        let along = |f: &usize, sector| planes[*f].normal.truncate().dot(middle_of(sector));
        let first = |sector| flats.iter().max_by(|a, b| along(a, sector).total_cmp(&along(b, sector)));
        let parts = Planes::all(planes, &flats);
        let part_of = |f: &usize| parts.iter().position(|part| part.facet.contains(&(*f as u32)));
        let facing = std::array::from_fn(|sector| first(sector).and_then(part_of).unwrap_or(0) as u16);
        Some(Belt { radius2: (radius * radius) as f32, flats: parts, facing })
    }

    /// Whether a plane is a flat.
    pub fn holds(plane: &Plane) -> bool {
        plane.normal.z.abs() < VERTICAL
    }

    /// Which of the sixteens faces the azimuth of a point.
    #[inline(always)]
    pub fn facing(&self, x: f32, y: f32) -> usize {
        self.facing[sector_of(x, y)].into()
    }

    /// Whether a point is well inside all flats.
    pub fn surrounds(&self, point: Vec3) -> bool {
        point.truncate().length_squared() < self.radius2
    }
}

/// Sectors of azimuth that name where to begin; more would not name it better.
const SECTORS: usize = 64;

/// The sector of a point: azimuth by y / (|x| + |y|), which rises with the angle as well.
#[inline(always)]
fn sector_of(x: f32, y: f32) -> usize {
    let slope = y / (x.abs() + y.abs());
    let around = if x < 0.0 { 2.0 - slope } else { slope };
    ((around + 1.0) * (SECTORS as f32 / 4.0)) as usize % SECTORS
}

/// A direction in the middle of a sector.
fn middle_of(sector: usize) -> DVec2 {
    let around = (sector as f64 + 0.5) * 4.0 / SECTORS as f64 - 1.0;
    let (slope, side) = if around < 1.0 { (around, 1.0) } else { (2.0 - around, -1.0) };
    DVec2::new(side * (1.0 - slope.abs()), slope)
}

impl Planes {
    /// The planes of these numbers, in parts that differ in length by one at most: no plane is alone in
    /// its part, so that every one has a neighbour there.
    pub fn all(planes: &[Plane], numbers: &[usize]) -> Vec<Planes> {
        let (n, parts) = (numbers.len(), numbers.len().div_ceil(LANES));
        (0..parts).map(|i| Self::of(planes, &numbers[i * n / parts..(i + 1) * n / parts])).collect()
    }

    fn of(planes: &[Plane], numbers: &[usize]) -> Planes {
        let zero = [0.0; LANES];
        let mut side =
            Planes { nx: zero, ny: zero, nz: zero, d: [1.0; LANES], facet: [NO_FACET; LANES], last: 0 };
        for (l, &f) in numbers.iter().enumerate() {
            [side.nx[l], side.ny[l], side.nz[l]] = planes[f].normal.as_vec3().into();
            side.d[l] = planes[f].distance as f32;
            side.facet[l] = f as u32;
            side.last = l as u32;
        }
        side
    }
}
