//! Cells: the luminance of points that lie together in a small square of the picture.
//!
//! An eye does not tell finer things apart. The mean over a cell is never computed, because the
//! noise of a mean of few points would pass for structure; the experiments multiply or compare
//! points of one cell in ways whose expectation is free of it.

use super::entrance::Outline;
use super::view::Sky;
use super::wavelengths::{TOGETHER, Wavelengths};
use super::{Aspect, ExperimentError, Medium, STOP_POWER};
use crate::math::random::{Purpose, Stream};
use crate::walk::feed::{self, Rays};
use crate::walk::{LANES, Lanes, Meeting, Packet, Stone};
use glam::{DVec2, Vec3};

/// Side of a cell as a share of the girdle's width: virtual facets smaller than that are not told
/// apart by eye (J. Sasián et al., *Optical Engineering* 46 (2007) 093604).
pub const SIDE: f64 = 0.01;

/// Side of a cell of this stone, walking units.
pub(super) fn side_for(stone: &Stone) -> f64 {
    SIDE * stone.solid.width() / stone.unit
}

/// Half-angle of the observer under the dome, degrees (AGS; 20° gives its contrast map).
pub const OBSERVER_DEG: f64 = 15.0;

/// Draws for a point of a cell within the outline. Less than one cell in a thousand has so little
/// of it inside that this may not do.
const DRAWS: usize = 32;

/// Random numbers for the cells of a run that starts at point `start` of a batch.
pub(super) fn stream(seed: u64, purpose: Purpose, batch: u64, start: u64) -> Stream {
    // the points' own shift is drawn from the stream of the batch's number
    Stream::new(seed, purpose, (batch + 1) << 40 | start)
}

/// A square cell of a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    inside: DVec2,
    corner: DVec2,
    side: DVec2,
}

impl Cell {
    /// A cell around a place, anyhow turned and shifted: as if the whole grid were.
    pub(super) fn around(inside: DVec2, side: f64, stream: &mut Stream) -> Cell {
        let side = DVec2::from_angle(std::f64::consts::TAU * stream.unit64()) * side;
        let corner = inside - side * stream.unit64() - side.perp() * stream.unit64();
        Cell { inside, corner, side }
    }

    /// Another place of the cell, uniform over what of it `holds` says.
    pub(super) fn another(&self, stream: &mut Stream, holds: impl Fn(DVec2) -> bool) -> DVec2 {
        let mut draw = || self.corner + self.side * stream.unit64() + self.side.perp() * stream.unit64();
        (0..DRAWS).map(|_| draw()).find(|at| holds(*at)).unwrap_or(self.inside)
    }
}

/// A line of sight about to meet the stone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    /// Towards the viewer.
    axis: Vec3,
    facet: usize,
    point: Vec3,
}

impl Sight {
    /// The line of sight through a place of the outline.
    pub(super) fn new(aspect: &Aspect, outline: &Outline, at: DVec2) -> Sight {
        let (facet, point) = outline.meet(at);
        Sight { axis: aspect.axis.as_vec3(), facet, point }
    }
}

/// Lines of sight that belong together.
pub(super) trait Groups {
    /// Sights of one point, next to each other in a group: they are seen in the same wavelengths.
    const OF_A_POINT: usize;

    /// Fills in the next group; false if there is none.
    fn next(&mut self, group: &mut Vec<Sight>) -> bool;

    /// Takes a group's luminances, dome = 1, in the group's order.
    fn take(&mut self, luminances: &[f32]);
}

/// A group on its way.
#[derive(Debug, Default)]
struct Pending {
    luminances: Vec<f32>,
    missing: usize,
}

/// A place in a group.
#[derive(Debug, Clone, Copy, Default)]
struct Seat {
    group: usize,
    member: usize,
}

/// How the cells of a stone are seen.
#[derive(Debug, Clone)]
pub(super) struct Seen<'a> {
    pub(super) stone: &'a Stone,
    pub(super) polarised: bool,
    pub(super) light: Wavelengths,
    pub(super) sky: Sky,
    /// A ray with less than this share of its light is given up.
    pub(super) stop_power: f32,
}

impl<'a> Seen<'a> {
    pub(super) fn new(stone: &'a Stone, medium: &Medium, sky: Sky) -> Result<Self, ExperimentError> {
        let light = Wavelengths::new(medium, stone.unit)?;
        Ok(Seen { stone, polarised: medium.polarised, light, sky, stop_power: STOP_POWER })
    }

