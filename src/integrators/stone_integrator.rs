//! Stone integrator: camera rays inside stones, and the radiance along their exits.

use super::camera_integrator::{CameraIntegrator, CameraSample, MAX_MIRRORS, StoneArrival};
use super::film::Pass;
use crate::color::cie::BANDS;
use crate::photons::stone_scattering;
use crate::photons::stone_scattering::IncidentPhoton as Single;
use crate::sampling::random::Stream;
use crate::scene::bsdfs::MIDDLE;
use crate::scene::intersection::{Intersection, Past, StoneHit, SurfacePoint};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{Interaction, LANES, Packet};
use glam::Vec3;

/// A camera ray inside a stone is followed until this share of its power is left.
const STOP_SHARE: f32 = 2e-3;

/// Ways out of a stone that carry less than this share are followed by Russian roulette, with a probability
/// in proportion; lights at their end are always seen.
const ROULETTE_BELOW: f32 = 0.08;

/// Segments of a path that are not inside the stone: from the eye, and to the light.
const OUTSIDE: u32 = 2;

/// Follows the camera rays of a pixel through the stones. A way out of the first stone that leads
/// into another goes on by one exit at each, chosen by power.
pub(super) fn radiance_of_stones(
    view: &CameraIntegrator,
    entering: &[StoneArrival],
    sights: &mut [CameraSample],
    stream: &mut Stream,
) {
    let mut onward = Vec::new();
    for (number, placed) in view.scene.stones.iter().enumerate() {
        let mut its = entering.iter().filter(|e| e.stone == number).peekable();
        if its.peek().is_none() {
            continue;
        }
        let mut inside = StoneClient {
            view,
            number,
            entering: its,
            sights: &mut *sights,
            stream: &mut *stream,
            onward: &mut onward,
            carried: [CarriedSample::default(); LANES],
        };
        lane_scheduler::trace_all(&placed.stone, STOP_SHARE, &mut inside);
    }
    while !onward.is_empty() {
        let now = std::mem::take(&mut onward);
        for (number, placed) in view.scene.stones.iter().enumerate() {
            let its: Vec<&OnwardRay> = now.iter().filter(|o| o.stone == number).collect();
            let singles: Vec<Single> = its
                .iter()
                .map(|o| Single { hit: o.arrival, nm: sights[o.sight].nm[o.band], choice: stream.unit64() })
                .collect();
            let departures = stone_scattering::scatter(placed, view.scene.max_bounces(OUTSIDE), &singles);
            for (o, departure) in its.iter().zip(departures) {
                let way = ExitRay {
                    stone: number,
                    point: departure.point,
                    direction: departure.direction,
                    sight: o.sight,
                    band: o.band,
                    power: o.power * departure.share,
                };
                let chance = RandomNumbers::draw(stream);
                radiance_outside(view, way, &mut sights[o.sight], chance, &mut onward);
            }
        }
    }
}

/// A ray of one wavelength that leaves a stone, in its trace frame.
struct ExitRay {
    stone: usize,
    point: Vec3,
    direction: Vec3,
    sight: usize,
    band: usize,
    power: f32,
}

/// A ray of one wavelength about to enter another stone.
struct OnwardRay {
    stone: usize,
    arrival: StoneHit,
    sight: usize,
    band: usize,
    power: f32,
}

/// Random numbers of one interaction.
#[derive(Clone, Copy)]
struct RandomNumbers {
    roulette: f32,
    jitter: [f32; 2],
}

impl RandomNumbers {
    fn draw(stream: &mut Stream) -> RandomNumbers {
        RandomNumbers { roulette: stream.unit(), jitter: stream.pair() }
    }
}

/// Radiance of one wavelength along an exit of a stone: of lights always; of a surface or another stone by
/// Russian roulette if the power is small.
fn radiance_outside(
    view: &CameraIntegrator,
    way: ExitRay,
    sight: &mut CameraSample,
    chance: RandomNumbers,
    onward: &mut Vec<OnwardRay>,
) {
    let scene = view.scene;
    let placed = &scene.stones[way.stone];
    let mut origin = placed.point_to_world(way.point);
    let mut direction = placed.direction_to_world(way.direction);
    let (mut power, mut past) = (way.power, Past::Stone(way.stone));
    let (nm, band) = (sight.nm[way.band], way.band);
    for _ in 0..MAX_MIRRORS {
        let probability = (power / ROULETTE_BELOW).min(1.0);
        let drawn = chance.roulette < probability;
        match scene.intersect(origin, direction, past) {
            Intersection::None => {
                let far: f32 = scene
                    .distant_lights(direction)
                    .map(|(light, colour)| light.radiance_at(colour, nm))
                    .sum();
                sight.add(Pass::Stone, band, power * far);
                return;
            }
            Intersection::Light(i, colour) => {
                sight.add(Pass::Stone, band, power * scene.lights[i].radiance_at(colour, nm));
                return;
            }
            Intersection::Surface(at) => {
                let finish = &scene.surfaces[at.surface].finish;
                if !finish.is_delta() {
                    if drawn {
                        let reflected = power / probability * finish.reflectance(nm) / std::f32::consts::PI;
                        radiance_from_afar(view, &at, direction, band, reflected, sight, chance.jitter);
                    }
                    return;
                }
                power *= finish.reflectance(nm);
                (origin, direction) = (scene.start(&at), finish.sample(at.normal, direction, MIDDLE));
                past = Past::Surface(at.surface);
            }
            Intersection::Stone(stone, arrival) => {
                if drawn {
                    let power = power / probability;
                    onward.push(OnwardRay { stone, arrival, sight: way.sight, band, power });
                }
                return;
            }
        }
    }
}

