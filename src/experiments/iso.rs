//! Iso: the face-up view by the rules that faceters compare designs with (GemRay's).

use super::batches::Experiment;
use super::entrance::{self, Outline};
use super::view::Sky;
use super::wavelengths::Wavelengths;
use super::{Aspect, ExperimentError, Medium};
use crate::math::points::Points;
use crate::math::random::Purpose;
use crate::math::stats::Sum;
use crate::walk::feed::{self, Rays};
use crate::walk::{LANES, Lanes, Meeting, Packet, Stone};
use std::ops::Range;

/// Meetings inside that a ray is followed for: ten segments, the incoming one and nine inside.
pub const MEETINGS: u32 = 9;

/// Half-angle of the shadow of the viewer's head, degrees.
pub const OBSERVER_DEG: f64 = 10.0;

/// A facet faces the viewer if the cosine between its normal and his direction is above this.
const FACING: f64 = 1e-4;

/// A lane with less than this share of its light is given up: nothing of what counts.
const STOP_POWER: f32 = 1e-7;

/// The parallel view of one stone, D line or daylight for a stone that absorbs, unpolarised at every facet; what counts leaves through
/// facets that face the viewer, into the sky outside his head's shadow.
#[derive(Debug, Clone)]
pub struct Iso<'a> {
    stone: &'a Stone,
    light: Wavelengths,
    sky: Sky,
    aspect: Aspect,
    outline: Outline,
    facing: Vec<f32>,
    table: Vec<f32>,
}

/// For each facet 1 if it faces the viewer, else 0.
pub(super) fn facing_flags(stone: &Stone, aspect: Aspect) -> Vec<f32> {
    entrance::flags(stone, |n| n.dot(aspect.axis) > FACING)
}

/// The three weights of light from height h (sine of its elevation): 1, h, 2h√(1 − h²).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum Weight {
    /// 1.
    Iso = 0,
    /// h.
    Cos = 1,
    /// 2h√(1 − h²).
    Sc2 = 2,
}

/// Sums of a batch.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    /// Rays.
    pub rays: f64,
    /// Σ power by [`Weight`].
    pub all: [f64; 3],
    /// Rays that meet the table.
    pub table_rays: f64,
    /// Σ power of these by [`Weight`].
    pub table: [f64; 3],
}

impl Tally {
    /// Percent of the light over the whole outline.
    pub fn percent(&self, weight: Weight) -> f64 {
        100.0 * self.all[weight as usize] / self.rays
    }

    /// Percent of the light over the table alone.
    pub fn table_percent(&self, weight: Weight) -> f64 {
        100.0 * self.table[weight as usize] / self.table_rays
    }
}

impl Sum for Tally {
    fn add(&mut self, other: &Tally) {
        self.rays += other.rays;
        self.all.add(&other.all);
        self.table_rays += other.table_rays;
        self.table.add(&other.table);
    }
}

/// The weights of light from a height.
pub(super) fn weights(h: f32) -> [f32; 3] {
    [1.0, h, 2.0 * h * (1.0 - h * h).max(0.0).sqrt()]
}

impl<'a> Iso<'a> {
    /// Looks at a stone, without polarisation.
    pub fn seen_from(
        stone: &'a Stone,
        medium: &Medium,
        aspect: Aspect,
        sky: Sky,
    ) -> Result<Self, ExperimentError> {
        Ok(Self {
            stone,
            light: Wavelengths::new(medium, stone.unit)?,
            sky,
            aspect,
            outline: Outline::new(stone, aspect)?,
            facing: facing_flags(stone, aspect),
            table: entrance::table_flags(stone),
        })
    }
}

/// The rays of a run of points.
struct Gaze<'a> {
    experiment: &'a Iso<'a>,
    points: Points<2>,
    hues: Points<1>,
    tally: &'a mut Tally,
    power: [Lanes; 3],
    table: Lanes,
    meetings: [u32; LANES],
}

impl Rays for Gaze<'_> {
    const WIDTH: usize = 1;

    fn absorbing(&self) -> bool {
        self.experiment.light.absorb()
    }

    fn ends_by_what_came_out(&self) -> bool {
        self.absorbing()
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let (Some(u), Some([hue])) = (self.points.next(), self.hues.next()) else { return false };
        let Iso { stone, light, sky, aspect, outline, facing, table } = self.experiment;
        let (facet, point) = outline.sample(u);
        let optics = light.at(hue);
        let entry = stone.enter(facet, -aspect.axis.as_vec3(), optics.index);
        packet.enter(lane, point, &entry, optics.index);
        packet.absorption[lane] = optics.absorption;
        let mirrored = sky.mirrored(&entry) * facing[facet];
        let height = Sky::mirror_height(&entry);
        for (power, weight) in self.power.iter_mut().zip(weights(height)) {
            power[lane] = mirrored * weight;
        }
        self.table[lane] = table[facet];
        self.meetings[lane] = 0;
        true
    }

    fn meet(&mut self, m: &Meeting, _: &Packet) {
        let axis = self.experiment.aspect.axis.as_vec3();
        for l in 0..LANES {
            let height = m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z;
            let counts = self.experiment.sky.is_bright(height);
            let power = if counts { m.power[l] * self.experiment.facing[m.facet[l] as usize] } else { 0.0 };
            let [_, cos, sc2] = weights(height);
            self.power[0][l] += power;
            self.power[1][l] += power * cos;
            self.power[2][l] += power * sc2;
            self.meetings[l] += 1;
        }
    }

    fn is_done(&self, lane: usize) -> bool {
        self.meetings[lane] >= MEETINGS
    }

    fn ended(&mut self, lane: usize) {
        let table = f64::from(self.table[lane]);
        self.tally.rays += 1.0;
        self.tally.table_rays += table;
        for (i, power) in self.power.iter_mut().enumerate() {
            let power = f64::from(std::mem::take(&mut power[lane]));
            self.tally.all[i] += power;
            self.tally.table[i] += table * power;
        }
    }
}

impl Experiment for Iso<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let mut gaze = Gaze {
            experiment: self,
            hues: Points::new(seed, Purpose::ScoreHue, batch, points.clone()),
            points: Points::new(seed, Purpose::Iso, batch, points),
            tally,
            power: [[0.0; LANES]; 3],
            table: [0.0; LANES],
            meetings: [0; LANES],
        };
        feed::walk_all(self.stone, STOP_POWER, &mut gaze);
    }
}
