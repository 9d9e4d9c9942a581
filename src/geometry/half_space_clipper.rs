//! Half-space clipping: a box, less one half-space after the other.

use super::plane::Plane;
use super::polyhedron::{Face, PlaneStatus, Polyhedron, SolidError};
use glam::{DMat3, DVec3};
use std::collections::{HashMap, HashSet};

/// Marks a face of the starting box instead of a given plane.
const OF_THE_BOX: usize = usize::MAX;

/// The side of a corner of no face.
const UNJUDGED: i8 = 2;

/// The solid while it is being cut.
pub(super) struct HalfSpaceClipper {
    vertices: Vec<DVec3>,
    faces: Vec<Face>,
    on_plane: f64,
}

impl HalfSpaceClipper {
    pub(super) fn new_box(half: f64, on_plane: f64) -> Self {
        let vertices = (0..8)
            .map(|i| {
                let side = |bit: usize| if i >> bit & 1 == 1 { half } else { -half };
                DVec3::new(side(0), side(1), side(2))
            })
            .collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
            .map(|c| Face { plane: OF_THE_BOX, corners: c.to_vec() })
            .to_vec();
        Self { vertices, faces, on_plane }
    }

    /// Cuts by plane `number` of `planes`.
    pub(super) fn clip(&mut self, number: usize, planes: &[Plane]) -> Result<PlaneStatus, SolidError> {
        let plane = &planes[number];
        // of corners that were cut away long ago nothing is asked
        let mut side = vec![UNJUDGED; self.vertices.len()];
        for &c in self.faces.iter().flat_map(|f| &f.corners) {
            if side[c] == UNJUDGED {
                let h = plane.signed_distance(self.vertices[c]);
                side[c] = if h.abs() <= self.on_plane { 0 } else { h.signum() as i8 };
            }
        }
        let used = || self.faces.iter().flat_map(|f| f.corners.iter().map(|&c| side[c]));
        if !used().any(|s| s > 0) {
            let mut given = self.faces.iter().filter(|f| f.plane != OF_THE_BOX);
            let twin = given.find(|f| f.corners.iter().all(|&c| side[c] == 0));
            return Ok(twin.map_or(PlaneStatus::Redundant, |f| PlaneStatus::Duplicate(f.plane)));
        }
        if !used().any(|s| s < 0) {
            return Err(SolidError::Empty { plane: number });
        }
        let mut on_cut: HashMap<(usize, usize), usize> = HashMap::new();
        let mut rim: HashSet<(usize, usize)> = HashSet::new();
        let faces = std::mem::take(&mut self.faces);
        for face in faces {
            if !face.corners.iter().any(|&c| side[c] < 0) {
                continue;
            }
            let mut kept = Vec::with_capacity(face.corners.len() + 1);
            for (i, &a) in face.corners.iter().enumerate() {
                let b = face.corners[(i + 1) % face.corners.len()];
                if side[a] <= 0 {
                    kept.push(a);
                }
                if side[a] * side[b] < 0 {
                    let next = self.vertices.len();
                    let v = *on_cut.entry((a.min(b), a.max(b))).or_insert(next);
                    if v == next {
                        self.vertices.push(between(plane, self.vertices[a], self.vertices[b]));
                    }
                    kept.push(v);
                }
            }
            let on = |c: usize| c >= side.len() || side[c] == 0;
            for (i, &a) in kept.iter().enumerate() {
                let b = kept[(i + 1) % kept.len()];
                // where both neighbours of an edge stay, it is no rim
                if on(a) && on(b) && !rim.remove(&(a, b)) {
                    rim.insert((b, a));
                }
            }
            self.faces.push(Face { plane: face.plane, corners: kept });
        }
        let corners = ring(&rim).ok_or(SolidError::Degenerate { plane: number })?;
        self.faces.push(Face { plane: number, corners });
        self.settle_from(side.len(), planes);
        Ok(PlaneStatus::Facet(0)) // the face's number is known at the end
    }

