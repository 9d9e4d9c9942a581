//! A small file cannot ask for much: headers that promise gigabytes, nesting and inclusion without end,
//! entities that would expand. The program runs with a gigabyte of address space and says one line.

use super::cutlab;
use cutlab::advanced::{formats, limits};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// Runs the program in `folder`, on Linux with at most so many kilobytes of address space.
fn within_memory(folder: &Path, arguments: &str) -> Output {
    /// Of address space, kB: more than memory that is used. The program itself takes a fifth of it.
    const MOST: u32 = 1_000_000;
    if !cfg!(target_os = "linux") {
        return cutlab(folder, arguments);
    }
    let program = env!("CARGO_BIN_EXE_cutlab");
    Command::new("sh")
        .args(["-c", &format!("ulimit -v {MOST}; exec {program} {arguments}")])
        .envs([("RAYON_NUM_THREADS", "2"), ("MALLOC_ARENA_MAX", "2")])
        .current_dir(folder)
        .output()
        .expect("the shell starts")
}

/// One line that says `says`, exit code 2, and in little time.
pub fn refused(folder: &Path, arguments: &str, says: &str) {
    let start = Instant::now();
    let out = within_memory(folder, arguments);
    let said = String::from_utf8_lossy(&out.stderr);
    let shown: String = said.chars().take(300).collect();
    assert_eq!(out.status.code(), Some(2), "{arguments}: {:?} {shown}", out.status);
    assert_eq!(said.trim_end().lines().count(), 1, "{arguments}: {shown}");
    assert!(said.contains(says), "{arguments}: '{shown}' without '{says}'");
    assert!(start.elapsed() < Duration::from_secs(20), "{arguments}: {:?}", start.elapsed());
}

/// Every file is refused by `show`, and is small.
fn all_refused(files: &[(&str, Vec<u8>, &str)]) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes, says) in files {
        fs::write(folder.path().join(name), bytes).expect("written");
        refused(folder.path(), &format!("show {name}"), says);
    }
}

fn ply(counts: &str, lists: &str, data: &[u8]) -> Vec<u8> {
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {counts}\nproperty float x\nproperty float y\n\
         property float z\nelement face {counts}\nproperty list {lists} int vertex_indices\nend_header\n"
    );
    [head.as_bytes(), data].concat()
}

fn gltf(accessor: &str, view: &str) -> Vec<u8> {
    format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":\
         [{{\"attributes\":{{\"POSITION\":0}}}}]}}],\"accessors\":[{{{accessor},\"componentType\":5126,\
         \"type\":\"VEC3\"}}],\"bufferViews\":[{{\"buffer\":0,{view}}}],\"buffers\":[{{\"byteLength\":4,\
         \"uri\":\"data:application/octet-stream;base64,AAAAAA==\"}}]}}"
    )
    .into_bytes()
}

#[test]
fn headers_that_promise_gigabytes_are_refused() {
    let mut stl = vec![b' '; 80];
    stl.extend(u32::MAX.to_le_bytes());
    stl.extend([0; 50]);
    let chunk = [&b"glTF\x02\0\0\0\x40\0\0\0\xf0\xff\xff\xffJSON"[..], &[b' '; 44]].concat();
    let list = [&[0; 36][..], &u32::MAX.to_le_bytes()].concat();
    let sparse = "\"count\":4000000,\"sparse\":{\"count\":4000000,\"indices\":{\"bufferView\":0,\
                  \"componentType\":5125},\"values\":{\"bufferView\":0}}";
    let gem = [&1f64.to_le_bytes()[..], &[0; 20], b"\xff"].concat();
    all_refused(&[
        ("count.stl", stl, "count.stl"),
        ("count.ply", ply("18446744073709551615", "uint", &[0; 100]), "expected"),
        ("list.ply", ply("3", "uint", &list), "more than 100000 entries of a PLY list"),
        ("overflow.ply", ply("99999999999999999999", "uint", &[]), "element NAME COUNT"),
        ("chunk.glb", chunk, "chunk.glb"),
        (
            "count.gltf",
            gltf("\"bufferView\":0,\"count\":4294967295", "\"byteLength\":4"),
            "more than 4000000 corners",
        ),
        (
            "huge.gltf",
            gltf("\"bufferView\":0,\"count\":18446744073709551615", "\"byteLength\":4"),
            "huge.gltf",
        ),
        ("nothing.gltf", gltf("\"count\":4000000", "\"byteLength\":4"), "nothing.gltf"),
        ("sparse.gltf", gltf(sparse, "\"byteLength\":4"), "a buffer that holds 4000000 elements"),
        (
            "view.gltf",
            gltf("\"bufferView\":0,\"count\":9", "\"byteLength\":18446744073709551615"),
            "view.gltf",
        ),
        ("text.gem", gem, "text.gem"),
    ]);
}

