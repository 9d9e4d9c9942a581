//! View: a parallel eye in front of the stone, traced backward to where the light comes from.

use super::batches::Experiment;
use super::entrance::{self, Outline};
use super::horizon::{self, LEVEL, is_above, is_up};
use super::wavelengths::{TOGETHER, Wavelengths};
use super::{Aspect, ExperimentError, Medium, STOP_POWER};
use crate::math::points::Points;
use crate::math::random::Purpose;
use crate::math::stats::Sum;
pub use crate::optics::viewers::{OBSERVER_DEG, SCOPE_DEG};
use crate::walk::feed::{self, Rays};
use crate::walk::{Entry, LANES, Lanes, Meeting, Packet, Stone};
use std::ops::Range;

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

/// A white dome above the viewer's horizon, dark where his head is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sky {
    /// Cosine of the dark cone's half-angle.
    dark_from: f32,
}

impl Sky {
    /// A dome with a dark cone about the viewer.
    ///
    /// - `half_angle`: of the cone, degrees; 0 for no cone at all
    pub fn behind(half_angle: f64) -> Sky {
        let cos = half_angle.to_radians().cos() as f32;
        // light along the edge of the cone is bright; but no cone is too small to hold the zenith
        let edge = cos + LEVEL.min(0.5 * (1.0 - cos));
        Sky { dark_from: if half_angle > 0.0 { edge } else { f32::INFINITY } }
    }

    /// Whether light comes from the height (sine of the elevation).
    #[inline(always)]
    pub fn is_bright(&self, height: f32) -> bool {
        horizon::is_up(height) && height < self.dark_from
    }

    /// Whether light comes from the dark cone about the viewer.
    #[inline(always)]
    pub fn is_hidden(&self, height: f32) -> bool {
        height >= self.dark_from.max(f32::MIN_POSITIVE)
    }

    /// The height at which the outer side of a facet mirrors the viewer's line of sight.
    pub fn mirror_height(entry: &Entry) -> f32 {
        2.0 * entry.cos_outside * entry.cos_outside - 1.0
    }

    /// What the outer side of a facet mirrors of the dome towards the viewer.
    pub fn mirrored(&self, entry: &Entry) -> f32 {
        if self.is_bright(Sky::mirror_height(entry)) { entry.reflectance } else { 0.0 }
    }
}

/// What stands around the stone in a view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surroundings {
    /// The dome whose dark cone is the black of the Ideal-Scope.
    pub scope: Sky,
    /// The dome that luminance is seen under.
    pub dome: Sky,
}

impl Default for Surroundings {
    fn default() -> Self {
        Surroundings { scope: Sky::behind(SCOPE_DEG), dome: Sky::behind(OBSERVER_DEG) }
    }
}

/// Share of the dome's luminance below which a point counts as dark.
pub const DARK: f32 = 0.1;

/// The view of one stone: points uniform over the outline, parallel rays, every facet that faces
/// the viewer. D line, or daylight for a stone that absorbs; unpolarised outside.
#[derive(Debug, Clone)]
pub struct View<'a> {
    stone: &'a Stone,
    polarised: bool,
    light: Wavelengths,
    stop_power: f32,
    aspect: Aspect,
    surroundings: Surroundings,
    outline: Outline,
    pavilion: Vec<f32>,
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
    /// Power from above the horizon outside the cone of the Ideal-Scope.
    pub scope_bright: f64,
    /// Power from above the horizon inside that cone.
    pub scope_dark: f64,
    /// Luminance under the dome, reflection at entry included.
    pub luminance: f64,
    /// Rays whose strongest path leaves through the first pavilion facet that it meets.
    pub windowed: f64,
    /// Other rays with a luminance below [`DARK`].
    pub dark: f64,
}

impl Sum for Tally {
    fn add(&mut self, other: &Tally) {
        self.rays += other.rays;
        self.reflected += other.reflected;
        self.bands.add(&other.bands);
        self.up_cos2 += other.up_cos2;
        self.absorbed += other.absorbed;
        self.lost += other.lost;
        self.strongest.add(&other.strongest);
        self.scope_bright += other.scope_bright;
        self.scope_dark += other.scope_dark;
        self.luminance += other.luminance;
        self.windowed += other.windowed;
        self.dark += other.dark;
    }

