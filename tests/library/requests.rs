//! Requests for tables: their canonical JSON is their identity, and no field can be left out of it.

use cutlab::ReportRequest;
use cutlab::advanced::batch::fingerprint::{Fingerprint, canonical};
use cutlab::advanced::batch::request::{
    ComparisonTable, ScoreTable, SortRequest, SweepTable, TableRequest, TiltRange,
};
use cutlab::advanced::batch::sweep::Steps;
use cutlab::advanced::batch::table_job::Order;
use cutlab::advanced::metrics::Metric;
use cutlab::advanced::scoring::settings::ScoreRequest;
use cutlab::advanced::stone::{Orientation, StoneOptions, UpAxis};
use serde::Serialize;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

fn metric(name: &str) -> &'static Metric {
    Metric::by_name(name).expect("is in the catalogue")
}

/// A request of each kind, with every field set.
fn requests() -> [TableRequest; 3] {
    let orientation = Orientation::default().up(UpAxis::NegY).align(true);
    let options = StoneOptions::default().material("ruby").ri(1.76).size_mm(6.5).orientation(orientation);
    let scores =
        ScoreRequest::default().metrics(vec![metric("wlr"), metric("iso")]).error(0.001).observer(16.0);
    let steps = Steps::new(30.0, 38.0, 0.5).expect("a range");
    let stones = ["tolkowsky", "a b.asc"];
    let tilt = TiltRange { degrees: steps, azimuths: vec![0.0, 90.0] };
    let sort = SortRequest { metric: metric("iso"), order: Order { ascending: true, top: Some(3) } };
    let table = ScoreTable::new(stones, scores.clone()).tilt(tilt).proportions(true).sort(sort);
    let vary = ["crown-angle=30:38:0.5".parse().expect("a range")];
    let sweep = SweepTable::new("round-brilliant", vary, scores.clone()).scatter(20);
    [
        TableRequest::Score(table.options(options.clone())),
        TableRequest::Sweep(sweep.options(options.clone())),
        TableRequest::Compare(ComparisonTable::new(stones, scores).options(options)),
    ]
}

fn identity(request: &impl Serialize) -> String {
    Fingerprint::of_request(request).hex()
}

/// Paths to all numbers, texts and truth values of a JSON value.
fn leaves(value: &Value, path: String, found: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            map.iter().for_each(|(key, inner)| leaves(inner, format!("{path}/{key}"), found));
        }
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, inner)| leaves(inner, format!("{path}/{i}"), found));
        }
        _ => found.push(path),
    }
}

#[test]
fn every_field_changes_the_identity() {
    for request in requests() {
        let whole = canonical(&request);
        let mut paths = Vec::new();
        leaves(&whole, String::new(), &mut paths);
        assert!(paths.len() > 12, "{paths:?}");
        for path in paths {
            let mut changed = whole.clone();
            *changed.pointer_mut(&path).expect("a leaf") = json!("another value");
            assert_ne!(identity(&changed), identity(&request), "{path}");
        }
    }
}

#[test]
fn every_field_of_a_report_changes_its_identity() {
    let [TableRequest::Score(ScoreTable { stones, options, .. }), ..] = requests() else {
        panic!("the first is of scores");
    };
    let report = ReportRequest::new(stones).options(options).polarised(false).seed(7).error(0.01).width(320);
    let whole = canonical(&report);
    let mut paths = Vec::new();
    leaves(&whole, String::new(), &mut paths);
    assert!(paths.contains(&"/polarised".to_string()) && paths.len() > 7, "{paths:?}");
    for path in paths {
        let mut changed = whole.clone();
        *changed.pointer_mut(&path).expect("a leaf") = json!("another value");
        assert_ne!(identity(&changed), identity(&whole), "{path}");
    }
}

#[test]
fn a_field_that_a_later_version_adds_changes_the_identity() {
    #[derive(Serialize)]
    struct Later {
        #[serde(flatten)]
        request: TableRequest,
        colour_temperature_k: f64,
    }
    for request in requests() {
        let now = identity(&request);
        let later = Later { request, colour_temperature_k: 5500.0 };
        assert_ne!(identity(&later), now);
    }
}

#[test]
fn a_request_is_the_same_after_a_round_trip_through_json() {
    for request in requests() {
        let text = serde_json::to_string(&request).expect("is JSON");
        let again: TableRequest = serde_json::from_str(&text).expect("is a request");
        assert_eq!(identity(&again), identity(&request), "{text}");
        assert_eq!(again.command(), request.command());
    }
}

#[test]
fn what_is_no_request_is_refused_by_name() {
    for (change, said) in [
        (json!({"scores": {"metrics": ["wrl"]}}), "no metric is called 'wrl'"),
        (json!({"scores": {"seeds": 1}}), "unknown field `seeds`"),
        (json!({"tilt": {"degrees": {"from": 0, "to": 10, "step": -1}, "azimuths": []}}), "leads away"),
        (json!({"colour": 1}), "unknown field `colour`"),
    ] {
        let [request, ..] = requests();
        let mut value = canonical(&request);
        for (key, inner) in change.as_object().expect("an object") {
            value[key] = inner.clone();
        }
        let error = serde_json::from_value::<TableRequest>(value).expect_err("no request").to_string();
        assert!(error.contains(said), "{error}");
    }
}

#[test]
fn the_command_line_spells_out_every_setting() {
    let [score, sweep, compare] = requests().map(|request| request.command());
    let settings = "--metrics wlr,iso --error 0.001 --observer 16 --material ruby --ri 1.76 --size 6.5 \
                    --polarisation on --seed 1 --up -y --align";
    assert_eq!(
        score,
        format!(
            "cutlab score tolkowsky 'a b.asc' {settings} --proportions --sort -iso --top 3 \
             --tilt 30:38:0.5 --tilt-axis 0,90"
        )
    );
    assert_eq!(
        sweep,
        format!("cutlab sweep round-brilliant --vary crown-angle=30:38:0.5 --scatter 20 {settings}")
    );
    assert_eq!(compare, format!("cutlab compare tolkowsky 'a b.asc' {settings}"));
}

/// A report belongs to what the files of its stone and of its material hold, whichever of both names the material.
#[test]
fn a_report_belongs_to_what_its_files_hold() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [stone, material] = ["a.toml", "m.toml"].map(|name| folder.path().join(name));
    let named = |path: &Path| path.to_str().expect("UTF-8").to_owned();
    let write_material = |n: f64| {
        fs::write(&material, format!("name = \"m\"\n[index]\nn-d = {n}\n")).expect("writes");
    };
    let write_stone = |cut: &str| {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cuts").join(cut);
        fs::copy(file, &stone).expect("copies");
    };
    let of_all = |stone: String, material: Option<String>| {
        let plain = StoneOptions::default();
        let options = material.map_or(plain.clone(), |material| plain.material(material));
        let request = ReportRequest::new([stone]).options(options);
        request.identity(&request.stones)
    };
    let both = || {
        let own = format!("{}:material={}", named(&stone), named(&material));
        [of_all(named(&stone), Some(named(&material))), of_all(own, None)]
    };
    write_material(1.6);
    write_stone("emerald.toml");
    let first = both();
    assert_eq!(both(), first);
    write_material(1.7);
    let second = both();
    write_stone("eppler.toml");
    let third = both();
    for (before, after) in first.iter().zip(&second).chain(second.iter().zip(&third)) {
        assert_ne!(before, after);
    }
}
