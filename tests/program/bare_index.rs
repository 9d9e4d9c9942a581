//! Design files of faceters state an index of refraction and no material: what then cannot be had is left
//! empty, with what to do about it, said once.

use crate::bench::Bench;

const WAY_OUT: &str = "--material NAME gives one";

/// A diamond as the three formats hold it: its index is 2.417.
fn designs() -> Bench {
    let bench = Bench::new();
    for file in ["d/t.asc", "d/t.gem", "d/t.gcs"] {
        bench.good(&["generate", "-q", "tolkowsky", "-o", file]);
    }
    bench
}

#[test]
fn scores_of_colours_name_the_materials_of_the_index() {
    let bench = designs();
    let score = ["score", "d", "--metrics", "fire_streak,dispersion_mean,spread"];
    let (table, said) = bench.ends(0, &score);
    let rows: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(rows.len(), 3);
    for row in rows {
        assert!(row.contains("fire_streak, dispersion_mean left out: no dispersion is known"), "{row}");
        assert!(row.contains(WAY_OUT) && row.contains("(n = 2.417: diamond"), "{row}");
    }
    assert_eq!(said.matches(WAY_OUT).count(), 1, "said once: {said}");
    let (table, said) = bench.ends(0, &[&score[..], &["--material", "diamond"]].concat());
    assert!(!table.contains("left out") && !said.contains(WAY_OUT), "{table}{said}");

    let vary = ["--vary", "size=5:7:1", "--metrics", "fire_streak,spread"];
    let (_, said) = bench.ends(0, &[&["sweep", "d/t.gem"], &vary[..]].concat());
    assert_eq!(said.matches(WAY_OUT).count(), 1, "{said}");
    // of an index that runs through several the first is told, not each
    let vary = ["sweep", "cube", "--vary", "ri=1.54:1.58:0.01", "--metrics", "fire_streak,spread"];
    let (table, said) = bench.ends(0, &vary);
    assert_eq!(said.matches(WAY_OUT).count(), 1, "{said}");
    assert!(table.contains("(n = 1.54: ") && table.contains("(n = 1.58: "), "{table}");
    let quartz = table.lines().find(|l| l.contains("(n = 1.54: ")).expect("a row");
    assert!(quartz.contains("quartz") && !quartz.contains("diamond"), "{quartz}");
    let none = bench.ends(0, &["score", "cube", "--ri", "5", "--metrics", "fire_streak,spread"]).0;
    assert!(none.contains("(n = 5: no material is known)"), "{none}");

    let compare = ["compare", "d/t.asc", "d/t.gcs", "--metrics", "fire_streak,spread", "--error", "0.05"];
    let (shown, _) = bench.ends(0, &compare);
    for stone in ["d/t.asc", "d/t.gcs"] {
        assert_eq!(shown.matches(&format!("{stone}: fire_streak left out")).count(), 1, "{shown}");
    }
}

#[test]
fn a_picture_without_fire_says_why() {
    let bench = designs();
    let quick = ["--width", "8", "--spp", "1", "--photons", "100", "--scene", "table"];
    let render =
        |stones: &[&str]| bench.good(&[&["render"], stones, &quick, &["-o", "x.png", "--force"]].concat());
    for file in ["d/t.asc", "d/t.gem", "d/t.gcs"] {
        let said = render(&[file]);
        assert_eq!(said.matches(WAY_OUT).count(), 1, "{said}");
        assert!(said.contains("without fire and colour") && said.contains("diamond"), "{said}");
    }
    for other in [&["d/t.asc", "--material", "diamond"][..], &["d/t.asc", "--ri", "2.4"], &["tolkowsky"]] {
        assert!(!render(other).contains(WAY_OUT), "{other:?}");
    }
}
