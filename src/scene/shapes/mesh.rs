//! Triangle meshes around the stones, in a tree of boxes.

use super::super::build_context::{BuildContext, GREATEST};
use super::super::field_error::{FieldError, field_error};
use super::super::schema::{positive, turned};
use super::super::surface_hit::SurfaceHit;
use super::super::surface_schema::SurfaceEntry;
use super::surface_geometry::SurfaceGeometry;
use crate::formats::triangle_mesh::{self, Triangles};
use crate::limits::{self, Exceeded, Limits};
use glam::{DMat3, DVec3, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;
use std::collections::HashMap;

/// A mesh prepared for intersection from both sides.
pub struct SceneMesh {
    triangles: Vec<Triangle>,
    tree: Bvh2,
    /// CRC-32 of its corners.
    checksum: u32,
}

/// Checksums of scenes take a mesh by the checksum of its corners.
impl std::fmt::Debug for SceneMesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "mesh of {} triangles {:08x}", self.triangles.len(), self.checksum)
    }
}

impl SceneMesh {
    /// The mesh of a surface's entry.
    pub(super) fn read(
        file: &str,
        entry: &SurfaceEntry,
        place: &BuildContext,
    ) -> Result<SceneMesh, FieldError> {
        let mesh = triangle_mesh::triangles(&place.files.find("mesh", file)?, place.limits);
        let mesh = mesh.map_err(|e| field_error("mesh", e.to_string()))?;
        place.count_triangles(mesh.triangles.len()).map_err(|e| field_error("mesh", e.to_string()))?;
        let scale = place.length(positive("scale", Some(entry.scale.unwrap_or(1.0)))?);
        if mesh.vertices.iter().any(|v| v.length() * f64::from(scale) > GREATEST) {
            return Err(field_error("mesh", format!("{file} has a corner beyond ±{GREATEST:e}")));
        }
        let at = place.point(entry.at.unwrap_or_default()).as_dvec3();
        let mesh = SceneMesh::new(&mesh, turned(entry.turn), scale.into(), at, place.limits);
        mesh.map_err(|e| field_error("mesh", e.to_string()))
    }

    /// Places a mesh: turned and scaled about its own origin, then moved.
    pub fn new(
        mesh: &Triangles,
        turn: DMat3,
        scale: f64,
        at: DVec3,
        limits: Limits,
    ) -> Result<SceneMesh, Exceeded> {
        let place = |i: usize| (at + turn * mesh.vertices[i] * scale).as_vec3a();
        let triangles: Vec<Triangle> = mesh
            .triangles
            .iter()
            .map(|[a, b, c]| Triangle { v0: place(*a), v1: place(*b), v2: place(*c) })
            .collect();
        let mut same: HashMap<[u32; 6], usize> = HashMap::new();
        for t in &triangles {
            let (low, high) = (t.v0.min(t.v1).min(t.v2), t.v0.max(t.v1).max(t.v2));
            let [(a, b, c), (d, e, f)] = [low, high].map(|v| v.into());
            let count = same.entry([a, b, c, d, e, f].map(f32::to_bits)).or_default();
            *count += 1;
            limits.check(&limits::SAME_BOX, *count)?;
        }
        Ok(SceneMesh::from_triangles(triangles))
    }

    fn from_triangles(mut triangles: Vec<Triangle>) -> SceneMesh {
        let mut crc = crc32fast::Hasher::new();
        for t in &triangles {
            [t.v0, t.v1, t.v2].iter().flat_map(|v| v.to_array()).for_each(|x| crc.update(&x.to_le_bytes()));
        }
        let tree = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Default::default());
        // in the tree's order, so that a leaf's number is its triangle's
        triangles = tree.primitive_indices.iter().map(|i| triangles[*i as usize]).collect();
        SceneMesh { triangles, tree, checksum: crc.finalize() }
    }

    /// The mesh with every corner moved.
    pub fn moved(&self, to: &dyn Fn(Vec3) -> Vec3) -> SceneMesh {
        let moved = |v: Vec3A| Vec3A::from(to(v.into()));
        let each = |t: &Triangle| Triangle { v0: moved(t.v0), v1: moved(t.v1), v2: moved(t.v2) };
        SceneMesh::from_triangles(self.triangles.iter().map(each).collect())
    }

    /// Bound on the rounding error of a point of the mesh.
    pub fn offset(&self, point: Vec3) -> f32 {
        let (low, high) = self.bounds();
        1e-5 * (high - low).length().max(point.abs().max_element())
    }

    /// The corners of every triangle; neighbours follow each other.
    pub fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        self.triangles.iter().map(|t| [t.v0, t.v1, t.v2].map(Vec3::from))
    }
}

