//! The horizon has one rule: light that leaves exactly level counts as below, by photons and by beams.

use crate::brilliants::{SEED, subject};
use cutlab::advanced::design::{Design, library};
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::{METRICS, Metric};
use cutlab::advanced::sampling::stats::Estimate;
use cutlab::advanced::scoring::score::{ScoreInput, ScoreRequest, ScoreRow, Target, score};

/// Indices of refraction: quartz for faceters, diamond.
const INDICES: [f64; 2] = [1.54, 2.417];

fn cut(name: &str) -> Design {
    library::design(name, &Default::default()).expect("in the library").expect("solved")
}

/// Every figure of one direction that beams give; all of the sky with `whole`.
fn by_beams(whole: bool) -> Vec<&'static Metric> {
    let of_one_direction = |m: &Metric| matches!(m.estimator.name(), "view" | "iso" | "beam");
    METRICS.iter().copied().filter(|m| m.by_beams && (whole || of_one_direction(m))).collect()
}

fn both(subject: &ScoreInput, metrics: &[&'static Metric], samples: u64) -> [ScoreRow; 2] {
    let effort = Target::Samples(samples);
    let plan = ScoreRequest::default().metrics(metrics.iter().copied()).target(effort).seed(SEED);
    [false, true].map(|exact| score(subject, &plan.clone().exact(exact)))
}

/// The errors of both and what neither holds: beams leave a few parts in 10⁵ of the outline
/// undecided, lanes give up less than that.
fn apart(metric: &Metric, a: Estimate, b: Estimate) -> f64 {
    (a.value - b.value).abs() / (a.error.hypot(b.error) + 2e-5 * metric.scale)
}

/// Compares all figures of `names`, each at its indices; returns the number compared and the worst.
fn scan<'a>(cases: impl Iterator<Item = (&'a str, &'a [f64])>, whole: bool, samples: u64) -> (usize, f64) {
    let metrics = by_beams(whole);
    let (mut compared, mut worst) = (0, 0.0f64);
    for (name, indices) in cases {
        for &index in indices {
            let subject = subject(name, &cut(name), Material::from_index(index));
            let [photons, beams] = both(&subject, &metrics, samples);
            for ((metric, a), b) in metrics.iter().zip(photons.scores).zip(beams.scores) {
                // a shape without a table has no scores of it
                let (Some(a), Some(b)) = (a, b) else { continue };
                let errors = apart(metric, a, b);
                if errors > 4.0 {
                    println!("{name} {index} {}: {a:?} {b:?}: {errors:.1} errors", metric.name);
                }
                compared += 1;
                worst = worst.max(errors);
            }
        }
    }
    (compared, worst)
}

/// Shapes with facets at 45.0° and crystals. Without a rule barion-square's `iso` is 46.7 by photons
/// and 50.3 by beams, the dodecahedron's `aset_green` .045 and .135.
#[test]
fn photons_and_beams_agree_on_level_light() {
    let names = ["barion-square", "octagon-step", "rhombic-dodecahedron", "cube", "octahedron"];
    let (compared, worst) = scan(names.into_iter().map(|name| (name, &INDICES[..])), false, 1 << 16);
    assert!(compared >= 100 && worst < 4.5, "{compared} compared, the worst {worst} errors apart");
}

/// Of some thousand figures the largest of a normal law is 3.5 errors off.
#[test]
#[ignore = "every cut of the library by beams at two indices, half a minute: .ci/run runs it"]
fn photons_and_beams_agree_for_every_cut() {
    // the indices in turn
    let cases = library::names().zip(INDICES.chunks(1).cycle());
    let (compared, worst) = scan(cases, true, 1 << 15);
    assert!(compared > 1000 && worst < 5.0, "{compared} compared, the worst {worst} errors apart");
}

/// Light that leaves level does not count as coming from above: an independent tracer in f64 has
/// .4476 ± .0005 for this stone, and .4948 with the horizon counted. In exact arithmetic all green of
/// the rhombic dodecahedron in diamond comes from the horizon.
#[test]
fn level_light_is_not_light_from_above() {
    let one = |name: &str, index: f64, metric: &str| {
        let metrics = [Metric::by_name(metric).expect("in the catalogue")];
        let subject = subject(name, &cut(name), Material::from_index(index));
        both(&subject, &metrics, 1 << 17).map(|row| row.scores[0].expect("applies"))
    };
    for found in one("barion-square", 2.417, "brightness") {
        assert!((found.value - 0.4476).abs() < 4.0 * found.error.hypot(0.0005), "{found:?}");
    }
    for found in one("rhombic-dodecahedron", 2.417, "aset_green") {
        assert!(found.value.abs() < 1e-5, "{found:?}");
    }
}
