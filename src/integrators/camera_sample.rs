//! Settings, maps and samples that both integrators share.

use super::film::{PASSES, Pass};
use super::sensor::Sensor;
use super::tone::Tone;
use crate::color::cie;
use crate::color::cie::BANDS;
use crate::photons::PhotonSets;
use crate::photons::map::PhotonMap;
use crate::scene::intersection::StoneHit;
use crate::scene::{Camera, Light, Scene};
use glam::{Mat3, Vec3};

/// Settings of a render.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RenderSettings {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Camera rays a pixel.
    pub samples_per_pixel: u32,
    /// Which of several pictures with the same seed this is: their mean is one of all their rays.
    pub round: u32,
    /// Exposure and tone curve.
    pub tone: Tone,
    /// The user's seed.
    pub seed: u64,
}

/// Mirrors in a row, after which a camera ray sees black.
pub(super) const MAX_MIRRORS: u32 = 64;

/// The maps of a picture.
pub struct PhotonMaps {
    /// Caustic light: last from a stone or a mirror.
    pub caustic: PhotonMap,
    /// Indirect light: last from another diffuse surface.
    pub indirect: PhotonMap,
}

impl PhotonMaps {
    /// Arranges both classes of photons for look-up.
    ///
    /// - `nearest`: photons that an estimate gathers
    pub fn new(scene: &Scene, shots: PhotonSets, nearest: usize) -> PhotonMaps {
        PhotonMaps {
            caustic: PhotonMap::new(scene, shots.caustic, nearest),
            indirect: PhotonMap::new(scene, shots.indirect, nearest),
        }
    }
}

/// State of a render.
pub(super) struct CameraIntegrator<'a> {
    pub scene: &'a Scene,
    pub(super) camera: &'a Camera,
    pub maps: &'a PhotonMaps,
    pub(super) settings: &'a RenderSettings,
    pub(super) sensor: Sensor,
}

/// A camera ray and what it has gathered: radiance by pass and wavelength. The wavelengths of a ray
/// share its random numbers, so that colour has no noise.
pub(super) struct CameraSample {
    pub nm: [f32; BANDS],
    pub(super) light: [[f32; BANDS]; PASSES],
    /// Whether it met the background of a scene that leaves its background out.
    pub(super) left_out: bool,
}

impl CameraSample {
    pub(super) fn colour(&self, sensor: &Sensor) -> [Vec3; PASSES] {
        let weights = self.nm.map(|nm| sensor.weight(nm));
        self.light.map(|bands| {
            let seen: Vec3 = (0..BANDS).map(|b| weights[b] * bands[b]).sum::<Vec3>() / BANDS as f32;
            sensor.srgb(seen)
        })
    }

    /// Colour of all passes by the mean weight of each band: without the noise of the few wavelengths
    /// that the ray has, so that white is white. Not for spectra that change within a band.
    pub(super) fn even_colour(&self, rgb_from_xyz: &Mat3) -> Vec3 {
        let band = |b: usize| cie::band_xyz(b) * self.light.iter().map(|pass| pass[b]).sum::<f32>();
        *rgb_from_xyz * ((0..BANDS).map(band).sum::<Vec3>() / BANDS as f32)
    }

    /// Adds a light that is seen.
    ///
    /// - `colour`: as its emitter gives it
    pub(super) fn add_light(&mut self, pass: Pass, share: &[f32; BANDS], light: &Light, colour: Vec3) {
        for (b, share) in share.iter().enumerate() {
            self.light[pass as usize][b] += share * light.radiance_at(colour, self.nm[b]);
        }
    }

    pub fn add(&mut self, pass: Pass, band: usize, radiance: f32) {
        self.light[pass as usize][band] += radiance;
    }
}

/// A camera ray at a stone's surface, about to go in.
pub(super) struct StoneArrival {
    /// The camera ray's number in its pixel.
    pub sight: usize,
    /// The stone's number.
    pub stone: usize,
    pub hit: StoneHit,
    /// Share of each wavelength that mirrors have left.
    pub share: [f32; BANDS],
}
