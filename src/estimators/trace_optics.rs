//! Optics of a stone as estimators trace it; errors of stones that cannot be lit.

use crate::materials::Material;
use crate::optics::crystal::facet::Crystal;
use crate::trace::crystal::CrystalOptics;
use crate::trace::{ConvexStone, Packet, Refraction};
use glam::{DVec3, Vec3};

/// Wavelengths that go together through one point of a stone that absorbs, where the brightness of
/// the point counts: as many as a picture's.
pub(super) const LINES_PER_RAY: usize = 8;

/// A ray with less than this share of its light is given up, unless less is asked for. A smaller value
/// costs time, a larger one accuracy: at this one 3e-5 of a round brilliant's light is given up. In a stone
/// that absorbs the share is of what has come out
/// ([`crate::trace::lane_scheduler::RayClient::stops_by_emitted_power`]).
pub const STOP_POWER: f32 = 1e-4;

/// What a stone is made of, and how light is followed in it. A stone of a material that absorbs is in
/// millimetres: its size matters.
#[derive(Debug, Clone, Copy)]
pub struct TraceOptics<'a> {
    /// The material.
    pub material: &'a Material,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at
    /// each (scalar Fresnel).
    pub polarised: bool,
}

/// A stone's optics at one wavelength.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LineOptics {
    pub(super) index: f32,
    /// Absorption coefficient per trace unit.
    pub(super) absorption: f32,
    /// The same of a doubly refracting stone, mode by mode; none of another.
    pub(super) crystal: Option<CrystalOptics>,
}

impl LineOptics {
    pub(super) fn absorbs(&self) -> bool {
        self.absorption > 0.0 || self.crystal.is_some_and(|crystal| crystal.absorption != glam::DMat3::ZERO)
    }

    /// The optic axis of a uniaxial stone.
    pub(super) fn optic_axis(&self) -> Option<DVec3> {
        match self.crystal?.crystal {
            Crystal::Uniaxial(crystal) => Some(crystal.axis),
            Crystal::Biaxial(_) => None,
        }
    }

    /// Loads a lane with what enters of unpolarised light of power 1; returns its refraction.
    ///
    /// - `facet`, `point` on it, `direction` (unit, from outside): trace frame
    /// - `choice`: uniform in 0..1, for the modes of a stone that refracts doubly
    pub(super) fn enter(
        self,
        packet: &mut Packet,
        lane: usize,
        stone: &ConvexStone,
        (facet, point): (usize, Vec3),
        direction: Vec3,
        choice: f64,
    ) -> Refraction {
        if let Some(crystal) = &self.crystal {
            return stone.enter_crystal(packet, lane, (facet, point), direction, crystal, choice);
        }
        let entry = stone.refract_into(facet, direction, self.index);
        packet.load_refracted(lane, point, &entry, self.index);
        packet.absorption[lane] = self.absorption;
        entry
    }
}

impl TraceOptics<'_> {
    /// Wavelengths in which each point of a view is traced: one for a clear stone.
    pub fn wavelengths_per_point(&self) -> u64 {
        if self.material.is_clear() { 1 } else { LINES_PER_RAY as u64 }
    }

    /// Optics of a stone with a trace unit of `unit` at `nm`; refuses indices outside 1..=10.
    pub(super) fn optics(&self, unit: f64, nm: f64) -> Result<LineOptics, EstimatorError> {
        let index = check_index(self.material.index(nm))?;
        let uniaxial = self.material.crystal_at(nm).filter(|crystal| matches!(crystal, Crystal::Uniaxial(_)));
        let crystal = uniaxial.map(|crystal| CrystalOptics {
            crystal,
            absorption: self.material.absorption_tensor_at(nm) * unit,
        });
        Ok(LineOptics { index, absorption: (self.material.absorption_per_mm(nm) * unit) as f32, crystal })
    }
}

/// A stone or material that cannot be lit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EstimatorError {
    /// No facet faces up.
    #[error("no facet faces up: no light enters from above")]
    NoCrown,
    /// An index of refraction that no stone has.
    #[error("index of refraction {0} is not a number from 1 to 10")]
    Index(f64),
}

/// Refuses indices outside 1..=10.
pub(super) fn check_index(n: f64) -> Result<f32, EstimatorError> {
    if (1.0..=10.0).contains(&n) { Ok(n as f32) } else { Err(EstimatorError::Index(n)) }
}
