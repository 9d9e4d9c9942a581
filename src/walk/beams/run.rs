//! The loop over beams: a stack of footprints, each clipped by the facets that it meets.

use super::clip::{Clipper, locate};
use super::facets::{Facets, NONE};
use super::light::{Interface, Light, refract};
use super::{Entrance, Exit, FACETS_LIMIT, FACING, Frame, Lit, Rest, Totals, Watch};
use glam::DVec2;

/// A beam on its way; its footprint is in the arena.
#[derive(Debug, Clone, Copy)]
struct Pending<L, const K: usize> {
    frames: [Frame; K],
    light: L,
    /// Facet it leaves.
    facet: usize,
    start: usize,
    meetings: u32,
}

/// One call of [`super::Beams::follow`]; what it allocates serves all beams.
pub(super) struct Run<'a, L, W, const K: usize> {
    facets: &'a Facets,
    lit: &'a Lit<K>,
    stop_power: f64,
    watch: &'a mut W,
    totals: Totals,
    /// Beams still to be followed, the last one first, and their footprints in the same order.
    stack: Vec<Pending<L, K>>,
    arena: Vec<DVec2>,
    polygon: Vec<DVec2>,
    clipper: Clipper,
    /// Facets that the present beam meets, and for each facet the beam that saw it last.
    queue: Vec<usize>,
    seen_by: Vec<u64>,
    /// Beams taken up so far.
    number: u64,
    /// For each facet, the one that the last beam from it met first.
    last_met: Vec<usize>,
}

/// What all beams of one entry facet have in common.
struct Origin {
    entrance: Entrance,
    /// Light that falls on a unit of the facet's area, as a share of the light on the outline.
    density: f64,
}

impl<'a, L: Light, W: Watch<L, K>, const K: usize> Run<'a, L, W, K> {
    pub(super) fn new(facets: &'a Facets, lit: &'a Lit<K>, stop_power: f64, watch: &'a mut W) -> Self {
        Run {
            facets,
            lit,
            stop_power,
            watch,
            totals: Totals::default(),
            stack: Vec::new(),
            arena: Vec::new(),
            polygon: Vec::new(),
            clipper: Clipper::default(),
            queue: Vec::new(),
            seen_by: vec![0; facets.count()],
            number: 0,
            last_met: (0..facets.count()).collect(),
        }
    }

    /// Follows all light; see [`super::Beams::follow`].
    pub(super) fn all(mut self, light: L) -> Totals {
        let (facets, toward) = (self.facets, self.lit.direction);
        let cosine = |f: usize| -facets.planes[f].normal.dot(toward);
        let lit = || (0..facets.count()).filter(|f| cosine(*f) > FACING && !facets.ring(*f).is_empty());
        self.totals.outline = lit().map(|f| facets.area(f) * cosine(f)).sum();
        for facet in lit() {
            let entrance = Entrance::new(facet, facets.planes[facet], toward);
            let origin = Origin { entrance, density: cosine(facet) / self.totals.outline };
            self.enter(&origin, light);
            while let Some(beam) = self.stack.pop() {
                self.advance(&origin, &beam);
            }
        }
        self.totals
    }

    /// Lets the light into a facet.
    fn enter(&mut self, origin: &Origin, light: L) {
        let Origin { entrance, density } = origin;
        let plane = entrance.plane;
        let refracted = |n: f64| refract(self.lit.direction, -plane.normal, n);
        let frames = self.lit.indices.map(|n| entrance.frame(refracted(n).2));
        let (cos_i, cos_t, passed) = refracted(self.lit.indices[0]);
        let eta = self.lit.indices[0];
        let at = Interface { cos_i, cos_t, eta, normal: plane.normal, passed, frame: &frames[0] };
        let (inside, reflected) = light.split(&at);
        self.totals.reflected += reflected.power() * density * self.facets.area(entrance.facet);
        self.totals.beams += 1;
        let start = self.arena.len();
        self.arena.extend(self.facets.ring(entrance.facet).iter().map(|p| entrance.coordinates(*p)));
        self.stack.push(Pending { frames, light: inside, facet: entrance.facet, start, meetings: 0 });
    }

