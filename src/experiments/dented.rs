//! Dented: the dome and the view of a stone that is not convex, walked in `f64` over its mesh.
//!
//! The definitions are those of [`super::hemisphere`] and [`super::view`], and so are the tallies. The
//! crown is every facet that faces up, the outline all that lines of sight meet. Light of the dome that
//! another part of the stone shades does not arrive there; what is mirrored and has never been inside
//! counts as reflected at entry, after however many facets. In a dent chance picks which part of a ray
//! goes on: sums of power have no bias, but a single ray has no strongest path and no luminance of its
//! own, so the tallies of strongest paths and of dark rays stay empty. Checked in `tests/dented.rs`.

use super::batches::Experiment;
use super::entrance::{self, Crown};
use super::horizon::is_up;
use super::view::{Surroundings, band};
use super::{Aspect, ExperimentError, Medium, Optics, hemisphere, view};
use crate::math::points::Points;
use crate::math::random::{Purpose, Stream};
use crate::math::sample;
use crate::optics::dispersion::lines;
use crate::optics::stokes::Stokes;
use crate::walk::mesh::{MeshStone, Side};
use crate::walk::scalar::{Meeting, Ray};
use glam::DVec3;
use std::ops::Range;

/// A ray with less than this share of its light is given up; see the hemisphere's.
const STOP_POWER: f64 = 1e-4;

/// Rays start so far from the stone's middle, or from where they meet it: outside its sphere.
const FAR: f64 = 2.5;

/// A stone that is not convex, and how it is lit.
#[derive(Clone)]
struct Lit<'a> {
    stone: &'a MeshStone,
    aspect: Aspect,
    polarised: bool,
    optics: Optics,
}

impl Lit<'_> {
    /// Follows a ray of unpolarised light of power 1 from outside. `visit` also learns whether the
    /// light has been inside.
    fn follow(
        &self,
        point: DVec3,
        direction: DVec3,
        mut stream: Stream,
        mut visit: impl FnMut(&Meeting, bool),
    ) -> f64 {
        let axis = direction.any_orthonormal_vector();
        let ray = Ray {
            point,
            direction,
            power: 1.0,
            index: self.optics.index.into(),
            absorption: self.optics.absorption.into(),
            stokes: self.polarised.then(|| Stokes::unpolarised(1.0, axis)),
        };
        let mut entered = false;
        self.stone.walk(ray, Side::Outside, STOP_POWER, &mut stream, |meeting, side| {
            entered |= side == Side::Inside;
            visit(meeting, entered);
        })
    }
}

/// The numbers that chance takes for a point of a batch.
fn chance(seed: u64, batch: u64, point: u64) -> Stream {
    Stream::new(seed, Purpose::Dents, (batch << 48) | point)
}

/// The dome over a stone that is not convex: [`hemisphere::Hemisphere`].
#[derive(Clone)]
pub struct Dome<'a> {
    lit: Lit<'a>,
    entrance: Crown,
    crown: Vec<bool>,
}

impl<'a> Dome<'a> {
    /// Lights a stone at the material's D line.
    pub fn new(stone: &'a MeshStone, medium: &Medium, aspect: Aspect) -> Result<Self, ExperimentError> {
        let optics = medium.optics(stone.unit, lines::D)?;
        let crown = stone.planes.iter().map(|p| entrance::is_crown(p.normal)).collect();
        let lit = Lit { stone, aspect, polarised: medium.polarised, optics };
        Ok(Self { lit, entrance: Crown::of_mesh(stone)?, crown })
    }
}

impl Experiment for Dome<'_> {
    type Tally = hemisphere::Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Self::Tally) {
        let Lit { stone, aspect, .. } = &self.lit;
        let numbers = points.clone();
        for (number, [a, b, c, d]) in numbers.zip(Points::new(seed, Purpose::Hemisphere, batch, points)) {
            tally.drawn += 1.0;
            let (facet, point) = self.entrance.sample([a, b]);
            let normal = stone.planes[facet].normal.as_vec3();
            let sky = sample::about(normal, sample::cosine_hemisphere([c as f32, d as f32]));
            let sky = sky.as_dvec3().normalize();
            let from = point + FAR * sky;
            let in_sight = || stone.next_facet(from, -sky, Side::Outside).is_some_and(|(f, _)| f == facet);
            if !is_up(sky.dot(aspect.axis) as f32) || !in_sight() {
                continue;
            }
            tally.arrived += 1.0;
            tally.lost += self.lit.follow(from, -sky, chance(seed, batch, number), |m, entered| {
                let up = m.direction.dot(aspect.axis);
                tally.absorbed += m.absorbed;
                if !entered {
                    tally.glare += m.power;
                } else if is_up(up as f32) && self.crown[m.facet] {
                    tally.returned += m.power;
                    tally.returned_cos2 += m.power * up * up;
                } else {
                    tally.leaked += m.power;
                }
            });
        }
    }
}

/// The view of a stone that is not convex: [`view::View`].
#[derive(Clone)]
pub struct Gaze<'a> {
    lit: Lit<'a>,
    surroundings: Surroundings,
}

impl<'a> Gaze<'a> {
    /// Looks at a stone at the material's D line.
    pub fn new(
        stone: &'a MeshStone,
        medium: &Medium,
        aspect: Aspect,
        surroundings: Surroundings,
    ) -> Result<Self, ExperimentError> {
        let optics = medium.optics(stone.unit, lines::D)?;
        Ok(Self { lit: Lit { stone, aspect, polarised: medium.polarised, optics }, surroundings })
    }
}

impl Experiment for Gaze<'_> {
    type Tally = view::Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Self::Tally) {
        let Aspect { axis, right, top } = self.lit.aspect;
        let Surroundings { scope, dome } = self.surroundings;
        let numbers = points.clone();
        for (number, [a, b]) in numbers.zip(Points::new(seed, Purpose::View, batch, points)) {
            // the stone lies within the unit sphere
            let from = axis * FAR + right * (2.0 * a - 1.0) + top * (2.0 * b - 1.0);
            if self.lit.stone.next_facet(from, -axis, Side::Outside).is_none() {
                continue;
            }
            tally.rays += 1.0;
            tally.lost += self.lit.follow(from, -axis, chance(seed, batch, number), |m, entered| {
                let z = m.direction.dot(axis);
                let bright = |sky: view::Sky| if sky.is_bright(z as f32) { m.power } else { 0.0 };
                tally.absorbed += m.absorbed;
                tally.luminance += bright(dome);
                if entered {
                    tally.bands[band(z as f32) as usize] += m.power;
                    tally.up_cos2 += m.power * z.max(0.0).powi(2);
                    tally.scope_bright += bright(scope);
                } else {
                    tally.reflected += m.power;
                }
            });
        }
    }
}
