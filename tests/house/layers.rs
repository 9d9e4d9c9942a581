//! The rules of the house: rows of rooms, file headers and lengths, no way to panic, one file with
//! `unsafe`, markup by canvas and templates alone, no folder that nobody expects.

use cutlab::advanced::sampling::random::Purpose;
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms, lowest row first. A file imports only from lower rows; rooms of one row are
/// strangers.
const ROWS: &[&[&str]] = &[
    &["sampling", "parse", "limits", "parallel", "progress"],
    &["storage", "search"],
    &["color", "optics", "geometry"],
    &["materials", "design", "trace"],
    &["formats", "estimators"],
    &["stone", "metrics"],
    &["scene", "scoring"],
    &["photons", "batch"],
    &["optimise"],
    &["integrators"],
    &["render"],
    &["report", "manual"],
    &["error"],
    &["prelude"],
    &["cli"],
    &["advanced"],
];

/// Folders of the repository, apart from what git ignores.
const FOLDERS: &[&str] = &["cuts", "tools", "reports", "tests", "src"];

const LONGEST: usize = 400;

/// The most lines of a file directly in `src/cli`: the commands, and what they have in common.
const LONGEST_COMMAND: usize = 120;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.expect("the folder can be listed").path();
        if path.is_dir() && !path.ends_with("target") {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

pub fn sources() -> Vec<(PathBuf, String)> {
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a source file is UTF-8");
        (path.strip_prefix(root()).expect("inside the repository").to_owned(), text)
    };
    rust_files(&root().join("src")).into_iter().map(read).collect()
}

