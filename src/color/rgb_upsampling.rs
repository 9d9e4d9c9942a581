//! Spectra of colours that are known as red, green and blue alone: panoramas, painted things.

use super::cie;
use super::illuminants::Illuminant;
use glam::{Mat3, Vec3};
use std::sync::LazyLock;

/// Where blue ends and red begins, nm.
const ENDS_NM: [f32; 2] = [490.0, 585.0];
const SOFTNESS_NM: f32 = 8.0;

/// Three smooth spectra, one each for red, green and blue, that add up to 1 at every wavelength.
/// A colour is a mixture of them; equal parts are grey to the last bit.
pub fn basis(nm: f32) -> Vec3 {
    let rise = |edge: f32| 1.0 / (1.0 + ((edge - nm) / SOFTNESS_NM).exp());
    let (not_blue, red) = (rise(ENDS_NM[0]), rise(ENDS_NM[1]));
    Vec3::new(red, not_blue - red, 1.0 - not_blue)
}

/// The mixture of [`basis`] that looks like a linear sRGB colour under equal-energy light. A colour
/// that no mixture of positive parts makes gets the nearest one.
pub fn upsample(srgb: Vec3) -> Vec3 {
    static FROM_RGB: LazyLock<Mat3> = LazyLock::new(|| {
        let column = |i: usize| cie::linear_srgb(Illuminant::equal_energy().xyz(|nm| basis(nm)[i]));
        Mat3::from_cols(column(0), column(1), column(2)).inverse()
    });
    (*FROM_RGB * srgb).max(Vec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_comes_back() {
        for rgb in [Vec3::ONE, Vec3::new(0.6, 0.3, 0.2), Vec3::new(0.2, 0.5, 0.3), Vec3::new(0.3, 0.3, 0.7)] {
            let parts = upsample(rgb);
            let back = cie::linear_srgb(Illuminant::equal_energy().xyz(|nm| basis(nm).dot(parts)));
            assert!((back - rgb).abs().max_element() < 2e-3, "{rgb}: {back}");
        }
    }
}
