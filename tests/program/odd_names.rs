//! Names and numbers that nobody expects: bytes that are no UTF-8, line ends in names, numbers below 0 and in
//! other units, a size that must not change a shape.

use crate::bench::{Bench, text};

#[test]
fn numbers_are_refused_with_what_is_needed() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "cube", "-o", "plain.obj"]);
    for (line, said) in [
        ("show cube --carat -1", "a weight is a number of carats"),
        ("show cube --size -3", "a girdle width is a number of millimetres"),
        ("score cube --seed -1", "a seed is a whole number"),
        ("score cube --error -0.1", "a standard error is a number"),
        ("render cube --width -8", "a width is a whole number"),
        ("score cube --threads -2", "threads are a whole number"),
        ("score cube --seed 0x10", "a seed is a whole number"),
        ("score cube --error 1%", "the number alone, as 0.01"),
        ("show cube --size 0.8cm", "millimetres, as 8"),
        ("show cube --size 1in", "millimetres, as 25.4"),
        ("show round-brilliant:crown-angle=34,5", "as crown-angle=34.5"),
        ("render cube --width 640x480", "'640x480' is two"),
        ("render cube --width 1,000", "no separators, as 1000"),
        ("render cube --width 640,5", "a width is a whole number"),
        ("show cube --size -3mm", "a girdle width is a number of millimetres"),
        ("render cube --progressive --time -1s", "a time is given with its unit"),
        ("score cube --shard -1/2", "a shard is I/N"),
        ("show cube --carat 200mg", "give carats, as 1"),
        ("show cube --size 8µm", "give millimetres, as 0.008"),
        ("score cube --tilt 10:20:0", "the step is 0"),
        ("report cube -o x --exact", "unexpected argument '--exact'"),
        ("generate cube -o - -o -", "standard output is given for two outputs"),
        ("list cuts nosuch", "all: cutlab list cuts"),
        ("show plain.obj:ri=1,5", "write decimals with a point, as ri=1.5"),
        ("show plain.obj:material=topaz,size=4", "a file takes material=NAME or ri=N"),
        ("show nosuch[.asc", "there is no file 'nosuch[.asc'"),
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        let complaint = bench.ends(2, &words).1;
        assert!(complaint.contains(said) && !complaint.contains("-- -"), "{line}: {complaint}");
    }
    // a number below 0 is no option where one may stand
    bench.good(&["score", "cube", "--metrics", "spread", "--tilt", "-10"]);
    assert!(bench.ends(2, &["show", "-1"]).1.contains("-1"));
}

/// A cube of another size is a cube, whoever makes it; a prism of given height has its width set.
#[test]
fn a_size_scales_the_shape() {
    let bench = Bench::new();
    let measures = |file: &str| {
        let (said, _) = bench.ends(0, &["show", "--json", file]);
        let sheet: serde_json::Value = serde_json::from_str(&said).expect("JSON");
        ["width", "depth_percent"].map(|key| sheet[0][key].as_f64().expect("a number"))
    };
    let near = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    let generate = |options: &[&str]| {
        bench.good(&[&["generate", "-q"], options, &["-o", "x.toml", "--force"]].concat());
        measures("x.toml")
    };
    assert!(near(generate(&["cube", "--size", "4"]), [4.0, 100.0]));
    assert!(near(generate(&["prism", "--sides", "4", "--height", "5", "--size", "4"]), [4.0, 125.0]));
    assert!(near(generate(&["prism:height=2,sides=4", "--size", "4"]), [4.0, 50.0]));
    let reference = generate(&["round-brilliant"])[1];
    assert!(near(generate(&["round-brilliant", "--size", "8"]), [8.0, reference]));
    let vary = ["sweep", "cube", "--vary", "size=4:8:4", "--metrics", "weight_ratio"];
    let (table, _) = bench.ends(0, &vary);
    let ratios: Vec<&str> = table.lines().skip(1).filter_map(|row| row.split(',').nth(2)).collect();
    assert!(ratios.len() == 2 && ratios[0] == ratios[1], "the same shape: {table}");
}