/// A surface seen through a stone or mirrored in it, at one wavelength: one shadow ray a light, irradiance
/// from the nearest cell of the maps.
///
/// - `direction`: of the ray that meets it
fn radiance_from_afar(
    view: &CameraIntegrator,
    at: &SurfacePoint,
    direction: Vec3,
    band: usize,
    reflected: f32,
    sight: &mut CameraSample,
    jitter: [f32; 2],
) {
    let nm = sight.nm[band];
    let finish = &view.scene.surfaces[at.surface].finish;
    let scattered = |incoming: Vec3| finish.eval(at.normal, incoming, -direction);
    let lights = view.scene.lights.iter().enumerate();
    let direct: f32 = lights
        .map(|(i, light)| light.radiance_at(view.scene.direct_light(i, at, [jitter], scattered), nm))
        .sum();
    let caustic = view.maps.caustic.irradiance_nearby(at)[band];
    let indirect = view.maps.indirect.irradiance_nearby(at)[band];
    sight.add(Pass::Stone, band, reflected * (direct + caustic + indirect));
}

/// Contents of a lane: a camera ray's number, and the share that mirrors before the stone left.
#[derive(Clone, Copy, Default)]
struct CarriedSample {
    sight: usize,
    share: f32,
}

/// The camera rays of a pixel inside one stone, eight lanes each.
struct StoneClient<'a, 'v, I> {
    view: &'a CameraIntegrator<'v>,
    number: usize,
    entering: I,
    sights: &'a mut [CameraSample],
    stream: &'a mut Stream,
    onward: &'a mut Vec<OnwardRay>,
    carried: [CarriedSample; LANES],
}

impl<'a, I: Iterator<Item = &'a StoneArrival>> RayClient for StoneClient<'a, '_, I> {
    const WIDTH: usize = BANDS;

    fn polarised(&self) -> bool {
        self.view.scene.stones[self.number].polarised
    }

    fn absorbing(&self) -> bool {
        !self.view.scene.stones[self.number].material.is_clear()
    }

    fn max_bounces(&self) -> u32 {
        self.view.scene.max_bounces(OUTSIDE)
    }

    /// Refracts a camera ray into the stone; what the facet mirrors is evaluated at once.
    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(e) = self.entering.next() else { return false };
        let placed = &self.view.scene.stones[self.number];
        let sight = &mut self.sights[e.sight];
        let StoneHit { facet, point, direction } = e.hit;
        let mirrored = placed.stone.reflect(facet, direction);
        let chance = RandomNumbers::draw(self.stream);
        for band in 0..BANDS {
            let nm = sight.nm[band];
            let index = placed.index(nm);
            let entry = placed.stone.refract_into(facet, direction, index);
            packet.load_refracted(lane + band, point, &entry, index);
            packet.absorption[lane + band] = placed.absorption(nm);
            self.carried[lane + band] = CarriedSample { sight: e.sight, share: e.share[band] };
            let way = ExitRay {
                stone: self.number,
                point,
                direction: mirrored,
                sight: e.sight,
                band,
                power: e.share[band] * entry.reflectance,
            };
            radiance_outside(self.view, way, sight, chance, self.onward);
        }
        true
    }

    fn interact(&mut self, interaction: &Interaction, packet: &Packet) {
        let chances: [RandomNumbers; LANES / BANDS] =
            std::array::from_fn(|_| RandomNumbers::draw(self.stream));
        for lane in 0..LANES {
            let Some(exit) = interaction.exit(packet, lane) else { continue };
            let CarriedSample { sight, share } = self.carried[lane];
            let way = ExitRay {
                stone: self.number,
                point: exit.point,
                direction: exit.direction,
                sight,
                band: lane % BANDS,
                power: share * exit.power,
            };
            radiance_outside(self.view, way, &mut self.sights[sight], chances[lane / BANDS], self.onward);
        }
    }
}
