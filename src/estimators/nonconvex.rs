//! Estimators of stones that are not convex: hemisphere and view, traced in `f64` over the mesh.
//!
//! The definitions are those of [`super::hemisphere`] and [`super::view`], and so are the tallies. The
//! crown is every facet that faces up, the outline all that lines of sight meet. Light of the dome that
//! another part of the stone shades does not arrive there; what is mirrored and has never been inside
//! counts as reflected at entry, after however many facets. In a concavity a random choice decides which
//! part of a ray goes on: sums of power have no bias, but a single ray has no strongest path and no
//! luminance of its own, so the tallies of strongest paths and of dark rays stay empty. Checked in
//! `tests/trace/nonconvex_scores.rs`.

use super::batches::Estimator;
use super::entry_sampling::{self, Crown};
use super::horizon::is_up;
use super::view::{ViewerLighting, band};
use super::wavelengths::Wavelengths;
use super::{EstimatorError, STOP_POWER, TraceOptics, ViewFrame, hemisphere, view};
use crate::optics::stokes::Stokes;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::{Purpose, Stream};
use crate::sampling::warps;
use crate::trace::nonconvex::{MeshStone, Side};
use crate::trace::reference::{ScalarInteraction, ScalarRay};
use glam::{DVec2, DVec3};
use std::ops::Range;

/// A ray of a stone that absorbs is given up below this share of its light: of a dark stone little
/// comes out. It is soon reached there.
const MIN_POWER: f64 = 1e-9;

/// Rays start so far from the stone's middle, or from where they meet it: outside its sphere.
const FAR_AWAY: f64 = 2.5;

/// A stone that is not convex, and how it is lit.
#[derive(Clone)]
pub(super) struct NonconvexTracer<'a> {
    pub(super) stone: &'a MeshStone,
    pub(super) view_frame: ViewFrame,
    polarised: bool,
    pub(super) light: Wavelengths,
    stop_power: f64,
}

impl<'a> NonconvexTracer<'a> {
    fn new(
        stone: &'a MeshStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
    ) -> Result<Self, EstimatorError> {
        let light = Wavelengths::new(medium, stone.unit)?;
        let stop_power = if light.absorb() { MIN_POWER } else { STOP_POWER.into() };
        Ok(NonconvexTracer { stone, view_frame, polarised: medium.polarised, light, stop_power })
    }

    /// Gives rays up below `power`, or before.
    fn set_stop_power(&mut self, power: f32) {
        self.stop_power = self.stop_power.min(power.into());
    }

    /// Follows a ray of unpolarised light of power 1 from outside, at the wavelength numbered by
    /// `hue` ([`Wavelengths::line`]). `visit` also learns whether the
    /// light has been inside.
    fn trace(
        &self,
        point: DVec3,
        direction: DVec3,
        hue: f64,
        mut stream: Stream,
        mut visit: impl FnMut(&ScalarInteraction, bool),
    ) -> f64 {
        let axis = direction.any_orthonormal_vector();
        let optics = self.light.line(hue);
        let ray = ScalarRay {
            point,
            direction,
            power: 1.0,
            index: optics.index.into(),
            absorption: optics.absorption.into(),
            stokes: self.polarised.then(|| Stokes::unpolarised(1.0, axis)),
        };
        let mut entered = false;
        self.stone.trace(ray, Side::Outside, self.stop_power, &mut stream, |interaction, side| {
            entered |= side == Side::Inside;
            visit(interaction, entered);
        })
    }
}

/// Random numbers for a point of a batch.
pub(super) fn chance(seed: u64, batch: u64, point: u64) -> Stream {
    Stream::new(seed, Purpose::Nonconvex, (batch << 48) | point)
}

/// The dome over a stone that is not convex: [`hemisphere::Hemisphere`].
#[derive(Clone)]
pub struct NonconvexHemisphere<'a> {
    lit: NonconvexTracer<'a>,
    entrance: Crown,
    crown: Vec<bool>,
}

impl<'a> NonconvexHemisphere<'a> {
    /// Lights a stone.
    pub fn new(
        stone: &'a MeshStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
    ) -> Result<Self, EstimatorError> {
        let crown = stone.planes.iter().map(|p| entry_sampling::is_crown(p.normal)).collect();
        Ok(Self {
            lit: NonconvexTracer::new(stone, medium, view_frame)?,
            entrance: Crown::from_mesh(stone)?,
            crown,
        })
    }

