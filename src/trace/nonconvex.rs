//! Stones that are not convex: tracing over a bounding-volume tree, in `f64`, one ray at a time.
//!
//! Light that leaves a concavity may meet the stone again. A ray still never branches: a transmitted part
//! that does not meet the stone again leaves it; where both parts meet the stone again, one of them goes on
//! with the power of both, chosen at random in proportion to its share. That conserves power, and sums over
//! many rays have no bias. `tests/library/trace/nonconvex.rs` checks both, and convex stones against
//! [`super::reference`].

use super::reference::{ScalarInteraction, ScalarRay};
use crate::geometry::Plane;
use crate::geometry::triangulation::TriangleMesh;
use crate::optics::fresnel::FresnelCoefficients;
use crate::optics::snell::Snell;
use crate::optics::stokes::Stokes;
use crate::sampling::random::Stream;
use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder};
use obvhs::{BvhBuildParams, ray};
use std::collections::HashMap;

/// Corners of a facet lie in its plane within this, trace units: `f32` in a file passes. A ray that
/// finds a gap of that width between two facets is lost, and counted.
const MAX_OFF_PLANE: f64 = 1e-6;

/// A point within this of a plane or an edge is on it, trace units: some thousand roundings.
const MIN_DISTANCE: f64 = 1e-12;

/// Margin of boxes for the roundings of `f32` in the tree.
const BOX_MARGIN: f32 = 1e-6;

/// A stone of any shape in its trace frame: centred on its box and scaled so that its farthest
/// corner lies at distance 1, as [`super::ConvexStone`] has it.
#[derive(Clone)]
pub struct MeshStone {
    /// Facet planes in the trace frame, normals outward.
    pub planes: Vec<Plane>,
    /// Origin of the trace frame, in the mesh's unit.
    pub centre: DVec3,
    /// Length of one trace unit, in the mesh's unit.
    pub unit: f64,
    triangles: Vec<Triangle>,
    tree: Bvh2,
}

#[derive(Debug, Clone)]
struct Triangle {
    corners: [DVec3; 3],
    facet: usize,
}

/// On which side of the surface a ray is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// In the stone.
    Inside,
    /// In the air.
    Outside,
}

/// A mesh that cannot be traced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// An edge is not run once in each direction.
    #[error("open: the edge between corners {0} and {1} is not shared by two triangles")]
    Open(usize, usize),
    /// The triangles of a face do not lie in one plane.
    #[error("face {0} is not flat")]
    NotFlat(usize),
}

