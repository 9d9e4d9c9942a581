//! How commands end when something is in the way: interrupts, readers that go away, a full disk, a
//! folder that cannot be written, an input that vanishes or is replaced. One line, the right exit code,
//! and no part of a file.
#![cfg(unix)]

use crate::bench::{Bench, text};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

const SMALL: [&str; 10] =
    ["--width", "32", "--height", "24", "--spp", "4", "--photons", "2000", "--nearest", "50"];

/// Work that takes longer than any test waits.
const ENDLESS: [&str; 4] = ["--metrics", "wlr", "--error", "0.0000001"];

/// Exit code and the lines on standard error, all of which must be the program's.
fn ended(out: &Output) -> (Option<i32>, Vec<String>) {
    let lines: Vec<String> = text(&out.stderr).lines().map(String::from).collect();
    assert!(lines.iter().all(|l| l.starts_with("cutlab: ") && !l.contains("panicked")), "{lines:?}");
    (out.status.code(), lines)
}

fn send(signal: &str, id: u32) {
    let sent = Command::new("kill").args([signal, &id.to_string()]).status().expect("kill runs");
    assert!(sent.success());
}

fn visible(bench: &Bench) -> Vec<String> {
    bench.names().into_iter().filter(|n| !n.starts_with('.')).collect()
}

#[test]
fn an_interrupt_is_one_line_that_says_whether_the_work_is_kept() {
    let frames: Vec<&str> = [&["render", "--frames", "9999", "-o", "t.gif", "-q"], &SMALL[..]].concat();
    let picture = ["render", "--spp", "1000000", "-o", "p.png", "-q"];
    let table = [&["score", "-q", "-o", "t.csv"], &ENDLESS[..]].concat();
    let stream = [&["score", "-q"], &ENDLESS[..]].concat();
    let sweep = [&["sweep", "cube", "--vary", "size=1:2:0.1", "-q", "-o", "t.csv"], &ENDLESS[..]].concat();
    for (command, kept) in
        [(&frames[..], true), (&table, true), (&sweep, true), (&picture[..], false), (&stream, false)]
    {
        for signal in ["-INT", "-TERM"] {
            let bench = Bench::new();
            let child = bench.command(command).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
            let child = child.expect("the program starts");
            std::thread::sleep(Duration::from_millis(700));
            send(signal, child.id());
            let (code, lines) = ended(&child.wait_with_output().expect("ends"));
            assert_eq!((code, lines.len()), (Some(130), 1), "{command:?} {signal}: {lines:?}");
            assert_eq!(lines[0].contains("the same command goes on"), kept, "{command:?}: {lines:?}");
            assert!(visible(&bench).is_empty(), "{command:?}: {:?}", bench.names());
        }
    }
}

#[test]
fn a_reader_that_has_read_enough_ends_it_quietly() {
    let bench = Bench::new();
    bench.good(&["generate", "tolkowsky", "-o", "in/a.asc", "-o", "in/b.gem", "-q"]);
    let sweep = ["sweep", "cube", "--vary", "size=1:100:0.0001", "--metrics", "spread", "-o", "-"];
    let score = ["score", "in", "cube", "octahedron", "--metrics", "wlr", "--error", "0.01", "--json"];
    let json_lines = ["sweep", "cube", "--vary", "size=1:100:0.0001", "--metrics", "spread", "--json"];
    let commands: [(&[&str], &str); 8] = [
        (&sweep, "size,facets"),
        (&json_lines, "["),
        (&score, "["),
        (&["list"], ""),
        (&["list", "metrics"], ""),
        (&["--help"], "A laboratory"),
        (&["score", "--help"], ""),
        (&["generate", "-o", "-", "-q"], ""),
    ];
    for (command, first) in commands {
        let begun = Instant::now();
        let child = bench.command(command).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
        let mut child = child.expect("the program starts");
        let mut line = String::new();
        let mut reader = BufReader::with_capacity(1, child.stdout.take().expect("piped"));
        reader.read_line(&mut line).expect("UTF-8");
        drop(reader);
        let (code, lines) = ended(&child.wait_with_output().expect("ends"));
        assert!(line.starts_with(first), "{command:?}: {line}");
        assert!(
            code == Some(0) || (command == ["list"] && code == Some(2)),
            "{command:?}: {code:?} {lines:?}"
        );
        assert!(code != Some(0) || lines.is_empty(), "{command:?}: {lines:?}");
        assert!(begun.elapsed() < Duration::from_secs(20), "{command:?} goes on without a reader");
    }
}

