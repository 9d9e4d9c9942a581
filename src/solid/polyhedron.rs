//! Half-space intersection: the solid that a list of planes leaves standing.
//!
//! A large box is cut by one plane after the other. Each corner is judged once per cut (inside, on,
//! outside), and all facets around it use that judgement, so the result is a closed surface by
//! construction however the roundings fall.

use super::carving::Carving;
use super::plane::Plane;
use glam::DVec3;

/// A corner nearer to a plane than this, times the largest distance of the planes from the origin,
/// lies on it. Tried in turn until every cut leaves one closed outline: the first is far above the
/// rounding of `f64` and far below what a faceter can cut; planes that were recovered from nine
/// decimals or from `f32` miss their common corners by as much as that, and need the later ones.
/// A smaller value splits corners at which many facets meet, a larger one swallows facets.
const ON_PLANE: [f64; 5] = [1e-10, 1e-9, 1e-8, 1e-7, 1e-6];

/// Half the side of the box that is cut, times the same distance: a stone that reaches further is
/// called open.
const BOX: f64 = 1e4;

/// A stone so many times smaller than the largest distance of its planes is carved again by its own
/// measure.
const SMALL: f64 = 16.0;

/// So many times its own radius a solid may lie from the origin.
const AFAR: f64 = 1e5;

/// A solid of less volume than this, times the cube of its radius, is refused: a needle a thousand
/// times as long as it is wide has more.
const SLIVER: f64 = 1e-7;

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
pub enum Fate {
    /// It bounds the stone; the face's number.
    Facet(usize),
    /// It coincides with an earlier plane, whose number this is.
    Duplicate(usize),
    /// It bounds nothing: the other planes lie further in.
    Redundant,
}

/// A bounded convex solid.
#[derive(Debug, Clone)]
pub struct Polyhedron {
    /// Corner positions, in the unit of the planes.
    pub vertices: Vec<DVec3>,
    /// Facets in the order of their planes.
    pub faces: Vec<Face>,
    /// What became of each given plane.
    pub fates: Vec<Fate>,
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
    Nothing {
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
    Afar {
        /// Radius of the solid.
        radius: f64,
        /// Distance of its centre from the origin.
        distance: f64,
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
    /// The solid `{x : n·x ≤ d for every plane}`.
    ///
    /// - `planes`: in any order, any origin (it need not lie inside), any unit
    ///
    /// Coincident planes merge, planes that bound nothing are dropped; [`Polyhedron::fates`] tells.
    /// Checked in `tests/geometry.rs` (V − E + F = 2, volumes, shuffled and turned planes).
    pub fn from_planes(planes: &[Plane]) -> Result<Self, SolidError> {
        for (plane, p) in planes.iter().enumerate() {
            if !p.normal.is_finite() || !p.distance.is_finite() || (p.normal.length() - 1.0).abs() > 1e-6 {
                return Err(SolidError::NotAPlane { plane, normal: p.normal, distance: p.distance });
            }
        }
        let size = planes.iter().fold(0.0, |m: f64, p| m.max(p.distance.abs())).max(f64::MIN_POSITIVE);
        let solid = Self::resolved(planes, size)?;
        let (centre, radius) = solid.bounding_sphere();
        let distance = centre.length();
        if distance > AFAR * radius {
            return Err(SolidError::Afar { radius, distance });
        }
        if radius * SMALL < size { Self::near(planes, centre, radius) } else { Ok(solid) }
    }

    /// Carved with the least tolerance that leaves every outline closed.
    ///
    /// - `size`: what tolerance and box are measured by
    fn resolved(planes: &[Plane], size: f64) -> Result<Self, SolidError> {
        let mut outcome = Err(SolidError::Degenerate { plane: 0 });
        for on_plane in ON_PLANE {
            outcome = Self::carved(planes, size, on_plane);
            if !matches!(outcome, Err(SolidError::Degenerate { .. })) {
                break;
            }
        }
        outcome
    }

    fn carved(planes: &[Plane], size: f64, on_plane: f64) -> Result<Self, SolidError> {
        let mut cut = Carving::box_of(size * BOX, size * on_plane);
        let mut fates = Vec::with_capacity(planes.len());
        for i in 0..planes.len() {
            fates.push(cut.by(i, planes)?);
        }
        cut.refuse_open(size)?;
        let solid = cut.finish(planes, fates);
        let (volume, cube) = (solid.volume(), solid.bounding_sphere().1.powi(3));
        if volume > SLIVER * cube { Ok(solid) } else { Err(SolidError::Sliver { volume, cube }) }
    }

    /// The solid again, for a stone that is small beside some plane's distance: seen from its own
    /// centre, so that the tolerance is the stone's, and without the planes that lie far beyond it.
    fn near(planes: &[Plane], centre: DVec3, radius: f64) -> Result<Self, SolidError> {
        let reach = 2.0 * radius;
        let (numbers, moved): (Vec<usize>, Vec<Plane>) = planes
            .iter()
            .map(|p| p.moved(-centre))
            .enumerate()
            .filter(|(_, p)| p.distance.abs() <= reach)
            .unzip();
        let mut solid = Self::resolved(&moved, reach)?;
        solid.vertices.iter_mut().for_each(|v| *v += centre);
        solid.faces.iter_mut().for_each(|f| f.plane = numbers[f.plane]);
        let mut fates = vec![Fate::Redundant; planes.len()];
        for (number, fate) in numbers.iter().zip(solid.fates) {
            fates[*number] = if let Fate::Duplicate(of) = fate { Fate::Duplicate(numbers[of]) } else { fate };
        }
        Ok(Self { fates, ..solid })
    }

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
    use crate::math::random::{Purpose, Stream};

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
        let mut stream = Stream::new(1708, Purpose::Pixel, 0);
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
