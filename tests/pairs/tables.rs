//! Tables read back, and what must hold of their cells.

use cutlab::metrics::METRICS;
use std::collections::BTreeMap;

/// A row by its columns; cells as text, numbers as JSON and CSV both write them.
pub type Row = BTreeMap<String, String>;

/// The rows of a table of the form that `ending` says.
pub fn rows(bytes: &[u8], ending: &str) -> Result<Vec<Row>, String> {
    if ending == "csv" {
        let mut reader = csv::Reader::from_reader(bytes);
        let head = reader.headers().map_err(|e| e.to_string())?.clone();
        let row = |record: csv::StringRecord| {
            head.iter().map(String::from).zip(record.iter().map(number_as_json)).collect()
        };
        return reader.records().map(|r| r.map(row).map_err(|e| e.to_string())).collect();
    }
    let values: Result<Vec<serde_json::Value>, _> = match ending {
        "json" => serde_json::from_slice(bytes),
        _ => serde_json::Deserializer::from_slice(bytes).into_iter().collect(),
    };
    values.map_err(|e| e.to_string())?.into_iter().map(object).collect()
}

fn object(value: serde_json::Value) -> Result<Row, String> {
    let serde_json::Value::Object(map) = value else { return Err(format!("{value} is no row")) };
    let cell = |v: serde_json::Value| match v {
        serde_json::Value::Null => String::new(),
        serde_json::Value::String(s) => s,
        number => number_as_json(&number.to_string()),
    };
    Ok(map.into_iter().map(|(k, v)| (k, cell(v))).collect())
}

/// A number in one way of writing, other text as it is.
fn number_as_json(cell: &str) -> String {
    cell.parse::<f64>().map_or_else(|_| cell.to_string(), |x| format!("{x:?}"))
}

/// What is wrong with the cells of a table: empty without a reason, no numbers, outside the range.
pub fn fault(rows: &[Row]) -> Option<String> {
    let in_row = |row: &Row| METRICS.iter().find_map(|m| cell_fault(row, m));
    rows.iter().find_map(in_row)
}

fn cell_fault(row: &Row, metric: &cutlab::metrics::Metric) -> Option<String> {
    let (cell, error) = (row.get(metric.name)?, row.get(&format!("{}_se", metric.name))?);
    if cell.is_empty() && error.is_empty() {
        let has_reason = row.get("error").is_some_and(|e| !e.is_empty());
        return (!has_reason).then(|| format!("{} is empty without a reason", metric.name));
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

/// What directions in single precision may be off by, in radians or degrees.
const ROUNDING: f64 = 1e-5;

/// What differs between tables of the same stones and metrics by beams and by photons: more than five
/// errors, or a cell that one of them has.
pub fn disagreement(beams: &[Row], photons: &[Row]) -> Option<String> {
    if beams.len() != photons.len() {
        return Some("different numbers of rows".into());
    }
    beams.iter().zip(photons).find_map(|(a, b)| {
        METRICS.iter().find_map(|m| {
            let of = |row: &Row| {
                let number = |name: &str| row.get(name).and_then(|c| c.parse::<f64>().ok());
                Some((number(m.name)?, number(&format!("{}_se", m.name))?))
            };
            match (of(a), of(b)) {
                (Some((x, e)), Some((y, f))) => {
                    let apart = (x - y).abs() > 5.0 * e.hypot(f) + ROUNDING * m.scale;
                    apart.then(|| format!("{}: {x} ± {e} by beams, {y} ± {f} by photons", m.name))
                }
                (None, None) => None,
                (Some(_), None) => Some(format!("{} by beams alone", m.name)),
                (None, Some(_)) => Some(format!("{} by photons alone", m.name)),
            }
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
    let near = rows(b"stone,iso,iso_se,error\ncube,1.9,0.1,\n", "csv").expect("reads");
    let far = rows(b"stone,iso,iso_se,error\ncube,2.1,0.1,\n", "csv").expect("reads");
    assert_eq!((disagreement(&csv, &near), disagreement(&csv, &far).is_some()), (None, true));
}
