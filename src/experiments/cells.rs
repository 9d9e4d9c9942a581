//! Cells: the luminance of points that lie together in a small square of the picture.
//!
//! An eye does not tell finer things apart. The mean over a cell is never computed, because the
//! noise of a mean of few points would pass for structure; the experiments multiply or compare
//! points of one cell in ways whose expectation is free of it.

use super::entrance::Outline;
use super::view::Sky;
use super::{Aspect, Optics};
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

/// A lane with less than this share of its light is given up; see the hemisphere's.
const STOP_POWER: f32 = 1e-4;

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

/// The groups' lines of sight on their way through the lanes.
struct Gaze<'a, G> {
    stone: &'a Stone,
    polarised: bool,
    optics: Optics,
    sky: Sky,
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

/// Walks all groups.
pub(super) fn walk_all(stone: &Stone, optics: Optics, polarised: bool, sky: Sky, groups: &mut impl Groups) {
    let zero = [0.0; LANES];
    let mut gaze = Gaze {
        stone,
        optics,
        polarised,
        sky,
        groups,
        sights: Vec::new(),
        begun: 0,
        group: 0,
        pending: Vec::new(),
        free: Vec::new(),
        seats: [Seat::default(); LANES],
        axis: [zero; 3],
        luminance: zero,
    };
    feed::walk_all(stone, STOP_POWER, &mut gaze);
}

impl<G: Groups> Gaze<'_, G> {
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

impl<G: Groups> Rays for Gaze<'_, G> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.polarised
    }

    fn absorbing(&self) -> bool {
        self.optics.absorbs()
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        if self.begun == self.sights.len() && !self.begin() {
            return false;
        }
        let Some(sight) = self.sights.get(self.begun) else { return false };
        let entry = self.stone.enter(sight.facet, -sight.axis, self.optics.index);
        packet.enter(lane, sight.point, &entry, self.optics.index);
        packet.absorption[lane] = self.optics.absorption;
        self.luminance[lane] = self.sky.mirrored(&entry);
        for (axis, value) in self.axis.iter_mut().zip(sight.axis.to_array()) {
            axis[lane] = value;
        }
        self.seats[lane] = Seat { group: self.group, member: self.begun };
        self.begun += 1;
        true
    }

    fn meet(&mut self, m: &Meeting, _: &Packet) {
        let [x, y, z] = &self.axis;
        for l in 0..LANES {
            let height = m.dx[l] * x[l] + m.dy[l] * y[l] + m.dz[l] * z[l];
            self.luminance[l] += if self.sky.is_bright(height) { m.power[l] } else { 0.0 };
        }
    }

    fn ended(&mut self, lane: usize) {
        let Seat { group, member } = self.seats[lane];
        let pending = &mut self.pending[group];
        pending.luminances[member] = std::mem::take(&mut self.luminance[lane]);
        pending.missing -= 1;
        if pending.missing == 0 {
            self.groups.take(&pending.luminances);
            self.free.push(group);
        }
    }
}
