//! What the tiers of a design do: changes per degree against edits that are scored by other means, lost light
//! against the metric, advice against the stone that takes it.

use cutlab::advanced::design::edit::Keep;
use cutlab::advanced::scoring::{Attribution, AttributionError, Effort, Objective};
use cutlab::{AttributionRequest, EditRequest, Error, ErrorKind, Estimate, Progress, ScoreRequest, Stone};

fn stone(spec: &str) -> Stone {
    Stone::parse(spec).unwrap_or_else(|error| panic!("{spec}: {error}"))
}

fn attribution(spec: &str, metrics: &[&str], samples: u64) -> Attribution {
    let request =
        AttributionRequest::new(metrics).expect("metrics").effort(Effort::default().samples(samples));
    request.run(&stone(spec), &()).unwrap_or_else(|error| panic!("{spec}: {error}"))
}

/// A score of the stone with a tier steeper by some degrees: of beams that are followed to their end, or of rays by
/// a seed of their own.
fn scored(stone: &Stone, metric: &str, (place, degrees, keep): (&str, f64, Keep)) -> Estimate {
    let request = EditRequest::new([format!("{place}.angle+={degrees}")]).expect("a setting").keep(keep);
    let edited = request.run(stone.convex_design().expect("convex")).expect("can be turned");
    let turned = stone.clone().with_design(edited.design).expect("convex");
    let plan = ScoreRequest::new([metric]).seed(77).exact(metric == "iso").samples(1 << 18);
    plan.run(&turned).expect("is lit")[metric]
}

fn difference(more: Estimate, less: Estimate) -> Estimate {
    Estimate { value: more.value - less.value, error: more.error.hypot(less.error) }
}

#[test]
fn changes_per_degree_are_what_edits_score() {
    /// Of `iso` by beams both ways: what their ends leave, in points per degree.
    const BY_BEAMS: f64 = 2e-3;
    let mut told_by_rays = 0;
    for (spec, metrics) in
        [("classic:ri=1.54", &["iso", "wlr"][..]), ("round-brilliant", &["iso"]), ("emerald", &["iso"])]
    {
        let (found, stone) = (attribution(spec, metrics, 1 << 16), stone(spec));
        let (mut compared, mut told) = (0, 0);
        for tier in &found.tiers {
            for change in &tier.changes {
                let keep = tier.keep.expect("was turned");
                let [more, less] =
                    [0.25, -0.25].map(|by| scored(&stone, &change.objective, (&tier.place, by, keep)));
                let step = difference(more, less);
                let (slope, error) = (step.value / 0.5, step.error / 0.5);
                let allowed = match &*change.objective {
                    "iso" => BY_BEAMS,
                    _ => 4.5 * error.hypot(change.per_degree.error),
                };
                let off = (change.per_degree.value - slope).abs();
                let which = format!("{spec} {} {}", tier.place, change.objective);
                assert!(off <= allowed, "{which}: {:?} {slope} ± {error}", change.per_degree);
                // a sign that is turned around would be seen
                let is_told = 2.0 * slope.abs() > allowed;
                match &*change.objective {
                    "iso" => (compared, told) = (compared + 1, told + usize::from(is_told)),
                    _ => told_by_rays += usize::from(is_told),
                }
            }
        }
        assert!(compared >= 5 && 4 * told > 3 * compared, "{spec}: {told} of {compared}");
    }
    assert!(told_by_rays > 0);
}

#[test]
fn lost_light_adds_up_to_the_metric() {
    for (spec, material) in [("tolkowsky", "diamond"), ("emerald", "quartz"), ("oval", "ruby")] {
        let spec = format!("{spec}:material={material}");
        let found = attribution(&spec, &["spread"], 1 << 14);
        let request = ScoreRequest::new(["aset_leak"]).samples(1 << 16).seed(5);
        let sized = stone(&spec).with_width(6.5).expect("a width");
        let metric = request.run(&sized).expect("is lit")["aset_leak"];
        let off = difference(found.leakage, metric);
        assert!(off.value.abs() < 4.5 * off.error + 1e-5, "{spec}: {:?} {metric:?}", found.leakage);
        let tiers: f64 = found.tiers.iter().map(|tier| tier.leakage.value).sum();
        assert!((tiers - found.leakage.value).abs() < 1e-9 && tiers > 1e-3, "{spec}: {tiers}");
        for tier in &found.tiers {
            let facets: f64 = tier.leakage_by_facet.iter().map(|facet| facet.leakage.value).sum();
            assert!((facets - tier.leakage.value).abs() < 1e-9, "{spec} {}", tier.place);
            assert_eq!(tier.leakage_by_facet.len(), tier.facets, "{spec} {}", tier.place);
        }
    }
}

