//! Photon maps: light that reaches diffuse surfaces by way of the stone or of other surfaces.
//!
//! Three disjoint classes of light fall on a surface: direct (from a light, by shadow rays),
//! caustic (last from the stone), indirect (last from another surface). The caustic map holds the
//! second, the global map the third.

pub mod emission;
pub mod map;
pub mod map_file;
mod mirror_images;
mod photon_light;
pub mod stone_scattering;
mod surface_cells;

use crate::color::cie::BANDS;
use crate::sampling::random::Purpose;
use crate::scene::intersection::SurfacePoint;
use glam::Vec3;

/// Photons of the caustic map, one stream a photon.
const CAUSTIC_STREAM: Purpose = Purpose::named("caustic photon");

/// Photons of the global map, one stream a photon.
const GLOBAL_STREAM: Purpose = Purpose::named("global photon");

/// Which class of light a map holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// The last thing before the surface was the stone.
    Caustic,
    /// The last thing before the surface was another surface.
    Indirect,
}

impl Class {
    pub(super) fn purpose(self) -> Purpose {
        match self {
            Class::Caustic => CAUSTIC_STREAM,
            Class::Indirect => GLOBAL_STREAM,
        }
    }
}

/// A photon on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoredPhoton {
    /// Place, world frame.
    pub point: Vec3,
    /// Spectral power of its strongest band, a share of the lights' total Φ: Φ is the power at each
    /// wavelength, so light of equal energy has equal power in every band.
    pub power: f32,
    /// Power of each band as a share of the strongest, in 255ths: one band alone for a photon that
    /// has been through the stone.
    pub tint: [u8; BANDS],
    /// Number of the surface.
    pub surface: u16,
    /// Whether it fell on the surface's front.
    pub front: bool,
    /// Unit normal on the side where it fell, in 127ths: a mesh has many.
    pub normal: [i8; 3],
}

impl StoredPhoton {
    /// A photon that falls on a surface.
    pub fn new(at: &SurfacePoint, spectrum: &BandSpectrum) -> StoredPhoton {
        let power = spectrum.iter().copied().fold(0.0, f32::max);
        let tint = spectrum.map(|p| (255.0 * p / power.max(f32::MIN_POSITIVE)).round() as u8);
        let normal = at.normal.to_array().map(|x| (127.0 * x).round() as i8);
        StoredPhoton { point: at.point, power, tint, surface: at.surface as u16, front: at.front, normal }
    }

    /// Unit normal on the side where it fell.
    pub fn normal(&self) -> Vec3 {
        Vec3::from(self.normal.map(f32::from)).normalize_or_zero()
    }

    /// Power in a band.
    pub fn in_band(&self, band: usize) -> f32 {
        self.power * f32::from(self.tint[band]) / 255.0
    }
}

/// Power, irradiance or radiance in each band.
pub type BandSpectrum = [f32; BANDS];

/// How the maps of a picture are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhotonSettings {
    /// Photons kept in each map.
    pub photons: usize,
    /// Photons over whose distance each spreads its light.
    pub nearest: usize,
    /// The user's seed.
    pub seed: u64,
}

/// The photons of one class, before they are arranged for look-up.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PhotonSet {
    /// The photons, powers scaled by the number emitted.
    pub photons: Vec<StoredPhoton>,
    /// Photons emitted to get them.
    pub emitted: u64,
}

/// The stored photons of a scene, both classes.
#[derive(Debug, Clone, PartialEq)]
pub struct PhotonSets {
    /// Caustic photons, scattered last by a stone or a mirror.
    pub caustic: PhotonSet,
    /// Indirect photons, reflected last by another diffuse surface.
    pub indirect: PhotonSet,
}
