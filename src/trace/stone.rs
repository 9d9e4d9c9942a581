//! A convex stone prepared for tracing.

use super::dispatch::Isa;
use super::girdle::{GirdleFacets, PlaneBlock16};
use super::packet::Refraction;
use crate::geometry::{Plane, Polyhedron};
use crate::optics::fresnel::FresnelCoefficients;
use crate::optics::snell::Snell;
use glam::{DVec3, Vec3};

/// A convex stone in its trace frame: centred on its box and scaled so that its farthest corner
/// lies at distance 1, axes as the design's.
#[derive(Debug, Clone)]
pub struct ConvexStone {
    /// Facet planes in the trace frame, `f64`.
    pub planes: Vec<Plane>,
    /// For each facet, its outward unit normal in `f32`.
    pub normals: Vec<Vec3>,
    /// The solid the stone was made from, in the design's unit.
    pub solid: Polyhedron,
    /// Origin of the trace frame, in the design's unit.
    pub centre: DVec3,
    /// Length of one trace unit, in the design's unit.
    pub unit: f64,
    /// Planes (normal, distance) by facet for the packet kernel.
    pub(super) plane_coefficients: Vec<[f32; 4]>,
    /// The facets that all rays of a packet try.
    pub(super) inclined_facets: Vec<InclinedFacet>,
    /// The girdle facets; none if they are few, and then `inclined_facets` has them.
    pub(super) girdle: Option<GirdleFacets>,
    /// The inclined facets again, for single rays.
    pub(super) inclined_blocks: Vec<PlaneBlock16>,
    pub(super) isa: Isa,
}

/// A plane as the packet kernel reads it.
#[derive(Debug, Clone, Copy)]
pub(super) struct InclinedFacet {
    pub plane: [f32; 4],
    pub facet: u32,
}

impl ConvexStone {
    /// Prepares a solid for tracing, with the best instruction set of this machine.
    pub fn new(solid: Polyhedron) -> ConvexStone {
        Self::with_isa(solid, Isa::best())
    }

    /// Prepares a solid for tracing, with a given instruction set.
    pub fn with_isa(solid: Polyhedron, isa: Isa) -> ConvexStone {
        let (centre, unit) = solid.bounding_sphere();
        let planes: Vec<Plane> = (0..solid.faces.len())
            .map(|f| {
                let normal = solid.area_vector(f).normalize();
                let corner = solid.vertices[solid.faces[f].corners[0]];
                Plane { normal, distance: normal.dot(corner - centre) / unit }
            })
            .collect();
        let girdle = GirdleFacets::new(&planes);
        let slopes: Vec<usize> =
            (0..planes.len()).filter(|f| girdle.is_none() || !GirdleFacets::is_girdle(&planes[*f])).collect();
        let facets: Vec<[f32; 4]> =
            planes.iter().map(|p| p.normal.as_vec3().extend(p.distance as f32).into()).collect();
        ConvexStone {
            inclined_facets: slopes
                .iter()
                .map(|f| InclinedFacet { plane: facets[*f], facet: *f as u32 })
                .collect(),
            inclined_blocks: PlaneBlock16::split(&planes, &slopes),
            plane_coefficients: facets,
            girdle,
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

    /// A point of the design's frame in the trace frame.
    pub fn point_from_design(&self, p: DVec3) -> DVec3 {
        (p - self.centre) / self.unit
    }

    /// Refraction of a ray into facet `facet`.
    ///
    /// - `direction`: unit, pointing at the facet from outside
    /// - `index`: refractive index of the stone
    pub fn refract_into(&self, facet: usize, direction: Vec3, index: f32) -> Refraction {
        let normal = self.normals[facet];
        let cos_outside = (-direction.dot(normal)).clamp(0.0, 1.0);
        let law = Snell::new(cos_outside.into(), 1.0 / f64::from(index));
        let facing = FresnelCoefficients::of(&law);
        let (reflectance, cos_inside) = (facing.unpolarised_reflectance() as f32, facing.cos_t as f32);
        let polarisation = (0.5 * (facing.r_p - facing.r_s)) as f32; // T_s − T_p over 2
        let across = direction.cross(normal);
        let axis = if across.length_squared() < 1e-12 {
            direction.any_orthonormal_vector()
        } else {
            across.normalize()
        };
        let inside = Vec3::from(law.to_f32().refracted(direction.into(), (-normal).into()));
        Refraction { direction: inside.normalize(), reflectance, cos_outside, cos_inside, polarisation, axis }
    }

    /// Direction of a ray mirrored at facet `facet`.
    pub fn reflect(&self, facet: usize, direction: Vec3) -> Vec3 {
        direction.reflect(self.normals[facet])
    }

    /// The planes as the kernel has them, `f32` values widened: [`super::reference`] then traces the very
    /// same stone.
    pub fn kernel_planes(&self) -> Vec<Plane> {
        self.plane_coefficients
            .iter()
            .map(|[x, y, z, distance]| Plane {
                normal: Vec3::new(*x, *y, *z).as_dvec3(),
                distance: (*distance).into(),
            })
            .collect()
    }
}