    /// Gives rays up below `power` instead of [`STOP_POWER`].
    pub fn with_stop_power(mut self, power: f32) -> Self {
        self.lit.set_stop_power(power);
        self
    }
}

impl Estimator for NonconvexHemisphere<'_> {
    type Tally = hemisphere::HemisphereTally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Self::Tally) {
        let NonconvexTracer { stone, view_frame, .. } = &self.lit;
        let hues = KroneckerPoints::<1>::new(seed, Purpose::ScoreHue, batch, points.clone());
        let numbers = points.clone().zip(hues);
        let places = KroneckerPoints::new(seed, Purpose::Hemisphere, batch, points);
        for ((number, [hue]), [a, b, c, d]) in numbers.zip(places) {
            tally.drawn += 1.0;
            let (facet, point) = self.entrance.sample([a, b]);
            let normal = stone.planes[facet].normal.as_vec3();
            let sky = warps::to_world(normal, warps::cosine_hemisphere([c as f32, d as f32]));
            let sky = sky.as_dvec3().normalize();
            let from = point + FAR_AWAY * sky;
            let in_sight = || stone.next_facet(from, -sky, Side::Outside).is_some_and(|(f, _)| f == facet);
            if !is_up(sky.dot(view_frame.axis) as f32) || !in_sight() {
                continue;
            }
            tally.arrived += 1.0;
            tally.lost += self.lit.trace(from, -sky, hue, chance(seed, batch, number), |m, entered| {
                let up = m.direction.dot(view_frame.axis);
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
pub struct NonconvexView<'a> {
    pub(super) lit: NonconvexTracer<'a>,
    surroundings: ViewerLighting,
}

impl<'a> NonconvexView<'a> {
    /// Looks at a stone.
    pub fn new(
        stone: &'a MeshStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
        surroundings: ViewerLighting,
    ) -> Result<Self, EstimatorError> {
        Ok(Self { lit: NonconvexTracer::new(stone, medium, view_frame)?, surroundings })
    }

    /// Gives rays up below `power` instead of [`STOP_POWER`].
    pub fn with_stop_power(mut self, power: f32) -> Self {
        self.lit.set_stop_power(power);
        self
    }
}

impl Estimator for NonconvexView<'_> {
    type Tally = view::ViewTally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Self::Tally) {
        let hues = KroneckerPoints::<1>::new(seed, Purpose::ScoreHue, batch, points.clone());
        let numbers = points.clone().zip(hues);
        for ((number, [hue]), [a, b]) in numbers.zip(KroneckerPoints::new(seed, Purpose::View, batch, points))
        {
            // the stone lies within the unit sphere
            let place = DVec2::new(2.0 * a - 1.0, 2.0 * b - 1.0);
            self.trace_sight(place, hue, chance(seed, batch, number), tally);
        }
    }
}

impl NonconvexView<'_> {
    /// Traces the line of sight through a place of the picture, if it meets the stone, and adds up what is
    /// seen along it.
    pub(super) fn trace_sight(&self, place: DVec2, hue: f64, stream: Stream, tally: &mut view::ViewTally) {
        let ViewFrame { axis, right, top } = self.lit.view_frame;
        let ViewerLighting { scope, dome } = self.surroundings;
        let from = axis * FAR_AWAY + right * place.x + top * place.y;
        if self.lit.stone.next_facet(from, -axis, Side::Outside).is_none() {
            return;
        }
        tally.rays += 1.0;
        tally.lost += self.lit.trace(from, -axis, hue, stream, |m, entered| {
            let z = m.direction.dot(axis);
            let bright = |sky: view::ObserverDome| if sky.is_bright(z as f32) { m.power } else { 0.0 };
            tally.absorbed += m.absorbed;
            tally.luminance += bright(dome);
            if entered {
                tally.bands[band(z as f32) as usize] += m.power;
                tally.up_cos2 += m.power * z.max(0.0).powi(2);
                tally.scope_bright += bright(scope);
                tally.scope_dark += if scope.is_hidden(z as f32) { m.power } else { 0.0 };
            } else {
                tally.reflected += m.power;
            }
        });
    }
}
