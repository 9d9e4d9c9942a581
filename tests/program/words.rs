//! What people type is understood or explained, and what strangers write stays words.

use clap::Command;
use std::path::PathBuf;
use std::process::{Output, Stdio};

struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Bench {
        Bench(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn program(&self) -> std::process::Command {
        let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_cutlab"));
        program.current_dir(self.0.path());
        program
    }

    fn run(&self, arguments: &[&str]) -> Output {
        self.program().args(arguments).output().expect("the program starts")
    }

    fn good(&self, arguments: &[&str]) -> String {
        let out = self.run(arguments);
        assert_eq!(out.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&out.stderr));
        String::from_utf8(out.stdout).expect("UTF-8")
    }

    /// What is said of a command that is refused.
    fn bad(&self, arguments: &[&str]) -> String {
        let out = self.run(arguments);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!((out.status.code(), said.lines().count()), (Some(2), 1), "{arguments:?}: {said}");
        said
    }
}

/// What the argument parser says of an option's value, if it refuses it.
fn refusal(command: &Command, sub: &str, flag: &str, value: &str) -> Option<String> {
    let words = ["cutlab", sub, &format!("{flag}={value}")].map(String::from);
    let error = command.clone().try_get_matches_from(words).err()?;
    // a missing argument is another matter: the value was taken
    (error.kind() == clap::error::ErrorKind::ValueValidation).then(|| error.to_string())
}

/// Every option of every command, also those to come: no words of the compiler or a parser.
#[test]
fn every_refused_value_is_explained_in_words() {
    const MACHINES: [&str; 9] = [
        "invalid float literal",
        "invalid digit",
        "cannot parse",
        "number too",
        "expected number at",
        "time unit needed",
        "not in 1..",
        "not in 0..",
        "ParseError",
    ];
    let mut command = cutlab::advanced::cli::command();
    command.build();
    let mut seen = 0;
    for sub in command.get_subcommands() {
        for arg in sub.get_arguments().filter(|a| a.get_action().takes_values()) {
            let Some(flag) = arg.get_long().map(|long| format!("--{long}")) else { continue };
            for value in ["34,5", "34.5°", "57%", "640x480", "abc", "", "1e400", "-", "nan", "0x10", "1:2"] {
                let Some(said) = refusal(&command, sub.get_name(), &flag, value) else { continue };
                seen += 1;
                let words = MACHINES.iter().find(|words| said.contains(**words));
                assert_eq!(words, None, "{} {flag}={value}: {said}", sub.get_name());
            }
        }
    }
    assert!(seen > 300, "{seen}");
}

#[test]
fn numbers_with_units_are_understood_and_others_explained() {
    let bench = Bench::new();
    let generate =
        |value: &str| bench.good(&["generate", "-q", "--to", "toml", "-o", "-", "--crown-angle", value]);
    assert_eq!(generate("34.5°"), generate("34.5"));
    let stone = |spec: &str| bench.good(&["generate", spec, "-q", "--to", "toml", "-o", "-"]);
    assert_eq!(
        stone("round-brilliant:table=57%, crown-angle=34°"),
        stone("round-brilliant:table=57,crown-angle=34")
    );
    assert_eq!(stone("round-brilliant:depth=61.5%"), stone("round-brilliant:depth=61.5"));
    assert_eq!(stone("Round-Brilliant:Table=57"), stone("round-brilliant:table=57"));
    for (arguments, word) in [
        (&["generate", "--crown-angle", "34,5"][..], "as 34.5"),
        (&["generate", "--carat", "1,5"], "as 1.5"),
        (&["score", "--sort", "iso", "--top", "0"], "a whole number of rows from 1 on"),
        (&["generate", "--table", "57mm"], "give per cent, as 57"),
        (&["render", "--width", "640x480"], "one number is needed, '640x480' is two"),
        (&["render", "--width", "0"], "a whole number of pixels from 1 to 16384"),
        (&["score", "--seed", "abc"], "a seed is a whole number"),
        (&["render", "--progressive", "--time", "60"], "e.g. 60s, 5min or 1h30m"),
        (&["score", "--tilt", "1,5:3:1"], "as 1.5"),
        (&["show", "round-brilliant:crown-angle=34,5"], "a point, as crown-angle=34.5"),
        (&["show", "round-brilliant:crown-angle=34,crown-angle=35"], "given twice"),
        (&["show", "round-brilliant:crown-angle=35x"], "give degrees, as 35"),
        (&["show", "round-brilliant:crown-angle=wide"], "a number is needed"),
    ] {
        let said = bench.bad(arguments);
        assert!(said.contains(word), "{arguments:?}: {said}");
    }
    for arguments in [&["generate", "--table", "1e300"][..], &["show", "round-brilliant:table=-1e-300"]] {
        let said = bench.bad(arguments);
        assert!(said.contains("1e") && said.len() < 200, "{said}");
    }
}

