//! Half-space clipping: a box, less one half-space after the other.

use super::plane::Plane;
use super::polyhedron::{Face, PlaneStatus, Polyhedron, SolidError};
use glam::{DMat3, DVec3};
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

/// Marks a face of the starting box instead of a given plane.
const OF_THE_BOX: usize = usize::MAX;

/// The solid while it is being cut, with buffers that serve every cut.
pub(super) struct HalfSpaceClipper {
    vertices: Vec<DVec3>,
    faces: Vec<Face>,
    on_plane: f64,
    /// For each corner −1 inside the plane of the present cut, 0 on it, 1 outside.
    side: Vec<i8>,
    /// For each face, which sides its corners are on.
    reach: Vec<FaceReach>,
    /// Corners of the face that is being cut.
    kept: Vec<usize>,
    /// For each edge that is cut, by the numbers of its ends, the corner where it is.
    on_cut: HashMap<(usize, usize), usize, BuildHasherDefault<NumberHasher>>,
    rim: Rim,
    /// Corner and plane of each face that has it.
    incidences: Vec<(usize, usize)>,
}

/// Directed edges around a cut.
type Rim = HashSet<(usize, usize), BuildHasherDefault<NumberHasher>>;

/// How many corners of a face are inside a plane, on it and outside.
#[derive(Clone, Copy, Default)]
struct FaceReach {
    inside: u32,
    on: u32,
    outside: u32,
}

/// Hashes numbers of corners, which nobody chooses to collide, by a multiplication (D. Knuth, *The Art of
/// Computer Programming* 3, §6.4).
#[derive(Default)]
struct NumberHasher(u64);

