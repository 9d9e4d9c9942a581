//! Panoramas: light all around, from a picture of high dynamic range.
//!
//! Equirectangular, the zenith at the top, the middle of the picture toward +y.

use crate::color::rgb_upsampling;
use crate::limits::{self, Limits};
use crate::sampling::discrete_cdf::DiscreteCdf;
use crate::storage::{bounded_read, text};
use glam::Vec3;
use image::{DynamicImage, ImageDecoder};
use std::f32::consts::{PI, TAU};
use std::io::Cursor;
use std::path::Path;

/// Brighter pixels are taken as this bright: the sun is 1e5 times the sky, and sums stay finite.
const BRIGHTEST: f32 = 1e12;

/// A channel of a pixel, which a file may give as anything: negative outside the gamut, or no number.
fn bounded(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(-BRIGHTEST, BRIGHTEST) }
}

/// A panorama ready for look-up and for drawing directions by brightness.
pub struct Panorama {
    width: usize,
    height: usize,
    /// Colours as parts of [`rgb_upsampling::basis`].
    pixels: Vec<Vec3>,
    /// Pixels by brightness × solid angle, adding up to 1.
    pixels_by_power: DiscreteCdf,
    mean: f32,
    /// CRC-32 of the file.
    checksum: u32,
}

/// Checksums of scenes take a panorama by the checksum of its file.
impl std::fmt::Debug for Panorama {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "panorama {}×{} {:08x}", self.width, self.height, self.checksum)
    }
}

impl Panorama {
    /// Reads a Radiance `.hdr` or an OpenEXR file; the error says in one line what is wrong.
    pub fn open(path: &Path, limits: Limits) -> Result<Panorama, String> {
        let wrong =
            |e: &dyn std::fmt::Display| format!("cannot read the panorama {}: {e}", text::display_name(path));
        let missing = |e: std::io::Error| match e.kind() {
            std::io::ErrorKind::NotFound => wrong(&e) + "; --hdr FILE names one that is there",
            _ => wrong(&e),
        };
        let bytes = bounded_read::read_regular(path, limits, &limits::PANORAMA).map_err(missing)?;
        let bytes = bytes.map_err(|e| wrong(&e))?;
        Panorama::from_bytes(&bytes, limits).map_err(|e| wrong(&e))
    }

    /// Reads the bytes of such a file; the error says in one line what is wrong.
    ///
    /// Its size is known to be within the limits before any of it is decoded.
    pub fn from_bytes(bytes: &[u8], limits: Limits) -> Result<Panorama, String> {
        let one_line = |e: image::ImageError| e.to_string().replace('\n', " ");
        let reader = image::ImageReader::new(Cursor::new(bytes)).with_guessed_format();
        let reader = reader.map_err(|e| e.to_string())?;
        if reader.format().is_none() {
            return Err("it is neither a Radiance .hdr nor an OpenEXR file".into());
        }
        let decoder = reader.into_decoder().map_err(one_line)?;
        let (width, height) = decoder.dimensions();
        let count = u64::from(width) * u64::from(height);
        limits.check(&limits::PIXELS, count).map_err(|e| e.to_string())?;
        let per_byte = count / bytes.len() as u64;
        limits.check(&limits::PIXELS_PER_BYTE, per_byte).map_err(|e| e.to_string())?;
        let picture = DynamicImage::from_decoder(decoder).map_err(one_line)?.into_rgb32f();
        let pixels: Vec<Vec3> =
            picture.pixels().map(|p| rgb_upsampling::upsample(Vec3::from_array(p.0.map(bounded)))).collect();
        if pixels.iter().all(|p| *p == Vec3::ZERO) {
            return Err("it is black".into());
        }
        Ok(Panorama::new(width as usize, height as usize, pixels, crc32fast::hash(bytes)))
    }

