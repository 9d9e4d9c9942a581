//! Camera rays inside stones, and what they see on their ways out.

use super::film::Pass;
use super::tracer::{Entering, MIRRORS, Sight, View};
use crate::math::random::Stream;
use crate::optics::colour::BANDS;
use crate::scene::Finish;
use crate::transport::crossing::{self, Entering as Single};
use crate::transport::{Arrival, Event, Past, SurfacePoint};
use crate::walk::feed::{self, Rays};
use crate::walk::{LANES, Meeting, Packet};
use glam::Vec3;

/// A camera ray inside a stone is followed until this share of its power is left.
const STOP_SHARE: f32 = 2e-3;

/// Ways out of a stone that carry less than this share are looked along by lot, with a probability
/// in proportion; lights at their end are always seen.
const LOT_SHARE: f32 = 0.08;

/// Segments of a path that are not inside the stone: from the eye, and to the light.
const OUTSIDE: u32 = 2;

/// Follows the camera rays of a pixel through the stones. A way out of the first stone that leads
/// into another goes on by one exit at each, chosen by power.
pub(super) fn look_into_stones(
    view: &View,
    entering: &[Entering],
    sights: &mut [Sight],
    stream: &mut Stream,
) {
    let mut onward = Vec::new();
    for (number, placed) in view.scene.stones.iter().enumerate() {
        let mut its = entering.iter().filter(|e| e.stone == number).peekable();
        if its.peek().is_none() {
            continue;
        }
        let mut inside = Inside {
            view,
            number,
            entering: its,
            sights: &mut *sights,
            stream: &mut *stream,
            onward: &mut onward,
            carried: [Carried::default(); LANES],
        };
        feed::walk_all(&placed.stone, STOP_SHARE, &mut inside);
    }
    while !onward.is_empty() {
        let now = std::mem::take(&mut onward);
        for (number, placed) in view.scene.stones.iter().enumerate() {
            let its: Vec<&Onward> = now.iter().filter(|o| o.stone == number).collect();
            let singles: Vec<Single> = its
                .iter()
                .map(|o| Single {
                    arrival: o.arrival,
                    nm: sights[o.sight].nm[o.band],
                    choice: stream.unit64(),
                })
                .collect();
            let departures = crossing::cross(placed, view.scene.most_meetings(OUTSIDE), &singles);
            for (o, departure) in its.iter().zip(departures) {
                let way = WayOut {
                    stone: number,
                    point: departure.point,
                    direction: departure.direction,
                    sight: o.sight,
                    band: o.band,
                    power: o.power * departure.share,
                };
                let chance = Chance::draw(stream);
                look_out(view, way, &mut sights[o.sight], chance, &mut onward);
            }
        }
    }
}

/// A ray of one wavelength that leaves a stone, in its walking frame.
struct WayOut {
    stone: usize,
    point: Vec3,
    direction: Vec3,
    sight: usize,
    band: usize,
    power: f32,
}

