//! Fire by beams: what a point light at infinity sends out of the crown, by exact areas; beams too small
//! to be followed are finished by photons.

use super::beam::{self, Needs, THRESHOLD, angle_deg};
use super::horizon::is_up;
use super::together::Together;
use super::weigh::{Effort, MOST_BEAMS};
use super::{Aspect, BATCHES, ExperimentError, Medium, check_index, entrance};
use crate::optics::dispersion::lines;
use crate::optics::stokes::Stokes;
use crate::solid::Plane;
use crate::walk::beams::remainder::{Photons, Remainder};
use crate::walk::beams::{Beams, Exit, Interface, Light, Lit, Rest, Scalar, Until, Watch};
use crate::walk::{LANES, Meeting};
use glam::DVec3;
use rayon::prelude::*;

/// A beam that covers less than this share of the outline is left to photons: of a brilliant some
/// tens of thousands are followed, which hold 97 % of its streaks.
const AREA: f64 = 5e-5;

/// Fewest photons of a batch: with fewer, visible exits are so rare that their spread is not known, and
/// the stated error with it.
const FEWEST_OF_A_BATCH: usize = 64;

/// Lines that are compared, D first.
const LINES: [f64; 3] = [lines::D, lines::B, lines::G];

/// Light that is followed by the area it covers, while it can be seen.
#[derive(Debug, Clone, Copy)]
struct Visible<L> {
    light: L,
    least: f64,
}

impl<L: Light> Light for Visible<L> {
    /// 1, so that a beam's share of the light is its share of the outline.
    fn power(&self) -> f64 {
        1.0
    }

    fn split(&self, at: &Interface) -> (Self, Self) {
        let (out, kept) = self.light.split(at);
        (Visible { light: out, ..*self }, Visible { light: kept, ..*self })
    }

    fn goes_on(&self) -> bool {
        self.light.power() >= self.least
    }

    fn stokes(&self) -> Option<Stokes> {
        self.light.stokes()
    }

    fn of_photon(&self) -> f64 {
        self.light.power()
    }
}

/// The tally of [`super::Beam`] in batches, which share what beams give and have photons of their own:
/// the streaks, and what is lit. What is too faint to be seen is left out.
///
/// Checked in `tests/fire.rs` against [`super::Beam`].
pub fn fire(
    beams: &Beams,
    medium: &Medium,
    aspect: Aspect,
    needs: Needs,
    effort: &Effort,
) -> Result<Vec<beam::Tally>, ExperimentError> {
    let indices = LINES.map(|um| medium.material.index(um));
    let compared = sums(beams, medium, aspect, indices, effort, |directions, weight| {
        weight * angle_deg(directions[1], directions[2])
    })?;
    let mut tallies: Vec<_> = compared
        .into_iter()
        .map(|streak_deg| beam::Tally { points: 1.0, streak_deg, ..beam::Tally::default() })
        .collect();
    if needs.lit {
        for um in lines::SIX {
            let index = [medium.material.index(um)];
            let lit = sums(beams, medium, aspect, index, effort, |_, weight| weight)?;
            let six = lines::SIX.len() as f64;
            tallies.iter_mut().zip(lit).for_each(|(tally, lit)| tally.lit += lit / six);
        }
    }
    Ok(tallies)
}

