//! Spectrum of a photon in flight: all eight bands until it meets the stone, one wavelength after.
//!
//! Only stones disperse light. A photon that has met walls alone carries its whole spectrum, so that light
//! between surfaces has no colour noise; at the stone it keeps one wavelength.

use super::BandSpectrum;
use crate::color::cie;
use crate::color::cie::BANDS;

/// Power by band, and where in each band the photon's wavelengths lie.
#[derive(Debug, Clone, Copy)]
pub struct PhotonLight {
    power: BandSpectrum,
    /// 0..1, the same place in every band.
    place_in_band: f32,
    single: bool,
}

impl PhotonLight {
    /// Light of a spectrum.
    ///
    /// - `power`: by wavelength in nm; `place_in_band`: uniform in (0, 1)
    pub fn new(power: impl Fn(f32) -> f32, place_in_band: f32) -> PhotonLight {
        PhotonLight {
            power: std::array::from_fn(|b| power(wavelength(b, place_in_band))),
            place_in_band,
            single: false,
        }
    }

    fn nm(&self, band: usize) -> f32 {
        wavelength(band, self.place_in_band)
    }

    /// Power by band.
    pub fn spectrum(&self) -> &BandSpectrum {
        &self.power
    }

    /// Multiplies all power.
    pub fn scale(&mut self, weight: f32) {
        self.power.iter_mut().for_each(|p| *p *= weight);
    }

    /// Reflects at a surface. Russian roulette by the strongest band decides whether the photon
    /// goes on, its power then in proportion to what each band reflects.
    ///
    /// - `reflectance`: by wavelength in nm; `u`: uniform in (0, 1)
    pub fn reflect(&mut self, reflectance: impl Fn(f32) -> f32, u: f32) -> bool {
        let before = self.strongest();
        if before <= 0.0 {
            return false;
        }
        for band in 0..BANDS {
            self.power[band] *= reflectance(self.nm(band));
        }
        let survival = self.strongest() / before;
        if u >= survival {
            return false;
        }
        self.scale(1.0 / survival);
        true
    }

    /// Keeps one wavelength, chosen by power, with the power of all; returns it in nm.
    ///
    /// - `u`: uniform in (0, 1)
    pub fn single_wavelength(&mut self, u: f32) -> f32 {
        let total: f32 = self.power.iter().sum();
        let mut rest = u * total;
        let chosen = (0..BANDS).find(|b| {
            rest -= self.power[*b];
            rest < 0.0
        });
        let band = chosen.unwrap_or_else(|| self.power.iter().rposition(|p| *p > 0.0).unwrap_or(0));
        if !self.single {
            self.power = [0.0; BANDS];
            self.power[band] = total;
            self.single = true;
        }
        self.nm(band)
    }

    fn strongest(&self) -> f32 {
        self.power.iter().copied().fold(0.0, f32::max)
    }
}

/// The wavelength at a place of a band, nm.
fn wavelength(band: usize, place: f32) -> f32 {
    cie::wavelength((band as f32 + place) / BANDS as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};
    use crate::scene::Reflectance;

    /// A coloured wall and the loss of all but one wavelength leave the mean spectrum as it is.
    #[test]
    fn roulette_and_choice_are_right_on_average() {
        let red = Reflectance::Edge { low: 0.1, high: 0.8, edge_nm: 600.0 };
        let mut stream = Stream::new(1, Purpose::TEST, 0);
        let (n, mut mean, mut expected) = (200_000, [0f64; BANDS], [0f64; BANDS]);
        for _ in 0..n {
            let mut light = PhotonLight::new(|_| 1.0, stream.unit());
            for (band, sum) in expected.iter_mut().enumerate() {
                *sum += f64::from(red.value(light.nm(band))) / f64::from(n);
            }
            if light.reflect(|nm| red.value(nm), stream.unit()) {
                light.single_wavelength(stream.unit());
                (0..BANDS).for_each(|b| mean[b] += f64::from(light.spectrum()[b]) / f64::from(n));
            }
        }
        for band in 0..BANDS {
            // a band of mean m holds at most 8 per photon: variance under 8m
            let sigma = (8.0 * expected[band] / f64::from(n)).sqrt();
            assert!((mean[band] - expected[band]).abs() < 4.0 * sigma, "{mean:?} {expected:?}");
        }
    }
}
