//! Tables as files: exact scores, sidecars, folders, shards in other forms, rows used again, order.

use crate::bench::{Bench, text};
use serde_json::Value;
use std::time::Duration;

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).expect("JSON")
}

fn column(table: &str, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let at = reader.headers().expect("a head").iter().position(|h| h == name);
    let at = at.unwrap_or_else(|| panic!("no column {name}: {table}"));
    reader.records().map(|r| r.expect("a row")[at].to_owned()).collect()
}

/// Samples of beams have names with blanks, at which records of progress were once split.
#[test]
fn exact_scores_go_to_files_as_to_standard_output() {
    let bench = Bench::new();
    let metrics = "aset_red,aset_red_strongest,windowing,iso,fire_streak,wlr,spread";
    for command in [
        &["score", "cube", "octahedron", "--exact", "--error", "0.01", "--metrics", metrics][..],
        &[
            "sweep",
            "cube",
            "--vary",
            "ri=1.5:1.7:0.1",
            "--exact",
            "--error",
            "0.01",
            "--metrics",
            "aset_red,iso",
        ],
    ] {
        let (shown, _) = bench.ends(0, command);
        for file in ["x.csv", "x.json", "x.jsonl"] {
            bench.good(&[command, &["-o", file, "--force"]].concat());
        }
        assert_eq!(text(&bench.read("x.csv")), shown, "{command:?}");
        let lines = text(&bench.read("x.jsonl"));
        let lines: Vec<Value> = lines.lines().map(|l| json(l.as_bytes())).collect();
        assert_eq!(json(&bench.read("x.json")), Value::Array(lines));
        let samples = &json(&bench.read("x.csv.meta.json"))["samples"];
        assert!(samples["view by beams"]["least"].is_u64(), "{samples}");
    }
    assert!(bench.names().iter().all(|n| !n.starts_with('.')), "{:?}", bench.names());
}

#[test]
fn a_killed_table_of_exact_scores_goes_on() {
    let bench = Bench::new();
    let score = |output| {
        let stones = ["score", "tolkowsky", "oval", "pear", "cushion", "asscher", "scan-dn"];
        [&stones[..], &["--exact", "--metrics", "aset_red,iso", "--error", "0.0005", "-o", output]].concat()
    };
    for wait in [300, 700, 1500] {
        bench.kill_after(Duration::from_millis(wait), &score("t.csv"));
    }
    bench.good(&score("t.csv"));
    bench.good(&score("whole.csv"));
    assert_eq!(bench.read("t.csv"), bench.read("whole.csv"));
    assert_eq!(bench.names(), ["t.csv", "t.csv.meta.json", "whole.csv", "whole.csv.meta.json"]);
}

const SPREAD: [&str; 2] = ["--metrics", "spread"];

#[test]
fn each_table_has_a_sidecar_of_its_own_and_parts_of_all_forms_join_into_any() {
    let bench = Bench::new();
    let score = |options: &[&'static str]| {
        [&["score", "-q", "cube", "42", "oval:table=55,star=50", "octahedron"], &SPREAD[..], options].concat()
    };
    bench.good(&["generate", "-q", "cube", "-o", "42.obj"]);
    std::fs::rename(bench.path("42.obj"), bench.path("42")).expect("renames");
    for (shard, part) in [("1/3", "t.csv"), ("2/3", "t.json"), ("3/3", "t.jsonl")] {
        bench.good(&score(&["--shard", shard, "-o", part]));
    }
    for whole in ["whole.csv", "whole.json", "whole.jsonl"] {
        bench.good(&score(&["-o", whole]));
        let joined = whole.replace("whole", "joined");
        bench.good(&["merge", "t.csv", "t.json", "t.jsonl", "-o", &joined]);
        assert_eq!(text(&bench.read(&joined)), text(&bench.read(whole)));
        let sidecar = |table: &str| bench.read(&format!("{table}.meta.json"));
        assert_eq!(sidecar(&joined), sidecar(whole));
        // by a pattern that matches sidecars and the whole as well
        bench.good(&["merge", "[tj]*.*", "-o", &joined]);
    }
    std::fs::rename(bench.path("t.csv.meta.json"), bench.path("t.meta.json")).expect("renames");
    bench.good(&["merge", "t.csv", "t.json", "t.jsonl", "-o", "old.csv"]);
    assert_eq!(bench.read("old.csv"), bench.read("whole.csv"));
    // another build of the same version computes other numbers
    let mut meta = json(&bench.read("t.json.meta.json"));
    meta["build"] = "0123456789ab".into();
    meta["study"] = "00".into();
    std::fs::write(bench.path("t.json.meta.json"), meta.to_string()).expect("writes");
    let said = bench.ends(2, &["merge", "t.csv", "t.json", "t.jsonl", "-o", "new.csv"]).1;
    assert!(said.contains("different builds"), "{said}");
    assert!(!bench.exists("new.csv"));
}

