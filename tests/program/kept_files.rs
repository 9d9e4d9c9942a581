//! Nothing of the user's is lost, overwritten or done in vain: the rule for outputs, in every command.

use crate::bench::{Bench, text};
use std::path::Path;

const SMALL: [&str; 8] = ["--width", "8", "--spp", "1", "--photons", "100", "--nearest", "5"];

/// A command of each kind that writes, with `{}` where its output goes, and the file that it then makes.
fn writers() -> Vec<(Vec<&'static str>, &'static str)> {
    let words = |line: &'static str| line.split(' ').collect::<Vec<_>>();
    let render = |line| [&words(line)[..], &SMALL].concat();
    vec![
        (words("generate -q octahedron -o o.obj"), "o.obj"),
        (words("generate -q octahedron -o o.svg"), "o.svg"),
        (words("show -q cube --diagram d.svg"), "d.svg"),
        (words("show -q cube --beams b.svg"), "b.svg"),
        (words("import -q in/a.asc -o i.obj"), "i.obj"),
        (words("import -q in -o out --to obj"), "out/a.obj"),
        (words("score -q cube --metrics spread -o t.csv"), "t.csv"),
        (words("score -q cube --metrics spread -o u.json"), "u.json.meta.json"),
        (words("score -q cube --metrics spread --tilt 0:10:5 --plot tilt.svg -o v.csv"), "tilt.svg"),
        (words("sweep -q cube --vary size=1:2:0.5 --metrics spread -o w.csv"), "w.csv"),
        (words("sweep -q cube --vary size=1:2:0.5 --metrics spread -o x.csv --plot p.svg"), "p.svg"),
        (words("sweep -q cube --vary size=1:2:0.5 --metrics spread -o y.csv --plot p.png"), "p.png"),
        (words("merge -q p1.csv p2.csv -o all.csv"), "all.csv"),
        (words("plot -q whole.csv -o again.svg"), "again.svg"),
        (words("compare -q cube octahedron --metrics spread -o c.csv"), "c.csv"),
        (words("compare -q cube octahedron --metrics spread -o c.md"), "c.md"),
        (words("validate -q --only no-such-thing-but-angle -o val"), ""),
        (render("render -q octahedron -o r.png"), "r.png"),
        (render("render -q octahedron -o r.exr"), "r.exr"),
        (render("render -q octahedron --frames 2 -o r.gif"), "r.gif"),
        (render("render -q octahedron --frames 2 -o r.apng"), "r.apng"),
        (render("render -q octahedron --frames 2 -o r%02d.png"), "r01.png"),
        (render("render -q octahedron --passes -o s.png"), "s-direct.png"),
    ]
    .into_iter()
    .filter(|(_, file)| !file.is_empty())
    .collect()
}

/// What the writers read.
fn inputs(bench: &Bench) {
    bench.good(&["generate", "-q", "octahedron", "-o", "in/a.asc"]);
    let table = ["sweep", "-q", "cube", "--vary", "size=1:2:0.5", "--metrics", "spread", "-o"];
    for (shard, part) in [("1/2", "p1.csv"), ("2/2", "p2.csv"), ("1/1", "whole.csv")] {
        bench.good(&[&table[..], &[part, "--shard", shard]].concat());
    }
}

#[test]
fn what_a_command_did_not_make_is_not_overwritten_and_its_own_is() {
    for (command, file) in writers() {
        let bench = Bench::new();
        inputs(&bench);
        if let Some(folder) = bench.path(file).parent() {
            std::fs::create_dir_all(folder).expect("makes");
        }
        std::fs::write(bench.path(file), "mine").expect("writes");
        let before = bench.files();
        let (out, said) = bench.ends(3, &command);
        assert!(out.is_empty() && said.lines().count() == 1, "{command:?}: {said}");
        assert!(said.contains(file) && said.contains("--force"), "{command:?}: {said}");
        assert!(bench.files() == before, "{command:?} leaves {:?}", bench.names());
        bench.good(&[&command[..], &["--force"]].concat());
        let made = bench.files();
        assert!(made[Path::new(file)] != b"mine", "{command:?}");
        // again, by the same command, whatever it may say on the way
        bench.good(&command);
        let (out, said) = bench.ends(0, &[&["--quiet"], &command[..]].concat());
        // what is shown is a result, beside its drawing or table
        let shows = ["show", "compare"].contains(&command[0]);
        assert!(said.is_empty() && (shows || out.is_empty()), "{command:?} --quiet: {out}{said}");
        assert!(bench.files() == made, "{command:?}");
    }
}

