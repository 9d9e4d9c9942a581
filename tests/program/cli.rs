//! The program itself: every command, its files, exit codes, and errors of one line.

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

/// A folder of its own for a test, and the program run in it.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Bench {
        Bench(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_cutlab"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .expect("the program starts")
    }

    /// Runs a command that must end well; its standard output.
    fn good(&self, arguments: &[&str]) -> String {
        let out = self.run(arguments);
        assert_eq!(out.status.code(), Some(0), "{arguments:?}: {}", text(&out.stderr));
        text(&out.stdout)
    }

    /// Runs a command that must fail with `code` and one line on standard error; the line.
    fn bad(&self, code: i32, arguments: &[&str]) -> String {
        let out = self.run(arguments);
        let said = text(&out.stderr);
        assert_eq!(out.status.code(), Some(code), "{arguments:?}: {said}");
        assert_eq!(said.trim_end().lines().count(), 1, "{arguments:?}: {said}");
        assert!(said.starts_with("cutlab: ") && !said.contains("panicked"), "{said}");
        said
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("JSON")
}

fn near(value: &serde_json::Value, expected: f64, tolerance: f64) -> bool {
    value.as_f64().is_some_and(|v| (v - expected).abs() <= tolerance)
}

#[test]
fn generate_bare_writes_a_named_obj_here() {
    let bench = Bench::new();
    let said = bench.good(&["generate", "--facets", "153"]);
    assert!(said.contains("153 facets") && said.contains("96 girdle") && said.contains("8 star"), "{said}");
    let obj = std::fs::read_to_string(bench.path("round-brilliant-153.obj")).expect("written");
    assert!(obj.lines().filter(|l| l.starts_with("f ")).count() >= 153);
    let out = bench.run(&["generate"]);
    assert!(text(&out.stderr).contains("round-brilliant-153.obj"), "the note names the file");
    assert_eq!(text(&bench.run(&["generate", "--quiet"]).stderr), "");
}

#[test]
fn generate_writes_every_format_and_each_reads_back() {
    let bench = Bench::new();
    let mut arguments = vec!["generate", "--table", "57", "--size", "8"];
    let files = ["s.obj", "s.stl", "s.glb", "s.toml", "s.asc", "s.gem", "s.gcs", "s.ply"];
    files.iter().for_each(|f| arguments.extend(["-o", f]));
    bench.good(&arguments);
    let mut show = vec!["show", "--json"];
    show.extend(files);
    let sheets = json(&bench.good(&show));
    for sheet in sheets.as_array().expect("an array") {
        assert_eq!(sheet["facets"], 153, "{sheet}");
        assert_eq!((&sheet["closed"], &sheet["convex"]), (&true.into(), &true.into()));
        // glTF is in metres; foreign design formats have a frame of their own
        let (from, to) = match sheet["format"].as_str() {
            Some("glb") => (0.008, 0.008),
            Some("gemcad" | "gemcad-binary" | "gem-cut-studio") => (1.4, 2.3),
            _ => (8.0, 8.0),
        };
        let width = sheet["width"].as_f64().expect("a width");
        assert!(width > from * (1.0 - 1e-6) && width < to * (1.0 + 1e-6), "{sheet}");
        assert!(near(&sheet["table_percent"], 57.0, 1e-3), "{sheet}");
    }
    assert_eq!(sheets.as_array().map(Vec::len), Some(8));
    // the same on standard output
    let obj = bench.good(&["generate", "--table", "57", "--size", "8", "-o", "-", "--quiet"]);
    assert_eq!(obj, std::fs::read_to_string(bench.path("s.obj")).expect("written"));
}

