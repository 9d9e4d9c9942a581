//! Reference tracer in `f64`, one ray at a time, written for reading: the oracle of the packet kernel.

use crate::geometry::Plane;
use crate::optics::fresnel::FresnelCoefficients;
use crate::optics::snell::Snell;
use crate::optics::stokes::Stokes;
use glam::DVec3;

/// A ray inside a stone.
#[derive(Debug, Clone, Copy)]
pub struct ScalarRay {
    /// Position, in the frame of the planes.
    pub point: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    /// Power still inside.
    pub power: f64,
    /// Refractive index of the stone at the ray's wavelength.
    pub index: f64,
    /// Absorption coefficient of the stone at the ray's wavelength, natural logarithm, per unit of
    /// length.
    pub absorption: f64,
    /// Stokes vector (its power is `power`); none to take light as unpolarised at every facet.
    pub stokes: Option<Stokes>,
}

impl ScalarRay {
    /// Absorbs over `distance` by Beer–Lambert; returns the power absorbed.
    pub(super) fn absorb(&mut self, distance: f64) -> f64 {
        let (before, left) = (self.power, (-self.absorption * distance).exp());
        self.power *= left;
        self.stokes = self.stokes.map(|light| light.dimmed(left));
        before - self.power
    }
}

/// Interaction of a ray with a facet: what leaves the stone there.
#[derive(Debug, Clone, Copy)]
pub struct ScalarInteraction {
    /// The facet's number.
    pub facet: usize,
    /// Point of the facet, in the frame of the planes.
    pub point: DVec3,
    /// Unit direction outside; the zero vector at total reflection.
    pub direction: DVec3,
    /// Power that left; 0 at total reflection.
    pub power: f64,
    /// Power absorbed on the way there.
    pub absorbed: f64,
    /// Cosine of the ray with the facet normal, inside.
    pub cos_inside: f64,
    /// Cosine outside; 0 at total reflection.
    pub cos_outside: f64,
}

/// The facet that a ray meets next, and the distance to it: the least positive (dᵢ − nᵢ·x)/(nᵢ·d)
/// over facets that the ray heads for. None only for a direction that is not a number.
pub fn next_facet(planes: &[Plane], point: DVec3, direction: DVec3) -> Option<(usize, f64)> {
    let mut best = None;
    for (i, plane) in planes.iter().enumerate() {
        let toward = plane.normal.dot(direction);
        if toward > 0.0 {
            let distance = (-plane.signed_distance(point)).max(0.0) / toward;
            if best.is_none_or(|(_, d)| distance < d) {
                best = Some((i, distance));
            }
        }
    }
    best
}

/// Traces a ray until its power falls below `stop_power`, calling `visit` at every interaction; returns
/// the power given up.
pub fn trace(
    planes: &[Plane],
    mut ray: ScalarRay,
    stop_power: f64,
    mut visit: impl FnMut(&ScalarInteraction),
) -> f64 {
    for _ in 0..super::MAX_BOUNCES {
        if ray.power < stop_power || ray.power <= 0.0 {
            break;
        }
        let Some((facet, distance)) = next_facet(planes, ray.point, ray.direction) else { break };
        let normal = planes[facet].normal;
        ray.point += ray.direction * distance;
        ray.point -= normal * planes[facet].signed_distance(ray.point);
        let absorbed = ray.absorb(distance);
        let cos_inside = ray.direction.dot(normal).clamp(0.0, 1.0);
        let law = Snell::new(cos_inside, ray.index);
        let facing = FresnelCoefficients::of(&law);
        let cos_outside = facing.cos_t;
        ray.stokes = ray.stokes.map(|light| light.about_incidence(ray.direction, normal).reflected(&facing));
        let kept = ray.stokes.map_or(ray.power * facing.unpolarised_reflectance(), |light| light.i);
        let direction = if cos_outside > 0.0 {
            law.refracted(ray.direction.into(), normal.into()).into()
        } else {
            DVec3::ZERO
        };
        let power = ray.power - kept;
        visit(&ScalarInteraction {
            facet,
            point: ray.point,
            direction,
            power,
            absorbed,
            cos_inside,
            cos_outside,
        });
        ray.power = kept;
        ray.direction = (ray.direction - 2.0 * cos_inside * normal).normalize();
    }
    ray.power
}
