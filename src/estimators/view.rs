//! View: a parallel eye in front of the stone, traced backward to where the light comes from.

use super::batches::Estimator;
use super::entry_sampling::{self, Silhouette};
use super::horizon::{is_above, is_up};
use super::strongest_path::StrongestPaths;
use super::viewer_lighting::BAND_LIMITS;
pub use super::viewer_lighting::{AsetBand, GIA_OBSERVER_DEG, ObserverDome, SCOPE_DEG, ViewerLighting, band};
use super::wavelengths::{LINES_PER_RAY, LightPoints, Wavelengths};
use super::{EstimatorError, STOP_POWER, TraceOptics, ViewFrame};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use crate::sampling::tally::{Column, Tally, columns};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet};
use glam::{DVec3, Vec3};
use std::ops::Range;

/// Points of the outline, one stream a batch.
pub(super) const STREAM: Purpose = Purpose::named("view");

/// Both waves of a facet are followed where each holds more than this share of the light of a ray.
const FOLLOWED: f32 = 1e-3;

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

// Sums of a batch; every ray has power 1.
columns! {
    /// Rays.
    RAYS,
    /// Reflected at entry.
    REFLECTED,
    /// Power from 0 to 45° above the girdle plane, whatever facet it leaves through.
    GREEN,
    /// Power from 45 to 75°.
    RED,
    /// Power from 75 to 90°.
    BLUE,
    /// Power from below the horizon.
    BELOW,
    /// Power that leaves upward, weighted by cos² from zenith.
    UP_COS2,
    /// Taken by the stone.
    ABSORBED,
    /// Given up inside.
    LOST,
    /// Rays whose strongest path (reflection at entry aside) comes from 0 to 45° above the girdle plane.
    STRONGEST_GREEN,
    /// The same from 45 to 75°.
    STRONGEST_RED,
    /// The same from 75 to 90°.
    STRONGEST_BLUE,
    /// The same from below the horizon.
    STRONGEST_BELOW,
    /// Power from above the horizon outside the cone of the Ideal-Scope.
    SCOPE_BRIGHT,
    /// Power from above the horizon inside that cone.
    SCOPE_DARK,
    /// Luminance under the dome, reflection at entry included.
    LUMINANCE,
    /// Rays whose strongest path leaves through the first pavilion facet that it meets.
    WINDOWED,
    /// Other rays with a luminance below [`DARK`].
    DARK_RAYS,
}

/// Power by [`AsetBand`].
pub const BANDS: [Column; 4] = [GREEN, RED, BLUE, BELOW];

/// Rays by the [`AsetBand`] of their strongest path.
pub const STRONGEST: [Column; 4] = [STRONGEST_GREEN, STRONGEST_RED, STRONGEST_BLUE, STRONGEST_BELOW];

/// All that was given up from one band, or from within the observer's cone.
pub(super) fn bounds_of_untraced(sums: &Tally) -> Vec<Tally> {
    let all = |columns: &[Column]| sums.with(columns, sums[LOST]);
    let sky = [GREEN, RED, BLUE].map(|band| all(&[band, UP_COS2, SCOPE_BRIGHT, LUMINANCE]));
    // a clear stone takes none of it
    let absorbed = (sums[ABSORBED] > 0.0).then(|| all(&[ABSORBED]));
    sky.into_iter().chain([all(&[BLUE, UP_COS2, SCOPE_DARK]), all(&[BELOW])]).chain(absorbed).collect()
}

/// Power that leaves upward.
pub fn up(sums: &Tally) -> f64 {
    [GREEN, RED, BLUE].iter().map(|band| sums[*band]).sum()
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

/// A line of sight.
#[derive(Debug, Clone, Copy)]
pub(super) struct SightLine {
    /// Facet and point that it meets.
    pub(super) place: (usize, Vec3),
    /// The place of its wavelengths in their strata, 0..1.
    pub(super) hue: f64,
    /// Uniform in 0..1: chooses between the modes of a stone that refracts doubly.
    pub(super) choice: f64,
}

/// The rays of lines of sight, `K` wavelengths each; sums of a ray are kept in its first lane.
struct ViewClient<'a, S, const K: usize> {
    estimator: &'a View<'a>,
    sights: S,
    tally: &'a mut Tally,
    bands: [Lanes; 4],
    up_cos2: Lanes,
    absorbed: Lanes,
    strongest: StrongestPaths<K>,
    scope_bright: Lanes,
    scope_dark: Lanes,
    luminance: Lanes,
}

