//! Camera rays: eight wavelengths each, two rays to a packet.

use super::film::{Film, Pass, Pixel};
use crate::math::random::{Purpose, Stream};
use crate::optics::colour::{self, BANDS};
use crate::photons::Spectrum;
use crate::photons::map::PhotonMap;
use crate::scene::{Camera, Scene};
use crate::transport::Event;
use crate::walk::{LANES, Packet};
use glam::Vec3;
use rayon::prelude::*;

/// How a picture is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Camera rays a pixel, rounded up to an even number.
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

/// Takes a picture.
///
/// - `row_done`: called after each row, from any thread
///
/// The same scene, maps and settings give the same bytes on any number of threads.
pub fn render(scene: &Scene, camera: &Camera, maps: &Maps, settings: &Settings, row_done: &(dyn Fn() + Sync)) -> Film {
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

/// A camera ray and what it has gathered: radiance by pass and wavelength.
struct Sight {
    nm: [f32; BANDS],
    /// Shadow-ray jitter and lots are shared by the wavelengths, so that colour has no noise.
    light: [[f32; BANDS]; 3],
}

impl Sight {
    fn colour(&self) -> Pixel {
        self.light.map(|bands| {
            let xyz: Vec3 = (0..BANDS).map(|b| colour::xyz_weight(self.nm[b]) * bands[b]).sum::<Vec3>() / BANDS as f32;
            colour::linear_srgb(xyz)
        })
    }

    fn add(&mut self, pass: Pass, band: usize, radiance: f32) {
        self.light[pass as usize][band] += radiance;
    }
}

/// Photon irradiance of the surface a pixel shows, gathered once a pixel.
#[derive(Default)]
struct Gathered(Option<(usize, Spectrum, Spectrum)>);

impl View<'_> {
    fn pixel(&self, x: u32, y: u32) -> Pixel {
        let mut stream =
            Stream::new(self.settings.seed, Purpose::Pixel, u64::from(y) * u64::from(self.settings.width) + u64::from(x));
        let rays = self.settings.rays.next_multiple_of(2).max(2);
        let mut gathered = Gathered::default();
        let mut sum: Pixel = [Vec3::ZERO; 3];
        for pair in 0..rays / 2 {
            let mut inside = Inside::default();
            let mut sights: [Sight; 2] = std::array::from_fn(|half| {
                let number = 2 * pair + half as u32;
                self.look(x, y, number, rays, &mut stream, &mut gathered, half, &mut inside)
            });
            if inside.any {
                self.follow(&mut inside, &mut sights, &mut stream);
            }
            for sight in &sights {
                let colour = sight.colour();
                (0..3).for_each(|p| sum[p] += colour[p]);
            }
        }
        sum.map(|c| c / rays as f32)
    }

    /// One camera ray up to the first thing it meets; the part that enters the stone is laid into
    /// half of the packet.
    #[allow(clippy::too_many_arguments)] // the state of a pixel, passed once
    fn look(
        &self,
        x: u32,
        y: u32,
        number: u32,
        rays: u32,
        stream: &mut Stream,
        gathered: &mut Gathered,
        half: usize,
        inside: &mut Inside,
    ) -> Sight {
        let offset = [tent(stratum(stream.unit(), number, rays)), tent(stratum(stream.unit(), number * 7 + 3, rays))];
        let u = (x as f32 + 0.5 + offset[0]) / self.settings.width as f32;
        let v = (y as f32 + 0.5 + offset[1]) / self.settings.height as f32;
        let shift = stream.unit();
        let nm = std::array::from_fn(|b| colour::wavelength((b as f32 + shift) / BANDS as f32));
        let mut sight = Sight { nm, light: [[0.0; BANDS]; 3] };
        let direction = self.camera.ray(u, v);
        match self.scene.first(self.camera.position, direction, false) {
            Event::Nothing => {}
            Event::Light(i) => (0..BANDS).for_each(|b| sight.add(Pass::Direct, b, self.scene.lights[i].radiance)),
            Event::Surface(s, point) => self.see_surface(s, point, &mut sight, stream, gathered),
            Event::Stone { facet, point, direction } => {
                self.enter(facet, point, direction, &mut sight, stream, half, inside);
            }
        }
        sight
    }

    /// A surface that the camera sees directly: 25 shadow rays a light, photons gathered in full.
    fn see_surface(&self, s: usize, point: Vec3, sight: &mut Sight, stream: &mut Stream, gathered: &mut Gathered) {
        let surface = &self.scene.surfaces[s];
        let direct = self.scene.direct_irradiance(point, surface.normal(), SHADOW_STRATA, || stream.pair());
        let (caustic, indirect) = match gathered.0 {
            Some((of, caustic, indirect)) if of == s => (caustic, indirect),
            _ => {
                let caustic = self.maps.caustic.irradiance(self.scene, s, point);
                let indirect = self.maps.indirect.irradiance(self.scene, s, point);
                gathered.0 = Some((s, caustic, indirect));
                (caustic, indirect)
            }
        };
        for b in 0..BANDS {
            let reflected = surface.reflectance.at(sight.nm[b]) / std::f32::consts::PI;
            sight.add(Pass::Direct, b, reflected * direct);
            sight.add(Pass::Caustic, b, reflected * caustic[b]);
            sight.add(Pass::Indirect, b, reflected * indirect[b]);
        }
    }

    /// The stone's surface: what it mirrors is seen at once, what it lets in joins the packet.
    #[allow(clippy::too_many_arguments)] // the state of a pixel, passed once
    fn enter(
        &self,
        facet: usize,
        point: Vec3,
        direction: Vec3,
        sight: &mut Sight,
        stream: &mut Stream,
        half: usize,
        inside: &mut Inside,
    ) {
        let placed = &self.scene.stone;
        let mut reflectance = [0.0; BANDS];
        for b in 0..BANDS {
            let index = placed.index(sight.nm[b]);
            let entry = placed.stone.enter(facet, direction, index);
            reflectance[b] = entry.reflectance;
            inside.packet.set(half * BANDS + b, point, entry.direction, 1.0 - entry.reflectance, index);
        }
        inside.any = true;
        let normal = placed.stone.normals[facet];
        let mirrored = direction - 2.0 * direction.dot(normal) * normal;
        let (origin, direction) = (placed.point_to_world(point), placed.direction_to_world(mirrored));
        let (lot, jitter) = (stream.unit(), stream.pair());
        for b in 0..BANDS {
            self.look_out(origin, direction, b, reflectance[b], sight, lot, jitter);
        }
    }

    /// Follows a packet through the stone and looks along every way out.
    fn follow(&self, inside: &mut Inside, sights: &mut [Sight; 2], stream: &mut Stream) {
        let placed = &self.scene.stone;
        placed.stone.walk(&mut inside.packet, STOP_SHARE, |meeting, packet| {
            let lots = [stream.unit(), stream.unit()];
            let jitter = stream.pair();
            for lane in 0..LANES {
                let Some(exit) = meeting.exit(packet, lane) else { continue };
                let half = lane / BANDS;
                let origin = placed.point_to_world(exit.point);
                let direction = placed.direction_to_world(exit.direction);
                self.look_out(origin, direction, lane % BANDS, exit.power, &mut sights[half], lots[half], jitter);
            }
        });
    }

    /// What one wavelength sees along a ray that leaves the stone with `power`: a light always, a
    /// surface by lot if the power is small, and then it counts for more.
    #[allow(clippy::too_many_arguments)] // one ray
    fn look_out(
        &self,
        origin: Vec3,
        direction: Vec3,
        band: usize,
        power: f32,
        sight: &mut Sight,
        lot: f32,
        jitter: [f32; 2],
    ) {
        match self.scene.first(origin, direction, true) {
            Event::Light(i) => sight.add(Pass::Direct, band, power * self.scene.lights[i].radiance),
            Event::Surface(s, at) => {
                let chance = (power / LOT_SHARE).min(1.0);
                if lot < chance {
                    self.see_afar(s, at, band, power / chance, sight, jitter);
                }
            }
            _ => {}
        }
    }

    /// A surface seen through the stone or mirrored in it, at one wavelength: one shadow ray,
    /// photons from what is known beforehand.
    fn see_afar(&self, s: usize, at: Vec3, band: usize, weight: f32, sight: &mut Sight, jitter: [f32; 2]) {
        let surface = &self.scene.surfaces[s];
        let reflected = weight * surface.reflectance.at(sight.nm[band]) / std::f32::consts::PI;
        let direct = self.scene.direct_irradiance(at, surface.normal(), 1, || jitter);
        sight.add(Pass::Direct, band, reflected * direct);
        sight.add(Pass::Caustic, band, reflected * self.maps.caustic.known_irradiance(s, at)[band]);
        sight.add(Pass::Indirect, band, reflected * self.maps.indirect.known_irradiance(s, at)[band]);
    }
}

/// Two camera rays in the stone.
#[derive(Default)]
struct Inside {
    packet: Packet,
    any: bool,
}

/// Uniform within the `number`-th of `of` strata of (0, 1).
fn stratum(u: f32, number: u32, of: u32) -> f32 {
    ((number % of) as f32 + u) / of as f32
}

/// A number in (−1, 1) with the density of a tent: the reconstruction filter, sampled by weight so
/// that every ray counts alike and pixels stay independent.
fn tent(u: f32) -> f32 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
}
