//! Half-space intersection: the solid that a list of planes leaves standing.
//!
//! A large box is cut by one plane after the other. Each corner is judged once per cut (inside, on,
//! outside), and all facets around it use that judgement, so the result is a closed surface by
//! construction however the roundings fall.

use glam::DVec3;

/// One facet of a polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Which of the given planes it lies in.
    pub plane: usize,
    /// Its corners, counter-clockwise seen from outside.
    pub corners: Vec<usize>,
}

/// What became of a given plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneStatus {
    /// It bounds the stone; the face's number.
    Facet(usize),
    /// It coincides with an earlier plane, whose number this is.
    Duplicate(usize),
    /// It bounds nothing: the other planes lie further in.
    Redundant,
}

/// A bounded convex solid.
///
/// ```
/// use cutlab::glam::DVec3;
/// use cutlab::{Plane, Polyhedron};
///
/// let sides = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
/// let cube = Polyhedron::from_planes(&sides.map(|normal| Plane::new(normal, 1.0))).unwrap();
/// assert!((cube.volume() - 8.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone)]
pub struct Polyhedron {
    /// Corner positions, in the unit of the planes.
    pub vertices: Vec<DVec3>,
    /// Facets in the order of their planes.
    pub faces: Vec<Face>,
    /// What became of each given plane.
    pub plane_status: Vec<PlaneStatus>,
}

/// Planes that bound no solid.
#[derive(Debug, Clone, thiserror::Error, PartialEq)]
pub enum SolidError {
    /// The planes leave a direction open.
    #[error("open: planes {} leave direction ({:.3}, {:.3}, {:.3}) unbounded", list(.planes), .direction.x, .direction.y, .direction.z)]
    Open {
        /// The planes (counted from 0) around the opening.
        planes: Vec<usize>,
        /// A direction in which the solid has no end.
        direction: DVec3,
    },
    /// A plane cuts away all that the planes before it left.
    #[error("nothing is left: plane {plane} cuts away what the planes before it leave")]
    Empty {
        /// The plane's number, from 0.
        plane: usize,
    },
    /// A plane with a coordinate that is not a number, or without direction.
    #[error("plane {plane} is not a plane: normal {normal}, distance {distance}")]
    NotAPlane {
        /// The plane's number, from 0.
        plane: usize,
        /// Its normal as given.
        normal: DVec3,
        /// Its distance as given.
        distance: f64,
    },
    /// A solid so far from the origin that `f64` has too few digits left for its shape.
    #[error(
        "the planes bound a solid of radius {radius:.1e} at {distance:.1e} from the origin, too far to be resolved"
    )]
    TooFarFromOrigin {
        /// Radius of the solid.
        radius: f64,
        /// Distance of its centre from the origin.
        distance: f64,
    },
    /// Planes so far from the origin, or so near, that the cube of their distance is no number.
    #[error("the planes bound a solid of about {size:.1e} in size, beyond 1e±90")]
    Size {
        /// The largest distance of its planes.
        size: f64,
    },
    /// A needle or a film, whose corners `f64` cannot tell apart.
    #[error("the planes bound a sliver: its volume is {:.1e} of the cube of its radius", .volume / .cube)]
    Sliver {
        /// Its volume.
        volume: f64,
        /// The cube of its radius.
        cube: f64,
    },
    /// A cut whose outline did not close: the planes are too nearly degenerate for `f64`.
    #[error("plane {plane} meets the others too nearly degenerately to be resolved")]
    Degenerate {
        /// The plane's number, from 0.
        plane: usize,
    },
}

fn list(planes: &[usize]) -> String {
    let shown: Vec<_> = planes.iter().take(8).map(usize::to_string).collect();
    let more = if planes.len() > 8 { " …" } else { "" };
    format!("{}{more}", shown.join(", "))
}

impl Polyhedron {
    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.faces.iter().map(|f| f.corners.len()).sum::<usize>() / 2
    }

    /// V − E + F, 2 for a closed convex surface.
    pub fn euler(&self) -> i64 {
        self.vertices.len() as i64 - self.edge_count() as i64 + self.faces.len() as i64
    }

    /// The corners of a face as points, counter-clockwise seen from outside.
    pub fn polygon(&self, face: usize) -> impl ExactSizeIterator<Item = DVec3> + Clone + '_ {
        self.faces[face].corners.iter().map(|&v| self.vertices[v])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Plane;
    use crate::sampling::random::{Purpose, Stream};

    /// Sixteen planes through one apex, sixteen through the rim, twice over: the worst that stones
    /// recovered from rounded meshes have.
    #[test]
    fn planes_that_miss_their_common_corners_by_rounding_still_bound_a_solid() {
        let mut planes = vec![Plane::new(DVec3::Z, 0.2)];
        for i in 0..32 {
            let (s, c) = (std::f64::consts::TAU * i as f64 / 32.0).sin_cos();
            planes.push(Plane::new(DVec3::new(s, c, -0.9), 0.5));
            planes.push(Plane::new(DVec3::new(s, c, 0.0), 0.7));
            planes.push(Plane::new(DVec3::new(s, c, 1.1), 0.6));
        }
        let exact = Polyhedron::from_planes(&planes).expect("closed").volume();
        let mut stream = Stream::new(1708, Purpose::named("pixel"), 0);
        for noise in [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7] {
            for _ in 0..50 {
                let mut draw = || (2.0 * stream.unit64() - 1.0) * noise;
                let jolted = |p: &Plane| {
                    Plane::new(p.normal + DVec3::new(draw(), draw(), draw()), p.distance + draw())
                };
                let moved: Vec<_> = planes.iter().map(jolted).collect();
                let solid = Polyhedron::from_planes(&moved).unwrap_or_else(|e| panic!("{noise}: {e}"));
                assert_eq!(solid.euler(), 2, "{noise}");
                assert!((solid.volume() / exact - 1.0).abs() < 100.0 * noise, "{noise}");
            }
        }
    }
}
