//! Pixel cells: the luminance of points that lie together in a small square of the picture.
//!
//! An eye does not tell finer things apart. The mean over a cell is never computed, because the
//! noise of a mean of few points would pass for structure; the estimators multiply or compare
//! points of one cell in ways whose expectation is free of it.

use super::batches::Estimator;
use super::entry_sampling::Silhouette;
use super::kind::{Method, Setup};
use super::viewer_lighting::ObserverDome;
use super::wavelengths::{HUE_STREAM, LINES_PER_RAY, MODE_STREAM, Wavelengths};
use super::{EstimatorError, STOP_POWER, TraceOptics, ViewFrame};
use crate::sampling::random::{Purpose, Stream};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet};
use glam::{DVec2, DVec3, Vec3};

/// Side of a cell as a share of the girdle's width: virtual facets smaller than that are not told
/// apart by eye (J. Sasián et al., *Optical Engineering* 46 (2007) 093604).
pub const CELL_SIDE: f64 = 0.01;

/// Side of a cell of this stone, trace units.
pub(super) fn side_for(stone: &ConvexStone) -> f64 {
    CELL_SIDE * stone.solid.width() / stone.unit
}

/// Half-angle of the observer under the dome, degrees (AGS; 20° gives its contrast map).
pub const AGS_OBSERVER_DEG: f64 = 15.0;

/// Draws for a point of a cell within the outline. They may not suffice for less than one cell in a
/// thousand.
const DRAWS: usize = 32;

/// The method of an estimator of cells: samples, under a dome with the observer of AGS, or the one asked for.
///
/// - `cost`: so many points of the hemisphere are as dear as a cell in one wavelength
pub(super) fn methods<'a, E: Estimator + 'a>(
    name: &'static str,
    cost: u64,
    setup: Setup<'a>,
    make: impl FnOnce(ObserverDome) -> Result<E, EstimatorError> + 'a,
) -> Vec<Method<'a>> {
    let dome = setup.dome(AGS_OBSERVER_DEG);
    vec![Method::samples(name, cost * setup.medium.wavelengths_per_point(), move || make(dome))]
}

/// Random numbers for the cells of a run that starts at point `start` of a batch.
pub(super) fn stream(seed: u64, purpose: Purpose, batch: u64, start: u64) -> Stream {
    // the points' own shift is drawn from the stream of the batch's number
    Stream::new(seed, purpose, (batch + 1) << 40 | start)
}

/// A square cell of a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct PixelCell {
    inside: DVec2,
    corner: DVec2,
    side: DVec2,
}

impl PixelCell {
    /// A cell around a place, of a randomly rotated and shifted grid.
    pub(super) fn around(inside: DVec2, side: f64, stream: &mut Stream) -> PixelCell {
        let side = DVec2::from_angle(std::f64::consts::TAU * stream.unit64()) * side;
        let corner = inside - side * stream.unit64() - side.perp() * stream.unit64();
        PixelCell { inside, corner, side }
    }

    /// Another place of the cell, uniform over the part of it where `holds` is true.
    pub(super) fn sample(&self, stream: &mut Stream, holds: impl Fn(DVec2) -> bool) -> DVec2 {
        let mut draw = || self.corner + self.side * stream.unit64() + self.side.perp() * stream.unit64();
        (0..DRAWS).map(|_| draw()).find(|at| holds(*at)).unwrap_or(self.inside)
    }
}

/// A line of sight about to meet the stone.
#[derive(Debug, Clone, Copy)]
pub(super) struct SightLine {
    /// Towards the viewer.
    axis: Vec3,
    facet: usize,
    point: Vec3,
}

impl SightLine {
    /// The line of sight through a place of the outline.
    pub(super) fn new(view_frame: &ViewFrame, outline: &Silhouette, at: DVec2) -> SightLine {
        let (facet, point) = outline.facet_above(at);
        SightLine { axis: view_frame.axis.as_vec3(), facet, point }
    }
}

/// Lines of sight that belong together.
pub(super) trait SampleGroups {
    /// Sights of one point, next to each other in a group: they are seen in the same wavelengths.
    const POINT_GROUPS: usize;

    /// Fills in the next group; false if there is none.
    fn next_group(&mut self, group: &mut Vec<SightLine>) -> bool;

    /// Receives a group's luminances, dome = 1, in the group's order.
    fn accept(&mut self, luminances: &[f32]);
}

/// A group under way.
#[derive(Debug, Default)]
struct PendingGroup {
    luminances: Vec<f32>,
    missing: usize,
}

/// A place in a group.
#[derive(Debug, Clone, Copy, Default)]
struct LaneSlot {
    group: usize,
    member: usize,
}

/// Tracer of the cells of a stone's picture.
#[derive(Debug, Clone)]
pub(super) struct CellTracer<'a> {
    pub(super) stone: &'a ConvexStone,
    pub(super) polarised: bool,
    pub(super) light: Wavelengths,
    pub(super) sky: ObserverDome,
    /// A ray with less than this share of its light is given up.
    pub(super) stop_power: f32,
}

