//! Tables read back, and what must hold of their cells.

use cutlab::advanced::metrics::{METRICS, Metric, MetricSource};
use serde_json::Value;
use std::collections::BTreeMap;

/// A row by its columns; cells as text, numbers as JSON and CSV both write them.
pub type Row = BTreeMap<String, String>;

/// The rows of a table of the form that `extension` says.
pub fn rows(bytes: &[u8], extension: &str) -> Result<Vec<Row>, String> {
    if extension == "csv" {
        let mut reader = csv::Reader::from_reader(bytes);
        let head = reader.headers().map_err(|e| e.to_string())?.clone();
        let row = |record: csv::StringRecord| {
            head.iter().map(String::from).zip(record.iter().map(number_as_json)).collect()
        };
        return reader.records().map(|r| r.map(row).map_err(|e| e.to_string())).collect();
    }
    let values: Result<Vec<Value>, _> = match extension {
        "json" => serde_json::from_slice(bytes),
        _ => serde_json::Deserializer::from_slice(bytes).into_iter().collect(),
    };
    values.map_err(|e| e.to_string())?.into_iter().map(object).collect()
}

fn object(value: Value) -> Result<Row, String> {
    let Value::Object(map) = value else { return Err(format!("{value} is no row")) };
    let cell = |v: Value| match v {
        Value::Null => String::new(),
        Value::String(s) => s,
        number => number_as_json(&number.to_string()),
    };
    Ok(map.into_iter().map(|(k, v)| (k, cell(v))).collect())
}

/// A number in one way of writing, other text as it is.
fn number_as_json(cell: &str) -> String {
    cell.parse::<f64>().map_or_else(|_| cell.to_string(), |x| format!("{x:?}"))
}

/// Columns whose cells may be empty where a stone has no such measure, and where nothing is wrong.
const MAY_BE_EMPTY: [&str; 8] = [
    "error",
    "name",
    "width_mm",
    "table_percent",
    "crown_angle_deg",
    "pavilion_angle_deg",
    "carats",
    "weighed_as",
];

/// What is wrong with the cells of a table: empty without a reason, no numbers, outside the range.
pub fn fault(rows: &[Row]) -> Option<String> {
    let of_metric = |row: &Row| METRICS.iter().find_map(|m| cell_fault(row, m));
    rows.iter().find_map(|row| of_metric(row).or_else(|| other_fault(row)))
}

fn has_reason(row: &Row) -> bool {
    row.get("error").is_some_and(|e| !e.is_empty())
}

fn cell_fault(row: &Row, metric: &Metric) -> Option<String> {
    let (cell, error) = (row.get(metric.name)?, row.get(&format!("{}_se", metric.name))?);
    if cell.is_empty() && error.is_empty() {
        return (!has_reason(row)).then(|| format!("{} is empty without a reason", metric.name));
    }
    match (cell.parse::<f64>(), error.parse::<f64>()) {
        (Ok(x), Ok(e)) if x.is_finite() && e.is_finite() && e >= 0.0 => {
            let (from, to) = metric.range;
            let inside = (from..=to).contains(&x);
            (!inside).then(|| format!("{} = {x} is outside {from} to {to}", metric.name))
        }
        _ => Some(format!("{} = {cell} ± {error} is no number", metric.name)),
    }
}

/// Cells that are no scores.
fn other_fault(row: &Row) -> Option<String> {
    let is_score = |column: &str| Metric::by_name(column.trim_end_matches("_se")).is_some();
    row.iter().filter(|(column, _)| !is_score(column)).find_map(|(column, cell)| {
        if cell.is_empty() && !MAY_BE_EMPTY.contains(&column.as_str()) && !has_reason(row) {
            return Some(format!("{column} is empty without a reason"));
        }
        let not_finite = cell.parse::<f64>().is_ok_and(|x| !x.is_finite());
        not_finite.then(|| format!("{column} = {cell} is no number"))
    })
}

