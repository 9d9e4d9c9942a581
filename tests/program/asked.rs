//! What is asked for of a written stone is done or refused, and never passed over.

use crate::bench::Bench;

/// What --to says is done or refused: it is never passed over.
#[test]
fn a_format_that_is_asked_for_is_written_or_refused() {
    let bench = Bench::new();
    let format = |file: &str| {
        let json: serde_json::Value =
            serde_json::from_str(&bench.ends(0, &["show", "--json", file]).0).expect("JSON");
        json[0]["format"].as_str().expect("a format").to_owned()
    };
    bench.good(&["generate", "-q", "cube", "--to", "asc"]);
    bench.good(&["generate", "-q", "cube", "-o", "y.gem"]);
    assert_eq!(format("cube-6.asc"), "gemcad");
    for command in [["generate", "cube"], ["import", "cube-6.asc"]] {
        let (_, said) = bench.ends(2, &[&command[..], &["-o", "x.obj", "--to", "stl"]].concat());
        assert!(said.contains("x.obj") && said.contains("--to stl"), "{said}");
        let name = format!("{}.bin", command[0]);
        bench.good(&[&command[..], &["-q", "-o", &name, "--to", "gem"]].concat());
        assert_eq!(format(&name), format("y.gem"));
    }
}

/// What is set beside a folder of stones is done to each.
#[test]
fn a_folder_of_stones_takes_weight_paper_and_material() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "classic", "-o", "d/one.asc"]);
    bench.good(&["generate", "-q", "d", "-o", "out", "--to", "asc", "--carat", "2", "--material", "topaz"]);
    let alone = ["generate", "-q", "d/one.asc", "-o", "one.asc", "--carat", "2", "--material", "topaz"];
    bench.good(&alone);
    let read = |name: &str| bench.read(name);
    assert_eq!(read("out/one.asc"), read("one.asc"));
    for paper in ["a4", "letter"] {
        bench.good(&["generate", "-q", "d", "-o", paper, "--to", "svg", "--paper", paper]);
    }
    assert_ne!(read("a4/one.svg"), read("letter/one.svg"));
    // a stone's own words count as those of the command
    bench.good(&["generate", "-q", "d/one.asc:material=topaz", "-o", "own.asc", "--carat", "2"]);
    assert_eq!(read("own.asc"), read("one.asc"));
    bench.good(&["import", "d/one.asc:material=topaz", "-o", "imported.asc"]);
    bench.good(&["generate", "-q", "d/one.asc", "-o", "made.asc", "--material", "topaz"]);
    assert_eq!(read("imported.asc"), read("made.asc"));
}
