//! Entry of light into a doubly refracting stone: a lane of a packet is loaded with one wave, and the other waits beside it.

use super::crystal::CrystalOptics;
use super::crystal_lanes::LoadedWave;
use super::packet::{Packet, Refraction};
use super::stone::ConvexStone;
use crate::optics::crystal::facet::Crystal;
use glam::Vec3;

impl ConvexStone {
    /// Loads a lane with what enters of unpolarised light of power 1: one of both waves, chosen by power, with the power of
    /// both; the other is in [`super::CrystalLanes::other`].
    ///
    /// - `facet`, `point` on it, `direction` (unit, from outside): trace frame
    /// - `choice`: uniform in 0..1
    ///
    /// Returns the refraction of the wave that was chosen.
    pub fn enter_crystal(
        &self,
        packet: &mut Packet,
        lane: usize,
        (facet, point): (usize, Vec3),
        direction: Vec3,
        optics: &CrystalOptics,
        choice: f64,
    ) -> Refraction {
        let normal = self.planes[facet].normal;
        let rays = optics.enter(point.as_dvec3(), direction.as_dvec3().normalize(), normal);
        let power = rays[0].power + rays[1].power;
        let share = if power > 0.0 { rays[0].power / power } else { 1.0 };
        let (mode, rest) =
            if choice < share { (0, choice / share) } else { (1, (choice - share) / (1.0 - share)) };
        let [chosen, other] = [&rays[mode], &rays[1 - mode]];
        let ray = chosen.wave.ray.as_vec3();
        if let Crystal::Uniaxial(crystal) = optics.crystal {
            let wave = LoadedWave {
                wave_vector: chosen.wave.k.re.as_vec3(),
                is_extraordinary: mode == 1,
                indices: [crystal.ordinary as f32, crystal.extraordinary as f32],
                choice: rest as f32,
            };
            packet.load_wave(lane, point, ray, power as f32, &wave);
            packet.absorption[lane] = optics.absorption_of(&chosen.wave) as f32;
            if let Some(waves) = &mut packet.waves {
                let along = crystal.axis.dot(optics.absorption * crystal.axis);
                let across = crystal.axis.any_orthonormal_vector();
                let of_o = across.dot(optics.absorption * across) / crystal.ordinary;
                waves.absorption[0][lane] = of_o as f32;
                waves.absorption[1][lane] = (along / crystal.extraordinary) as f32;
                waves.other[lane] = other.power as f32;
                let k = other.wave.k.re.as_vec3();
                (waves.other_kx[lane], waves.other_ky[lane], waves.other_kz[lane]) = k.into();
            }
        }
        Refraction {
            direction: ray,
            reflectance: (1.0 - power) as f32,
            cos_outside: (-direction.dot(self.normals[facet])).clamp(0.0, 1.0),
            cos_inside: (-ray.dot(self.normals[facet])).clamp(0.0, 1.0),
            polarisation: 0.0,
            axis: ray.any_orthonormal_vector(),
        }
    }
}
