//! Leakage by facet: through which facets light from below reaches the eye, or lost light leaves.

use super::entry_sampling::Silhouette;
use super::horizon::is_up;
use super::view::STREAM;
use super::wavelengths::{LINES_PER_RAY, LightPoints, Wavelengths};
use super::{BATCHES, EstimatorError, STOP_POWER, TraceOptics, ViewFrame};
use crate::parallel;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::stats::{self, Estimate};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Packet};
use glam::DVec3;

/// Leakage of a view, facet by facet.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetLeakage {
    /// For each facet, the share of the sight lines' power that leaves through it to below the horizon: seen
    /// the other way, what comes from below through it. Together they are the metric `aset_leak`.
    pub by_facet: Vec<Estimate>,
    /// One a batch, the powers by facet and the number of rays.
    batches: Vec<(Vec<f64>, f64)>,
}

impl FacetLeakage {
    /// The leakage through several facets together, by their numbers.
    pub fn through(&self, facets: impl Iterator<Item = usize> + Clone) -> Estimate {
        let of = |powers: &[f64]| facets.clone().filter_map(|f| powers.get(f)).sum::<f64>();
        stats::ratio(self.batches.iter().map(|(powers, rays)| (of(powers), *rays)))
    }
}

/// The leakage of a parallel view over the whole outline, by the rays of [`super::View`]: light at the D line,
/// or daylight for a stone that absorbs.
///
/// - `samples`: sight lines, all batches together
///
/// Checked in `tests/library/objective.rs` against the metric `aset_leak`.
pub fn facet_leakage(
    stone: &ConvexStone,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    seed: u64,
    samples: u64,
) -> Result<FacetLeakage, EstimatorError> {
    let light = Wavelengths::new(medium, stone.unit)?;
    let outline = Silhouette::new(stone, view_frame)?;
    let view = LeakingView { stone, polarised: medium.polarised, light, outline, view_frame };
    let points = samples.div_ceil(BATCHES as u64);
    let batches: Vec<(Vec<f64>, f64)> = parallel::map(BATCHES, |batch| {
        let powers = match view.light.absorb() {
            true => view.trace::<LINES_PER_RAY>(seed, batch as u64, points),
            false => view.trace::<1>(seed, batch as u64, points),
        };
        (powers, points as f64)
    });
    let leakage = FacetLeakage { by_facet: Vec::new(), batches };
    let by_facet = (0..stone.facet_count()).map(|f| leakage.through(std::iter::once(f))).collect();
    Ok(FacetLeakage { by_facet, ..leakage })
}

/// A stone and how it is looked at.
struct LeakingView<'a> {
    stone: &'a ConvexStone,
    polarised: bool,
    light: Wavelengths,
    outline: Silhouette,
    view_frame: ViewFrame,
}

impl LeakingView<'_> {
    /// Powers by facet of a batch, in `K` wavelengths for each sight line.
    fn trace<const K: usize>(&self, seed: u64, batch: u64, points: u64) -> Vec<f64> {
        let mut client = LeakageClient::<K> {
            view: self,
            places: KroneckerPoints::new(seed, STREAM, batch, 0..points),
            lights: LightPoints::new(seed, batch, 0..points),
            powers: vec![0.0; self.stone.facet_count()],
        };
        lane_scheduler::trace_all(self.stone, STOP_POWER, &mut client);
        client.powers.iter().map(|power| power / K as f64).collect()
    }
}

/// Rays of sight lines, whose exits below the horizon are counted by facet.
struct LeakageClient<'a, const K: usize> {
    view: &'a LeakingView<'a>,
    places: KroneckerPoints<2>,
    lights: LightPoints,
    powers: Vec<f64>,
}

impl<const K: usize> RayClient for LeakageClient<'_, K> {
    const WIDTH: usize = K;

    fn polarised(&self) -> bool {
        self.view.polarised
    }

    fn optic_axis(&self) -> Option<DVec3> {
        self.view.light.optic_axis()
    }

    fn absorbing(&self) -> bool {
        self.view.light.absorb()
    }

    fn stops_by_emitted_power(&self) -> bool {
        self.absorbing()
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let (Some(place), Some([hue, choice])) = (self.places.next(), self.lights.next()) else {
            return false;
        };
        let LeakingView { stone, light, outline, view_frame, .. } = self.view;
        let (facet, point) = outline.sample(place);
        let toward = -view_frame.axis.as_vec3();
        for (lane, optics) in (lane..).zip(light.spread::<K>(hue)) {
            optics.enter(packet, lane, stone, (facet, point), toward, choice);
        }
        true
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        for lane in 0..LANES {
            let power = m.power[lane];
            if power > 0.0 && !is_up(self.view.view_frame.sin_elevation(m.direction(lane))) {
                self.powers[m.facet[lane] as usize] += f64::from(power);
            }
        }
    }
}
