//! No two files import each other, directly or round a ring. An item counts as imported from the file
//! that defines it, whichever `pub use` it is reached by; a file's own tests may look anywhere.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Module = Vec<String>;

#[derive(Default)]
struct Source {
    /// Text without comments, tests and `use`.
    body: String,
    /// Names that the file defines.
    items: BTreeSet<String>,
    /// Modules that it declares.
    children: BTreeSet<String>,
    /// What it brings into scope: the name, and the path as written.
    uses: Vec<(String, Module)>,
}

fn words(path: &str) -> Module {
    path.split("::").map(|word| word.trim().to_owned()).collect()
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder can be listed") {
        let path = entry.expect("the folder can be listed").path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The leaves of a `use` tree: the name each brings into scope, and its path.
fn leaves(tree: &str, above: &[String], out: &mut Vec<(String, Module)>) {
    let tree = tree.trim();
    if let Some((head, group)) = tree.split_once('{') {
        let mut above = above.to_vec();
        above.extend(words(head.trim().trim_end_matches("::")).into_iter().filter(|w| !w.is_empty()));
        let group = group.strip_suffix('}').expect("a group is closed");
        let (mut depth, mut start) = (0, 0);
        for (i, c) in group.char_indices().chain([(group.len(), ',')]) {
            depth += i32::from(c == '{') - i32::from(c == '}');
            if c == ',' && depth == 0 {
                if !group[start..i].trim().is_empty() {
                    leaves(&group[start..i], &above, out);
                }
                start = i + 1;
            }
        }
        return;
    }
    let (path, alias) = tree.split_once(" as ").map_or((tree, None), |(path, alias)| (path, Some(alias)));
    let mut full = above.to_vec();
    full.extend(words(path));
    if full.last().is_some_and(|w| w == "self") {
        full.pop();
    }
    let name = alias.map(|a| a.trim().to_owned()).or_else(|| full.last().cloned());
    out.extend(name.map(|name| (name, full)));
}

/// The text without what `pub`, `pub(…)`, `unsafe` and `const` may stand before an item.
fn bare(line: &str) -> &str {
    let mut rest = line;
    loop {
        let shorter = match rest.strip_prefix("pub(") {
            Some(scope) => scope.split_once(") ").map_or(scope, |(_, after)| after),
            None => ["pub ", "unsafe ", "const fn ", "static mut "]
                .iter()
                .find_map(|word| rest.strip_prefix(word))
                .map_or(
                    rest,
                    |after| if rest.starts_with("const fn ") { &rest["const ".len()..] } else { after },
                ),
        };
        if shorter == rest {
            return rest;
        }
        rest = shorter;
    }
}

fn source(text: &str) -> Source {
    let before_tests = text.split("#[cfg(test)]").next().unwrap_or_default();
    let mut source = Source::default();
    let mut lines = before_tests.lines().filter(|l| !l.trim_start().starts_with("//"));
    while let Some(line) = lines.next() {
        let line = line.split(" // ").next().unwrap_or_default();
        let item = bare(line.trim_start());
        if let Some(tree) = item.strip_prefix("use ") {
            let mut tree = tree.to_owned();
            while !tree.contains(';') {
                tree.push_str(lines.next().expect("a use ends"));
            }
            leaves(tree.trim_end_matches(';'), &[], &mut source.uses);
            continue;
        }
        source.body.push_str(line);
        source.body.push('\n');
        if line.starts_with(' ') {
            continue;
        }
        let name =
            |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
        for kind in ["fn ", "struct ", "enum ", "trait ", "type ", "const ", "static "] {
            source.items.extend(item.strip_prefix(kind).map(name));
        }
        source.children.extend(item.strip_prefix("mod ").filter(|rest| rest.ends_with(';')).map(name));
    }
    source
}

struct House(BTreeMap<Module, Source>);

impl House {
    fn read() -> House {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut paths = Vec::new();
        rust_files(&root, &mut paths);
        let module = |path: &Path| -> Module {
            let inside = path.strip_prefix(&root).expect("a source file").with_extension("");
            inside
                .iter()
                .map(|part| part.to_string_lossy().into_owned())
                .filter(|part| part != "lib")
                .collect()
        };
        // what a macro names after `$crate::` is for those who use it
        let text = |path: &PathBuf| {
            fs::read_to_string(path).expect("a source file is UTF-8").replace("$crate::advanced::", "")
        };
        let all = paths.iter().filter(|p| !p.ends_with("main.rs"));
        House(all.map(|path| (module(path), source(&text(path)))).collect())
    }

    /// A path as written in a file, from the crate's root; none if it leads outside.
    fn absolute(&self, from: &Module, path: &[String]) -> Option<Module> {
        let (first, rest) = path.split_first()?;
        let mut above = from.clone();
        match first.as_str() {
            "crate" => return Some(rest.to_vec()),
            "self" => (),
            "super" => {
                above.pop();
                let ups = rest.iter().take_while(|w| *w == "super").count();
                above.truncate(above.len().saturating_sub(ups));
                return Some([above, rest[ups..].to_vec()].concat());
            }
            name if self.0[from].children.contains(name) => return Some([above, path.to_vec()].concat()),
            name => {
                let (_, alias) = self.0[from].uses.iter().find(|(n, full)| n == name && full[0] != *name)?;
                return (!rest.is_empty())
                    .then(|| self.absolute(from, alias))?
                    .map(|a| [a, rest.to_vec()].concat());
            }
        }
        Some([above, rest.to_vec()].concat())
    }

    /// The file that defines what a path from the root names.
    fn file_of(&self, path: &[String], depth: usize) -> Option<Module> {
        let longest = (0..=path.len()).rev().find(|n| self.0.contains_key(&path[..*n]))?;
        let (module, rest) = (path[..longest].to_vec(), &path[longest..]);
        let source = &self.0[&module];
        if let Some(name) = rest.first().filter(|name| !source.items.contains(*name) && depth < 8)
            && let Some((_, full)) = source.uses.iter().find(|(n, _)| n == name)
            && let Some(target) = self.absolute(&module, full).filter(|target| target != path)
        {
            return self.file_of(&[target, rest[1..].to_vec()].concat(), depth + 1).or(Some(module));
        }
        Some(module)
    }

    fn imports(&self, module: &Module) -> BTreeSet<Module> {
        let source = &self.0[module];
        let mut paths: Vec<Module> = source.uses.iter().map(|(_, full)| full.clone()).collect();
        let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        paths.extend(source.body.split(|c| !is_path(c)).filter(|w| w.contains("::")).map(words));
        let absolute = paths.iter().filter_map(|path| self.absolute(module, path));
        let files = absolute.filter_map(|path| self.file_of(&path, 0));
        files.filter(|file| file != module && !file.is_empty()).collect()
    }

    /// Every set of files that can be reached from each other, by name.
    fn circles(&self) -> Vec<Vec<String>> {
        let edges: BTreeMap<&Module, BTreeSet<Module>> =
            self.0.keys().map(|m| (m, self.imports(m))).collect();
        let reach = |from: &Module| {
            let (mut seen, mut next) = (BTreeSet::new(), vec![from.clone()]);
            while let Some(module) = next.pop() {
                for to in edges.get(&module).into_iter().flatten() {
                    if seen.insert(to.clone()) {
                        next.push(to.clone());
                    }
                }
            }
            seen
        };
        let reached: BTreeMap<&Module, BTreeSet<Module>> = self.0.keys().map(|m| (m, reach(m))).collect();
        let mut circles = BTreeSet::new();
        for (module, seen) in &reached {
            let mutual = seen.iter().filter(|other| reached.get(other).is_some_and(|r| r.contains(*module)));
            let circle: Vec<String> = mutual.map(|m| m.join("/")).collect();
            if circle.len() > 1 {
                circles.insert(circle);
            }
        }
        circles.into_iter().collect()
    }
}

#[test]
fn no_two_files_import_each_other() {
    let circles = House::read().circles();
    let text: Vec<String> = circles.iter().map(|c| format!("{} files: {}", c.len(), c.join(", "))).collect();
    assert!(circles.is_empty(), "{} circles:\n{}", circles.len(), text.join("\n"));
}

#[test]
fn every_form_of_import_is_seen() {
    let mut house = House(BTreeMap::new());
    for (module, text) in [
        ("a", "pub mod b;\nmod c;\npub use c::Item;\nfn f() {}\n"),
        ("a::b", "use super::{\n    Item,\n    c::{self, other as third},\n};\nfn g() { crate::d::h() }\n"),
        ("a::c", "pub struct Item;\npub(super) const fn other() {}\n"),
        ("d", "use crate::a;\npub fn h() { a::f() }\n#[cfg(test)]\nmod tests {\n    use crate::a::b;\n}\n"),
    ] {
        house.0.insert(words(module), source(text));
    }
    let of = |module: &str| house.imports(&words(module)).iter().map(|m| m.join("::")).collect::<Vec<_>>();
    assert_eq!(of("a::b"), ["a::c", "d"]);
    assert_eq!(of("d"), ["a"]);
    assert_eq!(of("a"), ["a::c"]);
    assert!(house.circles().is_empty());
    house.0.insert(words("a::c"), source("use super::b::g;\npub struct Item;\n"));
    assert_eq!(house.circles(), [["a", "a/b", "a/c", "d"]]);
}