/// Names in tables for people stay in their row.
#[test]
fn line_ends_in_names_end_no_line() {
    let bench = Bench::new();
    let odd = "odd\nnote: forged | <b>";
    bench.good(&["generate", "-q", "cube", "-o", "plain.obj"]);
    std::fs::copy(bench.path("plain.obj"), bench.path(&format!("{odd}.obj"))).expect("copies");
    let file = format!("{odd}.obj");
    let shows = |out: &str, how: &str| {
        assert!(!out.lines().any(|line| line.starts_with("note: forged")), "{how}: {out}");
        assert!(out.contains("odd\\nnote: forged"), "{how}: {out}");
    };
    for (how, words) in [
        ("show", vec!["show", &file]),
        ("compare", vec!["compare", &file, "plain.obj", "--metrics", "spread"]),
        ("import", vec!["import", &file, "-o", "out", "--to", "stl"]),
    ] {
        shows(&bench.ends(0, &words).0, how);
    }
    bench.good(&["compare", "-q", &file, "plain.obj", "--metrics", "spread", "-o", "c.md"]);
    let markdown = text(&bench.read("c.md"));
    shows(&markdown, "markdown");
    assert!(!markdown.contains("<b>"), "{markdown}");
    // data stays data
    let (json, _) = bench.ends(0, &["score", "--json", &file, "--metrics", "spread"]);
    let rows: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(rows[0]["stone"], file.as_str());
}

#[cfg(target_os = "linux")]
mod not_utf8 {
    use crate::bench::Bench;
    use std::ffi::OsString;
    use std::os::unix::ffi::OsStringExt;

    /// Runs a command in which `@` stands for a byte that is no UTF-8; standard output and error.
    fn good(bench: &Bench, line: &str) -> (String, String) {
        let words = line.split(' ').map(|word| OsString::from_vec(bytes(word)));
        let out = bench.command(&[]).args(words).output().expect("the program starts");
        let said = String::from_utf8(out.stderr).expect("UTF-8");
        assert_eq!(out.status.code(), Some(0), "{line}: {said}");
        (String::from_utf8(out.stdout).expect("UTF-8"), said)
    }

    fn bytes(word: &str) -> Vec<u8> {
        word.bytes().map(|b| if b == b'@' { 0xff } else { b }).collect()
    }

    fn exists(bench: &Bench, name: &str) -> bool {
        bench.path("").join(OsString::from_vec(bytes(name))).exists()
    }

    #[test]
    fn outputs_of_any_name_are_written_and_told() {
        let bench = Bench::new();
        let quick = "--width 8 --spp 1 --photons 100";
        for (line, made) in [
            ("generate cube -o a@.obj", "a@.obj"),
            ("import cube -o b@.stl", "b@.stl"),
            ("import a@.obj -o c@ --to stl", "c@/a@.stl"),
            ("sweep a@.obj --vary size=4:5:1 --metrics spread -o t@.csv --plot p@.svg", "p@.svg"),
            ("plot t@.csv -o q@.svg", "q@.svg"),
            ("score a@.obj --metrics spread -o s@.csv", "s@.csv"),
            ("compare a@.obj cube --metrics spread -o d@.csv", "d@.csv"),
            ("show a@.obj --diagram e@.svg", "e@.svg"),
            (&format!("render a@.obj {quick} -o f@.png"), "f@.png"),
        ] {
            let (json, _) = good(&bench, &format!("{line} --json"));
            assert!(exists(&bench, made), "{line}");
            serde_json::from_str::<serde_json::Value>(&json).unwrap_or_else(|e| panic!("{line}: {e} {json}"));
            let (_, said) = good(&bench, &format!("{line} --force"));
            assert!(!said.contains('\u{fffd}'), "{line}: {said}");
        }
        // default names keep the bytes, so that two stones have two files
        good(&bench, "generate a@.obj");
        assert!(
            exists(&bench, "a@-6.obj"),
            "{:?}",
            std::fs::read_dir(bench.path("")).expect("lists").count()
        );
        // scenes too
        let (scene, _) = good(&bench, "list scenes table");
        let path = bench.path("").join(OsString::from_vec(bytes("scene@.toml")));
        std::fs::write(path, scene).expect("writes");
        good(&bench, &format!("render cube --scene scene@.toml {quick} -o g.png"));
        let out = bench
            .command(&["render", "cube", "--scene"])
            .arg(OsString::from_vec(bytes("no@.toml")))
            .output()
            .expect("the program starts");
        let said = String::from_utf8(out.stderr).expect("UTF-8");
        assert!(out.status.code() == Some(2) && said.contains("no\\xff.toml"), "{said}");
    }
}