#[test]
fn files_of_a_folder_that_are_no_stones_are_passed_over() {
    let bench = Bench::new();
    for file in ["d/a.asc", "d/b.toml", "d/deep/c.gltf", "d/list.obj"] {
        bench.good(&["generate", "-q", "octahedron", "-o", file]);
    }
    std::fs::rename(bench.path("d/list.obj"), bench.path("d/e.txt")).expect("renames");
    for (name, content) in [
        ("d/package.json", "{ \"name\": \"x\", \"asset\": 1 }"),
        ("d/readme.txt", "Include the Shape of every stone.\nsolid gold\n"),
        ("d/numbers.txt", "1 2 3\n4 5 6\n"),
        ("d/empty.txt", ""),
        ("d/Cargo.toml", "[package]\nname = \"x\"\n"),
        ("d/scene.toml", "unit = \"mm\"\n[camera]\nfrom = [0, 0, 1]\n[[stone]]\ncut = \"cube\"\n"),
        ("d/settings.toml", "colour = \"red\"\n"),
        ("d/x.csv", "stone,wlr\na,1\n"),
        ("d/notes.jsonl", "{\"stone\":\"a\"}\n"),
    ] {
        std::fs::write(bench.path(name), content).expect("writes");
    }
    let stones = ["d/a.asc", "d/b.toml", "d/deep/c.gltf", "d/e.txt"];
    assert_eq!(column(&bench.ends(0, &[&["score", "d"], &SPREAD[..]].concat()).0, "stone"), stones);
    for table in ["d/t.csv", "d/t.json", "d/t.jsonl"] {
        let score = [&["score", "-q", "d"], &SPREAD[..], &["-o", table, "--force"]].concat();
        bench.good(&score);
        let first = bench.read(table);
        bench.good(&score);
        assert_eq!(bench.read(table), first, "{table}");
    }
    let (said, _) = bench.ends(0, &["import", "d", "-o", "out", "--to", "obj"]);
    assert!(said.contains("4 written") && said.contains("passed over"), "{said}");
    // what is meant as a design and damaged keeps its row
    for (name, content) in [
        ("d/bad.asc", "GemCad 5.0\ng 96 0.0\n"),
        ("d/bad.toml", "nmae = \"x\"\n[[tier]]\nangle = 40\n"),
        ("d/worse.toml", "[[tier]]\nangle = = 40\n"),
    ] {
        std::fs::write(bench.path(name), content).expect("writes");
    }
    let (table, _) = bench.ends(1, &[&["score", "d"], &SPREAD[..]].concat());
    let failed =
        ["d/a.asc", "d/b.toml", "d/bad.asc", "d/bad.toml", "d/deep/c.gltf", "d/e.txt", "d/worse.toml"];
    assert_eq!(column(&table, "stone"), failed);
}