impl<S: Iterator<Item = SightLine>, const K: usize> RayClient for ViewClient<'_, S, K> {
    const WIDTH: usize = K;

    fn polarised(&self) -> bool {
        self.estimator.polarised
    }

    fn optic_axis(&self) -> Option<DVec3> {
        self.estimator.light.optic_axis()
    }

    fn absorbing(&self) -> bool {
        self.estimator.light.absorb()
    }

    fn stops_by_emitted_power(&self) -> bool {
        self.absorbing()
    }

    /// The strongest path is no sum of power.
    fn branches_above(&self) -> Option<f32> {
        Some(FOLLOWED)
    }

    fn path_state(&self, lane: usize) -> f32 {
        self.strongest.state(lane)
    }

    fn resume(&mut self, lane: usize, state: f32) {
        self.strongest.resume(lane, state);
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(SightLine { place: (facet, point), hue, choice }) = self.sights.next() else { return false };
        let View { stone, light, view_frame, lighting: surroundings, .. } = self.estimator;
        let toward = -view_frame.axis.as_vec3();
        self.tally[RAYS] += 1.0;
        self.strongest.begin(lane);
        for (lane, optics) in (lane..).zip(light.spread::<K>(hue)) {
            let entry = optics.enter(packet, lane, stone, (facet, point), toward, choice);
            self.luminance[lane] = surroundings.dome.mirrored(&entry);
            self.tally[REFLECTED] += f64::from(entry.reflectance) / K as f64;
        }
        true
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let View { view_frame, lighting: ViewerLighting { scope, dome }, pavilion, .. } = self.estimator;
        let axis = view_frame.axis.as_vec3();
        let (mut height, mut below) = ([0.0; LANES], [0.0; LANES]);
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
            (height[l], below[l]) = (z, pavilion[m.facet[l] as usize]);
        }
        self.strongest.interact(m, &height, &below);
    }

    fn finish(&mut self, lane: usize) {
        let strongest = self.strongest.finish(lane);
        let take = |sums: &mut Lanes| {
            let all = sums[lane..lane + K].iter_mut().map(|sum| f64::from(std::mem::take(sum)));
            all.sum::<f64>() / K as f64
        };
        for (band, lanes) in BANDS.into_iter().zip(&mut self.bands) {
            self.tally[band] += take(lanes);
        }
        self.tally[UP_COS2] += take(&mut self.up_cos2);
        self.tally[ABSORBED] += take(&mut self.absorbed);
        self.tally[SCOPE_BRIGHT] += take(&mut self.scope_bright);
        self.tally[SCOPE_DARK] += take(&mut self.scope_dark);
        let (luminance, windowed) = (take(&mut self.luminance), f64::from(strongest.windowed));
        self.tally[LUMINANCE] += luminance;
        self.tally[WINDOWED] += windowed;
        self.tally[DARK_RAYS] += if luminance < f64::from(DARK) { 1.0 - windowed } else { 0.0 };
        if strongest.power > 0.0 {
            self.tally[STRONGEST[band(strongest.towards) as usize]] += 1.0;
        }
    }
}

impl View<'_> {
    /// Traces lines of sight and adds up what is seen along them.
    pub(super) fn trace_sights(&self, sights: impl Iterator<Item = SightLine>, tally: &mut Tally) {
        if self.light.absorb() {
            self.trace_in::<LINES_PER_RAY>(sights, tally);
        } else {
            self.trace_in::<1>(sights, tally);
        }
    }

    /// Traces lines of sight in `K` wavelengths each.
    fn trace_in<const K: usize>(&self, sights: impl Iterator<Item = SightLine>, tally: &mut Tally) {
        let zero = [0.0; LANES];
        let mut client = ViewClient::<_, K> {
            estimator: self,
            sights,
            tally,
            bands: [zero; 4],
            up_cos2: zero,
            absorbed: zero,
            strongest: StrongestPaths::default(),
            scope_bright: zero,
            scope_dark: zero,
            luminance: zero,
        };
        let lost = lane_scheduler::trace_all(self.stone, self.stop_power, &mut client);
        tally[LOST] += lost / K as f64;
    }
}

impl Estimator for View<'_> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let lights = LightPoints::new(seed, batch, points.clone());
        let places = KroneckerPoints::new(seed, STREAM, batch, points);
        let sight = |(u, [hue, choice])| SightLine { place: self.outline.sample(u), hue, choice };
        self.trace_sights(places.zip(lights).map(sight), tally);
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        bounds_of_untraced(sums)
    }
}
