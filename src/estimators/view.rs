//! View: a parallel eye in front of the stone, traced backward to where the light comes from.

use super::batches::Estimator;
use super::entry_sampling::{self, Silhouette};
use super::horizon::{self, MAX_LEVEL_SINE, is_above, is_up};
use super::wavelengths::{LINES_PER_RAY, Wavelengths};
use super::{EstimatorError, STOP_POWER, TraceOptics, ViewFrame};
pub use crate::color::viewers::{GIA_OBSERVER_DEG, SCOPE_DEG};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use crate::sampling::stats::Accumulate;
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet, Refraction};
use glam::Vec3;
use std::ops::Range;

/// sin 45° and sin 75°: where the bands of the ASET end.
const BAND_LIMITS: [f32; 2] = [std::f32::consts::FRAC_1_SQRT_2, 0.965_925_8];

/// Where light comes from, by elevation above the girdle plane. Numbers index the arrays of
/// [`ViewTally`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum AsetBand {
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
pub struct ObserverDome {
    /// Cosine of the dark cone's half-angle.
    dark_from: f32,
}

impl ObserverDome {
    /// A dome with a dark cone about the viewer.
    ///
    /// - `half_angle`: of the cone, degrees; 0 for no cone at all
    pub fn with_observer(half_angle: f64) -> ObserverDome {
        let cos = half_angle.to_radians().cos() as f32;
        // light along the edge of the cone is bright; but no cone is too small to hold the zenith
        let edge = cos + MAX_LEVEL_SINE.min(0.5 * (1.0 - cos));
        ObserverDome { dark_from: if half_angle > 0.0 { edge } else { f32::INFINITY } }
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
    pub fn mirror_height(entry: &Refraction) -> f32 {
        2.0 * entry.cos_outside * entry.cos_outside - 1.0
    }

    /// What the outer side of a facet mirrors of the dome towards the viewer.
    pub fn mirrored(&self, entry: &Refraction) -> f32 {
        if self.is_bright(ObserverDome::mirror_height(entry)) { entry.reflectance } else { 0.0 }
    }
}

/// Lighting of a view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewerLighting {
    /// The dome whose dark cone is the black of the Ideal-Scope.
    pub scope: ObserverDome,
    /// The dome that luminance is seen under.
    pub dome: ObserverDome,
}

impl Default for ViewerLighting {
    fn default() -> Self {
        ViewerLighting {
            scope: ObserverDome::with_observer(SCOPE_DEG),
            dome: ObserverDome::with_observer(GIA_OBSERVER_DEG),
        }
    }
}

/// Share of the dome's luminance below which a point counts as dark.
pub const DARK: f32 = 0.1;

/// The view of one stone: points uniform over the outline, parallel rays, every facet that faces
/// the viewer. D line, or daylight for a stone that absorbs; unpolarised outside.
#[derive(Debug, Clone)]
pub struct View<'a> {
    pub(super) stone: &'a ConvexStone,
    polarised: bool,
    pub(super) light: Wavelengths,
    stop_power: f32,
    pub(super) view_frame: ViewFrame,
    lighting: ViewerLighting,
    pub(super) outline: Silhouette,
    pavilion: Vec<f32>,
}

/// Sums of a batch; every ray has power 1.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ViewTally {
    /// Rays.
    pub rays: f64,
    /// Reflected at entry.
    pub reflected: f64,
    /// Power by [`AsetBand`], whatever facet it leaves through.
    pub bands: [f64; 4],
    /// Power that leaves upward, weighted by cos² from zenith.
    pub up_cos2: f64,
    /// Taken by the stone.
    pub absorbed: f64,
    /// Given up inside.
    pub lost: f64,
    /// Rays by the [`AsetBand`] of their strongest path (reflection at entry aside).
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

impl Accumulate for ViewTally {
    fn accumulate(&mut self, other: &ViewTally) {
        self.rays += other.rays;
        self.reflected += other.reflected;
        self.bands.accumulate(&other.bands);
        self.up_cos2 += other.up_cos2;
        self.absorbed += other.absorbed;
        self.lost += other.lost;
        self.strongest.accumulate(&other.strongest);
        self.scope_bright += other.scope_bright;
        self.scope_dark += other.scope_dark;
        self.luminance += other.luminance;
        self.windowed += other.windowed;
        self.dark += other.dark;
    }

    /// All from one band, or from within the observer's cone.
    fn bounds_of_untraced(&self) -> Vec<ViewTally> {
        let from = |band: usize, bright: f64| {
            let mut tally = self.clone();
            tally.bands[band] += self.lost;
            tally.up_cos2 += if band < AsetBand::Below as usize { self.lost } else { 0.0 };
            tally.scope_bright += bright * self.lost;
            tally.luminance += bright * self.lost;
            tally
        };
        // a clear stone takes none of it
        let absorbs = self.absorbed > 0.0;
        let absorbed = absorbs.then(|| ViewTally { absorbed: self.absorbed + self.lost, ..self.clone() });
        let zenith = AsetBand::Blue as usize;
        let sky = (0..=zenith).map(|band| from(band, 1.0));
        let viewer = ViewTally { scope_dark: self.scope_dark + self.lost, ..from(zenith, 0.0) };
        sky.chain([viewer, from(AsetBand::Below as usize, 0.0)]).chain(absorbed).collect()
    }
}

impl ViewTally {
    /// Power that leaves upward.
    pub fn up(&self) -> f64 {
        self.bands[..3].iter().sum()
    }
}