/// The score and its error, if the row has them.
fn estimate(row: &Row, metric: &Metric) -> Option<(f64, f64)> {
    let number = |name: &str| row.get(name).and_then(|c| c.parse::<f64>().ok());
    Some((number(metric.name)?, number(&format!("{}_se", metric.name))?))
}

/// An error beyond the one that was asked for, in a row that does not say so.
pub fn too_rough(rows: &[Row], asked: f64) -> Option<String> {
    rows.iter().filter(|row| !has_reason(row)).find_map(|row| {
        METRICS.iter().find_map(|m| {
            let (_, error) = estimate(row, m)?;
            (error > asked * m.scale * (1.0 + 1e-9)).then(|| format!("{} ± {error} for {asked}", m.name))
        })
    })
}

/// Cubes, of which face-up every ray fares alike: their scores are certain.
const CUBES: [&str; 4] = ["cube", "a.asc", "d/one.asc", "-"];

/// A score that is summed over samples, lies between the ends of its range, and is said to be certain.
pub fn certain(rows: &[Row]) -> Option<String> {
    let sampled = || METRICS.iter().filter(|m| !matches!(m.read_from, MetricSource::Solid(_)));
    let is_cube = |row: &&Row| row.get("stone").is_some_and(|stone| CUBES.contains(&stone.as_str()));
    rows.iter().filter(|row| !is_cube(row)).find_map(|row| {
        sampled().find_map(|m| {
            let (value, error) = estimate(row, m)?;
            (error == 0.0 && m.range.0 < value && value < m.range.1)
                .then(|| format!("{} = {value} ± 0", m.name))
        })
    })
}

/// The scores and differences of `compare --json` as rows of its CSV.
pub fn of_comparison(entries: &Value) -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for entry in entries.as_array().ok_or("no list")? {
        let listed = |key: &str| entry[key].as_array().cloned().unwrap_or_default();
        for (list, value, error) in
            [("scores", "value", "value_se"), ("differences", "difference", "difference_se")]
        {
            for said in listed(list) {
                let mut row = object(said)?;
                row.remove("from");
                for (from, to) in [("value", value), ("error", error)] {
                    let cell = row.remove(from).unwrap_or_default();
                    row.insert(to.into(), cell);
                }
                if let Some(cell) = row.get_mut("significant") {
                    *cell = match cell.as_str() {
                        "true" => "yes".into(),
                        "false" => "no".into(),
                        _ => String::new(),
                    };
                }
                row.insert("metric".into(), entry["metric"].as_str().unwrap_or_default().into());
                row.insert("unit".into(), entry["unit"].as_str().unwrap_or_default().into());
                rows.push(row);
            }
        }
    }
    Ok(rows)
}

/// Whether `whole` has every cell of `part`, numbers to the nine decimals of a table.
pub fn is_part(part: &Row, whole: &Row) -> bool {
    part.iter().all(|(column, cell)| {
        let other = whole.get(column).map_or("", String::as_str);
        cell == other
            || matches!((cell.parse::<f64>(), other.parse::<f64>()), (Ok(a), Ok(b)) if (a - b).abs() < 1e-9)
    })
}

/// What differs between the row of a report's `scores.csv` and what `--json` says of the report.
pub fn differs_from_report(row: &Row, summary: &Value) -> Option<String> {
    let sections = summary["scores"].as_object()?;
    METRICS.iter().find_map(|m| {
        let said = sections.values().find_map(|scores| scores.get(m.name));
        let Some(said) = said else { return Some(format!("{} is not in --json", m.name)) };
        let number = |key: &str| said[key].as_f64();
        match (estimate(row, m), number("value").zip(number("error"))) {
            (Some((x, e)), Some((y, f))) if (x - y).abs() < 1e-9 && (e - f).abs() < 1e-9 => None,
            (None, None) if summary["left_out"][m.name].is_string() => None,
            (csv, json) => Some(format!("{}: {csv:?} in CSV, {json:?} in JSON", m.name)),
        }
    })
}

/// What directions in single precision may be off by, in radians or degrees.
const ROUNDING: f64 = 1e-5;

/// What each way of computing gives up itself: of beams and of photons no common value.
const GIVEN_UP: &str = "lost";

