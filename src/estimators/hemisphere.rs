//! Hemisphere: a uniform dome of light above the girdle plane, and everything that comes out.

use super::batches::Estimator;
use super::entry_sampling::{self, Crown, Silhouette};
use super::horizon::is_up;
use super::kind::{Better, EstimatorKind, LIGHT, Method, Metric, MetricSource, Setup};
use super::wavelengths::{LightPoints, Wavelengths};
use super::{EstimatorError, STOP_POWER, TraceOptics, ViewFrame};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally, columns};
use crate::sampling::warps;
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet};
use glam::DVec3;
use std::ops::Range;

/// Points of the dome, one stream a batch.
pub(super) const STREAM: Purpose = Purpose::named("hemisphere");

/// The dome over one stone.
///
/// Points of the crown uniform by area, directions cosine-distributed about the facet's normal;
/// directions from below the horizon are drawn but not lit. The dome stays with the viewer when the
/// stone is tilted. D line, or daylight for a stone that absorbs; unpolarised outside.
#[derive(Debug, Clone)]
pub struct Hemisphere<'a> {
    stone: &'a ConvexStone,
    view_frame: ViewFrame,
    polarised: bool,
    light: Wavelengths,
    stop_power: f32,
    entrance: Crown,
    crown: Vec<f32>,
    /// Area of the crown, trace units squared.
    pub crown_area: f64,
    /// Area within the outline that the viewer sees, trace units squared.
    pub outline_area: f64,
}

// Sums of a batch; every accepted direction arrives with power 1.
columns! {
    /// Directions drawn, those from below the horizon included.
    DRAWN,
    /// Power that arrived: directions from above the horizon.
    ARRIVED,
    /// Reflected at entry.
    GLARE,
    /// Left through the crown, upward.
    RETURNED,
    /// The same, weighted by cos² from zenith.
    RETURNED_COS2,
    /// Left otherwise.
    LEAKED,
    /// Taken by the stone.
    ABSORBED,
    /// Given up inside.
    LOST,
}

/// All that was given up returned, leaked or absorbed.
pub(super) fn bounds_of_untraced(sums: &Tally) -> Vec<Tally> {
    let all = |columns: &[Column]| sums.with(columns, sums[LOST]);
    // a clear stone takes none of it
    let absorbed = (sums[ABSORBED] > 0.0).then(|| all(&[ABSORBED]));
    [all(&[RETURNED, RETURNED_COS2]), all(&[LEAKED])].into_iter().chain(absorbed).collect()
}

impl<'a> Hemisphere<'a> {
    /// Lights a face-up stone.
    pub fn new(stone: &'a ConvexStone, medium: &TraceOptics) -> Result<Self, EstimatorError> {
        Self::in_frame(stone, medium, ViewFrame::FACE_UP)
    }

    /// Lights a stone.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
    ) -> Result<Self, EstimatorError> {
        let entrance = Crown::new(stone)?;
        Ok(Self {
            stone,
            view_frame,
            polarised: medium.polarised,
            light: Wavelengths::new(medium, stone.unit)?,
            stop_power: STOP_POWER,
            crown_area: entrance.area(),
            outline_area: Silhouette::new(stone, view_frame)?.area(),
            entrance,
            crown: entry_sampling::crown_flags(stone),
        })
    }

    /// Gives rays up below `power` instead of [`STOP_POWER`].
    pub fn with_stop_power(self, power: f32) -> Self {
        Self { stop_power: power, ..self }
    }
}

/// The rays of a run of points.
struct HemisphereClient<'a> {
    estimator: &'a Hemisphere<'a>,
    points: KroneckerPoints<4>,
    lights: LightPoints,
    tally: &'a mut Tally,
    returned: Lanes,
    returned_cos2: Lanes,
    leaked: Lanes,
    absorbed: Lanes,
}

impl RayClient for HemisphereClient<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.estimator.polarised
    }

    fn optic_axis(&self) -> Option<DVec3> {
        self.estimator.light.optic_axis()
    }

    fn absorbing(&self) -> bool {
        self.estimator.light.absorb()
    }

    fn stops_by_emitted_power(&self) -> bool {
        self.absorbing()
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Hemisphere { stone, view_frame, light, entrance, .. } = self.estimator;
        for ([a, b, c, d], [hue, choice]) in self.points.by_ref().zip(&mut self.lights) {
            self.tally[DRAWN] += 1.0;
            let (facet, point) = entrance.sample([a, b]);
            let sky = warps::to_world(stone.normals[facet], warps::cosine_hemisphere([c as f32, d as f32]));
            if is_up(view_frame.sin_elevation(sky)) {
                let entry =
                    light.line(hue).enter(packet, lane, stone, (facet, point.as_vec3()), -sky, choice);
                self.tally[ARRIVED] += 1.0;
                self.tally[GLARE] += f64::from(entry.reflectance);
                return true;
            }
        }
        false
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let axis = self.estimator.view_frame.axis.as_vec3();
        for l in 0..LANES {
            let up = (m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z).max(0.0);
            let through_crown = m.power[l] * self.estimator.crown[m.facet[l] as usize];
            let returned = if is_up(up) { through_crown } else { 0.0 };
            self.returned[l] += returned;
            self.returned_cos2[l] += returned * up * up;
            self.leaked[l] += m.power[l] - returned;
            self.absorbed[l] += m.absorbed[l];
        }
    }

    fn finish(&mut self, lane: usize) {
        let take = |sum: &mut Lanes| f64::from(std::mem::take(&mut sum[lane]));
        self.tally[RETURNED] += take(&mut self.returned);
        self.tally[RETURNED_COS2] += take(&mut self.returned_cos2);
        self.tally[LEAKED] += take(&mut self.leaked);
        self.tally[ABSORBED] += take(&mut self.absorbed);
    }
}

