//! Photon guide: aims a share of the photons at the stones.

use super::bsdfs::Bsdf;
use crate::sampling::warps;
use glam::Vec3;
use std::f32::consts::PI;

/// A sphere in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingSphere {
    /// Its centre.
    pub centre: Vec3,
    /// Its radius.
    pub radius: f32,
}

/// Targets of photons.
///
/// Directions are drawn from a mixture of the natural density and one uniform over the cones in
/// which the targets are seen; the weights (balance heuristic: natural density over that of the
/// mixture) keep every mean right.
#[derive(Debug, Clone)]
pub struct PhotonGuide {
    /// Spheres around the stones and what lies near them.
    pub targets: Vec<BoundingSphere>,
    /// Share of photons sent at the targets; 0 if there are none.
    pub share: f32,
    /// Sphere around everything that photons can land on.
    pub world: BoundingSphere,
}

/// A cone in which a target is seen.
struct Cone {
    axis: Vec3,
    cos: f32,
}

impl PhotonGuide {
    /// None for a target that the point lies in.
    fn cone(&self, target: &BoundingSphere, point: Vec3) -> Option<Cone> {
        let to = target.centre - point;
        let sin2 = target.radius * target.radius / to.length_squared();
        (sin2 < 1.0).then(|| Cone { axis: to.normalize(), cos: (1.0 - sin2).sqrt() })
    }

    /// A direction from a surface that shines as the cosine within a cone about its normal, and its
    /// weight. None for one that leaves the cone.
    ///
    /// - `sin2_max`: squared sine of the cone's half-angle, 1 for a diffuse surface
    /// - `pick`, `u`: three uniforms
    pub fn direction(
        &self,
        point: Vec3,
        normal: Vec3,
        sin2_max: f32,
        pick: f32,
        u: [f32; 2],
    ) -> Option<(Vec3, f32)> {
        let natural = || {
            let local = warps::uniform_disc(u) * sin2_max.sqrt();
            warps::to_world(normal, local.extend((1.0 - local.length_squared()).max(0.0).sqrt()))
        };
        let pdf = |direction: Vec3| {
            let cos = direction.dot(normal);
            if cos * cos < 1.0 - sin2_max || cos <= 0.0 { 0.0 } else { cos / (PI * sin2_max) }
        };
        self.mixed(point, natural, pdf, pick, u)
    }

    /// A direction in which a surface scatters light, and its weight. None for one in which it sends none.
    ///
    /// - `normal`, `incoming`: as [`Bsdf`] has them; `pick`, `u`: three uniforms
    pub fn scattered(
        &self,
        bsdf: &dyn Bsdf,
        point: Vec3,
        normal: Vec3,
        incoming: Vec3,
        pick: f32,
        u: [f32; 2],
    ) -> Option<(Vec3, f32)> {
        let natural = || bsdf.sample(normal, incoming, u);
        self.mixed(point, natural, |outgoing| bsdf.pdf(normal, incoming, outgoing), pick, u)
    }

    /// A direction from the mixture of a natural density and the cones of the targets, and its weight.
    ///
    /// - `natural`: a direction of density `pdf`
    fn mixed(
        &self,
        point: Vec3,
        natural: impl Fn() -> Vec3,
        pdf: impl Fn(Vec3) -> f32,
        pick: f32,
        u: [f32; 2],
    ) -> Option<(Vec3, f32)> {
        if self.share == 0.0 {
            return Some((natural(), 1.0));
        }
        let count = self.targets.len();
        let pick = pick / self.share;
        let chosen = (pick < 1.0).then(|| ((pick * count as f32) as usize).min(count - 1));
        let direction = match chosen.map(|i| self.cone(&self.targets[i], point)) {
            Some(Some(cone)) => warps::to_world(cone.axis, warps::uniform_cone(u, cone.cos)),
            _ => natural(),
        };
        let natural = pdf(direction);
        if natural <= 0.0 {
            return None;
        }
        let mut mixed = (1.0 - self.share) * natural;
        for target in &self.targets {
            mixed += self.share / count as f32
                * match self.cone(target, point) {
                    Some(cone) if direction.dot(cone.axis) >= cone.cos => warps::uniform_cone_pdf(cone.cos),
                    Some(_) => 0.0,
                    None => natural,
                };
        }
        Some((direction, natural / mixed))
    }

