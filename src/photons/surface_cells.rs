//! A surface divided into cells, each of which has one irradiance.

use crate::parallel;
use crate::scene::Surface;
use glam::Vec3;

/// A part of one side of a surface.
#[derive(Debug, Clone, Copy)]
pub struct SurfaceCell {
    /// Its middle.
    pub point: Vec3,
    /// Unit normal on its side.
    pub normal: Vec3,
    /// Area of the surface that it represents.
    pub area: f32,
    /// Radius over which photons that fall on it are spread.
    pub radius: f32,
}

/// A parallelogram or a triangle.
#[derive(Debug, Clone, Copy)]
struct Patch {
    corner: Vec3,
    u: Vec3,
    v: Vec3,
    triangle: bool,
}

impl Patch {
    fn middle(&self) -> Vec3 {
        self.corner + (self.u + self.v) / if self.triangle { 3.0 } else { 2.0 }
    }

    fn area(&self) -> f32 {
        self.u.cross(self.v).length() * if self.triangle { 0.5 } else { 1.0 }
    }

    fn longest_edge(&self) -> f32 {
        let edge = self.u.length().max(self.v.length());
        if self.triangle { edge.max(self.u.distance(self.v)) } else { edge }
    }

    /// Both halves, cut across the longest edge.
    fn halves(&self) -> [Patch; 2] {
        let Patch { corner, u, v, triangle } = *self;
        let patch = |corner, u, v| Patch { corner, u, v, triangle };
        let (a, b) = (u.length_squared(), v.length_squared());
        if triangle && u.distance_squared(v) > a.max(b) {
            let middle = 0.5 * (u + v);
            [patch(corner, u, middle), patch(corner, middle, v)]
        } else if a >= b {
            let half = 0.5 * u;
            [patch(corner, half, v), patch(corner + half, half, if triangle { v - half } else { v })]
        } else {
            let half = 0.5 * v;
            [patch(corner, u, half), patch(corner + half, if triangle { u - half } else { u }, half)]
        }
    }
}

/// Triangles of a mesh that are divided one after the other, the unit of parallel work.
const RUN: usize = 1024;
/// A radius holds for places within this share of it.
const PHOTONS_PER_CELL: f32 = 0.1;
/// Halvings of a patch, at most: a millionth of its edge in both directions.
const DEEPEST: u32 = 40;
/// Halvings by which a quad is divided in parallel.
const PARALLEL: u32 = 6;

/// Divides the front of a surface until no cell is longer than `share` of the radius at its middle.
/// Triangles of a mesh that are smaller represent their neighbours of about the same normal.
///
/// - `radius`: at a place; may not change faster than the place does, and `share` is below √2, so that
///   no small spot is missed
pub fn divide(surface: &Surface, share: f32, radius: &(impl Fn(Vec3) -> f32 + Sync)) -> Vec<SurfaceCell> {
    if let Some(quad) = surface.shape.as_quad() {
        let whole = Patch { corner: quad.corner, u: quad.u, v: quad.v, triangle: false };
        return halve(whole, quad.normal(), share, radius, 0);
    }
    let triangles = surface.shape.geometry().triangles();
    let runs: Vec<&[[Vec3; 3]]> = triangles.chunks(RUN).collect();
    parallel::map(runs.len(), |i| of_triangles(runs[i], share, radius)).concat()
}

/// The cells of a patch, in order.
fn halve(
    patch: Patch,
    normal: Vec3,
    share: f32,
    radius: &(impl Fn(Vec3) -> f32 + Sync),
    depth: u32,
) -> Vec<SurfaceCell> {
    let point = patch.middle();
    let here = radius(point);
    if depth == DEEPEST || patch.longest_edge() <= share * here {
        return vec![SurfaceCell { point, normal, area: patch.area(), radius: here }];
    }
    let [one, other] = patch.halves();
    let half = |patch| halve(patch, normal, share, radius, depth + 1);
    let (mut cells, others) = if depth < PARALLEL {
        parallel::join(|| half(one), || half(other))
    } else {
        (half(one), half(other))
    };
    cells.extend(others);
    cells
}

/// The cells of triangles that are neighbours.
fn of_triangles(
    triangles: &[[Vec3; 3]],
    share: f32,
    radius: &(impl Fn(Vec3) -> f32 + Sync),
) -> Vec<SurfaceCell> {
    let mut cells = Vec::new();
    // for each direction of the normal: area that no cell represents yet, and the last small triangle
    let mut small: [Option<SurfaceCell>; 6] = [None; 6];
    let mut known = (Vec3::INFINITY, 0.0);
    for [a, b, c] in triangles {
        let patch = Patch { corner: *a, u: *b - *a, v: *c - *a, triangle: true };
        let Some(normal) = patch.u.cross(patch.v).try_normalize() else { continue };
        let point = patch.middle();
        if point.distance(known.0) > PHOTONS_PER_CELL * known.1 {
            known = (point, radius(point));
        }
        let edge = share * known.1;
        if patch.longest_edge() > edge {
            cells.extend(halve(patch, normal, share, radius, PARALLEL));
            continue;
        }
        let gathered = &mut small[direction(normal)];
        let area = patch.area() + gathered.map_or(0.0, |cell| cell.area);
        let cell = SurfaceCell { point, normal, area, radius: known.1 };
        // half of the largest square is about the mean of what halving gives
        let enough = area > 0.5 * edge * edge;
        *gathered = (!enough).then_some(cell);
        cells.extend(enough.then_some(cell));
    }
    cells.extend(small.into_iter().flatten());
    cells
}

/// The nearest of the six directions of the axes.
fn direction(normal: Vec3) -> usize {
    let axis = normal.abs().max_position();
    2 * axis + usize::from(normal[axis] < 0.0)
}
