//! What must hold of every command.

use crate::bench::{Bench, Inputs, Ran};
use crate::case::Case;
use crate::files;
use crate::tables::{self, Row};
use std::path::{Path, PathBuf};

/// What came of a case.
#[derive(Debug, PartialEq)]
pub enum Verdict {
    /// All holds.
    Good,
    /// Refused at once, with one line and nothing done.
    Refused,
    /// What does not hold.
    Bad(Vec<Fault>),
}

/// Something that does not hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// What should.
    pub oracle: &'static str,
    /// What was found.
    pub found: String,
}

fn fault(oracle: &'static str, found: impl Into<String>) -> Fault {
    Fault { oracle, found: found.into() }
}

/// Runs a case and what belongs to it, and judges it.
pub fn judge(case: &Case, inputs: &Inputs) -> Verdict {
    let bench = Bench::new(inputs);
    let ran = bench.run(&case.words(), 1);
    let mut faults = ends(case, &ran);
    if ran.code == Some(2) && faults.is_empty() {
        return Verdict::Refused;
    }
    if !matches!(ran.code, Some(0 | 1)) {
        return Verdict::Bad(faults);
    }
    faults.extend(written(case, &ran, inputs));
    faults.extend(repeated(case, &ran, inputs));
    if case.makes_table() {
        faults.extend(table(case, &ran, inputs));
    }
    if faults.is_empty() { Verdict::Good } else { Verdict::Bad(faults) }
}

/// How a command ends: exit code, what it says, what it leaves.
fn ends(case: &Case, ran: &Ran) -> Vec<Fault> {
    let mut faults = Vec::new();
    let said = ran.stderr.trim();
    if ran.code.is_none() {
        faults.push(fault("it ends", "it did not"));
    }
    if said.contains("panicked") {
        faults.push(fault("no panic", said));
    }
    // one stone of a table may have no score, which its row explains
    let explained = ran.code == Some(1) && case.makes_table();
    if !matches!(ran.code, None | Some(0 | 2)) && !explained {
        faults.push(fault("exit code 0 or 2", format!("{:?}: {said}", ran.code)));
    }
    if ran.code == Some(2) {
        // what failed of several may be told as JSON instead
        let told = case.has("json") && serde_json::from_slice::<serde_json::Value>(&ran.stdout).is_ok();
        if !told && (said.lines().count() != 1 || !said.starts_with("cutlab: ")) {
            faults.push(fault("a refusal is one line", said));
        }
        if !ran.files.is_empty() || !(told || ran.stdout.is_empty()) {
            faults.push(fault("a refusal does nothing", format!("{said}: {:?}", ran.files.keys())));
        }
    }
    if ran.code == Some(0) && case.has("quiet") && !said.is_empty() {
        faults.push(fault("quiet is silent", said));
    }
    let hidden = |path: &&PathBuf| path.iter().any(|part| part.as_encoded_bytes().starts_with(b"."));
    if let Some(left) = ran.files.keys().find(hidden) {
        faults.push(fault("nothing is left behind", left.display().to_string()));
    }
    if let Some(harmed) = ran.harmed.first() {
        faults.push(fault("inputs are left alone", harmed.display().to_string()));
    }
    faults
}

/// The files that a command was to write, and its standard output.
fn written(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    let mut faults = Vec::new();
    for id in ["output", "plot", "beams", "diagram", "photon_map"] {
        for name in case.values(id).into_iter().filter(|n| *n != "-") {
            if !is_there(Path::new(name), ran) {
                faults.push(fault("every output is there", name));
            }
        }
    }
    for (name, bytes) in &ran.files {
        // a part of a small table may have no rows, and JSON lines have no head
        let no_rows = bytes.is_empty() && case.has("shard");
        if let Some(found) = files::fault(name, bytes, inputs).filter(|_| !no_rows) {
            faults.push(fault("every output is whole", format!("{}: {found}", name.display())));
        }
        let width = case.values("width").first().and_then(|w| w.parse::<u32>().ok());
        if case.command == "render" && width.is_some() && name.extension().is_some_and(|e| e != "map") {
            let of = files::size(bytes).map(|(w, _)| w);
            if of.is_some() && of != width {
                faults.push(fault("pictures have the size asked for", format!("{} {of:?}", name.display())));
            }
        }
    }
    if case.streams() {
        let name = Path::new("stdout").with_extension(files::sniffed(&ran.stdout, streamed(case)));
        if let Some(found) = files::fault(&name, &ran.stdout, inputs) {
            faults.push(fault("standard output is whole", found));
        }
    } else if case.has("json") {
        match serde_json::from_slice::<serde_json::Value>(&ran.stdout) {
            Err(error) => faults.push(fault("--json gives JSON", error.to_string())),
            Ok(value) => faults.extend(named(case, &value, ran)),
        }
    }
    faults
}

/// Whether what is named was written: itself, numbered, or one for each metric.
fn is_there(name: &Path, ran: &Ran) -> bool {
    let stem = name.file_stem().unwrap_or_default().to_string_lossy();
    let stem = stem.split('%').next().unwrap_or_default();
    let like = |path: &PathBuf| {
        path.extension() == name.extension()
            && path.file_name().is_some_and(|n| n.to_string_lossy().starts_with(stem))
    };
    ran.files.keys().any(|path| path == name || path.starts_with(name) || like(path))
}

