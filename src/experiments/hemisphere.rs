//! Hemisphere: a uniform dome of light above the girdle plane, and everything that comes out.

use super::batches::Experiment;
use super::entrance::{self, Crown, Outline};
use super::horizon::is_up;
use super::wavelengths::Wavelengths;
use super::{Aspect, ExperimentError, Medium, STOP_POWER};
use crate::math::points::Points;
use crate::math::{random::Purpose, sample, stats::Sum};
use crate::walk::feed::{self, Rays};
use crate::walk::{LANES, Lanes, Meeting, Packet, Stone};
use std::ops::Range;

/// The dome over one stone.
///
/// Points of the crown uniform by area, directions cosine-distributed about the facet's normal;
/// directions from below the horizon are drawn but not lit. The dome stays with the viewer when the
/// stone is tilted. D line, or daylight for a stone that absorbs; unpolarised outside.
#[derive(Debug, Clone)]
pub struct Hemisphere<'a> {
    stone: &'a Stone,
    aspect: Aspect,
    polarised: bool,
    light: Wavelengths,
    stop_power: f32,
    entrance: Crown,
    crown: Vec<f32>,
    /// Area of the crown, walking units squared.
    pub crown_area: f64,
    /// Area within the outline that the viewer sees, walking units squared.
    pub outline_area: f64,
}

/// Sums of a batch; every accepted direction arrives with power 1.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
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

impl Sum for Tally {
    fn add(&mut self, other: &Tally) {
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
    fn if_followed(&self) -> Vec<Tally> {
        let with = |change: fn(&mut Tally, f64)| {
            let mut tally = self.clone();
            change(&mut tally, self.lost);
            tally
        };
        let returned = |t: &mut Tally, lost| {
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
    pub fn new(stone: &'a Stone, medium: &Medium) -> Result<Self, ExperimentError> {
        Self::seen_from(stone, medium, Aspect::FACE_UP)
    }

    /// Lights a stone.
    pub fn seen_from(stone: &'a Stone, medium: &Medium, aspect: Aspect) -> Result<Self, ExperimentError> {
        let entrance = Crown::new(stone)?;
        Ok(Self {
            stone,
            aspect,
            polarised: medium.polarised,
            light: Wavelengths::new(medium, stone.unit)?,
            stop_power: STOP_POWER,
            crown_area: entrance.area(),
            outline_area: Outline::new(stone, aspect)?.area(),
            entrance,
            crown: entrance::crown_flags(stone),
        })
    }

    /// Gives rays up below `power` instead of [`STOP_POWER`].
    pub fn followed_to(self, power: f32) -> Self {
        Self { stop_power: power, ..self }
    }
}

/// The rays of a run of points.
struct Dome<'a> {
    experiment: &'a Hemisphere<'a>,
    points: Points<4>,
    hues: Points<1>,
    tally: &'a mut Tally,
    returned: Lanes,
    returned_cos2: Lanes,
    leaked: Lanes,
    absorbed: Lanes,
}

impl Rays for Dome<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.experiment.polarised
    }

    fn absorbing(&self) -> bool {
        self.experiment.light.absorb()
    }

    fn ends_by_what_came_out(&self) -> bool {
        self.absorbing()
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Hemisphere { stone, aspect, light, entrance, .. } = self.experiment;
        for ([a, b, c, d], [hue]) in self.points.by_ref().zip(&mut self.hues) {
            self.tally.drawn += 1.0;
            let (facet, point) = entrance.sample([a, b]);
            let sky = sample::about(stone.normals[facet], sample::cosine_hemisphere([c as f32, d as f32]));
            if is_up(aspect.height(sky)) {
                let optics = light.at(hue);
                let entry = stone.enter(facet, -sky, optics.index);
                self.tally.arrived += 1.0;
                self.tally.glare += f64::from(entry.reflectance);
                packet.enter(lane, point.as_vec3(), &entry, optics.index);
                packet.absorption[lane] = optics.absorption;
                return true;
            }
        }
        false
    }

    fn meet(&mut self, m: &Meeting, _: &Packet) {
        let axis = self.experiment.aspect.axis.as_vec3();
        for l in 0..LANES {
            let up = (m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z).max(0.0);
            let through_crown = m.power[l] * self.experiment.crown[m.facet[l] as usize];
            let returned = if is_up(up) { through_crown } else { 0.0 };
            self.returned[l] += returned;
            self.returned_cos2[l] += returned * up * up;
            self.leaked[l] += m.power[l] - returned;
            self.absorbed[l] += m.absorbed[l];
        }
    }

    fn ended(&mut self, lane: usize) {
        let take = |sum: &mut Lanes| f64::from(std::mem::take(&mut sum[lane]));
        self.tally.returned += take(&mut self.returned);
        self.tally.returned_cos2 += take(&mut self.returned_cos2);
        self.tally.leaked += take(&mut self.leaked);
        self.tally.absorbed += take(&mut self.absorbed);
    }
}

impl Experiment for Hemisphere<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let zero = [0.0; LANES];
        let mut dome = Dome {
            experiment: self,
            hues: Points::new(seed, Purpose::ScoreHue, batch, points.clone()),
            points: Points::new(seed, Purpose::Hemisphere, batch, points),
            tally,
            returned: zero,
            returned_cos2: zero,
            leaked: zero,
            absorbed: zero,
        };
        let lost = feed::walk_all(self.stone, self.stop_power, &mut dome);
        tally.lost += lost;
    }
}
