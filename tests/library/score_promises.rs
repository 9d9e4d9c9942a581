//! What scores promise whatever the stone: honest errors, the same bytes from any number of
//! threads, rows that say what failed.

use crate::brilliants::{SEED, diamond, n2417, named, plan, stone, subject};
use cutlab::advanced::batch::table;
use cutlab::advanced::estimators::{BatchedEstimate, PointLight, TraceOptics, point_light};
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::METRICS;
use cutlab::advanced::scoring::score::{ScoreInput, ScoreRequest, ScoreRow, score, score_all};
use glam::DMat3;

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let subjects = [subject("a", &named("reference"), diamond()), subject("b", &named("nailhead"), n2417())];
    let plans =
        [ScoreRequest::default().samples(5000).seed(SEED), ScoreRequest::default().error(0.01).seed(SEED)];
    let bytes = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            plans.clone().map(|p| table::csv(&p.metrics, &score_all(&subjects, &p)).expect("csv"))
        })
    };
    let one = bytes(1);
    assert_eq!(one, bytes(2));
    assert_eq!(one, bytes(5));
}

/// [D] every metric keeps its value when the stone turns about its axis, and its stated range; but
/// scintillation is rocked about axes that stay. Some thirty comparisons: 4.2 standard errors.
#[test]
fn turning_a_stone_about_its_axis_changes_no_score() {
    let still = named("steep-deep");
    let turned = still.clone().turned(DMat3::from_rotation_z(0.3));
    let plan = ScoreRequest::default().samples(1 << 15).seed(SEED);
    let [a, b] = [still, turned].map(|d| score(&subject("stone", &d, diamond()), &plan));
    for ((metric, a), b) in METRICS.iter().zip(a.scores).zip(b.scores) {
        let (a, b) = (a.expect("applies"), b.expect("applies"));
        let off = (a.value - b.value).abs();
        let turns = metric.name != "scintillation";
        assert!(!turns || off <= 4.2 * a.error.hypot(b.error) + 1e-6, "{}: {a:?} and {b:?}", metric.name);
        assert!((metric.range.0..=metric.range.1).contains(&a.value), "{}: {a:?}", metric.name);
    }
}

#[test]
fn an_error_asked_for_is_reached_or_the_row_says_so() {
    let subject = subject("reference", &named("reference"), n2417());
    let asked = |target, cap| {
        let metrics = plan(&["wlr", "aset_red"], 0).metrics;
        score(
            &subject,
            &ScoreRequest::default().metrics(metrics).error(target).polarised(false).seed(SEED).cap(cap),
        )
    };
    let reached = asked(0.001, 1 << 20);
    assert_eq!(reached.error, None);
    assert!(reached.scores.iter().all(|s| s.is_some_and(|e| e.error <= 0.001)));
    let short = asked(1e-6, 1 << 15);
    let message = short.error.expect("says so");
    assert!(message.contains("hemisphere: standard error"), "{message}");
    assert!(message.contains("not reached") && message.contains("32768 samples"), "{message}");
    assert!(short.scores.iter().all(Option::is_some), "the scores stand");
}

#[test]
fn rows_hold_what_applies_and_say_what_failed() {
    let mut subjects = vec![
        subject("plain, with a comma", &named("reference"), n2417()),
        subject("sparkling", &named("reference"), diamond()),
        subject("impossible", &named("reference"), Material::from_index(0.5)),
    ];
    subjects[1].material = diamond();
    subjects.push(ScoreInput {
        stone: "open".into(),
        material: diamond(),
        shape: Err("open: no table".into()),
        tilt: None,
    });
    let plan = plan(&["wlr", "fire_streak"], 1000);
    let rows: Vec<ScoreRow> = score_all(&subjects, &plan);
    let text = String::from_utf8(table::csv(&plan.metrics, &rows).expect("csv")).expect("text");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().expect("a header").iter().collect::<Vec<_>>().join(",");
    assert_eq!(header, "stone,material,facets,wlr,wlr_se,fire_streak,fire_streak_se,error");
    let cells: Vec<csv::StringRecord> = reader.records().collect::<Result<_, _>>().expect("records");
    assert_eq!(
        (cells.len(), &cells[0][0], &cells[0][1], &cells[0][2]),
        (4, "plain, with a comma", "n=2.417", "153")
    );
    assert!(cells[0][3].parse::<f64>().is_ok_and(|x| (0.2..0.4).contains(&x)));
    assert_eq!((&cells[0][5], &cells[0][6]), ("", ""), "no dispersion, no fire");
    assert!(cells[0][7].starts_with("fire_streak left out: no dispersion"), "{}", &cells[0][7]);
    assert!(cells[1][5].parse::<f64>().is_ok_and(|x| x > 0.5) && cells[1][7].is_empty());
    assert!(cells[2][3].is_empty() && cells[2][7].contains("0.5"), "{:?}", cells[2]);
    assert_eq!((&cells[3][2], &cells[3][3], &cells[3][7]), ("", "", "open: no table"));
}

/// A material without dispersion lights no colours.
#[test]
fn a_constant_index_separates_nothing() {
    let stone = stone(&named("reference"));
    let mut beam = BatchedEstimate::new(
        PointLight::new(&stone, &TraceOptics { material: &n2417(), polarised: false }).expect("lit"),
        SEED,
    );
    beam.extend_to(1000);
    assert_eq!(beam.estimate(|t| t[point_light::POWER_ANGLE_DEG] / t[point_light::PAIRED_POWER]).value, 0.0);
    assert_eq!(beam.estimate(|t| t[point_light::STREAK_DEG] / t[point_light::POINTS]).value, 0.0);
}
