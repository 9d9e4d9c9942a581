//! Faceters' view (ISO, COS, SC2): the face-up view by GemRay's rules, by which faceters compare designs.

use super::batches::Estimator;
use super::entry_sampling::{self, Silhouette};
use super::kind::{Better, EstimatorKind, Method, Metric, MetricSource, NOTHING_SEEN, Setup};
use super::viewer_lighting::ObserverDome;
use super::wavelengths::{LightPoints, Wavelengths};
use super::{EstimatorError, TraceOptics, ViewFrame};
use crate::design::Zone;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally, columns};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet};
use glam::DVec3;
use std::ops::Range;

/// Points of the outline, one stream a batch.
const STREAM: Purpose = Purpose::named("faceter view");

/// Bounces inside that a ray is followed for: ten segments, the incoming one and nine inside.
pub const MAX_BOUNCES: u32 = 9;

/// Half-angle of the shadow of the viewer's head, degrees.
pub const GEMRAY_OBSERVER_DEG: f64 = 10.0;

/// A facet faces the viewer if the cosine between its normal and his direction is above this.
const MIN_FACING_COS: f64 = 1e-4;

/// A lane with less than this share of its light is given up: negligible.
const STOP_POWER: f32 = 1e-7;

/// The parallel view of one stone, D line or daylight for a stone that absorbs, unpolarised at every facet; what counts leaves through
/// facets that face the viewer, into the sky outside his head's shadow.
#[derive(Debug, Clone)]
pub struct FaceterView<'a> {
    stone: &'a ConvexStone,
    light: Wavelengths,
    sky: ObserverDome,
    view_frame: ViewFrame,
    outline: Silhouette,
    facing: Vec<f32>,
    table: Vec<f32>,
}

/// For each facet 1 if it faces the viewer, else 0.
pub(super) fn facing_flags(stone: &ConvexStone, view_frame: ViewFrame) -> Vec<f32> {
    entry_sampling::flags(stone, |n| n.dot(view_frame.axis) > MIN_FACING_COS)
}

// Sums of a batch. Light from height h (sine of its elevation) has three weights: 1 (ISO), h (COS) and
// 2h√(1 − h²) (SC2).
columns! {
    /// Rays.
    RAYS,
    /// Power.
    ISO,
    /// Power × h.
    COS,
    /// Power × 2h√(1 − h²).
    SC2,
    /// Rays that meet the table.
    TABLE_RAYS,
    /// Power of these.
    TABLE_ISO,
    /// Their power × h.
    TABLE_COS,
    /// Their power × 2h√(1 − h²).
    TABLE_SC2,
    /// Half of the power that was not traced to its end. It is part of the powers above.
    UNTRACED,
    /// The same of rays that meet the table.
    TABLE_UNTRACED,
}

/// The columns of power over the whole outline, in the order of [`weights`].
pub(super) const ALL: [Column; 3] = [ISO, COS, SC2];

/// The same over the table alone.
pub(super) const TABLE: [Column; 3] = [TABLE_ISO, TABLE_COS, TABLE_SC2];

/// Adds half of the power that was not traced to its end to all that it may be part of.
///
/// - `untraced`: of all rays, and of those that meet the table
pub(super) fn add_half_of_untraced(tally: &mut Tally, untraced: [f64; 2]) {
    let parts = [(UNTRACED, ALL), (TABLE_UNTRACED, TABLE)];
    for ((half, columns), power) in parts.into_iter().zip(untraced) {
        tally[half] += 0.5 * power;
        columns.iter().for_each(|column| tally[*column] += 0.5 * power);
    }
}

/// What sums would be had all of the power that was not traced counted in full, or none of it.
fn bounds_of_untraced(sums: &Tally) -> Vec<Tally> {
    let moved = |sign: f64| {
        let bound = sums.with(&ALL, sign * sums[UNTRACED]);
        bound.with(&TABLE, sign * sums[TABLE_UNTRACED])
    };
    if sums[UNTRACED] > 0.0 { vec![moved(1.0), moved(-1.0)] } else { Vec::new() }
}

