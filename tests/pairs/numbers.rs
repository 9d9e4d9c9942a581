//! The numbers of a command: the same in every form, in parts and as a whole, by beams and by photons.

use crate::bench::{Bench, Inputs, Ran, WHOLE};
use crate::case::Case;
use crate::oracles::{Fault, fault};
use crate::outputs::streamed;
use crate::tables::{self, Row};
use serde_json::Value;
use std::path::Path;

/// Beams are compared with photons of this error, in hundredths of a metric's scale: the less, the more
/// it says.
const FINE: &str = "0.01";

/// Faults of all numbers.
pub fn faults(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    match case.command.as_str() {
        "score" | "sweep" | "merge" => table(case, ran, inputs),
        "compare" => compared(case, ran, inputs),
        "report" => reported(case, ran),
        "validate" => validated(case, ran).into_iter().collect(),
        _ => Vec::new(),
    }
}

/// The rows that were printed, or what is wrong with them.
fn printed(case: &Case, inputs: &Inputs) -> Result<Vec<Row>, String> {
    let ran = Bench::once(inputs, &case.words(), 2);
    tables::rows(&ran.stdout, "csv").map_err(|e| format!("{e}: {}", ran.stderr.trim()))
}

/// Tables: cells, errors, the same numbers in every form, beams and photons, shards and the whole.
fn table(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    let mut faults = Vec::new();
    let name = case.values("output").first().copied().filter(|name| *name != "-").map(Path::new);
    let (bytes, extension) = match name {
        Some(name) => (ran.files.get(name), name.extension().and_then(|e| e.to_str()).unwrap_or("csv")),
        None => (Some(&ran.stdout), streamed(case)),
    };
    let Some(bytes) = bytes else { return faults };
    let rows = match tables::rows(bytes, extension) {
        Ok(rows) if rows.iter().all(|r| r.contains_key("error")) && !rows.is_empty() => rows,
        // a shard of a small table may have no rows
        Ok(rows) if rows.is_empty() && case.has("shard") => rows,
        Ok(_) => return vec![fault("a table has rows and reasons", "no rows, or no column 'error'")],
        Err(error) => return vec![fault("a table is read back", error)],
    };
    faults.extend(tables::fault(&rows).map(|found| fault("no cell without its reason", found)));
    if ran.code == Some(1) && rows.iter().all(|r| r["error"].is_empty()) {
        faults.push(fault("exit code 0 or 2", "1 without an error in any row"));
    }
    if let Some(name) = name {
        faults.extend(sidecar(name, bytes, &rows, ran));
    }
    if case.command == "merge" {
        faults.extend(whole(case, &rows, inputs));
        return faults;
    }
    let asked = case.values("error").first().and_then(|e| e.parse().ok());
    let found = asked.and_then(|asked| tables::too_rough(&rows, asked));
    faults.extend(found.map(|found| fault("the error asked for is reached, or not with a reason", found)));
    if !case.has("exact") {
        let found = tables::certain(&rows);
        faults.extend(found.map(|found| fault("what is sampled has an error", found)));
    }
    // a plot of --tilt asks for a second axis, and so for more rows
    let silent: &[&str] = match case.command.as_str() {
        "score" => &["output", "json"],
        _ => &["output", "json", "plot", "title", "range", "pixels", "colours"],
    };
    let plain = case.without(silent);
    match printed(&plain, inputs) {
        Ok(csv) if csv == rows => (),
        Ok(_) => faults.push(fault("the same numbers in every form", format!("{extension} and CSV differ"))),
        Err(error) => faults.push(fault("the same numbers in every form", error)),
    }
    if case.has("exact") {
        let photons = plain.without(&["exact"]).with("error", &["--error", FINE]);
        // a sorted table may have equal rows the other way round
        let in_order = |case: &Case| case.without(&["sort", "top"]);
        let pair =
            printed(&in_order(&plain), inputs).and_then(|b| Ok((b, printed(&in_order(&photons), inputs)?)));
        let found = pair.map_or_else(Some, |(beams, photons)| tables::disagreement(&beams, &photons));
        faults.extend(found.map(|found| fault("beams agree with photons", found)));
    }
    if let (Some(shard), Some(name)) = (case.values("shard").first(), name) {
        let found = joined(case, shard, name, inputs);
        faults.extend(found.map(|found| fault("shards joined are the whole", found)));
    }
    faults
}