#[test]
fn generate_makes_prisms_bipyramids_and_the_octahedron() {
    let bench = Bench::new();
    assert!(bench.good(&["generate", "prism", "--sides", "7", "--height", "5"]).contains("9 facets"));
    assert!(bench.path("prism-9.obj").exists());
    assert!(bench.good(&["generate", "bipyramid", "--sides", "5", "--size", "3"]).contains("10 facets"));
    assert!(bench.good(&["generate", "octahedron"]).contains("8 facets"));
    let sheet = json(&bench.good(&["show", "bipyramid-10.obj", "--json"]));
    assert!(near(&sheet[0]["width"], 3.0, 1e-9), "--size scales what has no size of its own: {sheet}");
}

#[test]
fn generate_names_the_nearest_total_and_the_bound_that_was_crossed() {
    let bench = Bench::new();
    for (arguments, word) in [
        (&["--facets", "153", "--culet", "1"][..], "154"),
        (&["--facets", "58"], "73"),
        (&["--table", "500"], "20 to 95"),
        (&["--table", "NaN"], "a finite number"),
        (&["--star", "5"], "star must be above 18.4%"),
        (&["--girdle", "0.5"], "girdle must be above"),
        (&["--girdle-facets", "90"], "multiple of 16"),
        (&["--crown-angle", "-5"], "0 to 70"),
        (&["--tabel", "50"], "--table"),
        (&["--sides", "5"], "no parameter 'sides'"),
        (&["--size", "0"], "millimetres"),
        (&["rund-brilliant"], "round-brilliant"),
        (&["round-brilliant:tabel=50"], "tabel"),
        (&["-o", "x.docx"], "obj"),
    ] {
        let said = bench.bad(2, &[&["generate"], arguments].concat());
        assert!(said.contains(word), "{arguments:?}: {said}");
    }
    let left = std::fs::read_dir(bench.0.path()).expect("lists").count();
    assert_eq!(left, 0, "a command that fails leaves nothing behind");
    // a crown of no height is legal, and the count says what merged
    assert!(bench.good(&["generate", "--crown-angle", "0", "-o", "flat.obj"]).contains("121 facets"));
}

#[test]
fn show_gives_the_proportions_of_the_reference_stone() {
    let bench = Bench::new();
    let sheets = json(&bench.good(&["show", "round-brilliant", "--json"]));
    let sheet = &sheets[0];
    assert_eq!((sheet["file"].as_str(), sheet["facets"].as_u64()), (Some("round-brilliant"), Some(153)));
    assert_eq!(sheet["facets_by_kind"]["crown"], 32);
    for (key, value, tolerance) in [
        ("table_percent", 56.0, 1e-6),
        ("crown_angle_deg", 34.0, 1e-6),
        ("crown_height_percent", 14.84, 0.005),
        ("pavilion_angle_deg", 40.5, 1e-6),
        ("pavilion_depth_percent", 42.70, 0.005),
        ("girdle_percent", 3.0, 1e-6),
        ("depth_percent", 60.54, 0.005),
        ("volume", 57.26, 0.01),
        ("carats", 1.008, 0.0005),
        ("critical_angle_deg", 24.44, 0.005),
    ] {
        assert!(near(&sheet[key], value, tolerance), "{key}: {}", sheet[key]);
    }
    let said = bench.good(&["show", "round-brilliant", "--size", "13", "--material", "quartz"]);
    // eight times the volume at quartz's 2.65 g/cm³
    assert!(said.contains("6.070 ct in quartz") && said.contains("closed"), "{said}");
}

