//! Camera rays: eight wavelengths each, from the eye to the first thing that is no mirror.

use super::film::{Film, PASSES, Pass, Pixel, Thing};
use super::inside;
use super::tone::Tone;
use crate::math::random::{Purpose, Stream};
use crate::optics::colour::{self, BANDS};
use crate::photons::Shots;
use crate::photons::map::PhotonMap;
use crate::scene::{Camera, Finish, Light, Scene};
use crate::transport::{Arrival, Event};
use glam::{Mat3, Vec3};
use rayon::prelude::*;

/// How a picture is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Camera rays a pixel.
    pub rays: u32,
    /// How light becomes a picture.
    pub tone: Tone,
    /// The user's seed.
    pub seed: u64,
}

/// Shadow rays to each light that a pixel of a surface seen directly takes at least, over all its
/// camera rays: a penumbra of 2 % noise.
const SHADOW_RAYS: u32 = 200;
/// Largest side of the grid of shadow rays of one camera ray.
const SHADOW_STRATA: usize = 5;

/// Mirrors in a row, after which a camera ray sees black.
pub(super) const MIRRORS: u32 = 64;

/// The maps of a picture.
pub struct Maps {
    /// Light last from a stone.
    pub caustic: PhotonMap,
    /// Light last from another surface.
    pub indirect: PhotonMap,
}

impl Maps {
    /// Arranges both classes of photons for look-up.
    ///
    /// - `nearest`: photons that an estimate gathers
    pub fn new(scene: &Scene, shots: &Shots, nearest: usize) -> Maps {
        Maps {
            caustic: PhotonMap::new(scene, &shots.caustic, nearest),
            indirect: PhotonMap::new(scene, &shots.indirect, nearest),
        }
    }
}

/// Takes a picture.
///
/// - `row_done`: called after each row, from any thread
///
/// The same scene, maps and settings give the same bytes on any number of threads.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    maps: &Maps,
    settings: &Settings,
    row_done: &(dyn Fn() + Sync),
) -> Film {
    let rgb_from_xyz = colour::to_adapted_srgb(camera.white.xyz(|_| 1.0));
    let view = View { scene, camera, maps, settings, rgb_from_xyz };
    let pixels = (0..settings.height)
        .into_par_iter()
        .flat_map_iter(|y| {
            let row: Vec<Pixel> = (0..settings.width).map(|x| view.pixel(x, y)).collect();
            row_done();
            row
        })
        .collect();
    Film { width: settings.width, height: settings.height, pixels }
}

/// What lies in the middle of each pixel.
pub fn things(scene: &Scene, camera: &Camera, width: u32, height: u32) -> Vec<Thing> {
    let before: Vec<usize> = scene
        .stones
        .iter()
        .scan(0, |sum, placed| Some(std::mem::replace(sum, *sum + placed.stone.facet_count())))
        .collect();
    let thing = |x: u32, y: u32| {
        let (u, v) = ((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32);
        let (origin, direction) = camera.ray(u, v);
        match scene.first(origin, direction, None) {
            Event::Surface(_, at, normal) => Thing { depth: at.distance(origin), facet: 0, normal },
            Event::Stone(i, arrival) => {
                let placed = &scene.stones[i];
                let normal = placed.direction_to_world(placed.stone.normals[arrival.facet]);
                let depth = placed.point_to_world(arrival.point).distance(origin);
                Thing { depth, facet: (before[i] + arrival.facet + 1) as u32, normal }
            }
            Event::Light(..) | Event::Nothing => Thing { depth: f32::INFINITY, ..Thing::default() },
        }
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| thing(x, y)).collect()
}

/// A picture being taken.
pub(super) struct View<'a> {
    pub scene: &'a Scene,
    camera: &'a Camera,
    pub maps: &'a Maps,
    settings: &'a Settings,
    rgb_from_xyz: Mat3,
}

/// A camera ray and what it has gathered: radiance by pass and wavelength. The wavelengths of a ray
/// share its random numbers, so that colour has no noise.
pub(super) struct Sight {
    pub nm: [f32; BANDS],
    light: [[f32; BANDS]; PASSES],
}

impl Sight {
    fn colour(&self, rgb_from_xyz: &Mat3) -> [Vec3; PASSES] {
        let weights = self.nm.map(colour::xyz_weight);
        self.light.map(|bands| {
            let xyz: Vec3 = (0..BANDS).map(|b| weights[b] * bands[b]).sum::<Vec3>() / BANDS as f32;
            *rgb_from_xyz * xyz
        })
    }

    pub fn add(&mut self, pass: Pass, band: usize, radiance: f32) {
        self.light[pass as usize][band] += radiance;
    }
}

/// A camera ray at a stone's surface, about to go in.
pub(super) struct Entering {
    /// The camera ray's number in its pixel.
    pub sight: usize,
    /// The stone's number.
    pub stone: usize,
    pub arrival: Arrival,
    /// Share of each wavelength that mirrors have left.
    pub share: [f32; BANDS],
}

