//! Light of a beam: a power, a Stokes vector, or either with a record of the strongest exit.

use crate::optics::fresnel::FresnelCoefficients;
use crate::optics::snell::Snell;
use crate::optics::stokes::Stokes;
use glam::DVec3;

/// A facet as the light of a beam meets it.
#[derive(Debug, Clone, Copy)]
pub struct Interface {
    /// Unit direction of the light that arrives.
    pub direction: DVec3,
    /// Unit normal of the facet, on the side that the light goes to.
    pub normal: DVec3,
    /// Unit direction of the light that passes; the zero vector at total reflection.
    pub transmitted: DVec3,
    /// Whether light leaves the stone here, or enters it.
    pub is_exit: bool,
    /// Fresnel's coefficients.
    pub fresnel: FresnelCoefficients,
}

impl Interface {
    /// A facet before unit `direction`, between indices of which `ratio` is before / behind.
    #[inline(always)]
    pub(super) fn new(direction: DVec3, normal: DVec3, ratio: f64, leaves: bool) -> Interface {
        let cos_i = direction.dot(normal).clamp(0.0, 1.0);
        let law = Snell::new(cos_i, ratio);
        let fresnel = FresnelCoefficients::of(&law);
        let refracted = DVec3::from(law.refracted(direction.into(), normal.into()));
        Interface {
            direction,
            normal,
            transmitted: if fresnel.cos_t > 0.0 { refracted } else { DVec3::ZERO },
            is_exit: leaves,
            fresnel,
        }
    }
}

/// Light of a beam, as a share of the light that fell on its footprint.
pub trait BeamLight: Copy {
    /// Its power: 1 for all that fell on the footprint.
    fn power(&self) -> f64;

    /// The transmitted and the reflected part at a facet; no power is lost.
    fn split(&self, at: &Interface) -> (Self, Self);

    /// Whether it is worth following, whatever its power.
    fn is_traced_further(&self) -> bool {
        true
    }

    /// The power of a photon that represents it when it is not followed: 1 if photons are drawn in
    /// proportion to power, as by default.
    fn photon_share(&self) -> f64 {
        1.0
    }

    /// Its polarisation, if it has one.
    fn stokes(&self) -> Option<Stokes> {
        None
    }
}

/// Unpolarised at every facet: a power alone, split by (R_s + R_p)/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnpolarisedLight(pub f64);

impl BeamLight for UnpolarisedLight {
    #[inline(always)]
    fn power(&self) -> f64 {
        self.0
    }

    #[inline(always)]
    fn split(&self, at: &Interface) -> (UnpolarisedLight, UnpolarisedLight) {
        let kept = self.0 * at.fresnel.unpolarised_reflectance();
        (UnpolarisedLight(self.0 - kept), UnpolarisedLight(kept))
    }
}

/// A Stokes vector, carried along exactly: all rays of a beam meet a facet at one angle.
impl BeamLight for Stokes {
    #[inline(always)]
    fn power(&self) -> f64 {
        self.i
    }

    #[inline(always)]
    fn split(&self, at: &Interface) -> (Stokes, Stokes) {
        let arrives = self.about_incidence(at.direction, at.normal);
        (arrives.transmitted(&at.fresnel), arrives.reflected(&at.fresnel))
    }

    fn stokes(&self) -> Option<Stokes> {
        Some(*self)
    }
}