#[test]
fn show_draws_the_virtual_facets() {
    let bench = Bench::new();
    let sheet = bench.good(&["show", "round-brilliant", "--beams", "pattern.svg"]);
    let svg = std::fs::read_to_string(bench.path("pattern.svg")).expect("written");
    assert!(sheet.contains("153 = ") && svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{sheet}");
    // the shares of the strongest path, physics.md §4: 6.0, 66.7, 22.8, 4.5 within .5
    for share in ["6.0 %", "66.6 %", "22.9 %", "4.5 %"] {
        assert!(svg.contains(&format!(">{share} of the outline")), "{share}");
    }
    assert_eq!(bench.good(&["show", "round-brilliant", "--quiet", "--beams", "-"]), svg);
    assert!(bench.bad(2, &["show", "tolkowsky", "octahedron", "--beams", "x.svg"]).contains("one stone"));
    assert!(bench.bad(2, &["show", "tolkowsky", "--beams", "x.png"]).contains("SVG"));
}

#[test]
fn show_goes_on_after_a_bad_file_and_the_exit_code_tells() {
    let bench = Bench::new();
    std::fs::write(bench.path("bad.obj"), "v 1 2\nf 1 2 3\n").expect("writes");
    let open = "name = \"open\"\n[[tier]]\nangle = -45\ndistance = 1\nindices = [0, 24, 48, 72]\n";
    std::fs::write(bench.path("open.toml"), open).expect("writes");
    let out = bench.run(&["show", "bad.obj", "open.toml", "octahedron", "--json"]);
    assert_eq!(out.status.code(), Some(1));
    let sheets = json(&text(&out.stdout));
    assert!(sheets[0]["error"].is_string(), "{sheets}");
    assert_eq!(sheets[1]["closed"], false, "{sheets}");
    assert!(sheets[1]["reason"].as_str().is_some_and(|r| r.contains("unbounded")), "{sheets}");
    assert_eq!(sheets[2]["facets"], 8);
    bench.bad(2, &["show", "bad.obj"]);
    assert!(bench.bad(2, &["show", "missing.asc"]).contains("missing.asc"));
    let empty = json(&text(&bench.run(&["show", "missing.asc", "--json"]).stdout));
    assert_eq!(empty.as_array().map(Vec::len), Some(1));
}

#[test]
fn import_converts_one_file_or_a_folder_full() {
    let bench = Bench::new();
    bench.good(&["generate", "tolkowsky", "-o", "a.obj", "-o", "b.stl"]);
    bench.good(&["import", "a.obj", "-o", "c.glb"]);
    bench.good(&["import", "a.obj", "b.stl", "-o", "all", "--to", "toml", "--size", "5"]);
    let sheets = json(&bench.good(&["show", "--json", "c.glb", "all/a.toml", "all/b.toml"]));
    assert!((0..3).all(|i| sheets[i]["facets"] == 153), "{sheets}");
    assert!(near(&sheets[1]["width"], 5.0, 1e-9) && near(&sheets[2]["width"], 5.0, 1e-5));
    assert!(bench.bad(2, &["import", "a.obj", "b.stl", "-o", "one.obj"]).contains("folder"));
    assert!(bench.bad(2, &["import", "a.obj", "-o", "x.docx"]).contains("obj"));
}

#[test]
fn import_takes_folders_and_never_overwrites() {
    let bench = Bench::new();
    bench.good(&["generate", "tolkowsky", "-o", "in/a.asc", "-o", "in/a.gem", "-o", "in/deep/b.gcs"]);
    std::fs::write(bench.path("in/notes.md"), "# notes").expect("writes");
    let said = bench.good(&["import", "in", "-o", "out", "--to", "glb"]);
    assert!(said.starts_with("file ") && said.contains("gem-cut-studio"), "{said}");
    assert!(said.ends_with("3 written, 1 passed over\n"), "{said}");
    let sheets = json(&bench.good(&["show", "--json", "out/a-asc.glb", "out/a-gem.glb", "out/deep/b.glb"]));
    assert!((0..3).all(|i| sheets[i]["facets"] == 153), "{sheets}");
    // what is there stays, to the byte, whoever wrote it
    std::fs::write(bench.path("out/a-asc.glb"), "mine").expect("writes");
    let out = bench.run(&["import", "in", "-o", "out", "--to", "glb"]);
    assert_eq!(out.status.code(), Some(1), "the other two are there already, to the byte");
    assert!(text(&out.stderr).contains("--force"));
    assert_eq!(std::fs::read_to_string(bench.path("out/a-asc.glb")).expect("there"), "mine");
    bench.good(&["import", "in", "-o", "out", "--to", "glb", "--force"]);
    // a bad file does not stop the rest
    std::fs::write(bench.path("in/bad.gem"), "no design").expect("writes");
    let out = bench.run(&["import", "in", "-o", "new", "--to", "sc-tracer", "--json"]);
    assert_eq!(out.status.code(), Some(1), "{}", text(&out.stderr));
    let rows = json(&text(&out.stdout));
    let outcomes: Vec<_> = (0..5).map(|i| rows[i]["outcome"].as_str().unwrap_or_default()).collect();
    assert_eq!(outcomes, ["written", "written", "failed", "written", "passed over"], "{rows}");
    assert!(
        rows[2]["error"].as_str().is_some_and(|e| e.contains("in/bad.gem: text, not a design or mesh")),
        "{rows}"
    );
    assert!(bench.path("new/deep/b.asc").exists());
    assert!(bench.bad(2, &["import", "in", "-o", "x", "--to", "docx"]).contains("docx"));
    std::fs::create_dir(bench.path("empty")).expect("makes");
    assert!(bench.bad(2, &["import", "empty", "-o", "x"]).contains("no designs"));
    assert!(bench.bad(3, &["import", "in/a.asc", "-o", "out/a-gem.glb"]).contains("exists"));
}

#[test]
fn score_writes_csv_with_a_column_and_an_error_a_metric() {
    let bench = Bench::new();
    let table = bench.good(&["score", "--metrics", "wlr,leakage,fire_streak"]);
    let mut lines = table.lines();
    assert_eq!(
        lines.next(),
        Some("stone,material,facets,wlr,wlr_se,leakage,leakage_se,fire_streak,fire_streak_se,error")
    );
    let cells: Vec<&str> = lines.next().expect("a row").split(',').collect();
    assert_eq!(cells[..3], ["round-brilliant", "diamond", "153"]);
    let wlr: f64 = cells[3].parse().expect("a number");
    assert!((wlr - 0.283).abs() < 0.003, "{wlr}");
    // the same seed, the same bytes; into a file
    bench.good(&["score", "--metrics", "wlr,leakage,fire_streak", "-o", "t/scores.csv"]);
    assert_eq!(std::fs::read_to_string(bench.path("t/scores.csv")).expect("written"), table);
    let out = bench.run(&["score", "octahedron", "missing", "--metrics", "wlr", "--ri", "1.5"]);
    assert_eq!((out.status.code(), text(&out.stdout).lines().count()), (Some(1), 3));
    assert!(bench.bad(2, &["score", "--metrics", "wrl"]).contains("'wlr'"));
    let rows = json(&bench.good(&["score", "--metrics", "wlr", "--error", "0.002", "--json"]));
    assert!(rows[0]["wlr_se"].as_f64().is_some_and(|e| e > 0.0 && e <= 0.002), "{rows}");
}

#[test]
fn render_writes_a_png_and_its_passes() {
    let bench = Bench::new();
    let small = ["--width", "32", "--height", "24", "--spp", "4", "--photons", "500", "--nearest", "20"];
    bench.good(&[&["render"], &small[..]].concat());
    assert!(bench.path("round-brilliant-table.png").exists());
    bench.good(
        &[&["render", "octahedron", "--scene", "cornell", "--passes", "-o", "p.png"], &small[..]].concat(),
    );
    for name in ["p.png", "p-direct.png", "p-caustic.png", "p-indirect.png"] {
        let png = std::fs::read(bench.path(name)).expect("written");
        assert!(png.starts_with(b"\x89PNG"), "{name}");
    }
    assert!(bench.bad(2, &["render", "--scene", "tabel"]).contains("'table'"));
}

#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn report_leaves_everything_about_a_stone() {
    let bench = Bench::new();
    let said = bench.good(&["report", "round-brilliant", "--width", "160", "--error", "0.01", "-o", "out"]);
    for word in
        ["Brilliance", "wlr", "leakage", "Dispersion", "fire_streak", "dispersion_mean", "out: index.html"]
    {
        assert!(said.contains(word), "{word}: {said}");
    }
    for name in
        ["stone.obj", "stone.toml", "table.png", "aset.png", "diagram.svg", "scores.csv", "index.html"]
    {
        assert!(bench.path("out").join(name).exists(), "{name}");
    }
    let page = std::fs::read_to_string(bench.path("out/index.html")).expect("written");
    assert_eq!(page.matches("data:image/png;base64,").count(), 5);
    assert!(!page.contains("http://") && !page.contains("https://"), "the page needs no network");
    for metric in cutlab::advanced::metrics::METRICS.iter() {
        assert!(page.contains(metric.name), "{}", metric.name);
    }
    assert!(page.contains("cutlab report round-brilliant --width 160 --error 0.01 -o out"));
}

