//! Values to try where the definition of an option has none: small work, each of another kind.

use clap::Arg;

/// A material of a user's own. The options are read in this process too, so its path is whole.
const MATERIAL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/materials/clear.toml");

/// Options that are never left out, for the work would be large without.
pub const ALWAYS: &[(&str, &str)] = &[
    ("render", "width"),
    ("render", "spp"),
    ("render", "photons"),
    ("render", "scene"),
    ("score", "metrics"),
    ("score", "error"),
    ("sweep", "metrics"),
    ("sweep", "error"),
    ("report", "stones"),
    ("compare", "metrics"),
    ("compare", "error"),
    ("validate", "only"),
    ("retarget", "ri"),
    ("retarget", "score"),
    ("optimise", "maximise"),
    ("optimise", "evaluations"),
    ("attribute", "metrics"),
    ("attribute", "error"),
];

/// Heights of a brilliant that go together.
pub const HEIGHTS: [(&str, &str); 3] = [("depth", "61.5"), ("crown-height", "15"), ("pavilion-depth", "43")];

/// Values of an option: of that command, or of every command (`*`), by the option's name or by the
/// name of its value. Arguments without a name have several words a value; of an option each word is
/// given with its flag, and an empty word is the flag alone.
type Sample = (&'static str, &'static str, &'static [&'static [&'static str]]);

const SAMPLES: &[Sample] = &[
    // stones
    (
        "generate",
        "stone",
        &[&["round-brilliant"], &["a.asc"], &["-"], &["classic"], &["oval:table=55"], &["d"]],
    ),
    ("import", "files", &[&["b.gem"], &["d"], &["a.asc", "o.stl"], &["cube"]]),
    ("show", "stones", &[&["a.asc"], &["round-brilliant", "b.gem"], &["o.stl"], &["-"], &["d"]]),
    ("render", "stones", &[&["a.asc"], &["octahedron"], &["classic"], &["-"]]),
    (
        "score",
        "stones",
        &[
            &["cube"],
            &["d"],
            &["a.asc", "round-brilliant:crown-angle=35"],
            &["d/*.asc", "octahedron"],
            &["-"],
        ],
    ),
    ("sweep", "stone", &[&["round-brilliant:facets=73"], &["a.asc"], &["oval"]]),
    ("compare", "stones", &[&["cube", "classic"], &["a.asc", "d/one.asc", "o.stl"], &["d"]]),
    ("report", "stones", &[&["a.asc"], &["cube", "o.stl"]]),
    ("edit", "stone", &[&["classic"], &["round-brilliant"], &["oval"]]),
    ("retarget", "stone", &[&["classic:ri=1.54"], &["round-brilliant:ri=1.6"]]),
    ("optimise", "stone", &[&["a.asc"], &["round-brilliant"], &["classic"], &["o.stl"]]),
    ("attribute", "stone", &[&["a.asc"], &["classic"], &["o.stl"], &["-"]]),
    // changes
    ("attribute", "metrics", &[&["spread,weight_ratio"], &["iso"], &["wlr"]]),
    ("attribute", "tilt", &[&["0,10"]]),
    ("attribute", "keep", &[&["meets"], &["angles"], &["depths"]]),
    ("attribute", "output", &[&["x.csv"], &["x.json"], &["-"]]),
    (
        "optimise",
        "vary",
        &[&["P1.angle"], &["crown.scale=0.9:1.1", "table"], &["P*.angle", "C1.angle=28:36"]],
    ),
    ("optimise", "maximise", &[&["iso"], &["iso@0,10", "weight_ratio"]]),
    ("optimise", "minimise", &[&["spread"]]),
    ("optimise", "tilt", &[&["0,10"]]),
    ("optimise", "at_least", &[&["weight_ratio=0.9*start"], &["table_percent=30"]]),
    ("optimise", "at_most", &[&["depth_percent=1.1*start"]]),
    ("optimise", "least_facet", &[&["0.1"]]),
    ("optimise", "least_girdle", &[&["0.8"]]),
    ("optimise", "tolerance", &[&["0"], &["0.2"]]),
    ("optimise", "evaluations", &[&["4"], &["7"]]),
    ("optimise", "starts", &[&["2"]]),
    ("optimise", "keep_best", &[&["2"]]),
    ("optimise", "method", &[&["random"], &["cma-es"], &["nsga-ii"]]),
    ("optimise", "keep", &[&["meets"], &["angles"], &["depths"]]),
    ("optimise", "front", &[&["front.csv"]]),
    ("optimise", "output", &[&["x.asc"], &["out"], &["x.toml"]]),
    (
        "edit",
        "set",
        &[&["P1.angle+=0.1"], &["crown.scale=0.98", "C1.index+=0"], &["girdle+=0.2"], &["P*.angle-=0.2"]],
    ),
    ("edit", "keep", &[&["meets"], &["angles"], &["depths"]]),
    ("retarget", "ri", &[&["1.62"], &["1.5"]]),
    ("retarget", "from", &[&["1.6"]]),
    ("retarget", "pavilion", &[&["best"], &["margin"], &["range"], &["keep"], &["43"]]),
    ("retarget", "crown", &[&["best"], &["prism"], &["index"], &["keep"], &["0.9"]]),
    ("*", "score", &[&["spread,weight_ratio"], &["iso,wlr"]]),
    (
        "merge",
        "parts",
        &[
            &["p1.csv", "p2.csv"],
            &["p*.csv"],
            &["q1.jsonl", "q2.jsonl"],
            &["r2.json", "r1.json"],
            &["v1.csv", "v2.csv"],
        ],
    ),
    // where to write
    ("generate", "output", &[&["x.obj"], &["x.svg"], &["x.toml", "x.png"], &["-"], &["x.glb"], &["out"]]),
    ("import", "output", &[&["x.asc"], &["out"], &["-"]]),
    (
        "render",
        "output",
        &[
            &["x.png"],
            &["x.exr"],
            &["x.jpg"],
            &["x.webp"],
            &["x.gif"],
            &["x%03d.png"],
            &["x.apng"],
            &["x.mp4"],
            &["-"],
        ],
    ),
    ("edit", "output", &[&["x.asc"], &["x.toml"], &["x.gem"], &["x.stl"], &["x.svg"], &["-"]]),
    ("retarget", "output", &[&["x.asc"], &["x.toml"], &["x.obj"], &["-"]]),
    ("*", "output", &[&["x.csv"], &["x.jsonl"], &["x.json"], &["-"]]),
    ("compare", "output", &[&["out"], &["x.md"], &["x.csv"], &["-"]]),
    ("report", "output", &[&["out"]]),
    ("validate", "output", &[&["out"]]),
    ("man", "output", &[&["out"], &["-"]]),
    ("show", "beams", &[&["beams.svg"], &["-"]]),
    ("show", "diagram", &[&["diagram.svg"], &["diagram.png"], &["diagram.pdf"], &["-"]]),
    ("render", "photon_map", &[&["x.map"]]),
    ("sweep", "plot", &[&["plot.svg"], &["iso.png", "spread.svg"]]),
    ("score", "plot", &[&["tilt.svg"]]),
    ("merge", "plot", &[&["plot.svg"]]),
    ("plot", "table", &[&["w.csv"], &["m.json"], &["t.jsonl"]]),
    ("plot", "output", &[&["w.svg"], &["iso.png", "spread.svg"]]),
    // formats
    ("import", "to", &[&["stl"], &["asc"], &["gem"], &["gltf"]]),
    ("*", "to", &[&["stl"], &["asc"], &["gem"], &["svg"], &["gltf"]]),
    ("*", "paper", &[&["a4"], &["letter"]]),
    ("*", "up", &[&["x"], &["-z"]]),
    // scores
    (
        "*",
        "metrics",
        &[
            &["spread,weight_ratio"],
            &["iso,wlr"],
            &["aset_red,leakage_strongest,windowing"],
            &["fire_streak,dispersion_mean"],
            &["table_iso,cos"],
            &["contrast,scintillation"],
            &["brightness,lost"],
        ],
    ),
    // its page takes half a minute
    ("compare", "metrics", &[&["spread,weight_ratio"], &["iso,fire_streak"], &["aset_red,contrast"]]),
    ("*", "error", &[&["0.05"], &["0.02"]]),
    ("*", "observer", &[&["0"], &["20"]]),
    ("score", "sort", &[&["iso"], &["spread"], &["-weight_ratio"]]),
    ("score", "top", &[&["1"]]),
    ("score", "outline", &[&["round"], &["square,octagon,other,oval,round"]]),
    ("*", "shard", &[&["1/2"], &["3/3"]]),
    ("score", "tilt", &[&["10"], &["-20:20:20"]]),
    ("score", "tilt_axis", &[&["90"], &["-45"]]),
    ("sweep", "vary", &[&["crown-angle=34:35:1"], &["table=55:57:2", "size=2:4:2"], &["ri=1.6:1.8:0.2"]]),
    ("sweep", "scatter", &[&["3"]]),
    // looks of plots
    ("*", "title", &[&["A title"]]),
    ("score", "range", &[&["tilt=-10:10"], &["spread=0:2"]]),
    ("*", "range", &[&["crown-angle=33:36"], &["spread=0:2"]]),
    ("*", "pixels", &[&["64"]]),
    ("*", "colours", &[&["greys"]]),
    // stones' stuff
    ("*", "material", &[&["diamond"], &["quartz"], &["ruby"], &[MATERIAL]]),
    ("*", "ri", &[&["1.54"]]),
    ("*", "size", &[&["4"]]),
    ("*", "carat", &[&["1"]]),
    ("generate", "facets", &[&["73"]]),
    ("*", "polarisation", &[&["on"], &["off"]]),
    ("*", "seed", &[&["7"]]),
    ("*", "threads", &[&["2"]]),
    // pictures
    ("render", "scene", &[&["scene.toml"], &["table"], &["daylight"]]),
    ("render", "pose", &[&["lying"], &["table-up"], &["table-down"]]),
    ("render", "width", &[&["16"], &["24"]]),
    ("report", "width", &[&["64"], &["96"]]),
    ("compare", "width", &[&["64"], &["96"]]),
    ("optimise", "width", &[&["64"], &["96"]]),
    ("render", "height", &[&["18"]]),
    ("render", "spp", &[&["1"], &["2"]]),
    ("render", "photons", &[&["100"], &["200"]]),
    ("render", "nearest", &[&["20"]]),
    ("render", "rounds", &[&["2"]]),
    // over with the first round: how many rounds a longer time has is of no command line
    ("render", "time", &[&["1us"]]),
    ("render", "noise", &[&["400%"]]),
    ("render", "frames", &[&["2"]]),
    ("render", "fps", &[&["5"]]),
    ("render", "hdr", &[&["sky.hdr"]]),
    ("render", "background", &[&["white"], &["transparent"]]),
    ("render", "turn", &[&["camera"], &["stone"], &["light"]]),
    ("render", "exposure", &[&["auto"], &["-1.5"]]),
    ("render", "tone", &[&["filmic"], &["linear"]]),
    ("render", "glare", &[&[""], &["8"]]),
    // the rest
    ("list", "names", &[&["wlr"], &["oval"]]),
    ("validate", "only", &[&["critical angle"], &["cube"]]),
];

/// The values of an option, if there are any.
pub fn of(command: &str, arg: &Arg) -> Option<&'static [&'static [&'static str]]> {
    let id = arg.get_id().as_str();
    let value = arg.get_value_names().and_then(|names| names.first()).map(|n| n.as_str());
    let find = |command: &str, key: &str| {
        SAMPLES.iter().find(|(c, k, _)| *c == command && *k == key).map(|(.., values)| *values)
    };
    find(command, id).or_else(|| find("*", id)).or_else(|| find("*", value?))
}

/// The words of an option with a value.
pub fn option(flag: &str, value: &str, with_equals: bool) -> Vec<String> {
    match (value, with_equals) {
        ("", _) => vec![flag.into()],
        (_, true) => vec![format!("{flag}={value}")],
        _ => vec![flag.into(), value.into()],
    }
}

/// Words that make a command quick without which it would not be: pictures that converge stop, reports are
/// small, and where all metrics are scored they are coarse.
pub fn tamed(command: &str, words: &[String]) -> Vec<String> {
    let has = |flag: &str| words.iter().any(|w| w == flag);
    if command == "render" && has("--progressive") && !["--rounds", "--time", "--noise"].into_iter().any(has)
    {
        return vec!["--rounds".into(), "1".into()];
    }
    let mut words = Vec::new();
    let is_page = command == "report" || (["compare", "optimise"].contains(&command) && has("out"));
    if is_page && !has("--width") {
        words.extend(["--width".into(), "64".into()]);
    }
    let all = ["score", "sweep", "compare"].contains(&command) && !has("--metrics");
    // what a retargeted stone is scored by unless it is said, too
    let changed = command == "retarget" || (command == "edit" && has("--score"));
    if (command == "report" || all || changed) && !has("--error") {
        words.extend(["--error".into(), "0.05".into()]);
    }
    words
}
