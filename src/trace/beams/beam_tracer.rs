//! The loop over beams: the strongest first, each clipped by the facets that it meets.

use super::beam_coords::{BeamCoords, EntryFacet};
use super::beam_light::{BeamLight, Interface};
use super::beam_visitor::{BeamExit, BeamVisitor, IncidentBeam, ResidualBeam};
use super::clip::{self, Clipper, MIN_FACING_COS, locate};
use super::energy_budget::{EnergyBudget, MAX_FACETS, StopCriteria};
use super::facets::{NO_NEIGHBOUR, WeldedFacets};
use super::queue::Queue;
use super::sector::Sector;
use crate::trace::dispatch::Vectorised;
use crate::trace::{ConvexStone, LANES, NO_FACET, NextFacets, Packet};
use glam::DVec2;

/// A beam under way; its footprint is stored beside it.
#[derive(Debug, Clone, Copy)]
struct Beam<L, const K: usize> {
    frames: [BeamCoords; K],
    light: L,
    /// The footprint's share of the outline.
    share: f64,
    /// Facet it leaves.
    facet: u32,
    /// Number of its origin.
    origin: u32,
    bounces: u32,
}

/// A beam that is followed, and its footprint.
struct BeamSlot<L, const K: usize> {
    beam: Option<Beam<L, K>>,
    footprint: Vec<DVec2>,
    middle: DVec2,
}

/// What all beams of one entry facet have in common.
struct BeamOrigin {
    entrance: EntryFacet,
    /// Light that falls on a unit of the facet's area, as a share of the light on the outline.
    density: f64,
}

/// One call of [`super::Beams::trace`]; what it allocates serves all beams.
pub(super) struct BeamTracer<'a, L, V, const K: usize> {
    stone: &'a ConvexStone,
    facets: &'a WeldedFacets,
    /// The part that is lit for the whole stone.
    sector: Option<Sector>,
    lit: &'a IncidentBeam<K>,
    /// What falls on the stone, power 1.
    light: L,
    until: StopCriteria,
    watch: &'a mut V,
    totals: EnergyBudget,
    origins: Vec<BeamOrigin>,
    queue: Queue<Beam<L, K>>,
    clipper: Clipper,
    /// Facets that the present beam meets, and for each facet the beam that saw it last.
    next_facets: Vec<usize>,
    reached_by: Vec<u64>,
    /// Beams divided so far.
    number: u64,
    /// Power of all beams not yet at their end.
    inside: f64,
}

impl<L: BeamLight, V: BeamVisitor<L, K>, const K: usize> Vectorised for BeamTracer<'_, L, V, K> {
    type Output = EnergyBudget;

    #[inline(always)]
    fn run<const FUSED: bool, const W: usize, const B: usize>(self) -> EnergyBudget {
        self.trace()
    }
}

