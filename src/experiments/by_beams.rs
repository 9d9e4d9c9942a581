//! Tallies by beams: what the experiments of one direction add up, without noise or all but.

use super::exact::{StrongestShares, strongest};
use super::iso::{self, weights};
use super::separation;
use super::view::{Band, Sky, Surroundings, band};
use super::weigh::{Effort, Weighed, weigh};
use super::{Aspect, ExperimentError, Medium, beam, check_index, entrance, view};
use crate::math::statistic::Statistic;
use crate::walk::beams::{Beams, Entrance, Exit, Lit, Scalar, Until, Watch};
use glam::DVec3;

/// A beam that could still bring a stronger path to a point is followed down to this share of the
/// light on the outline; what then is undecided covers some 1e-5 of the outline.
const STRONGEST_POWER: f64 = 1e-8;

/// The faceters' view follows every beam of nine meetings that holds more than this.
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
pub fn reads_strongest(score: &Statistic<view::Tally>) -> bool {
    let (strongest, windowed) = (UNKNOWN.bands, UNKNOWN.windowed);
    score.of(&view::Tally { rays: 1.0, strongest, windowed, ..view::Tally::default() }).is_nan()
}

/// The view's tally in batches, which share what beams give and have photons of their own.
///
/// The luminance of single points is not known: `dark` stays 0. Strongest paths are followed if they
/// are asked for; if not, or if there are too many beams, they are not numbers. Checked in `tests/exact.rs` against
/// [`super::View`].
pub fn view(
    beams: &Beams,
    medium: &Medium,
    aspect: Aspect,
    surroundings: Surroundings,
    with_strongest: bool,
    effort: &Effort,
) -> Result<Vec<view::Tally>, ExperimentError> {
    const COS2: usize = Band::Below as usize + 1;
    const SCOPE: usize = COS2 + 1;
    const DOME: usize = COS2 + 2;
    const HIDDEN: usize = COS2 + 3;
    let (direction, index) = (-aspect.axis, medium.material.index_d());
    let Surroundings { scope, dome } = surroundings;
    let lit = Lit { direction, indices: [index] };
    let weighed: Weighed<8> = weigh(beams, &lit, medium.polarised, effort, |l| {
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
    let tally = |(sums, lost): ([f64; 8], f64)| view::Tally {
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

/// The faceters' view. Checked in `tests/exact.rs` against [`super::Iso`].
pub fn iso(beams: &Beams, medium: &Medium, aspect: Aspect, sky: Sky) -> Result<iso::Tally, ExperimentError> {
    let index = check_index(medium.material.index_d())?;
    let (facing, table) = (iso::facing_flags(beams.stone(), aspect), entrance::table_flags(beams.stone()));
    let mut bright =
        Bright { axis: aspect.axis, sky, facing: &facing, table: &table, tally: iso::Tally::default() };
    let lit = Lit { direction: -aspect.axis, indices: [f64::from(index)] };
    let until = Until { facets: iso::MEETINGS, ..Until::power(ISO_POWER) };
    let totals = beams.follow(&lit, Scalar(1.0), until, &mut bright);
    let facets = beams.facets();
    let seen =
        |f: usize| facets.area(f) * facets.planes[f].normal.dot(aspect.axis).max(0.0) * f64::from(table[f]);
    let table_rays = (0..facets.count()).map(seen).sum::<f64>() / totals.outline;
    Ok(iso::Tally { rays: 1.0, table_rays, ..bright.tally })
}

/// What is bright by the faceters' rules.
struct Bright<'a> {
    axis: DVec3,
    sky: Sky,
    facing: &'a [f32],
    table: &'a [f32],
    tally: iso::Tally,
}

impl Bright<'_> {
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

impl Watch<Scalar, 1> for Bright<'_> {
    fn reflected(&mut self, entrance: &Entrance, direction: DVec3, power: f64) {
        self.add(entrance.facet, entrance.facet, direction, power);
    }

    fn exit(&mut self, exit: &Exit<Scalar, 1>) {
        self.add(exit.entrance.facet, exit.facet, exit.direction, exit.power);
    }
}

/// What of the beam's tally the separation of the colours is taken from, in batches as [`view()`]'s.
/// Angles one by one and thresholds are left out. Checked in `tests/beams.rs`.
pub fn colours(
    beams: &Beams,
    medium: &Medium,
    aspect: Aspect,
    effort: &Effort,
) -> Result<Vec<beam::Tally>, ExperimentError> {
    let weighed = separation::weighed(beams, -aspect.axis, medium, effort)?;
    let tally = |([power_angle_deg, paired_power], _): ([f64; 2], f64)| beam::Tally {
        points: 1.0,
        power_angle_deg,
        paired_power,
        ..beam::Tally::default()
    };
    Ok(weighed.batches().into_iter().map(tally).collect())
}
