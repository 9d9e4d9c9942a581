//! Point light: light from a point at infinity behind the viewer, in the six lines B C D e F G.

use super::batches::Estimator;
use super::entry_sampling::{self, Silhouette};
use super::horizon::is_up;
use super::kind::{Better, EstimatorKind, Method, Metric, MetricSource, Setup};
use super::same_path::SamePath;
use super::wavelengths::MODE_STREAM;
use super::{EstimatorError, LineOptics, TraceOptics, ViewFrame};
use crate::optics::dispersion::lines;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally, columns};
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{ConvexStone, Interaction, LANES, Lanes, Packet};
use glam::DVec3;
use std::ops::Range;

/// Points of the outline, one stream a batch.
const STREAM: Purpose = Purpose::named("point light");

/// A path is followed while it holds this share of the light that fell on its point.
const STOP_POWER: f32 = 1e-6;

/// Threshold of visibility: exiting irradiance as a share of the beam's (GIA 2001: 10⁻³).
pub const THRESHOLD: f32 = 1e-3;

/// Lanes of a ray: the sixteenth of a packet is idle.
const LINES: usize = 3;

/// Lines that are paired on one path, D first.
const PAIRED: [f64; LINES] = [lines::D, lines::B, lines::G];

/// The other three of the six.
const UNPAIRED: [f64; LINES] = [lines::C, lines::E, lines::F];

/// Width of the classes that the median separation is taken from, in degrees.
pub const CLASS_DEG: f64 = 0.05;

/// A beam from the viewer's side on one stone: points uniform over the outline, unpolarised outside.
///
/// The exiting beam is m = (cos t / cos i) at entry × (cos out / cos in) at exit times as wide as
/// the entering one; its irradiance is power / m. Crown exits above the horizon count.
#[derive(Debug, Clone)]
pub struct PointLight<'a> {
    stone: &'a ConvexStone,
    view_frame: ViewFrame,
    polarised: bool,
    optics: [[LineOptics; LINES]; 2],
    outline: Silhouette,
    crown: Vec<f32>,
    needs: PointLightNeeds,
}

/// The parts of a point light's tally that are needed; the others may be wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PointLightNeeds {
    /// Exits of all six lines, rather than of those that are compared.
    pub lit: bool,
    /// Exits too faint to be seen, which count for the separation of the colours.
    pub faint: bool,
}

impl PointLightNeeds {
    /// All parts.
    pub const ALL: PointLightNeeds = PointLightNeeds { lit: true, faint: true };

    /// The parts that a score reads.
    pub fn from_statistic(reading: &Statistic) -> PointLightNeeds {
        let seen = Tally::of(&[(POINTS, 1.0), (LIT, 1.0), (STREAK_DEG, 1.0)]);
        let unlit = seen.with(&[LIT], 1.0);
        let mut faint = seen.with(&[POWER_ANGLE_DEG, PAIRED_POWER], 1.0);
        faint.histogram.insert(1.0, 1.0);
        let differs = |other: &Tally| reading.value(other).to_bits() != reading.value(&seen).to_bits();
        PointLightNeeds { lit: differs(&unlit), faint: differs(&faint) }
    }

    /// The parts that either needs.
    pub fn and(self, other: PointLightNeeds) -> PointLightNeeds {
        PointLightNeeds { lit: self.lit || other.lit, faint: self.faint || other.faint }
    }
}

// Sums of a batch; every ray has power 1 in every line. The histogram has the power of [`PAIRED_POWER`] by
// angle, in classes of [`CLASS_DEG`].
columns! {
    /// Points of the outline.
    POINTS,
    /// Σ m cos² over visible exits, mean over the six lines.
    LIT,
    /// Σ m cos² × angle between B and G in degrees, over visible exits at D whose B and G have met the same
    /// facets and leave too.
    STREAK_DEG,
    /// Σ power × angle between B and G in degrees, over crown exits at D whose B and G have met the same
    /// facets and leave too.
    POWER_ANGLE_DEG,
    /// Σ power over the same exits.
    PAIRED_POWER,
}

impl<'a> PointLight<'a> {
    /// Lights a face-up stone; a material without dispersion gives no angles.
    pub fn new(stone: &'a ConvexStone, medium: &TraceOptics) -> Result<Self, EstimatorError> {
        Self::in_frame(stone, medium, ViewFrame::FACE_UP)
    }