impl<'a, L: BeamLight, V: BeamVisitor<L, K>, const K: usize> BeamTracer<'a, L, V, K> {
    pub(super) fn new(
        stone: &'a ConvexStone,
        (facets, sector): (&'a WeldedFacets, Option<Sector>),
        lit: &'a IncidentBeam<K>,
        light: L,
        until: StopCriteria,
        watch: &'a mut V,
    ) -> Self {
        BeamTracer {
            stone,
            facets,
            sector,
            lit,
            light,
            until,
            watch,
            totals: EnergyBudget::default(),
            origins: Vec::new(),
            queue: Queue::new(until.residual > 0.0),
            clipper: Clipper::default(),
            next_facets: Vec::new(),
            reached_by: vec![0; facets.count()],
            number: 0,
            inside: 0.0,
        }
    }

    /// Follows all light; see [`super::Beams::trace`].
    #[inline(always)]
    fn trace(mut self) -> EnergyBudget {
        let (facets, toward) = (self.facets, self.lit.direction);
        let cosine = |f: usize| -facets.planes[f].normal.dot(toward);
        let lit =
            || (0..facets.count()).filter(|f| cosine(*f) > MIN_FACING_COS && !facets.ring(*f).is_empty());
        self.totals.outline = lit().map(|f| facets.area(f) * cosine(f)).sum();
        let images = self.sector.as_ref().map_or(1.0, |sector| sector.images);
        for facet in lit() {
            let entrance = EntryFacet::new(facet, facets.planes[facet], toward);
            self.enter(BeamOrigin { entrance, density: images * cosine(facet) / self.totals.outline });
        }
        let slot = |_| BeamSlot { beam: None, footprint: Vec::new(), middle: DVec2::ZERO };
        let mut slots: [BeamSlot<L, K>; LANES] = std::array::from_fn(slot);
        while self.fill(&mut slots) {
            let next = self.ahead(&slots);
            for (slot, facet) in slots.iter_mut().zip(next.facet) {
                if let Some(beam) = &mut slot.beam
                    && !self.step(beam, &slot.footprint, slot.middle, facet)
                {
                    slot.beam = None;
                }
            }
        }
        for slot in &slots {
            if let Some(beam) = &slot.beam {
                self.leave(beam, &slot.footprint);
            }
        }
        let mut footprint = Vec::new();
        while let Some(beam) = self.queue.pop(&mut footprint) {
            self.leave(&beam, &footprint);
        }
        self.totals
    }

    /// Fills empty slots with the strongest beams of the queue; false if none is to be followed further.
    fn fill(&mut self, slots: &mut [BeamSlot<L, K>]) -> bool {
        if self.inside <= self.until.residual || self.totals.beams >= self.until.beams {
            return false;
        }
        let mut some = false;
        for slot in slots {
            if slot.beam.is_none() {
                slot.beam = self.queue.pop(&mut slot.footprint);
                slot.middle = slot.footprint.iter().sum::<DVec2>() / slot.footprint.len() as f64;
            }
            some |= slot.beam.is_some();
        }
        some
    }

    /// The facets that the middles of all beams meet next: a first guess, in `f32`.
    #[inline(always)]
    fn ahead(&self, slots: &[BeamSlot<L, K>; LANES]) -> NextFacets {
        let mut packet = Packet::default();
        for (lane, slot) in slots.iter().enumerate() {
            if let Some(beam) = &slot.beam {
                let frame = &beam.frames[0];
                let plane = &self.facets.planes[beam.facet as usize];
                let point = frame.point_on(slot.middle, plane);
                (packet.x[lane], packet.y[lane], packet.z[lane]) = point.as_vec3().into();
                (packet.dx[lane], packet.dy[lane], packet.dz[lane]) = frame.direction.as_vec3().into();
            }
        }
        self.stone.next_facets(&packet)
    }

    /// Lets the light into a facet.
    fn enter(&mut self, origin: BeamOrigin) {
        let BeamOrigin { entrance, density } = &origin;
        let (facets, normal) = (self.facets, entrance.plane.normal);
        let met = self.lit.indices.map(|n| Interface::new(self.lit.direction, -normal, 1.0 / n, false));
        let frames = met.map(|at| entrance.coords(at.transmitted));
        let (inside, reflected) = self.light.split(&met[0]);
        let ring = facets.ring(entrance.facet);
        let part = self.sector.as_ref().map(|sector| sector.part_of(ring));
        let lit_ring = part.as_deref().unwrap_or(ring);
        let corners: Vec<_> = lit_ring.iter().map(|p| entrance.coordinates(*p)).collect();
        let area = if part.is_some() { clip::area(&corners) } else { facets.area(entrance.facet) };
        if area <= 0.0 {
            return;
        }
        let share = density * area;
        let (glare, toward) = (reflected.power() * share, self.lit.direction);
        self.totals.reflected += glare;
        self.watch.reflected(entrance, toward.reflect(normal), glare);
        let (facet, number) = (entrance.facet as u32, self.origins.len() as u32);
        let beam = Beam { frames, light: inside, share, facet, origin: number, bounces: 0 };
        self.inside += inside.power() * share;
        self.queue.push(beam, inside.power() * share, &corners);
        self.origins.push(origin);
    }

    /// Takes a beam to the facets that it meets next, of which `guess` is likely to be one. False if
    /// it is not to be followed at once.
    #[inline(always)]
    fn step(&mut self, beam: &mut Beam<L, K>, footprint: &[DVec2], middle: DVec2, guess: u32) -> bool {
        self.totals.beams += 1;
        // beams enter against the facet's normal, which shows the facets ahead clockwise
        let orientation_sign = if beam.bounces.is_multiple_of(2) { -1.0 } else { 1.0 };
        let facet = if guess == NO_FACET { 0 } else { guess as usize };
        for frame in &beam.frames {
            if !clip::contains(self.facets, facet, frame, orientation_sign, footprint) {
                self.divide(beam, footprint, middle, facet, orientation_sign);
                return false;
            }
        }
        let Some(power) = self.interact(beam, facet, footprint) else { return false };
        let next = self.queue.is_next(power);
        if !next {
            self.queue.push(*beam, power, footprint);
        }
        next
    }

    /// Divides a beam among the facets that it meets, of which `guess` is likely to be one.
    #[inline(always)]
    fn divide(
        &mut self,
        beam: &Beam<L, K>,
        footprint: &[DVec2],
        middle: DVec2,
        guess: usize,
        orientation_sign: f64,
    ) {
        let mut clipper = std::mem::take(&mut self.clipper);
        self.spread(&mut clipper, beam, footprint, guess, orientation_sign);
        if self.next_facets.is_empty()
            && let Some(first) = self.first_met(beam, middle, orientation_sign)
        {
            self.spread(&mut clipper, beam, footprint, first, orientation_sign);
        }
        self.clipper = clipper;
    }

    /// From a facet that a beam meets to its neighbours, as far as the footprint goes on. If the beam does
    /// not meet the facet, `next_facets` is left empty.
    #[inline(always)]
    fn spread(
        &mut self,
        clipper: &mut Clipper,
        beam: &Beam<L, K>,
        footprint: &[DVec2],
        first: usize,
        orientation_sign: f64,
    ) {
        let facets = self.facets;
        let [lead, company @ ..] = &beam.frames[..] else { return };
        self.number += 1;
        self.reached_by[first] = self.number;
        self.next_facets.clear();
        self.next_facets.push(first);
        let mut next = 0;
        while let Some(&facet) = self.next_facets.get(next) {
            next += 1;
            clipper.load(footprint);
            if !clipper.clip(facets, facet, lead, orientation_sign) {
                continue;
            }
            for edge in clipper.cut_edges() {
                let neighbour = facets.beyond(facet)[edge];
                if neighbour != NO_NEIGHBOUR && self.reached_by[neighbour as usize] != self.number {
                    self.reached_by[neighbour as usize] = self.number;
                    self.next_facets.push(neighbour as usize);
                }
            }
            let mut stays = true;
            for frame in company {
                stays = stays && clipper.clip(facets, facet, frame, orientation_sign);
            }
            if !stays {
                continue;
            }
            let part = clipper.corners();
            let share = clip::area(part) * self.origins[beam.origin as usize].density;
            let mut beam = Beam { share, ..*beam };
            if share > 0.0
                && let Some(power) = self.interact(&mut beam, facet, part)
            {
                self.queue.push(beam, power, part);
            }
        }
        if next == 1 && clipper.is_spent() {
            self.next_facets.clear();
        }
    }

    /// The facet that the middle of a beam meets, sought step by step in `f64`.
    fn first_met(&self, beam: &Beam<L, K>, middle: DVec2, orientation_sign: f64) -> Option<usize> {
        let (facets, frame) = (self.facets, &beam.frames[0]);
        let cosine = |f: usize| facets.planes[f].normal.dot(frame.direction);
        let usable = |f: &usize| cosine(*f) > MIN_FACING_COS && !facets.ring(*f).is_empty();
        let start = (0..facets.count()).find(usable)?;
        locate(facets, start, frame, orientation_sign, middle).filter(usable).or_else(|| {
            // rounding misled the search: test every plane
            let point = frame.point(middle);
            let distance = |f: &usize| -facets.planes[*f].signed_distance(point) / cosine(*f);
            (0..facets.count()).filter(usable).min_by(|a, b| distance(a).total_cmp(&distance(b)))
        })
    }

    /// A beam meets a facet: part leaves, the rest is reflected. Returns the power that goes on, as a share
    /// of the light on the outline.
    #[inline(always)]
    fn interact(&mut self, beam: &mut Beam<L, K>, facet: usize, footprint: &[DVec2]) -> Option<f64> {
        let plane = &self.facets.planes[facet];
        let at = Interface::new(beam.frames[0].direction, plane.normal, self.lit.indices[0], true);
        let (out, kept) = beam.light.split(&at);
        beam.bounces += 1;
        if at.fresnel.cos_t > 0.0 {
            let power = out.power() * beam.share;
            self.totals.exited += power;
            self.inside -= power;
            self.watch.exit(&BeamExit {
                entry: &self.origins[beam.origin as usize].entrance,
                facet,
                direction: at.transmitted,
                bounces: beam.bounces,
                footprint,
                power,
                share: beam.share,
                light: out,
                coords: &beam.frames,
                normal: plane.normal,
                indices: self.lit.indices,
            });
        }
        (beam.light, beam.facet) = (kept, facet as u32);
        for frame in &mut beam.frames {
            frame.mirror(plane);
        }
        let power = kept.power() * beam.share;
        let is_last = beam.bounces >= self.until.facets.min(MAX_FACETS);
        if is_last || power < self.until.power || !kept.is_traced_further() {
            if is_last && self.until.residual > 0.0 {
                self.inside -= power; // nobody asks how it goes on
            }
            self.leave(beam, footprint);
            return None;
        }
        Some(power)
    }

    /// Hands a beam to the visitor as residual.
    fn leave(&mut self, beam: &Beam<L, K>, footprint: &[DVec2]) {
        let power = beam.light.power() * beam.share;
        self.totals.not_followed += power;
        self.watch.residual(&ResidualBeam {
            entry: &self.origins[beam.origin as usize].entrance,
            facet: beam.facet as usize,
            plane: self.facets.planes[beam.facet as usize],
            footprint,
            bounces: beam.bounces,
            power,
            share: beam.share,
            light: beam.light,
            coords: &beam.frames,
        });
    }
}
