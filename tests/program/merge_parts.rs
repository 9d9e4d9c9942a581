//! Parts of a table that `merge` joins: what failed in them is told, what is torn is named.

use crate::bench::{Bench, text};

#[test]
fn rows_that_failed_are_counted_and_a_torn_part_is_named() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "octahedron", "-o", "a.asc"]);
    std::fs::write(bench.path("b.asc"), "junk").expect("writes");
    let part = |code: i32, shard: &str, output: &str| {
        let stones = ["score", "-q", "a.asc", "b.asc", "cube", "--metrics", "spread", "--shard", shard];
        bench.ends(code, &[&stones[..], &["-o", output]].concat())
    };
    part(0, "1/2", "p1.csv");
    part(2, "2/2", "p2.csv"); // its only row failed
    let merge = |code: i32, output: &str| bench.ends(code, &["merge", "p1.csv", "p2.csv", "-o", output]).1;
    let said = merge(1, "all.csv");
    assert!(said.contains("3 rows of 2 parts, 1 failed"), "{said}");
    let table = text(&bench.read("all.csv"));
    let stones: Vec<&str> = table.lines().skip(1).filter_map(|row| row.split(',').next()).collect();
    assert_eq!(stones, ["a.asc", "b.asc", "cube"]);

    let whole = bench.read("p1.csv");
    std::fs::write(bench.path("p1.csv"), &whole[..whole.len() / 2]).expect("writes");
    let said = merge(2, "torn.csv");
    assert!(said.contains("p1.csv is not as it was written") && said.lines().count() == 1, "{said}");
    std::fs::write(bench.path("p1.csv"), &whole).expect("writes");
    std::fs::remove_file(bench.path("p2.csv.meta.json")).expect("removes");
    let said = merge(2, "alone.csv");
    assert!(said.contains("cannot read p2.csv.meta.json") && said.lines().count() == 1, "{said}");
    assert!(!bench.exists("torn.csv") && !bench.exists("alone.csv"));
}