/// The text before a file's own tests, without comments.
pub fn code(text: &str) -> String {
    let before_tests = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = before_tests.lines().filter(|l| !l.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// The room of a file, from `src/ROOM.rs` or `src/ROOM/…`; none for the crate's own two files.
fn room_of(path: &Path) -> Option<String> {
    let inside = path.strip_prefix("src").expect("a source file");
    let first = inside.iter().next()?.to_string_lossy();
    let room = first.trim_end_matches(".rs");
    (!["lib", "main"].contains(&room)).then(|| room.to_string())
}

fn row_of(room: &str) -> Option<usize> {
    ROWS.iter().position(|row| row.contains(&room))
}

/// Every room that the text names after `crate::`, also in `crate::{a, b::c}`. What a macro names after
/// `$crate::` is for those who use it.
fn imports(text: &str) -> Vec<String> {
    let text = text.replace("$crate::", "");
    let mut rooms = Vec::new();
    let word = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    for rest in text.split("crate::").skip(1) {
        if let Some(group) = rest.strip_prefix('{') {
            let mut depth = 0;
            let mut start = true;
            for (i, c) in group.char_indices() {
                if start && c.is_alphabetic() && depth == 0 {
                    rooms.push(word(&group[i..]));
                }
                start = matches!(c, ',' | ' ' | '\n') && (start || c == ',');
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    _ => (),
                }
            }
            rooms.extend(group.starts_with(char::is_alphabetic).then(|| word(group)));
        } else {
            rooms.push(word(rest));
        }
    }
    rooms
}

#[test]
fn rooms_import_only_from_lower_rows() {
    let mut wrong = Vec::new();
    for (path, text) in sources() {
        let Some(room) = room_of(&path) else { continue };
        let Some(row) = row_of(&room) else {
            wrong.push(format!("{}: {room} is no room of design.md", path.display()));
            continue;
        };
        // a file's tests may look anywhere
        for other in imports(&code(&text)) {
            if other != room && row_of(&other).is_none_or(|r| r >= row) {
                wrong.push(format!("{}: {room} must not know {other}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_check_of_rows_sees_every_form_of_import() {
    assert_eq!(imports("use crate::sampling::random;"), ["sampling"]);
    assert_eq!(imports("fn f(x: crate::design::Design)"), ["design"]);
    let mut group = imports("use crate::{design::{Design, Tier},\n    geometry::Plane, trace};");
    group.sort();
    group.dedup();
    assert_eq!(group, ["design", "geometry", "trace"]);
}

#[test]
fn every_file_has_a_header_and_is_short() {
    let mut wrong = Vec::new();
    for folder in ["src", "tools", "tests"] {
        for path in rust_files(&root().join(folder)) {
            let text = fs::read_to_string(&path).expect("a source file is UTF-8");
            if !text.starts_with("//! ") {
                wrong.push(format!("{} does not start with //!", path.display()));
            }
            let lines = text.lines().count();
            if lines > LONGEST {
                wrong.push(format!("{} has {lines} lines, more than {LONGEST}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A command is its arguments and a few calls: what it is made of stands in the library, or in files of its folder.
#[test]
fn every_command_is_short() {
    let folder = root().join("src/cli");
    let mut wrong = Vec::new();
    let mut commands = 0;
    for path in rust_files(&folder).iter().filter(|path| path.parent() == Some(&folder)) {
        let lines = fs::read_to_string(path).expect("a source file is UTF-8").lines().count();
        if lines > LONGEST_COMMAND {
            wrong.push(format!("{} has {lines} lines, more than {LONGEST_COMMAND}", path.display()));
        }
        commands += 1;
    }
    assert!(commands > 15, "the check sees {commands} files");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn nothing_in_the_program_is_made_to_panic() {
    let mut wrong = Vec::new();
    for (path, text) in sources() {
        for word in [".unwrap()", ".expect(", "panic!", "todo!", "unimplemented!", "dbg!"] {
            if code(&text).contains(word) {
                wrong.push(format!("{}: {word}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn unsafe_stays_in_the_dispatch_of_the_tracer() {
    for (path, text) in sources() {
        let code = code(&text);
        let found = ["unsafe {", "unsafe fn", "unsafe impl", "unsafe trait", "unsafe extern"]
            .iter()
            .any(|w| code.contains(w));
        assert!(!found || path == Path::new("src/trace/dispatch.rs"), "{} has unsafe", path.display());
    }
}

/// The text without the items that only one architecture compiles: from their `#[cfg]` to the line
/// on which their brackets are closed again.
fn portable(text: &str) -> String {
    let mut kept = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if !line.trim_start().starts_with("#[cfg(target_arch") {
            kept.push(line);
            continue;
        }
        let mut depth = 0;
        for line in lines.by_ref() {
            let count = |brackets: &[char]| line.matches(brackets).count();
            depth += count(&['(', '{', '[']);
            depth -= count(&[')', '}', ']']);
            if depth == 0 && !line.trim_start().starts_with("#[") {
                break;
            }
        }
    }
    kept.join("\n")
}

/// What an ARM machine compiles names no instruction of another.
#[test]
fn only_the_dispatch_of_the_tracer_knows_architectures() {
    for (path, text) in sources() {
        let code = code(&text);
        for word in ["::arch", "feature_detected", "target_feature", "target_arch", "Avx", "avx"] {
            let rest =
                if path == Path::new("src/trace/dispatch.rs") { portable(&code) } else { code.clone() };
            assert!(!rest.contains(word), "{}: {word} outside #[cfg(target_arch)]", path.display());
        }
    }
    let both = "fn a() {}\n#[cfg(target_arch = \"x86_64\")]\n#[inline]\nfn b() {\n    avx();\n}\nfn c() {}";
    assert_eq!(portable(both), "fn a() {}\nfn c() {}");
}

/// Streams of random numbers are told apart by name: each is declared in one place, and has a key of its own.
#[test]
fn streams_of_random_numbers_have_names_of_their_own() {
    let mut names: Vec<(String, PathBuf)> = Vec::new();
    for (path, text) in sources() {
        for rest in code(&text).split("Purpose::named(\"").skip(1) {
            let name = rest.split('"').next().unwrap_or_default();
            names.push((name.to_owned(), path.clone()));
        }
    }
    assert!(names.len() >= 20, "the check sees {names:?}");
    for (i, (name, path)) in names.iter().enumerate() {
        for (other, place) in &names[..i] {
            let same = Purpose::named(name) == Purpose::named(other);
            assert!(!same, "{} and {}: '{name}' and '{other}'", path.display(), place.display());
        }
    }
}

/// The program's data stand in `src`: `reports/` is what it makes.
#[test]
fn nothing_in_the_program_reads_reports() {
    for (path, text) in sources() {
        let reads = code(&text).lines().any(|l| l.contains("include") && l.contains("reports/"));
        assert!(!reads, "{} reads reports/", path.display());
    }
}

/// Files whose strings may hold tags, and why.
const WITH_TAGS: &[&str] = &[
    "src/report/svg_canvas.rs",   // writes the elements of every drawing
    "src/formats/gcs.rs",         // Gem Cut Studio's own XML
    "src/formats/gcs/parser.rs",  // the same
    "src/formats/gcs/rewrite.rs", // the same
    "src/formats/gcs_write.rs",   // the same
    "src/formats/unsupported.rs", // knows pages and drawings by their first tag
];

/// The string literals of Rust code, without their quotes.
fn literals(code: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(at) = rest.find(['"', '\'', '/']) {
        let (before, here) = rest.split_at(at);
        let after = if here.starts_with("//") {
            here.find('\n').unwrap_or(here.len())
        } else if here.starts_with("'\"'") || here.starts_with("'\\") {
            3 // a quote or an escaped sign as a char
        } else if let Some(text) = here.strip_prefix('"') {
            let hashes = before.len() - before.trim_end_matches('#').len();
            let length = if before.trim_end_matches('#').ends_with('r') {
                text.find(&format!("\"{}", "#".repeat(hashes)))
            } else {
                let mut escaped = false;
                text.find(|c| {
                    let ends = c == '"' && !escaped;
                    escaped = c == '\\' && !escaped;
                    ends
                })
            };
            let length = length.expect("a string ends");
            found.push(&text[..length]);
            length + 2
        } else {
            1
        };
        rest = &here[after..];
    }
    found
}

/// Whether a text has a tag: `<a`, `</a`, `<!a`; `:<a` is a width in a format.
fn has_tag(text: &str) -> bool {
    text.match_indices('<').any(|(i, _)| {
        let name = text[i + 1..].trim_start_matches(['/', '!']);
        !text[..i].ends_with(':') && name.starts_with(|c: char| c.is_ascii_alphabetic())
    })
}

#[test]
fn markup_is_written_by_the_canvas_and_by_templates() {
    let mut wrong = Vec::new();
    for (path, text) in sources().iter().filter(|(path, _)| !WITH_TAGS.iter().any(|p| path == Path::new(p))) {
        let code = code(text);
        wrong.extend(
            literals(&code).iter().filter(|l| has_tag(l)).map(|l| format!("{}: {l}", path.display())),
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_check_of_markup_sees_every_form_of_string() {
    let code = "let a = \"<b>\\\"x\"; // \"no\"\nlet b = ('\"', '\\'', 'c'); f::<'a>(r#\"</p>\"#, br\"<!doctype\", \"{:<w$}\");";
    assert_eq!(literals(code), ["<b>\\\"x", "</p>", "<!doctype", "{:<w$}"]);
    let tags: Vec<bool> = literals(code).into_iter().map(has_tag).collect();
    assert_eq!(tags, [true, true, true, false]);
    assert!(!has_tag("a < b, <1>, x <- y"));
}

#[test]
fn the_top_level_holds_the_folders_of_the_house() {
    for entry in fs::read_dir(root()).expect("the repository can be listed") {
        let entry = entry.expect("the repository can be listed");
        let name = entry.file_name().to_string_lossy().into_owned();
        let ignored = name.starts_with('.') || ["target", "out"].contains(&name.as_str());
        if entry.path().is_dir() && !ignored {
            assert!(FOLDERS.contains(&name.as_str()), "{name}/ is no folder of design.md");
        }
    }
}