    /// All from one band, or from within the observer's cone.
    fn if_followed(&self) -> Vec<Tally> {
        let from = |band: usize, bright: f64| {
            let mut tally = self.clone();
            tally.bands[band] += self.lost;
            tally.up_cos2 += if band < Band::Below as usize { self.lost } else { 0.0 };
            tally.scope_bright += bright * self.lost;
            tally.luminance += bright * self.lost;
            tally
        };
        // a clear stone takes none of it
        let absorbs = self.absorbed > 0.0;
        let absorbed = absorbs.then(|| Tally { absorbed: self.absorbed + self.lost, ..self.clone() });
        let zenith = Band::Blue as usize;
        let sky = (0..=zenith).map(|band| from(band, 1.0));
        sky.chain([from(zenith, 0.0), from(Band::Below as usize, 0.0)]).chain(absorbed).collect()
    }
}

impl Tally {
    /// Power that leaves upward.
    pub fn up(&self) -> f64 {
        self.bands[..3].iter().sum()
    }
}

impl<'a> View<'a> {
    /// Looks at a face-up stone, with the usual surroundings.
    pub fn new(stone: &'a Stone, medium: &Medium) -> Result<Self, ExperimentError> {
        Self::seen_from(stone, medium, Aspect::FACE_UP, Surroundings::default())
    }

    /// Looks at a stone.
    pub fn seen_from(
        stone: &'a Stone,
        medium: &Medium,
        aspect: Aspect,
        surroundings: Surroundings,
    ) -> Result<Self, ExperimentError> {
        Ok(Self {
            stone,
            polarised: medium.polarised,
            light: Wavelengths::new(medium, stone.unit)?,
            stop_power: STOP_POWER,
            aspect,
            surroundings,
            outline: Outline::new(stone, aspect)?,
            pavilion: entrance::pavilion_flags(stone),
        })
    }

    /// Gives rays up below `power` instead of [`STOP_POWER`].
    pub fn followed_to(self, power: f32) -> Self {
        Self { stop_power: power, ..self }
    }
}

/// The band of a direction whose z is `z`.
pub fn band(z: f32) -> Band {
    if is_above(z, BAND_ENDS[1]) {
        Band::Blue
    } else if is_above(z, BAND_ENDS[0]) {
        Band::Red
    } else if is_up(z) {
        Band::Green
    } else {
        Band::Below
    }
}

/// The rays of a run of points, `K` wavelengths each; what is said of a ray stands in its first lane.
struct Gaze<'a, const K: usize> {
    experiment: &'a View<'a>,
    points: Points<2>,
    hues: Points<1>,
    tally: &'a mut Tally,
    bands: [Lanes; 4],
    up_cos2: Lanes,
    absorbed: Lanes,
    strongest: Lanes,
    strongest_z: Lanes,
    scope_bright: Lanes,
    scope_dark: Lanes,
    luminance: Lanes,
    /// 1 once a lane has met the pavilion.
    been_below: Lanes,
    /// 1 if the strongest path so far has left where the lane first met the pavilion.
    windowed: Lanes,
}