#[test]
fn nesting_without_end_is_refused() {
    let times = |text: &str, n: usize| text.repeat(n);
    let deep = |open: &str, n: usize, inner: &str, close: &str| {
        (times(open, n) + inner + &times(close, n)).into_bytes()
    };
    let named = |rest: Vec<u8>| [&b"name = \"x\"\n"[..], &rest].concat();
    let json = [&b"{\"asset\":"[..], &deep("[", 100_000, "", "]"), b"}"].concat();
    let xml = [&b"<GemCutStudio>"[..], &deep("<a>", 200_000, "", "</a>"), b"</GemCutStudio>"].concat();
    let blocks = times("AttributeBegin\n", 2000)
        + "Shape \"trianglemesh\" \"point P\" [0 0 0] \"integer indices\" [0 0 0]";
    let open = [&b"name = "[..], times("[", 500_000).as_bytes()].concat();
    all_refused(&[
        ("arrays.toml", named([&b"gear = "[..], &deep("[", 100_000, "", "]")].concat()), "arrays.toml, line"),
        ("open.toml", open, "open.toml, line 1"),
        (
            "tables.toml",
            named([&b"gear = "[..], &deep("{a=", 100_000, "1", "}")].concat()),
            "tables.toml, line",
        ),
        ("dots.toml", named((times("a.", 500_000) + "a = 1").into_bytes()), "dots.toml, line"),
        (
            "heads.toml",
            named(("[".to_string() + &times("a.", 500_000) + "a]").into_bytes()),
            "heads.toml, line",
        ),
        ("deep.gltf", json, "deep.gltf"),
        ("deep.gcs", xml, "tiers with facets"),
        ("blocks.pbrt", blocks.into_bytes(), "more than 1000 nested blocks"),
    ]);
}

/// Billion laughs, quadratic blow-up and a file from elsewhere: no document type is read at all.
#[test]
fn no_entity_of_xml_expands() {
    let mut laughs = String::from("<!ENTITY a \"ha\">");
    let mut before = 'a';
    for name in 'b'..='k' {
        laughs += &format!("<!ENTITY {name} \"{}\">", format!("&{before};").repeat(10));
        before = name;
    }
    let file = |inside: &str, used: &str| {
        format!("<?xml version=\"1.0\"?><!-- <GemCutStudio -->\n<!DOCTYPE GemCutStudio [{inside}]>\n<GemCutStudio><index gear=\"{used}\"/></GemCutStudio>")
            .into_bytes()
    };
    let long = format!("<!ENTITY a \"{}\">", "x".repeat(50_000));
    all_refused(&[
        ("laughs.gcs", file(&laughs, "&k;"), "DTD"),
        ("long.gcs", file(&long, &"&a;".repeat(50_000)), "DTD"),
        ("outside.gcs", file("<!ENTITY a SYSTEM \"file:///etc/passwd\">", "&a;"), "DTD"),
        ("unknown.gcs", b"<GemCutStudio><index gear=\"&a;\"/></GemCutStudio>".to_vec(), "line 1"),
    ]);
}

