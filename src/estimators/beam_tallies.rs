//! Tallies by beams: the sums of estimators of one direction, with little noise or none.

use super::beam_view::{StrongestShares, strongest};
use super::colour_separation;
use super::faceter_view::{self, weights};
use super::kind::{Method, Metric, MetricSource, Setup};
use super::viewer_lighting::{ObserverDome, ViewerLighting, band};
use super::weighted_exits::{BeamEffort, WeightedSums, integrate_exits};
use super::{
    EstimatorError, TraceOptics, ViewFrame, check_index, entry_sampling, point_light, view, view_metrics,
};
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally};
use crate::trace::ConvexStone;
use crate::trace::beams::{
    BeamExit, BeamVisitor, Beams, EntryFacet, IncidentBeam, ResidualBeam, StopCriteria, UnpolarisedLight,
};
use glam::DVec3;

/// The method by beams of the view's metrics.
pub(super) fn view_methods<'a>(
    stone: &'a ConvexStone,
    setup: Setup<'a>,
    asked: &[&Metric],
) -> Vec<Method<'a>> {
    let reads_strongest =
        |m: &&Metric| matches!(m.read_from, MetricSource::Sums(s) if needs_strongest_path(&s));
    let (lighting, strongest) = (view_metrics::lighting(&setup), asked.iter().any(reads_strongest));
    vec![Method::beams("view by beams", move |effort| {
        view(&setup.beams(stone), &setup.medium, setup.view_frame, lighting, strongest, effort)
    })]
}

/// The method by beams of the faceters' metrics.
pub(super) fn iso_methods<'a>(stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
    let dome = setup.dome(faceter_view::GEMRAY_OBSERVER_DEG);
    vec![Method::beams("iso by beams", move |effort| {
        Ok(vec![iso(&setup.beams(stone), &setup.medium, setup.view_frame, dome, effort.untraced)?])
    })]
}

/// The method by beams of the point light's metrics.
pub(super) fn colour_methods<'a>(stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
    vec![Method::beams("beam by beams", move |effort| {
        colours(&setup.beams(stone), &setup.medium, setup.view_frame, effort)
    })]
}

/// A beam that could still bring a stronger path to a point is followed down to this share of the light on
/// the outline; the undecided rest covers some 1e-5 of the outline.
const STRONGEST_POWER: f64 = 1e-8;

/// The faceters' view follows every beam of nine bounces that holds more than this.
const ISO_POWER: f64 = 1e-10;

/// Strongest paths that were not followed.
const UNKNOWN: StrongestShares = StrongestShares {
    bands: [f64::NAN; 4],
    undecided: 1.0,
    dark: f64::NAN,
    windowed: f64::NAN,
    cut_short: true,
};

/// Whether a score of the view reads the strongest paths.
pub fn needs_strongest_path(score: &Statistic) -> bool {
    let mut unknown = Tally::of(&[(view::RAYS, 1.0)]);
    add_strongest(&mut unknown, &UNKNOWN);
    score.value(&unknown).is_nan()
}

/// Enters strongest paths into a tally of the view.
fn add_strongest(tally: &mut Tally, shares: &StrongestShares) {
    view::STRONGEST.into_iter().zip(shares.bands).for_each(|(band, share)| tally[band] = share);
    tally[view::WINDOWED] = shares.windowed;
}

/// Columns of the view that are sums of exits, each with a weight.
const WEIGHTED: [Column; 8] = [
    view::GREEN,
    view::RED,
    view::BLUE,
    view::BELOW,
    view::UP_COS2,
    view::SCOPE_BRIGHT,
    view::SCOPE_DARK,
    view::LUMINANCE,
];

/// The view's tally in batches, which share what beams give and have photons of their own.
///
/// The luminance of single points is not known: dark rays stay 0. Strongest paths are followed if they are
/// asked for; if not, or if there are too many beams, they are NaN. Checked in `tests/library/exact.rs` against
/// [`super::View`].
pub fn view(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    surroundings: ViewerLighting,
    with_strongest: bool,
    effort: &BeamEffort,
) -> Result<Vec<Tally>, EstimatorError> {
    let (direction, index) = (-view_frame.axis, medium.material.index_d());
    let ViewerLighting { scope, dome } = surroundings;
    let lit = IncidentBeam { direction, indices: [index] };
    let weighed: WeightedSums<8> = integrate_exits(beams, &lit, medium.polarised, effort, |l| {
        let up = l.up as f32;
        let share = |counts: bool| f64::from(u8::from(counts));
        let [green, red, blue, below] = std::array::from_fn(|b| share(b == band(up) as usize));
        let cos2 = l.up.max(0.0).powi(2);
        let [bright, hidden] = [scope.is_bright(up), scope.is_hidden(up)].map(share);
        [green, red, blue, below, cos2, bright, hidden, share(dome.is_bright(up))]
    })?;
    let mut shares = UNKNOWN;
    if with_strongest {
        let found = strongest(beams, direction, index, medium.polarised, STRONGEST_POWER)?;
        shares = if found.cut_short { UNKNOWN } else { found };
    }
    // the last of the weighted sums: reflection at entry counts for luminance alone
    let glare = weighed.glare.last().copied().unwrap_or_default();
    let tally = |(sums, lost): ([f64; 8], f64)| {
        let mut tally =
            Tally::of(&[(view::RAYS, 1.0), (view::REFLECTED, weighed.reflected), (view::LOST, lost)]);
        WEIGHTED.into_iter().zip(sums).for_each(|(column, sum)| tally[column] = sum);
        tally[view::LUMINANCE] += glare;
        add_strongest(&mut tally, &shares);
        tally
    };
    Ok(weighed.batches().into_iter().map(tally).collect())
}