/// Commands that write files, with how many files each leaves.
fn writers() -> Vec<(Vec<&'static str>, usize)> {
    let words = |line: &'static str| line.split(' ').collect::<Vec<_>>();
    let render = |line| [&words(line)[..], &SMALL].concat();
    vec![
        (words("generate -q -o o/s.obj"), 1),
        (words("generate -q -o o/s.svg"), 1),
        (words("import -q in -o o --to obj"), 3),
        (words("score -q in --metrics wlr --error 0.01 -o o/t.csv"), 2),
        (words("sweep -q cube --vary size=1:3:0.01 --metrics spread -o o/t.jsonl"), 2),
        (words("sweep -q cube --vary size=1:2:0.2 --metrics spread -o o/t.csv --plot o/m.svg"), 3),
        (words("merge -q p1.csv p2.csv -o o/all.csv"), 2),
        (render("render -q octahedron -o o/p.png"), 1),
        (render("render -q octahedron -o o/p.exr"), 1),
        (render("render -q octahedron --photon-map o/kept.map -o p.png"), 1),
        (render("render -q octahedron --frames 2 -o o/a.gif"), 1),
        (render("render -q octahedron --frames 2 -o o/%d.png"), 2),
        (words("show -q cube --diagram o/d.svg"), 1),
    ]
}

/// What the writers read.
fn inputs(bench: &Bench) {
    for file in ["in/a.asc", "in/b.toml", "in/c.stl"] {
        bench.good(&["generate", "-q", "-o", file]);
    }
    for (shard, part) in [("1/2", "p1.csv"), ("2/2", "p2.csv")] {
        let table = ["--vary", "size=1:3:0.01", "--metrics", "spread", "--shard", shard, "-o", part, "-q"];
        bench.good(&[&["sweep", "cube"], &table[..]].concat());
    }
}

/// Runs `command` where it cannot write, then where it can: after the first nothing of the kind is
/// there, and the second ends in the bytes of a run that was never disturbed.
fn fails_then_succeeds(
    bench: &Bench,
    command: &[&str],
    files: usize,
    failing: impl FnOnce(&Bench, &[&str]) -> Output,
    mend: impl FnOnce(),
) {
    let (code, lines) = ended(&failing(bench, command));
    assert_eq!(code, Some(3), "{command:?}: {lines:?}");
    let most = if command[0] == "import" { 3 } else { 1 }; // a line a stone
    assert!((1..=most).contains(&lines.len()), "{command:?}: {lines:?}");
    let outputs = || bench.files().into_iter().filter(|(path, _)| path.starts_with("o"));
    let hidden = |p: &Path| p.iter().any(|part| part.as_encoded_bytes().starts_with(b"."));
    let left: Vec<_> = outputs().filter(|(p, _)| !hidden(p)).collect();
    mend();
    bench.good(command);
    let written = bench.files();
    for (path, bytes) in left {
        assert!(written[&path] == bytes, "{command:?}: {} was no whole file", path.display());
    }
    let names: Vec<_> = outputs().map(|(path, _)| path).collect();
    assert_eq!(names.len(), files, "{command:?}: {names:?}");
    let whole = Bench::new();
    inputs(&whole);
    whole.good(command);
    assert!(whole.files().into_iter().filter(|(p, _)| p.starts_with("o")).eq(outputs()), "{command:?}");
}

/// A file may grow no larger than 512 bytes: every write beyond fails as on a full disk.
#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn a_full_disk_is_one_line_and_nothing_half_written() {
    for (command, files) in writers() {
        let bench = Bench::new();
        inputs(&bench);
        let failing = |bench: &Bench, command: &[&str]| {
            let shell = "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"";
            let mut limited = Command::new("sh");
            limited.args(["-c", shell, env!("CARGO_BIN_EXE_cutlab")]).args(command);
            limited.current_dir(bench.path("")).output().expect("a shell")
        };
        fails_then_succeeds(&bench, &command, files, failing, || ());
    }
}

/// Mounts a file system on `o` of the bench; none where this is not allowed.
struct Mount(std::path::PathBuf);

impl Mount {
    fn new(bench: &Bench, options: &str) -> Option<Mount> {
        let at = bench.path("o");
        std::fs::create_dir_all(&at).expect("makes");
        let mount = Command::new("mount").args(["-t", "tmpfs", "-o", options, "tmpfs"]).arg(&at).output();
        mount.ok().filter(|out| out.status.success()).map(|_| Mount(at))
    }

    fn again(&self, options: &str) {
        let done = Command::new("mount").args(["-o", &format!("remount,{options}")]).arg(&self.0).status();
        assert!(done.expect("mount runs").success());
    }
}

impl Drop for Mount {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}