impl Estimator for Hemisphere<'_> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let zero = [0.0; LANES];
        let mut dome = HemisphereClient {
            estimator: self,
            lights: LightPoints::new(seed, batch, points.clone()),
            points: KroneckerPoints::new(seed, STREAM, batch, points),
            tally,
            returned: zero,
            returned_cos2: zero,
            leaked: zero,
            absorbed: zero,
        };
        let lost = lane_scheduler::trace_all(self.stone, self.stop_power, &mut dome);
        tally[LOST] += lost;
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        bounds_of_untraced(sums)
    }
}

/// The dome as scores have it.
#[derive(Debug, Clone, Copy)]
pub struct HemisphereKind;

impl EstimatorKind for HemisphereKind {
    fn name(&self) -> &'static str {
        "hemisphere"
    }

    fn metrics(&self) -> &'static [Metric] {
        &METRICS
    }

    fn columns(&self) -> &'static [Column] {
        &COLUMNS
    }

    fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
        let Setup { medium, view_frame, stop_power, .. } = setup;
        vec![Method::samples("hemisphere", 1, move || {
            Ok(Hemisphere::in_frame(stone, &medium, view_frame)?.with_stop_power(stop_power))
        })]
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        bounds_of_untraced(sums)
    }
}

const DOME: &str = "Uniform dome of light above the girdle plane, no observer's head;";
const SAMPLED: &str = "Directions are cosine-distributed about the crown facets' normals, points uniform by crown area; those \
    from below the horizon are not counted.";

/// What the rows have in common.
const ROW: Metric = Metric {
    by_beams: true,
    nonconvex: true,
    source: "defined by cutlab; light_return + glare + leakage + absorbed + lost = 1",
    ..Metric::of(&HemisphereKind, MetricSource::Sums(Statistic::Mean(RETURNED, ARRIVED, 1.0)))
};

/// The metrics.
static METRICS: [Metric; 6] = [
    Metric {
        name: "wlr",
        about: "weighted light return: white light from a dome, returned through the crown, most weight face-up",
        better: Better::More,
        definition: &[
            DOME,
            LIGHT,
            "Power that leaves upward through the crown, weighted by cos² of its angle from zenith, \
                surface reflection excluded, per power arriving.",
            SAMPLED,
        ],
        source: "T. S. Hemphill et al., Gems & Gemology 34 (1998) 158; recipe of the project's reference figures, \
            which `cutlab validate` checks",
        read_from: MetricSource::Sums(Statistic::Mean(RETURNED_COS2, ARRIVED, 1.0)),
        ..ROW
    },
    Metric {
        name: "light_return",
        about: "share of a dome's light that comes back up through the crown, from inside",
        better: Better::More,
        definition: &[
            DOME,
            LIGHT,
            "Power that leaves upward through the crown after entering, per power arriving.",
            SAMPLED,
        ],
        read_from: MetricSource::Sums(Statistic::Mean(RETURNED, ARRIVED, 1.0)),
        ..ROW
    },
    Metric {
        name: "leakage",
        about: "share that leaves otherwise: through the pavilion, or downward through the crown",
        better: Better::Less,
        definition: &[
            DOME,
            LIGHT,
            "Power that leaves otherwise than upward through the crown, per power arriving.",
            SAMPLED,
        ],
        read_from: MetricSource::Sums(Statistic::Mean(LEAKED, ARRIVED, 1.0)),
        ..ROW
    },
    Metric {
        name: "glare",
        about: "share mirrored by the crown's surface without entering",
        definition: &[DOME, LIGHT, "Power reflected at entry per power arriving.", SAMPLED],
        read_from: MetricSource::Sums(Statistic::Smooth(|t| t[GLARE] / t[ARRIVED])),
        ..ROW
    },
    Metric {
        name: "absorbed",
        about: "share that the stone's colour takes: 0 in a clear stone, more in a larger one",
        definition: &[
            DOME,
            LIGHT,
            "Power absorbed inside by Beer–Lambert over the path in millimetres, per power arriving.",
            SAMPLED,
        ],
        read_from: MetricSource::Sums(Statistic::Smooth(|t| t[ABSORBED] / t[ARRIVED])),
        ..ROW
    },
    Metric {
        name: "lost",
        about: "share no longer followed: the error of the figures above",
        definition: &[
            DOME,
            LIGHT,
            "Power that the tracer stopped following (a ray with less than 1e-4 of its light or half the \
                error asked for; in a stone that absorbs the share is of what has come out), per power \
                arriving. The errors of the other four hold it.",
            SAMPLED,
        ],
        read_from: MetricSource::Sums(Statistic::Smooth(|t| t[LOST] / t[ARRIVED])),
        ..ROW
    },
];
