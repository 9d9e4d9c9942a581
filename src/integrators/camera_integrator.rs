//! Camera integrator: rays of eight wavelengths each, from the eye to the first thing that is no mirror.

pub(super) use super::camera_sample::{CameraIntegrator, CameraSample, MAX_MIRRORS, StoneArrival};
pub use super::camera_sample::{PhotonMaps, RenderSettings};
use super::film::{Film, FirstHit, PASSES, Pass, Pixel};
use super::sensor::{Sensor, purest};
use super::stone_integrator;
use crate::color::cie;
use crate::color::cie::BANDS;
use crate::parallel;
use crate::photons::BandSpectrum;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::{Purpose, Stream};
use crate::scene::bsdfs::MIDDLE;
use crate::scene::intersection::{Intersection, Past, SurfacePoint};
use crate::scene::{Camera, Light, Scene};
use glam::Vec3;
use std::ops::Range;

/// Shadow rays to each light that a pixel of a surface seen directly takes over all its camera
/// rays: evenly spread over the light, a penumbra of 2 % noise.
const SHADOW_RAYS: u32 = 64;
/// Most shadow rays to each light of one camera ray.
const SHADOW_RAYS_EACH: u32 = 9;

/// An estimate of the maps holds within this share of its disc's radius: the camera rays of a pixel that
/// lie closer together share one.
const HOLDS: f32 = 0.1;

/// Places of camera rays, one stream a pixel.
const CAMERA_STREAM: Purpose = Purpose::named("camera ray");
/// Wavelengths of camera rays, one stream a pixel.
const HUE_STREAM: Purpose = Purpose::named("hue");
/// Places where camera rays cross the lens, one stream a pixel.
const LENS_STREAM: Purpose = Purpose::named("lens");
/// Places of lights that shadow rays look at, one stream a pixel and light.
const SHADOW_STREAM: Purpose = Purpose::named("shadow ray");
/// Other choices of camera rays, one stream a pixel.
const PIXEL_STREAM: Purpose = Purpose::named("pixel");

/// Renders a picture.
///
/// - `row_done`: called after each row, from any thread
///
/// The same scene, maps and settings give the same bytes on any number of threads.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    maps: &PhotonMaps,
    settings: &RenderSettings,
    row_done: &(dyn Fn() + Sync),
) -> Film {
    let view = CameraIntegrator { scene, camera, maps, settings, sensor: Sensor::new(camera) };
    let rows = parallel::map(settings.height as usize, |y| {
        let row: Vec<Pixel> = (0..settings.width).map(|x| view.pixel(x, y as u32)).collect();
        row_done();
        row
    });
    Film { width: settings.width, height: settings.height, pixels: rows.into_iter().flatten().collect() }
}