    /// A ray of a parallel beam from far away, and its area: 1 over the density of the ray on a
    /// plane across the beam.
    ///
    /// - `direction`: of the beam; `pick`, `u`: three uniforms
    pub fn beam(&self, direction: Vec3, pick: f32, u: [f32; 2]) -> (Vec3, f32) {
        let count = self.targets.len();
        let ball = if pick < self.share {
            &self.targets[((pick / self.share * count as f32) as usize).min(count - 1)]
        } else {
            &self.world
        };
        let across = warps::uniform_disc(u) * ball.radius;
        let point = ball.centre + warps::to_world(direction, across.extend(0.0));
        let within = |b: &BoundingSphere| {
            let off = point - b.centre;
            let distance2 = off.length_squared() - off.dot(direction).powi(2);
            if distance2 <= b.radius * b.radius { 1.0 / (PI * b.radius * b.radius) } else { 0.0 }
        };
        let aimed: f32 = self.targets.iter().map(within).sum();
        let density = self.share * aimed / count.max(1) as f32 + (1.0 - self.share) * within(&self.world);
        // back to outside the world
        let start = (point - self.world.centre).dot(direction) + 1.01 * self.world.radius;
        (point - direction * start.max(0.0), 1.0 / density.max(f32::MIN_POSITIVE))
    }

    /// Solid angle of the targets as seen from a point with a normal, each weighted by its cosine; π where
    /// there are no targets. A rough measure of how much a light matters to the stones.
    pub fn pdf(&self, point: Vec3, normal: Vec3) -> f32 {
        if self.share == 0.0 {
            return PI;
        }
        let one = |target: &BoundingSphere| {
            let to = target.centre - point;
            let cos = (normal.dot(to.normalize_or_zero())).max(0.05);
            PI * cos * (target.radius * target.radius / to.length_squared()).min(1.0)
        };
        self.targets.iter().map(one).sum()
    }

    /// Area of the targets across a beam; of the world where there are none.
    pub fn area(&self) -> f32 {
        let one = |b: &BoundingSphere| PI * b.radius * b.radius;
        if self.share == 0.0 { one(&self.world) } else { self.targets.iter().map(one).sum() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};

    /// Weighted directions and beams carry the power that plain ones do, targets or not.
    #[test]
    fn aiming_changes_no_mean() {
        let target = |x: f32| BoundingSphere { centre: Vec3::new(x, 0.0, 3.0), radius: 0.7 };
        let world = BoundingSphere { centre: Vec3::ZERO, radius: 5.0 };
        let aim = PhotonGuide { targets: vec![target(0.0), target(0.9)], share: 0.5, world };
        let mut stream = Stream::new(1, Purpose::TEST, 0);
        let n = 200_000;
        let (mut whole, mut half, mut area) = (0.0f64, 0.0f64, 0.0f64);
        for _ in 0..n {
            let (pick, u) = (stream.unit(), stream.pair());
            if let Some((d, w)) = aim.direction(Vec3::ZERO, Vec3::Z, 1.0, pick, u) {
                whole += f64::from(w);
                half += if d.x > 0.0 { f64::from(w) } else { 0.0 };
            }
            let (origin, a) = aim.beam(Vec3::X, stream.unit(), stream.pair());
            // a strip of the world that cuts both targets
            area += if (2.5..3.2).contains(&origin.z) { f64::from(a) } else { 0.0 };
        }
        assert!((whole / f64::from(n) - 1.0).abs() < 0.01, "{whole}");
        assert!((half / f64::from(n) - 0.5).abs() < 0.01, "{half}");
        // ∫ 2 √(25 − z²) dz from 2.5 to 3.2
        let strip: f64 =
            (0..700).map(|i| 2.0 * (25.0 - (2.5005 + f64::from(i) * 1e-3f64).powi(2)).sqrt() * 1e-3).sum();
        assert!((area / f64::from(n) / strip - 1.0).abs() < 0.02, "{area} {strip}");
    }
}