    /// Lights a stone from the viewer's side.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
    ) -> Result<Self, EstimatorError> {
        let mut optics = [[LineOptics::default(); LINES]; 2];
        for (into, lines) in optics.iter_mut().zip([PAIRED, UNPAIRED]) {
            for (optics, nm) in into.iter_mut().zip(lines) {
                *optics = medium.optics(stone.unit, nm)?;
            }
        }
        let (outline, crown) = (Silhouette::new(stone, view_frame)?, entry_sampling::crown_flags(stone));
        let polarised = medium.polarised;
        Ok(Self { stone, view_frame, polarised, optics, outline, crown, needs: PointLightNeeds::ALL })
    }

    /// Traces no more than what is needed of the tally; the same points give the same sums.
    pub fn for_needs(self, needs: PointLightNeeds) -> Self {
        Self { needs, ..self }
    }

    /// The power below which a path is not followed.
    fn stop_power(&self) -> f32 {
        let index = self.optics.iter().flatten().map(|o| o.index).fold(1.0, f32::max);
        if self.needs.faint { STOP_POWER } else { least_seen(index.into()) as f32 }
    }
}

/// Light inside a stone with less than this share of what fell in leaves no exit that can be seen.
///
/// Of light that arrives at a facet with power p no beam denser than 4 n p leaves: T/m is largest for
/// light polarised along the plane of incidence, at the critical angle, and no entering beam is
/// narrower inside than outside.
pub(super) fn least_seen(index: f64) -> f64 {
    f64::from(THRESHOLD) / (4.0 * index)
}

/// Angle between two directions, in degrees; exact for small angles.
pub(super) fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

/// The rays of a run of points in three of the lines.
struct PointLightClient<'a> {
    estimator: &'a PointLight<'a>,
    points: KroneckerPoints<2>,
    modes: KroneckerPoints<1>,
    tally: &'a mut Tally,
    optics: [LineOptics; LINES],
    /// Whether the lines are those that are compared.
    paired: bool,
    /// cos t / cos i at entry.
    widening: Lanes,
    together: SamePath<LINES>,
}

impl RayClient for PointLightClient<'_> {
    const WIDTH: usize = LINES;

    fn polarised(&self) -> bool {
        self.estimator.polarised
    }

    fn optic_axis(&self) -> Option<DVec3> {
        self.optics[0].optic_axis()
    }

    fn absorbing(&self) -> bool {
        self.optics.iter().any(LineOptics::absorbs)
    }

    fn stops_by_emitted_power(&self) -> bool {
        self.absorbing()
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let (Some(u), Some([choice])) = (self.points.next(), self.modes.next()) else { return false };
        let PointLight { stone, outline, view_frame, .. } = self.estimator;
        let (facet, point) = outline.sample(u);
        let toward = -view_frame.axis.as_vec3();
        for (lane, optics) in (lane..).zip(self.optics) {
            let entry = optics.enter(packet, lane, stone, (facet, point), toward, choice);
            self.widening[lane] = entry.cos_inside / entry.cos_outside;
        }
        if self.paired {
            self.together.begin(lane);
            self.tally[POINTS] += 1.0;
        }
        true
    }

    /// Lines that have met different facets are no longer compared.
    fn is_done(&self, lane: usize) -> bool {
        !self.estimator.needs.lit && !self.together.is_same(lane)
    }

    fn interact(&mut self, m: &Interaction, _: &Packet) {
        let axis = self.estimator.view_frame.axis.as_vec3();
        let (mut seen, mut height) = ([0.0; LANES], [0.0; LANES]);
        for (l, (seen, height)) in seen.iter_mut().zip(&mut height).enumerate() {
            let z = m.dx[l] * axis.x + m.dy[l] * axis.y + m.dz[l] * axis.z;
            *height = z;
            let width = self.widening[l] * m.cos_outside[l] / m.cos_inside[l].max(f32::MIN_POSITIVE);
            let visible = m.power[l] > THRESHOLD * width && is_up(z);
            let weight = width * z * z * self.estimator.crown[m.facet[l] as usize];
            *seen = if visible { weight } else { 0.0 };
        }
        let six = lines::SIX.len() as f64;
        self.tally[LIT] += seen.iter().map(|s| f64::from(*s)).sum::<f64>() / six;
        for d in SamePath::<LINES>::lanes() {
            let up = is_up(height[d]) && self.estimator.crown[m.facet[d] as usize] > 0.0;
            if self.together.leave(m, d) && up {
                let angle = angle_deg(m.direction(d + 1).as_dvec3(), m.direction(d + 2).as_dvec3());
                let power = f64::from(m.power[d]);
                self.tally[STREAK_DEG] += f64::from(seen[d]) * angle;
                self.tally[POWER_ANGLE_DEG] += power * angle;
                self.tally[PAIRED_POWER] += power;
                self.tally.histogram.insert(angle / CLASS_DEG, power);
            }
        }
    }
}