/// What differs between tables of the same stones and metrics by beams and by photons: more than five
/// errors, or a cell that one of them has.
pub fn disagreement(beams: &[Row], photons: &[Row]) -> Option<String> {
    if beams.len() != photons.len() {
        return Some("different numbers of rows".into());
    }
    beams.iter().zip(photons).find_map(|(a, b)| {
        let both = || METRICS.iter().filter(|m| m.name != GIVEN_UP);
        both().find_map(|m| match (estimate(a, m), estimate(b, m)) {
            (Some((x, e)), Some((y, f))) => {
                let apart = (x - y).abs() > 5.0 * e.hypot(f) + ROUNDING * m.scale;
                apart.then(|| format!("{}: {x} ± {e} by beams, {y} ± {f} by photons", m.name))
            }
            (None, None) => None,
            (Some(_), None) => Some(format!("{} by beams alone", m.name)),
            (None, Some(_)) => Some(format!("{} by photons alone", m.name)),
        })
    })
}

#[test]
fn tables_of_every_form_read_alike_and_their_faults_are_seen() {
    let csv = rows(b"stone,iso,iso_se,error\ncube,1.50,0,\n", "csv").expect("reads");
    let json =
        rows(b"[{\"stone\":\"cube\",\"iso\":1.5,\"iso_se\":0.0,\"error\":null}]", "json").expect("reads");
    assert_eq!(csv, json);
    assert_eq!(fault(&csv), None);
    for (cells, word) in [(",", "without a reason"), ("NaN,0", "no number"), ("101,0", "outside")] {
        let bad = rows(format!("stone,iso,iso_se,error\ncube,{cells},\n").as_bytes(), "csv").expect("reads");
        assert!(fault(&bad).is_some_and(|f| f.contains(word)), "{cells}");
    }
    let error = |asked: f64| too_rough(&rows(b"iso,iso_se,error\n1.5,0.3,\n", "csv").expect("reads"), asked);
    assert_eq!((error(0.003), error(0.002).is_some()), (None, true));
    assert_eq!(certain(&csv), None);
    let oval = rows(b"stone,iso,iso_se,error\noval,1.5,0,\n", "csv").expect("reads");
    assert!(certain(&oval).is_some_and(|f| f.contains("iso")));
    assert_eq!(certain(&rows(b"iso,iso_se,spread,spread_se\n0,0,1.1,0\n", "csv").expect("reads")), None);
}

#[test]
fn beams_and_photons_differ_by_five_of_their_errors() {
    let of = |cells: &str| rows(format!("iso,iso_se,error\n{cells},\n").as_bytes(), "csv").expect("reads");
    let beams = of("50,0");
    for (photons, differ) in [("50.4,0.1", false), ("50.6,0.1", true), ("50.6,0.2", false), (",", true)] {
        assert_eq!(disagreement(&beams, &of(photons)).is_some(), differ, "{photons}");
    }
    assert!(disagreement(&beams, &[]).is_some());
}

#[test]
fn comparisons_are_rows_and_parts_of_others() {
    let json = serde_json::json!([{
        "metric": "iso", "unit": "%",
        "scores": [{"stone": "cube", "material": "diamond", "value": 1.5000000001, "error": 0.1}],
        "differences": [{"stone": "b", "from": "cube", "value": 2.0, "error": 0.1, "significant": true}],
    }]);
    let made = of_comparison(&json).expect("reads");
    let csv = |value: &str, significant: &str| {
        let text = format!(
            "metric,unit,stone,material,value,value_se,difference,difference_se,significant,left_out\n\
             iso,%,cube,diamond,{value},0.1,,,,\niso,%,b,diamond,3.5,0.1,2,0.1,{significant},\n"
        );
        rows(text.as_bytes(), "csv").expect("reads")
    };
    let held = |value: &str, significant: &str| {
        made.iter().all(|row| csv(value, significant).iter().any(|other| is_part(row, other)))
    };
    assert!(held("1.5", "yes"));
    assert!(!held("1.6", "yes") && !held("1.5", "no"));
}
