//! `cutlab attribute`, as a user has it.

use crate::bench::Bench;
use serde_json::Value;
use std::collections::BTreeMap;

/// A folder with a design, as it is cut and as a mesh.
fn folder() -> Bench {
    let bench = Bench::new();
    bench.good(&["generate", "classic", "-q", "-o", "c.asc", "-o", "c.stl"]);
    bench
}

fn attribute<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ["attribute", "c.asc", "-q", "--error", "0.05"].iter().chain(more).copied().collect()
}

fn json(bench: &Bench, more: &[&str]) -> Value {
    let (out, said) = bench.ends(0, &[&attribute(more)[..], &["--json"]].concat());
    serde_json::from_str(&out).unwrap_or_else(|e| panic!("{more:?}: {e}: {said}"))
}

/// The first lines say which tier to turn which way, and turning it so scores what they say.
#[test]
fn the_first_line_is_the_change_to_make() {
    let bench = folder();
    let (out, said) = bench.ends(0, &attribute(&["--metrics", "iso,windowing"]));
    assert!(said.is_empty(), "{said}");
    assert!(!out.contains('\x1b'), "{out}");
    let found = json(&bench, &["--metrics", "iso,windowing"]);
    let first = &found["objectives"][0]["first"];
    let (place, degrees) =
        (first["place"].as_str().expect("a tier"), first["degrees"].as_f64().expect("a turn"));
    let way = if degrees > 0.0 { "steeper" } else { "flatter" };
    let line = out.lines().next().expect("a line");
    let begins = line.starts_with(&format!("iso: turn {place}"));
    assert!(
        begins && line.contains(way) && line.contains("linear") && line.contains("when scored"),
        "{line}"
    );
    assert!(out.lines().nth(1).is_some_and(|line| line.starts_with("windowing (less is better): ")), "{out}");
    let set = format!("{place}.angle+={degrees}");
    let edit = ["edit", "c.asc", "--set", &set, "--score", "iso", "--exact", "--json", "-q", "--keep"];
    let tier =
        found["tiers"].as_array().expect("tiers").iter().find(|t| t["place"] == place).expect("is there");
    let (edited, _) = bench.ends(0, &[&edit[..], &[tier["keep"].as_str().expect("kept")]].concat());
    let edited: Value = serde_json::from_str(&edited).expect("JSON");
    let gain = |value: &Value| value["value"].as_f64().expect("a number");
    let (scored, exact) = (gain(&first["scored"]), gain(&edited["scores"][0]["difference"]));
    assert!((scored - exact).abs() < 1e-3 && scored > 0.0, "{scored} {exact}");
    // girdle and table cannot turn, and all else goes on
    for (place, word) in [("G1", "vertical"), ("T1", "horizontal")] {
        let row =
            out.lines().find(|line| line.starts_with(place)).unwrap_or_else(|| panic!("{place}: {out}"));
        assert!(row.contains(word) && row.contains('–'), "{row}");
    }
}

/// The table has a row for each tier, in cutting order, with the figures of the JSON.
#[test]
fn the_table_is_what_json_says() {
    let bench = folder();
    let found = json(&bench, &["--metrics", "iso,wlr", "-o", "tiers.csv"]);
    assert_eq!(found["file"], "tiers.csv");
    let table = bench.read("tiers.csv");
    let mut rows = csv::Reader::from_reader(&table[..]);
    let head: Vec<String> = rows.headers().expect("a head").iter().map(str::to_owned).collect();
    assert_eq!(
        head,
        [
            "place",
            "name",
            "zone",
            "facets",
            "angle_deg",
            "iso_per_deg",
            "iso_per_deg_se",
            "iso_per_deg_significant",
            "wlr_per_deg",
            "wlr_per_deg_se",
            "wlr_per_deg_significant",
            "leakage",
            "leakage_se",
            "followed",
            "left_out"
        ]
    );
    let tiers = found["tiers"].as_array().expect("tiers");
    let rows: Vec<csv::StringRecord> = rows.records().map(|row| row.expect("a row")).collect();
    assert_eq!(rows.len(), tiers.len());
    for (row, tier) in rows.iter().zip(tiers) {
        assert_eq!(&row[0], tier["place"].as_str().expect("a place"));
        let same = |cell: &str, value: &Value| {
            let (cell, value) = (cell.parse::<f64>().ok(), value.as_f64());
            assert!(cell.is_some() == value.is_some(), "{cell:?} {value:?}");
            assert!((cell.unwrap_or(0.0) - value.unwrap_or(0.0)).abs() < 1e-9, "{cell:?} {value:?}");
        };
        same(&row[5], &tier["changes"][0]["per_degree"]["value"]);
        same(&row[9], &tier["changes"][1]["per_degree"]["error"]);
        same(&row[11], &tier["leakage"]["value"]);
        assert_eq!(row[14].is_empty(), tier["left_out"].is_null());
    }
    // the same on a stream, on any number of threads, in colourless terminals; as JSON too
    for more in [&["--threads", "1"][..], &["--threads", "2"]] {
        let streamed = attribute(&[&["--metrics", "iso,wlr", "-o", "-"], more].concat());
        assert_eq!(bench.ends(0, &streamed).0.into_bytes(), table);
    }
    bench.good(&attribute(&["--metrics", "iso,wlr", "-o", "tiers.json"]));
    let written: Value = serde_json::from_slice(&bench.read("tiers.json")).expect("JSON");
    assert_eq!(written["tiers"], found["tiers"]);
    // the same command replaces its table, another does not
    bench.good(&attribute(&["--metrics", "iso,wlr", "-o", "tiers.csv"]));
    bench.ends(3, &attribute(&["--metrics", "iso", "-o", "tiers.csv"]));
    bench.good(&attribute(&["--metrics", "iso", "-o", "tiers.csv", "--force"]));
}

