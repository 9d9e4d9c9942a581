//! Sensor: from the wavelengths of a camera ray to colours, an eye's or flat ones.

use crate::color::{cie, rgb_upsampling};
use crate::scene::Camera;
use glam::{Mat3, Vec3};

/// A sensor of three channels.
#[derive(Debug, Clone, Copy)]
pub enum Sensor {
    /// An eye's, with the matrix from XYZ to linear sRGB adapted to the camera's white.
    Eye(Mat3),
    /// The bands of [`rgb_upsampling::basis`], with the matrix that parts them where they overlap: a mixture of them
    /// comes out as its parts.
    Flat(Mat3),
}

impl Sensor {
    /// The sensor of a camera.
    pub fn new(camera: &Camera) -> Sensor {
        if !camera.flat {
            return Sensor::Eye(cie::to_adapted_srgb(camera.white.xyz(|_| 1.0)));
        }
        /// Wavelengths that the means of the bands and of their overlaps are taken over.
        const COUNT: u16 = 1000;
        let overlap = |i: u16| {
            let bands = rgb_upsampling::basis(cie::wavelength((f32::from(i) + 0.5) / f32::from(COUNT)));
            Mat3::from_cols(bands * bands.x, bands * bands.y, bands * bands.z)
        };
        let overlaps: Mat3 = (0..COUNT).map(overlap).sum();
        Sensor::Flat((overlaps * f32::from(COUNT).recip()).inverse())
    }

    /// What radiance 1 at a wavelength that [`cie::wavelength`] gave adds to the channels' mean.
    pub fn weight(&self, nm: f32) -> Vec3 {
        match self {
            Sensor::Eye(_) => cie::xyz_weight(nm),
            Sensor::Flat(_) => rgb_upsampling::basis(nm),
        }
    }

    /// Linear sRGB of the channels' mean.
    pub fn srgb(&self, channels: Vec3) -> Vec3 {
        match self {
            Sensor::Eye(to_srgb) | Sensor::Flat(to_srgb) => *to_srgb * channels,
        }
    }
}

/// What a flat sensor shows of the light of one camera ray: white, red, green, blue or black, whichever
/// has the greatest share of light of at most 1. White is what the three have in common, black what is
/// missing.
pub fn purest(light: Vec3) -> Vec3 {
    let light = light.max(Vec3::ZERO);
    let white = light.min_element();
    let pure = light - white;
    let shares = [
        (white, Vec3::ONE),
        (pure.x, Vec3::X),
        (pure.y, Vec3::Y),
        (pure.z, Vec3::Z),
        (1.0 - white - pure.element_sum(), Vec3::ZERO),
    ];
    shares.iter().fold((f32::NEG_INFINITY, Vec3::ZERO), |best, s| if s.0 > best.0 { *s } else { best }).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Illuminant;
    use crate::color::cie::BANDS;
    use crate::scene::Lens;

    fn flat_sensor() -> Sensor {
        Sensor::new(&Camera {
            position: Vec3::Z,
            target: Vec3::ZERO,
            lens: Lens::Orthographic(1.0),
            aspect: 1.0,
            stops: 0.0,
            white: Illuminant::equal_energy(),
            flat: true,
        })
    }

    #[test]
    fn a_mixture_of_bands_comes_out_as_its_parts() {
        let sensor = flat_sensor();
        for parts in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE, Vec3::new(0.7, 0.1, 0.3)] {
            const N: usize = 400;
            let nm = |i: usize| cie::wavelength((i as f32 + 0.5) / (N * BANDS) as f32);
            let light =
                (0..N * BANDS).map(|i| sensor.weight(nm(i)) * rgb_upsampling::basis(nm(i)).dot(parts));
            let seen = sensor.srgb(light.sum::<Vec3>() / (N * BANDS) as f32);
            assert!((seen - parts).abs().max_element() < 2e-3, "{parts}: {seen}");
        }
    }

    #[test]
    fn the_greatest_share_wins() {
        for (light, colour) in [
            (Vec3::new(0.6, 0.1, 0.1), Vec3::X),
            (Vec3::new(0.55, 0.45, 0.45), Vec3::ONE),
            (Vec3::new(0.1, 0.5, 0.3), Vec3::Y),
            (Vec3::new(0.1, 0.1, 0.4), Vec3::ZERO),
            (Vec3::new(-0.1, 0.0, 0.9), Vec3::Z),
            (Vec3::ZERO, Vec3::ZERO),
        ] {
            assert_eq!(purest(light), colour, "{light}");
        }
    }
}
