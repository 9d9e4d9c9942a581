//! What a camera makes of the wavelengths of a ray: the colours of an eye, or those of three bands.

use crate::optics::{colour, rgb};
use crate::scene::Camera;
use glam::{Mat3, Vec3};

/// A sensor of three channels.
#[derive(Debug, Clone, Copy)]
pub enum Sensor {
    /// An eye's, with the matrix from XYZ to linear sRGB adapted to the camera's white.
    Eye(Mat3),
    /// The bands of [`rgb::basis`], each with the factor that makes equal-energy light 1.
    Bands(Vec3),
}

impl Sensor {
    /// The sensor of a camera.
    pub fn new(camera: &Camera) -> Sensor {
        if !camera.by_bands {
            return Sensor::Eye(colour::to_adapted_srgb(camera.white.xyz(|_| 1.0)));
        }
        /// Wavelengths that the mean of a band is taken over.
        const COUNT: u16 = 1000;
        let at = |i: u16| rgb::basis(colour::wavelength((f32::from(i) + 0.5) / f32::from(COUNT)));
        Sensor::Bands(f32::from(COUNT) / (0..COUNT).map(at).sum::<Vec3>())
    }

    /// What radiance 1 at a wavelength that [`colour::wavelength`] gave adds to the channels' mean.
    pub fn weight(&self, nm: f32) -> Vec3 {
        match self {
            Sensor::Eye(_) => colour::xyz_weight(nm),
            Sensor::Bands(scale) => rgb::basis(nm) * *scale,
        }
    }

    /// Linear sRGB of the channels' mean.
    pub fn srgb(&self, channels: Vec3) -> Vec3 {
        match self {
            Sensor::Eye(rgb_from_xyz) => *rgb_from_xyz * channels,
            Sensor::Bands(_) => channels,
        }
    }
}