impl Estimator for PointLight<'_> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let passes = [(self.optics[0], true), (self.optics[1], false)];
        for (optics, paired) in passes.into_iter().filter(|(_, paired)| *paired || self.needs.lit) {
            let mut shine = PointLightClient {
                estimator: self,
                points: KroneckerPoints::new(seed, STREAM, batch, points.clone()),
                modes: KroneckerPoints::new(seed, MODE_STREAM, batch, points.clone()),
                tally: &mut *tally,
                optics,
                paired,
                widening: [0.0; LANES],
                together: SamePath::NONE,
            };
            lane_scheduler::trace_all(self.stone, self.stop_power(), &mut shine);
        }
    }
}

/// So many points of the hemisphere are as dear as one of the point light, which has six lines and follows paths
/// to a hundredth of the power.
pub(super) const COST: u64 = 4;

/// The point light as scores have it.
#[derive(Debug, Clone, Copy)]
pub struct PointLightKind;

impl EstimatorKind for PointLightKind {
    fn name(&self) -> &'static str {
        "beam"
    }

    fn metrics(&self) -> &'static [Metric] {
        &METRICS
    }

    fn columns(&self) -> &'static [Column] {
        &COLUMNS
    }

    fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
        let Setup { medium, view_frame, .. } = setup;
        vec![Method::samples("beam", COST, move || PointLight::in_frame(stone, &medium, view_frame))]
    }

    fn needs_dispersion(&self) -> bool {
        true
    }
}

const POINT_LIGHT: &str = "Vertical collimated beam on the whole outline, unpolarised, Fresnel with its polarisation followed \
    inside (scalar with --polarisation off); exits upward through the crown.";
const ABSORBED: &str = "What a stone absorbs counts at each line.";
const EXACT_AREAS: &str = "Of clear stones by exact beams, those too small to be followed by photons.";

/// What the rows have in common.
const ROW: Metric = Metric {
    unit: "°",
    source: "after the DCLR of I. M. Reinitz et al., Gems & Gemology 37 (2001) 174, whose formula is not public",
    ..Metric::of(&PointLightKind, MetricSource::Sums(Statistic::Mean(LIT, POINTS, 1.0)))
};

/// The metrics.
static METRICS: [Metric; 4] = [
    Metric {
        name: "fire_lit",
        about: "area of the beams that a point light sends out of the crown, per area of the stone (surrogate of \
            GIA's DCLR)",
        unit: "",
        range: (0.0, 1e3),
        better: Better::More,
        definition: &[
            POINT_LIGHT,
            "Area of the exiting beams brighter than 1e-3 of the incident irradiance, weighted by cos² of \
                the angle from zenith, per outline area; mean of the lines B C D e F G. A surrogate.",
            EXACT_AREAS,
            ABSORBED,
        ],
        read_from: MetricSource::Sums(Statistic::Mean(LIT, POINTS, 1.0)),
        ..ROW
    },
    Metric {
        name: "fire_streak",
        about: "length of the colour streaks, line B to G, summed over the beams that a point light sends out of \
            the crown (surrogate of GIA's DCLR)",
        range: (0.0, 1e3),
        better: Better::More,
        definition: &[
            POINT_LIGHT,
            "Area of the exiting beams brighter than 1e-3 of the incident irradiance at D, weighted by \
                cos² of the angle from zenith and by the angle between lines B and G where both leave by the \
                same facets, per outline area. A surrogate.",
            EXACT_AREAS,
            ABSORBED,
        ],
        read_from: MetricSource::Sums(Statistic::Mean(STREAK_DEG, POINTS, 1.0)),
        ..ROW
    },
    Metric {
        name: "dispersion_mean",
        about: "mean angle between lines B and G of one exit, by power; read it beside light return",
        range: (0.0, 180.0),
        by_beams: true,
        definition: &[
            POINT_LIGHT,
            "Angle between lines B and G where both leave by the same facets as D, mean weighted by the \
                power at D. High for stones that return little: read it beside light return.",
            ABSORBED,
        ],
        source: "defined by cutlab",
        read_from: MetricSource::Sums(Statistic::Smooth(|t| t[POWER_ANGLE_DEG] / t[PAIRED_POWER])),
        ..ROW
    },
    Metric {
        name: "dispersion_median",
        about: "median angle between lines B and G of one exit, by power; read it beside light return",
        range: (0.0, 180.0),
        definition: &[
            POINT_LIGHT,
            "Angle between lines B and G where both leave by the same facets as D: half the power at D \
                leaves with less. Median of grouped data: the power of each class of 0.05° counts as spread \
                evenly over it, because facets give a few sharp angles; angles under 0.001° count as 0.",
            ABSORBED,
            "The error is the longer side of a 95 % confidence interval over 1.96: between two peaks it \
                reaches from one to the other until the rays can tell on which the half falls.",
        ],
        source: "defined by cutlab",
        read_from: MetricSource::Sums(Statistic::Median(CLASS_DEG)),
        ..ROW
    },
];
