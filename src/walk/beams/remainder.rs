//! The light that beams leave over, drawn as photons and walked to its end.
//!
//! Each batch draws on its own: it lays marks at equal steps of power, from a random first one, over
//! the beams in the order in which they are left over, and puts a photon into the beam of each mark,
//! at a random point of its footprint. A batch's photons thus stand for the whole remainder without
//! bias, and the spread of the batches is the error.

use super::{Light, Rest, Watch};
use crate::math::random::{Purpose, Stream};
use crate::optics::stokes::Stokes;
use crate::solid::Plane;
use crate::walk::feed::{self, Rays};
use crate::walk::{Meeting, Packet, Stone};
use glam::{DVec2, Vec3};

/// A photon with less than this share of its power is given up: of a remainder of 2.5 %, 2.5e-7.
const STOP_POWER: f32 = 1e-5;

/// Power between the first marks, as a share of all light: doubled as often as photons become too
/// many, so its value matters for speed alone.
const FIRST_STEP: f64 = 1e-5;

/// A ray that enters at one point in `K` lines.
#[derive(Debug, Clone, Copy)]
struct Photon<const K: usize> {
    power: f32,
    /// Plane of the facet that it entered through.
    entrance: Plane,
    points: [Vec3; K],
    directions: [Vec3; K],
    /// Polarisation of the leading line, if it is followed; its company is there for its directions.
    stokes: Option<Stokes>,
}

/// The photons of one batch.
#[derive(Debug, Clone)]
struct Batch<const K: usize> {
    stream: Stream,
    /// Power that one photon stands for.
    step: f64,
    /// Power left over up to the next photon.
    next: f64,
    photons: Vec<Photon<K>>,
}

/// Photons of what is left over, in independent batches.
#[derive(Debug, Clone)]
pub struct Remainder<const K: usize> {
    batches: Vec<Batch<K>>,
    most: usize,
    /// Power below which photons are given up.
    stop_power: f32,
    /// Power left over so far, and at the nearest mark of any batch.
    power: f64,
    mark: f64,
}

impl<const K: usize> Remainder<K> {
    /// Nothing left over yet.
    ///
    /// - `batches`: independent ones; `photons`: each batch draws half to all of this number (at
    ///   least 2)
    pub fn new(seed: u64, batches: usize, photons: usize) -> Self {
        let most = photons.max(2);
        let batches = (0..batches as u64).map(|b| {
            let mut stream = Stream::new(seed, Purpose::BeamRemainder, b);
            let step = FIRST_STEP;
            Batch { next: step * stream.unit64(), stream, step, photons: Vec::with_capacity(most) }
        });
        Remainder { batches: batches.collect(), most, stop_power: STOP_POWER, power: 0.0, mark: 0.0 }
    }

    /// Gives photons up below a power.
    pub fn ending_at(self, power: f32) -> Self {
        Remainder { stop_power: power, ..self }
    }

    /// Number of batches.
    pub fn batches(&self) -> usize {
        self.batches.len()
    }

    /// Takes a beam that is not followed.
    pub fn add<L: Light>(&mut self, rest: &Rest<L, K>) {
        self.power += rest.power;
        if self.power <= self.mark {
            return;
        }
        self.mark = f64::INFINITY;
        for batch in &mut self.batches {
            while batch.next < self.power {
                batch.draw(rest);
                if batch.photons.len() >= self.most {
                    batch.thin();
                }
            }
            self.mark = self.mark.min(batch.next);
        }
    }

    /// Walks the photons of a batch to their end.
    ///
    /// - `indices`: of the stone for each line
    /// - `watch`: sees every meeting; a photon has power 1 in every line, or what its light says
    ///   ([`Light::of_photon`])
    ///
    /// Returns the power that one photon stands for, and the power given up over all lines, in
    /// photons.
    pub fn walk(
        &self,
        batch: usize,
        stone: &Stone,
        indices: [f64; K],
        watch: &mut impl Photons,
    ) -> (f64, f64) {
        let Some(batch) = self.batches.get(batch) else { return (0.0, 0.0) };
        let indices = indices.map(|n| n as f32);
        let polarised = batch.photons.first().is_some_and(|photon| photon.stokes.is_some());
        let mut shower = Shower { photons: batch.photons.iter(), polarised, indices, watch };
        (batch.step, feed::walk_all(stone, self.stop_power, &mut shower))
    }
}

