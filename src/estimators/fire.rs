//! Fire by beams: what a point light at infinity sends out of the crown, by exact areas; beams too small
//! to be followed are finished by photons.

use super::horizon::is_up;
use super::kind::{Method, Metric, MetricSource, Setup};
use super::point_light::{self, LIT, POINTS, PointLight, PointLightNeeds, STREAK_DEG, THRESHOLD, angle_deg};
use super::same_path::SamePath;
use super::weighted_exits::{BeamEffort, MAX_BEAMS};
use super::{BATCHES, EstimatorError, TraceOptics, ViewFrame, check_index, entry_sampling};
use crate::geometry::Plane;
use crate::optics::dispersion::lines;
use crate::optics::snell::Snell;
use crate::optics::stokes::Stokes;
use crate::parallel;
use crate::sampling::tally::Tally;
use crate::trace::beams::residual::{ResidualClient, ResidualPhotons};
use crate::trace::beams::{
    BeamExit, BeamLight, BeamVisitor, Beams, IncidentBeam, Interface, ResidualBeam, StopCriteria,
    UnpolarisedLight,
};
use crate::trace::{ConvexStone, Interaction, LANES};
use glam::DVec3;

/// A beam that covers less than this share of the outline is left to photons: of a brilliant some
/// tens of thousands are followed, which hold 97 % of its streaks.
const UNIT_AREA: f64 = 5e-5;

/// Fewest photons of a batch: with fewer, visible exits are so rare that their spread is not known, and
/// the stated error with it.
const FEWEST_OF_A_BATCH: usize = 64;

/// Lines that are compared, D first.
const LINES: [f64; 3] = [lines::D, lines::B, lines::G];

/// The methods of the point light's metrics in a clear stone: beams are nearly exact for one direction, and ten
/// times as cheap as photons; what is too faint to be seen takes photons.
pub(super) fn methods<'a>(stone: &'a ConvexStone, setup: Setup<'a>, asked: &[&Metric]) -> Vec<Method<'a>> {
    let Setup { medium, view_frame, .. } = setup;
    let lit = asked.iter().filter_map(|m| needs(m)).any(|needs| needs.lit && !needs.faint);
    let seen = Method::beams("fire", move |effort| {
        fire(&setup.beams(stone), &medium, view_frame, PointLightNeeds { lit, faint: false }, effort)
    });
    let faint = Method::samples("beam", point_light::COST, move || {
        let needs = PointLightNeeds { lit: false, faint: true };
        Ok(PointLight::in_frame(stone, &medium, view_frame)?.for_needs(needs))
    });
    vec![seen.giving(|m| !is_faint(m)), faint.giving(is_faint)]
}

/// The parts of the tally that a metric reads.
fn needs(metric: &Metric) -> Option<PointLightNeeds> {
    match metric.read_from {
        MetricSource::Sums(of) => Some(PointLightNeeds::from_statistic(&of)),
        MetricSource::Solid(_) => None,
    }
}

/// Whether a metric counts exits too faint to be seen.
fn is_faint(metric: &Metric) -> bool {
    needs(metric).is_some_and(|needs| needs.faint)
}

/// Light that is followed by the area it covers, while it is visible.
#[derive(Debug, Clone, Copy)]
struct VisibleLight<L> {
    light: L,
    least: f64,
}

impl<L: BeamLight> BeamLight for VisibleLight<L> {
    /// 1, so that a beam's share of the light is its share of the outline.
    fn power(&self) -> f64 {
        1.0
    }

    fn split(&self, at: &Interface) -> (Self, Self) {
        let (out, kept) = self.light.split(at);
        (VisibleLight { light: out, ..*self }, VisibleLight { light: kept, ..*self })
    }

    fn is_traced_further(&self) -> bool {
        self.light.power() >= self.least
    }

    fn stokes(&self) -> Option<Stokes> {
        self.light.stokes()
    }

    fn photon_share(&self) -> f64 {
        self.light.power()
    }
}

/// The tally of [`super::PointLight`] in batches, which share what beams give and have photons of their own:
/// the streaks, and what is lit. What is too faint to be seen is left out.
///
/// Checked in `tests/library/fire.rs` against [`super::PointLight`].
pub fn fire(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    needs: PointLightNeeds,
    effort: &BeamEffort,
) -> Result<Vec<Tally>, EstimatorError> {
    let indices = LINES.map(|nm| medium.material.index(nm));
    let compared = sums(beams, medium, view_frame, indices, effort, |directions, weight| {
        weight * angle_deg(directions[1], directions[2])
    })?;
    let mut tallies: Vec<Tally> = compared
        .into_iter()
        .map(|streak_deg| Tally::of(&[(POINTS, 1.0), (STREAK_DEG, streak_deg)]))
        .collect();
    if needs.lit {
        for nm in lines::SIX {
            let index = [medium.material.index(nm)];
            let lit = sums(beams, medium, view_frame, index, effort, |_, weight| weight)?;
            let six = lines::SIX.len() as f64;
            tallies.iter_mut().zip(lit).for_each(|(tally, lit)| tally[LIT] += lit / six);
        }
    }
    Ok(tallies)
}