#[test]
fn designs_that_would_take_for_ever_are_refused() {
    let repeated = |n: usize| {
        let tier =
            |i| format!("[[tier]]\nname = \"t{i}\"\nangle = 40\ndistance = 1\nindices = [0]\nrepeat = {n}\n");
        ("gear = { teeth = 96 }\n".to_string() + &(0..12).map(tier).collect::<String>()).into_bytes()
    };
    // a girdle of many flats, then tables whose height is found by carving again and again
    let mut tables = String::from(
        "[[tier]]\nname = \"g\"\nangle = 90\nwidth = 2\nindices = [0]\nrepeat = 4000\n\
         [[tier]]\nname = \"p\"\nangle = -40\ndistance = 1\nindices = [0]\nrepeat = 4000\n\
         [[tier]]\nname = \"c\"\nangle = 30\ndistance = 1\nindices = [0]\nrepeat = 1000\n",
    );
    for i in 0..20 {
        tables += &format!("[[tier]]\nname = \"t{i}\"\nangle = 0\ntable = 0.{}\nindices = [0]\n", 90 - i);
    }
    let statements =
        |what: &str, n: usize| (0..n).map(|i| what.replace('#', &i.to_string())).collect::<String>();
    let attributes = format!("<GemCutStudio {}/>", statements("a#=\"\" ", 200));
    all_refused(&[
        ("repeat.toml", repeated(4_294_967_295), "more than 10000 facets"),
        ("tiers.toml", repeated(9_999), "more than 10000 facets"),
        ("tables.toml", tables.into_bytes(), "more than 100000000 steps"),
        (
            "gemcad.asc",
            ("GemCad 5.0\ng 96 0\ny 1 n\nI 1.5\na 40 1 ".to_string() + &statements("# ", 10_001))
                .into_bytes(),
            "more than 10000 facets",
        ),
        ("attributes.gcs", attributes.into_bytes(), "more than 100 attributes"),
    ]);
}

/// A file of 200 bytes that says three thousand facets: its stone and symmetry were once found in a time
/// that grew with the third power of them.
#[test]
fn thousands_of_facets_are_shown_in_seconds() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let tier =
        |angle: i32| format!("[[tier]]\nangle = {angle}\ndistance = 1\nindices = [0]\nrepeat = 1000\n");
    fs::write(folder.path().join("many.toml"), [90, -40, 30].map(tier).concat()).expect("written");
    let start = Instant::now();
    let out = within_memory(folder.path(), "show many.toml");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    assert!(String::from_utf8_lossy(&out.stdout).contains("3000"));
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

#[test]
fn panoramas_cannot_claim_to_be_large() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let hdr = |w: u32, h: u32| format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {h} +X {w}\n").into_bytes();
    for (name, w, h, says) in [
        ("wide.hdr", 16384, 8192, "more than 33554432 pixels"),
        ("vast.hdr", 4_000_000_000, 4_000_000_000, "vast.hdr"),
        ("small.hdr", 4096, 2048, "more than 1024 pixels of a panorama for each byte"),
    ] {
        fs::write(folder.path().join(name), [hdr(w, h), vec![2; 100]].concat()).expect("written");
        panorama_refused(folder.path(), name, says);
    }
    // an OpenEXR file whose windows are stretched to 65536 × 65536
    let picture = image::Rgb32FImage::from_pixel(8, 4, image::Rgb([1.0, 0.5, 0.25]));
    picture.save(folder.path().join("good.exr")).expect("written");
    let good = fs::read(folder.path().join("good.exr")).expect("is there");
    let window: Vec<u8> = [0i32, 0, 7, 3].iter().flat_map(|n| n.to_le_bytes()).collect();
    for most in [65_535i32, 4095, i32::MAX] {
        let stretched: Vec<u8> = [0, 0, most, most].iter().flat_map(|n| n.to_le_bytes()).collect();
        let mut bytes = good.clone();
        while let Some(at) = bytes.windows(16).position(|w| w == window) {
            bytes[at..at + 16].copy_from_slice(&stretched);
        }
        assert_ne!(bytes, good);
        fs::write(folder.path().join("bad.exr"), &bytes).expect("written");
        panorama_refused(folder.path(), "bad.exr", "cannot read the panorama");
    }
    #[cfg(unix)]
    {
        panorama_refused(folder.path(), "/dev/zero", "is outside the scene's folder");
        refused(folder.path(), &format!("{RENDER} --allow-outside"), "it is not a regular file");
    }
}