impl Hasher for NumberHasher {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.write_usize(usize::from(*byte)));
    }

    fn write_usize(&mut self, number: usize) {
        self.0 = (self.0.rotate_left(32) ^ number as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn finish(&self) -> u64 {
        self.0.rotate_left(26)
    }
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
        Self {
            vertices,
            faces,
            on_plane,
            side: Vec::new(),
            reach: Vec::new(),
            kept: Vec::new(),
            on_cut: HashMap::default(),
            rim: Rim::default(),
            incidences: Vec::new(),
        }
    }

    /// Judges every corner by a plane, and counts by faces; what all faces together have.
    fn judge(&mut self, plane: &Plane) -> FaceReach {
        let Self { vertices, faces, on_plane, side, reach, .. } = self;
        side.clear();
        // corners that were cut away long ago are judged too, which is quicker than to ask
        side.extend(vertices.iter().map(|v| {
            let h = plane.signed_distance(*v);
            i8::from(h > *on_plane) - i8::from(h < -*on_plane)
        }));
        reach.clear();
        let mut all = FaceReach::default();
        for face in faces {
            let mut of_face = FaceReach::default();
            for &c in &face.corners {
                of_face.inside += u32::from(side[c] < 0);
                of_face.on += u32::from(side[c] == 0);
                of_face.outside += u32::from(side[c] > 0);
            }
            all.inside += of_face.inside;
            all.outside += of_face.outside;
            reach.push(of_face);
        }
        all
    }

    /// Cuts by plane `number` of `planes`.
    pub(super) fn clip(&mut self, number: usize, planes: &[Plane]) -> Result<PlaneStatus, SolidError> {
        let plane = &planes[number];
        let all = self.judge(plane);
        if all.outside == 0 {
            let mut given = self.faces.iter().zip(&self.reach).filter(|(f, _)| f.plane != OF_THE_BOX);
            let twin = given.find(|(_, reach)| reach.inside == 0);
            return Ok(twin.map_or(PlaneStatus::Redundant, |(f, _)| PlaneStatus::Duplicate(f.plane)));
        }
        if all.inside == 0 {
            return Err(SolidError::Empty { plane: number });
        }
        let Self { vertices, faces, side, reach, kept, on_cut, rim, incidences, .. } = self;
        on_cut.clear();
        rim.clear();
        incidences.clear();
        let first = side.len();
        let mut reaches = reach.iter();
        faces.retain_mut(|face| {
            let Some(&FaceReach { inside, on, outside }) = reaches.next() else { return true };
            if inside == 0 {
                return false;
            }
            if outside > 0 {
                kept.clear();
                for (i, &a) in face.corners.iter().enumerate() {
                    let b = face.corners[(i + 1) % face.corners.len()];
                    if side[a] <= 0 {
                        kept.push(a);
                    }
                    if side[a] * side[b] < 0 {
                        let next = vertices.len();
                        let v = *on_cut.entry((a.min(b), a.max(b))).or_insert(next);
                        if v == next {
                            vertices.push(between(plane, vertices[a], vertices[b]));
                        }
                        kept.push(v);
                        incidences.push((v, face.plane));
                    }
                }
                face.corners.clear();
                face.corners.extend_from_slice(kept);
            }
            if outside > 0 || on > 1 {
                let corners = &face.corners;
                let on = |c: usize| c >= first || side[c] == 0;
                for (i, &a) in corners.iter().enumerate() {
                    let b = corners[(i + 1) % corners.len()];
                    // where both neighbours of an edge stay, it is no rim
                    if on(a) && on(b) && !rim.remove(&(a, b)) {
                        rim.insert((b, a));
                    }
                }
            }
            true
        });
        let corners = ring(rim).ok_or(SolidError::Degenerate { plane: number })?;
        incidences.extend(corners.iter().filter(|c| **c >= first).map(|c| (*c, number)));
        faces.push(Face { plane: number, corners });
        self.settle_cut(planes);
        Ok(PlaneStatus::Facet(0)) // the face's number is known at the end
    }

    /// Puts the corners of the last cut onto their planes. A corner cut from an edge that ran to the far box
    /// has that edge's rounding, ten thousand times the stone's own: unsettled, it can miss a plane that
    /// passes through it, and the stone gets two corners in one place.
    fn settle_cut(&mut self, planes: &[Plane]) {
        self.incidences.retain(|(_, plane)| *plane != OF_THE_BOX);
        // those of a corner stay in the order of the faces
        self.incidences.sort_by_key(|(corner, _)| *corner);
        for around in self.incidences.chunk_by(|a, b| a.0 == b.0) {
            let v = &mut self.vertices[around[0].0];
            *v = settle(*v, around.iter().map(|(_, plane)| *plane), planes);
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
        let mut around: Vec<(usize, usize)> =
            self.faces.iter().flat_map(|f| f.corners.iter().map(|c| (*c, f.plane))).collect();
        // those of a corner stay in the order of the faces
        around.sort_by_key(|(corner, _)| *corner);
        let mut place = vec![0..0; self.vertices.len()];
        for (i, (corner, _)) in around.iter().enumerate() {
            let start = if place[*corner].is_empty() { i } else { place[*corner].start };
            place[*corner] = start..i + 1;
        }
        for f in &mut self.faces {
            f.corners.retain(|&c| place[c].len() > 2);
        }
        self.faces.retain(|f| f.corners.len() > 2);
        self.faces.sort_by_key(|f| f.plane);
        let mut number = vec![usize::MAX; self.vertices.len()];
        let mut vertices = Vec::new();
        for f in &mut self.faces {
            for c in &mut f.corners {
                if number[*c] == usize::MAX {
                    number[*c] = vertices.len();
                    let planes_around = around[place[*c].clone()].iter().map(|(_, plane)| *plane);
                    vertices.push(settle(self.vertices[*c], planes_around, planes));
                }
                *c = number[*c];
            }
        }
        let mut face_of = vec![None; planes.len()];
        self.faces.iter().enumerate().for_each(|(i, f)| face_of[f.plane] = Some(i));
        for (status, face) in statuses.iter_mut().zip(face_of) {
            if let PlaneStatus::Facet(_) = status {
                *status = face.map_or(PlaneStatus::Redundant, PlaneStatus::Facet);
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
fn ring(edges: &Rim) -> Option<Vec<usize>> {
    let mut next: Vec<(usize, usize)> = edges.iter().copied().collect();
    next.sort_unstable();
    if next.windows(2).any(|pair| pair[0].0 == pair[1].0) {
        return None;
    }
    let &(start, mut at) = next.first()?;
    let mut corners = Vec::with_capacity(next.len());
    corners.push(start);
    while at != start {
        corners.push(at);
        if corners.len() > next.len() {
            return None;
        }
        at = next[next.binary_search_by_key(&at, |edge| edge.0).ok()?].1;
    }
    (corners.len() == next.len() && corners.len() > 2).then_some(corners)
}

/// Moves a corner by least squares onto the planes that meet in it, undoing the rounding of the
/// cuts; a corner of nearly parallel planes, where that is not determined, stays.
fn settle(p: DVec3, around: impl Iterator<Item = usize>, planes: &[Plane]) -> DVec3 {
    let (mut m, mut rhs) = (DMat3::ZERO, DVec3::ZERO);
    for i in around {
        let n = planes[i].normal;
        m += DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        rhs -= n * planes[i].signed_distance(p);
    }
    if m.determinant() < 1e-12 {
        return p;
    }
    p + m.inverse() * rhs
}