    /// Walks all groups.
    ///
    /// - `hues`: what the wavelengths of a stone that absorbs are drawn from
    pub(super) fn walk(&self, groups: &mut impl Groups, hues: Stream) {
        if self.light.absorb() {
            Gaze::<_, TOGETHER>::new(self, groups, hues).walk();
        } else {
            Gaze::<_, 1>::new(self, groups, hues).walk();
        }
    }
}

/// The groups' lines of sight on their way through the lanes, in `K` wavelengths each.
struct Gaze<'a, G, const K: usize> {
    seen: &'a Seen<'a>,
    hues: Stream,
    /// Where in their parts of the light the wavelengths of the present point lie.
    hue: f64,
    groups: &'a mut G,
    /// The last group's sights, and how many of them are on their way.
    sights: Vec<Sight>,
    begun: usize,
    group: usize,
    pending: Vec<Pending>,
    free: Vec<usize>,
    seats: [Seat; LANES],
    axis: [Lanes; 3],
    luminance: Lanes,
}

impl<'a, G: Groups, const K: usize> Gaze<'a, G, K> {
    fn new(seen: &'a Seen<'a>, groups: &'a mut G, hues: Stream) -> Self {
        let zero = [0.0; LANES];
        Gaze {
            seen,
            hues,
            hue: 0.0,
            groups,
            sights: Vec::new(),
            begun: 0,
            group: 0,
            pending: Vec::new(),
            free: Vec::new(),
            seats: [Seat::default(); LANES],
            axis: [zero; 3],
            luminance: zero,
        }
    }

    fn walk(mut self) {
        feed::walk_all(self.seen.stone, self.seen.stop_power, &mut self);
    }

    /// Takes up the next group.
    fn begin(&mut self) -> bool {
        self.sights.clear();
        self.begun = 0;
        if !self.groups.next(&mut self.sights) {
            return false;
        }
        self.group = self.free.pop().unwrap_or_else(|| {
            self.pending.push(Pending::default());
            self.pending.len() - 1
        });
        let pending = &mut self.pending[self.group];
        pending.luminances.clear();
        pending.luminances.resize(self.sights.len(), 0.0);
        pending.missing = self.sights.len();
        true
    }
}

impl<G: Groups, const K: usize> Rays for Gaze<'_, G, K> {
    const WIDTH: usize = K;

    fn polarised(&self) -> bool {
        self.seen.polarised
    }

    fn absorbing(&self) -> bool {
        self.seen.light.absorb()
    }

    fn ends_by_what_came_out(&self) -> bool {
        self.absorbing()
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        if self.begun == self.sights.len() && !self.begin() {
            return false;
        }
        let Some(sight) = self.sights.get(self.begun) else { return false };
        let Seen { stone, light, sky, .. } = self.seen;
        if light.absorb() && self.begun.is_multiple_of(G::OF_A_POINT) {
            self.hue = self.hues.unit64();
        }
        for (lane, optics) in (lane..).zip(light.spread::<K>(self.hue)) {
            let entry = stone.enter(sight.facet, -sight.axis, optics.index);
            packet.enter(lane, sight.point, &entry, optics.index);
            packet.absorption[lane] = optics.absorption;
            self.luminance[lane] = sky.mirrored(&entry);
            for (axis, value) in self.axis.iter_mut().zip(sight.axis.to_array()) {
                axis[lane] = value;
            }
        }
        self.seats[lane] = Seat { group: self.group, member: self.begun };
        self.begun += 1;
        true
    }

    fn meet(&mut self, m: &Meeting, _: &Packet) {
        let [x, y, z] = &self.axis;
        for l in 0..LANES {
            let height = m.dx[l] * x[l] + m.dy[l] * y[l] + m.dz[l] * z[l];
            self.luminance[l] += if self.seen.sky.is_bright(height) { m.power[l] } else { 0.0 };
        }
    }

    fn ended(&mut self, lane: usize) {
        let Seat { group, member } = self.seats[lane];
        let pending = &mut self.pending[group];
        let luminances = &mut self.luminance[lane..lane + K];
        pending.luminances[member] = luminances.iter().sum::<f32>() / K as f32;
        luminances.fill(0.0);
        pending.missing -= 1;
        if pending.missing == 0 {
            self.groups.take(&pending.luminances);
            self.free.push(group);
        }
    }
}
