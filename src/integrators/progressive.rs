//! Progressive photon mapping: picture after picture with photons of their own and ever smaller
//! estimates, whose mean has less and less noise and blur.
//!
//! Every round emits as many photons as the one before but spreads each over fewer of them, k_{i+1} = k_i
//! (i + α)/(i + 1) with α = 2/3: the disc of an estimate shrinks to nothing while the mean over rounds sees
//! ever more photons, so that noise and bias both vanish. Memory holds one round. Source: C. Knaus and M.
//! Zwicker, *Progressive photon mapping: a probabilistic approach*, ACM Trans. Graphics 30(3), 2011.
//! Checked in `tests/library/progressive.rs`.

use super::camera_integrator::{self, PhotonMaps, RenderSettings};
use super::film::{Film, PASSES, Pixel};
use super::tone::LUMINANCE;
use crate::photons::{self, PhotonSets};
use crate::scene::{Camera, Scene};
use glam::Vec3;

/// α: how fast the estimates shrink; with ⅔ noise and blur fall alike.
const ALPHA: f64 = 2.0 / 3.0;
/// No estimate gathers fewer photons; from there on the rounds emit more of them instead.
const MIN_PHOTONS_NEAREST: f64 = 32.0;
/// Most photons of a round.
const MAX_PHOTONS: f64 = 5e7;
/// Fewest rounds from whose spread the noise is estimated.
const MIN_ROUNDS_FOR_NOISE: u32 = 8;
/// Side of the square of pixels whose noise is measured.
const BLOCK: usize = 4;

/// The mean of the rounds so far.
pub struct Progressive<'a> {
    scene: &'a Scene,
    camera: &'a Camera,
    settings: RenderSettings,
    photons: photons::PhotonSettings,
    /// Photons of both classes emitted so far.
    emitted: [u64; 2],
    mean: Film,
    /// For each block of pixels: mean luminance and the sum of its squared deviations.
    blocks: Vec<(f64, f64)>,
}

impl<'a> Progressive<'a> {
    /// A picture before its first round.
    ///
    /// - `settings.samples_per_pixel`: camera rays a pixel and round; `settings.round` is counted here
    /// - `photons`: those of the first round
    pub fn new(
        scene: &'a Scene,
        camera: &'a Camera,
        settings: RenderSettings,
        photons: photons::PhotonSettings,
    ) -> Self {
        let RenderSettings { width, height, .. } = settings;
        let pixels = vec![Pixel::default(); width as usize * height as usize];
        let blocks = (width as usize).div_ceil(BLOCK) * (height as usize).div_ceil(BLOCK);
        Progressive {
            scene,
            camera,
            settings: RenderSettings { round: 0, ..settings },
            photons,
            emitted: [0, 0],
            mean: Film { width, height, pixels },
            blocks: vec![(0.0, 0.0); blocks],
        }
    }

    /// Rounds taken.
    pub fn rounds(&self) -> u32 {
        self.settings.round
    }

    /// The picture so far.
    pub fn film(&self) -> &Film {
        &self.mean
    }

    /// Takes one more round.
    ///
    /// - `row_done`: called after each row, from any thread
    pub fn round(&mut self, row_done: &(dyn Fn() + Sync)) {
        let photons = of_round(self.photons, self.rounds());
        let shots = PhotonSets::resume(self.scene, &photons, self.emitted);
        self.emitted[0] += shots.caustic.emitted;
        self.emitted[1] += shots.indirect.emitted;
        let maps = PhotonMaps::new(self.scene, shots, photons.nearest);
        let film = camera_integrator::render(self.scene, self.camera, &maps, &self.settings, row_done);
        self.settings.round += 1;
        let n = self.settings.round;
        for (mean, new) in self.mean.pixels.iter_mut().zip(&film.pixels) {
            (0..PASSES).for_each(|p| mean.light[p] += (new.light[p] - mean.light[p]) / n as f32);
            mean.display += (new.display - mean.display) / n as f32;
            mean.alpha += (new.alpha - mean.alpha) / n as f32;
        }
        for ((mean, spread), new) in self.blocks.iter_mut().zip(blocks(&film)) {
            let off = new - *mean;
            *mean += off / f64::from(n);
            *spread += off * (new - *mean);
        }
    }

    /// Everything that decides the rounds to come, as bytes, little-endian: the number of rounds and
    /// of photons emitted, the picture, its noise. For [`Self::restore`] of the same picture.
    pub fn state(&self) -> Vec<u8> {
        let mut bytes = Vec::from(self.rounds().to_le_bytes());
        self.emitted.iter().for_each(|n| bytes.extend(n.to_le_bytes()));
        for pixel in &self.mean.pixels {
            let colours = pixel.light.iter().chain([&pixel.display]);
            let numbers = colours.flat_map(|c| c.to_array()).chain([pixel.alpha]);
            numbers.for_each(|x| bytes.extend(x.to_le_bytes()));
        }
        let noise = self.blocks.iter().flat_map(|(mean, spread)| [*mean, *spread]);
        noise.for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes
    }

