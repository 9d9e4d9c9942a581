//! Estimators of stones that are not convex: hemisphere and view, traced in `f64` over the mesh.
//!
//! The definitions are those of [`super::hemisphere`] and [`super::view`], and so are the tallies. The
//! crown is every facet that faces up, the outline all that lines of sight meet. Light of the dome that
//! another part of the stone shades does not arrive there; what is mirrored and has never been inside
//! counts as reflected at entry, after however many facets. In a concavity a random choice decides which
//! part of a ray goes on: sums of power have no bias, but a single ray has no strongest path and no
//! luminance of its own, so the tallies of strongest paths and of dark rays stay empty. Checked in
//! `tests/library/trace/nonconvex_scores.rs`.

use super::batches::Estimator;
use super::entry_sampling::{self, Crown};
use super::horizon::is_up;
use super::kind::{Method, Setup};
use super::viewer_lighting::{ObserverDome, ViewerLighting, band};
use super::wavelengths::{HUE_STREAM, Wavelengths};
use super::{EstimatorError, STOP_POWER, TraceOptics, ViewFrame, hemisphere, view, view_metrics};
use crate::optics::stokes::Stokes;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::{Purpose, Stream};
use crate::sampling::tally::Tally;
use crate::sampling::warps;
use crate::trace::nonconvex::{MeshStone, Side};
use crate::trace::reference::{ScalarInteraction, ScalarRay};
use glam::{DVec2, DVec3};
use std::ops::Range;

/// Which way light goes on in a concavity, one stream a ray.
const STREAM: Purpose = Purpose::named("nonconvex");

/// A ray of a stone that absorbs is given up below this share of its light: of a dark stone little
/// comes out. It is soon reached there.
const MIN_POWER: f64 = 1e-9;

/// Rays start so far from the stone's middle, or from where they meet it: outside its sphere.
const FAR_AWAY: f64 = 2.5;

/// So many points of the hemisphere are as dear as a ray of a stone that is not convex.
const COST: u64 = 16;

/// The method by which the hemisphere's metrics are found of a stone that is not convex.
pub(super) fn hemisphere_methods<'a>(stone: &'a MeshStone, setup: Setup<'a>) -> Vec<Method<'a>> {
    let Setup { medium, view_frame, stop_power, .. } = setup;
    vec![Method::samples("hemisphere", COST, move || {
        Ok(NonconvexHemisphere::new(stone, &medium, view_frame)?.with_stop_power(stop_power))
    })]
}

/// The same of the view's metrics.
pub(super) fn view_methods<'a>(stone: &'a MeshStone, setup: Setup<'a>) -> Vec<Method<'a>> {
    vec![Method::samples("view", COST, move || NonconvexView::in_setup(stone, &setup))]
}

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
    Stream::new(seed, STREAM, (batch << 48) | point)
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
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let NonconvexTracer { stone, view_frame, .. } = &self.lit;
        let hues = KroneckerPoints::<1>::new(seed, HUE_STREAM, batch, points.clone());
        let numbers = points.clone().zip(hues);
        let places = KroneckerPoints::new(seed, hemisphere::STREAM, batch, points);
        for ((number, [hue]), [a, b, c, d]) in numbers.zip(places) {
            tally[hemisphere::DRAWN] += 1.0;
            let (facet, point) = self.entrance.sample([a, b]);
            let normal = stone.planes[facet].normal.as_vec3();
            let sky = warps::to_world(normal, warps::cosine_hemisphere([c as f32, d as f32]));
            let sky = sky.as_dvec3().normalize();
            let from = point + FAR_AWAY * sky;
            let in_sight = || stone.next_facet(from, -sky, Side::Outside).is_some_and(|(f, _)| f == facet);
            if !is_up(sky.dot(view_frame.axis) as f32) || !in_sight() {
                continue;
            }
            tally[hemisphere::ARRIVED] += 1.0;
            tally[hemisphere::LOST] +=
                self.lit.trace(from, -sky, hue, chance(seed, batch, number), |m, entered| {
                    let up = m.direction.dot(view_frame.axis);
                    tally[hemisphere::ABSORBED] += m.absorbed;
                    if !entered {
                        tally[hemisphere::GLARE] += m.power;
                    } else if is_up(up as f32) && self.crown[m.facet] {
                        tally[hemisphere::RETURNED] += m.power;
                        tally[hemisphere::RETURNED_COS2] += m.power * up * up;
                    } else {
                        tally[hemisphere::LEAKED] += m.power;
                    }
                });
        }
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        hemisphere::bounds_of_untraced(sums)
    }
}

/// The view of a stone that is not convex: [`view::View`].
#[derive(Clone)]
pub struct NonconvexView<'a> {
    pub(super) lit: NonconvexTracer<'a>,
    surroundings: ViewerLighting,
}

impl<'a> NonconvexView<'a> {
    /// Looks at a stone as the view's metrics do.
    pub fn in_setup(stone: &'a MeshStone, setup: &Setup) -> Result<Self, EstimatorError> {
        let lighting = view_metrics::lighting(setup);
        let view = Self::new(stone, &setup.medium, setup.view_frame, lighting)?;
        Ok(view.with_stop_power(setup.stop_power))
    }

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
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let hues = KroneckerPoints::<1>::new(seed, HUE_STREAM, batch, points.clone());
        let numbers = points.clone().zip(hues);
        for ((number, [hue]), [a, b]) in numbers.zip(KroneckerPoints::new(seed, view::STREAM, batch, points))
        {
            // the stone lies within the unit sphere
            let place = DVec2::new(2.0 * a - 1.0, 2.0 * b - 1.0);
            self.trace_sight(place, hue, chance(seed, batch, number), tally);
        }
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        view::bounds_of_untraced(sums)
    }
}

impl NonconvexView<'_> {
    /// Traces the line of sight through a place of the picture, if it meets the stone, and adds up what is
    /// seen along it.
    pub(super) fn trace_sight(&self, place: DVec2, hue: f64, stream: Stream, tally: &mut Tally) {
        let ViewFrame { axis, right, top } = self.lit.view_frame;
        let ViewerLighting { scope, dome } = self.surroundings;
        let from = axis * FAR_AWAY + right * place.x + top * place.y;
        if self.lit.stone.next_facet(from, -axis, Side::Outside).is_none() {
            return;
        }
        tally[view::RAYS] += 1.0;
        tally[view::LOST] += self.lit.trace(from, -axis, hue, stream, |m, entered| {
            let z = m.direction.dot(axis);
            let bright = |sky: ObserverDome| if sky.is_bright(z as f32) { m.power } else { 0.0 };
            tally[view::ABSORBED] += m.absorbed;
            tally[view::LUMINANCE] += bright(dome);
            if entered {
                tally[view::BANDS[band(z as f32) as usize]] += m.power;
                tally[view::UP_COS2] += m.power * z.max(0.0).powi(2);
                tally[view::SCOPE_BRIGHT] += bright(scope);
                tally[view::SCOPE_DARK] += if scope.is_hidden(z as f32) { m.power } else { 0.0 };
            } else {
                tally[view::REFLECTED] += m.power;
            }
        });
    }
}
