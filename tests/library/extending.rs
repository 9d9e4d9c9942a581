//! Metrics and an estimator from outside: one row on sums that are there, one file for sums of its own, one
//! for an estimator of its own, each scored as those of the catalogue are.

use crate::brilliants::{diamond, named, plan, subject};
use cutlab::advanced::estimators::hemisphere::{GLARE, HemisphereKind, RETURNED};
use cutlab::advanced::metrics::{Metric, MetricSource, Statistic};
use cutlab::advanced::sampling::stats::Estimate;
use cutlab::advanced::scoring::score::{Target, score};

/// A metric on sums that an estimator has: one row.
static GLARE_PER_RETURN: Metric = Metric {
    name: "glare_per_return",
    about: "light mirrored by the crown's surface per light returned from inside",
    range: (0.0, 1e3),
    ..Metric::of(&HemisphereKind, MetricSource::Sums(Statistic::Smooth(|t| t[GLARE] / t[RETURNED])))
};

/// A metric on a sum of its own: light that leaves towards a lamp-lit ring, by beams.
mod ring {
    use cutlab::advanced::estimators::kind::{EstimatorKind, LIGHT, Method, Metric, MetricSource, Setup};
    use cutlab::advanced::estimators::weighted_exits::integrate_exits;
    use cutlab::advanced::sampling::statistic::Statistic;
    use cutlab::advanced::sampling::tally::{Column, Tally, columns};
    use cutlab::advanced::trace::ConvexStone;
    use cutlab::advanced::trace::beams::{Beams, IncidentBeam};

    columns! {
        /// Light on the outline.
        SEEN,
        /// Power from 30 to 60° above the girdle plane.
        RING,
    }

    /// The face-up view of a ring of light.
    #[derive(Debug)]
    pub struct RingKind;

    /// The metric.
    pub static METRICS: [Metric; 1] = [Metric {
        name: "ring",
        about: "share of what one sees face-up that comes from 30 to 60°",
        definition: &["Parallel face-up view;", LIGHT, "Share of power from 30 to 60°."],
        ..Metric::of(&RingKind, MetricSource::Sums(Statistic::Mean(RING, SEEN, 1.0)))
    }];

    impl EstimatorKind for RingKind {
        fn name(&self) -> &'static str {
            "ring"
        }

        fn metrics(&self) -> &'static [Metric] {
            &METRICS
        }

        fn columns(&self) -> &'static [Column] {
            &COLUMNS
        }

        fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
            vec![Method::beams("ring", move |effort| {
                let direction = -setup.view_frame.axis;
                let lit = IncidentBeam { direction, indices: [setup.medium.material.index_d()] };
                let polarised = setup.medium.polarised;
                let sums = integrate_exits(&Beams::new(stone), &lit, polarised, effort, |exit| {
                    let ring = 30f64.to_radians().sin()..=60f64.to_radians().sin();
                    [f64::from(u8::from(ring.contains(&exit.up)))]
                })?;
                let tally = |([ring], _): ([f64; 1], f64)| Tally::of(&[(SEEN, 1.0), (RING, ring)]);
                Ok(sums.batches().into_iter().map(tally).collect())
            })]
        }
    }
}

/// An estimator of its own: one file.
mod crown {
    use cutlab::advanced::estimators::kind::{EstimatorKind, Method, Metric, MetricSource, Setup};
    use cutlab::advanced::estimators::{Estimator, EstimatorError};
    use cutlab::advanced::sampling::kronecker::KroneckerPoints;
    use cutlab::advanced::sampling::random::Purpose;
    use cutlab::advanced::sampling::statistic::Statistic;
    use cutlab::advanced::sampling::tally::{Column, Tally, columns};
    use cutlab::advanced::trace::ConvexStone;
    use std::ops::Range;

    const STREAM: Purpose = Purpose::named("places over a crown");

    columns! {
        /// Places of the square about the stone.
        PLACES,
        /// Those over the stone.
        INSIDE,
    }

