//! Facet recovery, from a mesh back to facets: weld, orient, merge coplanar polygons, classify.
//!
//! A mesh file stores corners that were rounded (to `f32`, to six decimals) and facets cut into
//! triangles. What comes out are the planes that the stone was cut by, and whether the mesh was
//! a closed convex surface at all.

use super::closed_mesh::ClosedMesh;
use super::plane::Plane;
pub use super::polygon::{Polygon, Stored};
use super::polyhedron::{Polyhedron, SolidError};
use super::welded_surface::WeldedSurface;
use super::welding::weld;
use crate::limits::{self, Exceeded, Limits};
use glam::DVec3;

/// Corners of one facet lie in one plane within so many roundings of a stored coordinate: three coordinates of
/// a corner, and the plane's own.
const ROUNDINGS: f64 = 4.0;

/// Distances below which two corners are one, in parts of the mesh's diagonal, however exactly they are
/// stored: the least, which is above the rounding of `f64` in what was computed to be the same, and the
/// most. Between them the distance grows until the surface closes: starting coarser would swallow the short
/// edges of a finely written mesh.
const WELD: [f64; 2] = [1e-9, 1e-4];

/// Heights within which the corners of two neighbours are coplanar, in parts of the mesh's diagonal,
/// however exactly they are stored. The least is what programs that write for readers in `f32` move corners
/// by; the most is 5 µm on a stone of 6.5 mm. Between them the height grows until the facets make a convex solid of the
/// mesh's volume: so the noise of a scan is found where it is more than the roundings.
const COPLANAR: [f64; 2] = [3e-7, 5e-4];

/// From one try to the next a weld grows by this.
const WELD_STEP: f64 = 32.0;

/// From one try to the next a height grows by this: with more, the first that is above the noise may bend
/// narrow facets into their neighbours.
const COPLANAR_STEP: f64 = 2.0;

/// What stands out so many times the coarsest height above a facet's plane is not noise but a concavity.
const MAX_NONCONVEXITY: f64 = 10.0;

/// Stated normals must fit the corners within this part of the mesh's diagonal at the best: well above the
/// rounding of `f64`.
const MAX_MISFIT: f64 = 1e-11;

/// A corner may stand out of a facet's plane by the coplanar tolerance, or by this part of it over
/// the facet's narrowness if that is more: the roundings that the tolerance is meant for are a few
/// times smaller than it is.
const MAX_TRUSTED_TOLERANCE: f64 = 0.25;

/// Relative difference of volume, in parts of the coplanar tolerance, that rounding can make
/// between a mesh and the solid of its planes.
const VOLUME_SLACK: f64 = 30.0;

/// What a mesh was found to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Recovered {
    /// Name and plane of each facet, in the order of the polygons.
    pub facets: Vec<(String, Plane)>,
    /// Number of corners that lie on edges of other polygons, which are divided on one side only.
    pub divided_edges: usize,
    /// Number of edges that are not shared by exactly two polygons.
    pub open_edges: usize,
    /// Whether no corner stands out of any facet's plane.
    pub convex: bool,
    /// How far the farthest corner stands out of a facet's plane, in parts of the diagonal.
    pub max_protrusion: f64,
    /// Volume enclosed by the polygons as given, in the mesh's unit cubed; 0 if not closed.
    pub volume: f64,
    /// The coplanar tolerance that was needed, in parts of the mesh's diagonal.
    pub tolerance: f64,
    /// Whether the facets make a stone: closed, convex, in one piece and of the mesh's volume.
    verdict: Result<(), RecoverError>,
    /// The surface, where it is closed but no convex stone.
    mesh: Option<Box<ClosedMesh>>,
}