impl SurfaceGeometry for SceneMesh {
    fn intersect(&self, origin: Vec3, direction: Vec3, near: f32) -> Option<SurfaceHit> {
        // an intersection at the ray's least distance counts in the tree
        let ray = Ray::new(origin.into(), direction.into(), near.next_up(), f32::INFINITY);
        let mut hit = RayHit::none();
        let met = self.tree.ray_traverse(ray, &mut hit, |ray, id| self.triangles[id].intersect(ray));
        if !met {
            return None;
        }
        let t = &self.triangles[hit.primitive_id as usize];
        let normal = Vec3::from((t.v1 - t.v0).cross(t.v2 - t.v0)).normalize_or(-direction);
        let front = normal.dot(direction) <= 0.0;
        Some(SurfaceHit { distance: hit.t, normal: if front { normal } else { -normal }, front })
    }

    fn start(&self, point: Vec3, normal: Vec3) -> Vec3 {
        point + normal * self.offset(point)
    }

    fn bounds(&self) -> (Vec3, Vec3) {
        let root = self.tree.nodes.first().map(|n| (n.aabb().min, n.aabb().max));
        let (low, high) = root.unwrap_or((Vec3A::ZERO, Vec3A::ZERO));
        (low.into(), high.into())
    }

    fn lowest(&self) -> f32 {
        let corners = self.triangles.iter().flat_map(|t| [t.v0, t.v1, t.v2]);
        corners.map(|v| v.z).fold(f32::INFINITY, f32::min)
    }

    fn triangles(&self) -> Vec<[Vec3; 3]> {
        SceneMesh::triangles(self).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::library;
    use crate::sampling::random::{Purpose, Stream};
    use crate::trace::ConvexStone;
    use std::collections::BTreeMap;

    /// The tree finds what the planes of a convex stone find.
    #[test]
    fn a_mesh_of_a_brilliant_is_met_where_its_planes_are() {
        let design =
            library::design("round-brilliant", &BTreeMap::new()).expect("in the library").expect("builds");
        let stone = ConvexStone::new(design.solid().expect("closed"));
        let mesh = stone.solid.triangulate();
        let triangles = Triangles { vertices: mesh.vertices, triangles: mesh.triangles };
        let scale = 1.0 / stone.unit;
        let at = -stone.centre * scale;
        let mesh = SceneMesh::new(&triangles, DMat3::IDENTITY, scale, at, Limits::default()).expect("few");
        let mut stream = Stream::new(5, Purpose::TEST, 0);
        let mut met = 0;
        for _ in 0..2000 {
            let from =
                Vec3::new(stream.unit() - 0.5, stream.unit() - 0.5, stream.unit() - 0.5).normalize() * 3.0;
            let to = Vec3::new(stream.unit() - 0.5, stream.unit() - 0.5, stream.unit() - 0.5) * 1.5;
            let d = (to - from).normalize();
            match (stone.intersect(from, d), mesh.intersect(from, d, 0.0)) {
                (Some(a), Some(hit)) => {
                    met += 1;
                    assert!((a.distance - hit.distance).abs() < 1e-4, "{} {hit:?}", a.distance);
                    assert!(hit.normal.dot(d) < 0.0 && hit.front);
                }
                (None, None) => {}
                (a, b) => assert!(
                    a.map(|h| h.distance)
                        .or(b.map(|h| h.distance))
                        .is_some_and(|t| (from + d * t).length() > 0.3),
                    "one side alone {a:?} {b:?}"
                ),
            }
        }
        assert!(met > 500);
    }
}