/// A ray of one wavelength on its way into another stone.
struct Onward {
    stone: usize,
    arrival: Arrival,
    sight: usize,
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

/// What one wavelength sees along a way out of a stone: a light always; a surface or another stone
/// by lot if the power is small, and then it counts for more.
fn look_out(view: &View, way: WayOut, sight: &mut Sight, chance: Chance, onward: &mut Vec<Onward>) {
    let scene = view.scene;
    let placed = &scene.stones[way.stone];
    let mut origin = placed.point_to_world(way.point);
    let mut direction = placed.direction_to_world(way.direction);
    let (mut power, mut past) = (way.power, Past::Stone(way.stone));
    let (nm, band) = (sight.nm[way.band], way.band);
    for _ in 0..MIRRORS {
        let probability = (power / LOT_SHARE).min(1.0);
        let drawn = chance.lot < probability;
        match scene.first(origin, direction, past) {
            Event::Nothing => {
                let far: f32 = scene.from_afar(direction).map(|(light, colour)| light.at(colour, nm)).sum();
                sight.add(Pass::Stone, band, power * far);
                return;
            }
            Event::Light(i, colour) => {
                sight.add(Pass::Stone, band, power * scene.lights[i].at(colour, nm));
                return;
            }
            Event::Surface(at) => match &scene.surfaces[at.surface].finish {
                Finish::Mirror(reflectance) => {
                    power *= reflectance.at(nm);
                    (origin, direction) = (scene.start(&at), direction.reflect(at.normal));
                    past = Past::Surface(at.surface);
                }
                Finish::Diffuse(reflectance) => {
                    if drawn {
                        let reflected = power / probability * reflectance.at(nm) / std::f32::consts::PI;
                        see_afar(view, &at, band, reflected, sight, chance.jitter);
                    }
                    return;
                }
            },
            Event::Stone(stone, arrival) => {
                if drawn {
                    let power = power / probability;
                    onward.push(Onward { stone, arrival, sight: way.sight, band, power });
                }
                return;
            }
        }
    }
}

/// A surface seen through a stone or mirrored in it, at one wavelength: one shadow ray a light,
/// photons from the nearest known place.
fn see_afar(
    view: &View,
    at: &SurfacePoint,
    band: usize,
    reflected: f32,
    sight: &mut Sight,
    jitter: [f32; 2],
) {
    let nm = sight.nm[band];
    let lights = view.scene.lights.iter().enumerate();
    let direct: f32 =
        lights.map(|(i, light)| light.at(view.scene.direct_irradiance(i, at, [jitter]), nm)).sum();
    let caustic = view.maps.caustic.irradiance_nearby(at)[band];
    let indirect = view.maps.indirect.irradiance_nearby(at)[band];
    sight.add(Pass::Stone, band, reflected * (direct + caustic + indirect));
}

/// What a lane carries: a camera ray's number, and the share that mirrors before the stone left.
#[derive(Clone, Copy, Default)]
struct Carried {
    sight: usize,
    share: f32,
}

/// The camera rays of a pixel inside one stone, eight lanes each.
struct Inside<'a, 'v, I> {
    view: &'a View<'v>,
    number: usize,
    entering: I,
    sights: &'a mut [Sight],
    stream: &'a mut Stream,
    onward: &'a mut Vec<Onward>,
    carried: [Carried; LANES],
}

impl<'a, I: Iterator<Item = &'a Entering>> Rays for Inside<'a, '_, I> {
    const WIDTH: usize = BANDS;

    fn polarised(&self) -> bool {
        self.view.scene.stones[self.number].polarised
    }

    fn absorbing(&self) -> bool {
        !self.view.scene.stones[self.number].material.is_clear()
    }

    fn most_meetings(&self) -> u32 {
        self.view.scene.most_meetings(OUTSIDE)
    }

    /// Lets a camera ray in; what the facet mirrors is seen at once.
    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(e) = self.entering.next() else { return false };
        let placed = &self.view.scene.stones[self.number];
        let sight = &mut self.sights[e.sight];
        let Arrival { facet, point, direction } = e.arrival;
        let mirrored = placed.stone.reflect(facet, direction);
        let chance = Chance::draw(self.stream);
        for band in 0..BANDS {
            let nm = sight.nm[band];
            let index = placed.index(nm);
            let entry = placed.stone.enter(facet, direction, index);
            packet.enter(lane + band, point, &entry, index);
            packet.absorption[lane + band] = placed.absorption(nm);
            self.carried[lane + band] = Carried { sight: e.sight, share: e.share[band] };
            let way = WayOut {
                stone: self.number,
                point,
                direction: mirrored,
                sight: e.sight,
                band,
                power: e.share[band] * entry.reflectance,
            };
            look_out(self.view, way, sight, chance, self.onward);
        }
        true
    }

    fn meet(&mut self, meeting: &Meeting, packet: &Packet) {
        let chances: [Chance; LANES / BANDS] = std::array::from_fn(|_| Chance::draw(self.stream));
        for lane in 0..LANES {
            let Some(exit) = meeting.exit(packet, lane) else { continue };
            let Carried { sight, share } = self.carried[lane];
            let way = WayOut {
                stone: self.number,
                point: exit.point,
                direction: exit.direction,
                sight,
                band: lane % BANDS,
                power: share * exit.power,
            };
            look_out(self.view, way, &mut self.sights[sight], chances[lane / BANDS], self.onward);
        }
    }
}