#[test]
fn list_names_what_the_catalogues_hold() {
    let bench = Bench::new();
    for (kind, word) in [
        ("cuts", "tolkowsky"),
        ("materials", "cubic-zirconia"),
        ("metrics", "fire_streak"),
        ("formats", "stl"),
        ("scenes", "cornell"),
    ] {
        assert!(bench.good(&["list", kind]).contains(word), "{kind}");
        let entries = json(&bench.good(&["list", kind, "--json"]));
        assert!(entries.as_array().is_some_and(|a| a.iter().all(|e| e["name"].is_string())));
    }
    assert!(bench.bad(2, &["list", "cust"]).contains("cuts"));
}

#[test]
fn usage_errors_are_one_line_that_says_where_help_is() {
    let bench = Bench::new();
    for arguments in
        [&["bogus"][..], &["show"], &["generate", "--bogus"], &["show", "x", "--material", "diamnd"]]
    {
        assert!(bench.bad(2, arguments).contains("--help"), "{arguments:?}");
    }
    assert!(bench.bad(2, &["show", "x", "--material", "diamnd"]).contains("'diamond'"));
    assert!(bench.good(&["--version"]).contains(env!("CARGO_PKG_VERSION")));
    assert!(bench.good(&["generate", "--help"]).contains("--crown-angle"));
    assert_eq!(bench.run(&[]).status.code(), Some(2));
}

