//! Residual light: beams that are not traced further, sampled as photons.
//!
//! Each batch samples systematically, independently of the others: marks at equal steps of power, from a
//! random first one, over the beams in the order in which they are left over; a photon into the beam of
//! each mark, at a random point of its footprint. A batch's photons thus stand for the whole residual
//! without bias, and the spread of the batches is the error.

use super::{BeamExit, BeamLight, BeamVisitor, ResidualBeam};
use crate::geometry::Plane;
use crate::optics::stokes::Stokes;
use crate::sampling::random::{Purpose, Stream};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, Packet};
use glam::{DVec2, Vec3};

/// Photons that finish what beams leave over, one stream a batch.
const STREAM: Purpose = Purpose::named("beam residual");

/// A photon with less than this share of its power is given up: of a residual of 2.5 %, 2.5e-7.
const STOP_POWER: f32 = 1e-5;

/// Power between the first marks, as a share of all light: doubled as often as photons become too
/// many, so its value matters for speed alone.
const FIRST_STEP: f64 = 1e-5;

/// A ray that enters at one point in `K` lines.
#[derive(Debug, Clone, Copy)]
struct ResidualPhoton<const K: usize> {
    power: f32,
    /// Plane of the facet that it entered through.
    entrance: Plane,
    points: [Vec3; K],
    directions: [Vec3; K],
    /// Polarisation of the leading line, if it is followed; the other lines have directions alone.
    stokes: Option<Stokes>,
}

/// The photons of one batch.
#[derive(Debug, Clone)]
struct PhotonBatch<const K: usize> {
    stream: Stream,
    /// Power that one photon stands for.
    step: f64,
    /// Power left over up to the next photon.
    next: f64,
    photons: Vec<ResidualPhoton<K>>,
}

/// Photons of what is left over, in independent batches.
#[derive(Debug, Clone)]
pub struct ResidualPhotons<const K: usize> {
    batches: Vec<PhotonBatch<K>>,
    most: usize,
    /// Power below which photons are given up.
    stop_power: f32,
    /// Power left over so far, and at the nearest mark of any batch.
    power: f64,
    mark: f64,
}

impl<const K: usize> ResidualPhotons<K> {
    /// An empty residual.
    ///
    /// - `batches`: independent ones; `photons`: each batch draws half to all of this number (at
    ///   least 2)
    pub fn new(seed: u64, batches: usize, photons: usize) -> Self {
        let most = photons.max(2);
        let batches = (0..batches as u64).map(|b| {
            let mut stream = Stream::new(seed, STREAM, b);
            let step = FIRST_STEP;
            PhotonBatch { next: step * stream.unit64(), stream, step, photons: Vec::with_capacity(most) }
        });
        ResidualPhotons { batches: batches.collect(), most, stop_power: STOP_POWER, power: 0.0, mark: 0.0 }
    }

    /// Gives photons up below a power.
    pub fn stopping_at(self, power: f32) -> Self {
        ResidualPhotons { stop_power: power, ..self }
    }

    /// Number of batches.
    pub fn batches(&self) -> usize {
        self.batches.len()
    }

    /// Takes a beam that is not followed.
    pub fn add<L: BeamLight>(&mut self, rest: &ResidualBeam<L, K>) {
        self.power += rest.power;
        if self.power <= self.mark {
            return;
        }
        self.mark = f64::INFINITY;
        for batch in &mut self.batches {
            while batch.next < self.power {
                batch.draw(rest);
                if batch.photons.len() >= self.most {
                    batch.subsample();
                }
            }
            self.mark = self.mark.min(batch.next);
        }
    }

    /// Traces the photons of a batch to their end.
    ///
    /// - `indices`: of the stone for each line
    /// - `watch`: sees every interaction; a photon has power 1 in every line, or what its light says
    ///   ([`BeamLight::photon_share`])
    ///
    /// Returns the power that one photon stands for, and the power given up over all lines, in
    /// photons.
    pub fn trace(
        &self,
        batch: usize,
        stone: &ConvexStone,
        indices: [f64; K],
        watch: &mut impl ResidualClient,
    ) -> (f64, f64) {
        let Some(batch) = self.batches.get(batch) else { return (0.0, 0.0) };
        let indices = indices.map(|n| n as f32);
        let polarised = batch.photons.first().is_some_and(|photon| photon.stokes.is_some());
        let mut shower = ResidualRays { photons: batch.photons.iter(), polarised, indices, watch };
        (batch.step, lane_scheduler::trace_all(stone, self.stop_power, &mut shower))
    }
}

impl<const K: usize> PhotonBatch<K> {
    fn draw<L: BeamLight>(&mut self, rest: &ResidualBeam<L, K>) {
        let uv = point_in(rest.footprint, &mut self.stream);
        self.photons.push(ResidualPhoton {
            power: rest.light.photon_share() as f32,
            entrance: rest.entry.plane,
            points: std::array::from_fn(|k| rest.coords[k].point_on(uv, &rest.plane).as_vec3()),
            directions: std::array::from_fn(|k| rest.coords[k].direction.as_vec3().normalize()),
            stokes: rest.light.stokes(),
        });
        self.next += self.step;
    }

    /// Keeps every other photon, from the first or the second at random: the sample that a step of twice
    /// the width would have drawn.
    fn subsample(&mut self) {
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

/// A client that sees what residual photons leave.
pub trait ResidualClient {
    /// A new photon is in the lanes from `lane` on; it entered the stone through a facet in the plane
    /// `entrance`.
    fn begin(&mut self, _lane: usize, _entrance: &Plane) {}

    /// Whether the photon in the lanes from `lane` on need not be followed further.
    fn is_done(&self, _lane: usize) -> bool {
        false
    }

    /// What all lanes leave at an interaction.
    fn interact(&mut self, interaction: &Interaction);
}

struct ResidualRays<'a, W, const K: usize> {
    photons: std::slice::Iter<'a, ResidualPhoton<K>>,
    polarised: bool,
    indices: [f32; K],
    watch: &'a mut W,
}

impl<W: ResidualClient, const K: usize> RayClient for ResidualRays<'_, W, K> {
    const WIDTH: usize = K;

    fn polarised(&self) -> bool {
        self.polarised
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(photon) = self.photons.next() else { return false };
        for k in 0..K {
            packet.load(lane + k, photon.points[k], photon.directions[k], photon.power, self.indices[k]);
        }
        if let Some(Stokes { i, q, u, v, axis }) = photon.stokes {
            let part = |x: f64| photon.power * (x / i) as f32;
            (packet.q[lane], packet.u[lane], packet.v[lane]) = (part(q), part(u), part(v));
            (packet.ax[lane], packet.ay[lane], packet.az[lane]) = axis.as_vec3().into();
        }
        self.watch.begin(lane, &photon.entrance);
        true
    }

    fn is_done(&self, lane: usize) -> bool {
        self.watch.is_done(lane)
    }

    fn interact(&mut self, interaction: &Interaction, _: &Packet) {
        self.watch.interact(interaction);
    }
}

/// Collects residual beams; exits do not count.
impl<L: BeamLight, const K: usize> BeamVisitor<L, K> for ResidualPhotons<K> {
    fn exit(&mut self, _: &BeamExit<L, K>) {}

    fn residual(&mut self, rest: &ResidualBeam<L, K>) {
        self.add(rest);
    }
}
