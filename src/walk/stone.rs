//! A stone made ready for light.

use super::dispatch::{self, Isa};
use super::packet::LANES;
use crate::optics::fresnel::Facing;
use crate::solid::{Plane, Polyhedron};
use glam::{DVec3, Vec3};

/// A convex stone in its walking frame: centred on its box and scaled so that its farthest corner
/// lies at distance 1, axes as the design's.
#[derive(Debug, Clone)]
pub struct Stone {
    /// Facet planes in the walking frame, `f64`.
    pub planes: Vec<Plane>,
    /// For each facet, its outward unit normal in `f32`.
    pub normals: Vec<Vec3>,
    /// The solid the stone was made from, in the design's unit.
    pub solid: Polyhedron,
    /// Origin of the walking frame, in the design's unit.
    pub centre: DVec3,
    /// Length of one walking unit, in the design's unit.
    pub unit: f64,
    /// Planes (normal, distance) for the packet kernel: sloping facets, then the girdle's flats.
    pub(super) rows: Vec<[f32; 4]>,
    /// How many of the rows are sloping facets.
    pub(super) slopes: usize,
    /// For each row, the facet's number.
    pub(super) facet_of: Vec<u32>,
    /// Square of the radius about the frame's axis within which no girdle flat is met.
    pub(super) belt_radius2: f32,
    /// Planes by facet for the single-ray kernel, padded to a multiple of [`LANES`] with planes that nothing meets.
    pub(super) nx: Vec<f32>,
    pub(super) ny: Vec<f32>,
    pub(super) nz: Vec<f32>,
    pub(super) d: Vec<f32>,
    pub(super) isa: Isa,
}

/// Where a ray from outside meets the stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The facet.
    pub facet: usize,
    /// Distance along the ray, in walking units.
    pub distance: f32,
}

/// A ray that enters the stone.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Unit direction inside.
    pub direction: Vec3,
    /// Share of the power reflected at the facet.
    pub reflectance: f32,
    /// Cosine of incidence outside.
    pub cos_outside: f32,
    /// Cosine of refraction inside.
    pub cos_inside: f32,
    /// Q of the light that enters of unpolarised light of power 1.
    pub polarisation: f32,
    /// Axis of Q: unit, across the plane of incidence.
    pub axis: Vec3,
}

impl Stone {
    /// Makes a solid ready, for the best instruction set of this machine.
    pub fn new(solid: Polyhedron) -> Stone {
        Self::with_isa(solid, Isa::best())
    }

    /// Makes a solid ready for a given instruction set.
    pub fn with_isa(solid: Polyhedron, isa: Isa) -> Stone {
        let (centre, unit) = solid.bounding_sphere();
        let planes: Vec<Plane> = (0..solid.faces.len())
            .map(|f| {
                let normal = solid.area_vector(f).normalize();
                // the plane itself, not the polygon's: a small facet's polygon knows it less well
                let corner = solid.vertices[solid.faces[f].corners[0]];
                Plane { normal, distance: normal.dot(corner - centre) / unit }
            })
            .collect();
        let padded = planes.len().next_multiple_of(LANES);
        let column = |value: &dyn Fn(&Plane) -> f64, pad: f32| {
            let mut column: Vec<f32> = planes.iter().map(|p| value(p) as f32).collect();
            column.resize(padded, pad);
            column
        };
        let (order, slopes) = belt_last(&planes);
        let row = |f: &usize| {
            let n = planes[*f].normal.as_vec3();
            [n.x, n.y, n.z, planes[*f].distance as f32]
        };
        // a hair less than the nearest flat, for the rounding of a ray's end
        let belt = order[slopes..].iter().map(|f| planes[*f].distance).fold(f64::INFINITY, f64::min) - 1e-5;
        Stone {
            rows: order.iter().map(row).collect(),
            facet_of: order.iter().map(|f| *f as u32).collect(),
            slopes,
            belt_radius2: (belt.max(0.0).powi(2)) as f32,
            nx: column(&|p| p.normal.x, 0.0),
            ny: column(&|p| p.normal.y, 0.0),
            nz: column(&|p| p.normal.z, 0.0),
            d: column(&|p| p.distance, 1.0),
            normals: planes.iter().map(|p| p.normal.as_vec3()).collect(),
            isa,
            planes,
            solid,
            centre,
            unit,
        }
    }

    /// Number of facets.
    pub fn facet_count(&self) -> usize {
        self.planes.len()
    }

    /// A point of the design's frame in the walking frame.
    pub fn from_design(&self, p: DVec3) -> DVec3 {
        (p - self.centre) / self.unit
    }

    /// First meeting of a ray that starts outside.
    ///
    /// - `origin`, `direction` (unit): walking frame
    ///
    /// None if the ray misses the stone or starts behind or inside it.
    pub fn hit(&self, origin: Vec3, direction: Vec3) -> Option<Hit> {
        // most rays of a scene miss the sphere around the stone
        let b = origin.dot(direction);
        let c = origin.length_squared() - 1.0;
        if c > 0.0 && (b > 0.0 || b * b < c) {
            return None;
        }
        dispatch::first_hit(self, origin, direction)
    }

    /// Refraction of a ray into facet `facet`.
    ///
    /// - `direction`: unit, pointing at the facet from outside
    /// - `index`: refractive index of the stone
    pub fn enter(&self, facet: usize, direction: Vec3, index: f32) -> Entry {
        let normal = self.normals[facet];
        let cos_outside = (-direction.dot(normal)).clamp(0.0, 1.0);
        let facing = Facing::new(cos_outside.into(), index.into());
        let (reflectance, cos_inside) = (facing.mean() as f32, facing.cos_t as f32);
        let polarisation = (0.5 * (facing.r_p - facing.r_s)) as f32; // T_s − T_p over 2
        let across = direction.cross(normal);
        let axis = if across.length_squared() < 1e-12 {
            direction.any_orthonormal_vector()
        } else {
            across.normalize()
        };
        let eta = 1.0 / index;
        let inside = direction * eta + normal * (eta * cos_outside - cos_inside);
        Entry { direction: inside.normalize(), reflectance, cos_outside, cos_inside, polarisation, axis }
    }

    /// Direction of a ray mirrored at facet `facet`.
    pub fn reflect(&self, facet: usize, direction: Vec3) -> Vec3 {
        direction.reflect(self.normals[facet])
    }

    /// The planes as the kernel has them, `f32` values widened: the scalar twin walks the very
    /// same stone.
    pub fn kernel_planes(&self) -> Vec<Plane> {
        (0..self.planes.len())
            .map(|i| Plane {
                normal: DVec3::new(self.nx[i].into(), self.ny[i].into(), self.nz[i].into()),
                distance: self.d[i].into(),
            })
            .collect()
    }
}

/// The facets with the vertical ones last, and how many come before them.
///
/// The belt is left out (all facets come before it) if it is too small to be worth a look of its
/// own.
fn belt_last(planes: &[Plane]) -> (Vec<usize>, usize) {
    /// Fewer flats cost less than finding out whether they are needed.
    const FLATS_WORTH_SKIPPING: usize = 8;
    /// Flats of a design are vertical to rounding; the cylinder inside them needs no more slack.
    const VERTICAL: f64 = 1e-9;
    let is_flat = |f: &usize| planes[*f].normal.z.abs() < VERTICAL;
    let (flats, mut order): (Vec<usize>, Vec<usize>) = (0..planes.len()).partition(is_flat);
    let slopes = order.len();
    order.extend(&flats);
    if flats.len() < FLATS_WORTH_SKIPPING {
        ((0..planes.len()).collect(), planes.len())
    } else {
        (order, slopes)
    }
}