#[test]
fn names_are_known_in_any_case_and_suggestions_are_near() {
    let bench = Bench::new();
    assert!(bench.good(&["show", "TOLKOWSKY", "--material", "Quartz"]).contains("quartz"));
    let table = bench.good(&["score", "cube", "--metrics", " ISO, spread", "--error", "0.05"]);
    assert!(table.starts_with("stone,material,facets,iso,iso_se,spread,spread_se,error"), "{table}");
    assert!(bench.good(&["list", "METRICS", "Wlr"]).contains("definition"));
    for (arguments, word) in [
        (&["show", "tolkovsky"][..], "did you mean 'tolkowsky'?"),
        (&["show", "cube", "--material", "diamnd"], "did you mean 'diamond'?"),
        (&["score", "--metrics", "weight"], "did you mean 'weight_ratio'?"),
        (&["render", "--scene", "cornel"], "did you mean 'cornell'?"),
    ] {
        assert!(bench.bad(arguments).contains(word), "{arguments:?}: {}", bench.bad(arguments));
    }
    for arguments in [
        &["show", "nosuch.asc"][..],
        &["show", "no/such/folder"],
        &["show", "PC"],
        &["show", "cube", "--material", "obsidian"],
        &["score", "--metrics", "beauty"],
    ] {
        let said = bench.bad(arguments);
        assert!(!said.contains("did you mean"), "{arguments:?}: {said}");
    }
    assert!(bench.bad(&["show", "nosuch.asc"]).contains("there is no file 'nosuch.asc'"));
    // a file wins over a cut whose name differs in case
    std::fs::write(
        bench.path("Cube"),
        bench.good(&["generate", "octahedron", "-q", "--to", "asc", "-o", "-"]),
    )
    .expect("writes");
    assert!(bench.good(&["show", "Cube"]).contains("8 = "));
    assert!(bench.good(&["show", "CUBE"]).contains("6 = "));
}

#[cfg(unix)]
#[test]
fn arguments_that_are_no_text_are_refused_or_read_without_a_panic() {
    use std::os::unix::ffi::OsStrExt;
    let bench = Bench::new();
    let name = std::ffi::OsStr::from_bytes(b"gr\xfcn.asc");
    std::fs::write(
        bench.0.path().join(name),
        bench.good(&["generate", "cube", "-q", "--to", "asc", "-o", "-"]),
    )
    .expect("writes");
    for words in [
        &["show"][..],
        &["score", "--metrics", "spread"],
        &["render", "--width", "8", "--spp", "1"],
        &["bogus"],
    ] {
        let out = bench.program().args(words).arg(name).output().expect("the program starts");
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(matches!(out.status.code(), Some(0 | 2)), "{words:?}: {:?} {said}", out.status.code());
        assert!(!said.contains("panicked"), "{words:?}: {said}");
    }
}

/// A name that would set a terminal's title, colour its text and turn its direction.
const ESCAPES: &str = r"a\u001b]0;x\u0007\u001b[31m\u009b1m\u202eb";

fn obeyed(bytes: &[u8]) -> Option<char> {
    let text = String::from_utf8_lossy(bytes).into_owned();
    text.chars().find(|c| (c.is_control() && *c != '\n' && *c != '\t') || *c == '\u{202e}')
}

