//! Many rows and many designs: what is in memory does not grow with them, and going on costs no more
//! than the rows that are there.
#![cfg(target_os = "linux")]

use crate::bench::Bench;
use cutlab::advanced::storage::journal::Journal;

/// What memory may differ by from one run to another, in kB: threads' stacks and allocators' reserves.
const ROOM: u64 = 8_000;

#[test]
#[ignore = "five seconds: .ci/run runs it"]
fn many_rows_need_no_more_memory_than_few() {
    for (table, extra) in [("t.csv", ""), ("t.jsonl", ""), ("t.json", "--scatter")] {
        let bench = Bench::new();
        let peak = |rows: u64| {
            let (steps, rows) = (format!("size=1:2:{}", 1.0 / (rows - 1) as f64), rows.to_string());
            let mut command =
                vec!["sweep", "cube", "--vary", &steps, "--metrics", "spread", "-o", table, "-q", "--force"];
            if !extra.is_empty() {
                command.extend([extra, &rows]);
            }
            bench.peak_kb(&command)
        };
        let (few, many) = (peak(500), peak(20_000));
        println!("{table}: 500 rows {few} kB, 20,000 rows {many} kB");
        assert!(many < few + ROOM, "{table}: {few} kB, then {many} kB");
    }
}

#[test]
#[ignore = "five seconds: .ci/run runs it"]
fn many_tilts_need_no_more_memory_than_few() {
    let bench = Bench::new();
    let peak = |steps: &str| {
        let tilt = format!("0:60:{steps}");
        bench.peak_kb(&[
            "score",
            "cube",
            "--tilt",
            &tilt,
            "--metrics",
            "spread",
            "-o",
            "t.csv",
            "-q",
            "--force",
        ])
    };
    let (few, many) = (peak("0.1"), peak("0.003"));
    println!("600 rows {few} kB, 20,000 rows {many} kB");
    assert!(many < few + ROOM, "{few} kB, then {many} kB");
}

#[test]
#[ignore = "five seconds: .ci/run runs it"]
fn many_designs_need_no_more_memory_than_few() {
    let peak = |designs: usize| {
        let bench = Bench::new();
        bench.good(&["generate", "tolkowsky", "-o", "in/0.asc", "-q"]);
        for i in 1..designs {
            std::fs::copy(bench.path("in/0.asc"), bench.path(&format!("in/{i}.asc"))).expect("copies");
        }
        bench.peak_kb(&["score", "in", "--metrics", "spread", "-o", "t.csv", "-q"])
    };
    let (few, many) = (peak(300), peak(2_000));
    println!("300 designs {few} kB, 2,000 designs {many} kB");
    assert!(many < few + ROOM, "{few} kB, then {many} kB");
}

/// Bytes that this process has read so far.
fn read_so_far() -> u64 {
    let text = std::fs::read_to_string("/proc/self/io").expect("Linux");
    let line = text.lines().find_map(|l| l.strip_prefix("rchar: "));
    line.and_then(|n| n.parse().ok()).expect("a number")
}

#[test]
fn going_on_reads_what_is_there_once() {
    let dir = tempfile::tempdir().expect("a folder");
    for rows in [1_000, 20_000] {
        let path = dir.path().join(format!("{rows}"));
        let open = || Journal::open(&path, "work", &|_| ()).expect("opens");
        let mut progress = open();
        (0..rows).for_each(|i| progress.append(i, &[b'x'; 100]).expect("appends"));
        drop(progress);
        let before = read_so_far();
        let mut progress = open();
        let opened = read_so_far() - before;
        let mut count = 0;
        progress
            .for_each(|row| {
                count += row.len() as u64;
                Ok(())
            })
            .expect("reads");
        let length = std::fs::metadata(&path).expect("is there").len();
        assert_eq!((progress.missing_from(), count), (rows, rows * 100));
        // the head is read on its own, and what little other tests of this process read
        let slack = 500_000;
        assert!(opened < length + slack, "{rows} rows: {opened} of {length} bytes");
        assert!(read_so_far() - before < 2 * length + slack, "{rows} rows, twice");
    }
}