#[test]
fn imported_stones_of_one_name_each_have_a_file() {
    let bench = Bench::new();
    for (i, file) in ["x/s.asc", "y/s.asc", "in/a.asc", "in/a.gem", "in/a-asc.obj"].into_iter().enumerate() {
        bench.good(&["generate", "-q", "--table", &(50 + i).to_string(), "-o", file]);
    }
    for force in [&[][..], &["--force"]] {
        for (arguments, count) in [(&["x/s.asc", "y/s.asc"][..], 2), (&["in"], 3)] {
            let to = ["-o", "out", "--to", "obj", "--json"];
            let rows = json(bench.ends(0, &[&["import"], arguments, &to, force].concat()).0.as_bytes());
            let written: std::collections::BTreeSet<String> =
                rows.as_array().expect("rows").iter().map(|r| r["wrote"].to_string()).collect();
            assert_eq!(written.len(), count, "{rows}");
            for row in rows.as_array().expect("rows") {
                let (file, wrote) = (row["file"].as_str().expect("a name"), row["wrote"].as_str());
                let sheets = bench.ends(0, &["show", "--json", file, wrote.expect("a file")]).0;
                let sheets = json(sheets.as_bytes());
                let tables = [0, 1].map(|i| sheets[i]["table_percent"].as_f64().expect("a table"));
                assert!((tables[0] - tables[1]).abs() < 1e-3, "{file}: {tables:?}");
            }
            std::fs::remove_dir_all(bench.path("out")).expect("removes");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_not_utf8_are_read() {
    use std::os::unix::ffi::OsStrExt;
    let bench = Bench::new();
    bench.good(&["generate", "-q", "octahedron", "-o", "d/good.asc"]);
    for name in [&b"d/bad\xff.asc"[..], b"d/bad\xfe.asc"] {
        let path = bench.path("").join(std::ffi::OsStr::from_bytes(name));
        std::fs::copy(bench.path("d/good.asc"), path).expect("copies");
    }
    let stones = ["d/bad\\xfe.asc", "d/bad\\xff.asc", "d/good.asc"];
    for (named, file) in
        [("d", "t.csv"), ("d", "-"), ("d/*.asc", "-"), ("./?/*[d].a*", "-"), ("**/*.asc", "-")]
    {
        let (shown, _) = bench.ends(0, &[&["score", named, "-q"], &SPREAD[..], &["-o", file]].concat());
        let table = if file == "-" { shown } else { text(&bench.read(file)) };
        let shown: Vec<_> = column(&table, "stone").iter().map(|s| s.replace("./", "")).collect();
        let expected = if named.contains("[d]") { &stones[2..] } else { &stones };
        assert_eq!(shown, expected, "{named}");
    }
    bench.good(&["import", "d", "-o", "out", "--to", "obj"]);
    assert_eq!(std::fs::read_dir(bench.path("out")).expect("lists").count(), 3);
    bench.ends(0, &["show", "d"]);
    let alone = std::ffi::OsStr::from_bytes(b"d/bad\xff.asc:material=topaz");
    let mut command = bench.command(&["score", "--metrics", "spread", "-q"]);
    let out = command.arg(alone).output().expect("starts");
    assert_eq!(column(&text(&out.stdout), "material"), ["topaz"]);
}

#[test]
fn a_folder_below_that_cannot_be_listed_fails_alone() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    for file in ["d/a.asc", "d/locked/b.asc", "d/c.asc"] {
        bench.good(&["generate", "-q", "octahedron", "-o", file]);
    }
    let locked = bench.path("d/locked");
    std::fs::set_permissions(&locked, PermissionsExt::from_mode(0o0)).expect("locks");
    let command = [&["score", "d"], &SPREAD[..]].concat();
    if let Some((table, said)) = bench.ends_for_a_user(1, &command) {
        assert_eq!(column(&table, "stone"), ["d/a.asc", "d/c.asc", "d/locked"]);
        assert!(said.contains("d/locked") && said.lines().count() == 1, "{said}");
    }
    std::fs::set_permissions(&locked, PermissionsExt::from_mode(0o755)).expect("unlocks");
}

const GRID: [&str; 6] =
    ["sweep", "round-brilliant", "--vary", "crown-angle=30:38:2", "--vary", "pavilion-angle=40:42:0.5"];

/// The drawing without the record of its command.
fn drawing(bench: &Bench, file: &str) -> String {
    let svg = text(&bench.read(file));
    roxmltree::Document::parse(&svg).unwrap_or_else(|e| panic!("{file}: {e}"));
    svg.split("<?cutlab-record").next().expect("a drawing").to_owned()
}

#[test]
fn plots_of_a_whole_table_are_drawn_without_computing_it_again() {
    let bench = Bench::new();
    let sweep = [&GRID[..], &["--metrics", "spread", "-o", "t.csv"]].concat();
    bench.good(&sweep);
    let made = |file: &str| bench.path(file).metadata().and_then(|m| m.modified()).expect("a time");
    let before = made("t.csv");
    let said = bench.good(&[&sweep[..], &["--plot", "p.svg"]].concat());
    assert!(said.contains("used again") && made("t.csv") == before, "{said}");
    bench.good(&["plot", "t.csv", "-o", "spread.svg", "-o", "q.png"]);
    assert_eq!(drawing(&bench, "spread.svg"), drawing(&bench, "p.svg"));
    assert!(bench.read("q.png").starts_with(b"\x89PNG"));
    for (shard, part) in [("1/2", "p1.csv"), ("2/2", "p2.jsonl")] {
        bench.good(&[&GRID[..], &["--metrics", "spread", "--shard", shard, "-o", part]].concat());
    }
    bench.good(&["merge", "p1.csv", "p2.jsonl", "-o", "all.csv", "--plot", "m.svg"]);
    assert_eq!(
        (drawing(&bench, "m.svg"), bench.read("all.csv")),
        (drawing(&bench, "p.svg"), bench.read("t.csv"))
    );
    let said = bench.ends(2, &["plot", "p1.csv", "-o", "x.svg"]).1;
    assert!(said.contains("cutlab merge"), "{said}");
    bench.good(&["score", "-q", "cube", "--metrics", "spread", "-o", "s.csv"]);
    let said = bench.ends(2, &["plot", "s.csv", "-o", "x.svg"]).1;
    assert!(said.contains("nothing to draw"), "{said}");
    // an edited table is not the one its sidecar speaks of
    std::fs::write(bench.path("t.csv"), "mine").expect("writes");
    assert!(bench.ends(2, &["plot", "t.csv", "-o", "x.svg"]).1.contains("checksum"));
    assert!(bench.ends(3, &sweep).1.contains("--force"));
    assert_eq!(bench.read("t.csv"), b"mine");
}

#[test]
fn stones_on_a_map_whose_other_parameters_differ_are_marked_so() {
    let bench = Bench::new();
    let map = |stone: &'static str, file: &'static str| {
        let command =
            [&["sweep", stone], &GRID[2..], &["--metrics", "spread", "-o", "t.csv", "--plot", file]];
        bench.good(&[&command.concat()[..], &["--force"]].concat());
        drawing(&bench, file)
    };
    let own = map("tolkowsky", "a.svg");
    assert!(own.contains(">tolkowsky<") && own.contains("reference *<"), "a table of 53 is not one of 56");
    assert!(own.contains("* with another") && own.contains("table"), "{own}");
    let other = map("round-brilliant:table=57", "b.svg");
    assert!(other.contains("tolkowsky *<") && !other.contains("tolkowsky<") && !other.contains("reference<"));
}

#[test]
fn tilts_are_drawn_about_both_axes() {
    let bench = Bench::new();
    let tilt = ["--metrics", "wlr", "--error", "0.01", "--tilt", "-30:30:15"];
    let (table, _) = bench.ends(0, &[&["score", "oval"], &tilt[..], &["--plot", "tilt.svg"]].concat());
    assert_eq!(column(&table, "tilt_axis_deg").len(), 10);
    let (wlr, axis) = (column(&table, "wlr"), column(&table, "tilt_axis_deg"));
    assert_eq!((axis[0].as_str(), axis[9].as_str(), &wlr[2]), ("0.0", "90.0", &wlr[7]));
    assert_ne!(wlr[0], wlr[5], "an oval looks otherwise when it is tilted about its length");
    let svg = drawing(&bench, "tilt.svg");
    for word in ["tilt (°)", "axis at 0°", "axis at 90°", "wlr of oval"] {
        assert!(svg.contains(word), "{word}");
    }
    let several =
        [&["score", "cube", "octahedron"], &tilt[..], &["--tilt-axis", "45", "-o", "t.csv"]].concat();
    bench.good(&several);
    assert!(!text(&bench.read("t.csv")).contains("tilt_axis"));
    bench.good(&["plot", "t.csv", "-o", "both.svg"]);
    assert!(drawing(&bench, "both.svg").contains(">octahedron<"));
}

#[test]
fn rows_are_sorted_and_the_first_kept() {
    let bench = Bench::new();
    let stones =
        ["score", "octahedron", "cube", "missing", "tolkowsky", "oval", "--metrics", "spread,weight_ratio"];
    let sorted = |options: &[&str]| {
        let (table, _) = bench.ends(1, &[&stones[..], options].concat());
        let number = |x: &String| x.parse::<f64>().ok();
        (column(&table, "stone"), column(&table, "spread").iter().map(number).collect::<Vec<_>>())
    };
    let (_, plain) = sorted(&[]);
    let (names, down) = sorted(&["--sort", "spread"]);
    assert!(down[..4].windows(2).all(|w| w[0] >= w[1]) && down[4].is_none(), "{down:?}");
    assert_eq!((names[4].as_str(), plain[2]), ("missing", None));
    let (_, up) = sorted(&["--sort", "-spread"]);
    assert!(up[..4].windows(2).all(|w| w[0] <= w[1]) && up[4].is_none(), "{up:?}");
    let top = ["--sort", "spread", "--top", "2"];
    assert_eq!(sorted(&top).1, down[..2]);
    for file in ["t.csv", "t.json"] {
        let (said, _) = bench.ends(1, &[&stones[..], &top, &["-o", file, "--json"]].concat());
        let said = json(said.as_bytes());
        assert_eq!((&said["rows"], &said["failed"], &said["files"][0]), (&2.into(), &1.into(), &file.into()));
    }
    assert_eq!(text(&bench.read("t.csv")), bench.ends(1, &[&stones[..], &top].concat()).0);
    assert_eq!(json(&bench.read("t.json")).as_array().map(Vec::len), Some(2));
    assert!(bench.ends(2, &[&stones[..], &["--sort", "wlr"]].concat()).1.contains("--metrics"));
    assert!(bench.ends(2, &[&stones[..], &["--top", "2"]].concat()).1.contains("--sort"));
}

#[test]
fn proportions_names_and_materials_of_its_own_stand_beside_a_stone() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "tolkowsky", "--size", "6.5", "-o", "d/t.toml"]);
    let score =
        ["score", "d/:material=quartz", "tolkowsky:material=topaz", "tolkowsky", "--material", "ruby"];
    let rest = ["--metrics", "spread,spread", "--proportions", "-q"];
    let (table, _) = bench.ends(0, &[&score[..], &rest].concat());
    assert_eq!(column(&table, "material"), ["quartz", "topaz", "ruby"]);
    assert_eq!(column(&table, "stone")[0], "d/t.toml:material=quartz");
    assert_eq!(
        table.lines().next().expect("a head").matches("spread").count(),
        2,
        "spread and its error, once"
    );
    for (name, expected) in [("table_percent", 53.0), ("crown_angle_deg", 34.5), ("length_to_width", 1.0)] {
        for cell in column(&table, name) {
            assert!(cell.parse::<f64>().is_ok_and(|x| (x - expected).abs() < 0.1), "{name}: {cell}");
        }
    }
    let carats: Vec<f64> = column(&table, "carats").iter().map(|c| c.parse().expect("a weight")).collect();
    assert!((carats[1] / carats[0] - 3.53 / 2.65).abs() < 0.03, "topaz and quartz: {carats:?}");
    let wrong = bench.ends(2, &["score", "d/t.toml:material=kryptonite"]).1;
    assert!(wrong.contains("kryptonite"), "{wrong}");
}

