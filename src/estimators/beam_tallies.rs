//! Tallies by beams: the sums of estimators of one direction, with little noise or none.

use super::beam_view::{StrongestShares, strongest};
use super::colour_separation;
use super::faceter_view::{self, weights};
use super::view::{AsetBand, ObserverDome, ViewerLighting, band};
use super::weighted_exits::{BeamEffort, WeightedSums, integrate_exits};
use super::{EstimatorError, TraceOptics, ViewFrame, check_index, entry_sampling, point_light, view};
use crate::sampling::statistic::Statistic;
use crate::trace::beams::{
    BeamExit, BeamVisitor, Beams, EntryFacet, IncidentBeam, StopCriteria, UnpolarisedLight,
};
use glam::DVec3;

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
pub fn needs_strongest_path(score: &Statistic<view::ViewTally>) -> bool {
    let (strongest, windowed) = (UNKNOWN.bands, UNKNOWN.windowed);
    score.value(&view::ViewTally { rays: 1.0, strongest, windowed, ..view::ViewTally::default() }).is_nan()
}

/// The view's tally in batches, which share what beams give and have photons of their own.
///
/// The luminance of single points is not known: `dark` stays 0. Strongest paths are followed if they are
/// asked for; if not, or if there are too many beams, they are NaN. Checked in `tests/exact.rs` against
/// [`super::View`].
pub fn view(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    surroundings: ViewerLighting,
    with_strongest: bool,
    effort: &BeamEffort,
) -> Result<Vec<view::ViewTally>, EstimatorError> {
    const COS2: usize = AsetBand::Below as usize + 1;
    const SCOPE: usize = COS2 + 1;
    const DOME: usize = COS2 + 2;
    const HIDDEN: usize = COS2 + 3;
    let (direction, index) = (-view_frame.axis, medium.material.index_d());
    let ViewerLighting { scope, dome } = surroundings;
    let lit = IncidentBeam { direction, indices: [index] };
    let weighed: WeightedSums<8> = integrate_exits(beams, &lit, medium.polarised, effort, |l| {
        let up = l.up as f32;
        let mut weights = [0.0; 8];
        weights[band(up) as usize] = 1.0;
        weights[COS2] = l.up.max(0.0).powi(2);
        weights[SCOPE] = f64::from(u8::from(scope.is_bright(up)));
        weights[HIDDEN] = f64::from(u8::from(scope.is_hidden(up)));
        weights[DOME] = f64::from(u8::from(dome.is_bright(up)));
        weights
    })?;
    let mut shares = UNKNOWN;
    if with_strongest {
        let found = strongest(beams, direction, index, medium.polarised, STRONGEST_POWER)?;
        shares = if found.cut_short { UNKNOWN } else { found };
    }
    let tally = |(sums, lost): ([f64; 8], f64)| view::ViewTally {
        rays: 1.0,
        reflected: weighed.reflected,
        bands: std::array::from_fn(|b| sums[b]),
        up_cos2: sums[COS2],
        absorbed: 0.0,
        lost,
        strongest: shares.bands,
        scope_bright: sums[SCOPE],
        scope_dark: sums[HIDDEN],
        luminance: weighed.glare[DOME] + sums[DOME],
        windowed: shares.windowed,
        dark: 0.0,
    };
    Ok(weighed.batches().into_iter().map(tally).collect())
}

/// The faceters' view. Checked in `tests/exact.rs` against [`super::FaceterView`].
pub fn iso(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    sky: ObserverDome,
) -> Result<faceter_view::FaceterTally, EstimatorError> {
    let index = check_index(medium.material.index_d())?;
    let (facing, table) =
        (faceter_view::facing_flags(beams.stone(), view_frame), entry_sampling::table_flags(beams.stone()));
    let mut bright = FaceterBeamVisitor {
        axis: view_frame.axis,
        sky,
        facing: &facing,
        table: &table,
        tally: faceter_view::FaceterTally::default(),
    };
    let lit = IncidentBeam { direction: -view_frame.axis, indices: [f64::from(index)] };
    let until = StopCriteria { facets: faceter_view::MAX_BOUNCES, ..StopCriteria::at_power(ISO_POWER) };
    let totals = beams.trace(&lit, UnpolarisedLight(1.0), until, &mut bright);
    let facets = beams.facets();
    let seen = |f: usize| {
        facets.area(f) * facets.planes[f].normal.dot(view_frame.axis).max(0.0) * f64::from(table[f])
    };
    let table_rays = (0..facets.count()).map(seen).sum::<f64>() / totals.outline;
    Ok(faceter_view::FaceterTally { rays: 1.0, table_rays, ..bright.tally })
}

/// Visitor that sums what is bright by the faceters' rules.
struct FaceterBeamVisitor<'a> {
    axis: DVec3,
    sky: ObserverDome,
    facing: &'a [f32],
    table: &'a [f32],
    tally: faceter_view::FaceterTally,
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
            self.tally.all[i] += power;
            self.tally.table[i] += table * power;
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
}

/// The sums behind colour separation, in batches as those of [`view()`]; angles one by one and thresholds
/// are left out. Checked in `tests/beams.rs`.
pub fn colours(
    beams: &Beams,
    medium: &TraceOptics,
    view_frame: ViewFrame,
    effort: &BeamEffort,
) -> Result<Vec<point_light::PointLightTally>, EstimatorError> {
    let weighed = colour_separation::weighted_mean(beams, -view_frame.axis, medium, effort)?;
    let tally = |([power_angle_deg, paired_power], _): ([f64; 2], f64)| point_light::PointLightTally {
        points: 1.0,
        power_angle_deg,
        paired_power,
        ..point_light::PointLightTally::default()
    };
    Ok(weighed.batches().into_iter().map(tally).collect())
}