/// A scene in as little work as there is.
pub const RENDER: &str = "render --scene s.toml --width 4 --height 4 --spp 1 --photons 3";

fn panorama_refused(folder: &Path, name: &str, says: &str) {
    let scene = "unit = \"stone\"\n[camera]\nat = [0, -5, 5]\nfield = 30\n[[stone]]\n[[light]]\nkind = \"dome\"\nradiance = 1\n";
    fs::write(folder.join("s.toml"), format!("{scene}panorama = \"{name}\"\n")).expect("written");
    refused(folder, RENDER, says);
}

#[test]
fn scenes_are_limited_and_their_numbers_sensible() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = |more: &str| {
        format!(
            "unit = \"stone\"\n[camera]\nat = [0, -5, 5]\nfield = 30\n[[stone]]\ncut = \"cube\"\n{more}[[light]]\nkind = \"dome\"\nradiance = 1\n"
        )
    };
    let plate = "[[surface]]\ncorner = [-9, -9, 0]\nu = [18, 0, 0]\nv = [0, 18, 0]\nreflectance = 0.5\n";
    for (text, says) in [
        (scene(&"[[stone]]\n".repeat(100)), "more than 100 stones"),
        (scene(&plate.repeat(501)), "more than 500 surfaces"),
        (scene(&"[[light]]\nkind = \"dome\"\nradiance = 1\n".repeat(500)), "more than 500 lights"),
        (scene(&format!("# {}\n", "x".repeat(1 << 20))), "more than 1048576 bytes in a scene"),
        (scene("").replace("-5", "nan"), "line 3: a number beyond"),
        (scene("").replace("-5", "-1e30"), "line 3: a number beyond"),
        (scene("").replace("30", "inf"), "line 4: a number beyond"),
        (scene("").replace("30", "9_000_000_000"), "line 4: a number beyond"),
        (scene(&format!("[[stone]]\ncut = {}{}\n", "[".repeat(9999), "]".repeat(9999))), "line 8"),
    ] {
        fs::write(folder.path().join("s.toml"), text).expect("written");
        refused(folder.path(), RENDER, says);
    }
    for (text, line) in [
        (scene("").replace("\"cube\"", "\"/dev/zero\""), 6),
        (
            scene(plate)
                .replace("corner = [-9, -9, 0]\nu = [18, 0, 0]\nv = [0, 18, 0]", "mesh = \"/dev/zero\""),
            8,
        ),
    ] {
        fs::write(folder.path().join("s.toml"), text).expect("written");
        refused(folder.path(), RENDER, &format!("line {line}: "));
        refused(folder.path(), RENDER, "is outside the scene's folder");
        let says = format!("line {line}: cannot read /dev/zero: it is not a regular file");
        refused(folder.path(), &format!("{RENDER} --allow-outside"), &says);
    }
    fs::write(folder.path().join("s.toml"), scene("size = 6_500.5e-3\n")).expect("written");
    let out =
        cutlab(folder.path(), "render -q --scene s.toml --width 4 --height 4 --spp 1 --photons 3 -o s.png");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
}

