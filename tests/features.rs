//! The features of the package: what the library needs without any, and that each names what it adds.

use std::collections::BTreeSet;
use toml::{Table, Value};

/// The most that the library may depend on directly without any feature.
const MOST: usize = 10;

/// Dependencies of the program, of pictures and of threads: none of them may come without a feature.
const OF_FEATURES: [&str; 7] = ["clap", "indicatif", "ctrlc", "resvg", "exr", "image", "rayon"];

fn manifest() -> Table {
    include_str!("../Cargo.toml").parse().expect("the manifest is TOML")
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