#[test]
fn ranges_keep_their_bounds() {
    let bench = Bench::new();
    for line in [
        "score cube --tilt 89.9999999999",
        "score cube --tilt 0:90:10",
        "score cube --tilt 10 --tilt-axis nan",
        "score cube --error 1e-300",
        "sweep cube --vary size=-1:1:1",
        "sweep cube --vary size=1e8",
        "sweep cube --vary ri=1:100:33",
        "sweep cube --vary ri=0.5:2:0.5",
    ] {
        let (out, said) = bench.ends(2, &line.split(' ').collect::<Vec<_>>());
        assert!(out.is_empty() && said.lines().count() == 1 && said.len() < 300, "{line}: {said}");
    }
    let (table, _) = bench.ends(0, &[&["score", "cube", "--tilt", "0:89.899999:10"], &SPREAD[..]].concat());
    assert_eq!(column(&table, "tilt_deg").last().map(String::as_str), Some("80.0"));
}

#[test]
fn a_name_that_leads_nowhere_is_a_wrong_argument_in_every_command() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("d")).expect("makes");
    for line in [
        "score none.asc",
        "show none.asc",
        "render none.asc",
        "render d",
        "render --scene none.toml",
        "render --scene d",
        "generate none.asc",
        "import none.asc -o x.obj",
        "report none.asc -o x",
        "compare cube none.asc",
        "merge none.csv -o all.csv",
        "plot none.csv -o x.svg",
        "sweep d --vary size=1",
    ] {
        let said = bench.ends(2, &line.split(' ').collect::<Vec<_>>()).1;
        assert_eq!(said.lines().count(), 1, "{line}: {said}");
    }
    assert_eq!(bench.names(), ["d"]);
}