/// The weights of light from a height.
pub(super) fn weights(h: f32) -> [f32; 3] {
    [1.0, h, 2.0 * h * (1.0 - h * h).max(0.0).sqrt()]
}

impl<'a> FaceterView<'a> {
    /// Looks at a stone, without polarisation.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
        sky: ObserverDome,
    ) -> Result<Self, EstimatorError> {
        Ok(Self {
            stone,
            light: Wavelengths::new(medium, stone.unit)?,
            sky,
            view_frame,
            outline: Silhouette::new(stone, view_frame)?,
            facing: facing_flags(stone, view_frame),
            table: entry_sampling::table_flags(stone),
        })
    }
}

/// The rays of a run of points.
struct FaceterClient<'a> {
    estimator: &'a FaceterView<'a>,
    points: KroneckerPoints<2>,
    lights: LightPoints,
    tally: &'a mut Tally,
    power: [Lanes; 3],
    table: Lanes,
    bounces: [u32; LANES],
}

impl RayClient for FaceterClient<'_> {
    const WIDTH: usize = 1;

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
        let (Some(u), Some([hue, choice])) = (self.points.next(), self.lights.next()) else { return false };
        let FaceterView { stone, light, sky, view_frame, outline, facing, table } = self.estimator;
        let (facet, point) = outline.sample(u);
        let toward = -view_frame.axis.as_vec3();
        let entry = light.line(hue).enter(packet, lane, stone, (facet, point), toward, choice);
        let mirrored = sky.mirrored(&entry) * facing[facet];
        let height = ObserverDome::mirror_height(&entry);
        for (power, weight) in self.power.iter_mut().zip(weights(height)) {
            power[lane] = mirrored * weight;
        }
        self.table[lane] = table[facet];
        self.bounces[lane] = 0;
        true
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let axis = self.estimator.view_frame.axis.as_vec3();
        for l in 0..LANES {
            let height = m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z;
            let counts = self.estimator.sky.is_bright(height);
            let power = if counts { m.power[l] * self.estimator.facing[m.facet[l] as usize] } else { 0.0 };
            let [_, cos, sc2] = weights(height);
            self.power[0][l] += power;
            self.power[1][l] += power * cos;
            self.power[2][l] += power * sc2;
            self.bounces[l] += 1;
        }
    }

    fn is_done(&self, lane: usize) -> bool {
        self.bounces[lane] >= MAX_BOUNCES
    }

    fn finish(&mut self, lane: usize) {
        let table = f64::from(self.table[lane]);
        self.tally[RAYS] += 1.0;
        self.tally[TABLE_RAYS] += table;
        for (i, power) in self.power.iter_mut().enumerate() {
            let power = f64::from(std::mem::take(&mut power[lane]));
            self.tally[ALL[i]] += power;
            self.tally[TABLE[i]] += table * power;
        }
    }
}

impl Estimator for FaceterView<'_> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let mut client = FaceterClient {
            estimator: self,
            lights: LightPoints::new(seed, batch, points.clone()),
            points: KroneckerPoints::new(seed, STREAM, batch, points),
            tally,
            power: [[0.0; LANES]; 3],
            table: [0.0; LANES],
            bounces: [0; LANES],
        };
        lane_scheduler::trace_all(self.stone, STOP_POWER, &mut client);
    }
}

/// The faceters' view as scores have it.
#[derive(Debug, Clone, Copy)]
pub struct FaceterViewKind;

impl EstimatorKind for FaceterViewKind {
    fn name(&self) -> &'static str {
        "iso"
    }

    fn metrics(&self) -> &'static [Metric] {
        &METRICS
    }

    fn columns(&self) -> &'static [Column] {
        &COLUMNS
    }

    fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
        let dome = setup.dome(GEMRAY_OBSERVER_DEG);
        vec![Method::samples("iso", 1, move || {
            FaceterView::in_frame(stone, &setup.medium, setup.view_frame, dome)
        })]
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        bounds_of_untraced(sums)
    }

    fn why_unseen(&self, stone: &ConvexStone) -> &'static str {
        let table = stone.planes.iter().any(|p| Zone::from_normal(p.normal) == Zone::Table);
        if table { NOTHING_SEEN } else { NO_TABLE }
    }
}

