//! Colour separation: how far apart a stone sends the colours of one direction, by beams of three lines at
//! once, the residual finished by photons.

use super::horizon::is_up;
use super::point_light::angle_deg;
use super::weighted_exits::{BeamEffort, WeightedSums, integrate_exits};
use super::{EstimatorError, TraceOptics, entry_sampling};
use crate::optics::dispersion::lines;
use crate::sampling::stats::Estimate;
use crate::trace::beams::{Beams, IncidentBeam};
use glam::DVec3;

/// Lines that go together, D first.
const LINES: [f64; 3] = [lines::D, lines::B, lines::G];

/// How far apart lines B and G leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourSeparation {
    /// Mean angle between B and G in degrees, weighted by the power at D.
    pub angle_deg: Estimate,
    /// Power at D that the mean is taken over, as a share of the light on the outline.
    pub power: Estimate,
}

/// B–G separation of one direction.
///
/// - `direction`: unit, in which the light goes
///
/// Light counts that leaves through the crown on the side that it came from, at a point where B and
/// G, which fell on the same point of the stone, have met the same facets as D and leave too: the
/// beams of the three lines are clipped together. A material without dispersion gives 0. Checked in
/// `tests/library/beams.rs` against the photons of [`super::PointLight`].
pub fn colour_separation(
    beams: &Beams,
    direction: DVec3,
    medium: &TraceOptics,
    effort: &BeamEffort,
) -> Result<ColourSeparation, EstimatorError> {
    let weighed = weighted_mean(beams, direction, medium, effort)?;
    Ok(ColourSeparation { angle_deg: weighed.ratio(0, 1), power: weighed.sum(1) })
}

/// Σ power × angle in degrees, and Σ power, of one direction.
pub(super) fn weighted_mean(
    beams: &Beams,
    direction: DVec3,
    medium: &TraceOptics,
    effort: &BeamEffort,
) -> Result<WeightedSums<2>, EstimatorError> {
    let lit = IncidentBeam { direction, indices: LINES.map(|nm| medium.material.index(nm)) };
    let crown = entry_sampling::crown_flags(beams.stone());
    integrate_exits(beams, &lit, medium.polarised, effort, |l| {
        let counts = is_up(l.up as f32) && crown[l.facet] > 0.0;
        if counts { [angle_deg(l.directions[1], l.directions[2]), 1.0] } else { [0.0; 2] }
    })
}
