//! Quadrature: the dome of the hemisphere, direction by direction, each by beams.

use super::batches::Estimator;
use super::hemisphere::{self, ARRIVED, DRAWN, GLARE, LEAKED, LOST, RETURNED, RETURNED_COS2};
use super::horizon::is_up;
use super::kind::{Method, Metric, Setup};
use super::{EstimatorError, TraceOptics, ViewFrame, check_index, entry_sampling};
use crate::optics::stokes::Stokes;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use crate::sampling::tally::Tally;
use crate::trace::beams::residual::{ResidualClient, ResidualPhotons};
use crate::trace::beams::{
    BeamExit, BeamLight, BeamVisitor, Beams, EntryFacet, IncidentBeam, Interface, ResidualBeam, StopCriteria,
    UnpolarisedLight,
};
use crate::trace::{ConvexStone, Interaction, LANES};
use glam::DVec3;
use std::f64::consts::TAU;
use std::ops::Range;

/// Directions of the dome, one stream a batch.
const STREAM: Purpose = Purpose::named("quadrature");

/// Beams weaker than this share of the light on the outline are left to photons.
const STOP_POWER: f64 = 3e-4;

/// Photons that finish the beams of one direction (half to all of them are drawn).
const PHOTONS: usize = 64;

/// The sums of [`super::Hemisphere`] over evenly spread directions of the dome, uniform by solid
/// angle, each followed over the whole crown at once by beams and finished by a few photons.
///
/// Batches shift their directions at random, so their spread is the error of the quadrature, photons
/// included. Checked in `tests/library/exact.rs` against [`super::Hemisphere`].
#[derive(Debug, Clone)]
pub struct Quadrature<'a> {
    stone: &'a ConvexStone,
    beams: Beams<'a>,
    polarised: bool,
    index: f64,
    view_frame: ViewFrame,
    crown: Vec<f32>,
}

impl<'a> Quadrature<'a> {
    /// Lights a stone at the material's D line.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
    ) -> Result<Self, EstimatorError> {
        Ok(Self {
            stone,
            beams: Beams::new(stone),
            polarised: medium.polarised,
            index: f64::from(check_index(medium.material.index_d())?),
            view_frame,
            crown: entry_sampling::crown_flags(stone),
        })
    }

    /// Adds what one direction of the sky brings.
    fn add(&self, sky: DVec3, seed: u64, tally: &mut Tally) {
        let lit = IncidentBeam { direction: -sky, indices: [self.index] };
        let mut one = DirectionVisitor {
            crown: &self.crown,
            axis: self.view_frame.axis,
            sums: DirectionSums::default(),
            glare: 0.0,
            residual: ResidualPhotons::new(seed, 1, PHOTONS),
        };
        let until = StopCriteria::at_power(STOP_POWER);
        let outline = if self.polarised {
            let light = Stokes::unpolarised(1.0, sky.any_orthonormal_vector());
            self.beams.trace(&lit, CrownCounts::new(light), until, &mut one).outline
        } else {
            self.beams.trace(&lit, CrownCounts::new(UnpolarisedLight(1.0)), until, &mut one).outline
        };
        let DirectionVisitor { mut sums, glare, residual, .. } = one;
        let mut finished = DirectionClient {
            crown: &self.crown,
            axis: self.view_frame.axis,
            sums: DirectionSums::default(),
        };
        let (photon, lost) = residual.trace(0, self.stone, lit.indices, &mut finished);
        sums.add(&finished.sums, photon);
        let facets = self.beams.facets();
        let lit_area =
            |f: usize| facets.area(f) * facets.planes[f].normal.dot(sky).max(0.0) * f64::from(self.crown[f]);
        tally[DRAWN] += 1.0;
        tally[ARRIVED] += (0..facets.count()).map(lit_area).sum::<f64>();
        tally[GLARE] += outline * glare;
        tally[RETURNED] += outline * sums.returned;
        tally[RETURNED_COS2] += outline * sums.returned_cos2;
        tally[LEAKED] += outline * sums.leaked;
        tally[LOST] += outline * photon * lost;
    }
}

