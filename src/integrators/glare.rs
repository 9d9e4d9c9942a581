//! Star-burst glare: light that the iris of a camera diffracts away from what is brighter than white.
//!
//! The intensity far behind a polygonal iris is the squared Fourier transform of its shape: most of
//! the light lands within a pixel, the rest in two spikes for each pair of edges, red farther out
//! than blue. Only the picture that is shown has glare; its linear light, its passes and what is
//! measured do not.
//!
//! Source: M. Born and E. Wolf, *Principles of Optics*, §8.3.3 (Fraunhofer diffraction), with the
//! transform of a polygon as a sum over its edges. Checked in this file's tests by the light that an aperture of a
//! given perimeter must throw beyond a radius.

use super::film::Film;
use super::tone::Tone;
use crate::color::rgb_upsampling;
use crate::parallel;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Edges of the iris.
const BLADES: usize = 6;
/// How the iris is turned, so that no spike lies along a row of pixels.
const TILT_DEG: f32 = 10.0;
/// Width of the picture in the camera, µm: the small-picture format.
const FRAME_UM: f32 = 36_000.0;
/// How far spikes are followed, as a share of the picture's width.
const REACH: f32 = 0.15;
/// Wavelengths that the spikes are made of, µm.
const RANGE_UM: (f32, f32) = (0.43, 0.66);
/// Points of place and wavelength that a pixel's share is the mean of.
const POINTS: u64 = 128;

/// Points by which glare is averaged, one stream a pixel of its spread.
const STREAM: Purpose = Purpose::named("glare");

/// Where the light of one pixel goes: shares of red, green and blue, which add up to 1.
struct PointSpread {
    reach: i32,
    shares: Vec<Vec3>,
}

impl PointSpread {
    /// - `f_number`: focal length over the iris's widest diameter
    /// - `width`: of the picture in pixels
    fn new(f_number: f32, width: u32) -> PointSpread {
        let reach = (REACH * width as f32).ceil() as i32;
        let side = 2 * reach + 1;
        let pixel_um = FRAME_UM / width as f32;
        // the iris has a centre of symmetry, and so has what it spreads: half of it is enough
        let half = (side * side / 2) as usize;
        let mut shares: Vec<Vec3> = parallel::map(half, |i| {
            let i = i as i32;
            let away = Vec2::new((i % side - reach) as f32, (i / side - reach) as f32);
            share(away, f_number, pixel_um, i as u64)
        });
        let away: Vec3 = shares.iter().sum();
        let other: Vec<Vec3> = shares.iter().rev().copied().collect();
        shares.push(Vec3::ONE - 2.0 * away);
        shares.extend(other);
        PointSpread { reach, shares }
    }

    /// - `x`, `y`: pixels to the right and down, at most `reach`
    fn value(&self, x: i32, y: i32) -> Vec3 {
        self.shares[((y + self.reach) * (2 * self.reach + 1) + x + self.reach) as usize]
    }
}

/// Share of the light that lands in a pixel at a distance from its own.
fn share(pixel: Vec2, f_number: f32, pixel_um: f32, number: u64) -> Vec3 {
    let (mut sum, mut white) = (Vec3::ZERO, Vec3::ZERO);
    for point in KroneckerPoints::<3>::new(0, STREAM, number, 0..POINTS) {
        let [x, y, hue] = point.map(|p| p as f32);
        let um = RANGE_UM.0 + (RANGE_UM.1 - RANGE_UM.0) * hue;
        let k_per_um = TAU / (um * f_number);
        let k = (pixel + Vec2::new(x, y) - 0.5) * (pixel_um * k_per_um);
        // Parseval: the integral of the squared transform over k is (2π)² times the area
        let density = transform(k).powi(2) / (AREA * TAU * TAU) * k_per_um * k_per_um;
        sum += rgb_upsampling::basis(um * 1000.0) * density;
        white += rgb_upsampling::basis(um * 1000.0);
    }
    sum / white * pixel_um * pixel_um
}

/// Area of the iris whose widest diameter is 1.
const AREA: f32 = 0.649_519;

/// Fourier transform of that iris; it is real, for the iris has a centre of symmetry.
fn transform(k: Vec2) -> f32 {
    let corner = |j: usize| 0.5 * Vec2::from_angle(TILT_DEG.to_radians() + TAU * j as f32 / BLADES as f32);
    let edge = |j: usize| {
        let (a, b) = (corner(j), corner(j + 1));
        let half = 0.5 * k.dot(b - a);
        let sinc = if half.abs() < 1e-4 { 1.0 } else { half.sin() / half };
        k.perp_dot(b - a) * sinc * k.dot(0.5 * (a + b)).sin()
    };
    (0..BLADES).map(edge).sum::<f32>() / k.length_squared()
}