    /// The shadow of a stone in a square, by random places.
    struct Shadow<'a>(&'a ConvexStone);

    impl Estimator for Shadow<'_> {
        fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
            let hull = self.0.solid.hull();
            let reach = hull.iter().fold(0.0, |most: f64, p| most.max(p.abs().max_element()));
            for [u, v] in KroneckerPoints::<2>::new(seed, STREAM, batch, points) {
                let at = reach * glam::DVec2::new(2.0 * u - 1.0, 2.0 * v - 1.0);
                let next = |i: usize| hull[(i + 1) % hull.len()];
                let inside = (0..hull.len()).all(|i| (next(i) - hull[i]).perp_dot(at - hull[i]) >= 0.0);
                tally[PLACES] += 1.0;
                tally[INSIDE] += f64::from(u8::from(inside));
            }
        }
    }

    /// Shadows.
    #[derive(Debug)]
    pub struct ShadowKind;

    /// The metric.
    pub static METRICS: [Metric; 1] = [Metric {
        name: "shadow",
        about: "share of the square about the stone that lies in its shadow",
        ..Metric::of(&ShadowKind, MetricSource::Sums(Statistic::Share(INSIDE, PLACES)))
    }];

    impl EstimatorKind for ShadowKind {
        fn name(&self) -> &'static str {
            "shadow"
        }

        fn metrics(&self) -> &'static [Metric] {
            &METRICS
        }

        fn columns(&self) -> &'static [Column] {
            &COLUMNS
        }

        fn methods<'a>(&self, stone: &'a ConvexStone, _: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
            vec![Method::samples("shadow", 1, move || Ok::<_, EstimatorError>(Shadow(stone)))]
        }
    }
}

/// Scores of the reference brilliant in diamond: those of the catalogue that are named, then the others.
fn scores(names: &[&str], others: &[&'static Metric], target: Target) -> (Vec<Estimate>, Vec<&'static str>) {
    let mut plan = plan(names, 1).target(target);
    plan.metrics.extend(others);
    let row = score(&subject("reference", &named("reference"), diamond()), &plan);
    assert_eq!((row.error, row.left_out), (None, Vec::new()));
    let scores = row.scores.into_iter().map(|score| score.expect("applies")).collect();
    (scores, row.samples.into_iter().map(|(by, _)| by).collect())
}

/// [D] from the same rays: the quotient of the two metrics of the catalogue.
#[test]
fn a_row_on_sums_that_are_there_is_a_metric() {
    let (found, by) = scores(&["glare", "light_return"], &[&GLARE_PER_RETURN], Target::Samples(1 << 14));
    let [glare, returned, quotient] = found[..] else { panic!("three scores: {found:?}") };
    assert!((quotient.value - glare.value / returned.value).abs() < 1e-12, "{found:?}");
    assert!(quotient.error > 0.0 && quotient.error < 0.01, "{quotient:?}");
    assert_eq!(by, ["hemisphere"], "traced once");
}

/// [D] the ring lies within the bands of the ASET that it cuts: all of it is green or red, and no more.
#[test]
fn a_sum_of_its_own_is_a_metric() {
    let (found, by) = scores(&["aset_green", "aset_red"], &[&ring::METRICS[0]], Target::Samples(1 << 16));
    let [green, red, ring] = found[..] else { panic!("three scores: {found:?}") };
    assert!(ring.value > 0.05 && ring.value < green.value + red.value, "{found:?}");
    assert_eq!(by, ["view", "ring"]);
    let sums: f64 =
        scores(&["aset_blue", "aset_leak"], &[], Target::Samples(1 << 16)).0.iter().map(|e| e.value).sum();
    assert!(ring.value + sums < 1.0, "{ring:?} {sums}");
}

/// [D] a circle fills π/4 of its square, a girdle of 96 flats nearly; traced until the error asked for.
#[test]
fn an_estimator_of_its_own_is_scored_to_an_error() {
    let (found, by) = scores(&["spread"], &[&crown::METRICS[0]], Target::Error(1e-3));
    let shadow = found[1];
    assert!(shadow.error > 0.0 && shadow.error <= 1e-3, "{shadow:?}");
    let of_a_circle = std::f64::consts::FRAC_PI_4;
    assert!((shadow.value - of_a_circle).abs() < 0.002 + 4.0 * shadow.error, "{shadow:?}");
    assert_eq!(by, ["shadow"]);
}
