//! Flat parts of a surface: leftovers of noise go to the facet around them, and what is no stone is handed
//! out in facets that are flat indeed.

use super::{Plane, Polygon, WeldedSurface};
use crate::geometry::closed_mesh::{ClosedMesh, ClosedMeshFacet};
use crate::geometry::facet_recovery::name_of;
use crate::geometry::triangulation::triangles_of;
use glam::DVec3;
use std::collections::HashMap;

/// Corners of a facet of a [`ClosedMesh`] lie in its plane within this part of the mesh's diagonal: the tracer over
/// such bodies refuses no less than half as much again.
const FLAT: f64 = 2e-7;

impl WeldedSurface {
    /// The regions, smaller ones joined to a larger neighbour in whose plane they lie as well: a region grows
    /// from one face, whose own normal noise may have turned so that it stops too early.
    pub(super) fn absorbed(
        &self,
        mut regions: Vec<Vec<usize>>,
        polygons: &[Polygon],
        within: f64,
    ) -> Vec<Vec<usize>> {
        let mut region_of: HashMap<usize, usize> = HashMap::new();
        for (r, region) in regions.iter().enumerate() {
            region.iter().for_each(|f| {
                region_of.insert(*f, r);
            });
        }
        let mut planes: Vec<Plane> = regions.iter().map(|r| self.mean_plane(r)).collect();
        let mut areas: Vec<f64> = regions.iter().map(|r| self.area_of(r).length()).collect();
        let mut by_area: Vec<usize> = (0..regions.len()).collect();
        by_area.sort_by(|&a, &b| areas[a].total_cmp(&areas[b]));
        for small in by_area {
            let around = regions[small].iter().flat_map(|f| &self.neighbours[*f]);
            let mut around: Vec<usize> = around.filter_map(|f| region_of.get(f).copied()).collect();
            around.sort_unstable();
            around.dedup();
            around.retain(|&r| {
                let in_plane = |p: DVec3| planes[r].signed_distance(p).abs() <= within;
                areas[r] > areas[small]
                    && planes[r].normal.dot(planes[small].normal) > 0.0
                    && !self.named_apart(polygons, regions[r][0], regions[small][0])
                    && self.points(&regions[small]).all(in_plane)
            });
            let Some(large) = around.into_iter().max_by(|&a, &b| areas[a].total_cmp(&areas[b])) else {
                continue;
            };
            let faces = std::mem::take(&mut regions[small]);
            faces.iter().for_each(|f| {
                region_of.insert(*f, large);
            });
            regions[large].extend(faces);
            // exact enough while it grows by leftovers; a large gain counts
            if areas[small] > 0.01 * areas[large] {
                planes[large] = self.mean_plane(&regions[large]);
            }
            areas[large] += areas[small];
            areas[small] = 0.0;
        }
        regions.retain(|r| !r.is_empty());
        regions
    }

    /// The plane of the region's area and mean level.
    fn mean_plane(&self, region: &[usize]) -> Plane {
        let normal = self.area_of(region).normalize_or(DVec3::Z);
        let (sum, n) = self.points(region).fold((0.0, 0usize), |(s, n), p| (s + normal.dot(p), n + 1));
        Plane { normal, distance: sum / n.max(1) as f64 }
    }

    /// The closed surface as it stands: regions that are flat as facets, of others every triangle.
    pub fn body(
        &self,
        polygons: &[Polygon],
        regions: &[Vec<usize>],
        stands_out: f64,
        size: f64,
    ) -> ClosedMesh {
        let bent = |region: &Vec<usize>| {
            let plane = self.mean_plane(region);
            self.points(region).any(|p| plane.signed_distance(p).abs() > FLAT * size)
        };
        let bent: Vec<bool> = regions.iter().map(bent).collect();
        let named = |r: &Vec<usize>| ClosedMeshFacet {
            name: name_of(self, polygons, r),
            normal: self.area_of(r).normalize_or(DVec3::Z),
        };
        let (vertices, triangles, region_of) = self.triangles(regions);
        let mut facets: Vec<ClosedMeshFacet> = Vec::new();
        let mut facet_of_region = vec![usize::MAX; regions.len()];
        let mut facet_of = Vec::with_capacity(triangles.len());
        for (triangle, region) in triangles.iter().zip(region_of) {
            let [a, b, c] = triangle.map(|i: usize| vertices[i]);
            let own = (b - a).cross(c - a).try_normalize().filter(|_| bent[region]);
            if own.is_some() || facet_of_region[region] == usize::MAX {
                let mut facet = named(&regions[region]);
                facet.normal = own.unwrap_or(facet.normal);
                facet_of_region[region] = facets.len();
                facets.push(facet);
            }
            facet_of.push(facet_of_region[region]);
        }
        ClosedMesh {
            vertices,
            facets,
            triangles,
            facet_of,
            shells: self.shells,
            max_protrusion: stands_out,
            volume: self.volume(),
        }
    }

    /// Corners in use, triangles in those corners, and the region of each. A face without area,
    /// which is of no region, goes with a neighbour: without it the surface would be open.
    fn triangles(&self, regions: &[Vec<usize>]) -> (Vec<DVec3>, Vec<[usize; 3]>, Vec<usize>) {
        let mut number: HashMap<usize, usize> = HashMap::new();
        let mut vertices = Vec::new();
        let mut region_of: HashMap<usize, usize> = HashMap::new();
        regions.iter().enumerate().for_each(|(r, faces)| {
            faces.iter().for_each(|&f| {
                region_of.insert(f, r);
            });
        });
        let (mut triangles, mut regions) = (Vec::new(), Vec::new());
        for (f, face) in self.faces.iter().enumerate() {
            let beside = || self.neighbours[f].iter().find_map(|g| region_of.get(g));
            let region = region_of.get(&f).or_else(beside).copied().unwrap_or_default();
            let points: Vec<DVec3> = face.corners.iter().map(|&c| self.vertices[c]).collect();
            for triangle in triangles_of(&points, face.area.normalize_or(DVec3::Z)) {
                triangles.push(triangle.map(|i| {
                    *number.entry(face.corners[i]).or_insert_with(|| {
                        vertices.push(points[i]);
                        vertices.len() - 1
                    })
                }));
                regions.push(region);
            }
        }
        (vertices, triangles, regions)
    }
}
