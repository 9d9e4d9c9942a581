//! Named pipes and devices as outputs: written to as they are, in every command, never replaced and never
//! called a file that is there. And places are tried before anything is written.

#![cfg(unix)]

use crate::bench::Bench;
use std::os::unix::fs::FileTypeExt;
use std::process::Command;

/// What comes out of the pipe `name` while a command runs, which must end well; it stays a pipe.
fn through(bench: &Bench, name: &str, arguments: &[&str]) -> Vec<u8> {
    let path = bench.path(name);
    if !path.exists() {
        let made = Command::new("mkfifo").arg(&path).status().expect("mkfifo starts");
        assert!(made.success(), "{name}");
    }
    let place = path.clone();
    let reader = std::thread::spawn(move || std::fs::read(place).expect("reads"));
    let out = bench.run(arguments);
    // a reader whose writer never came is let go
    if !out.status.success() {
        let _ = std::fs::OpenOptions::new().append(true).open(&path);
    }
    let read = reader.join().expect("ends");
    assert!(out.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&out.stderr));
    assert!(path.symlink_metadata().expect("is there").file_type().is_fifo(), "{arguments:?}");
    read
}

#[test]
fn every_command_writes_into_a_pipe_what_it_writes_into_a_file() {
    let bench = Bench::new();
    let quick = ["--width", "8", "--spp", "1", "--photons", "100"];
    let frames = [&["render", "-q", "cube"], &quick[..], &["--frames", "2"]].concat();
    let sweep = ["sweep", "-q", "cube", "--vary", "size=4:6:1", "--metrics", "spread,iso", "--error", "0.05"];
    bench.good(&[&sweep[..], &["-o", "p1.csv", "--shard", "1/2"]].concat());
    bench.good(&[&sweep[..], &["-o", "p2.csv", "--shard", "2/2"]].concat());
    bench.good(&[&sweep[..], &["-o", "t.csv"]].concat());
    bench.good(&["sweep", "-q", "cube", "--vary", "size=4:6:1", "--metrics", "spread", "-o", "one.csv"]);
    bench.good(&["generate", "-q", "classic", "-o", "c.asc"]);
    let cases: Vec<(&str, Vec<&str>)> = vec![
        ("g.stl", vec!["generate", "-q", "cube", "-o"]),
        ("g.svg", vec!["generate", "-q", "cube", "-o"]),
        ("i.obj", vec!["import", "-q", "c.asc", "-o"]),
        ("i.pdf", vec!["import", "-q", "c.asc", "-o"]),
        ("d.png", vec!["show", "-q", "cube", "--diagram"]),
        ("b.svg", vec!["show", "-q", "cube", "--beams"]),
        ("s.jsonl", vec!["score", "-q", "cube", "--metrics", "spread", "-o"]),
        ("w.json", [&sweep[..], &["-o"]].concat()),
        ("m.csv", vec!["merge", "-q", "p1.csv", "p2.csv", "-o"]),
        ("plot.svg", vec!["plot", "-q", "one.csv", "--title", "T", "--range", "spread=0:9", "-o"]),
        ("x.json", vec!["compare", "-q", "cube", "prism", "--metrics", "spread", "-o"]),
        ("x.md", vec!["compare", "-q", "cube", "prism", "--metrics", "spread", "-o"]),
        ("r.jpg", [&["render", "-q", "cube"], &quick[..], &["-o"]].concat()),
        ("r.gif", [&frames[..], &["-o"]].concat()),
        (
            "r.mp4",
            vec![
                "render",
                "-q",
                "cube",
                "--width",
                "32",
                "--spp",
                "1",
                "--photons",
                "100",
                "--frames",
                "2",
                "-o",
            ],
        ),
    ];
    for (name, words) in cases {
        let pipe = format!("pipe-{name}");
        let came = through(&bench, &pipe, &[&words[..], &[&pipe]].concat());
        bench.good(&[&words[..], &[name]].concat());
        let file = bench.read(name);
        // pictures hold the command that made them, which names the output in neither
        assert!(!came.is_empty() && came == file, "{name}: {} and {} bytes", came.len(), file.len());
        // again, for it is no file that is there
        assert_eq!(through(&bench, &pipe, &[&words[..], &[&pipe]].concat()), came, "{name}");
    }
    // one pipe holds no two plots
    let said = bench.ends(2, &["plot", "-q", "t.csv", "-o", "pipe-plot.svg"]).1;
    assert!(said.contains("takes one plot"), "{said}");
    let beside: Vec<String> =
        bench.names().into_iter().filter(|n| n.contains("pipe-") && !n.starts_with("pipe-")).collect();
    assert!(beside.is_empty(), "nothing is kept beside a pipe: {beside:?}");
}