impl<const K: usize> Batch<K> {
    fn draw<L: Light>(&mut self, rest: &Rest<L, K>) {
        let uv = point_in(rest.footprint, &mut self.stream);
        self.photons.push(Photon {
            power: rest.light.of_photon() as f32,
            entrance: rest.entrance.plane,
            points: std::array::from_fn(|k| rest.frames[k].point_on(uv, &rest.plane).as_vec3()),
            directions: std::array::from_fn(|k| rest.frames[k].direction.as_vec3().normalize()),
            stokes: rest.light.stokes(),
        });
        self.next += self.step;
    }

    /// Keeps every other photon, from the first or the second at random: what a step of twice the
    /// width would have drawn.
    fn thin(&mut self) {
        let odd = usize::from(self.stream.unit() < 0.5);
        let last = self.photons.len() - 1;
        let mut i = 0;
        self.photons.retain(|_| {
            i += 1;
            (i - 1) % 2 == odd
        });
        if last % 2 == odd {
            self.next += self.step; // the next one would be dropped
        }
        self.step *= 2.0;
    }
}

/// A point of a convex polygon, uniform by area.
fn point_in(corners: &[DVec2], stream: &mut Stream) -> DVec2 {
    let [first, rest @ ..] = corners else { return DVec2::ZERO };
    let twice = |pair: &[DVec2]| (pair[0] - first).perp_dot(pair[1] - first).max(0.0);
    let mut left = stream.unit64() * rest.windows(2).map(twice).sum::<f64>();
    let mut chosen = rest;
    for pair in rest.windows(2) {
        chosen = pair;
        left -= twice(pair);
        if left < 0.0 {
            break;
        }
    }
    let [b, c, ..] = chosen else { return *first };
    let (root, along) = (stream.unit64().sqrt(), stream.unit64());
    *first + (b - first) * (root * (1.0 - along)) + (c - first) * (root * along)
}

/// What photons of the remainder leave.
pub trait Photons {
    /// A new photon is in the lanes from `lane` on; it entered the stone through a facet in the plane
    /// `entrance`.
    fn begins(&mut self, _lane: usize, _entrance: &Plane) {}

    /// Whether the photon in the lanes from `lane` on need not be followed further.
    fn is_done(&self, _lane: usize) -> bool {
        false
    }

    /// What all lanes leave at a meeting.
    fn meet(&mut self, meeting: &Meeting);
}

struct Shower<'a, W, const K: usize> {
    photons: std::slice::Iter<'a, Photon<K>>,
    polarised: bool,
    indices: [f32; K],
    watch: &'a mut W,
}

impl<W: Photons, const K: usize> Rays for Shower<'_, W, K> {
    const WIDTH: usize = K;

    fn polarised(&self) -> bool {
        self.polarised
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(photon) = self.photons.next() else { return false };
        for k in 0..K {
            packet.set(lane + k, photon.points[k], photon.directions[k], photon.power, self.indices[k]);
        }
        if let Some(Stokes { i, q, u, v, axis }) = photon.stokes {
            let part = |x: f64| photon.power * (x / i) as f32;
            (packet.q[lane], packet.u[lane], packet.v[lane]) = (part(q), part(u), part(v));
            (packet.ax[lane], packet.ay[lane], packet.az[lane]) = axis.as_vec3().into();
        }
        self.watch.begins(lane, &photon.entrance);
        true
    }

    fn is_done(&self, lane: usize) -> bool {
        self.watch.is_done(lane)
    }

    fn meet(&mut self, meeting: &Meeting, _: &Packet) {
        self.watch.meet(meeting);
    }
}

/// A remainder takes what is left over and lets exits pass.
impl<L: Light, const K: usize> Watch<L, K> for Remainder<K> {
    fn exit(&mut self, _: &super::Exit<L, K>) {}

    fn rest(&mut self, rest: &Rest<L, K>) {
        self.add(rest);
    }
}