/// A mesh of which no convex stone can be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecoverError {
    /// No polygon with an area.
    #[error("the mesh has no face with an area")]
    Empty,
    /// More faces or facets than are read.
    #[error(transparent)]
    Limit(#[from] Exceeded),
    /// A polygon with a corner that is not there.
    #[error("face {polygon} names corner {corner} of {vertices} (both counted from 0)")]
    NoCorner {
        /// The polygon, from 0.
        polygon: usize,
        /// The corner it names, from 0.
        corner: usize,
        /// How many there are.
        vertices: usize,
    },
    /// A corner that is not a finite point.
    #[error("corner {0} (from 0) is not a finite point")]
    NotFinite(usize),
    /// A surface with an edge.
    #[error("the mesh is open: {0} edges are not shared by exactly two faces; only closed meshes are read")]
    Open(usize),
    /// Several surfaces.
    #[error("the mesh holds {0} separate closed surfaces: it is a mesh, not one convex stone")]
    Shells(usize),
    /// A concavity: how far the farthest corner stands out of a facet's plane, in parts of the diagonal.
    #[error(
        "the mesh is not convex: a corner stands out of a facet's plane by {0:.1e} of its size; it is a mesh, not a convex stone"
    )]
    NotConvex(f64),
    /// The planes leave another solid than the mesh.
    #[error("the facet planes enclose a volume of {planes}, the mesh one of {mesh}")]
    Volume {
        /// Volume of the half-space intersection.
        planes: f64,
        /// Volume of the mesh.
        mesh: f64,
    },
    /// The planes bound no solid.
    #[error("the facet planes bound no solid: {0}")]
    Solid(#[from] SolidError),
}

/// Finds the facets of a mesh.
///
/// - `vertices`: in any unit
/// - `stored`: how exactly. What counts as one corner and as one plane follows from it. A stated normal is
///   taken if it is known better than the facet's corners tell it, and if these lie in its plane; otherwise
///   the normal is the area-weighted mean of the merged polygons
///
/// Corners are welded, corners on edges made corners of both sides, faces without three different corners
/// dropped, windings made consistent and outward, coplanar neighbours merged unless both have names and
/// stated normals and differ in both. A mesh that is open or not convex comes back with its flags saying so;
/// [`Recovered::into_facets`] turns those into errors. Checked in this file's tests, in `tests/library/formats.rs` and
/// on real designs in `tests/program/corpus.rs`.
pub fn facets_of_polygons(
    vertices: &[DVec3],
    polygons: &[Polygon],
    stored: Stored,
    limits: Limits,
) -> Result<Recovered, RecoverError> {
    limits.check_all(&limits::POLYGONS, polygons.len())?;
    for (polygon, p) in polygons.iter().enumerate() {
        if let Some(&corner) = p.corners.iter().find(|&&c| c >= vertices.len()) {
            return Err(RecoverError::NoCorner { polygon, corner, vertices: vertices.len() });
        }
        if let Some(&c) = p.corners.iter().find(|&&c| !vertices[c].is_finite()) {
            return Err(RecoverError::NotFinite(c));
        }
    }
    let used = || polygons.iter().flat_map(|p| p.corners.iter().map(|&c| vertices[c]));
    let (lo, hi) = used().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
    let size = (hi - lo).length();
    if !(size > 0.0 && size.is_finite()) {
        return Err(RecoverError::Empty);
    }
    let rounding = ROUNDINGS * stored.corner / size;
    let mut surface = WeldedSurface::default();
    for within in steps(WELD[0].max(rounding), WELD_STEP, WELD[1]) {
        surface = WeldedSurface::new(
            vertices,
            polygons,
            &weld(vertices, 0..vertices.len(), (lo, hi), within * size),
        );
        if surface.open_edges > 0 {
            surface = surface.with_corners_on_edges(polygons, COPLANAR[0].max(rounding) * size);
        }
        if surface.open_edges == 0 {
            break;
        }
    }
    if surface.faces.is_empty() {
        return Err(RecoverError::Empty);
    }
    let judged = |tolerance| classify(&surface, polygons, tolerance, stored, size, limits);
    let finest = COPLANAR[0].max(rounding);
    let first = judged(finest);
    match &first {
        Ok(found) if !found.is_worth_another_try() => return first,
        // of noise no stone is made, but a stone may have that many facets
        Err(_) if surface.is_convex_at_edges(finest * size) => return first,
        _ => {}
    }
    let coarsest = judged(COPLANAR[1].max(finest));
    if coarsest
        .as_ref()
        .is_ok_and(|c| c.is_worth_another_try() && c.max_protrusion > MAX_NONCONVEXITY * COPLANAR[1])
    {
        return first.or(coarsest);
    }
    // what is no stone at any height is handed out by the finest
    let mut best = first;
    for tolerance in steps(finest, COPLANAR_STEP, COPLANAR[1]).skip(1) {
        let found = judged(tolerance);
        if found.as_ref().is_ok_and(|f| f.verdict.is_ok()) {
            return found;
        }
        best = match (best, found) {
            (Ok(best), Ok(found)) => Ok(best.with_protrusion_at_most(found.max_protrusion)),
            (best, found) => best.or(found),
        };
    }
    best
}