#[test]
fn nothing_in_names_and_files_reaches_the_terminal() {
    let bench = Bench::new();
    let design = bench.good(&["generate", "classic", "-q", "--to", "toml", "-o", "-"]);
    let rest = design
        .split_once('\n')
        .map_or("", |(_, rest)| rest)
        .replace("name = \"", &format!("name = \"{ESCAPES}"));
    let file = "s\u{1b}[31m\u{9b}\u{202e}.toml";
    std::fs::write(bench.path(file), format!("name = \"{ESCAPES}\"\n{rest}")).expect("writes");
    std::fs::create_dir(bench.path("d")).expect("makes a folder");
    std::fs::copy(bench.path(file), bench.path("d").join(file)).expect("copies");
    std::fs::write(bench.path("d/\u{1b}[31mbad.asc"), "GemCad 5.0\n\u{1b}[31m").expect("writes");
    for arguments in [
        &["show", file][..],
        &["show", file, "--json"],
        &["generate", file, "-o", "x.obj"],
        &["generate", file, "-o", "x.obj", "--json"],
        &["import", "d", "-o", "out"],
        &["import", "d", "-o", "out", "--json"],
        &["compare", file, "cube", "--metrics", "spread"],
        &["compare", file, "cube", "--metrics", "spread", "--json"],
        &["score", file, "\u{1b}[31mno\u{202e}", "--metrics", "spread", "-o", "t\u{1b}[31m.csv"],
        &["render", file, "--width", "8", "--spp", "1", "--photons", "100"],
        &["show", "\u{1b}]0;x\u{7}"],
        &["score", "--metrics", "\u{1b}[31m"],
        &["\u{1b}[31m"],
    ] {
        let out = bench.run(arguments);
        assert_eq!(obeyed(&out.stderr), None, "{arguments:?}: {:?}", String::from_utf8_lossy(&out.stderr));
        assert_eq!(obeyed(&out.stdout), None, "{arguments:?}: {:?}", String::from_utf8_lossy(&out.stdout));
        if arguments.contains(&"--json") {
            let value: serde_json::Value = serde_json::from_slice(&out.stdout).expect("JSON");
            assert!(!value.is_null());
        }
    }
}

#[test]
fn no_cell_of_a_csv_is_a_formula_and_parts_still_join() {
    let bench = Bench::new();
    let design = bench.good(&["generate", "cube", "-q", "--to", "asc", "-o", "-"]);
    let names = ["=1+1.asc", "+1.asc", "@SUM(1).asc", "\t=1.asc", "\n=1.asc", "'=1.asc", "''@1.asc"];
    for name in names {
        std::fs::write(bench.path(name), &design).expect("writes");
    }
    let score = |more: &[&str]| {
        let stones = [&["score", "-q"][..], &names[..], &["--metrics", "spread"], more].concat();
        bench.good(&stones)
    };
    let table = score(&[]);
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let stones: Vec<String> = reader.records().map(|r| r.expect("a row")[0].to_string()).collect();
    assert_eq!(stones, names.map(|n| format!("'{n}")), "{table}");
    // JSON has the names as they are
    let rows: serde_json::Value = serde_json::from_str(&score(&["--json"])).expect("JSON");
    assert_eq!(rows[0]["stone"], names[0]);
    score(&["-o", "all.csv"]);
    score(&["-o", "p1.csv", "--shard", "1/2"]);
    score(&["-o", "p2.csv", "--shard", "2/2"]);
    bench.good(&["merge", "p1.csv", "p2.csv", "-o", "joined.csv"]);
    let read = |name: &str| std::fs::read_to_string(bench.path(name)).expect("written");
    assert_eq!(read("joined.csv"), read("all.csv"));
    // and names are again as they were
    score(&["-o", "all.json"]);
    bench.good(&["merge", "p1.csv", "p2.csv", "-o", "joined.json"]);
    assert_eq!(read("joined.json"), read("all.json"));
}

#[test]
fn every_command_takes_a_stone_from_standard_input() {
    let bench = Bench::new();
    let design = bench.good(&["generate", "classic", "-q", "--to", "gem", "-o", "x.gem"]);
    assert!(design.is_empty() || !design.is_empty());
    let fed = |arguments: &[&str]| {
        let file = std::fs::File::open(bench.path("x.gem")).expect("opens");
        let out = bench.program().args(arguments).stdin(Stdio::from(file)).output().expect("starts");
        let said = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(0), "{arguments:?}: {said}");
        String::from_utf8(out.stdout).expect("UTF-8")
    };
    assert!(fed(&["show", "-"]).contains("standard") || fed(&["show", "-"]).contains("- ("));
    assert_eq!(
        fed(&["generate", "-", "-q", "--to", "obj", "-o", "-"])
            .lines()
            .filter(|l| l.starts_with("f "))
            .count(),
        bench
            .good(&["generate", "x.gem", "-q", "--to", "obj", "-o", "-"])
            .lines()
            .filter(|l| l.starts_with("f "))
            .count()
    );
    let scores =
        |table: &str| table.lines().nth(1).map(|row| row.split_once(',').map(|(_, rest)| rest.to_string()));
    let score = ["--metrics", "iso,spread", "--error", "0.05", "-q"];
    let by_name = bench.good(&[&["score", "x.gem"], &score[..]].concat());
    assert_eq!(scores(&fed(&[&["score", "-"], &score[..]].concat())), scores(&by_name));
    fed(&[&["score", "-", "-o", "t.csv"], &score[..]].concat());
    assert_eq!(scores(&std::fs::read_to_string(bench.path("t.csv")).expect("written")), scores(&by_name));
    fed(&["import", "-", "-o", "y.asc"]);
    assert!(bench.path("y.asc").exists());
    fed(&["render", "-", "--width", "8", "--spp", "1", "--photons", "100", "-o", "y.png"]);
    assert!(bench.path("y.png").exists());
    fed(&["compare", "-", "cube", "--metrics", "spread"]);
}