    /// Restores what [`Self::state`] gave; false if the bytes do not fit the picture.
    pub fn restore(&mut self, mut state: &[u8]) -> bool {
        let fixed = size_of::<u32>() + 2 * size_of::<u64>();
        let a_pixel = size_of::<f32>() * (3 * (PASSES + 1) + 1);
        let a_block = 2 * size_of::<f64>();
        if state.len() != fixed + a_pixel * self.mean.pixels.len() + a_block * self.blocks.len() {
            return false;
        }
        let from = &mut state;
        self.settings.round = u32::from_le_bytes(taken(from));
        self.emitted = [(); 2].map(|()| u64::from_le_bytes(taken(from)));
        for pixel in &mut self.mean.pixels {
            for colour in pixel.light.iter_mut().chain([&mut pixel.display]) {
                *colour = Vec3::from([(); 3].map(|()| f32::from_le_bytes(taken(from))));
            }
            pixel.alpha = f32::from_le_bytes(taken(from));
        }
        for block in &mut self.blocks {
            *block = [(); 2].map(|()| f64::from_le_bytes(taken(from))).into();
        }
        true
    }

    /// Noise of the picture so far: the root mean square of the standard errors of 4×4 pixels'
    /// luminance, over the mean luminance. Infinite after one round; 0 for a picture that is black.
    pub fn noise(&self) -> f64 {
        let n = f64::from(self.rounds());
        let variance: f64 = self.blocks.iter().map(|(_, spread)| spread / (n - 1.0) / n).sum();
        let mean: f64 = self.blocks.iter().map(|(mean, _)| mean).sum();
        let count = self.blocks.len() as f64;
        match mean {
            _ if n < 2.0 => f64::INFINITY,
            0.0 => 0.0,
            mean => (variance / count).sqrt() / (mean / count),
        }
    }

    /// Whether the noise is surely at most a share: by rounds enough to tell, for a variance of a few values
    /// is small by luck, and with two standard errors of the mean variance of all blocks to spare. A picture
    /// that no light reaches has none.
    pub fn is_converged(&self, share: f64) -> bool {
        if self.rounds() < MIN_ROUNDS_FOR_NOISE {
            return self.rounds() > 0 && self.scene.lights.is_empty();
        }
        let count = self.blocks.len() as f64;
        let sum: f64 = self.blocks.iter().map(|(_, spread)| spread).sum();
        let squares: f64 = self.blocks.iter().map(|(_, spread)| (spread - sum / count).powi(2)).sum();
        let bound = 1.0 + 2.0 * squares.sqrt() / sum.max(f64::MIN_POSITIVE);
        self.noise() * bound.sqrt() <= share
    }

    /// Whether no light has reached the picture.
    pub fn is_black(&self) -> bool {
        self.blocks.iter().all(|(mean, _)| *mean == 0.0)
    }
}

/// Photons, and how many of them an estimate gathers, in a round.
fn of_round(first: photons::PhotonSettings, round: u32) -> photons::PhotonSettings {
    let shrunk: f64 = (1..=round).map(|i| (f64::from(i) - 1.0 + ALPHA) / f64::from(i)).product();
    let nearest = first.nearest as f64 * shrunk;
    let fewest = MIN_PHOTONS_NEAREST.min(first.nearest as f64);
    let photons = (first.photons as f64 * (fewest / nearest).max(1.0)).min(MAX_PHOTONS);
    photons::PhotonSettings {
        photons: photons as usize,
        nearest: nearest.max(fewest).round() as usize,
        ..first
    }
}

/// The next bytes; zeros after the end.
fn taken<const N: usize>(from: &mut &[u8]) -> [u8; N] {
    let (next, rest) = from.split_first_chunk().unwrap_or((&[0; N], &[]));
    *from = rest;
    *next
}

/// Mean luminance of every block of pixels.
fn blocks(film: &Film) -> Vec<f64> {
    let across = (film.width as usize).div_ceil(BLOCK);
    let mut sums = vec![(0.0, 0.0); across * (film.height as usize).div_ceil(BLOCK)];
    for (i, linear) in film.linear(None).into_iter().enumerate() {
        let (x, y) = (i % film.width as usize, i / film.width as usize);
        let (sum, count) = &mut sums[y / BLOCK * across + x / BLOCK];
        *sum += f64::from(linear.dot(LUMINANCE));
        *count += 1.0;
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_shrink_as_the_cube_root_and_photons_grow_when_they_cannot() {
        let first = photons::PhotonSettings { photons: 1000, nearest: 500, seed: 1 };
        assert_eq!(of_round(first, 0), first);
        // Γ(i + 2/3)/(Γ(2/3) i!) → i^(−1/3)/Γ(2/3), Γ(2/3) = 1.3541
        let thousandth = of_round(first, 1000);
        assert_eq!((thousandth.nearest, thousandth.photons), (37, 1000));
        let few = of_round(photons::PhotonSettings { nearest: 64, ..first }, 1000);
        assert_eq!(few.nearest, 32);
        assert!((few.photons as f64 / (1000.0 * 32.0 / (64.0 * 0.1 / 1.3541)) - 1.0).abs() < 1e-2);
    }
}