impl<'a> View<'a> {
    /// Looks at a face-up stone, with the usual surroundings.
    pub fn new(stone: &'a ConvexStone, medium: &TraceOptics) -> Result<Self, EstimatorError> {
        Self::in_frame(stone, medium, ViewFrame::FACE_UP, ViewerLighting::default())
    }

    /// Looks at a stone.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
        surroundings: ViewerLighting,
    ) -> Result<Self, EstimatorError> {
        Ok(Self {
            stone,
            polarised: medium.polarised,
            light: Wavelengths::new(medium, stone.unit)?,
            stop_power: STOP_POWER,
            view_frame,
            lighting: surroundings,
            outline: Silhouette::new(stone, view_frame)?,
            pavilion: entry_sampling::pavilion_flags(stone),
        })
    }

    /// Gives rays up below `power` instead of [`STOP_POWER`].
    pub fn with_stop_power(self, power: f32) -> Self {
        Self { stop_power: power, ..self }
    }
}

/// The band of a direction whose z is `z`.
pub fn band(z: f32) -> AsetBand {
    if is_above(z, BAND_LIMITS[1]) {
        AsetBand::Blue
    } else if is_above(z, BAND_LIMITS[0]) {
        AsetBand::Red
    } else if is_up(z) {
        AsetBand::Green
    } else {
        AsetBand::Below
    }
}

/// A line of sight: facet and point that it meets, and the place of its wavelengths in their strata, 0..1.
pub(super) type SightLine = ((usize, Vec3), f64);

/// The rays of lines of sight, `K` wavelengths each; sums of a ray are kept in its first lane.
struct ViewClient<'a, S, const K: usize> {
    estimator: &'a View<'a>,
    sights: S,
    tally: &'a mut ViewTally,
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

impl<S: Iterator<Item = SightLine>, const K: usize> RayClient for ViewClient<'_, S, K> {
    const WIDTH: usize = K;

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
        let Some(((facet, point), hue)) = self.sights.next() else { return false };
        let View { stone, light, view_frame, lighting: surroundings, .. } = self.estimator;
        let toward = -view_frame.axis.as_vec3();
        self.tally.rays += 1.0;
        for (lane, optics) in (lane..).zip(light.spread::<K>(hue)) {
            let entry = optics.enter(packet, lane, stone, facet, point, toward);
            self.luminance[lane] = surroundings.dome.mirrored(&entry);
            self.been_below[lane] = 0.0;
            self.tally.reflected += f64::from(entry.reflectance) / K as f64;
        }
        true
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let View { view_frame, lighting: ViewerLighting { scope, dome }, pavilion, .. } = self.estimator;
        let axis = view_frame.axis.as_vec3();
        let (mut height, mut straight) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            let power = m.power[l];
            let z = m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z;
            let up = z.max(0.0);
            self.up_cos2[l] += power * up * up;
            self.absorbed[l] += m.absorbed[l];
            let above = |counts: bool| if counts { power } else { 0.0 };
            let sky = above(is_up(z));
            let (high, zenith) = (above(is_above(z, BAND_LIMITS[0])), above(is_above(z, BAND_LIMITS[1])));
            self.bands[AsetBand::Green as usize][l] += sky - high;
            self.bands[AsetBand::Red as usize][l] += high - zenith;
            self.bands[AsetBand::Blue as usize][l] += zenith;
            self.bands[AsetBand::Below as usize][l] += power - sky;
            self.scope_bright[l] += above(scope.is_bright(z));
            self.scope_dark[l] += above(scope.is_hidden(z));
            self.luminance[l] += above(dome.is_bright(z));
            let below = pavilion[m.facet[l] as usize];
            let first = if self.been_below[l] > 0.0 { 0.0 } else { below };
            self.been_below[l] += below;
            (height[l], straight[l]) = (z, first);
        }
        // the strongest path of a ray: the exit with the greatest power over all wavelengths, by the
        // direction of the strongest of them
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

    fn finish(&mut self, lane: usize) {
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
    /// Traces lines of sight and adds up what is seen along them.
    pub(super) fn trace_sights(&self, sights: impl Iterator<Item = SightLine>, tally: &mut ViewTally) {
        if self.light.absorb() {
            self.trace_in::<LINES_PER_RAY>(sights, tally);
        } else {
            self.trace_in::<1>(sights, tally);
        }
    }

    /// Traces lines of sight in `K` wavelengths each.
    fn trace_in<const K: usize>(&self, sights: impl Iterator<Item = SightLine>, tally: &mut ViewTally) {
        let zero = [0.0; LANES];
        let mut client = ViewClient::<_, K> {
            estimator: self,
            sights,
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
        let lost = lane_scheduler::trace_all(self.stone, self.stop_power, &mut client);
        tally.lost += lost / K as f64;
    }
}

impl Estimator for View<'_> {
    type Tally = ViewTally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut ViewTally) {
        let hues = KroneckerPoints::new(seed, Purpose::ScoreHue, batch, points.clone());
        let places = KroneckerPoints::new(seed, Purpose::View, batch, points);
        self.trace_sights(places.zip(hues).map(|(u, [hue])| (self.outline.sample(u), hue)), tally);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::viewers::ASET_DEG;

    #[test]
    fn the_bands_are_those_of_the_viewer() {
        for (end, deg) in BAND_LIMITS.iter().zip(&ASET_DEG[1..]) {
            assert!((end - deg.to_radians().sin()).abs() < 1e-6);
        }
    }
}
