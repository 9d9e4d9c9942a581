//! Emission of photons: from the lights, through the stone, between the surfaces.
//!
//! Photons go in batches that travel in step: all in the world until they reach the stone, then
//! through it sixteen at a time, then on. Each has its own random stream, so a batch is the same on
//! any thread.

use super::PhotonSets;
use super::photon_light::PhotonLight;
use super::{Class, PhotonSet, PhotonSettings, StoredPhoton};
use crate::parallel;
use crate::photons::stone_scattering;
use crate::photons::stone_scattering::IncidentPhoton;
use crate::sampling::discrete_cdf::DiscreteCdf;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Stream;
use crate::scene::bsdfs::MIDDLE;
use crate::scene::intersection::{Intersection, Past};
use crate::scene::{PhotonGuide, Scene};
use glam::Vec3;

/// Photons of one batch, the unit of parallel work.
const BATCH: u64 = 4096;
/// Batches between two checks of whether there are enough photons.
const ROUND: usize = 16;
/// A class of which no photon has been stored is given up after this many times the photons asked for (the
/// global map of a scene with a single plane is empty), any class after `PATIENCE`² times.
const PATIENCE: u64 = 8;
/// Share of photons aimed at the stones and the spheres around them, at each emission and diffuse
/// reflection. The rest go as the surface sends them, so that light that reaches a stone by any other way
/// is found too: the balance of both densities makes a photon at most double its power, at each of the
/// bounces (with .8 it was five times, and rooms had coloured blotches). Light by way of table and stone is
/// over half of what is in a stone's shadow (`reports/peers.md`).
const AIMED: f32 = 0.5;
/// A light gets at least this share of the photons that an even split would give it.
const LEAST: f32 = 0.1;
/// Most mirrors in a row: two that face each other without loss would keep a photon for ever.
const MIRRORS: u32 = 1000;

/// Segments of a photon's path that are not inside a stone: from the light, to the surface, and
/// from there to the eye.
const OUTSIDE: u32 = 3;

/// Data shared by all photons of a class.
struct EmissionContext<'a> {
    scene: &'a Scene,
    class: Class,
    seed: u64,
    aim: PhotonGuide,
    /// Lights by the probability that a photon starts there.
    lights: DiscreteCdf,
}

impl EmissionContext<'_> {
    fn new(scene: &Scene, class: Class, seed: u64) -> EmissionContext<'_> {
        let aim = scene.photon_guide(AIMED);
        let reach = |l: &crate::scene::Light| l.emitter.importance(&aim) * (l.radiance.element_sum() / 3.0);
        let reaches: Vec<f32> = scene.lights.iter().map(reach).collect();
        let floor = LEAST * reaches.iter().sum::<f32>() / reaches.len().max(1) as f32;
        let total: f32 = reaches.iter().map(|r| r + floor).sum();
        let mut sum = 0.0f32;
        let add = |r: &f32| {
            sum += (r + floor) / total;
            f64::from(sum)
        };
        let lights = DiscreteCdf::from_cumulative(reaches.iter().map(add).collect());
        EmissionContext { scene, class, seed, aim, lights }
    }
}

/// Emits photons until `settings.photons` of a class are stored. If the scene has none or very few of them
/// the result holds what was found.
///
/// - `from`: number of the first photon; consecutive sets have none in common
pub fn emit(scene: &Scene, class: Class, settings: &PhotonSettings, from: u64) -> PhotonSet {
    let target = settings.photons;
    let possible = match class {
        Class::Caustic => scene.has_caustics(),
        Class::Indirect => scene.has_indirect_light(),
    };
    if !possible {
        return PhotonSet::default();
    }
    let room = EmissionContext::new(scene, class, settings.seed);
    let mut photons: Vec<StoredPhoton> = Vec::new();
    let mut emitted = 0;
    let (patience, more_patience) = (PATIENCE * target as u64, PATIENCE * PATIENCE * target as u64);
    'enough: loop {
        let first = from + emitted;
        for batch in parallel::map(ROUND, |b| batch(&room, first + b as u64 * BATCH, BATCH)) {
            let wanted = target - photons.len();
            if let Some((last, _)) = wanted.checked_sub(1).and_then(|last| batch.get(last)) {
                emitted = last + 1 - from;
                photons.extend(batch[..wanted].iter().map(|(_, photon)| photon));
                break 'enough;
            }
            emitted += BATCH;
            photons.extend(batch.iter().map(|(_, photon)| photon));
        }
        if photons.is_empty() && emitted >= patience || emitted >= more_patience {
            break;
        }
    }
    photons.iter_mut().for_each(|photon| photon.power /= emitted as f32);
    PhotonSet { photons, emitted }
}

/// Dimensions of a photon's start: light, wavelength, two of the place on it, three of the direction.
/// Evenly spread over all photons, which makes maps smoother than independent draws do.
type EmissionUniforms = [f64; 7];

/// Number of the stream that shifts the places; photons have the numbers from 0.
const PLACES: u64 = u64::MAX;

/// What a photon met last: a light, a surface, a stone or a mirror, of that number. What comes from a
/// mirror counts as caustic, for no shadow ray finds it.
#[derive(Clone, Copy, PartialEq)]
enum LastEvent {
    Light(usize),
    Surface(usize),
    Stone(usize),
    Mirror(usize),
}

impl LastEvent {
    fn past(self) -> Past {
        match self {
            LastEvent::Light(i) => Past::Light(i),
            LastEvent::Surface(i) | LastEvent::Mirror(i) => Past::Surface(i),
            LastEvent::Stone(i) => Past::Stone(i),
        }
    }
}

