//! One counter-based random stream per photon or pixel.
//!
//! A stream is a pure function of (seed, purpose, index), so a result does not depend on how many
//! threads worked on it or in which order.

use rand_philox::{Philox, splitmix64, u32_to_unit_f32, u32_to_unit_f64};

/// What a stream is drawn for. Streams of different purposes never share numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub enum Purpose {
    /// The hemisphere estimator, one stream a batch.
    Hemisphere = 1,
    /// The view estimator, one stream a batch.
    View = 2,
    /// The collimated-beam estimator, one stream a batch.
    Beam = 3,
    /// Photons of the caustic map, one stream a photon.
    CausticPhoton = 4,
    /// Photons of the global map, one stream a photon.
    GlobalPhoton = 5,
    /// Camera rays, one stream a pixel.
    Pixel = 6,
    /// Tests and tools.
    Test = 7,
    /// Photons that finish what beams leave over, one stream a batch.
    BeamResidual = 8,
    /// Directions of a dome, one stream a batch.
    Quadrature = 12,
    /// The faceters' view, one stream a batch.
    Iso = 9,
    /// Cells of the picture, one stream a batch and one a run of it.
    Contrast = 10,
    /// Cells of the rocked picture, likewise.
    Scintillation = 11,
    /// Which way light goes on in a concavity, one stream a ray.
    Nonconvex = 13,
    /// Wavelengths of the scores of stones that absorb, one stream a batch.
    ScoreHue = 14,
    /// Scattered points of a sweep, one stream.
    Scatter = 20,
    /// Places of camera rays, one stream a pixel.
    CameraRay = 21,
    /// Places of lights that shadow rays look at, one stream a pixel and light.
    ShadowRay = 22,
    /// Wavelengths of camera rays, one stream a pixel.
    Hue = 23,
    /// Places where camera rays cross the lens, one stream a pixel.
    Lens = 24,
    /// Points by which glare is averaged, one stream a pixel of its spread.
    Glare = 25,
}

/// A stream of random numbers: Philox 4×32-10 keyed by seed and purpose, counted by index.
#[derive(Debug, Clone)]
pub struct Stream(Philox);

impl Stream {
    /// The stream number `index` of `purpose` under the user's `--seed`.
    pub fn new(seed: u64, purpose: Purpose, index: u64) -> Self {
        let key = splitmix64(seed ^ (purpose as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        Self(Philox::from_u64_seed_stream(key, index))
    }

    /// Uniform on the open interval (0, 1), 23 bits.
    #[inline]
    pub fn unit(&mut self) -> f32 {
        u32_to_unit_f32(self.0.next_u32())
    }

    /// Uniform on the open interval (0, 1), 32 bits.
    #[inline]
    pub fn unit64(&mut self) -> f64 {
        u32_to_unit_f64(self.0.next_u32())
    }

    /// Two independent uniforms.
    #[inline]
    pub fn pair(&mut self) -> [f32; 2] {
        [self.unit(), self.unit()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_depends_on_seed_purpose_and_index_alone() {
        let draw = |seed, purpose, index| Stream::new(seed, purpose, index).unit();
        let first = draw(1, Purpose::Test, 5);
        assert_eq!(first, draw(1, Purpose::Test, 5));
        assert_ne!(first, draw(2, Purpose::Test, 5));
        assert_ne!(first, draw(1, Purpose::View, 5));
        assert_ne!(first, draw(1, Purpose::Test, 6));
    }

    #[test]
    fn neighbouring_streams_are_uncorrelated() {
        let n = 20_000;
        let xy: f64 = (0..n)
            .map(|i| {
                let a = Stream::new(1, Purpose::Test, i).unit64() - 0.5;
                let b = Stream::new(1, Purpose::Test, i + 1).unit64() - 0.5;
                a * b
            })
            .sum::<f64>()
            / n as f64;
        // standard error of the mean product: (1/12)/√n
        assert!(xy.abs() < 4.0 / 12.0 / (n as f64).sqrt(), "{xy}");
    }
}
