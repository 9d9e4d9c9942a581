//! Separation: how far apart a stone sends the colours of one direction, by beams of three lines at
//! once, the remainder finished by photons.

use super::beam::angle_deg;
use super::horizon::is_up;
use super::weigh::{Effort, Weighed, weigh};
use super::{ExperimentError, Medium, entrance};
use crate::math::stats::Estimate;
use crate::optics::dispersion::lines;
use crate::walk::beams::{Beams, Lit};
use glam::DVec3;

/// Lines that go together, D first.
const LINES: [f64; 3] = [lines::D, lines::B, lines::G];

/// How far apart lines B and G leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
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
/// `tests/beams.rs` against the photons of [`super::Beam`].
pub fn separation(
    beams: &Beams,
    direction: DVec3,
    medium: &Medium,
    effort: &Effort,
) -> Result<Separation, ExperimentError> {
    let weighed = weighed(beams, direction, medium, effort)?;
    Ok(Separation { angle_deg: weighed.ratio(0, 1), power: weighed.sum(1) })
}

/// Σ power × angle in degrees, and Σ power, of one direction.
pub(super) fn weighed(
    beams: &Beams,
    direction: DVec3,
    medium: &Medium,
    effort: &Effort,
) -> Result<Weighed<2>, ExperimentError> {
    let lit = Lit { direction, indices: LINES.map(|um| medium.material.index(um)) };
    let crown = entrance::crown_flags(beams.stone());
    weigh(beams, &lit, medium.polarised, effort, |l| {
        let counts = is_up(l.up as f32) && crown[l.facet] > 0.0;
        if counts { [angle_deg(l.directions[1], l.directions[2]), 1.0] } else { [0.0; 2] }
    })
}