/// Σ over visible exits of what `of` makes of the directions of the lines and of m cos² × area, one a
/// batch, per area of the outline.
fn sums<const K: usize>(
    beams: &Beams,
    medium: &Medium,
    aspect: Aspect,
    indices: [f64; K],
    effort: &Effort,
    of: impl Fn(&[DVec3; K], f64) -> f64 + Sync,
) -> Result<Vec<f64>, ExperimentError> {
    let mut greatest = 1.0f64;
    for n in indices {
        check_index(n)?;
        greatest = greatest.max(n);
    }
    let direction = -aspect.axis;
    let lit = Lit { direction, indices };
    let least = beam::least_seen(greatest);
    let crown = entrance::crown_flags(beams.stone());
    let rules = Rules { crown: &crown, direction, index: indices[0], of: &of };
    let of_a_batch = (effort.photons / BATCHES).max(FEWEST_OF_A_BATCH);
    let remainder = Remainder::new(effort.seed, BATCHES, of_a_batch).ending_at(least as f32);
    let mut seen = Seen { rules, sum: 0.0, remainder };
    let until = Until { beams: MOST_BEAMS, left: f64::NEG_INFINITY, ..Until::power(AREA) };
    if medium.polarised {
        let light = Stokes::unpolarised(1.0, direction.any_orthonormal_vector());
        beams.follow(&lit, Visible { light, least }, until, &mut seen);
    } else {
        beams.follow(&lit, Visible { light: Scalar(1.0), least }, until, &mut seen);
    }
    let Seen { sum, remainder, .. } = seen;
    let finish = |batch| {
        let mut finished = Finished { rules, sum: 0.0, together: Together::NONE, widening: [0.0; LANES] };
        let (share, _) = remainder.walk(batch, beams.stone(), indices, &mut finished);
        sum + share * finished.sum
    };
    Ok((0..BATCHES).into_par_iter().map(finish).collect())
}

/// Which exits count, and for how much.
struct Rules<'a, F> {
    crown: &'a [f32],
    /// In which the light goes.
    direction: DVec3,
    /// Of the leading line.
    index: f64,
    of: &'a F,
}

impl<F> Clone for Rules<'_, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F> Copy for Rules<'_, F> {}

impl<F> Rules<'_, F> {
    /// cos t / cos i at entry through a facet with unit normal `normal`.
    fn widening(&self, normal: DVec3) -> f64 {
        let cos = -normal.dot(self.direction);
        (1.0 - (1.0 - cos * cos) / self.index.powi(2)).max(0.0).sqrt() / cos
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

/// Exits of beams into a sum, what is too small to be followed into photons.
struct Seen<'a, F, const K: usize> {
    rules: Rules<'a, F>,
    sum: f64,
    remainder: Remainder<K>,
}

impl<L: Light, F: Fn(&[DVec3; K], f64) -> f64, const K: usize> Watch<Visible<L>, K> for Seen<'_, F, K> {
    fn exit(&mut self, exit: &Exit<Visible<L>, K>) {
        let mut directions = [exit.direction; K];
        for (k, direction) in directions.iter_mut().enumerate().skip(1) {
            let Some(leaves) = exit.direction_of(k) else { return };
            *direction = leaves;
        }
        let inside = exit.frames.first().map_or(1.0, |frame| frame.direction.dot(exit.normal));
        let width =
            self.rules.widening(exit.entrance.plane.normal) * exit.direction.dot(exit.normal) / inside;
        self.sum += exit.share * self.rules.seen(exit.facet, &directions, exit.light.light.power(), width);
    }

    fn rest(&mut self, rest: &Rest<Visible<L>, K>) {
        if rest.light.goes_on() {
            self.remainder.add(rest);
        }
    }
}

/// Exits of photons into a sum.
struct Finished<'a, F, const K: usize> {
    rules: Rules<'a, F>,
    sum: f64,
    together: Together<K>,
    /// Of the ray whose first lane it is.
    widening: [f64; LANES],
}

impl<F: Fn(&[DVec3; K], f64) -> f64, const K: usize> Photons for Finished<'_, F, K> {
    fn begins(&mut self, lane: usize, entrance: &Plane) {
        self.together.begin(lane);
        self.widening[lane] = self.rules.widening(entrance.normal);
    }

    fn is_done(&self, lane: usize) -> bool {
        !self.together.still(lane)
    }

    fn meet(&mut self, m: &Meeting) {
        for lane in Together::<K>::lanes() {
            if self.together.leave(m, lane) {
                let directions = std::array::from_fn(|k| m.direction(lane + k).as_dvec3());
                let width = self.widening[lane] * f64::from(m.cos_outside[lane] / m.cos_inside[lane]);
                self.sum += self.rules.seen(m.facet[lane] as usize, &directions, m.power[lane].into(), width);
            }
        }
    }
}
