//! Beam: light from a point at infinity above the stone, in the six lines B C D e F G.

use super::batches::Experiment;
use super::entrance::{self, Outline};
use super::points::Points;
use super::{ExperimentError, check_index};
use crate::math::random::Purpose;
use crate::optics::{Material, dispersion::lines};
use crate::walk::{LANES, Meeting, Packet, Stone};
use glam::{DVec3, Vec3};
use std::ops::Range;

/// A path is followed while it holds this share of the light that fell on its point.
const STOP_POWER: f32 = 1e-6;

/// Threshold of visibility: exiting irradiance as a share of the beam's (GIA 2001: 10⁻³).
pub const THRESHOLD: f32 = 1e-3;

/// Lines of a packet: a sample takes three lanes.
const LINES: usize = 3;

/// Samples of a packet; the lanes left over rest.
const SAMPLES: usize = LANES / LINES;

/// Lines that are paired on one path, D first.
const PAIRED: [f64; LINES] = [lines::D, lines::B, lines::G];

/// The other three of the six.
const UNPAIRED: [f64; LINES] = [lines::C, lines::E, lines::F];

/// A vertical beam on one stone: points uniform over the outline, unpolarised, scalar Fresnel.
///
/// The exiting beam is m = (cos t / cos i) at entry × (cos out / cos in) at exit times as wide as
/// the entering one; its irradiance is power / m. Crown exits above the horizon count.
#[derive(Debug, Clone)]
pub struct Beam<'a> {
    stone: &'a Stone,
    indices: [[f32; LINES]; 2],
    outline: Outline,
    crown: Vec<f32>,
}

/// Sums of a batch; every ray has power 1 in every line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    /// Points of the outline.
    pub points: f64,
    /// Σ m cos² over visible exits, mean over the six lines.
    pub lit: f64,
    /// Σ m cos² × angle between B and G in degrees, over visible exits at D whose B and G have
    /// come the same way and leave too.
    pub streak_deg: f64,
    /// Σ power × angle between B and G in degrees, over crown exits at D whose B and G have come
    /// the same way and leave too.
    pub power_angle_deg: f64,
    /// Σ power over the same exits.
    pub paired_power: f64,
}

/// One packet: `SAMPLES` points in three lines each.
struct Rays {
    packet: Packet,
    /// cos t / cos i at entry.
    widening: [f32; LANES],
}

impl Rays {
    fn new() -> Self {
        Self { packet: Packet::default(), widening: [0.0; LANES] }
    }

    fn set(&mut self, sample: usize, stone: &Stone, facet: usize, point: Vec3, indices: [f32; LINES]) {
        for (line, index) in indices.into_iter().enumerate() {
            let lane = sample * LINES + line;
            let entry = stone.enter(facet, -Vec3::Z, index);
            self.packet.set(lane, point, entry.direction, 1.0 - entry.reflectance, index);
            self.widening[lane] = entry.cos_inside / entry.cos_outside;
        }
    }
}

impl<'a> Beam<'a> {
    /// Lights a stone; a material without dispersion gives no angles.
    pub fn new(stone: &'a Stone, material: &Material) -> Result<Self, ExperimentError> {
        let mut indices = [[0.0; LINES]; 2];
        for (into, lines) in indices.iter_mut().zip([PAIRED, UNPAIRED]) {
            for (n, um) in into.iter_mut().zip(lines) {
                *n = check_index(material.index(um))?;
            }
        }
        let (outline, crown) = (Outline::new(stone)?, entrance::crown_flags(stone));
        Ok(Self { stone, indices, outline, crown })
    }

    /// m cos² of what a lane leaves, if it goes up through the crown and is bright enough; else 0.
    fn visible(&self, m: &Meeting, lane: usize, widening: f32) -> f32 {
        let z = m.dz[lane];
        let width = widening * m.cos_outside[lane] / m.cos_inside[lane].max(f32::MIN_POSITIVE);
        let seen = m.power[lane] > THRESHOLD * width && z > 0.0;
        if seen { width * z * z * self.crown[m.facet[lane] as usize] } else { 0.0 }
    }

    fn walk(&self, rays: &mut Rays, paired: bool, tally: &mut Tally) {
        let mut together = [paired; SAMPLES];
        let widening = rays.widening;
        let (mut lit, mut streak, mut power_angle, mut power) = (0.0, 0.0, 0.0, 0.0);
        self.stone.walk(&mut rays.packet, STOP_POWER, |m, _| {
            for (sample, together) in together.iter_mut().enumerate() {
                let d = sample * LINES;
                let mut seen = [0.0; LINES];
                for (line, seen) in seen.iter_mut().enumerate() {
                    *seen = self.visible(m, d + line, widening[d + line]);
                    lit += f64::from(*seen);
                }
                *together &= m.facet[d] == m.facet[d + 1] && m.facet[d] == m.facet[d + 2];
                let leaves = m.power[d] > 0.0 && m.power[d + 1] > 0.0 && m.power[d + 2] > 0.0;
                if *together && leaves && m.dz[d] > 0.0 && self.crown[m.facet[d] as usize] > 0.0 {
                    let angle = angle_deg(m, d + 1, d + 2);
                    streak += f64::from(seen[0]) * angle;
                    power_angle += f64::from(m.power[d]) * angle;
                    power += f64::from(m.power[d]);
                }
            }
        });
        tally.lit += lit / lines::SIX.len() as f64;
        tally.streak_deg += streak;
        tally.power_angle_deg += power_angle;
        tally.paired_power += power;
    }
}

/// Angle between what two lanes leave, in degrees.
fn angle_deg(m: &Meeting, a: usize, b: usize) -> f64 {
    let out = |l: usize| Vec3::new(m.dx[l], m.dy[l], m.dz[l]).as_dvec3();
    let (a, b): (DVec3, DVec3) = (out(a), out(b));
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

impl Experiment for Beam<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let mut rays = [Rays::new(), Rays::new()];
        let mut filled = 0;
        let mut points = Points::new(seed, Purpose::Beam, batch, points);
        loop {
            let point = points.next();
            if let Some(u) = point {
                let (facet, at) = self.outline.sample(u);
                tally.points += 1.0;
                for (rays, indices) in rays.iter_mut().zip(self.indices) {
                    rays.set(filled, self.stone, facet, at, indices);
                }
                filled += 1;
            }
            if filled == SAMPLES || point.is_none() {
                // samples not set again are at rest since the last walk
                let [first, second] = &mut rays;
                self.walk(first, true, tally);
                self.walk(second, false, tally);
                filled = 0;
            }
            if point.is_none() {
                return;
            }
        }
    }
}