#[test]
fn a_size_that_is_varied_is_not_noted_as_missing() {
    let bench = Bench::new();
    let sweep = |vary: &str| {
        let words = ["sweep", "oval", "--vary", vary, "--material", "ruby", "--metrics", "spread"];
        String::from_utf8_lossy(&bench.run(&words).stderr).into_owned()
    };
    assert!(!sweep("size=5:6:1").contains("wide"), "{}", sweep("size=5:6:1"));
    assert!(sweep("crown-angle=34:35:1").contains("6.5 mm wide"));
}

#[test]
fn threads_are_bounded_and_chosen() {
    let bench = Bench::new();
    assert!(bench.bad(&["score", "cube", "-j", "0"]).contains("from 1 to 256"));
    let tables: Vec<String> = ["1", "3"]
        .map(|n| bench.good(&["score", "cube", "--metrics", "iso", "--error", "0.05", "-j", n]))
        .to_vec();
    assert_eq!(tables[0], tables[1]);
    let start = std::time::Instant::now();
    let out = bench
        .program()
        .args(["score", "cube", "--metrics", "spread"])
        .env("RAYON_NUM_THREADS", "40000")
        .output()
        .expect("starts");
    assert_eq!(out.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&out.stderr).contains("256 threads are used"));
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}

#[test]
fn help_fits_a_page_and_names_the_cuts_of_the_list() {
    let bench = Bench::new();
    let mut command = cutlab::advanced::cli::command();
    command.build();
    for sub in command.get_subcommands().filter(|s| s.get_name() != "help") {
        let help = bench.good(&[sub.get_name(), "--help"]);
        let long = help.lines().find(|line| line.chars().count() > 101);
        assert_eq!(long, None, "{}", sub.get_name());
    }
    let help = bench.good(&["generate", "--help"]);
    assert!(
        !help.contains("oval-brilliant") && !help.contains("step-cut") && help.contains("emerald:"),
        "{help}"
    );
}

#[test]
fn lists_have_one_line_an_entry_and_facts_as_numbers() {
    let bench = Bench::new();
    let lines = bench.good(&["list", "metrics"]);
    assert_eq!(lines.lines().count(), cutlab::advanced::metrics::METRICS.len());
    assert!(bench.good(&["list", "metrics", "wlr", "iso"]).contains("source"));
    let ends = |name: &str, end: &str| lines.lines().any(|l| l.starts_with(name) && l.ends_with(end));
    assert!(ends("wlr ", "; more is better") && ends("leakage ", "; less is better"), "{lines}");
    assert!(!ends("contrast ", "better") && !ends("weight_ratio ", "better"), "{lines}");
    let materials: serde_json::Value =
        serde_json::from_str(&bench.good(&["list", "materials", "--json"])).expect("JSON");
    let diamond =
        materials.as_array().expect("an array").iter().find(|m| m["name"] == "diamond").expect("diamond");
    assert!((diamond["n_d"].as_f64().expect("a number") - 2.417).abs() < 1e-3, "{diamond}");
    assert!((diamond["density_g_cm3"].as_f64().expect("a number") - 3.52).abs() < 0.02, "{diamond}");
    let wlr: serde_json::Value =
        serde_json::from_str(&bench.good(&["list", "metrics", "wlr", "--json"])).expect("JSON");
    assert_eq!(wlr[0]["better"], "more");
    assert_eq!((wlr.as_array().map(Vec::len), &wlr[0]["range"]), (Some(1), &serde_json::json!([0.0, 1.0])));
    let oval: serde_json::Value =
        serde_json::from_str(&bench.good(&["list", "cuts", "oval", "--json"])).expect("JSON");
    assert!(
        oval[0]["parameters"].as_array().is_some_and(|p| p.iter().any(|p| p["key"] == "length-to-width")),
        "{oval}"
    );
    assert!(bench.bad(&["list", "metrics", "wlrr"]).contains("did you mean 'wlr'?"));
    // a cut as printed is a design of one's own
    std::fs::write(bench.path("own.toml"), bench.good(&["list", "cuts", "classic"])).expect("writes");
    assert_eq!(
        bench.good(&["show", "own.toml"]).lines().nth(2),
        bench.good(&["show", "classic"]).lines().nth(2)
    );
}