/// A photon under way.
struct PhotonPath {
    stream: Stream,
    number: u64,
    point: Vec3,
    direction: Vec3,
    light: PhotonLight,
    /// Uniform number by which the wavelength is chosen at the first interaction with the stone.
    hue: f32,
    last: LastEvent,
}

/// Emits photons `from .. from + count` and returns those of the class that landed, in order.
fn batch(room: &EmissionContext, from: u64, count: u64) -> Vec<(u64, StoredPhoton)> {
    let mut landed = Vec::new();
    let places = KroneckerPoints::new(room.seed, room.class.purpose(), PLACES, from..from + count);
    let mut flights: Vec<PhotonPath> =
        (from..from + count).zip(places).filter_map(|(n, place)| start_path(room, n, place)).collect();
    let mut arrivals: Vec<Vec<(PhotonPath, IncidentPhoton)>> =
        room.scene.stones.iter().map(|_| Vec::new()).collect();
    while !flights.is_empty() {
        for flight in flights.drain(..) {
            if let Some((stone, arrived)) = trace(room, flight, &mut landed) {
                arrivals[stone].push(arrived);
            }
        }
        for (stone, arrivals) in arrivals.iter_mut().enumerate() {
            scatter_all(room.scene, stone, arrivals, &mut flights);
        }
    }
    // the order of landing depends on how long each photon took; the order of the map must not
    landed.sort_by_key(|(number, _)| *number);
    landed
}

/// A photon leaving one of the lights.
///
/// - `place`: its point of the cube of light, wavelength, place and direction
fn start_path(room: &EmissionContext, number: u64, place: EmissionUniforms) -> Option<PhotonPath> {
    let [which, hue, s, t, pick, u, v] = place.map(|x| x as f32);
    let (i, _) = room.lights.sample(which.into());
    let source = room.scene.lights.get(i)?;
    let start = source.emitter.sample_le(&room.aim, [s, t, pick, u, v])?;
    let power = start.power / room.lights.weight(i) as f32;
    let mut stream = Stream::new(room.seed, room.class.purpose(), number);
    let light = PhotonLight::new(|nm| source.radiance_at(power, nm), stream.unit());
    let (point, direction) = (start.point, start.direction);
    Some(PhotonPath { stream, number, point, direction, light, hue, last: LastEvent::Light(i) })
}

/// Traces a photon through the world until it ends or reaches a stone.
fn trace(
    room: &EmissionContext,
    mut flight: PhotonPath,
    landed: &mut Vec<(u64, StoredPhoton)>,
) -> Option<(usize, (PhotonPath, IncidentPhoton))> {
    let scene = room.scene;
    let mut mirrors = 0;
    loop {
        match scene.intersect(flight.point, flight.direction, flight.last.past()) {
            Intersection::Stone(stone, arrival) => {
                let nm = flight.light.single_wavelength(flight.hue);
                let choice = flight.stream.unit64();
                return Some((stone, (flight, IncidentPhoton { hit: arrival, nm, choice })));
            }
            Intersection::Surface(at) => {
                let finish = &*scene.surfaces[at.surface].finish;
                if !finish.is_delta() {
                    let wanted = match flight.last {
                        LastEvent::Light(_) => false,
                        LastEvent::Stone(_) | LastEvent::Mirror(_) => room.class == Class::Caustic,
                        LastEvent::Surface(_) => room.class == Class::Indirect,
                    };
                    if wanted {
                        landed.push((flight.number, StoredPhoton::new(&at, flight.light.spectrum())));
                    }
                } else {
                    mirrors += 1;
                    if mirrors > MIRRORS {
                        return None;
                    }
                }
                if !flight.light.reflect(|nm| finish.reflectance(nm), flight.stream.unit()) {
                    return None;
                }
                flight.point = scene.start(&at);
                if finish.is_delta() {
                    flight.direction = finish.sample(at.normal, flight.direction, MIDDLE);
                    flight.last = LastEvent::Mirror(at.surface);
                } else {
                    let (pick, u) = (flight.stream.unit(), flight.stream.pair());
                    let scattered =
                        room.aim.scattered(finish, at.point, at.normal, flight.direction, pick, u);
                    let (direction, weight) = scattered?;
                    flight.direction = direction;
                    flight.light.scale(weight);
                    flight.last = LastEvent::Surface(at.surface);
                }
            }
            Intersection::Light(..) | Intersection::None => return None,
        }
    }
}

/// Scatters all photons that have reached a stone by it.
fn scatter_all(
    scene: &Scene,
    number: usize,
    arrivals: &mut Vec<(PhotonPath, IncidentPhoton)>,
    out: &mut Vec<PhotonPath>,
) {
    let placed = &scene.stones[number];
    let entering: Vec<IncidentPhoton> = arrivals.iter().map(|(_, e)| *e).collect();
    let departures = stone_scattering::scatter(placed, scene.max_bounces(OUTSIDE), &entering);
    for ((mut flight, _), departure) in arrivals.drain(..).zip(departures) {
        flight.point = placed.point_to_world(departure.point);
        flight.direction = placed.direction_to_world(departure.direction);
        flight.light.scale(departure.share);
        flight.last = LastEvent::Stone(number);
        out.push(flight);
    }
}

impl PhotonSets {
    /// Emits photons into a scene until each class has as many as asked for.
    pub fn emit(scene: &Scene, settings: &PhotonSettings) -> PhotonSets {
        PhotonSets::resume(scene, settings, [0, 0])
    }

    /// Emits the photons that come after those emitted so far, caustic and indirect ones.
    pub fn resume(scene: &Scene, settings: &PhotonSettings, [caustic, indirect]: [u64; 2]) -> PhotonSets {
        PhotonSets {
            caustic: emit(scene, Class::Caustic, settings, caustic),
            indirect: emit(scene, Class::Indirect, settings, indirect),
        }
    }
}
