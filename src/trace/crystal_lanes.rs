//! Lanes of waves in a uniaxial stone.

use super::lanes::{LANES, Lanes};
use glam::{DVec3, Vec3};

/// What a packet holds besides its rays in a uniaxial stone: for each lane a wave of one mode. The packet's directions are
/// those of the rays, its indices those of ordinary waves.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct CrystalLanes {
    /// Wave vectors, in units of ω/c.
    pub kx: Lanes,
    /// Wave vectors.
    pub ky: Lanes,
    /// Wave vectors.
    pub kz: Lanes,
    /// Refractive index of extraordinary waves across the axis, at the lane's wavelength.
    pub extraordinary: Lanes,
    /// 1 for an extraordinary wave, 0 for an ordinary one.
    pub mode: Lanes,
    /// Uniform in 0..1: it chooses the mode at each facet, stretched after each choice.
    pub choice: Lanes,
    /// Absorption coefficients of ordinary waves and of extraordinary waves across the axis, natural logarithm, per unit of the
    /// stone's frame. [`super::Packet::absorption`] is that of the lane's wave along its ray.
    pub absorption: [Lanes; 2],
    /// Power of the wave of each lane's last facet that was not chosen. It is part of the packet's power.
    pub other: Lanes,
    /// Wave vectors of these waves.
    pub other_kx: Lanes,
    /// Wave vectors of these waves.
    pub other_ky: Lanes,
    /// Wave vectors of these waves.
    pub other_kz: Lanes,
    /// The optic axis, unit, in the stone's frame.
    pub axis: Vec3,
    /// Any unit vector across it.
    pub across: Vec3,
}

/// A wave that a lane is loaded with.
#[derive(Debug, Clone, Copy)]
pub struct LoadedWave {
    /// Its wave vector, in units of ω/c.
    pub wave_vector: Vec3,
    /// Whether it is an extraordinary wave.
    pub is_extraordinary: bool,
    /// Refractive indices of ordinary and, across the axis, extraordinary waves at the lane's wavelength.
    pub indices: [f32; 2],
    /// Uniform in 0..1, for all choices between modes that are to come.
    pub choice: f32,
}

impl CrystalLanes {
    /// Idle lanes of a stone whose optic axis this is.
    pub fn new(axis: DVec3) -> CrystalLanes {
        let zero = [0.0; LANES];
        let axis = axis.as_vec3().normalize();
        CrystalLanes {
            kx: zero,
            ky: zero,
            kz: [1.5; LANES],
            extraordinary: [1.5; LANES],
            mode: zero,
            choice: [0.5; LANES],
            absorption: [zero; 2],
            other: zero,
            other_kx: zero,
            other_ky: zero,
            other_kz: zero,
            axis,
            across: axis.any_orthonormal_vector(),
        }
    }

    /// The ray and the absorption coefficient along it of an ordinary or an extraordinary wave of a lane.
    ///
    /// - `index`: of ordinary waves at the lane's wavelength
    pub fn ray_of(&self, lane: usize, index: f32, wave_vector: Vec3, is_extraordinary: bool) -> (Vec3, f32) {
        let [of_o, of_e] = [self.absorption[0][lane], self.absorption[1][lane]];
        if !is_extraordinary {
            return (wave_vector.normalize(), of_o);
        }
        let (o2, e2) = (index * index, self.extraordinary[lane] * self.extraordinary[lane]);
        let along = wave_vector.dot(self.axis);
        let ray = (wave_vector + self.axis * ((e2 - o2) * along / o2)).normalize();
        let cos2 = along * along / wave_vector.length_squared();
        let weights = of_o * cos2 / (o2 * index) + of_e * (1.0 - cos2) / (e2 * self.extraordinary[lane]);
        (ray, wave_vector.length_squared() * weights * wave_vector.dot(ray))
    }

    /// The wave vector of a lane.
    pub fn wave_vector(&self, lane: usize) -> Vec3 {
        Vec3::new(self.kx[lane], self.ky[lane], self.kz[lane])
    }
}