/// Σ over visible exits of what `of` makes of the directions of the lines and of m cos² × area, one a
/// batch, per area of the outline.
fn sums<const K: usize>(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    indices: [f64; K],
    effort: &BeamEffort,
    of: impl Fn(&[DVec3; K], f64) -> f64 + Sync,
) -> Result<Vec<f64>, EstimatorError> {
    let mut greatest = 1.0f64;
    for n in indices {
        check_index(n)?;
        greatest = greatest.max(n);
    }
    let direction = -view_frame.axis;
    let lit = IncidentBeam { direction, indices };
    let least = point_light::least_seen(greatest);
    let crown = entry_sampling::crown_flags(beams.stone());
    let rules = FireRules { crown: &crown, direction, index: indices[0], of: &of };
    let of_a_batch = (effort.photons / BATCHES).max(FEWEST_OF_A_BATCH);
    let residual = ResidualPhotons::new(effort.seed, BATCHES, of_a_batch).stopping_at(least as f32);
    let mut seen = FireVisitor { rules, sum: 0.0, residual };
    let until =
        StopCriteria { beams: MAX_BEAMS, residual: f64::NEG_INFINITY, ..StopCriteria::at_power(UNIT_AREA) };
    if medium.polarised {
        let light = Stokes::unpolarised(1.0, direction.any_orthonormal_vector());
        beams.trace(&lit, VisibleLight { light, least }, until, &mut seen);
    } else {
        beams.trace(&lit, VisibleLight { light: UnpolarisedLight(1.0), least }, until, &mut seen);
    }
    let FireVisitor { sum, residual, .. } = seen;
    let finish = |batch| {
        let mut finished = FireClient { rules, sum: 0.0, together: SamePath::NONE, widening: [0.0; LANES] };
        let (share, _) = residual.trace(batch, beams.stone(), indices, &mut finished);
        sum + share * finished.sum
    };
    Ok(parallel::map(BATCHES, finish))
}

/// Which exits count, and with what weight.
struct FireRules<'a, F> {
    crown: &'a [f32],
    /// Direction of the incident light, unit.
    direction: DVec3,
    /// Refractive index at the leading line.
    index: f64,
    of: &'a F,
}

impl<F> Clone for FireRules<'_, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F> Copy for FireRules<'_, F> {}

impl<F> FireRules<'_, F> {
    /// cos t / cos i at entry through a facet with unit normal `normal`.
    fn widening(&self, normal: DVec3) -> f64 {
        let cos = -normal.dot(self.direction);
        Snell::new(cos, 1.0 / self.index).cos_t / cos
    }

    /// What an exit adds for each part of the outline's area.
    ///
    /// - `power`: as a share of the light that fell in; `width`: m of the leading line
    fn seen<const K: usize>(&self, facet: usize, directions: &[DVec3; K], power: f64, width: f64) -> f64
    where
        F: Fn(&[DVec3; K], f64) -> f64,
    {
        let up = directions.first().map_or(0.0, |d| -d.dot(self.direction));
        let counts = self.crown[facet] > 0.0 && is_up(up as f32) && power > f64::from(THRESHOLD) * width;
        if counts { (self.of)(directions, width * up * up) } else { 0.0 }
    }
}

/// Visitor that sums exits of beams; beams too small to be followed go to photons.
struct FireVisitor<'a, F, const K: usize> {
    rules: FireRules<'a, F>,
    sum: f64,
    residual: ResidualPhotons<K>,
}

impl<L: BeamLight, F: Fn(&[DVec3; K], f64) -> f64, const K: usize> BeamVisitor<VisibleLight<L>, K>
    for FireVisitor<'_, F, K>
{
    fn exit(&mut self, exit: &BeamExit<VisibleLight<L>, K>) {
        let mut directions = [exit.direction; K];
        for (k, direction) in directions.iter_mut().enumerate().skip(1) {
            let Some(leaves) = exit.direction_of(k) else { return };
            *direction = leaves;
        }
        let inside = exit.coords.first().map_or(1.0, |frame| frame.direction.dot(exit.normal));
        let width = self.rules.widening(exit.entry.plane.normal) * exit.direction.dot(exit.normal) / inside;
        self.sum += exit.share * self.rules.seen(exit.facet, &directions, exit.light.light.power(), width);
    }

    fn residual(&mut self, rest: &ResidualBeam<VisibleLight<L>, K>) {
        if rest.light.is_traced_further() {
            self.residual.add(rest);
        }
    }
}

/// Client that sums exits of photons.
struct FireClient<'a, F, const K: usize> {
    rules: FireRules<'a, F>,
    sum: f64,
    together: SamePath<K>,
    /// Of the ray whose first lane it is.
    widening: [f64; LANES],
}

impl<F: Fn(&[DVec3; K], f64) -> f64, const K: usize> ResidualClient for FireClient<'_, F, K> {
    fn begin(&mut self, lane: usize, entrance: &Plane) {
        self.together.begin(lane);
        self.widening[lane] = self.rules.widening(entrance.normal);
    }

    fn is_done(&self, lane: usize) -> bool {
        !self.together.is_same(lane)
    }

    fn interact(&mut self, m: &Interaction) {
        for lane in SamePath::<K>::lanes() {
            if self.together.leave(m, lane) {
                let directions = std::array::from_fn(|k| m.direction(lane + k).as_dvec3());
                let width = self.widening[lane] * f64::from(m.cos_outside[lane] / m.cos_inside[lane]);
                self.sum += self.rules.seen(m.facet[lane] as usize, &directions, m.power[lane].into(), width);
            }
        }
    }
}