/// From `first` on, by factors, up to the most.
fn steps(first: f64, factor: f64, most: f64) -> impl Iterator<Item = f64> {
    let below = std::iter::successors(Some(first), move |t| Some(t * factor)).take_while(move |t| *t < most);
    below.chain([most.max(first)])
}

fn classify(
    surface: &WeldedSurface,
    polygons: &[Polygon],
    tolerance: f64,
    stored: Stored,
    size: f64,
    limits: Limits,
) -> Result<Recovered, RecoverError> {
    let regions = surface.regions(polygons, tolerance * size);
    let is_solid = surface.shells == 1 && surface.open_edges == 0;
    if is_solid {
        limits.check_all(&limits::FACETS, regions.len())?;
    }
    let mut facets = Vec::with_capacity(regions.len());
    let (mut stands_out, mut convex) = (0.0f64, is_solid);
    let corners = surface.corners();
    for region in regions.iter().filter(|_| is_solid) {
        // a facet narrower than the tolerance has no plane of its own: what it cuts off is smaller
        // than the tolerance, and its normal is noise
        let narrowness = surface.narrowness(region, size);
        // a stated normal that is known no better than the corners tell it is not needed
        let known = stored.normal * narrowness * size <= 2.0 * stored.corner.max(MAX_MISFIT * size);
        let within = (ROUNDINGS * stored.corner + 2.0 * stored.normal * size).max(MAX_MISFIT * size);
        let Some(plane) = surface.plane(region, polygons, known.then_some(within), narrowness > tolerance)
        else {
            continue;
        };
        let out = corners.iter().map(|&v| plane.signed_distance(v)).fold(0.0, f64::max) / size;
        // a narrow facet's normal is uncertain in proportion to its narrowness, and so is what
        // stands out of its plane
        let doubt = (MAX_TRUSTED_TOLERANCE / narrowness).max(1.0);
        convex &= out <= tolerance * doubt;
        stands_out = stands_out.max(out);
        facets.push((name_of(surface, polygons, region), plane));
    }
    let volume = if surface.open_edges == 0 { surface.volume() } else { 0.0 };
    let verdict = match (surface.open_edges, surface.shells, convex) {
        (1.., ..) => Err(RecoverError::Open(surface.open_edges)),
        (_, 2.., _) => Err(RecoverError::Shells(surface.shells)),
        (_, _, false) => Err(RecoverError::NotConvex(stands_out)),
        _ => check_encloses(&facets, volume, tolerance),
    };
    let is_closed_mesh = matches!(verdict, Err(RecoverError::Shells(_) | RecoverError::NotConvex(_)));
    let mesh = is_closed_mesh.then(|| Box::new(surface.body(polygons, &regions, stands_out, size)));
    let divided_edges = surface.divided_edges;
    Ok(Recovered {
        facets,
        divided_edges,
        open_edges: surface.open_edges,
        convex,
        max_protrusion: stands_out,
        volume,
        tolerance,
        verdict,
        mesh,
    })
}

/// The first name among a region's polygons.
pub(super) fn name_of(surface: &WeldedSurface, polygons: &[Polygon], region: &[usize]) -> String {
    let names = region.iter().map(|&f| &polygons[surface.faces[f].polygon].name);
    names.into_iter().find(|n| !n.is_empty()).map_or_else(String::new, |n| n.to_string())
}

/// Checks that the planes enclose the mesh's volume.
fn check_encloses(facets: &[(String, Plane)], mesh: f64, tolerance: f64) -> Result<(), RecoverError> {
    let planes: Vec<_> = facets.iter().map(|(_, p)| *p).collect();
    let volume = Polyhedron::from_planes(&planes)?.volume();
    if (volume - mesh).abs() <= VOLUME_SLACK * tolerance * mesh {
        Ok(())
    } else {
        Err(RecoverError::Volume { planes: volume, mesh })
    }
}