#[test]
fn an_input_is_never_an_output_whatever_leads_to_it() {
    let bench = Bench::new();
    inputs(&bench);
    bench.good(&["generate", "-q", "octahedron", "-o", "g.gltf"]);
    bench.good(&["generate", "-q", "octahedron", "-o", "r/stone.toml"]);
    std::fs::copy(bench.path("g.gltf"), bench.path("g.json")).expect("copies");
    #[cfg(unix)]
    std::os::unix::fs::symlink("g.json", bench.path("link.json")).expect("links");
    let here = bench.path("g.json").display().to_string();
    let score = |stone: &str, output: &str| {
        let command = ["score", stone, "--metrics", "spread", "--force", "-o", output];
        command.map(String::from).to_vec()
    };
    let mut commands = vec![
        score("./g.json", "g.json"),
        score("g.json", "./g.json"),
        score(&here, "g.json"),
        score("*.json", "g.json"),
        score("g.json:material=topaz", "g.json"),
    ];
    if cfg!(unix) {
        commands.extend([score("link.json", "g.json"), score("g.json", "link.json")]);
    }
    for line in [
        "generate in/a.asc -o in/a.asc --force",
        "generate in/a.asc -o ./in/../in/a.asc --force",
        "import in/a.asc -o in/a.asc --force",
        "import in -o in --to asc --force",
        "show in/a.asc --diagram in/a.asc --force",
        "render in/a.asc -o in/a.asc --force",
        "compare in/a.asc cube --metrics spread -o in/a.asc --force",
        "merge p1.csv p2.csv -o p1.csv --force",
        "merge p1.csv p2.csv -o ./p2.csv",
        "plot whole.csv -o whole.csv --force",
        "report r/stone.toml -o r --force",
    ] {
        commands.push(line.split(' ').map(String::from).collect());
    }
    let before = bench.files();
    for command in &commands {
        let words: Vec<&str> = command.iter().map(String::as_str).collect();
        let out = bench.run(&words);
        let said = text(&out.stderr);
        let refused = out.status.code() == Some(2) && said.trim_end().lines().count() == 1;
        assert!(refused, "{command:?}: {:?} {said}", out.status.code());
        assert!(bench.files() == before, "{command:?} changed a file");
    }
    let said = bench.ends(2, &["report", "in/a.asc", "-o", "r", "--material", "none"]).1;
    assert!(said.contains("none"), "{said}");
}

/// What a scene names, the panorama given for it and the sidecars of tables are inputs too.
#[cfg(unix)]
#[test]
fn files_that_inputs_name_are_never_outputs() {
    use std::os::unix::fs::symlink;
    let bench = Bench::new();
    inputs(&bench);
    let quick = ["--width", "8", "--height", "4", "--spp", "1", "--photons", "100", "-q"];
    bench.good(&["generate", "-q", "cube", "-o", "floor.obj"]);
    bench.good(&["generate", "-q", "octahedron", "-o", "stone.asc"]);
    bench.good(&[&["render", "cube", "-o", "sky.exr"], &quick[..]].concat());
    let (table, _) = bench.ends(0, &["list", "scenes", "table"]);
    let mesh = "\n[[surface]]\nmesh = \"floor.obj\"\nat = [9, 9, 9]\nreflectance = 0.5\n";
    let scene = table.replacen("cut = \"round-brilliant\"", "cut = \"stone.asc\"", 1) + mesh;
    assert!(scene.contains("stone.asc"));
    std::fs::write(bench.path("s.toml"), scene).expect("writes");
    for (link, target) in
        [("mesh.png", "floor.obj"), ("cut.png", "stone.asc"), ("meta.svg", "whole.csv.meta.json")]
    {
        symlink(target, bench.path(link)).expect("links");
    }
    symlink("p1.csv.meta.json", bench.path("part.json")).expect("links");
    let before = bench.files();
    for words in [
        vec!["render", "--scene", "s.toml", "-o", "mesh.png", "--force"],
        vec!["render", "--scene", "s.toml", "-o", "cut.png", "--force"],
        vec!["render", "cube", "--scene", "daylight", "--hdr", "sky.exr", "-o", "sky.exr", "--force"],
        vec!["plot", "whole.csv", "-o", "meta.svg", "--force"],
        vec!["merge", "p1.csv", "p2.csv", "-o", "part.json", "--force"],
    ] {
        let is_picture = words[0] == "render";
        let out = bench.run(&[&words[..], if is_picture { &quick[..] } else { &[] }].concat());
        let said = text(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{words:?}: {said}");
        assert!(said.contains("is an input") || words[0] == "plot", "{words:?}: {said}");
        assert!(bench.files() == before, "{words:?} changed a file");
    }
}

#[test]
fn two_outputs_are_never_one_file() {
    let bench = Bench::new();
    for line in [
        "generate cube -o a.obj -o ./a.obj",
        "sweep cube --vary size=1:2:1 --metrics spread -o t.csv --plot p.svg --plot p.svg",
        "render cube --width 8 --spp 1 --photon-map z.png -o z.png",
    ] {
        let said = bench.ends(2, &line.split(' ').collect::<Vec<_>>()).1;
        assert!(said.contains("two outputs"), "{line}: {said}");
        assert!(bench.names().is_empty(), "{line}: {:?}", bench.names());
    }
}

/// Commands that would take a while, each told of a place where nothing can be written.
#[test]
fn places_are_tried_before_the_work() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("folder")).expect("makes");
    std::fs::create_dir(bench.path("folder.csv")).expect("makes");
    std::fs::write(bench.path("file"), "x").expect("writes");
    #[cfg(unix)]
    for (target, link) in [("nowhere", "dangling.csv"), ("loop.csv", "loop.csv")] {
        std::os::unix::fs::symlink(target, bench.path(link)).expect("links");
    }
    let long = format!("{}.csv", "x".repeat(252));
    let nearly = format!("{}.csv", "x".repeat(245)); // its sidecar has no room
    let mut places = vec!["folder", "folder.csv", "file/t.csv", &long, &nearly];
    if cfg!(unix) {
        places.extend(["dangling.csv", "loop.csv"]);
    }
    let endless = ["--metrics", "wlr", "--error", "1e-7"];
    let before = bench.names();
    for place in places {
        for command in [&["score", "tolkowsky"][..], &["sweep", "cube", "--vary", "size=1:2:0.001"]] {
            let command = [command, &endless, &["-o", place]].concat();
            let (out, said) = bench.ends(3, &command);
            assert!(out.is_empty() && said.lines().count() == 1, "{command:?}: {said}");
            assert!(said.contains(&place[..8.min(place.len())]), "{command:?}: {said}");
        }
    }
    for line in [
        "report tolkowsky -o file",
        "compare tolkowsky octahedron --error 1e-7 -o file/x",
        "validate -o file",
        "render --width 4000 --spp 1000 -o file/x.png",
        "import folder -o file/x --to obj",
        "score tolkowsky --metrics wlr --tilt -80:80:0.01 --plot folder/../file/t.svg",
    ] {
        let out = bench.run(&line.split(' ').collect::<Vec<_>>());
        let said = text(&out.stderr);
        let code = if line.starts_with("import") { [Some(2), Some(3)] } else { [Some(3); 2] };
        assert!(code.contains(&out.status.code()) && said.lines().count() == 1, "{line}: {said}");
    }
    assert_eq!(bench.names(), before);
}

