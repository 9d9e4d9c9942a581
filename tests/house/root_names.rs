//! Every name of the root has an example that runs.

use crate::layers::{code, sources};

/// The names that `src/lib.rs` re-exports of its own modules.
fn root_names(lib: &str) -> Vec<String> {
    let code = code(lib);
    let statements = code.split(';').filter_map(|s| s.split_once("pub use ").map(|(_, path)| path));
    let own = statements.filter(|path| path.contains("::"));
    let names = own.flat_map(|path| {
        let list = path.rsplit("::").next().unwrap_or_default();
        list.trim_matches(|c| "{} \n".contains(c)).split(',').map(|name| name.trim().to_owned())
    });
    names.filter(|name| !name.is_empty()).collect()
}

/// The doc comments above the definitions of a public item.
fn doc_comments(text: &str, item: &str) -> Vec<String> {
    const KINDS: [&str; 5] = ["struct", "enum", "trait", "static", "fn"];
    let lines: Vec<&str> = text.lines().collect();
    let defines = |line: &str| {
        KINDS.iter().any(|kind| {
            let rest = line.strip_prefix(&format!("pub {kind} {item}"));
            rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
        })
    };
    let above = |i: usize| {
        let end = lines[..i].iter().rposition(|line| line.starts_with("///")).map_or(0, |last| last + 1);
        let start = lines[..end].iter().rposition(|line| !line.starts_with("///")).map_or(0, |last| last + 1);
        lines[start..end].join("\n")
    };
    (0..lines.len()).filter(|i| defines(lines[*i])).map(above).collect()
}

#[test]
fn every_name_of_the_root_has_an_example() {
    let sources = sources();
    let lib = sources.iter().find(|(path, _)| path.ends_with("src/lib.rs")).expect("is there");
    let names = root_names(&lib.1);
    assert!(names.len() > 40 && names.contains(&"Stone".into()) && names.contains(&"Illuminant".into()));
    for name in names {
        let docs: Vec<String> = sources.iter().flat_map(|(_, text)| doc_comments(text, &name)).collect();
        assert_eq!(docs.len(), 1, "{name} is defined once");
        assert!(docs[0].contains("/// ```"), "{name} has no example");
        for line in docs[0].lines().filter(|line| line.starts_with("/// ```")) {
            assert!(matches!(line, "/// ```" | "/// ```no_run"), "{name}: examples are run: {line}");
        }
    }
}

#[test]
fn the_check_of_examples_sees_lists_and_comments() {
    let lib = "pub use glam;\npub use a::{\n    B, C,\n};\npub use d::e::F;";
    assert_eq!(root_names(lib), ["B", "C", "F"]);
    let text = "/// Of C.\n#[derive(Debug)]\npub struct C;\n\n/// Of B.\n///\n/// ```\npub struct B {}\npub struct Bb;";
    assert_eq!(doc_comments(text, "B"), ["/// Of B.\n///\n/// ```"]);
    assert_eq!(doc_comments(text, "C"), ["/// Of C."]);
}