/// What the sidecar of a table says of it, against what it is.
fn sidecar(table: &Path, bytes: &[u8], rows: &[Row], ran: &Ran) -> Option<Fault> {
    let wrong = |found: String| Some(fault("the sidecar is of its table", found));
    let name = format!("{}.meta.json", table.display());
    let Some(meta) = ran.files.get(Path::new(&name)) else { return wrong(format!("no {name}")) };
    let meta: Value = match serde_json::from_slice(meta) {
        Ok(meta) => meta,
        Err(error) => return wrong(error.to_string()),
    };
    let mut columns: Vec<&str> = meta["columns"].as_array()?.iter().filter_map(Value::as_str).collect();
    columns.sort_unstable();
    if let Some(row) = rows.iter().find(|row| !row.keys().eq(&columns)) {
        return wrong(format!("columns {:?}", row.keys()));
    }
    let said = (&meta["rows"], &meta["crc32"]);
    let found = (rows.len().into(), format!("{:08x}", crc32fast::hash(bytes)).into());
    if said != (&found.0, &found.1) { wrong(format!("{said:?} for {found:?}")) } else { None }
}

/// A table joined of parts, against the whole; of a sweep the parts are two of its own.
fn whole(case: &Case, rows: &[Row], inputs: &Inputs) -> Option<Fault> {
    let of_sweep = case.values("parts").iter().any(|part| part.starts_with('v'));
    let whole = Path::new(if of_sweep { "w.csv" } else { WHOLE });
    let whole = inputs.rows(whole);
    (whole != rows).then(|| fault("shards joined are the whole", "the rows of the whole are others"))
}

/// What differs between the parts of a table, merged, and the whole.
fn joined(case: &Case, shard: &str, name: &Path, inputs: &Inputs) -> Option<String> {
    let of: u32 = shard.split('/').nth(1)?.parse().ok()?;
    let extension = name.extension()?.to_str()?;
    let whole = Bench::once(inputs, &case.without(&["shard"]).words(), 2);
    let bench = Bench::new(inputs, &case.words());
    let mut merge = vec!["merge".to_string()];
    for i in 1..=of {
        let part = format!("part{i}.{extension}");
        let (shard, output) = (format!("{i}/{of}"), part.clone());
        let case = case.with("shard", &["--shard", &shard]).with("output", &["--output", &output]);
        let ran = bench.run(&case.words(), 2);
        if !matches!(ran.code, Some(0 | 1)) {
            return Some(format!("part {i}: {}", ran.stderr.trim()));
        }
        merge.push(part);
    }
    merge.extend(["-o".into(), name.display().to_string()]);
    let ran = bench.run(&merge, 2);
    let same = whole.files.iter().all(|(path, bytes)| ran.files.get(path) == Some(bytes));
    if same && ran.code == whole.code {
        return None;
    }
    Some(format!("{:?} for {:?}: {}", ran.code, whole.code, ran.stderr.trim()))
}

