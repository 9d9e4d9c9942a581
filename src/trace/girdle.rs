//! Girdle facets, kept out of the packet loop: few rays need them (one in forty in a round brilliant), and
//! they are vertical, so that the z test is skipped.

use super::lanes::{LANES, Lanes};
use super::packet::NO_FACET;
use crate::geometry::Plane;
use glam::{DVec2, Vec3};

/// With fewer girdle facets it is faster to test them all for every ray.
const MIN_GIRDLE_FACETS: usize = 8;

/// Greatest |z| of a girdle facet's normal: those of designs are vertical to rounding.
const MAX_NORMAL_Z: f64 = 1e-9;

/// Margin between the cylinder and the nearest girdle facet, for the rounding of a ray's end.
const RADIUS_MARGIN: f64 = 1e-5;

/// The vertical facets of a stone.
#[derive(Debug, Clone)]
pub(super) struct GirdleFacets {
    /// Square of the radius about the frame's axis within which no girdle facet is met.
    pub radius2: f32,
    /// The facets in order of azimuth.
    pub blocks: Vec<PlaneBlock16>,
    /// For each sector of azimuth, the block that faces it.
    facing: [u16; SECTORS],
}

/// Sixteen planes side by side; unused places hold planes that no ray meets.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(super) struct PlaneBlock16 {
    pub nx: Lanes,
    pub ny: Lanes,
    pub nz: Lanes,
    pub d: Lanes,
    pub facet: [u32; LANES],
    /// Number of the last plane in use.
    pub last: u32,
}

impl GirdleFacets {
    /// The girdle facets among the planes, if there are enough to be worth a search of their own.
    pub fn new(planes: &[Plane]) -> Option<GirdleFacets> {
        let mut flats: Vec<usize> = (0..planes.len()).filter(|f| Self::is_girdle(&planes[*f])).collect();
        let azimuth = |f: &usize| planes[*f].normal.y.atan2(planes[*f].normal.x);
        flats.sort_by(|a, b| azimuth(a).total_cmp(&azimuth(b)));
        let radius = flats.iter().map(|f| planes[*f].distance).fold(f64::INFINITY, f64::min) - RADIUS_MARGIN;
        if flats.len() < MIN_GIRDLE_FACETS || radius <= 0.0 {
            return None;
        }
        let along = |f: &usize, sector| planes[*f].normal.truncate().dot(middle_of(sector));
        let first = |sector| flats.iter().max_by(|a, b| along(a, sector).total_cmp(&along(b, sector)));
        let parts = PlaneBlock16::split(planes, &flats);
        let part_of = |f: &usize| parts.iter().position(|part| part.facet.contains(&(*f as u32)));
        let facing = std::array::from_fn(|sector| first(sector).and_then(part_of).unwrap_or(0) as u16);
        Some(GirdleFacets { radius2: (radius * radius) as f32, blocks: parts, facing })
    }

    /// Whether a plane is vertical, as girdle facets are.
    pub fn is_girdle(plane: &Plane) -> bool {
        plane.normal.z.abs() < MAX_NORMAL_Z
    }

    /// The block that faces the azimuth of a point.
    #[inline(always)]
    pub fn facing(&self, x: f32, y: f32) -> usize {
        self.facing[sector_of(x, y)].into()
    }

    /// Whether a point is well inside all girdle facets.
    pub fn encloses(&self, point: Vec3) -> bool {
        point.truncate().length_squared() < self.radius2
    }
}

/// Sectors of azimuth by which a search finds its first block; more would not find a better one.
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

impl PlaneBlock16 {
    /// The planes of these numbers, in blocks that differ in length by one at most: no plane is alone in
    /// its block, so that every one has a neighbour there.
    pub fn split(planes: &[Plane], numbers: &[usize]) -> Vec<PlaneBlock16> {
        let (n, parts) = (numbers.len(), numbers.len().div_ceil(LANES));
        (0..parts).map(|i| Self::new(planes, &numbers[i * n / parts..(i + 1) * n / parts])).collect()
    }

    fn new(planes: &[Plane], numbers: &[usize]) -> PlaneBlock16 {
        let zero = [0.0; LANES];
        let mut side =
            PlaneBlock16 { nx: zero, ny: zero, nz: zero, d: [1.0; LANES], facet: [NO_FACET; LANES], last: 0 };
        for (l, &f) in numbers.iter().enumerate() {
            [side.nx[l], side.ny[l], side.nz[l]] = planes[f].normal.as_vec3().into();
            side.d[l] = planes[f].distance as f32;
            side.facet[l] = f as u32;
            side.last = l as u32;
        }
        side
    }
}
