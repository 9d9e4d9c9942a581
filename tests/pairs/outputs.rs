//! What a command writes: every file it was to write and no other, whole, and said where it says so.

use crate::bench::{Inputs, Ran};
use crate::case::Case;
use crate::files;
use crate::oracles::{Fault, fault};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The options that name files or folders to write.
const WRITTEN: [&str; 6] = ["output", "plot", "beams", "diagram", "photon_map", "front"];

/// Faults of files and of standard output.
pub fn faults(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    let mut faults = Vec::new();
    let asked: Vec<&Path> =
        WRITTEN.iter().flat_map(|id| case.values(id)).filter(|n| *n != "-").map(Path::new).collect();
    for name in &asked {
        if !ran.files.keys().any(|path| is_of(name, path)) {
            faults.push(fault("every output is there", name.display().to_string()));
        }
    }
    // commands that have names of their own for what nobody named
    let names_itself = ["generate", "render", "validate"].contains(&case.command.as_str());
    if let Some(path) = ran.files.keys().find(|path| !asked.iter().any(|name| is_of(name, path)))
        && (case.has("output") || !names_itself)
    {
        faults.push(fault("no output that nobody asked for", path.display().to_string()));
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
    faults.extend(standard_output(case, ran, inputs));
    faults
}

/// Faults of standard output.
fn standard_output(case: &Case, ran: &Ran, inputs: &Inputs) -> Option<Fault> {
    if case.streams() {
        let name = Path::new("stdout").with_extension(files::sniffed(&ran.stdout, streamed(case)));
        return files::fault(&name, &ran.stdout, inputs).map(|f| fault("standard output is whole", f));
    }
    if case.has("json") {
        return match serde_json::from_slice::<Value>(&ran.stdout) {
            Err(error) => Some(fault("--json gives JSON", error.to_string())),
            Ok(value) => named(case, &value, ran),
        };
    }
    // what an import has to say is which files it wrote
    let answers = [
        "show",
        "edit",
        "retarget",
        "attribute",
        "list",
        "compare",
        "validate",
        "report",
        "import",
        "completions",
    ]
    .contains(&case.command.as_str())
        && !(case.command == "import" && case.has("quiet"));
    (answers && ran.stdout.is_empty()).then(|| fault("what is asked is answered", "standard output is empty"))
}

/// Whether `path` was written for the name asked for: itself, its sidecar, in it, numbered, or one for
/// each metric or pass.
fn is_of(name: &Path, path: &Path) -> bool {
    let stem = name.file_stem().unwrap_or_default().to_string_lossy();
    let stem = stem.split('%').next().unwrap_or_default();
    let like = path.extension() == name.extension()
        && path.file_name().is_some_and(|n| n.to_string_lossy().starts_with(stem));
    path.starts_with(name) || like || path.as_os_str() == sidecar(name).as_os_str()
}

fn sidecar(table: &Path) -> PathBuf {
    let mut name = table.as_os_str().to_owned();
    name.push(".meta.json");
    name.into()
}

/// What standard output holds when it is a file, as an extension.
pub fn streamed(case: &Case) -> &str {
    match case.command.as_str() {
        // whatever form the parts of a whole have
        "score" | "sweep" | "merge" | "compare" | "attribute" if case.has("json") => "json",
        "score" | "sweep" | "merge" | "compare" | "attribute" => "csv",
        "show" => "svg",
        "render" => "png",
        "man" => "1",
        "generate" => case.values("to").first().copied().unwrap_or("obj"),
        _ => case.values("to").first().copied().unwrap_or("toml"),
    }
}

/// Files that a command says it wrote, against those that are there.
fn named(case: &Case, value: &Value, ran: &Ran) -> Option<Fault> {
    let listed = |value: &Value| -> Vec<PathBuf> {
        value.as_array().into_iter().flatten().filter_map(Value::as_str).map(PathBuf::from).collect()
    };
    let rows = || value.as_array().into_iter().flatten();
    let mut named: Vec<PathBuf> = match case.command.as_str() {
        "render" | "plot" | "man" => listed(value),
        "score" | "sweep" | "merge" | "optimise" => listed(&value["files"]),
        "edit" | "retarget" | "attribute" => value["file"].as_str().map(PathBuf::from).into_iter().collect(),
        "report" if value.is_object() => listed(&value["files"]),
        "report" => rows().flat_map(|report| listed(&report["files"])).collect(),
        "generate" if value.is_object() => listed(&value["files"]),
        "generate" | "import" => rows().filter_map(|row| row["wrote"].as_str()).map(PathBuf::from).collect(),
        _ => return None,
    };
    let is_beside = |path: &Path| {
        let name = path.to_string_lossy();
        name.ends_with(".meta.json") || name.ends_with(".map")
    };
    let mut there: Vec<PathBuf> = ran.files.keys().filter(|path| !is_beside(path)).cloned().collect();
    named.sort();
    there.sort();
    (named != there).then(|| fault("--json names the files", format!("{named:?} for {there:?}")))
}
