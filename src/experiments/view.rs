//! View: a parallel eye straight above the stone, traced backward to where the light comes from.

use super::batches::Experiment;
use super::entrance::Outline;
use super::{ExperimentError, Medium, Optics};
use crate::math::points::Points;
use crate::math::random::Purpose;
use crate::optics::dispersion::lines;
use crate::walk::feed::{self, Rays};
use crate::walk::{LANES, Lanes, Meeting, Packet, Stone};
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
/// faces up. D line, unpolarised outside, no observer's head.
#[derive(Debug, Clone)]
pub struct View<'a> {
    stone: &'a Stone,
    polarised: bool,
    absorbing: bool,
    optics: Optics,
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
    /// Taken by the stone.
    pub absorbed: f64,
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
    pub fn new(stone: &'a Stone, medium: &Medium) -> Result<Self, ExperimentError> {
        Ok(Self {
            stone,
            polarised: medium.polarised,
            absorbing: !medium.material.is_clear(),
            optics: medium.optics(stone, lines::D)?,
            outline: Outline::new(stone)?,
        })
    }
}

/// The band of a direction whose z is `z`.
pub fn band(z: f32) -> Band {
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

/// The rays of a run of points.
struct Gaze<'a> {
    experiment: &'a View<'a>,
    points: Points<2>,
    tally: &'a mut Tally,
    bands: [Lanes; 4],
    up_cos2: Lanes,
    absorbed: Lanes,
    strongest: Lanes,
    strongest_z: Lanes,
}

impl Rays for Gaze<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.experiment.polarised
    }

    fn absorbing(&self) -> bool {
        self.experiment.absorbing
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(u) = self.points.next() else { return false };
        let View { stone, optics, outline, .. } = self.experiment;
        let (facet, point) = outline.sample(u);
        let entry = stone.enter(facet, -Vec3::Z, optics.index);
        self.tally.rays += 1.0;
        self.tally.reflected += f64::from(entry.reflectance);
        packet.enter(lane, point, &entry, optics.index);
        packet.absorption[lane] = optics.absorption;
        true
    }

    fn meet(&mut self, m: &Meeting, _: &Packet) {
        for l in 0..LANES {
            let (z, power) = (m.dz[l], m.power[l]);
            let up = z.max(0.0);
            self.up_cos2[l] += power * up * up;
            self.absorbed[l] += m.absorbed[l];
            let above = |floor: bool| if floor { power } else { 0.0 };
            let (sky, high, zenith) = (above(z > 0.0), above(z >= BAND_ENDS[0]), above(z >= BAND_ENDS[1]));
            self.bands[Band::Green as usize][l] += sky - high;
            self.bands[Band::Red as usize][l] += high - zenith;
            self.bands[Band::Blue as usize][l] += zenith;
            self.bands[Band::Below as usize][l] += power - sky;
            let stronger = power > self.strongest[l];
            self.strongest[l] = if stronger { power } else { self.strongest[l] };
            self.strongest_z[l] = if stronger { z } else { self.strongest_z[l] };
        }
    }

    fn ended(&mut self, lane: usize) {
        let take = |sum: &mut Lanes| f64::from(std::mem::take(&mut sum[lane]));
        for (sum, lanes) in self.tally.bands.iter_mut().zip(&mut self.bands) {
            *sum += take(lanes);
        }
        self.tally.up_cos2 += take(&mut self.up_cos2);
        self.tally.absorbed += take(&mut self.absorbed);
        if take(&mut self.strongest) > 0.0 {
            self.tally.strongest[band(self.strongest_z[lane]) as usize] += 1.0;
        }
    }
}

impl Experiment for View<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let zero = [0.0; LANES];
        let mut gaze = Gaze {
            experiment: self,
            points: Points::new(seed, Purpose::View, batch, points),
            tally,
            bands: [zero; 4],
            up_cos2: zero,
            absorbed: zero,
            strongest: zero,
            strongest_z: zero,
        };
        let lost = feed::walk_all(self.stone, STOP_POWER, &mut gaze);
        tally.lost += lost;
    }
}