impl<'a> CellTracer<'a> {
    pub(super) fn new(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        sky: ObserverDome,
    ) -> Result<Self, EstimatorError> {
        let light = Wavelengths::new(medium, stone.unit)?;
        Ok(CellTracer { stone, polarised: medium.polarised, light, sky, stop_power: STOP_POWER })
    }

    /// Traces all groups of a run.
    ///
    /// - `seed`, `batch`, `start` (the run's first point): what the wavelengths of a stone that absorbs are
    ///   drawn by
    pub(super) fn trace(&self, groups: &mut impl SampleGroups, seed: u64, batch: u64, start: u64) {
        let streams = [HUE_STREAM, MODE_STREAM].map(|purpose| stream(seed, purpose, batch, start));
        if self.light.absorb() {
            CellClient::<_, LINES_PER_RAY>::new(self, groups, streams).trace();
        } else {
            CellClient::<_, 1>::new(self, groups, streams).trace();
        }
    }
}

/// The client that traces the groups' lines of sight, in `K` wavelengths each.
struct CellClient<'a, G, const K: usize> {
    seen: &'a CellTracer<'a>,
    hues: Stream,
    /// Chooses the modes of a doubly refracting stone.
    modes: Stream,
    /// Place of the present point's wavelengths in their strata, 0..1.
    hue: f64,
    groups: &'a mut G,
    /// The last group's lines of sight, and how many of them have been loaded.
    sights: Vec<SightLine>,
    begun: usize,
    group: usize,
    pending: Vec<PendingGroup>,
    free: Vec<usize>,
    seats: [LaneSlot; LANES],
    axis: [Lanes; 3],
    luminance: Lanes,
}

impl<'a, G: SampleGroups, const K: usize> CellClient<'a, G, K> {
    fn new(seen: &'a CellTracer<'a>, groups: &'a mut G, [hues, modes]: [Stream; 2]) -> Self {
        let zero = [0.0; LANES];
        CellClient {
            seen,
            hues,
            modes,
            hue: 0.0,
            groups,
            sights: Vec::new(),
            begun: 0,
            group: 0,
            pending: Vec::new(),
            free: Vec::new(),
            seats: [LaneSlot::default(); LANES],
            axis: [zero; 3],
            luminance: zero,
        }
    }

    fn trace(mut self) {
        lane_scheduler::trace_all(self.seen.stone, self.seen.stop_power, &mut self);
    }

    /// Begins the next group.
    fn begin(&mut self) -> bool {
        self.sights.clear();
        self.begun = 0;
        if !self.groups.next_group(&mut self.sights) {
            return false;
        }
        self.group = self.free.pop().unwrap_or_else(|| {
            self.pending.push(PendingGroup::default());
            self.pending.len() - 1
        });
        let pending = &mut self.pending[self.group];
        pending.luminances.clear();
        pending.luminances.resize(self.sights.len(), 0.0);
        pending.missing = self.sights.len();
        true
    }
}

impl<G: SampleGroups, const K: usize> RayClient for CellClient<'_, G, K> {
    const WIDTH: usize = K;

    fn polarised(&self) -> bool {
        self.seen.polarised
    }

    fn optic_axis(&self) -> Option<DVec3> {
        self.seen.light.optic_axis()
    }

    fn absorbing(&self) -> bool {
        self.seen.light.absorb()
    }

    fn stops_by_emitted_power(&self) -> bool {
        self.absorbing()
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        if self.begun == self.sights.len() && !self.begin() {
            return false;
        }
        let Some(sight) = self.sights.get(self.begun) else { return false };
        let CellTracer { stone, light, sky, .. } = self.seen;
        if light.absorb() && self.begun.is_multiple_of(G::POINT_GROUPS) {
            self.hue = self.hues.unit64();
        }
        let choice = if light.optic_axis().is_some() { self.modes.unit64() } else { 0.0 };
        for (lane, optics) in (lane..).zip(light.spread::<K>(self.hue)) {
            let entry = optics.enter(packet, lane, stone, (sight.facet, sight.point), -sight.axis, choice);
            self.luminance[lane] = sky.mirrored(&entry);
            for (axis, value) in self.axis.iter_mut().zip(sight.axis.to_array()) {
                axis[lane] = value;
            }
        }
        self.seats[lane] = LaneSlot { group: self.group, member: self.begun };
        self.begun += 1;
        true
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let [x, y, z] = &self.axis;
        for l in 0..LANES {
            let height = m.dx[l] * x[l] + m.dy[l] * y[l] + m.dz[l] * z[l];
            self.luminance[l] += if self.seen.sky.is_bright(height) { m.power[l] } else { 0.0 };
        }
    }

    fn finish(&mut self, lane: usize) {
        let LaneSlot { group, member } = self.seats[lane];
        let pending = &mut self.pending[group];
        let luminances = &mut self.luminance[lane..lane + K];
        pending.luminances[member] = luminances.iter().sum::<f32>() / K as f32;
        luminances.fill(0.0);
        pending.missing -= 1;
        if pending.missing == 0 {
            self.groups.accept(&pending.luminances);
            self.free.push(group);
        }
    }
}
