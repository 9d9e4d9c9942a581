//! Sending photons: from the lights, through the stone, between the surfaces.
//!
//! Photons go in batches that travel in step: all in the world until they reach the stone, then
//! through it sixteen at a time, then on. Each has its own random stream, so a batch is the same on
//! any thread.

use super::light::Light;
use super::{Class, Photon, Settings, Shot};
use crate::math::points::Points;
use crate::math::random::Stream;
use crate::math::sample;
use crate::scene::{Scene, SquareLight};
use crate::transport::Event;
use crate::transport::crossing::{self, Arrival};
use glam::Vec3;
use rayon::prelude::*;

/// Photons of one batch, the unit of parallel work.
const BATCH: u64 = 4096;
/// Batches between two looks at whether there are enough.
const ROUND: u64 = 16;
/// Give up a class of which nothing is found after emitting this many times the photons asked for
/// (the global map of a scene with a single plane is empty), and any class after `PATIENCE`² times.
const PATIENCE: u64 = 8;
/// Share of caustic photons aimed at the stone, at each emission and diffuse reflection. The rest
/// go as the surface sends them, so that light that reaches the stone by way of a surface is found
/// too; the balance of both densities keeps powers within a factor of two of each other's class.
const AIMED: f32 = 0.5;

/// Shoots photons until `settings.photons` of a class are stored. If the scene has none or very few
/// of them the result holds what was found.
pub fn shoot(scene: &Scene, class: Class, settings: &Settings) -> Shot {
    let target = settings.photons as u64;
    let mut found: Vec<(u64, Photon)> = Vec::new();
    let mut emitted = 0;
    loop {
        let batches: Vec<Vec<(u64, Photon)>> = (0..ROUND)
            .into_par_iter()
            .map(|b| batch(scene, class, settings.seed, emitted + b * BATCH, BATCH))
            .collect();
        emitted += ROUND * BATCH;
        batches.into_iter().for_each(|b| found.extend(b));
        let hopeless = found.is_empty() && emitted >= PATIENCE * target;
        if found.len() as u64 >= target || hopeless || emitted >= PATIENCE * PATIENCE * target {
            break;
        }
    }
    if found.len() > settings.photons {
        found.truncate(settings.photons);
        emitted = found.last().map_or(emitted, |(index, _)| index + 1);
    }
    let scale = 1.0 / emitted as f32;
    let photons = found.into_iter().map(|(_, p)| Photon { power: p.power * scale, ..p }).collect();
    Shot { photons, emitted }
}

/// Where a photon starts: light, wavelength, two for the place on it, three for the direction.
/// Evenly spread over all photons, which makes maps smoother than independent draws do.
type Place = [f64; 7];

/// Number of the stream that shifts the places; photons have the numbers from 0.
const PLACES: u64 = u64::MAX;

/// What a photon met last.
#[derive(Clone, Copy, PartialEq)]
enum Last {
    Light,
    Surface,
    Stone,
}

/// A photon under way.
struct Flight {
    stream: Stream,
    number: u64,
    point: Vec3,
    direction: Vec3,
    light: Light,
    /// Uniform number by which the wavelength is chosen at the first meeting with the stone.
    hue: f32,
    last: Last,
}

/// Emits photons `from .. from + count` and returns those of `class` that landed, in order.
fn batch(scene: &Scene, class: Class, seed: u64, from: u64, count: u64) -> Vec<(u64, Photon)> {
    let aimed = if class == Class::Caustic { AIMED } else { 0.0 };
    let mut landed = Vec::new();
    let places = Points::new(seed, class.purpose(), PLACES, from..from + count);
    let mut flights: Vec<Flight> = (from..from + count)
        .zip(places)
        .filter_map(|(n, place)| emit(scene, class, seed, n, aimed, place))
        .collect();
    let mut arrivals: Vec<(Flight, Arrival)> = Vec::new();
    while !flights.is_empty() {
        for flight in flights.drain(..) {
            arrivals.extend(fly(scene, class, aimed, flight, &mut landed));
        }
        flights = cross_all(scene, &mut arrivals);
    }
    // the order of landing depends on how long each photon took; the order of the map must not
    landed.sort_by_key(|(number, _)| *number);
    landed
}