#[cfg(unix)]
#[test]
fn read_only_files_are_refused_and_modes_are_kept() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    let score = ["score", "-q", "cube", "--metrics", "spread", "-o", "t.csv", "--force"];
    let mode = |mode: u32| {
        std::fs::set_permissions(bench.path("t.csv"), PermissionsExt::from_mode(mode)).expect("sets");
    };
    bench.good(&score);
    let whole = bench.read("t.csv");
    std::fs::write(bench.path("t.csv"), "old").expect("writes");
    mode(0o444);
    assert!(bench.ends(3, &score).1.contains("read-only"));
    assert_eq!(bench.read("t.csv"), b"old");
    mode(0o640);
    bench.good(&score);
    let kept = bench.path("t.csv").metadata().expect("there").permissions().mode();
    assert_eq!((bench.read("t.csv"), kept & 0o777), (whole, 0o640));
}

#[cfg(target_os = "linux")]
#[test]
fn streams_have_no_sidecars_and_stay_what_they_are() {
    let bench = Bench::new();
    let score = ["score", "-q", "cube", "--metrics", "spread", "-o"];
    let plain = bench.ends(0, &[&score[..], &["-"]].concat()).0;
    for name in ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"] {
        assert_eq!(bench.ends(0, &[&score[..], &[name]].concat()).0, plain, "{name}");
        let file = std::fs::File::create(bench.path("f")).expect("creates");
        let status = bench.command(&[&score[..], &[name]].concat()).stdout(file).status().expect("starts");
        assert!(status.success() && text(&bench.read("f")) == plain, "{name}");
        assert_eq!(bench.names(), ["f"], "{name}");
    }
    inputs(&bench);
    let merged = bench.ends(0, &["merge", "p1.csv", "p2.csv", "-o", "-"]).0;
    assert_eq!(merged, text(&bench.read("whole.csv")));
    let json = bench.ends(0, &["merge", "p1.csv", "p2.csv", "-o", "/dev/stdout", "--json"]).0;
    assert_eq!(
        serde_json::from_str::<serde_json::Value>(&json).expect("JSON").as_array().map(Vec::len),
        Some(3)
    );
    let before = bench.files();
    let made = std::process::Command::new("mkfifo").arg(bench.path("fifo.csv")).status();
    if made.is_ok_and(|status| status.success()) {
        let fifo = bench.path("fifo.csv");
        let reader = std::thread::spawn(move || std::fs::read(fifo).expect("reads"));
        bench.good(&["merge", "p1.csv", "p2.csv", "-o", "fifo.csv"]);
        assert_eq!(text(&reader.join().expect("ends")), merged);
        std::fs::remove_file(bench.path("fifo.csv")).expect("removes");
    }
    bench.good(&["import", "-q", "in/a.asc", "-o", "/dev/null"]);
    assert!(!Path::new("/dev/null").is_file() && bench.files() == before);
}