impl MeshStone {
    /// Prepares a closed surface for tracing, triangles counter-clockwise seen from outside.
    pub fn new(mesh: &TriangleMesh) -> Result<MeshStone, MeshError> {
        check_closed(mesh)?;
        let (low, high) = mesh
            .vertices
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)));
        let centre = (low + high) * 0.5;
        let unit = mesh.vertices.iter().map(|v| v.distance(centre)).fold(f64::MIN_POSITIVE, f64::max);
        let triangle = |(corners, facet): (&[usize; 3], &usize)| Triangle {
            corners: corners.map(|c| (mesh.vertices[c] - centre) / unit),
            facet: *facet,
        };
        let triangles: Vec<_> = mesh.triangles.iter().zip(&mesh.faces).map(triangle).collect();
        let planes = planes_of(&triangles)?;
        let boxes: Vec<Aabb> = triangles.iter().map(Triangle::bounds).collect();
        let tree = builder::build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Default::default());
        Ok(MeshStone { planes, centre, unit, triangles, tree })
    }

    /// The facet that a ray meets next, and the distance to it.
    ///
    /// - `point`, `direction` (unit): trace frame; `side`: where the ray is. A ray inside meets
    ///   facets from behind, one outside meets them from before; so it never meets the facet that it
    ///   has just left.
    pub fn next_facet(&self, point: DVec3, direction: DVec3, side: Side) -> Option<(usize, f64)> {
        if !(point.is_finite() && direction.is_finite()) {
            return None;
        }
        let mut best: Option<(usize, f64)> = None;
        let ray = ray::Ray::new_inf(Vec3A::from(point.as_vec3()), Vec3A::from(direction.as_vec3()));
        self.tree.ray_traverse(ray, &mut ray::RayHit::none(), |_, index| {
            let triangle = &self.triangles[self.tree.primitive_indices[index] as usize];
            let plane = &self.planes[triangle.facet];
            let Some(t) = triangle.distance(plane, point, direction, side) else { return f32::INFINITY };
            if best.is_none_or(|(_, least)| t < least) {
                best = Some((triangle.facet, t));
            }
            // boxes farther by a rounding are still searched
            t as f32 + BOX_MARGIN
        });
        best
    }

    /// Facet and corners of each triangle, counter-clockwise seen from outside, trace frame.
    pub fn triangles(&self) -> impl Iterator<Item = (usize, [DVec3; 3])> {
        self.triangles.iter().map(|t| (t.facet, t.corners))
    }

    /// Traces a ray until its power falls below `stop_power`, calling `visit` at every interaction with the
    /// side on which it met the facet; returns the power given up. A ray from outside that misses the
    /// stone gives up all.
    ///
    /// - `ray`: trace frame; `side`: where it starts; `stream`: random numbers
    pub fn trace(
        &self,
        mut ray: ScalarRay,
        mut side: Side,
        stop_power: f64,
        stream: &mut Stream,
        mut visit: impl FnMut(&ScalarInteraction, Side),
    ) -> f64 {
        for _ in 0..super::MAX_BOUNCES {
            if ray.power < stop_power || ray.power <= 0.0 {
                break;
            }
            let Some((facet, distance)) = self.next_facet(ray.point, ray.direction, side) else { break };
            let plane = &self.planes[facet];
            ray.point += ray.direction * distance;
            ray.point -= plane.normal * plane.signed_distance(ray.point);
            let absorbed = if side == Side::Inside { ray.absorb(distance) } else { 0.0 };
            let FresnelSplit { inside, outside, cos_inside, cos_outside } =
                FresnelSplit::new(plane.normal, &ray, side);
            let leaves =
                outside.power > 0.0 && self.next_facet(ray.point, outside.direction, Side::Outside).is_none();
            let interaction = ScalarInteraction {
                facet,
                point: ray.point,
                direction: if leaves { outside.direction } else { DVec3::ZERO },
                power: if leaves { outside.power } else { 0.0 },
                absorbed,
                cos_inside,
                cos_outside,
            };
            visit(&interaction, side);
            let whole = ray.power;
            let goes_outside = !leaves && stream.unit64() * whole < outside.power;
            side = if goes_outside { Side::Outside } else { Side::Inside };
            let mut way = if goes_outside { outside } else { inside };
            if !leaves {
                way = way.with_power(whole);
            }
            ray = ScalarRay { direction: way.direction, power: way.power, stokes: way.stokes, ..ray };
        }
        ray.power
    }
}

/// Reflected or transmitted light at a facet.
struct Branch {
    /// Unit.
    direction: DVec3,
    power: f64,
    stokes: Option<Stokes>,
}

impl Branch {
    /// The same light scaled to `power`.
    fn with_power(self, power: f64) -> Branch {
        let grown = power / self.power;
        Branch { power, stokes: self.stokes.map(|light| Stokes { i: power, ..light.dimmed(grown) }), ..self }
    }
}

/// Both parts of the light at a facet, by the side that they go on in.
struct FresnelSplit {
    inside: Branch,
    outside: Branch,
    cos_inside: f64,
    cos_outside: f64,
}

