//! Faceters' view (ISO, COS, SC2): the face-up view by GemRay's rules, by which faceters compare designs.

use super::batches::Estimator;
use super::entry_sampling::{self, Silhouette};
use super::view::ObserverDome;
use super::wavelengths::{HUE_STREAM, Wavelengths};
use super::{EstimatorError, TraceOptics, ViewFrame};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use crate::sampling::stats::Accumulate;
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet};
use std::ops::Range;

/// Points of the outline, one stream a batch.
const STREAM: Purpose = Purpose::named("faceter view");

/// Bounces inside that a ray is followed for: ten segments, the incoming one and nine inside.
pub const MAX_BOUNCES: u32 = 9;

/// Half-angle of the shadow of the viewer's head, degrees.
pub const GEMRAY_OBSERVER_DEG: f64 = 10.0;

/// A facet faces the viewer if the cosine between its normal and his direction is above this.
const MIN_FACING_COS: f64 = 1e-4;

/// A lane with less than this share of its light is given up: negligible.
const STOP_POWER: f32 = 1e-7;

/// The parallel view of one stone, D line or daylight for a stone that absorbs, unpolarised at every facet; what counts leaves through
/// facets that face the viewer, into the sky outside his head's shadow.
#[derive(Debug, Clone)]
pub struct FaceterView<'a> {
    stone: &'a ConvexStone,
    light: Wavelengths,
    sky: ObserverDome,
    view_frame: ViewFrame,
    outline: Silhouette,
    facing: Vec<f32>,
    table: Vec<f32>,
}

/// For each facet 1 if it faces the viewer, else 0.
pub(super) fn facing_flags(stone: &ConvexStone, view_frame: ViewFrame) -> Vec<f32> {
    entry_sampling::flags(stone, |n| n.dot(view_frame.axis) > MIN_FACING_COS)
}

/// The three weights of light from height h (sine of its elevation): 1, h, 2h√(1 − h²).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum FaceterWeight {
    /// 1.
    Iso = 0,
    /// h.
    Cos = 1,
    /// 2h√(1 − h²).
    Sc2 = 2,
}

/// Sums of a batch.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FaceterTally {
    /// Rays.
    pub rays: f64,
    /// Σ power by [`FaceterWeight`].
    pub all: [f64; 3],
    /// Rays that meet the table.
    pub table_rays: f64,
    /// Σ power of these by [`FaceterWeight`].
    pub table: [f64; 3],
}

impl FaceterTally {
    /// Percent of the light over the whole outline.
    pub fn percent(&self, weight: FaceterWeight) -> f64 {
        100.0 * self.all[weight as usize] / self.rays
    }

    /// Percent of the light over the table alone.
    pub fn table_percent(&self, weight: FaceterWeight) -> f64 {
        100.0 * self.table[weight as usize] / self.table_rays
    }
}

impl Accumulate for FaceterTally {
    fn accumulate(&mut self, other: &FaceterTally) {
        self.rays += other.rays;
        self.all.accumulate(&other.all);
        self.table_rays += other.table_rays;
        self.table.accumulate(&other.table);
    }
}

/// The weights of light from a height.
pub(super) fn weights(h: f32) -> [f32; 3] {
    [1.0, h, 2.0 * h * (1.0 - h * h).max(0.0).sqrt()]
}

impl<'a> FaceterView<'a> {
    /// Looks at a stone, without polarisation.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
        sky: ObserverDome,
    ) -> Result<Self, EstimatorError> {
        Ok(Self {
            stone,
            light: Wavelengths::new(medium, stone.unit)?,
            sky,
            view_frame,
            outline: Silhouette::new(stone, view_frame)?,
            facing: facing_flags(stone, view_frame),
            table: entry_sampling::table_flags(stone),
        })
    }
}

/// The rays of a run of points.
struct FaceterClient<'a> {
    estimator: &'a FaceterView<'a>,
    points: KroneckerPoints<2>,
    hues: KroneckerPoints<1>,
    tally: &'a mut FaceterTally,
    power: [Lanes; 3],
    table: Lanes,
    bounces: [u32; LANES],
}

impl RayClient for FaceterClient<'_> {
    const WIDTH: usize = 1;

    fn absorbing(&self) -> bool {
        self.estimator.light.absorb()
    }

    fn stops_by_emitted_power(&self) -> bool {
        self.absorbing()
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let (Some(u), Some([hue])) = (self.points.next(), self.hues.next()) else { return false };
        let FaceterView { stone, light, sky, view_frame, outline, facing, table } = self.estimator;
        let (facet, point) = outline.sample(u);
        let toward = -view_frame.axis.as_vec3();
        let entry = light.line(hue).enter(packet, lane, stone, facet, point, toward);
        let mirrored = sky.mirrored(&entry) * facing[facet];
        let height = ObserverDome::mirror_height(&entry);
        for (power, weight) in self.power.iter_mut().zip(weights(height)) {
            power[lane] = mirrored * weight;
        }
        self.table[lane] = table[facet];
        self.bounces[lane] = 0;
        true
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let axis = self.estimator.view_frame.axis.as_vec3();
        for l in 0..LANES {
            let height = m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z;
            let counts = self.estimator.sky.is_bright(height);
            let power = if counts { m.power[l] * self.estimator.facing[m.facet[l] as usize] } else { 0.0 };
            let [_, cos, sc2] = weights(height);
            self.power[0][l] += power;
            self.power[1][l] += power * cos;
            self.power[2][l] += power * sc2;
            self.bounces[l] += 1;
        }
    }

    fn is_done(&self, lane: usize) -> bool {
        self.bounces[lane] >= MAX_BOUNCES
    }

    fn finish(&mut self, lane: usize) {
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

impl Estimator for FaceterView<'_> {
    type Tally = FaceterTally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut FaceterTally) {
        let mut client = FaceterClient {
            estimator: self,
            hues: KroneckerPoints::new(seed, HUE_STREAM, batch, points.clone()),
            points: KroneckerPoints::new(seed, STREAM, batch, points),
            tally,
            power: [[0.0; LANES]; 3],
            table: [0.0; LANES],
            bounces: [0; LANES],
        };
        lane_scheduler::trace_all(self.stone, STOP_POWER, &mut client);
    }
}
