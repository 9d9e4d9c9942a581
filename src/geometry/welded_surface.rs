//! A mesh as a surface: welded corners, consistent outward winding, coplanar regions.

mod flat_regions;
mod junctions;

use super::facet_recovery::Polygon;
use super::plane::Plane;
use super::welding::without_repeats;
use glam::DVec3;
use std::collections::{HashMap, HashSet, VecDeque};

/// Names differ and stated normals differ by more than this: two facets, however nearly coplanar.
/// Far above the rounding of `f64`, far below any angle cut on purpose.
const SAME_STATED: f64 = 1e-9;

/// One polygon of the surface.
#[derive(Debug, Clone)]
pub(super) struct SurfaceFace {
    /// The polygon it came from.
    pub polygon: usize,
    corners: Vec<usize>,
    area: DVec3,
}

/// Polygons with welded corners, wound outward.
#[derive(Debug, Clone, Default)]
pub(super) struct WeldedSurface {
    vertices: Vec<DVec3>,
    pub faces: Vec<SurfaceFace>,
    neighbours: Vec<Vec<usize>>,
    stated_inward: bool,
    /// Corners that were put on edges of other faces.
    pub divided_edges: usize,
    /// Edges not shared by exactly two faces in opposite directions.
    pub open_edges: usize,
    /// Connected parts.
    pub shells: usize,
}

fn area_vector(vertices: &[DVec3], corners: &[usize]) -> DVec3 {
    let at = |i: usize| vertices[corners[i]] - vertices[corners[0]];
    (1..corners.len().saturating_sub(1)).map(|i| at(i).cross(at(i + 1))).sum::<DVec3>() * 0.5
}

impl WeldedSurface {
    /// The surface of the polygons, corners replaced by those they are welded to.
    pub fn new(vertices: &[DVec3], polygons: &[Polygon], first: &[usize]) -> WeldedSurface {
        // faces that are drawn from both sides are there twice
        let mut seen = HashSet::new();
        let mut outlines = Vec::new();
        for (polygon, p) in polygons.iter().enumerate() {
            let corners = without_repeats(p.corners.iter().map(|&c| first[c]));
            let mut set = corners.clone();
            set.sort_unstable();
            if corners.len() > 2 && seen.insert(set) {
                outlines.push((polygon, corners));
            }
        }
        WeldedSurface::from_outlines(vertices.to_vec(), polygons, outlines)
    }

    /// The surface of outlines, each the polygon's of that number.
    fn from_outlines(
        vertices: Vec<DVec3>,
        polygons: &[Polygon],
        outlines: Vec<(usize, Vec<usize>)>,
    ) -> WeldedSurface {
        let face = |(polygon, corners): (usize, Vec<usize>)| {
            let area = area_vector(&vertices, &corners);
            SurfaceFace { polygon, corners, area }
        };
        let faces = outlines.into_iter().map(face).collect();
        let mut surface = WeldedSurface { faces, vertices, ..WeldedSurface::default() };
        surface.orient();
        surface.stated_inward = surface.states_inward(polygons);
        surface
    }