impl FresnelSplit {
    fn new(normal: DVec3, ray: &ScalarRay, side: Side) -> FresnelSplit {
        let along = ray.direction.dot(normal);
        let cos_i = along.abs().min(1.0);
        let law = Snell::new(cos_i, if side == Side::Inside { ray.index } else { 1.0 / ray.index });
        let facing = FresnelCoefficients::of(&law);
        let refracted = law.refracted(ray.direction.into(), (normal * along.signum()).into());
        let light = ray.stokes.map(|light| light.about_incidence(ray.direction, normal));
        let reflected = light.map(|light| light.reflected(&facing));
        let power = reflected.map_or(ray.power * facing.unpolarised_reflectance(), |light| light.i);
        let mirrored = Branch {
            direction: (ray.direction - 2.0 * along * normal).normalize_or_zero(),
            power,
            stokes: reflected,
        };
        let passed = ray.power - power;
        let through = Branch {
            direction: DVec3::from(refracted).normalize_or_zero(),
            power: passed,
            stokes: light.map(|light| Stokes { i: passed, ..light.transmitted(&facing) }),
        };
        let cos_t = facing.cos_t;
        match side {
            Side::Inside => {
                FresnelSplit { inside: mirrored, outside: through, cos_inside: cos_i, cos_outside: cos_t }
            }
            Side::Outside => {
                FresnelSplit { inside: through, outside: mirrored, cos_inside: cos_t, cos_outside: cos_i }
            }
        }
    }
}

impl Triangle {
    fn area_vector(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a) * 0.5
    }

    fn bounds(&self) -> Aabb {
        let [a, b, c] = self.corners;
        let margin = Vec3A::splat(BOX_MARGIN);
        let corner = |v: DVec3| Vec3A::from(v.as_vec3());
        Aabb::new(corner(a.min(b).min(c)) - margin, corner(a.max(b).max(c)) + margin)
    }

    /// Distance to it along a ray; none if the ray does not come from its side or passes by.
    fn distance(&self, plane: &Plane, point: DVec3, direction: DVec3, side: Side) -> Option<f64> {
        let sign = if side == Side::Inside { 1.0 } else { -1.0 };
        let toward = sign * plane.normal.dot(direction);
        let height = -sign * plane.signed_distance(point);
        if toward <= 0.0 || height < -MIN_DISTANCE {
            return None;
        }
        let t = height.max(0.0) / toward;
        let at = point + direction * t;
        let within = (0..3).all(|i| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % 3]);
            (b - a).cross(at - a).dot(plane.normal) >= -MIN_DISTANCE * (b - a).length()
        });
        within.then_some(t)
    }
}

/// Checks that every edge is run once in each direction.
fn check_closed(mesh: &TriangleMesh) -> Result<(), MeshError> {
    let mut edges: HashMap<(usize, usize), u32> = HashMap::new();
    let runs = || mesh.triangles.iter().flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)]);
    runs().for_each(|edge| *edges.entry(edge).or_default() += 1);
    let once = |edge| edges.get(&edge) == Some(&1);
    match runs().find(|&(a, b)| !once((a, b)) || !once((b, a))) {
        Some((a, b)) => Err(MeshError::Open(a, b)),
        None => Ok(()),
    }
}

/// The plane of each facet, from all its triangles.
fn planes_of(triangles: &[Triangle]) -> Result<Vec<Plane>, MeshError> {
    let count = triangles.iter().map(|t| t.facet + 1).max().unwrap_or(0);
    let mut planes = vec![Plane { normal: DVec3::ZERO, distance: 0.0 }; count];
    triangles.iter().for_each(|t| planes[t.facet].normal += t.area_vector());
    planes.iter_mut().for_each(|p| p.normal = p.normal.normalize_or_zero());
    let (mut sums, mut corners) = (vec![0.0; count], vec![0.0; count]);
    for t in triangles {
        sums[t.facet] += t.corners.iter().map(|c| planes[t.facet].normal.dot(*c)).sum::<f64>();
        corners[t.facet] += 3.0;
    }
    planes.iter_mut().zip(sums.iter().zip(&corners)).for_each(|(p, (sum, n))| p.distance = sum / n);
    let off =
        |t: &&Triangle| !t.corners.iter().all(|c| planes[t.facet].signed_distance(*c).abs() <= MAX_OFF_PLANE);
    match triangles.iter().find(off) {
        Some(t) => Err(MeshError::NotFlat(t.facet)),
        None => Ok(planes),
    }
}