/// The first thing in the middle of each pixel.
pub fn first_hits(scene: &Scene, camera: &Camera, width: u32, height: u32) -> Vec<FirstHit> {
    let before: Vec<usize> = scene
        .stones
        .iter()
        .scan(0, |sum, placed| Some(std::mem::replace(sum, *sum + placed.stone.facet_count())))
        .collect();
    let thing = |x: u32, y: u32| {
        let (u, v) = ((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32);
        let (origin, direction) = camera.ray(u, v);
        match scene.intersect_seen(origin, direction, Past::Nothing) {
            Intersection::Surface(at) => {
                FirstHit { depth: at.point.distance(origin), facet: 0, normal: at.normal }
            }
            Intersection::Stone(i, arrival) => {
                let placed = &scene.stones[i];
                let normal = placed.direction_to_world(placed.stone.normals[arrival.facet]);
                let depth = placed.point_to_world(arrival.point).distance(origin);
                FirstHit { depth, facet: (before[i] + arrival.facet + 1) as u32, normal }
            }
            Intersection::Light(..) | Intersection::None => {
                FirstHit { depth: f32::INFINITY, ..FirstHit::default() }
            }
        }
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| thing(x, y)).collect()
}

/// State shared by the camera rays of a pixel.
struct Shared {
    stream: Stream,
    /// Next places of each light for shadow rays.
    shadows: Vec<KroneckerPoints<2>>,
    /// The last estimate from the maps.
    seen: Option<MapEstimates>,
    entering: Vec<StoneArrival>,
}

/// Irradiance that the maps gave at a place, and how far around it that holds.
struct MapEstimates {
    at: SurfacePoint,
    holds: f32,
    caustic: BandSpectrum,
    indirect: BandSpectrum,
}

impl CameraIntegrator<'_> {
    fn pixel(&self, x: u32, y: u32) -> Pixel {
        let RenderSettings { width, round, seed, .. } = *self.settings;
        let rays = self.settings.samples_per_pixel.max(1);
        let number = u64::from(y) * u64::from(width) + u64::from(x);
        let numbers = |each: u32| {
            let all = u64::from(rays * each);
            u64::from(round) * all..(u64::from(round) + 1) * all
        };
        let lights = self.scene.lights.len() as u64;
        let shadow = |light| {
            KroneckerPoints::new(seed, SHADOW_STREAM, number * lights + light, numbers(self.shadow_rays()))
        };
        let mut shared = Shared {
            stream: Stream::new(seed, PIXEL_STREAM, number | u64::from(round) << 32),
            shadows: (0..lights).map(shadow).collect(),
            seen: None,
            entering: Vec::new(),
        };
        let mut sights: Vec<CameraSample> = self
            .places(number, numbers(1))
            .enumerate()
            .map(|(ray, place)| self.radiance_along([x, y], ray, place.map(|p| p as f32), &mut shared))
            .collect();
        if !shared.entering.is_empty() {
            stone_integrator::radiance_of_stones(self, &shared.entering, &mut sights, &mut shared.stream);
        }
        let mut pixel = Pixel::default();
        for sight in &sights {
            let light = sight.colour(&self.sensor);
            (0..PASSES).for_each(|p| pixel.light[p] += light[p] / rays as f32);
            pixel.display += self.display_rgb(sight, light.iter().sum()) / rays as f32;
            pixel.alpha += if sight.left_out { 0.0 } else { 1.0 / rays as f32 };
        }
        pixel
    }

    /// Display colour of a camera ray.
    ///
    /// - `light`: of all passes
    fn display_rgb(&self, sight: &CameraSample, light: Vec3) -> Vec3 {
        let tone = &self.settings.tone;
        match &self.sensor {
            Sensor::Eye(rgb_from_xyz) => light * tone.gain(sight.even_colour(rgb_from_xyz)),
            Sensor::Flat(_) => tone.display_rgb(purest(light)),
        }
    }

    /// Where camera rays of a pixel lie: place, wavelength, lens. A sequence for each is more even in
    /// the plane, which is where edges of facets are, than one for all is.
    fn places(&self, pixel: u64, rays: Range<u64>) -> impl Iterator<Item = [f64; 5]> {
        let seed = self.settings.seed;
        let places = KroneckerPoints::<2>::new(seed, CAMERA_STREAM, pixel, rays.clone());
        let hues = KroneckerPoints::<1>::new(seed, HUE_STREAM, pixel, rays.clone());
        let lens = KroneckerPoints::<2>::new(seed, LENS_STREAM, pixel, rays);
        places.zip(hues).zip(lens).map(|(([across, down], [hue]), [u, v])| [across, down, hue, u, v])
    }

    /// Shadow rays to each light of one camera ray.
    fn shadow_rays(&self) -> u32 {
        SHADOW_RAYS.div_ceil(self.settings.samples_per_pixel.max(1)).min(SHADOW_RAYS_EACH)
    }

    /// One camera ray up to the first thing that is no mirror; at a stone it is noted for later.
    ///
    /// - `number`: of the ray in its pixel; `place`: its point of the cube of place, wavelength and lens
    fn radiance_along(
        &self,
        [x, y]: [u32; 2],
        number: usize,
        place: [f32; 5],
        shared: &mut Shared,
    ) -> CameraSample {
        let [across, down, hue, on_lens @ ..] = place;
        let u = (x as f32 + 0.5 + tent(across)) / self.settings.width as f32;
        let v = (y as f32 + 0.5 + tent(down)) / self.settings.height as f32;
        let nm = std::array::from_fn(|b| cie::wavelength((b as f32 + hue) / BANDS as f32));
        let mut sight = CameraSample { nm, light: [[0.0; BANDS]; PASSES], left_out: false };
        let mut share = [1.0; BANDS];
        let (mut origin, mut direction) = self.camera.ray_through(u, v, on_lens);
        let mut past = Past::Nothing;
        for mirrors in 0..MAX_MIRRORS {
            let event = self.scene.intersect_seen(origin, direction, past);
            if mirrors == 0 && self.scene.cut_out && is_background(self.scene, &event) {
                sight.left_out = true;
                break;
            }
            match event {
                Intersection::None => {
                    for (light, colour) in self.scene.distant_lights(direction) {
                        sight.add_light(Pass::Direct, &share, light, colour);
                    }
                    break;
                }
                Intersection::Light(i, colour) => {
                    sight.add_light(Pass::Direct, &share, &self.scene.lights[i], colour);
                    break;
                }
                Intersection::Surface(at) => {
                    let finish = &self.scene.surfaces[at.surface].finish;
                    (0..BANDS).for_each(|b| share[b] *= finish.reflectance(nm[b]));
                    if !finish.is_delta() {
                        self.radiance_of_surface(&at, direction, &share, &mut sight, shared);
                        break;
                    }
                    // a mirror goes the same way from the eye as to it
                    direction = finish.sample(at.normal, direction, MIDDLE);
                    origin = self.scene.start(&at);
                    past = Past::Surface(at.surface);
                }
                Intersection::Stone(stone, arrival) => {
                    shared.entering.push(StoneArrival { sight: number, stone, hit: arrival, share });
                    break;
                }
            }
        }
        sight
    }

    /// A surface that the camera sees directly.
    ///
    /// - `direction`: of the camera ray; `share`: of each wavelength that the surface and the mirrors before it give back
    fn radiance_of_surface(
        &self,
        at: &SurfacePoint,
        direction: Vec3,
        share: &[f32; BANDS],
        sight: &mut CameraSample,
        shared: &mut Shared,
    ) {
        let finish = &self.scene.surfaces[at.surface].finish;
        let scattered = |incoming: Vec3| finish.eval(at.normal, incoming, -direction);
        let each = self.shadow_rays() as usize;
        let lights = self.scene.lights.iter().enumerate().zip(&mut shared.shadows);
        let lit: Vec<(&Light, Vec3)> = lights
            .map(|((i, light), places)| {
                let places = places.take(each).map(|place| place.map(|p| p as f32));
                (light, self.scene.direct_light(i, at, places, scattered))
            })
            .collect();
        let near = |seen: &MapEstimates| {
            let same = (seen.at.surface, seen.at.front) == (at.surface, at.front);
            same && seen.at.point.distance(at.point) < seen.holds
        };
        let seen = shared.seen.take().filter(near).unwrap_or_else(|| self.map_estimates(at));
        for (b, share) in share.iter().enumerate() {
            let reflected = share / std::f32::consts::PI;
            let direct: f32 = lit.iter().map(|(light, colour)| light.radiance_at(*colour, sight.nm[b])).sum();
            sight.add(Pass::Direct, b, reflected * direct);
            sight.add(Pass::Caustic, b, reflected * seen.caustic[b]);
            sight.add(Pass::Indirect, b, reflected * seen.indirect[b]);
        }
        shared.seen = Some(seen);
    }

    fn map_estimates(&self, at: &SurfacePoint) -> MapEstimates {
        let (caustic, one) = self.maps.caustic.irradiance(at);
        let (indirect, other) = self.maps.indirect.irradiance(at);
        MapEstimates { at: *at, holds: HOLDS * one.min(other), caustic, indirect }
    }
}

/// Whether a camera ray that meets this first sees the background: nothing, a light, or a surface that
/// is a backdrop.
fn is_background(scene: &Scene, event: &Intersection) -> bool {
    match event {
        Intersection::None | Intersection::Light(..) => true,
        Intersection::Surface(at) => scene.surfaces[at.surface].backdrop,
        Intersection::Stone(..) => false,
    }
}

/// A number in (−1, 1) with the density of a tent: the reconstruction filter, sampled by weight so
/// that every ray counts alike and pixels stay independent.
fn tent(u: f32) -> f32 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
}
