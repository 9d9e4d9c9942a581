//! Text in every encoding that editors write: designs, scenes, tables and their sidecars.

use crate::bench::{Bench, text};

/// The same text as several systems save it.
fn saved(text: &str) -> Vec<(&'static str, Vec<u8>)> {
    let utf16 = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| {
        mark.into_iter().chain(text.encode_utf16().flat_map(bytes)).collect::<Vec<u8>>()
    };
    vec![
        ("UTF-16, little end first", utf16([0xff, 0xfe], u16::to_le_bytes)),
        ("UTF-16, big end first", utf16([0xfe, 0xff], u16::to_be_bytes)),
        ("UTF-8 with a mark", [&b"\xef\xbb\xbf"[..], text.as_bytes()].concat()),
        ("lines end as on Windows", text.replace('\n', "\r\n").into_bytes()),
        (
            "a mark, and lines end as on Windows",
            [&b"\xef\xbb\xbf"[..], text.replace('\n', "\r\n").as_bytes()].concat(),
        ),
        ("an end-of-file mark of DOS", [text.as_bytes(), b"\x1a"].concat()),
    ]
}

#[test]
fn designs_and_meshes_are_read_in_every_encoding() {
    let bench = Bench::new();
    for file in ["t.toml", "t.asc", "t.gcs", "t.obj", "t.stl", "t.gltf"] {
        bench.good(&["generate", "-q", "classic", "-o", file, "--force"]);
        let shown = |bench: &Bench| {
            let (said, _) = bench.ends(0, &["show", "-q", "--json", file]);
            let sheet: serde_json::Value = serde_json::from_str(&said).expect("JSON");
            (sheet[0]["facets"].clone(), sheet[0]["volume"].clone(), sheet[0]["name"].clone())
        };
        let plain = bench.read(file);
        let right = shown(&bench);
        assert!(right.0.as_u64().is_some_and(|n| n > 20), "{file}: {right:?}");
        let Ok(words) = String::from_utf8(plain) else { continue }; // binary STL
        for (how, bytes) in saved(&words) {
            std::fs::write(bench.path(file), bytes).expect("writes");
            assert_eq!(shown(&bench), right, "{file}: {how}");
        }
    }
    // neither marked nor UTF-8: Windows-1252
    let (listed, _) = bench.ends(0, &["list", "cuts", "classic"]);
    let named = format!("name = \"Fl\u{e8}che \u{bd}\"\n{}", without_name(&listed));
    let latin: Vec<u8> = named.chars().map(|c| u8::try_from(u32::from(c)).unwrap_or(b'?')).collect();
    std::fs::write(bench.path("latin.toml"), latin).expect("writes");
    let (said, _) = bench.ends(0, &["show", "latin.toml"]);
    assert!(said.contains("Flèche ½"), "{said}");
}

/// A design without the line of its name.
fn without_name(design: &str) -> String {
    let (before, after) = design.split_once("name = \"Classic\"\n").expect("it has one");
    before.to_owned() + after
}

#[test]
fn scenes_are_read_in_every_encoding() {
    let bench = Bench::new();
    let (scene, _) = bench.ends(0, &["list", "scenes", "table"]);
    std::fs::write(bench.path("s.toml"), &scene).expect("writes");
    let take = || {
        let quick = ["--width", "12", "--spp", "1", "--photons", "100", "-o", "x.png", "--force", "-q"];
        bench.good(&[&["render", "cube", "--scene", "s.toml"], &quick[..]].concat());
        bench.read("x.png")
    };
    let right = take();
    for (how, bytes) in saved(&scene) {
        std::fs::write(bench.path("s.toml"), bytes).expect("writes");
        assert_eq!(take(), right, "{how}");
    }
    // what is wrong stands in the same line
    let wrong = scene.replacen("[camera]", "[camera]\nfar = 1", 1);
    assert_ne!(wrong, scene);
    std::fs::write(bench.path("s.toml"), &wrong).expect("writes");
    let said = || bench.ends(2, &["render", "cube", "--scene", "s.toml", "-o", "y.png"]).1;
    let right = said();
    assert!(right.contains("s.toml, line "), "{right}");
    for (how, bytes) in saved(&wrong) {
        std::fs::write(bench.path("s.toml"), bytes).expect("writes");
        assert_eq!(said(), right, "{how}");
    }
}

/// A table is the same table in another encoding; one of other numbers is not.
#[test]
fn tables_and_their_sidecars_are_read_in_every_encoding() {
    let bench = Bench::new();
    let sweep = ["sweep", "-q", "cube", "--vary", "size=4:7:1", "--metrics", "spread,wlr", "--error", "0.05"];
    for (form, number) in [("csv", "1"), ("jsonl", "2"), ("json", "3")] {
        let [whole, one, two] = ["w", "p", "q"].map(|n| format!("{n}{number}.{form}"));
        bench.good(&[&sweep[..], &["-o", &whole]].concat());
        bench.good(&[&sweep[..], &["-o", &one, "--shard", "1/2"]].concat());
        bench.good(&[&sweep[..], &["-o", &two, "--shard", "2/2"]].concat());
        let parts = [one.clone(), format!("{one}.meta.json")].map(|name| (text(&bench.read(&name)), name));
        bench.good(&["plot", "-q", &whole, "-o", "wlr.svg", "--force"]);
        let (plot, table) = (bench.read("wlr.svg"), text(&bench.read(&whole)));
        for (words, name) in &parts {
            for (how, bytes) in saved(words) {
                std::fs::write(bench.path(name), bytes).expect("writes");
                bench.good(&["merge", "-q", &one, &two, "-o", &format!("all.{form}"), "--force"]);
                assert_eq!(text(&bench.read(&format!("all.{form}"))), table, "{name}: {how}");
            }
            std::fs::write(bench.path(name), words).expect("writes");
        }
        for (how, bytes) in saved(&table) {
            std::fs::write(bench.path(&whole), bytes).expect("writes");
            bench.good(&["plot", "-q", &whole, "-o", "wlr.svg", "--force"]);
            assert_eq!(bench.read("wlr.svg"), plot, "{whole}: {how}");
        }
        let other = table.replacen('4', "5", 1);
        std::fs::write(bench.path(&whole), [&b"\xef\xbb\xbf"[..], other.as_bytes()].concat())
            .expect("writes");
        let said = bench.ends(2, &["plot", "-q", &whole, "-o", "other.svg"]).1;
        assert!(said.contains("not as it was written"), "{said}");
    }
}