impl Estimator for Quadrature<'_> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let first = points.start;
        for (i, [u, v]) in (first..).zip(KroneckerPoints::<2>::new(seed, STREAM, batch, points)) {
            let (sin, cos) = (TAU * v).sin_cos();
            let across = (1.0 - u * u).sqrt();
            let ViewFrame { axis, right, top } = self.view_frame;
            // every direction has photons of its own
            let photons = seed.wrapping_add(((batch << 32 | i) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
            self.add(axis * u + (right * cos + top * sin) * across, photons, tally);
        }
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        hemisphere::bounds_of_untraced(sums)
    }
}

/// So many points of the hemisphere are as dear as a direction of the dome that is followed by beams.
const COST: u64 = 256;

/// The method by beams of the hemisphere's metrics.
pub(super) fn methods<'a>(stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
    let Setup { medium, view_frame, .. } = setup;
    vec![Method::samples("quadrature", COST, move || Quadrature::in_frame(stone, &medium, view_frame))]
}

/// Light that goes on only if it entered through the crown.
#[derive(Debug, Clone, Copy)]
struct CrownCounts<L> {
    light: L,
    counts: bool,
}

impl<L: BeamLight> CrownCounts<L> {
    fn new(light: L) -> Self {
        CrownCounts { light, counts: true }
    }
}

impl<L: BeamLight> BeamLight for CrownCounts<L> {
    fn power(&self) -> f64 {
        if self.counts { self.light.power() } else { 0.0 }
    }

    fn split(&self, at: &Interface) -> (Self, Self) {
        let (out, kept) = self.light.split(at);
        let counts = self.counts && (at.is_exit || entry_sampling::is_crown(-at.normal));
        (CrownCounts { light: out, counts }, CrownCounts { light: kept, counts })
    }

    fn is_traced_further(&self) -> bool {
        self.counts
    }

    fn stokes(&self) -> Option<Stokes> {
        self.light.stokes()
    }
}

/// Where light of one direction goes.
#[derive(Debug, Clone, Copy, Default)]
struct DirectionSums {
    returned: f64,
    returned_cos2: f64,
    leaked: f64,
}

impl DirectionSums {
    fn exit(&mut self, through_crown: bool, up: f64, power: f64) {
        if through_crown && is_up(up as f32) {
            self.returned += power;
            self.returned_cos2 += power * up * up;
        } else {
            self.leaked += power;
        }
    }

    fn add(&mut self, other: &DirectionSums, times: f64) {
        self.returned += times * other.returned;
        self.returned_cos2 += times * other.returned_cos2;
        self.leaked += times * other.leaked;
    }
}

/// Exits into sums, the rest into photons.
struct DirectionVisitor<'a> {
    crown: &'a [f32],
    axis: DVec3,
    sums: DirectionSums,
    glare: f64,
    residual: ResidualPhotons<1>,
}

impl<L: BeamLight> BeamVisitor<L, 1> for DirectionVisitor<'_> {
    fn reflected(&mut self, entrance: &EntryFacet, _: DVec3, power: f64) {
        self.glare += power * f64::from(self.crown[entrance.facet]);
    }

    fn exit(&mut self, exit: &BeamExit<L, 1>) {
        self.sums.exit(self.crown[exit.facet] > 0.0, exit.direction.dot(self.axis), exit.power);
    }

    fn residual(&mut self, rest: &ResidualBeam<L, 1>) {
        if rest.power > 0.0 {
            self.residual.add(rest);
        }
    }
}

/// Photons into sums.
struct DirectionClient<'a> {
    crown: &'a [f32],
    axis: DVec3,
    sums: DirectionSums,
}

impl ResidualClient for DirectionClient<'_> {
    fn interact(&mut self, m: &Interaction) {
        for l in 0..LANES {
            if m.power[l] > 0.0 {
                let up = m.direction(l).dot(self.axis.as_vec3());
                self.sums.exit(self.crown[m.facet[l] as usize] > 0.0, up.into(), m.power[l].into());
            }
        }
    }
}
