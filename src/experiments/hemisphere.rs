//! Hemisphere: a uniform dome of light above the girdle plane, and everything that comes out.

use super::batches::Experiment;
use super::entrance::{self, Crown, Outline};
use super::points::Points;
use super::{ExperimentError, check_index};
use crate::math::{random::Purpose, sample};
use crate::optics::Material;
use crate::walk::{LANES, Packet, Stone};
use std::ops::Range;

/// A lane with less than this share of its light is given up. Smaller costs time; larger shows:
/// what is given up is counted in [`Tally::lost`], 3e-5 in all for a round brilliant.
const STOP_POWER: f32 = 1e-4;

/// The dome over one stone.
///
/// Points of the crown uniform by area, directions cosine-distributed about the facet's normal;
/// directions from below the horizon are drawn but not lit. D line, unpolarised, scalar Fresnel.
#[derive(Debug, Clone)]
pub struct Hemisphere<'a> {
    stone: &'a Stone,
    index: f32,
    entrance: Crown,
    crown: Vec<f32>,
    /// Area of the crown, walking units squared.
    pub crown_area: f64,
    /// Area within the outline seen from above, walking units squared.
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
    /// Given up inside.
    pub lost: f64,
}

impl<'a> Hemisphere<'a> {
    /// Lights a stone at the material's D line.
    pub fn new(stone: &'a Stone, material: &Material) -> Result<Self, ExperimentError> {
        let entrance = Crown::new(stone)?;
        Ok(Self {
            stone,
            index: check_index(material.index_d())?,
            crown_area: entrance.area(),
            outline_area: Outline::new(stone)?.area(),
            entrance,
            crown: entrance::crown_flags(stone),
        })
    }

    fn walk(&self, packet: &mut Packet, tally: &mut Tally) {
        let (mut returned, mut cos2, mut left) = ([0f32; LANES], [0f32; LANES], [0f32; LANES]);
        let lost = self.stone.walk(packet, STOP_POWER, |m, _| {
            for l in 0..LANES {
                let z = m.dz[l].max(0.0);
                let up = if z > 0.0 { m.power[l] * self.crown[m.facet[l] as usize] } else { 0.0 };
                returned[l] += up;
                cos2[l] += up * z * z;
                left[l] += m.power[l];
            }
        });
        let sum = |lanes: &[f32; LANES]| lanes.iter().map(|x| f64::from(*x)).sum::<f64>();
        tally.returned += sum(&returned);
        tally.returned_cos2 += sum(&cos2);
        tally.leaked += sum(&left) - sum(&returned);
        tally.lost += f64::from(lost);
    }
}

impl Experiment for Hemisphere<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let mut packet = Packet::default();
        let mut filled = 0;
        for [a, b, c, d] in Points::new(seed, Purpose::Hemisphere, batch, points) {
            tally.drawn += 1.0;
            let (facet, point) = self.entrance.sample([a, b]);
            let toward_sky =
                sample::about(self.stone.normals[facet], sample::cosine_hemisphere([c as f32, d as f32]));
            if toward_sky.z <= 0.0 {
                continue;
            }
            let entry = self.stone.enter(facet, -toward_sky, self.index);
            tally.arrived += 1.0;
            tally.glare += f64::from(entry.reflectance);
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