impl Recovered {
    /// Whether every edge is shared by two polygons.
    pub fn closed(&self) -> bool {
        self.open_edges == 0
    }

    /// Whether a coarser look may make a stone of it.
    fn is_worth_another_try(&self) -> bool {
        !matches!(self.verdict, Ok(()) | Err(RecoverError::Open(_) | RecoverError::Shells(_)))
    }

    /// The same, of which no corner stands out further than that.
    fn with_protrusion_at_most(mut self, most: f64) -> Recovered {
        self.max_protrusion = self.max_protrusion.min(most);
        if let (Err(RecoverError::NotConvex(protrusion)), Some(mesh)) = (&mut self.verdict, &mut self.mesh) {
            (*protrusion, mesh.max_protrusion) = (self.max_protrusion, self.max_protrusion);
        }
        self
    }

    /// The surface where it is closed but has concavities or comes in several parts; taken out.
    pub fn take_mesh(&mut self) -> Option<ClosedMesh> {
        self.mesh.take().map(|mesh| *mesh)
    }

    /// The facets, if the mesh is one closed convex surface whose planes enclose its volume.
    pub fn into_facets(self) -> Result<Vec<(String, Plane)>, RecoverError> {
        self.verdict.map(|()| self.facets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit cube as twelve triangles, `wind` deciding which are turned round.
    fn cube(wind: impl Fn(usize) -> bool) -> (Vec<DVec3>, Vec<Polygon>) {
        let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|s| [[s[0], s[1], s[2]], [s[0], s[2], s[3]]]);
        let polygon = |(i, mut c): (usize, [usize; 3])| {
            if wind(i) {
                c.reverse();
            }
            Polygon { name: format!("side {}", i / 2).into(), corners: c.to_vec(), normal: None }
        };
        ((0..8).map(corner).collect(), triangles.enumerate().map(polygon).collect())
    }

    #[test]
    fn triangles_of_any_winding_become_named_outward_facets() {
        for wind in [|_: usize| false, |_| true, |i| i % 3 == 0] {
            let (vertices, polygons) = cube(wind);
            let found =
                facets_of_polygons(&vertices, &polygons, Stored::EXACT, Limits::default()).expect("a mesh");
            assert!(found.closed() && found.convex && (found.volume - 1.0).abs() < 1e-15);
            let facets = found.into_facets().expect("a stone");
            assert_eq!(facets.len(), 6);
            for (i, (name, plane)) in facets.iter().enumerate() {
                assert_eq!(*name, format!("side {i}"));
                assert!(plane.signed_distance(DVec3::splat(0.5)) < -0.49);
            }
        }
    }

    #[test]
    fn open_and_nonconvex_meshes_say_so() {
        let (mut vertices, mut polygons) = cube(|_| false);
        polygons.pop();
        let found =
            facets_of_polygons(&vertices, &polygons, Stored::EXACT, Limits::default()).expect("a mesh");
        assert!(!found.closed() && !found.convex);
        assert_eq!(found.into_facets(), Err(RecoverError::Open(3)));
        vertices[7] = DVec3::splat(0.4);
        let found = facets_of_polygons(&vertices, &cube(|_| false).1, Stored::EXACT, Limits::default())
            .expect("a mesh");
        assert!(found.closed() && !found.convex);
        assert!(matches!(found.into_facets(), Err(RecoverError::NotConvex(_))));
    }

    #[test]
    fn corners_that_are_not_there_are_errors() {
        let (vertices, polygons) = cube(|_| false);
        let error = facets_of_polygons(&vertices[..7], &polygons, Stored::EXACT, Limits::default())
            .expect_err("a corner is missing");
        assert_eq!(error, RecoverError::NoCorner { polygon: 2, corner: 7, vertices: 7 });
        assert_eq!(
            facets_of_polygons(&vertices, &[], Stored::EXACT, Limits::default()),
            Err(RecoverError::Empty)
        );
    }
}
