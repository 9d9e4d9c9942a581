//! Hemisphere: a uniform dome of light above the girdle plane, and everything that comes out.

use super::batches::Estimator;
use super::entry_sampling::{self, Crown, Silhouette};
use super::horizon::is_up;
use super::wavelengths::{HUE_STREAM, Wavelengths};
use super::{EstimatorError, STOP_POWER, TraceOptics, ViewFrame};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::{random::Purpose, stats::Accumulate, warps};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet};
use std::ops::Range;

/// Points of the dome, one stream a batch.
pub(super) const STREAM: Purpose = Purpose::named("hemisphere");

/// The dome over one stone.
///
/// Points of the crown uniform by area, directions cosine-distributed about the facet's normal;
/// directions from below the horizon are drawn but not lit. The dome stays with the viewer when the
/// stone is tilted. D line, or daylight for a stone that absorbs; unpolarised outside.
#[derive(Debug, Clone)]
pub struct Hemisphere<'a> {
    stone: &'a ConvexStone,
    view_frame: ViewFrame,
    polarised: bool,
    light: Wavelengths,
    stop_power: f32,
    entrance: Crown,
    crown: Vec<f32>,
    /// Area of the crown, trace units squared.
    pub crown_area: f64,
    /// Area within the outline that the viewer sees, trace units squared.
    pub outline_area: f64,
}

/// Sums of a batch; every accepted direction arrives with power 1.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HemisphereTally {
    /// Directions drawn, those from below the horizon included.
    pub drawn: f64,
    /// Power that arrived: directions from above the horizon.
    pub arrived: f64,
    /// Reflected at entry.
    pub glare: f64,
    /// Left through the crown, upward.
    pub returned: f64,
    /// The same, weighted by cos² from zenith.
    pub returned_cos2: f64,
    /// Left otherwise.
    pub leaked: f64,
    /// Taken by the stone.
    pub absorbed: f64,
    /// Given up inside.
    pub lost: f64,
}

impl Accumulate for HemisphereTally {
    fn accumulate(&mut self, other: &HemisphereTally) {
        self.drawn += other.drawn;
        self.arrived += other.arrived;
        self.glare += other.glare;
        self.returned += other.returned;
        self.returned_cos2 += other.returned_cos2;
        self.leaked += other.leaked;
        self.absorbed += other.absorbed;
        self.lost += other.lost;
    }

    /// All returned, leaked or absorbed.
    fn bounds_of_untraced(&self) -> Vec<HemisphereTally> {
        let with = |change: fn(&mut HemisphereTally, f64)| {
            let mut tally = self.clone();
            change(&mut tally, self.lost);
            tally
        };
        let returned = |t: &mut HemisphereTally, lost| {
            t.returned += lost;
            t.returned_cos2 += lost;
        };
        // a clear stone takes none of it
        let absorbed = (self.absorbed > 0.0).then(|| with(|t, lost| t.absorbed += lost));
        [with(returned), with(|t, lost| t.leaked += lost)].into_iter().chain(absorbed).collect()
    }
}

impl<'a> Hemisphere<'a> {
    /// Lights a face-up stone.
    pub fn new(stone: &'a ConvexStone, medium: &TraceOptics) -> Result<Self, EstimatorError> {
        Self::in_frame(stone, medium, ViewFrame::FACE_UP)
    }

    /// Lights a stone.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
    ) -> Result<Self, EstimatorError> {
        let entrance = Crown::new(stone)?;
        Ok(Self {
            stone,
            view_frame,
            polarised: medium.polarised,
            light: Wavelengths::new(medium, stone.unit)?,
            stop_power: STOP_POWER,
            crown_area: entrance.area(),
            outline_area: Silhouette::new(stone, view_frame)?.area(),
            entrance,
            crown: entry_sampling::crown_flags(stone),
        })
    }

    /// Gives rays up below `power` instead of [`STOP_POWER`].
    pub fn with_stop_power(self, power: f32) -> Self {
        Self { stop_power: power, ..self }
    }
}

/// The rays of a run of points.
struct HemisphereClient<'a> {
    estimator: &'a Hemisphere<'a>,
    points: KroneckerPoints<4>,
    hues: KroneckerPoints<1>,
    tally: &'a mut HemisphereTally,
    returned: Lanes,
    returned_cos2: Lanes,
    leaked: Lanes,
    absorbed: Lanes,
}

impl RayClient for HemisphereClient<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.estimator.polarised
    }

    fn absorbing(&self) -> bool {
        self.estimator.light.absorb()
    }

    fn stops_by_emitted_power(&self) -> bool {
        self.absorbing()
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Hemisphere { stone, view_frame, light, entrance, .. } = self.estimator;
        for ([a, b, c, d], [hue]) in self.points.by_ref().zip(&mut self.hues) {
            self.tally.drawn += 1.0;
            let (facet, point) = entrance.sample([a, b]);
            let sky = warps::to_world(stone.normals[facet], warps::cosine_hemisphere([c as f32, d as f32]));
            if is_up(view_frame.sin_elevation(sky)) {
                let entry = light.line(hue).enter(packet, lane, stone, facet, point.as_vec3(), -sky);
                self.tally.arrived += 1.0;
                self.tally.glare += f64::from(entry.reflectance);
                return true;
            }
        }
        false
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let axis = self.estimator.view_frame.axis.as_vec3();
        for l in 0..LANES {
            let up = (m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z).max(0.0);
            let through_crown = m.power[l] * self.estimator.crown[m.facet[l] as usize];
            let returned = if is_up(up) { through_crown } else { 0.0 };
            self.returned[l] += returned;
            self.returned_cos2[l] += returned * up * up;
            self.leaked[l] += m.power[l] - returned;
            self.absorbed[l] += m.absorbed[l];
        }
    }

    fn finish(&mut self, lane: usize) {
        let take = |sum: &mut Lanes| f64::from(std::mem::take(&mut sum[lane]));
        self.tally.returned += take(&mut self.returned);
        self.tally.returned_cos2 += take(&mut self.returned_cos2);
        self.tally.leaked += take(&mut self.leaked);
        self.tally.absorbed += take(&mut self.absorbed);
    }
}

impl Estimator for Hemisphere<'_> {
    type Tally = HemisphereTally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut HemisphereTally) {
        let zero = [0.0; LANES];
        let mut dome = HemisphereClient {
            estimator: self,
            hues: KroneckerPoints::new(seed, HUE_STREAM, batch, points.clone()),
            points: KroneckerPoints::new(seed, STREAM, batch, points),
            tally,
            returned: zero,
            returned_cos2: zero,
            leaked: zero,
            absorbed: zero,
        };
        let lost = lane_scheduler::trace_all(self.stone, self.stop_power, &mut dome);
        tally.lost += lost;
    }
}
