//! View: a parallel eye straight above the stone, traced backward to where the light comes from.

use super::batches::Experiment;
use super::entrance::Outline;
use super::points::Points;
use super::{ExperimentError, check_index};
use crate::math::random::Purpose;
use crate::optics::Material;
use crate::walk::{LANES, Packet, Stone};
use glam::Vec3;
use std::ops::Range;

/// A lane with less than this share of its light is given up; see the hemisphere's.
const STOP_POWER: f32 = 1e-4;

/// sin 45° and sin 75°: where the bands of the ASET end.
const BAND_ENDS: [f32; 2] = [std::f32::consts::FRAC_1_SQRT_2, 0.965_925_8];

/// Where light comes from, by elevation above the girdle plane. Numbers index the arrays of
/// [`Tally`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum Band {
    /// 0–45°.
    Green = 0,
    /// 45–75°.
    Red = 1,
    /// 75–90°.
    Blue = 2,
    /// Below the horizon.
    Below = 3,
}

/// The face-up view of one stone: points uniform over the outline, vertical rays, every facet that
/// faces up. D line, unpolarised, scalar Fresnel, no observer's head.
#[derive(Debug, Clone)]
pub struct View<'a> {
    stone: &'a Stone,
    index: f32,
    outline: Outline,
}

/// Sums of a batch; every ray has power 1.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    /// Rays.
    pub rays: f64,
    /// Reflected at entry.
    pub reflected: f64,
    /// Power by [`Band`], whatever facet it leaves through.
    pub bands: [f64; 4],
    /// Power that leaves upward, weighted by cos² from zenith.
    pub up_cos2: f64,
    /// Given up inside.
    pub lost: f64,
    /// Rays by the [`Band`] of their strongest path (reflection at entry aside).
    pub strongest: [f64; 4],
}

impl Tally {
    /// Power that leaves upward.
    pub fn up(&self) -> f64 {
        self.bands[..3].iter().sum()
    }
}

impl<'a> View<'a> {
    /// Looks at a stone at the material's D line.
    pub fn new(stone: &'a Stone, material: &Material) -> Result<Self, ExperimentError> {
        Ok(Self { stone, index: check_index(material.index_d())?, outline: Outline::new(stone)? })
    }

    fn walk(&self, packet: &mut Packet, tally: &mut Tally) {
        let mut bands = [[0f32; LANES]; 4];
        let mut cos2 = [0f32; LANES];
        let (mut strongest, mut strongest_z) = ([0f32; LANES], [0f32; LANES]);
        let lost = self.stone.walk(packet, STOP_POWER, |m, _| {
            for l in 0..LANES {
                let (z, power) = (m.dz[l], m.power[l]);
                let up = z.max(0.0);
                cos2[l] += power * up * up;
                let within = |from: bool, to: bool| if from && !to { power } else { 0.0 };
                bands[0][l] += within(z > 0.0, z >= BAND_ENDS[0]);
                bands[1][l] += within(z >= BAND_ENDS[0], z >= BAND_ENDS[1]);
                bands[2][l] += within(z >= BAND_ENDS[1], false);
                bands[3][l] += within(true, z > 0.0);
                let stronger = power > strongest[l];
                strongest[l] = if stronger { power } else { strongest[l] };
                strongest_z[l] = if stronger { z } else { strongest_z[l] };
            }
        });
        for (sum, lanes) in tally.bands.iter_mut().zip(&bands) {
            *sum += lanes.iter().map(|x| f64::from(*x)).sum::<f64>();
        }
        for l in 0..LANES {
            tally.up_cos2 += f64::from(cos2[l]);
            if strongest[l] > 0.0 {
                tally.strongest[band(strongest_z[l]) as usize] += 1.0;
            }
        }
        tally.lost += f64::from(lost);
    }
}

/// The band of a direction whose z is `z`.
fn band(z: f32) -> Band {
    if z >= BAND_ENDS[1] {
        Band::Blue
    } else if z >= BAND_ENDS[0] {
        Band::Red
    } else if z > 0.0 {
        Band::Green
    } else {
        Band::Below
    }
}

impl Experiment for View<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let mut packet = Packet::default();
        let mut filled = 0;
        for u in Points::new(seed, Purpose::View, batch, points) {
            let (facet, point) = self.outline.sample(u);
            let entry = self.stone.enter(facet, -Vec3::Z, self.index);
            tally.rays += 1.0;
            tally.reflected += f64::from(entry.reflectance);
            packet.set(filled, point, entry.direction, 1.0 - entry.reflectance, self.index);
            filled += 1;
            if filled == LANES {
                self.walk(&mut packet, tally);
                filled = 0;
            }
        }
        // lanes not set again are at rest since the last walk
        self.walk(&mut packet, tally);
    }
}
