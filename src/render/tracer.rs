//! Camera rays: eight wavelengths each, two rays to a packet at a time.

use super::film::{Film, Pass, Pixel};
use crate::math::random::{Purpose, Stream};
use crate::optics::colour::{self, BANDS};
use crate::photons::Shots;
use crate::photons::map::PhotonMap;
use crate::scene::{Camera, Scene};
use crate::transport::Event;
use crate::walk::feed::{self, Rays};
use crate::walk::{LANES, Meeting, Packet};
use glam::Vec3;
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
    /// The user's seed.
    pub seed: u64,
}

/// Side of the grid of shadow rays on each light for a surface that the camera sees directly.
const SHADOW_STRATA: usize = 5;

/// A camera ray inside the stone is followed until this share of its power is left.
const STOP_SHARE: f32 = 2e-3;

/// Ways out of the stone that carry less than this share are looked along by lot, with a
/// probability in proportion; lights at their end are always seen.
const LOT_SHARE: f32 = 0.08;

/// The maps of a picture.
pub struct Maps {
    /// Light last from the stone.
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
    let view = View { scene, camera, maps, settings };
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

struct View<'a> {
    scene: &'a Scene,
    camera: &'a Camera,
    maps: &'a Maps,
    settings: &'a Settings,
}

/// A camera ray and what it has gathered: radiance by pass and wavelength. The wavelengths of a ray
/// share its random numbers, so that colour has no noise.
struct Sight {
    nm: [f32; BANDS],
    light: [[f32; BANDS]; 3],
}

impl Sight {
    fn colour(&self) -> Pixel {
        self.light.map(|bands| {
            let xyz: Vec3 =
                (0..BANDS).map(|b| colour::xyz_weight(self.nm[b]) * bands[b]).sum::<Vec3>() / BANDS as f32;
            colour::linear_srgb(xyz)
        })
    }

    fn add(&mut self, pass: Pass, band: usize, radiance: f32) {
        self.light[pass as usize][band] += radiance;
    }
}

/// A camera ray at the stone's surface, about to go in.
struct Entering {
    sight: usize,
    facet: usize,
    point: Vec3,
    direction: Vec3,
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
            let placed = &self.scene.stone;
            let mut inside = Inside {
                view: self,
                entering: entering.iter(),
                sights: &mut sights,
                stream: &mut stream,
                sight_of: [0; LANES],
            };
            feed::walk_all(&placed.stone, STOP_SHARE, &mut inside);
        }
        let mut sum: Pixel = [Vec3::ZERO; 3];
        for sight in &sights {
            let colour = sight.colour();
            (0..3).for_each(|p| sum[p] += colour[p]);
        }
        sum.map(|c| c / rays as f32)
    }

    /// One camera ray up to the first thing it meets; at the stone it is noted for later.
    fn look(&self, [x, y]: [u32; 2], ray: u32, stream: &mut Stream, entering: &mut Vec<Entering>) -> Sight {
        let rays = self.settings.rays.max(1);
        let offset = stratified(ray, rays, stream.pair()).map(tent);
        let u = (x as f32 + 0.5 + offset[0]) / self.settings.width as f32;
        let v = (y as f32 + 0.5 + offset[1]) / self.settings.height as f32;
        let shift = stream.unit();
        let nm = std::array::from_fn(|b| colour::wavelength((b as f32 + shift) / BANDS as f32));
        let mut sight = Sight { nm, light: [[0.0; BANDS]; 3] };
        let direction = self.camera.ray(u, v);
        match self.scene.first(self.camera.position, direction, false) {
            Event::Nothing => {}
            Event::Light(i) => {
                (0..BANDS).for_each(|b| sight.add(Pass::Direct, b, self.scene.lights[i].radiance));
            }
            Event::Surface(s, point) => self.see_surface(s, point, &mut sight, stream),
            Event::Stone { facet, point, direction } => {
                entering.push(Entering { sight: ray as usize, facet, point, direction });
            }
        }
        sight
    }

    /// A surface that the camera sees directly: 25 shadow rays a light.
    fn see_surface(&self, s: usize, point: Vec3, sight: &mut Sight, stream: &mut Stream) {
        let surface = &self.scene.surfaces[s];
        let direct = self.scene.direct_irradiance(point, surface.normal(), SHADOW_STRATA, || stream.pair());
        let caustic = self.maps.caustic.irradiance(s, point);
        let indirect = self.maps.indirect.irradiance(s, point);
        for b in 0..BANDS {
            let reflected = surface.reflectance.at(sight.nm[b]) / std::f32::consts::PI;
            sight.add(Pass::Direct, b, reflected * direct);
            sight.add(Pass::Caustic, b, reflected * caustic[b]);
            sight.add(Pass::Indirect, b, reflected * indirect[b]);
        }
    }

    /// What one wavelength sees along a way out of the stone: a light always, a surface by lot if
    /// the power is small, and then it counts for more.
    fn look_out(&self, way: WayOut, sight: &mut Sight, chance: Chance) {
        let placed = &self.scene.stone;
        let origin = placed.point_to_world(way.point);
        let direction = placed.direction_to_world(way.direction);
        match self.scene.first(origin, direction, true) {
            Event::Light(i) => sight.add(Pass::Direct, way.band, way.power * self.scene.lights[i].radiance),
            Event::Surface(s, at) => {
                let probability = (way.power / LOT_SHARE).min(1.0);
                if chance.lot < probability {
                    self.see_afar(s, at, way.band, way.power / probability, sight, chance.jitter);
                }
            }
            _ => {}
        }
    }

    /// A surface seen through the stone or mirrored in it, at one wavelength: one shadow ray a
    /// light, photons from the nearest known place.
    fn see_afar(&self, s: usize, at: Vec3, band: usize, weight: f32, sight: &mut Sight, jitter: [f32; 2]) {
        let surface = &self.scene.surfaces[s];
        let reflected = weight * surface.reflectance.at(sight.nm[band]) / std::f32::consts::PI;
        let direct = self.scene.direct_irradiance(at, surface.normal(), 1, || jitter);
        sight.add(Pass::Direct, band, reflected * direct);
        sight.add(Pass::Caustic, band, reflected * self.maps.caustic.irradiance_nearby(s, at)[band]);
        sight.add(Pass::Indirect, band, reflected * self.maps.indirect.irradiance_nearby(s, at)[band]);
    }
}