/// What standard output holds when it is a file, as an ending.
fn streamed(case: &Case) -> &str {
    match case.command.as_str() {
        // whatever form the parts of a whole have
        "score" | "sweep" | "merge" if case.has("json") => "json",
        "score" | "sweep" | "merge" => "csv",
        "show" => "svg",
        "render" => "png",
        "generate" => case.values("to").first().copied().unwrap_or("obj"),
        _ => case.values("to").first().copied().unwrap_or("toml"),
    }
}

/// Files that a command says it wrote, against those that are there.
fn named(case: &Case, value: &serde_json::Value, ran: &Ran) -> Vec<Fault> {
    if case.command != "render" {
        return Vec::new();
    }
    let names = value.as_array().into_iter().flatten().filter_map(|v| v.as_str()).map(PathBuf::from);
    let (mut named, mut there): (Vec<PathBuf>, Vec<PathBuf>) = (
        names.collect(),
        ran.files.keys().filter(|p| p.extension().is_none_or(|e| e != "map")).cloned().collect(),
    );
    named.sort();
    there.sort();
    if named == there {
        Vec::new()
    } else {
        vec![fault("--json names the files", format!("{value} for {there:?}"))]
    }
}

/// The same on two threads, and again in the same folder.
fn repeated(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    let mut faults = Vec::new();
    let bench = Bench::new(inputs);
    let two = bench.run(&case.words(), 2);
    if (two.code, &two.stdout, &two.files) != (ran.code, &ran.stdout, &ran.files) {
        faults.push(fault("the same on two threads", differing(ran, &two)));
    }
    let again = bench.run(&case.words(), 2);
    let says_what_it_did = case.command == "import"; // which files were there already
    let same_words = says_what_it_did || again.stdout == two.stdout;
    if (again.code, &again.files) != (two.code, &two.files) || !same_words {
        faults.push(fault("the same again", format!("{} {}", differing(&two, &again), again.stderr.trim())));
    }
    faults
}

fn differing(one: &Ran, two: &Ran) -> String {
    let names = one.files.keys().chain(two.files.keys());
    let file = names.into_iter().find(|name| one.files.get(*name) != two.files.get(*name));
    let stdout = if one.stdout == two.stdout { "" } else { ", standard output" };
    format!("{:?} {:?}, file {file:?}{stdout}", one.code, two.code)
}

/// Tables: cells, the same numbers in every form, beams and photons, shards and the whole.
fn table(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    let mut faults = Vec::new();
    let (bytes, ending) = match case.values("output").first() {
        Some(name) if *name != "-" => {
            let ending = Path::new(*name).extension().and_then(|e| e.to_str()).unwrap_or("csv");
            (ran.files.get(Path::new(*name)), ending)
        }
        _ => (Some(&ran.stdout), streamed(case)),
    };
    let Some(bytes) = bytes else { return faults };
    let rows = match tables::rows(bytes, ending) {
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
    if case.command == "merge" {
        return faults;
    }
    let plain = case.with("output", &[]).with("plot", &[]).with("json", &[]);
    let printed = |case: &Case| -> Result<Vec<Row>, String> {
        let ran = Bench::new(inputs).run(&case.words(), 2);
        tables::rows(&ran.stdout, "csv")
    };
    match printed(&plain) {
        Ok(csv) if csv == rows => (),
        Ok(_) => faults.push(fault("the same numbers in every form", format!("{ending} and CSV differ"))),
        Err(error) => faults.push(fault("the same numbers in every form", error)),
    }
    if case.has("exact") {
        match printed(&plain.with("exact", &[])) {
            Ok(photons) => {
                let found = tables::disagreement(&rows, &photons);
                faults.extend(found.map(|found| fault("beams agree with photons", found)));
            }
            Err(error) => faults.push(fault("beams agree with photons", error)),
        }
    }
    if let (Some(shard), Some(name)) = (case.values("shard").first(), case.values("output").first())
        && *name != "-"
    {
        faults.extend(joined(case, shard, name, inputs));
    }
    faults
}

/// The parts of a table, merged, against the whole.
fn joined(case: &Case, shard: &str, name: &str, inputs: &Inputs) -> Option<Fault> {
    let wrong = |found: String| Some(fault("shards joined are the whole", found));
    let of: u32 = shard.split('/').nth(1)?.parse().ok()?;
    let ending = Path::new(name).extension()?.to_str()?;
    let whole = Bench::new(inputs).run(&case.with("shard", &[]).words(), 2);
    let bench = Bench::new(inputs);
    let mut merge = vec!["merge".to_string()];
    for i in 1..=of {
        let part = format!("part{i}.{ending}");
        let (shard, output) = (format!("{i}/{of}"), part.clone());
        let ran = bench
            .run(&case.with("shard", &["--shard", &shard]).with("output", &["--output", &output]).words(), 2);
        if !matches!(ran.code, Some(0 | 1)) {
            return wrong(format!("part {i}: {}", ran.stderr.trim()));
        }
        merge.push(part);
    }
    merge.extend(["-o".into(), name.into()]);
    let ran = bench.run(&merge, 2);
    let same = whole.files.iter().all(|(path, bytes)| ran.files.get(path) == Some(bytes));
    if same && ran.code == whole.code {
        return None;
    }
    wrong(format!("{:?} for {:?}: {}", ran.code, whole.code, ran.stderr.trim()))
}