/// Why scores of the table are left out.
const NO_TABLE: &str = "the stone has no table";

const OVER: &str = "Parallel view from the eye over";
const RULES: &str = "light that is unpolarised at every facet (scalar Fresnel, whatever --polarisation), D line (for a stone \
    that absorbs, luminance under D65). Rays of at most ten segments, the incoming one and nine inside. \
    Power from directions whose sine h of elevation lies above 0 and outside the shadow of the viewer's head \
    (10° half-angle, or --observer; 0 for none), weighted by";
const MEAN: &str =
    "exits and reflections at entry count at facets that face the viewer (cosine above 1e-4). Mean over";
const PERCENT: &str = "in percent. The light stays with the viewer when the stone is tilted.";
const OUTLINE: &str = "the whole outline;";
const OF_OUTLINE: &str = "the whole outline,";
const ONLY_TABLE: &str = "the table alone;";
const OF_TABLE: &str = "the table alone,";

/// What the rows have in common.
const ROW: Metric = Metric {
    by_beams: true,
    unit: "%",
    range: (0.0, 100.0),
    scale: 100.0,
    better: Better::More,
    observer: Some(GEMRAY_OBSERVER_DEG),
    source: "R. W. Strickland's GemRay, as the project's reference figures have it",
    ..Metric::of(&FaceterViewKind, MetricSource::Sums(Statistic::Mean(ISO, RAYS, 100.0)))
};

/// The metrics.
static METRICS: [Metric; 6] = [
    Metric {
        name: "iso",
        about: "percent of bright light that the stone returns face-up, all light alike (GemRay ISO)",
        definition: &[OVER, OUTLINE, RULES, "1;", MEAN, OF_OUTLINE, PERCENT],
        read_from: MetricSource::Sums(Statistic::Mean(ISO, RAYS, 100.0)),
        ..ROW
    },
    Metric {
        name: "cos",
        about: "percent of bright light that the stone returns face-up, most weight for light from above (GemRay \
            COS)",
        definition: &[OVER, OUTLINE, RULES, "h;", MEAN, OF_OUTLINE, PERCENT],
        read_from: MetricSource::Sums(Statistic::Mean(COS, RAYS, 100.0)),
        ..ROW
    },
    Metric {
        name: "sc2",
        about: "percent of bright light that the stone returns face-up, most weight for light from 45° (GemRay \
            SC2)",
        definition: &[OVER, OUTLINE, RULES, "2h√(1 − h²);", MEAN, OF_OUTLINE, PERCENT],
        read_from: MetricSource::Sums(Statistic::Mean(SC2, RAYS, 100.0)),
        ..ROW
    },
    Metric {
        name: "table_iso",
        about: "percent of bright light that the table returns face-up, all light alike (GemRay ISO)",
        definition: &[OVER, ONLY_TABLE, RULES, "1;", MEAN, OF_TABLE, PERCENT],
        read_from: MetricSource::Sums(Statistic::Mean(TABLE_ISO, TABLE_RAYS, 100.0)),
        ..ROW
    },
    Metric {
        name: "table_cos",
        about: "percent of bright light that the table returns face-up, most weight for light from above (GemRay \
            COS)",
        definition: &[OVER, ONLY_TABLE, RULES, "h;", MEAN, OF_TABLE, PERCENT],
        read_from: MetricSource::Sums(Statistic::Mean(TABLE_COS, TABLE_RAYS, 100.0)),
        ..ROW
    },
    Metric {
        name: "table_sc2",
        about: "percent of bright light that the table returns face-up, most weight for light from 45° (GemRay \
            SC2)",
        definition: &[OVER, ONLY_TABLE, RULES, "2h√(1 − h²);", MEAN, OF_TABLE, PERCENT],
        read_from: MetricSource::Sums(Statistic::Mean(TABLE_SC2, TABLE_RAYS, 100.0)),
        ..ROW
    },
];