/// A comparison: what `--json` prints against the CSV, metric by metric and stone by stone, and each cell
/// with a number or a reason.
fn compared(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    let wrong = |found: String| vec![fault("the same numbers in every form", found)];
    if ran.code == Some(1) && ran.stderr.is_empty() {
        return vec![fault("exit code 0 or 2", "1 and nothing said")];
    }
    if case.is_dear() && !case.has("json") {
        return Vec::new();
    }
    let plain = case.without(&["output", "json", "width"]);
    let csv = match case.values("output").first() {
        Some(name) if name.ends_with(".csv") => {
            ran.files.get(Path::new(*name)).map_or_else(|| Err("no table".into()), |b| tables::rows(b, "csv"))
        }
        _ => printed(&plain.with("output", &["--output", "-"]), inputs),
    };
    let csv = match csv {
        Ok(rows) if !rows.is_empty() => rows,
        Ok(_) => return wrong("no rows".into()),
        Err(error) => return wrong(error),
    };
    let mut faults = Vec::new();
    let empty = |row: &&Row| row.get("value").is_none_or(String::is_empty);
    let unexplained = |row: &&Row| row.get("left_out").is_none_or(String::is_empty);
    if let Some(row) = csv.iter().filter(empty).find(unexplained) {
        faults.push(fault("no cell without its reason", format!("{} of {}", row["metric"], row["stone"])));
    }
    let json = match case.has("json") && !case.streams() {
        true => ran.stdout.clone(),
        false => Bench::once(inputs, &plain.with("json", &["--json"]).words(), 2).stdout,
    };
    match serde_json::from_slice(&json).map_err(|e| e.to_string()).and_then(|v| tables::of_comparison(&v)) {
        Ok(rows) if rows.is_empty() => faults.extend(wrong("JSON has no rows".into())),
        Ok(rows) => {
            let missing = rows.iter().find(|row| !csv.iter().any(|c| tables::is_part(row, c)));
            faults
                .extend(missing.into_iter().flat_map(|row| wrong(format!("JSON has {row:?}, CSV has not"))));
        }
        Err(error) => faults.extend(wrong(error)),
    }
    faults
}

/// Reports: each `scores.csv` has the numbers of `--json`, and reasons for what it has not.
fn reported(case: &Case, ran: &Ran) -> Vec<Fault> {
    let mut faults = Vec::new();
    let tables = ran.files.iter().filter(|(path, _)| path.ends_with("scores.csv"));
    let json: Value = serde_json::from_slice(&ran.stdout).unwrap_or_default();
    let one = std::slice::from_ref(&json);
    let summaries: &[Value] = if json.is_object() { one } else { json.as_array().map_or(&[], |all| all) };
    for (path, bytes) in tables {
        let rows = match tables::rows(bytes, "csv") {
            Ok(rows) if rows.len() == 1 => rows,
            other => {
                faults.push(fault("a table is read back", format!("{}: {other:?}", path.display())));
                continue;
            }
        };
        faults.extend(tables::fault(&rows).map(|found| fault("no cell without its reason", found)));
        faults.extend(tables::certain(&rows).map(|found| fault("what is sampled has an error", found)));
        if !case.has("json") {
            continue;
        }
        let folder = path.parent().and_then(Path::to_str);
        let found = match summaries.iter().find(|s| s["folder"].as_str() == folder) {
            Some(summary) => tables::differs_from_report(&rows[0], summary),
            None => Some(format!("--json has no {folder:?}")),
        };
        faults.extend(found.map(|found| fault("the same numbers in every form", found)));
    }
    faults
}

/// A validation: `validation.csv` has the numbers of `--json`, or standard output their count.
fn validated(case: &Case, ran: &Ran) -> Option<Fault> {
    let wrong = |found: String| Some(fault("the same numbers in every form", found));
    let (_, table) = ran.files.iter().find(|(path, _)| path.ends_with("validation.csv"))?;
    let rows = match tables::rows(table, "csv") {
        Ok(rows) => rows,
        Err(error) => return wrong(error),
    };
    if !case.has("json") {
        let said = String::from_utf8_lossy(&ran.stdout).into_owned();
        let passed = format!("{} passed", rows.iter().filter(|row| row["verdict"] == "passed").count());
        return if said.contains(&passed) { None } else { wrong(format!("{passed}: {said}")) };
    }
    let listed = tables::rows(&ran.stdout, "json");
    match listed {
        Ok(listed) if listed.len() == rows.len() => {
            let other = |(a, b): &(&Row, &Row)| !tables::is_part(a, b) && !tables::is_part(b, a);
            let other = rows.iter().zip(&listed).find(other);
            other.and_then(|(a, b)| wrong(format!("{a:?} in CSV, {b:?} in JSON")))
        }
        Ok(listed) => wrong(format!("{} rows in CSV, {} in JSON", rows.len(), listed.len())),
        Err(error) => wrong(error),
    }
}