impl View<'_> {
    fn pixel(&self, x: u32, y: u32) -> Pixel {
        let number = u64::from(y) * u64::from(self.settings.width) + u64::from(x);
        let mut stream = Stream::new(self.settings.seed, Purpose::Pixel, number);
        let rays = self.settings.rays.max(1);
        let mut entering = Vec::new();
        let mut sights: Vec<Sight> =
            (0..rays).map(|ray| self.look([x, y], ray, &mut stream, &mut entering)).collect();
        if !entering.is_empty() {
            inside::look_into_stones(self, &entering, &mut sights, &mut stream);
        }
        let mut pixel = Pixel::default();
        for sight in &sights {
            let light = sight.colour(&self.rgb_from_xyz);
            (0..PASSES).for_each(|p| pixel.light[p] += light[p] / rays as f32);
            pixel.shown += self.settings.tone.shown(light.iter().sum()) / rays as f32;
        }
        pixel
    }

    /// One camera ray up to the first thing that is no mirror; at a stone it is noted for later.
    fn look(&self, [x, y]: [u32; 2], ray: u32, stream: &mut Stream, entering: &mut Vec<Entering>) -> Sight {
        let rays = self.settings.rays.max(1);
        let offset = stratified(ray, rays, stream.pair()).map(tent);
        let u = (x as f32 + 0.5 + offset[0]) / self.settings.width as f32;
        let v = (y as f32 + 0.5 + offset[1]) / self.settings.height as f32;
        let shift = stream.unit();
        let nm = std::array::from_fn(|b| colour::wavelength((b as f32 + shift) / BANDS as f32));
        let mut sight = Sight { nm, light: [[0.0; BANDS]; PASSES] };
        let mut share = [1.0; BANDS];
        let (mut origin, mut direction) = self.camera.ray(u, v);
        for _ in 0..MIRRORS {
            match self.scene.first(origin, direction, None) {
                Event::Nothing => break,
                Event::Light(i, colour) => {
                    let light = &self.scene.lights[i];
                    (0..BANDS).for_each(|b| sight.add(Pass::Direct, b, share[b] * light.at(colour, nm[b])));
                    break;
                }
                Event::Surface(s, point, normal) => match &self.scene.surfaces[s].finish {
                    Finish::Mirror(reflectance) => {
                        (0..BANDS).for_each(|b| share[b] *= reflectance.at(nm[b]));
                        (origin, direction) = (point, direction.reflect(normal));
                    }
                    Finish::Diffuse(reflectance) => {
                        (0..BANDS).for_each(|b| share[b] *= reflectance.at(nm[b]));
                        self.see_surface(s, point, normal, &share, &mut sight, stream);
                        break;
                    }
                },
                Event::Stone(stone, arrival) => {
                    entering.push(Entering { sight: ray as usize, stone, arrival, share });
                    break;
                }
            }
        }
        sight
    }

    /// A surface that the camera sees directly.
    ///
    /// - `share`: of each wavelength that the surface and the mirrors before it give back
    fn see_surface(
        &self,
        s: usize,
        point: Vec3,
        normal: Vec3,
        share: &[f32; BANDS],
        sight: &mut Sight,
        stream: &mut Stream,
    ) {
        let per_ray = SHADOW_RAYS.div_ceil(self.settings.rays.max(1));
        let strata = ((per_ray as f32).sqrt().ceil() as usize).min(SHADOW_STRATA);
        let lit: Vec<(&Light, Vec3)> = self
            .scene
            .lights
            .iter()
            .map(|light| {
                let jitter = || stream.pair();
                (light, self.scene.direct_irradiance(light, point, normal, strata, jitter))
            })
            .collect();
        let caustic = self.maps.caustic.irradiance(s, point);
        let indirect = self.maps.indirect.irradiance(s, point);
        for b in 0..BANDS {
            let reflected = share[b] / std::f32::consts::PI;
            let direct: f32 = lit.iter().map(|(light, colour)| light.at(*colour, sight.nm[b])).sum();
            sight.add(Pass::Direct, b, reflected * direct);
            sight.add(Pass::Caustic, b, reflected * caustic[b]);
            sight.add(Pass::Indirect, b, reflected * indirect[b]);
        }
    }
}

/// Two uniforms within the `number`-th of `of` cells of the unit square.
fn stratified(number: u32, of: u32, u: [f32; 2]) -> [f32; 2] {
    let columns = (of as f32).sqrt().ceil() as u32;
    if columns * columns != of {
        return u; // not a square number: plain random places
    }
    [((number % columns) as f32 + u[0]) / columns as f32, ((number / columns) as f32 + u[1]) / columns as f32]
}

/// A number in (−1, 1) with the density of a tent: the reconstruction filter, sampled by weight so
/// that every ray counts alike and pixels stay independent.
fn tent(u: f32) -> f32 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
}