    /// Finds neighbours, makes windings agree and point outward, counts open edges and parts.
    fn orient(&mut self) {
        let mut edges: HashMap<(usize, usize), Vec<(usize, bool)>> = HashMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for (i, &a) in face.corners.iter().enumerate() {
                let b = face.corners[(i + 1) % face.corners.len()];
                edges.entry((a.min(b), a.max(b))).or_default().push((f, a < b));
            }
        }
        let mut beside = vec![Vec::new(); self.faces.len()];
        for sharing in edges.values() {
            match sharing[..] {
                [(f, up), (g, also_up)] => {
                    beside[f].push((g, up == also_up));
                    beside[g].push((f, up == also_up));
                }
                _ => self.open_edges += 1,
            }
        }
        // the order of a map is none
        beside.iter_mut().for_each(|b: &mut Vec<(usize, bool)>| b.sort_unstable());
        let mut turned: Vec<Option<bool>> = vec![None; self.faces.len()];
        for start in 0..self.faces.len() {
            if turned[start].is_some() {
                continue;
            }
            self.shells += 1;
            turned[start] = Some(false);
            let (mut part, mut next) = (vec![start], 0);
            while let Some(&f) = part.get(next) {
                next += 1;
                for &(g, against) in &beside[f] {
                    let wanted = turned[f].map(|t| t != against);
                    if turned[g].is_none() {
                        turned[g] = wanted;
                        part.push(g);
                    } else if turned[g] != wanted {
                        self.open_edges += 1; // one-sided like a Möbius strip
                    }
                }
            }
            for &f in &part {
                if turned[f] == Some(true) {
                    self.turn(f);
                }
            }
            if self.volume_of(&part) < 0.0 {
                part.iter().for_each(|&f| self.turn(f));
            }
        }
        self.neighbours = beside.iter().map(|b| b.iter().map(|&(g, _)| g).collect()).collect();
        self.neighbours.iter_mut().for_each(|n: &mut Vec<usize>| n.sort_unstable());
    }

    fn turn(&mut self, face: usize) {
        self.faces[face].corners.reverse();
        self.faces[face].area = -self.faces[face].area;
    }

    fn volume_of(&self, part: &[usize]) -> f64 {
        let Some(origin) = part.first().map(|&f| self.vertices[self.faces[f].corners[0]]) else { return 0.0 };
        part.iter().map(|&f| self.faces[f].area.dot(self.centroid(f) - origin) / 3.0).sum()
    }

    /// A point such that area · point is thrice the face's part of the volume, planar or not.
    fn centroid(&self, face: usize) -> DVec3 {
        let SurfaceFace { corners, area, .. } = &self.faces[face];
        let total = area.length_squared();
        if total == 0.0 {
            return self.vertices[corners[0]];
        }
        let p = |i: usize| self.vertices[corners[i]];
        (1..corners.len() - 1)
            .map(|i| {
                let part = (p(i) - p(0)).cross(p(i + 1) - p(0)).dot(*area) * 0.5;
                (p(0) + p(i) + p(i + 1)) * (part / total / 3.0)
            })
            .sum()
    }

    /// Volume enclosed, in the mesh's unit cubed.
    pub fn volume(&self) -> f64 {
        self.volume_of(&(0..self.faces.len()).collect::<Vec<_>>())
    }

    /// The corners in use.
    pub fn corners(&self) -> Vec<DVec3> {
        let mut used: Vec<usize> = self.faces.iter().flat_map(|f| f.corners.iter().copied()).collect();
        used.sort_unstable();
        used.dedup();
        used.into_iter().map(|c| self.vertices[c]).collect()
    }

    /// Groups of coplanar neighbours, each led by its largest face, in the order of their first
    /// polygons. Grown from large faces to small ones, whose own normals are the less certain.
    pub fn regions(&self, polygons: &[Polygon], within: f64) -> Vec<Vec<usize>> {
        let mut by_area: Vec<usize> = (0..self.faces.len()).collect();
        by_area.sort_by(|&a, &b| {
            self.faces[b].area.length_squared().total_cmp(&self.faces[a].area.length_squared())
        });
        let mut taken = vec![false; self.faces.len()];
        let mut regions = Vec::new();
        for seed in by_area {
            if taken[seed] || self.faces[seed].area.length_squared() == 0.0 {
                continue;
            }
            taken[seed] = true;
            let (mut region, mut area) = (vec![seed], self.faces[seed].area);
            let mut moment = self.centroid(seed) * area.length();
            let mut weight = area.length();
            let mut queue: VecDeque<usize> = self.neighbours[seed].iter().copied().collect();
            while let Some(f) = queue.pop_front() {
                if taken[f] {
                    continue;
                }
                let face = &self.faces[f];
                let plane = Plane::new(area, 0.0);
                let level = plane.signed_distance(moment / weight);
                let flat = face
                    .corners
                    .iter()
                    .all(|&c| (plane.signed_distance(self.vertices[c]) - level).abs() <= within);
                if !flat || face.area.dot(area) < 0.0 || self.named_apart(polygons, seed, f) {
                    continue;
                }
                taken[f] = true;
                region.push(f);
                area += face.area;
                moment += self.centroid(f) * face.area.length();
                weight += face.area.length();
                queue.extend(self.neighbours[f].iter().filter(|&&g| !taken[g]));
            }
            regions.push(region);
        }
        let mut regions = self.absorbed(regions, polygons, within);
        regions.sort_by_key(|r| r.iter().map(|&f| self.faces[f].polygon).min());
        regions
    }

    /// Whether the file itself says that two faces are different facets.
    fn named_apart(&self, polygons: &[Polygon], a: usize, b: usize) -> bool {
        let (a, b) = (&polygons[self.faces[a].polygon], &polygons[self.faces[b].polygon]);
        let apart =
            |(n, m): (DVec3, DVec3)| n.normalize_or_zero().distance(m.normalize_or_zero()) > SAME_STATED;
        !a.name.is_empty()
            && !b.name.is_empty()
            && a.name != b.name
            && a.normal.zip(b.normal).is_some_and(apart)
    }

    /// The area of a region as a vector along its outward normal.
    pub fn area_of(&self, region: &[usize]) -> DVec3 {
        region.iter().map(|&f| self.faces[f].area).sum()
    }

    /// Whether no face rises above the plane of a neighbour by more than `within`.
    pub fn is_convex_at_edges(&self, within: f64) -> bool {
        (0..self.faces.len()).all(|f| {
            let SurfaceFace { corners, area, .. } = &self.faces[f];
            let Some(normal) = area.try_normalize() else { return true };
            let plane = Plane { normal, distance: normal.dot(self.vertices[corners[0]]) };
            let below = |c: &usize| plane.signed_distance(self.vertices[*c]) <= within;
            self.neighbours[f].iter().all(|g| self.faces[*g].corners.iter().all(below))
        })
    }

    fn points(&self, region: &[usize]) -> impl Iterator<Item = DVec3> + Clone {
        region.iter().flat_map(|&f| self.faces[f].corners.iter().map(|&c| self.vertices[c]))
    }

    /// The plane of a region: with its first stated normal that fits the corners within `stated_within`, if
    /// stated ones are wanted; else with the area-weighted mean normal, if the region is `broad` enough to
    /// have one.
    pub fn plane(
        &self,
        region: &[usize],
        polygons: &[Polygon],
        stated_within: Option<f64>,
        broad: bool,
    ) -> Option<Plane> {
        let area = self.area_of(region);
        // corners as the file has them: welding moves some by more than `stated_within`
        let own = || region.iter().flat_map(|&f| &polygons[self.faces[f].polygon].corners);
        let levelled = |normal: DVec3| {
            let plane = Plane { normal, distance: 0.0 };
            let (sum, n) =
                own().fold((0.0, 0usize), |(s, n), &c| (s + plane.signed_distance(self.vertices[c]), n + 1));
            Plane { normal, distance: sum / n as f64 }
        };
        let fits = |plane: &Plane| {
            own().all(|&c| {
                stated_within.is_some_and(|most| plane.signed_distance(self.vertices[c]).abs() <= most)
            })
        };
        let stated = region.iter().find_map(|&f| polygons[self.faces[f].polygon].normal);
        stated
            .filter(|n| n.is_finite() && n.length() > 0.0)
            .map(|n| unit(if self.stated_inward { -n } else { n }))
            .filter(|n| !broad || n.dot(area) > 0.0)
            .map(levelled)
            .filter(fits)
            .or_else(|| broad.then(|| levelled(area.normalize())))
    }

    /// Whether the stated normals, weighed by area, point into the mesh.
    fn states_inward(&self, polygons: &[Polygon]) -> bool {
        let finite = |n: DVec3| if n.is_finite() { n.normalize_or_zero() } else { DVec3::ZERO };
        let agreement = |f: &SurfaceFace| polygons[f.polygon].normal.map_or(0.0, |n| finite(n).dot(f.area));
        self.faces.iter().map(agreement).sum::<f64>() < 0.0
    }

    /// Area of a region over its longest extent and the mesh's size: how well its normal is known.
    pub fn narrowness(&self, region: &[usize], size: f64) -> f64 {
        let area = self.area_of(region);
        let (lo, hi) = self
            .points(region)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
        area.length() / (hi - lo).length() / size
    }
}

/// The direction of `n`; a vector that already is a unit to rounding stays as it is, to the bit.
fn unit(n: DVec3) -> DVec3 {
    if (n.length_squared() - 1.0).abs() < 1e-15 { n } else { n.normalize() }
}