#[test]
fn a_device_takes_what_has_no_extension() {
    let bench = Bench::new();
    for words in [
        &["import", "-q", "cube"][..],
        &["generate", "-q", "cube"],
        &["score", "-q", "cube", "--metrics", "spread"],
        &["render", "-q", "cube", "--width", "8", "--spp", "1", "--photons", "100"],
        &["compare", "-q", "cube", "prism", "--metrics", "spread"],
    ] {
        bench.good(&[words, &["-o", "/dev/null"]].concat());
    }
    let png = bench.run(&[
        "render",
        "-q",
        "cube",
        "--width",
        "8",
        "--spp",
        "1",
        "--photons",
        "100",
        "-o",
        "/dev/stdout",
    ]);
    assert!(png.status.success() && png.stdout.starts_with(b"\x89PNG"));
    assert!(png.stdout.ends_with(b"IEND\xaeB`\x82"), "nothing but the picture");
    assert!(bench.names().is_empty(), "{:?}", bench.names());
}

/// What is refused has written nothing, whichever of the outputs it is refused for.
#[test]
fn no_output_is_written_where_another_is_refused() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "cube", "-o", "there.svg"]);
    bench.good(&["sweep", "-q", "cube", "--vary", "size=4:5:1", "--metrics", "spread", "-o", "t.csv"]);
    std::fs::create_dir(bench.path("folder.svg")).expect("makes");
    std::fs::write(bench.path("there.csv"), "mine").expect("writes");
    let before = bench.files();
    let vary = ["--vary", "size=4:5:1", "--metrics", "spread"];
    let quick = ["--width", "8", "--spp", "1", "--photons", "100"];
    for refused in ["there.svg", "folder.svg", "there.svg/x.svg"] {
        for words in [
            vec!["show", "prism", "--beams", "new.svg", "--diagram", refused],
            vec!["show", "prism", "--diagram", "new.svg", "--beams", refused],
            vec!["show", "prism", "--beams", "-", "--diagram", refused],
            vec!["generate", "prism", "-o", "new.obj", "-o", refused],
            vec!["generate", "prism", "-o", refused, "-o", "new.obj"],
            [&["sweep", "cube"], &vary[..], &["-o", "new.csv", "--plot", refused]].concat(),
            vec!["plot", "t.csv", "-o", "spread.svg", "-o", refused],
            vec!["score", "cube", "--metrics", "spread", "--tilt", "10", "-o", "-", "--plot", refused],
        ] {
            let out = bench.run(&words);
            let code = out.status.code();
            assert!([Some(2), Some(3)].contains(&code), "{words:?}: {code:?}");
            assert!(out.stdout.is_empty(), "{words:?}");
            assert_eq!(bench.files(), before, "{words:?}");
        }
    }
    for words in [
        [&["sweep", "cube"], &vary[..], &["-o", "there.csv", "--plot", "new.svg"]].concat(),
        [&["render", "cube"], &quick[..], &["-o", "there.csv/x.png", "--photon-map", "new.map"]].concat(),
        [&["render", "cube"], &quick[..], &["-o", "new.png", "--photon-map", "there.csv/x.map"]].concat(),
    ] {
        let code = bench.run(&words).status.code();
        assert!([Some(2), Some(3)].contains(&code), "{words:?}: {code:?}");
        assert_eq!(bench.files(), before, "{words:?}");
    }
}