#[test]
fn tables_that_are_read_back_are_limited() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    for extension in ["csv", "jsonl"] {
        for shard in ["1/2", "2/2"] {
            let part = shard.replace('/', "-");
            let out = cutlab(
                folder.path(),
                &format!(
                    "score -q octahedron cube --metrics weight_ratio --shard {shard} -o {part}.{extension}"
                ),
            );
            assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
        }
        // a row without end, with the checksum in the sidecar put right
        let row = if extension == "csv" { "\"" } else { "{" };
        let table = [
            fs::read(at(&format!("1-2.{extension}"))).expect("is there"),
            row.as_bytes().to_vec(),
            vec![b'x'; 3 << 20],
        ]
        .concat();
        let good = fs::read_to_string(at(&format!("1-2.{extension}.meta.json"))).expect("is there");
        let sum = |bytes: &[u8]| format!("{:08x}", crc32fast::hash(bytes));
        let was = sum(&fs::read(at(&format!("1-2.{extension}"))).expect("is there"));
        // the long row comes first
        let head = table.iter().position(|b| *b == b'\n').expect("a line") + 1;
        let head = if extension == "csv" { head } else { 0 };
        let long = [&table[..head], &table[table.len() - (3 << 20) - 1..]].concat();
        fs::write(at(&format!("1-2.{extension}")), &long).expect("written");
        fs::write(at(&format!("1-2.{extension}.meta.json")), good.replace(&was, &sum(&long)))
            .expect("written");
        let out = within_memory(
            folder.path(),
            &format!("merge 1-2.{extension} 2-2.{extension} -o all.{extension}"),
        );
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(said.contains("more than 1048576 bytes in a row"), "{said}");
        assert_eq!(said.trim_end().lines().count(), 1, "{said}");
        assert!(!at(&format!("all.{extension}")).exists());
        fs::write(at(&format!("1-2.{extension}.meta.json")), format!("{good}{}", " ".repeat(1 << 20)))
            .expect("written");
        refused(
            folder.path(),
            &format!("merge 1-2.{extension} 2-2.{extension} -o all.{extension}"),
            "more than 1048576 bytes in a .meta.json",
        );
    }
}

/// An excess says what raises the limit, and that does.
#[test]
fn the_limits_are_told_and_can_be_raised() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let design =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("cuts/cube.toml")).expect("is there");
    fs::write(folder.path().join("long.toml"), format!("{design}\n# {}\n", "x".repeat(5 << 20)))
        .expect("written");
    refused(
        folder.path(),
        "show long.toml",
        "more than 4194304 bytes in a TOML design: the limit; CUTLAB_LIMIT=2",
    );
    let run = |factor: &str, arguments: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cutlab"));
        command.args(arguments.split(' ')).env(limits::VARIABLE, factor).current_dir(folder.path());
        let out = command.output().expect("the program starts");
        (
            out.status.code(),
            String::from_utf8_lossy(&out.stdout).into_owned() + &String::from_utf8_lossy(&out.stderr),
        )
    };
    let (code, said) = run("2", "show long.toml");
    assert_eq!(code, Some(0), "{said}");
    for wrong in ["0", "101", "two", ""] {
        let (code, said) = run(wrong, "show cube");
        assert!(code == Some(2) && said.contains("from 1 to 100"), "{wrong}: {said}");
    }
    let (_, listed) = run("3", "list limits");
    assert!(listed.contains("30000 ") && listed.contains("facets of a stone"), "{listed}");
    assert_eq!(listed.lines().count(), limits::ALL.len());
}

/// Limits belong to a call, not to the process.
#[test]
fn readers_beside_each_other_keep_to_limits_of_their_own() {
    let design = include_str!("../../../cuts/cube.toml").to_owned() + "\n# " + &"x".repeat(5 << 20);
    let raised = limits::Limits::raised(2).expect("a factor");
    assert!(formats::read_content_bytes("long.toml", design.as_bytes(), None, raised).is_ok());
    let error = formats::read_bytes("long.toml", design.as_bytes(), None).expect_err("too long");
    assert!(error.to_string().contains("more than 4194304 bytes"), "{error}");
}

#[test]
fn the_manual_has_every_limit() {
    let manual = include_str!("../../../src/manual/limits.md");
    for limit in limits::ALL {
        let row = format!("| {} | {} |", limits::Limits::default().max(limit), limit.of);
        assert!(manual.contains(&row), "the manual lacks '{row}'");
    }
    assert!(manual.contains(limits::VARIABLE));
}