/// A mesh has the changes of the design that it was made from; tilts and NO_COLOR are heard.
#[test]
fn meshes_and_tilts_are_attributed() {
    let bench = folder();
    let of = |file: &str, more: &[&str]| {
        let arguments =
            [&["attribute", file, "-q", "--json", "--metrics", "iso", "--ri", "1.54"], more].concat();
        let (out, _) = bench.ends(0, &arguments);
        let found: Value = serde_json::from_str(&out).expect("JSON");
        let tiers = found["tiers"].as_array().expect("tiers").clone();
        let alone = tiers.into_iter().filter(|tier| tier["followed"].as_array().is_some_and(Vec::is_empty));
        let slope = |tier: Value| {
            let slope = tier["changes"][0]["per_degree"]["value"].as_f64()?;
            Some((tier["place"].to_string(), slope))
        };
        alone.filter_map(slope).collect::<BTreeMap<String, f64>>()
    };
    let (design, mesh) = (of("c.asc", &[]), of("c.stl", &[]));
    // of the mesh, whose numbers are rounded, one tier of the pavilion does not turn without the other
    let both = || design.iter().filter_map(|(place, slope)| Some((slope, mesh.get(place)?)));
    assert!(design.len() == 5 && both().count() >= 3, "{design:?} {mesh:?}");
    assert!(both().all(|(a, b)| (a - b).abs() < 0.02 * a.abs() + 0.02), "{design:?} {mesh:?}");
    assert_ne!(design, of("c.asc", &["--tilt", "0,15"]));
    let mut plain = bench.command(&attribute(&["--metrics", "iso"]));
    let plain = plain.env("NO_COLOR", "1").output().expect("runs");
    assert_eq!(
        String::from_utf8(plain.stdout).as_ref(),
        Ok(&bench.ends(0, &attribute(&["--metrics", "iso"])).0)
    );
}

#[test]
fn what_cannot_be_is_one_line_and_writes_nothing() {
    let bench = folder();
    let cube = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv 0 0 0\n\
                f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n";
    std::fs::write(bench.path("dent.obj"), cube).expect("writes");
    let there = bench.names();
    for (arguments, words) in [
        (&["c.asc", "--metrics", "isso", "-o", "t.csv"][..], "did you mean 'iso'"),
        (&["c.asc", "--metrics", "fire_streak", "--ri", "1.54", "-o", "t.csv"], "no dispersion is known"),
        (&["c.asc", "--tilt", "95", "-o", "t.csv"], "a tilt is a number of degrees"),
        (&["c.asc", "--keep", "all", "-o", "t.csv"], "meets, angles or depths"),
        (&["c.asc", "--error", "0", "-o", "t.csv"], "a standard error"),
        (&["c.asc", "-o", "t.xyz"], "xyz"),
        (&["c.asc", "-o", "t.jsonl"], "is .csv or .json"),
        (&["c.asc", "-o", "c.asc"], "c.asc"),
        (&["dent.obj", "-o", "t.csv"], "an attribution needs one"),
        (&["nothing.asc", "-o", "t.csv"], "nothing.asc"),
    ] {
        let (out, said) = bench.ends(2, &[&["attribute"], arguments].concat());
        assert!(
            out.is_empty() && said.lines().count() == 1 && said.contains(words),
            "{arguments:?}: {out}{said}"
        );
    }
    assert_eq!(bench.names(), there);
    // a stone of which nothing turns has its lost light, and says so
    let (out, _) = bench.ends(0, &["attribute", "cube", "--metrics", "windowing", "--error", "0.05", "-q"]);
    assert!(out.starts_with("windowing (less is better): no tier can be turned\n"), "{out}");
}