/// A photon leaving one of the lights, chosen by power.
///
/// - `place`: its point of the cube of light, wavelength, place and direction
fn emit(scene: &Scene, class: Class, seed: u64, number: u64, aimed: f32, place: Place) -> Option<Flight> {
    let [which, hue, s, t, pick, u, v] = place.map(|x| x as f32);
    let total: f32 = scene.lights.iter().map(SquareLight::power).sum();
    let mut rest = which * total;
    let lamp = scene.lights.iter().find(|l| {
        rest -= l.power();
        rest < 0.0
    });
    let lamp = lamp.or(scene.lights.last())?;
    let point = lamp.point([s, t]);
    let (direction, weight) = diffuse_direction(scene, point, lamp.normal(), aimed, pick, [u, v])?;
    let mut stream = Stream::new(seed, class.purpose(), number);
    let light = Light::white(total * weight, stream.unit());
    Some(Flight { stream, number, point, direction, light, hue, last: Last::Light })
}

/// A direction from a diffuse surface or light, a share of them aimed at the sphere around the
/// stone, and the weight that makes the mixture right (balance heuristic). None for a direction
/// below the surface.
///
/// - `pick`, `u`: three uniforms
fn diffuse_direction(
    scene: &Scene,
    point: Vec3,
    normal: Vec3,
    aimed: f32,
    pick: f32,
    u: [f32; 2],
) -> Option<(Vec3, f32)> {
    let to_stone = scene.stone.position - point;
    let sin2 = (scene.stone.radius / to_stone.length()).powi(2);
    if aimed == 0.0 || sin2 >= 1.0 {
        return Some((sample::about(normal, sample::cosine_hemisphere(u)), 1.0));
    }
    let cos_max = (1.0 - sin2).sqrt();
    let axis = to_stone.normalize();
    let direction = if pick < aimed {
        sample::about(axis, sample::cone(u, cos_max))
    } else {
        sample::about(normal, sample::cosine_hemisphere(u))
    };
    let cos = direction.dot(normal);
    if cos <= 0.0 {
        return None;
    }
    let natural = sample::cosine_hemisphere_pdf(cos);
    let in_cone = if direction.dot(axis) >= cos_max { sample::cone_pdf(cos_max) } else { 0.0 };
    Some((direction, natural / (aimed * in_cone + (1.0 - aimed) * natural)))
}

/// Carries a photon through the world until it ends or reaches the stone.
fn fly(
    scene: &Scene,
    class: Class,
    aimed: f32,
    mut flight: Flight,
    landed: &mut Vec<(u64, Photon)>,
) -> Option<(Flight, Arrival)> {
    loop {
        match scene.first(flight.point, flight.direction, flight.last == Last::Stone) {
            Event::Stone { facet, point, direction } => {
                let nm = flight.light.single_wavelength(flight.hue);
                let (index, absorption) = (scene.stone.index(nm), scene.stone.absorption(nm));
                let choice = flight.stream.unit64();
                return Some((flight, Arrival { facet, point, direction, index, absorption, choice }));
            }
            Event::Surface(number, point) => {
                let wanted = match flight.last {
                    Last::Light => false,
                    Last::Stone => class == Class::Caustic,
                    Last::Surface => class == Class::Indirect,
                };
                if wanted {
                    landed.push((flight.number, Photon::new(point, number, flight.light.spectrum())));
                }
                let surface = &scene.surfaces[number];
                if !flight.light.reflect(&surface.reflectance, flight.stream.unit()) {
                    return None;
                }
                let (pick, u) = (flight.stream.unit(), flight.stream.pair());
                let (direction, weight) = diffuse_direction(scene, point, surface.normal(), aimed, pick, u)?;
                flight.point = point;
                flight.direction = direction;
                flight.light.weigh(weight);
                flight.last = Last::Surface;
            }
            Event::Light(_) | Event::Nothing => return None,
        }
    }
}

/// Takes all photons that have reached the stone through it.
fn cross_all(scene: &Scene, arrivals: &mut Vec<(Flight, Arrival)>) -> Vec<Flight> {
    let mut out = Vec::with_capacity(arrivals.len());
    let entering: Vec<Arrival> = arrivals.iter().map(|(_, a)| *a).collect();
    let departures = crossing::cross(&scene.stone, &entering);
    for ((mut flight, _), departure) in arrivals.drain(..).zip(departures) {
        flight.point = scene.stone.point_to_world(departure.point);
        flight.direction = scene.stone.direction_to_world(departure.direction);
        flight.light.weigh(departure.share);
        flight.last = Last::Stone;
        out.push(flight);
    }
    out
}
