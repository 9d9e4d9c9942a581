//! The features of the package: what the library needs without any, and that each names what it adds.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// The most that the library may depend on directly without any feature.
const MOST: usize = 10;

/// Dependencies of the program, of pictures and of threads: none of them may come without a feature.
const OF_FEATURES: [&str; 7] = ["clap", "indicatif", "ctrlc", "resvg", "exr", "image", "rayon"];

/// The files that ask for a feature.
const ASKING: [&str; 10] = [
    "lib.rs",
    "advanced.rs",
    "prelude.rs",
    "parallel.rs",
    "error.rs",
    "materials.rs",
    "color/illuminants/illuminant_file.rs",
    "stone/error.rs",
    "stone/grammar.rs",
    "stone/value.rs",
];

fn manifest() -> Table {
    include_str!("../../Cargo.toml").parse().expect("the manifest is TOML")
}

/// The tables of dependencies that are compiled into the library: of all systems, and of some.
fn dependencies(manifest: &Table) -> impl Iterator<Item = (&String, &Value)> {
    let of_systems = manifest["target"].as_table().into_iter().flat_map(Table::values);
    let tables = [&manifest["dependencies"]].into_iter().chain(of_systems.map(|t| &t["dependencies"]));
    tables.filter_map(Value::as_table).flatten()
}

fn is_optional(dependency: &Value) -> bool {
    dependency.get("optional").and_then(Value::as_bool).unwrap_or(false)
}

#[test]
fn the_library_without_features_needs_little() {
    let manifest = manifest();
    let needed: Vec<&String> =
        dependencies(&manifest).filter(|(_, of)| !is_optional(of)).map(|(name, _)| name).collect();
    assert!(needed.len() <= MOST, "{} direct dependencies: {needed:?}", needed.len());
    for name in OF_FEATURES {
        assert!(!needed.iter().any(|n| *n == name), "{name} is there without a feature");
        assert!(dependencies(&manifest).any(|(n, _)| n == name), "{name} is no dependency any more");
    }
}

/// A dependency that no feature names would never be compiled.
#[test]
fn every_optional_dependency_belongs_to_one_feature() {
    let manifest = manifest();
    let optional: BTreeSet<String> = dependencies(&manifest)
        .filter(|(_, of)| is_optional(of))
        .map(|(name, _)| format!("dep:{name}"))
        .collect();
    let features = manifest["features"].as_table().expect("a table of features");
    let items = features.values().filter_map(Value::as_array).flatten().filter_map(Value::as_str);
    let named: Vec<&str> = items.filter(|item| item.starts_with("dep:")).collect();
    assert_eq!(named.len(), optional.len(), "one of them is named twice, or never");
    assert_eq!(named.into_iter().map(str::to_owned).collect::<BTreeSet<_>>(), optional);
    assert_eq!(features["default"].as_array().map(Vec::len), Some(1), "the default is the program");
    let program: &[Value] = manifest["bin"].as_array().expect("the program");
    assert_eq!(program[0]["required-features"].as_array().map(|f| f[0].as_str()), Some(Some("cli")));
}

fn source(path: &Path) -> String {
    fs::read_to_string(path).expect("a source file is UTF-8")
}

/// The modules that `src/lib.rs` compiles without any feature.
fn modules_without_features() -> Vec<String> {
    let lib = source(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs"));
    let lines: Vec<&str> = lib.lines().collect();
    let is_gated = |i: usize| i > 0 && lines[i - 1].starts_with("#[cfg(feature");
    let module = |line: &str| {
        let line = line.strip_prefix("pub ").unwrap_or(line);
        Some(line.strip_prefix("mod ")?.strip_suffix(';')?.to_owned())
    };
    (0..lines.len()).filter(|&i| !is_gated(i)).filter_map(|i| module(lines[i])).collect()
}

/// Every Rust file at or below a path.
fn rust_files(path: PathBuf) -> Vec<PathBuf> {
    match fs::read_dir(&path) {
        Ok(entries) => entries.flat_map(|e| rust_files(e.expect("can be listed").path())).collect(),
        Err(_) => Some(path).filter(|p| p.extension().is_some_and(|e| e == "rs")).into_iter().collect(),
    }
}

/// A page has no files, no clock that `Instant` would read, and no threads. Files that ask for a feature may
/// name what they have with it.
#[test]
fn the_library_without_features_asks_nothing_of_the_system() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let modules = modules_without_features();
    assert!(modules.iter().any(|m| m == "scoring") && !modules.iter().any(|m| m == "storage"), "{modules:?}");
    for file in modules.iter().flat_map(|m| [src.join(format!("{m}.rs")), src.join(m)]).flat_map(rust_files) {
        if ASKING.iter().any(|asking| file.ends_with(asking)) {
            continue;
        }
        let text = source(&file);
        for word in ["std::fs", "std::env", "std::thread", "std::process", "Instant", "SystemTime"] {
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            assert!(!code.contains(word), "{}: {word}", file.display());
        }
    }
}

/// What depends on a feature is a whole module, one way of doing the loops of `parallel`, or a name that may be
/// a file's.
#[test]
fn features_are_asked_for_in_few_files() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let asks = |file: &PathBuf| source(file).contains("(feature = ");
    let asking: BTreeSet<PathBuf> = rust_files(src.clone()).into_iter().filter(asks).collect();
    assert_eq!(asking, ASKING.iter().map(|file| src.join(file)).collect());
}