/// The faceters' view. Checked in `tests/library/exact.rs` against [`super::FaceterView`].
///
/// - `untraced`: share of the light that may be left untraced, as [`BeamEffort::untraced`]
pub fn iso(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    sky: ObserverDome,
    untraced: f64,
) -> Result<Tally, EstimatorError> {
    let index = check_index(medium.material.index_d())?;
    let (facing, table) =
        (faceter_view::facing_flags(beams.stone(), view_frame), entry_sampling::table_flags(beams.stone()));
    let mut bright = FaceterBeamVisitor {
        axis: view_frame.axis,
        sky,
        facing: &facing,
        table: &table,
        tally: Tally::default(),
        untraced: [0.0; 2],
    };
    let lit = IncidentBeam { direction: -view_frame.axis, indices: [f64::from(index)] };
    let until = StopCriteria {
        facets: faceter_view::MAX_BOUNCES,
        residual: untraced,
        ..StopCriteria::at_power(ISO_POWER)
    };
    let totals = beams.trace(&lit, UnpolarisedLight(1.0), until, &mut bright);
    let facets = beams.facets();
    let seen = |f: usize| {
        facets.area(f) * facets.planes[f].normal.dot(view_frame.axis).max(0.0) * f64::from(table[f])
    };
    let table_rays = (0..facets.count()).map(seen).sum::<f64>() / totals.outline;
    let mut tally = bright.tally;
    (tally[faceter_view::RAYS], tally[faceter_view::TABLE_RAYS]) = (1.0, table_rays);
    if untraced > 0.0 {
        faceter_view::add_half_of_untraced(&mut tally, bright.untraced);
    }
    Ok(tally)
}

/// Visitor that sums what is bright by the faceters' rules.
struct FaceterBeamVisitor<'a> {
    axis: DVec3,
    sky: ObserverDome,
    facing: &'a [f32],
    table: &'a [f32],
    tally: Tally,
    /// Light that was not followed over as many facets as count, and the part of it that met the table.
    untraced: [f64; 2],
}

impl FaceterBeamVisitor<'_> {
    fn add(&mut self, entered: usize, facet: usize, direction: DVec3, power: f64) {
        let height = direction.dot(self.axis) as f32;
        if self.facing[facet] == 0.0 || !self.sky.is_bright(height) {
            return;
        }
        let table = f64::from(self.table[entered]);
        for (i, weight) in weights(height).into_iter().enumerate() {
            let power = power * f64::from(weight);
            self.tally[faceter_view::ALL[i]] += power;
            self.tally[faceter_view::TABLE[i]] += table * power;
        }
    }
}

impl BeamVisitor<UnpolarisedLight, 1> for FaceterBeamVisitor<'_> {
    fn reflected(&mut self, entrance: &EntryFacet, direction: DVec3, power: f64) {
        self.add(entrance.facet, entrance.facet, direction, power);
    }

    fn exit(&mut self, exit: &BeamExit<UnpolarisedLight, 1>) {
        self.add(exit.entry.facet, exit.facet, exit.direction, exit.power);
    }

    fn residual(&mut self, rest: &ResidualBeam<UnpolarisedLight, 1>) {
        if rest.bounces < faceter_view::MAX_BOUNCES {
            self.untraced[0] += rest.power;
            self.untraced[1] += f64::from(self.table[rest.entry.facet]) * rest.power;
        }
    }
}

/// The sums behind colour separation, in batches as those of [`view()`]; angles one by one and thresholds
/// are left out. Checked in `tests/library/beams.rs`.
pub fn colours(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    effort: &BeamEffort,
) -> Result<Vec<Tally>, EstimatorError> {
    let weighed = colour_separation::weighted_mean(beams, -view_frame.axis, medium, effort)?;
    let tally = |([power_angle_deg, paired_power], _): ([f64; 2], f64)| {
        Tally::of(&[
            (point_light::POINTS, 1.0),
            (point_light::POWER_ANGLE_DEG, power_angle_deg),
            (point_light::PAIRED_POWER, paired_power),
        ])
    };
    Ok(weighed.batches().into_iter().map(tally).collect())
}