/// A ray that leaves the stone, in the walking frame.
struct WayOut {
    point: Vec3,
    direction: Vec3,
    band: usize,
    power: f32,
}

/// Random numbers of one meeting.
#[derive(Clone, Copy)]
struct Chance {
    lot: f32,
    jitter: [f32; 2],
}

impl Chance {
    fn draw(stream: &mut Stream) -> Chance {
        Chance { lot: stream.unit(), jitter: stream.pair() }
    }
}

/// The camera rays of a pixel inside the stone, eight lanes each.
struct Inside<'a, 'v> {
    view: &'a View<'v>,
    entering: std::slice::Iter<'a, Entering>,
    sights: &'a mut [Sight],
    stream: &'a mut Stream,
    /// For each lane the camera ray that it carries.
    sight_of: [usize; LANES],
}

impl Rays for Inside<'_, '_> {
    const WIDTH: usize = BANDS;

    fn polarised(&self) -> bool {
        self.view.scene.stone.polarised
    }

    fn absorbing(&self) -> bool {
        !self.view.scene.stone.material.is_clear()
    }

    /// Lets a camera ray in; what the facet mirrors is seen at once.
    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(e) = self.entering.next() else { return false };
        let placed = &self.view.scene.stone;
        let sight = &mut self.sights[e.sight];
        let mirrored = placed.stone.reflect(e.facet, e.direction);
        let chance = Chance::draw(self.stream);
        for band in 0..BANDS {
            let index = placed.index(sight.nm[band]);
            let entry = placed.stone.enter(e.facet, e.direction, index);
            packet.enter(lane + band, e.point, &entry, index);
            packet.absorption[lane + band] = placed.absorption(sight.nm[band]);
            let way = WayOut { point: e.point, direction: mirrored, band, power: entry.reflectance };
            self.view.look_out(way, sight, chance);
        }
        self.sight_of[lane..lane + BANDS].fill(e.sight);
        true
    }

    fn meet(&mut self, meeting: &Meeting, packet: &Packet) {
        let chances: [Chance; LANES / BANDS] = std::array::from_fn(|_| Chance::draw(self.stream));
        for lane in 0..LANES {
            let Some(exit) = meeting.exit(packet, lane) else { continue };
            let way = WayOut {
                point: exit.point,
                direction: exit.direction,
                band: lane % BANDS,
                power: exit.power,
            };
            self.view.look_out(way, &mut self.sights[self.sight_of[lane]], chances[lane / BANDS]);
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