/// Adds glare to what a film shows.
///
/// - `f_number`: of the lens; 16 draws clear stars, smaller numbers fainter ones
pub fn add(film: &mut Film, tone: &Tone, f_number: f32) {
    let spread = PointSpread::new(f_number, film.width);
    let exposed: Vec<Vec3> = film.linear(None).iter().map(|p| *p * tone.stops.exp2()).collect();
    let width = film.width as usize;
    // what is beyond white, row by row
    let beyond = |light: &Vec3| (*light - 1.0).max(Vec3::ZERO);
    let in_row = |row: &[Vec3]| -> Vec<(i32, Vec3)> {
        let all = row.iter().enumerate().map(|(x, light)| (x as i32, beyond(light)));
        all.filter(|(_, light)| *light != Vec3::ZERO).collect()
    };
    let bright: Vec<Vec<(i32, Vec3)>> = exposed.chunks(width).map(in_row).collect();
    let curve = Tone { stops: 0.0, ..*tone };
    parallel::for_each_mut(&mut film.pixels, |i, pixel| {
        let (x, y) = ((i % width) as i32, (i / width) as i32);
        let mut come = Vec3::ZERO;
        for (from_y, row) in (0..).zip(&bright).filter(|(from_y, _)| (y - from_y).abs() <= spread.reach) {
            let first = row.partition_point(|(from_x, _)| *from_x < x - spread.reach);
            let near = row[first..].iter().take_while(|(from_x, _)| *from_x <= x + spread.reach);
            come += near.map(|(from_x, light)| spread.value(x - from_x, y - from_y) * *light).sum::<Vec3>();
        }
        // what a pixel loses is beyond white and not missed: its own edges stay as smooth as they were
        come -= spread.value(0, 0) * beyond(&exposed[i]);
        let added =
            curve.display_rgb(pixel.display + come.max(Vec3::ZERO)) - curve.display_rgb(pixel.display);
        pixel.display += added;
        // it covers what is behind it as much as it is bright, also beyond the edges of things
        pixel.alpha = (pixel.alpha + added.max_element()).min(1.0);
        pixel.display = pixel.display.min(Vec3::ONE);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::film::{Pass, Pixel};
    use crate::integrators::tone::ToneCurve;
    use std::f32::consts::PI;

    /// [D] All light lands somewhere, none is negative. Beyond a radius r of many fringes lies a share
    /// of (perimeter / area) λN / (2π² r), as for a circle (4 / D) from its Bessel functions.
    #[test]
    fn light_is_kept_and_as_much_goes_astray_as_the_perimeter_says() {
        let (f_number, width) = (16.0, 1000);
        let spread = PointSpread::new(f_number, width);
        let whole: Vec3 = spread.shares.iter().sum();
        assert!((whole - Vec3::ONE).abs().max_element() < 1e-4, "{whole}");
        assert!(spread.shares.iter().all(|s| s.min_element() >= 0.0));
        let side = 2 * spread.reach + 1;
        let (near, far) = (40.0, spread.reach as f32);
        let ring: f32 = (0..side * side)
            .map(|i| (i % side - spread.reach, i / side - spread.reach))
            .filter(|(x, y)| (near..far).contains(&((x * x + y * y) as f32).sqrt()))
            .map(|(x, y)| spread.value(x, y).y)
            .sum();
        // green is from 490 to 585 nm
        let um_per_pixel = 0.5375 * f_number / (FRAME_UM / width as f32);
        let expected = 3.0 / AREA * um_per_pixel / (2.0 * PI * PI) * (1.0 / near - 1.0 / far);
        assert!((ring / expected - 1.0).abs() < 0.1, "{ring} {expected}");
    }

    /// Spikes stand square to the edges; between two of them there is next to nothing.
    #[test]
    fn it_is_a_star_of_six() {
        let spread = PointSpread::new(16.0, 400);
        let along = |deg: f32| {
            let at = |r: i32| (Vec2::from_angle(deg.to_radians()) * r as f32).round();
            (12..50).map(|r| spread.value(at(r).x as i32, at(r).y as i32).y).sum::<f32>()
        };
        for spike in 0..6 {
            let deg = TILT_DEG + 30.0 + 60.0 * spike as f32;
            assert!(along(deg) > 20.0 * along(deg + 30.0), "{deg}");
        }
    }

    #[test]
    fn only_what_is_beyond_white_spreads() {
        let film = |middle: f32| {
            let mut film = Film { width: 99, height: 99, pixels: vec![Pixel::default(); 99 * 99] };
            film.pixels[49 * 99 + 49].light[Pass::Stone as usize] = Vec3::splat(middle);
            film
        };
        let tone = Tone { stops: 0.0, curve: ToneCurve::Linear };
        let shown = |middle: f32| {
            let mut film = film(middle);
            film.pixels.iter_mut().for_each(|p| p.display = tone.display_rgb(p.light.iter().sum()));
            let linear = film.linear(None);
            add(&mut film, &tone, 16.0);
            assert_eq!(film.linear(None), linear);
            film.pixels.iter().map(|p| p.display.y).sum::<f32>()
        };
        assert_eq!(shown(0.9), 0.9);
        assert!(shown(500.0) > 2.0);
    }

    /// What is premultiplied is never brighter than it is opaque, and what is opaque stays so.
    #[test]
    fn glare_beyond_an_edge_covers_as_much_as_it_shines() {
        let mut film = Film { width: 99, height: 99, pixels: vec![Pixel::default(); 99 * 99] };
        let middle = &mut film.pixels[49 * 99 + 49];
        *middle = Pixel { display: Vec3::ONE, alpha: 1.0, ..Pixel::default() };
        middle.light[Pass::Stone as usize] = Vec3::splat(500.0);
        add(&mut film, &Tone { stops: 0.0, curve: ToneCurve::Linear }, 16.0);
        assert!(film.pixels.iter().all(|p| p.display.max_element() <= p.alpha && p.alpha <= 1.0));
        assert!(film.pixels.iter().filter(|p| p.alpha > 0.01).count() > 20);
    }
}
