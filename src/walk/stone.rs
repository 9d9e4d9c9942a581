//! A stone made ready for light.

use super::belt::{Belt, Planes};
use super::dispatch::{self, Isa};
use super::packet::{NextFacets, Packet};
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
    /// Planes (normal, distance) by facet for the packet kernel.
    pub(super) facets: Vec<[f32; 4]>,
    /// The facets that all rays of a packet try.
    pub(super) rows: Vec<Row>,
    /// Those that few rays need to try; part of the rows if they are few.
    pub(super) belt: Option<Belt>,
    /// The rows again for single rays.
    pub(super) slopes: Vec<Planes>,
    pub(super) isa: Isa,
}

/// A plane as the packet kernel reads it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub plane: [f32; 4],
    pub facet: u32,
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
        let belt = Belt::of(&planes);
        let slopes: Vec<usize> =
            (0..planes.len()).filter(|f| belt.is_none() || !Belt::holds(&planes[*f])).collect();
        let facets: Vec<[f32; 4]> =
            planes.iter().map(|p| p.normal.as_vec3().extend(p.distance as f32).into()).collect();
        Stone {
            rows: slopes.iter().map(|f| Row { plane: facets[*f], facet: *f as u32 }).collect(),
            slopes: Planes::all(&planes, &slopes),
            facets,
            belt,
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

    /// The facet that every lane of a packet meets next, and how far it is: the search that a walk
    /// does at every meeting.
    ///
    /// Checked in `tests/walk_search.rs` against brute force in `f64`.
    pub fn next_facets(&self, packet: &Packet) -> NextFacets {
        dispatch::next_facets(self, packet)
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
        self.facets
            .iter()
            .map(|[x, y, z, distance]| Plane {
                normal: Vec3::new(*x, *y, *z).as_dvec3(),
                distance: (*distance).into(),
            })
            .collect()
    }
}