    /// Takes a beam to the facets that it meets next.
    fn advance(&mut self, origin: &Origin, beam: &Pending<L, K>) {
        self.polygon.clear();
        self.polygon.extend_from_slice(&self.arena[beam.start..]);
        self.arena.truncate(beam.start);
        self.number += 1;
        // beams enter against the facet's normal, which shows the facets ahead clockwise
        let turn = if beam.meetings.is_multiple_of(2) { -1.0 } else { 1.0 };
        self.queue.clear();
        if let Some(first) = self.first_met(beam, turn) {
            self.last_met[beam.facet] = first;
            self.seen_by[first] = self.number;
            self.queue.push(first);
        }
        let mut next = 0;
        while let Some(&facet) = self.queue.get(next) {
            next += 1;
            self.meet(origin, beam, facet, turn);
        }
    }

    /// The facet that the middle of a beam meets.
    fn first_met(&self, beam: &Pending<L, K>, turn: f64) -> Option<usize> {
        let middle = self.polygon.iter().sum::<DVec2>() / self.polygon.len() as f64;
        let frame = &beam.frames[0];
        let cosine = |f: usize| self.facets.planes[f].normal.dot(frame.direction);
        let usable = |f: &usize| cosine(*f) > FACING && !self.facets.ring(*f).is_empty();
        let start = Some(self.last_met[beam.facet]).filter(usable);
        let start = start.or_else(|| (0..self.facets.count()).find(usable))?;
        locate(self.facets, start, frame, turn, middle).filter(usable).or_else(|| {
            // rounding led astray: ask every plane
            let on_facet = frame.point_on(middle, &self.facets.planes[beam.facet]);
            let distance = |f: &usize| -self.facets.planes[*f].height(on_facet) / cosine(*f);
            let ahead = (0..self.facets.count()).filter(usable);
            ahead.min_by(|a, b| distance(a).total_cmp(&distance(b)))
        })
    }

    /// What of a beam meets `facet`: part leaves, part is thrown back.
    fn meet(&mut self, origin: &Origin, beam: &Pending<L, K>, facet: usize, turn: f64) {
        let plane = self.facets.planes[facet];
        let faces = |frame: &Frame| plane.normal.dot(frame.direction) > FACING;
        let [lead, company @ ..] = &beam.frames[..] else { return };
        self.clipper.load(&self.polygon);
        if !faces(lead) || !self.clipper.clip(self.facets, facet, lead, turn) {
            return;
        }
        let beyond = self.facets.beyond(facet);
        for edge in self.clipper.cut_edges() {
            let neighbour = beyond[edge];
            if neighbour != NONE && self.seen_by[neighbour as usize] != self.number {
                self.seen_by[neighbour as usize] = self.number;
                self.queue.push(neighbour as usize);
            }
        }
        for frame in company {
            if !faces(frame) || !self.clipper.clip(self.facets, facet, frame, turn) {
                return;
            }
        }
        let share = self.clipper.area() * origin.density;
        if share <= 0.0 {
            return;
        }
        let eta = 1.0 / self.lit.indices[0];
        let (cos_i, cos_t, passed) = refract(lead.direction, plane.normal, eta);
        let at = Interface { cos_i, cos_t, eta, normal: plane.normal, passed, frame: lead };
        let (out, kept) = beam.light.split(&at);
        let (meetings, footprint) = (beam.meetings + 1, self.clipper.corners());
        let left = out.power() * share;
        if cos_t > 0.0 {
            self.totals.exited += left;
            self.watch.exit(&Exit {
                entrance: &origin.entrance,
                facet,
                direction: passed,
                meetings,
                footprint,
                power: left,
                share,
                light: out,
                frames: &beam.frames,
                normal: plane.normal,
                indices: self.lit.indices,
            });
        }
        let stays = kept.power() * share;
        if stays < self.stop_power || meetings >= FACETS_LIMIT || !kept.goes_on() {
            self.totals.not_followed += stays;
            let (entrance, arrives) = (&origin.entrance, &beam.frames);
            let rest = Rest { entrance, facet, footprint, power: stays, share, light: kept, arrives, plane };
            self.watch.rest(&rest);
            return;
        }
        self.totals.beams += 1;
        let start = self.arena.len();
        self.arena.extend(footprint.iter().map(|c| c.at));
        let frames = beam.frames.map(|f| f.mirrored(&plane));
        self.stack.push(Pending { frames, light: kept, facet, start, meetings });
    }
}