impl<const K: usize> Rays for Gaze<'_, K> {
    const WIDTH: usize = K;

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
        let (Some(u), Some([hue])) = (self.points.next(), self.hues.next()) else { return false };
        let View { stone, light, aspect, outline, surroundings, .. } = self.experiment;
        let (facet, point) = outline.sample(u);
        self.tally.rays += 1.0;
        for (lane, optics) in (lane..).zip(light.spread::<K>(hue)) {
            let entry = stone.enter(facet, -aspect.axis.as_vec3(), optics.index);
            self.luminance[lane] = surroundings.dome.mirrored(&entry);
            self.been_below[lane] = 0.0;
            self.tally.reflected += f64::from(entry.reflectance) / K as f64;
            packet.enter(lane, point, &entry, optics.index);
            packet.absorption[lane] = optics.absorption;
        }
        true
    }

    fn meet(&mut self, m: &Meeting, _: &Packet) {
        let View { aspect, surroundings: Surroundings { scope, dome }, pavilion, .. } = self.experiment;
        let axis = aspect.axis.as_vec3();
        let (mut height, mut straight) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            let power = m.power[l];
            let z = m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z;
            let up = z.max(0.0);
            self.up_cos2[l] += power * up * up;
            self.absorbed[l] += m.absorbed[l];
            let above = |counts: bool| if counts { power } else { 0.0 };
            let sky = above(is_up(z));
            let (high, zenith) = (above(is_above(z, BAND_ENDS[0])), above(is_above(z, BAND_ENDS[1])));
            self.bands[Band::Green as usize][l] += sky - high;
            self.bands[Band::Red as usize][l] += high - zenith;
            self.bands[Band::Blue as usize][l] += zenith;
            self.bands[Band::Below as usize][l] += power - sky;
            self.scope_bright[l] += above(scope.is_bright(z));
            self.scope_dark[l] += above(scope.is_hidden(z));
            self.luminance[l] += above(dome.is_bright(z));
            let below = pavilion[m.facet[l] as usize];
            let first = if self.been_below[l] > 0.0 { 0.0 } else { below };
            self.been_below[l] += below;
            (height[l], straight[l]) = (z, first);
        }
        // the strongest path of the eye: where most of all wavelengths together leaves, as the one
        // that brings the most of it leaves
        for ray in (0..LANES).step_by(K) {
            let powers = &m.power[ray..ray + K];
            let power = powers.iter().sum::<f32>();
            let most = (1..K).fold(0, |most, k| if powers[k] > powers[most] { k } else { most });
            let stronger = power > self.strongest[ray];
            self.windowed[ray] = if stronger { straight[ray + most] } else { self.windowed[ray] };
            self.strongest[ray] = if stronger { power } else { self.strongest[ray] };
            self.strongest_z[ray] = if stronger { height[ray + most] } else { self.strongest_z[ray] };
        }
    }

    fn ended(&mut self, lane: usize) {
        let of_ray = |of: &mut Lanes| f64::from(std::mem::take(&mut of[lane]));
        let take = |sums: &mut Lanes| {
            let all = sums[lane..lane + K].iter_mut().map(|sum| f64::from(std::mem::take(sum)));
            all.sum::<f64>() / K as f64
        };
        for (sum, lanes) in self.tally.bands.iter_mut().zip(&mut self.bands) {
            *sum += take(lanes);
        }
        self.tally.up_cos2 += take(&mut self.up_cos2);
        self.tally.absorbed += take(&mut self.absorbed);
        self.tally.scope_bright += take(&mut self.scope_bright);
        self.tally.scope_dark += take(&mut self.scope_dark);
        let (luminance, windowed) = (take(&mut self.luminance), of_ray(&mut self.windowed));
        self.tally.luminance += luminance;
        self.tally.windowed += windowed;
        self.tally.dark += if luminance < f64::from(DARK) { 1.0 - windowed } else { 0.0 };
        if of_ray(&mut self.strongest) > 0.0 {
            self.tally.strongest[band(self.strongest_z[lane]) as usize] += 1.0;
        }
    }
}

impl View<'_> {
    /// Traces points in `K` wavelengths each.
    fn trace_in<const K: usize>(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let zero = [0.0; LANES];
        let mut gaze = Gaze::<K> {
            experiment: self,
            hues: Points::new(seed, Purpose::ScoreHue, batch, points.clone()),
            points: Points::new(seed, Purpose::View, batch, points),
            tally,
            bands: [zero; 4],
            up_cos2: zero,
            absorbed: zero,
            strongest: zero,
            strongest_z: zero,
            scope_bright: zero,
            scope_dark: zero,
            luminance: zero,
            been_below: zero,
            windowed: zero,
        };
        let lost = feed::walk_all(self.stone, self.stop_power, &mut gaze);
        tally.lost += lost / K as f64;
    }
}

impl Experiment for View<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        if self.light.absorb() {
            self.trace_in::<TOGETHER>(seed, batch, points, tally);
        } else {
            self.trace_in::<1>(seed, batch, points, tally);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::viewers::ASET_DEG;

    #[test]
    fn the_bands_are_those_of_the_viewer() {
        for (end, deg) in BAND_ENDS.iter().zip(&ASET_DEG[1..]) {
            assert!((end - deg.to_radians().sin()).abs() < 1e-6);
        }
    }
}
