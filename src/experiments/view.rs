//! View: a parallel eye in front of the stone, traced backward to where the light comes from.

use super::batches::Experiment;
use super::entrance::{self, Outline};
use super::horizon::{self, LEVEL, is_above, is_up};
use super::{Aspect, ExperimentError, Medium, Optics};
use crate::math::points::Points;
use crate::math::random::Purpose;
use crate::math::stats::Sum;
use crate::optics::dispersion::lines;
pub use crate::optics::viewers::{OBSERVER_DEG, SCOPE_DEG};
use crate::walk::feed::{self, Rays};
use crate::walk::{Entry, LANES, Lanes, Meeting, Packet, Stone};
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
/// the viewer. D line, unpolarised outside.
#[derive(Debug, Clone)]
pub struct View<'a> {
    stone: &'a Stone,
    polarised: bool,
    optics: Optics,
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
        self.luminance += other.luminance;
        self.windowed += other.windowed;
        self.dark += other.dark;
    }
}

impl Tally {
    /// Power that leaves upward.
    pub fn up(&self) -> f64 {
        self.bands[..3].iter().sum()
    }
}

impl<'a> View<'a> {
    /// Looks at a face-up stone at the material's D line, with the usual surroundings.
    pub fn new(stone: &'a Stone, medium: &Medium) -> Result<Self, ExperimentError> {
        Self::seen_from(stone, medium, Aspect::FACE_UP, Surroundings::default())
    }

    /// Looks at a stone at the material's D line.
    pub fn seen_from(
        stone: &'a Stone,
        medium: &Medium,
        aspect: Aspect,
        surroundings: Surroundings,
    ) -> Result<Self, ExperimentError> {
        Ok(Self {
            stone,
            polarised: medium.polarised,
            optics: medium.optics(stone.unit, lines::D)?,
            aspect,
            surroundings,
            outline: Outline::new(stone, aspect)?,
            pavilion: entrance::pavilion_flags(stone),
        })
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
    scope_bright: Lanes,
    luminance: Lanes,
    /// 1 once a lane has met the pavilion.
    been_below: Lanes,
    /// 1 if the strongest path so far has left where the lane first met the pavilion.
    windowed: Lanes,
}

impl Rays for Gaze<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.experiment.polarised
    }

    fn absorbing(&self) -> bool {
        self.experiment.optics.absorbs()
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(u) = self.points.next() else { return false };
        let View { stone, optics, aspect, outline, surroundings, .. } = self.experiment;
        let (facet, point) = outline.sample(u);
        let entry = stone.enter(facet, -aspect.axis.as_vec3(), optics.index);
        self.luminance[lane] = surroundings.dome.mirrored(&entry);
        self.been_below[lane] = 0.0;
        self.tally.rays += 1.0;
        self.tally.reflected += f64::from(entry.reflectance);
        packet.enter(lane, point, &entry, optics.index);
        packet.absorption[lane] = optics.absorption;
        true
    }

    fn meet(&mut self, m: &Meeting, _: &Packet) {
        let View { aspect, surroundings: Surroundings { scope, dome }, pavilion, .. } = self.experiment;
        let axis = aspect.axis.as_vec3();
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
            self.luminance[l] += above(dome.is_bright(z));
            let below = pavilion[m.facet[l] as usize];
            let first = if self.been_below[l] > 0.0 { 0.0 } else { below };
            self.been_below[l] += below;
            let stronger = power > self.strongest[l];
            self.windowed[l] = if stronger { first } else { self.windowed[l] };
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
        self.tally.scope_bright += take(&mut self.scope_bright);
        let (luminance, windowed) = (take(&mut self.luminance), take(&mut self.windowed));
        self.tally.luminance += luminance;
        self.tally.windowed += windowed;
        self.tally.dark += if luminance < f64::from(DARK) { 1.0 - windowed } else { 0.0 };
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
            scope_bright: zero,
            luminance: zero,
            been_below: zero,
            windowed: zero,
        };
        let lost = feed::walk_all(self.stone, STOP_POWER, &mut gaze);
        tally.lost += lost;
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