#[test]
#[ignore = "twenty seconds: .ci/run runs it"]
fn a_small_disk_and_a_read_only_one() {
    for (before, after) in [("size=4k", "size=64m"), ("ro", "rw")] {
        for (command, files) in writers() {
            let bench = Bench::new();
            inputs(&bench);
            let Some(mount) = Mount::new(&bench, before) else {
                println!("skipped: nothing can be mounted here");
                return;
            };
            if before == "size=4k" {
                // nothing is left of its one page
                std::fs::write(bench.path("o/.full"), vec![0; 4096]).expect("fits");
            }
            let mend = || {
                mount.again(after);
                let _ = std::fs::remove_file(bench.path("o/.full"));
            };
            fails_then_succeeds(&bench, &command, files, Bench::run, mend);
        }
    }
}

#[test]
fn a_full_device_is_named() {
    if !Path::new("/dev/full").exists() {
        println!("skipped: there is no /dev/full");
        return;
    }
    let bench = Bench::new();
    let score = ["score", "cube", "--metrics", "spread"];
    let out = bench.run(&[&score[..], &["-o", "/dev/full"]].concat());
    let (code, lines) = ended(&out);
    assert_eq!((code, lines.len()), (Some(3), 1), "{lines:?}");
    assert!(lines[0].contains("/dev/full"), "{lines:?}");
    for command in [&score[..], &["list", "cuts"], &["--help"], &["generate", "-q", "-o", "-"]] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("opens");
        let child = bench.command(command).stdout(full).stderr(Stdio::piped()).spawn().expect("starts");
        let (code, lines) = ended(&child.wait_with_output().expect("ends"));
        assert_eq!((code, lines.len()), (Some(3), 1), "{command:?}: {lines:?}");
        assert!(lines[0].contains("standard output"), "{lines:?}");
    }
    bench.good(&[&score[..], &["-o", "/dev/null"]].concat());
    assert!(!Path::new("/dev/null").is_file() && bench.names().is_empty());
}

/// Starts a long score of a folder, changes its last file while the first is at work; what it ends in.
fn meanwhile(change: impl Fn(&Path)) -> (Bench, Output) {
    let bench = Bench::new();
    for i in 0..12 {
        bench.good(&["generate", "-q", "-o", &format!("in/{i:02}.toml")]);
    }
    let command = ["score", "in", "--metrics", "wlr", "--error", "0.0005", "-o", "t.csv", "-q"];
    let mut child = bench.command(&command);
    // rows of one thread come in their order
    let child = child.env("RAYON_NUM_THREADS", "1").stderr(Stdio::piped()).spawn().expect("starts");
    let begun = Instant::now();
    while !bench.exists(".t.csv.progress") && begun.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(1));
    }
    change(&bench.path("in/11.toml"));
    let out = child.wait_with_output().expect("ends");
    (bench, out)
}

#[test]
fn an_input_that_vanishes_fails_alone() {
    let (bench, out) = meanwhile(|file| std::fs::remove_file(file).expect("removes"));
    let (code, lines) = ended(&out);
    assert_eq!((code, lines.len()), (Some(1), 1), "{lines:?}");
    assert!(lines[0].contains("in/11.toml"), "{lines:?}");
    let table = text(&bench.read("t.csv"));
    assert_eq!(table.lines().count(), 13, "{table}");
    assert!(table.lines().nth(12).expect("its row").contains("vanished"), "{table}");
}

#[test]
fn an_input_that_is_replaced_meanwhile_has_no_scores() {
    let (bench, out) = meanwhile(|file| {
        let other = text(&std::fs::read(file).expect("reads")).replace("34", "35");
        std::fs::write(file, other).expect("writes");
    });
    let (code, lines) = ended(&out);
    assert_eq!((code, lines.len()), (Some(1), 1), "{lines:?}");
    assert!(lines[0].contains("in/11.toml") && lines[0].contains("replaced"), "{lines:?}");
    let table = text(&bench.read("t.csv"));
    assert!(table.lines().nth(12).expect("its row").contains(",,"), "{table}");
    bench.good(&["score", "in", "--metrics", "wlr", "--error", "0.01", "-o", "t.csv", "-q", "--force"]);
}

/// What may not be looked at is not taken for a name that leads nowhere.
#[cfg(unix)]
#[test]
fn what_there_is_no_right_to_look_at_is_an_error_of_reading() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    bench.good(&["generate", "-q", "octahedron", "-o", "closed/a.asc"]);
    let close = |mode| {
        std::fs::set_permissions(bench.path("closed"), PermissionsExt::from_mode(mode)).expect("sets");
    };
    close(0o000);
    let said = bench.ends_for_a_user(3, &["show", "closed/a.asc"]);
    close(0o755);
    if let Some((out, said)) = said {
        assert!(out.is_empty() && said.contains("closed/a.asc: Permission denied"), "{said}");
    }
}