/// What is advised gains what it says, by an edit of the same tier; and its prediction is the slope's.
#[test]
fn advice_gains_what_it_says() {
    let mut advised = 0;
    for (spec, metrics) in [
        ("classic:ri=1.54", &["iso", "windowing"][..]),
        ("classic:ri=1.76", &["iso", "windowing"]),
        ("round-brilliant", &["iso"]),
        ("emerald", &["iso"]),
        ("pear", &["iso"]),
    ] {
        let (found, stone) = (attribution(spec, metrics, 1 << 13), stone(spec));
        for (number, objective) in found.objectives.iter().enumerate() {
            let Some(first) = &objective.first else { continue };
            let tier = found.tiers.iter().find(|tier| tier.place == first.place).expect("is a tier");
            let slope = tier.changes[number].per_degree;
            assert!((first.predicted.value - first.degrees * slope.value).abs() < 1e-12);
            assert_eq!((first.degrees.abs(), &first.followed), (0.5, &tier.followed));
            let sign = objective.aim.sign();
            assert!(
                sign * first.predicted.value > 0.0 && sign * first.scored.value > 0.0,
                "{spec}: {first:?}"
            );
            assert!(objective.order.contains(&first.place), "{spec}: {objective:?}");
            let keep = tier.keep.expect("was turned");
            let of = |by: f64| scored(&stone, &objective.name, (&first.place, by, keep));
            let gain = difference(of(first.degrees), of(0.0));
            let allowed = 4.5 * gain.error.hypot(first.scored.error) + 1e-3;
            assert!((gain.value - first.scored.value).abs() < allowed, "{spec}: {first:?} {gain:?}");
            advised += 1;
        }
    }
    assert!(advised >= 5, "{advised}");
}

/// By default other angles follow only where distances alone cannot: that is said, and to keep angles leaves those
/// tiers without a change.
#[test]
fn what_follows_is_said() {
    let mut following = 0;
    for spec in ["classic:ri=1.54", "round-brilliant", "emerald"] {
        let request = AttributionRequest::new(["weight_ratio"]).expect("a metric");
        let stone = stone(spec);
        let run = |request: &AttributionRequest| request.run(&stone, &()).expect("is scored");
        let (usual, angles) = (run(&request), run(&request.clone().keep(Keep::Angles)));
        for (usual, angles) in usual.tiers.iter().zip(&angles.tiers) {
            match usual.keep {
                Some(Keep::Meets) => {
                    assert!(angles.left_out.is_some() && angles.changes.is_empty(), "{spec} {angles:?}");
                    following += usize::from(!usual.followed.is_empty());
                }
                Some(_) => {
                    assert!(usual.followed.is_empty() && angles.left_out.is_none(), "{spec} {usual:?}")
                }
                None => assert!(angles.keep.is_none() && usual.left_out.is_some(), "{spec} {usual:?}"),
            }
        }
    }
    assert!(following > 0);
    let cube = attribution("cube", &["spread"], 1 << 10);
    assert!(cube.tiers.iter().all(|tier| tier.changes.is_empty() && tier.left_out.is_some()), "{cube:?}");
    assert!(cube.objectives[0].first.is_none() && cube.objectives[0].order.is_empty());
}

/// With an error asked for no change per degree has more noise: the errors of two seeds agree with it.
#[test]
fn noise_is_traced_below_the_error() {
    let run = |seed: u64| {
        let effort = Effort::default().seed(seed);
        let request = AttributionRequest::new(["wlr"]).expect("a metric").effort(effort).error(0.003);
        request.run(&stone("tolkowsky"), &()).expect("is scored")
    };
    let (one, other) = (run(1), run(2));
    assert!(one.warnings.is_empty() && other.warnings.is_empty());
    for (one, other) in one.tiers.iter().zip(&other.tiers).filter(|(one, _)| !one.changes.is_empty()) {
        let off = difference(one.changes[0].per_degree, other.changes[0].per_degree);
        assert!(off.value.abs() < 4.5 * 0.003 * 2f64.sqrt(), "{}: {off:?}", one.place);
    }
}

#[test]
fn the_number_of_threads_shows_in_no_bit() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let found = pool.install(|| attribution("classic:ri=1.54", &["iso", "wlr"], 1 << 11));
        serde_json::to_string(&found).expect("is JSON")
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn requests_are_data_and_what_cannot_be_is_a_typed_error() {
    let request = AttributionRequest::new(["iso@0,10"]).expect("a metric").keep(Keep::Depths).error(0.01);
    let text = serde_json::to_string(&request).expect("is JSON");
    let again: AttributionRequest = serde_json::from_str(&text).expect("is read again");
    assert_eq!(serde_json::to_string(&again).expect("is JSON"), text);
    let short: AttributionRequest = serde_json::from_str(r#"{ "keep": "meets" }"#).expect("is short");
    assert_eq!(short.objectives.iter().map(Objective::name).collect::<Vec<_>>(), ["iso", "wlr"]);
    assert!(serde_json::from_str::<AttributionRequest>(r#"{ "seed": 1 }"#).is_err());

    let unknown = Error::from(AttributionRequest::new(["isso"]).expect_err("no metric"));
    assert_eq!(unknown.kind(), ErrorKind::NotFound);
    let colours =
        AttributionRequest::new(["fire_streak"]).expect("a metric").run(&stone("classic:ri=1.5"), &());
    let colours = Error::from(colours.expect_err("has no colours"));
    assert!(colours.kind() == ErrorKind::Invalid && colours.to_string().contains("dispersion"), "{colours}");

    /// Ends work as soon as it can.
    struct Ended;
    impl Progress for Ended {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let ended = AttributionRequest::default().run(&stone("classic:ri=1.54"), &Ended);
    assert!(matches!(ended, Err(AttributionError::Cancelled)));
}
