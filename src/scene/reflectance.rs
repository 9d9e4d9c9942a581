//! Spectral reflectance of a surface.

use crate::color::rgb_upsampling;
use glam::Vec3;

/// Spectral reflectance of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reflectance {
    /// The same at every wavelength.
    Grey(f32),
    /// `low` below `edge_nm`, `high` above, over a soft edge of about 30 nm: with low < high red to
    /// yellow, with low > high blue to cyan.
    Edge {
        /// Reflectance at short wavelengths.
        low: f32,
        /// Reflectance at long wavelengths.
        high: f32,
        /// Wavelength of the middle, nm.
        edge_nm: f32,
    },
    /// Parts of [`rgb_upsampling::basis`], each in 0..=1.
    Mixture(Vec3),
}

impl Reflectance {
    /// Reflectance at `nm`, in 0..=1.
    pub fn value(&self, nm: f32) -> f32 {
        const SOFTNESS_NM: f32 = 8.0;
        match *self {
            Self::Grey(r) => r,
            Self::Mixture(parts) => rgb_upsampling::basis(nm).dot(parts),
            Self::Edge { low, high, edge_nm } => {
                low + (high - low) / (1.0 + ((edge_nm - nm) / SOFTNESS_NM).exp())
            }
        }
    }
}