    /// A panorama of a function's values in the middle of each pixel.
    ///
    /// - `colour`: parts of [`rgb_upsampling::basis`] in a unit direction; `checksum`: what tells it from others
    pub fn painted(
        (width, height): (usize, usize),
        colour: impl Fn(Vec3) -> Vec3,
        checksum: u32,
    ) -> Panorama {
        let pixel = |i: usize| {
            let (theta, phi) = (
                PI * ((i / width) as f32 + 0.5) / height as f32,
                TAU * ((i % width) as f32 + 0.5) / width as f32 - PI,
            );
            colour(Vec3::new(theta.sin() * phi.sin(), theta.sin() * phi.cos(), theta.cos()))
        };
        Panorama::new(width, height, (0..width * height).map(pixel).collect(), checksum)
    }

    fn new(width: usize, height: usize, pixels: Vec<Vec3>, checksum: u32) -> Panorama {
        // cos a − cos b by the sine of half their difference: near the zenith `f32` has no digits for it
        let step = std::f64::consts::PI / height as f64;
        let row = |y: usize| 2.0 * (step * (y as f64 + 0.5)).sin() * (step / 2.0).sin();
        let solid_angle = |i: usize| row(i / width) * f64::from(TAU) / width as f64;
        let power = |i: usize| f64::from(pixels[i].element_sum() / 3.0) * solid_angle(i);
        let by_power = DiscreteCdf::new((0..pixels.len()).map(power));
        let mean = (by_power.total() / f64::from(4.0 * PI)) as f32;
        Panorama { width, height, pixels, pixels_by_power: by_power.normalised(), mean, checksum }
    }

    /// How many pixels it has.
    pub fn pixel_count(&self) -> usize {
        self.pixels.len()
    }

    /// Mean brightness over the sphere.
    pub fn mean(&self) -> f32 {
        self.mean
    }

    /// Colour seen in a unit direction.
    pub fn colour(&self, d: Vec3) -> Vec3 {
        let x = (0.5 + d.x.atan2(d.y) / TAU) * self.width as f32;
        let y = d.z.clamp(-1.0, 1.0).acos() / PI * self.height as f32;
        self.pixels[(y as usize).min(self.height - 1) * self.width + (x as usize).min(self.width - 1)]
    }

    /// A direction drawn by brightness, and its colour over the density per steradian.
    pub fn sample(&self, u: [f32; 2]) -> (Vec3, Vec3) {
        let (i, within) = self.pixels_by_power.sample(u[0].into());
        let within = within as f32;
        let row = |y: usize| (PI * y as f32 / self.height as f32).cos();
        let z = row(i / self.width) + (row(i / self.width + 1) - row(i / self.width)) * u[1];
        let phi = ((i % self.width) as f32 + within) / self.width as f32 * TAU - PI;
        let r = (1.0 - z * z).max(0.0).sqrt();
        let colour = self.pixels[i];
        let brightness = colour.element_sum() / 3.0;
        (Vec3::new(r * phi.sin(), r * phi.cos(), z), colour * (4.0 * PI * self.mean / brightness))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};

    #[test]
    fn directions_are_drawn_by_brightness_and_found_again() {
        let mut pixels = vec![Vec3::splat(0.1); 32 * 16];
        pixels[4 * 32 + 20] = Vec3::new(50.0, 40.0, 30.0);
        let sky = Panorama::new(32, 16, pixels, 0);
        let mut stream = Stream::new(1, Purpose::TEST, 0);
        let n = 100_000;
        let mut up = Vec3::ZERO;
        for _ in 0..n {
            let (d, radiance) = sky.sample(stream.pair());
            let seen = sky.colour(d);
            let density = seen.y / radiance.y;
            assert!((density / (seen.element_sum() / 3.0) * (4.0 * PI * sky.mean()) - 1.0).abs() < 1e-3);
            up += radiance * d.z.max(0.0) / n as f32;
        }
        // the sun's pixel: solid angle × sine of its height; the sky: π × 0.1
        let (a, b) = ((PI * 4.0 / 16.0).cos(), (PI * 5.0 / 16.0).cos());
        let sun = (a * a - b * b) / 2.0 * TAU / 32.0;
        let expected = 0.1 * PI + sun * 39.9;
        assert!((up.y / expected - 1.0).abs() < 0.01, "{} {expected}", up.y);
    }
}