#[test]
fn what_cannot_be_read_or_written_is_code_3() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("folder.obj")).expect("makes");
    assert!(bench.bad(3, &["generate", "-o", "folder.obj", "--quiet"]).contains("folder.obj"));
    std::fs::write(bench.path("file"), "").expect("writes");
    bench.bad(3, &["generate", "-o", "file/stone.obj", "--quiet"]);
    assert!(bench.bad(3, &["score", "--metrics", "wlr", "-o", "file/s.csv", "--quiet"]).contains("file"));
    // a folder stands for the stones in it, and here there are none
    assert!(bench.bad(2, &["show", "folder.obj"]).contains("folder.obj"));
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let bench = Bench::new();
    let stones = vec!["round-brilliant"; 200];
    let mut child = Command::new(env!("CARGO_BIN_EXE_cutlab"))
        .arg("show")
        .args(&stones)
        .arg("--json")
        .current_dir(bench.0.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take()); // `| head` that has read enough
    let out = child.wait_with_output().expect("ends");
    assert_eq!((out.status.code(), text(&out.stderr)), (Some(0), String::new()));
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_with_130_and_leaves_no_part_of_a_file() {
    let bench = Bench::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_cutlab"))
        .args(["score", "--error", "0.0000001", "-o", "scores.csv"])
        .current_dir(bench.0.path())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(std::time::Duration::from_millis(400));
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(sent.success());
    assert_eq!(child.wait().expect("ends").code(), Some(130));
    let left: Vec<_> = std::fs::read_dir(bench.0.path()).expect("lists").collect();
    let names: Vec<_> = left.iter().flatten().map(std::fs::DirEntry::file_name).collect();
    assert_eq!(names, [".scores.csv.progress"], "the next start goes on from it");
}