    /// Puts the corners from number `first` on onto their planes. A corner cut from an edge that
    /// ran to the far box has that edge's rounding, ten thousand times the stone's own: unsettled,
    /// it can miss a plane that passes through it, and the stone gets two corners in one place.
    fn settle_from(&mut self, first: usize, planes: &[Plane]) {
        let mut around = vec![Vec::new(); self.vertices.len() - first];
        for f in self.faces.iter().filter(|f| f.plane != OF_THE_BOX) {
            f.corners.iter().filter(|c| **c >= first).for_each(|&c| around[c - first].push(f.plane));
        }
        for (v, around) in self.vertices[first..].iter_mut().zip(&around) {
            *v = settle(*v, around, planes);
        }
    }

    /// Refuses what has a corner beyond `reach` from the origin, as all of the box are.
    pub(super) fn check_bounded(&self, reach: f64) -> Result<(), SolidError> {
        let is_far = |v: &usize| self.vertices[*v].length() > reach;
        let far: Vec<usize> =
            self.faces.iter().flat_map(|f| f.corners.iter().copied()).filter(is_far).collect();
        if far.is_empty() {
            return Ok(());
        }
        let direction = far.iter().map(|&v| self.vertices[v] / reach).sum::<DVec3>();
        let mut planes: Vec<usize> = self
            .faces
            .iter()
            .filter(|f| f.plane != OF_THE_BOX && f.corners.iter().any(is_far))
            .map(|f| f.plane)
            .collect();
        planes.sort_unstable();
        Err(SolidError::Open { planes, direction: direction.normalize_or(DVec3::Z) })
    }

    /// Drops what is no corner any more, puts every corner on its planes, numbers the faces.
    pub(super) fn finish(mut self, planes: &[Plane], mut statuses: Vec<PlaneStatus>) -> Polyhedron {
        let mut around = vec![Vec::new(); self.vertices.len()];
        for f in &self.faces {
            f.corners.iter().for_each(|&c| around[c].push(f.plane));
        }
        for f in &mut self.faces {
            f.corners.retain(|&c| around[c].len() > 2);
        }
        self.faces.retain(|f| f.corners.len() > 2);
        self.faces.sort_by_key(|f| f.plane);
        let mut number = vec![usize::MAX; self.vertices.len()];
        let mut vertices = Vec::new();
        for f in &mut self.faces {
            for c in &mut f.corners {
                if number[*c] == usize::MAX {
                    number[*c] = vertices.len();
                    vertices.push(settle(self.vertices[*c], &around[*c], planes));
                }
                *c = number[*c];
            }
        }
        let mut face_of = HashMap::new();
        self.faces.iter().enumerate().for_each(|(i, f)| {
            face_of.insert(f.plane, i);
        });
        for (i, status) in statuses.iter_mut().enumerate() {
            if let PlaneStatus::Facet(_) = status {
                *status = face_of.get(&i).map_or(PlaneStatus::Redundant, |&f| PlaneStatus::Facet(f));
            }
        }
        Polyhedron { vertices, faces: self.faces, plane_status: statuses }
    }
}

/// Where the edge from `a` to `b` passes the plane.
fn between(plane: &Plane, a: DVec3, b: DVec3) -> DVec3 {
    let (ha, hb) = (plane.signed_distance(a), plane.signed_distance(b));
    a + (b - a) * (ha / (ha - hb))
}

/// Chains directed edges into one closed ring; none if they do not form one.
fn ring(edges: &HashSet<(usize, usize)>) -> Option<Vec<usize>> {
    let next: HashMap<usize, usize> = edges.iter().copied().collect();
    if next.len() < edges.len() {
        return None;
    }
    let start = *next.keys().min()?;
    let mut corners = vec![start];
    let mut at = next[&start];
    while at != start {
        corners.push(at);
        if corners.len() > next.len() {
            return None;
        }
        at = *next.get(&at)?;
    }
    (corners.len() == next.len() && corners.len() > 2).then_some(corners)
}

/// Moves a corner by least squares onto the planes that meet in it, undoing the rounding of the
/// cuts; a corner of nearly parallel planes, where that is not determined, stays.
fn settle(p: DVec3, around: &[usize], planes: &[Plane]) -> DVec3 {
    let (mut m, mut rhs) = (DMat3::ZERO, DVec3::ZERO);
    for &i in around {
        let n = planes[i].normal;
        m += DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        rhs -= n * planes[i].signed_distance(p);
    }
    if m.determinant() < 1e-12 {
        return p;
    }
    p + m.inverse() * rhs
}
