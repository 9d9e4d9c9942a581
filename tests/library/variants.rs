//! The ways in which people and programs write the formats: each odd file reads as the plain one.

use cutlab::advanced::formats::{self, Loaded};
use cutlab::advanced::stone::Stone;
use std::fmt::Write;

fn read(name: &str, bytes: &[u8]) -> Loaded {
    formats::read_bytes(name, bytes, None).unwrap_or_else(|e| panic!("{e}"))
}

fn refused(name: &str, bytes: &[u8]) -> String {
    formats::read_bytes(name, bytes, None).map(|i| i.format).expect_err("is refused").to_string()
}

fn volume(stone: &Loaded) -> f64 {
    stone.design.solid().expect("closed").volume()
}

/// A square stone: pavilion, girdle, crown, table.
const PLAIN: &str = "GemCad 5.0\ng 96 0.0\ny 4 y\nI 1.54\nH Square\na -42 0.5 96 n P 24 48 72 G Meet\n\
                     a -90 1 96 n G 24 48 72\na 40 0.9 96 n C 24 48 72\na 0 0.4 96 n T\nF by hand\n";

#[test]
fn gemcad_text_of_every_hand_is_one_stone() {
    let plain = read("x.asc", PLAIN.as_bytes());
    let swap = |from: &str, to: &str| {
        assert!(PLAIN.contains(from), "{from}");
        PLAIN.replace(from, to).into_bytes()
    };
    let every = |from: &str, to: &str| PLAIN.replace(from, to).into_bytes();
    let mut marked = b"\xEF\xBB\xBF".to_vec();
    marked.extend(PLAIN.as_bytes());
    for (what, bytes) in [
        ("CRLF", every("\n", "\r\n")),
        ("lone CR", every("\n", "\r")),
        ("byte-order mark", marked),
        ("tabs", every(" ", "\t")),
        ("empty lines", every("\n", "\n\n")),
        ("NUL padding", [PLAIN.as_bytes(), &[0; 64]].concat()),
        ("exponents", swap("0.9 ", "9.0e-1 ")),
        ("comments", swap("a 0", "; the table\n# last\na 0")),
        ("no title", swap("GemCad 5.0\n", "")),
        ("lower-case title", swap("GemCad 5.0", "gemcad")),
        ("letter and gear together", swap("g 96", "g96")),
        ("no gear letter", swap("g 96", "96")),
        ("no offset", swap("g 96 0.0", "g 96")),
        ("no symmetry", swap("y 4 y\n", "")),
        ("symmetry in words", swap("y 4 y", "y four-fold")),
        ("no index of refraction", swap("I 1.54\n", "")),
        ("index of refraction in words", swap("I 1.54", "I quartz")),
        ("index 0 for 96", every(" 96 n", " 0 n")),
        ("index beyond the wheel", every(" 96 n", " 192 n")),
        ("whole numbers with decimals", every(" 24 ", " 24.000 ")),
        ("girdle at +90", swap("a -90", "a 90")),
        ("typographic minus", swap("a -42", "a \u{2212}42")),
        ("continued by indices", swap(" 48 72 G Meet", "\n 48 72 G Meet")),
        ("continued by a name", swap("96 n P", "96\n n P")),
        ("instructions on a line of their own", swap(" G Meet", "\n G Meet")),
        ("indented tiers", every("\na ", "\n  a ")),
        ("indented keywords", every("\nF ", "\n  F ")),
        ("table without index", swap("a 0 0.4 96 n T", "a 0 0.4 n T")),
        ("stray words at the end", [PLAIN.as_bytes(), b"Printed by someone\n"].concat()),
        ("a footer that runs on", [PLAIN.as_bytes(), b"  12 times,  and on\n"].concat()),
        ("no line end", PLAIN.trim_end().as_bytes().to_vec()),
    ] {
        let other = read("x.asc", &bytes);
        assert_eq!(other.format, "gemcad", "{what}");
        let off = |(p, q): (cutlab::advanced::geometry::Plane, cutlab::advanced::geometry::Plane)| {
            p.normal.distance(q.normal).max((p.distance - q.distance).abs())
        };
        let (mine, its) = (plain.design.planes(), other.design.planes());
        assert_eq!(mine.len(), its.len(), "{what}");
        let off = mine.into_iter().zip(its).map(off).fold(0.0, f64::max);
        assert!(off < 1e-15, "{what}: {off:e}");
    }
    let run_on = read("x.asc", &[PLAIN.as_bytes(), b"  12 times\n"].concat());
    assert_eq!(run_on.design.footers, ["by hand 12 times"]);
    let mirrored = read("x.asc", PLAIN.replace("g 96", "g -96").as_bytes());
    assert!((volume(&mirrored) / volume(&plain) - 1.0).abs() < 1e-12);
    let turned = read("x.asc", PLAIN.replace(" 96 n", " 94.5 n").as_bytes()).design;
    assert_eq!(turned.tiers[0].facets[0].index, Some(94.5));
    assert!(refused("x.asc", PLAIN.replace("72 G Meet", "7x2").as_bytes()).contains("line 6"));
}

/// Corners and faces of a cube of side 2, each face a square, outward.
const CUBE: [[i32; 3]; 8] =
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]];
const SIDES: [[usize; 4]; 6] =
    [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [2, 3, 7, 6], [1, 2, 6, 5], [3, 0, 4, 7]];

fn is_the_cube(what: &str, stone: &Loaded) {
    assert!((volume(stone) - 8.0).abs() < 1e-6, "{what}: {}", volume(stone));
    assert_eq!(stone.design.facets().count(), 6, "{what}");
}

fn corners(start: &str, end: &str) -> String {
    CUBE.iter().map(|[x, y, z]| format!("{start}{x} {y} {z}{end}\n")).collect()
}

/// `f` lines of the cube, each corner as `corner` says (from 1).
fn faces(corner: impl Fn(usize) -> String) -> String {
    let face = |s: &[usize; 4]| s.iter().map(|&c| format!(" {}", corner(c + 1))).collect::<String>();
    SIDES.iter().map(|s| format!("f{}\n", face(s))).collect()
}

#[test]
fn obj_files_of_every_hand_are_one_stone() {
    let plain = faces(|c| c.to_string());
    let v = corners("v ", "");
    for (what, text) in [
        ("quads", format!("{v}{plain}")),
        ("CRLF", format!("{v}{plain}").replace('\n', "\r\n")),
        ("tabs", format!("{v}{plain}").replace(' ', "\t")),
        ("counted from the end", format!("{v}{}", faces(|c| format!("{}", c as i64 - 9)))),
        ("texture that is not there", format!("{v}{}", faces(|c| format!("{c}/{c}")))),
        ("normals of nan", format!("{v}vn nan nan nan\n{}", faces(|c| format!("{c}//1")))),
        ("colours", format!("{}{plain}", corners("v ", " 0.5 0.5 0.5"))),
        ("weights", format!("{}{plain}", corners("v ", " 1.0"))),
        ("objects, groups, materials", {
            let parted: String =
                plain.lines().map(|l| format!("o a\ng b c\nusemtl d\ns off\n{l}\n")).collect();
            format!("mtllib nowhere.mtl\n{v}{parted}")
        }),
        ("corners between faces", {
            let mut text = String::new();
            for side in SIDES {
                for [x, y, z] in side.map(|c| CUBE[c]) {
                    let _ = writeln!(text, "v {x} {y} {z}");
                }
                text += "f -4 -3 -2 -1\n";
            }
            text
        }),
        ("every face twice, from both sides", {
            let back: String = SIDES
                .iter()
                .map(|s| format!("f {} {} {} {}\n", s[3] + 1, s[2] + 1, s[1] + 1, s[0] + 1))
                .collect();
            format!("{v}{plain}{back}")
        }),
        ("a long comment first", format!("{}{v}{plain}", "# someone's words\n".repeat(400))),
        ("exponents", format!("{v}{plain}").replace("v 1 ", "v 1.0E+00 ")),
    ] {
        is_the_cube(what, &read("cube.obj", text.as_bytes()));
    }
}

/// Two triangles a side.
fn triangles() -> impl Iterator<Item = [[i32; 3]; 3]> {
    SIDES.iter().flat_map(|s| [[s[0], s[1], s[2]], [s[0], s[2], s[3]]]).map(|t| t.map(|c| CUBE[c]))
}

#[test]
fn stl_files_of_every_hand_are_one_stone() {
    let mut text = String::from("solid cube\n");
    let mut binary = b"solid but binary".to_vec();
    binary.resize(80, 0);
    binary.extend(12u32.to_le_bytes());
    for t in triangles() {
        text += "facet normal 0 0 0\nouter loop\n";
        binary.extend([0; 12]);
        for [x, y, z] in t {
            let _ = writeln!(text, "vertex {x} {y} {z}");
            binary.extend([x, y, z].iter().flat_map(|c| (*c as f32).to_le_bytes()));
        }
        text += "endloop\nendfacet\n";
        binary.extend([7, 7]);
    }
    text += "endsolid cube\n";
    for (what, bytes) in [
        ("text", text.clone().into_bytes()),
        ("capitals", text.to_uppercase().into_bytes()),
        ("indented, CRLF", text.replace('\n', "\r\n   ").into_bytes()),
        ("no name", text.replace(" cube", "").into_bytes()),
        ("normals of nan", text.replace("normal 0 0 0", "normal -nan nan nan").into_bytes()),
        ("two solids", text.replacen("endfacet\n", "endfacet\nendsolid\nsolid b\n", 1).into_bytes()),
        ("binary that begins with solid", binary.clone()),
        ("binary with a padded end", [binary.clone(), vec![0; 30]].concat()),
    ] {
        is_the_cube(what, &read("cube.stl", &bytes));
    }
    assert!(refused("cube.stl", &binary[..binary.len() - 1]).contains("cube.stl"));
}

#[test]
fn ply_files_of_every_hand_are_one_stone() {
    let header = |format: &str, real: &str, length: &str, index: &str, list: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment x\nobj_info y\nelement vertex 8\nproperty {real} x\nproperty {real} y\n\
             property {real} z\nproperty float confidence\nelement face 6\nproperty uchar red\n\
             property list {length} {index} {list}\nelement edge 1\nproperty int a\nend_header\n"
        )
    };
    let body: String =
        SIDES.iter().map(|s| format!("255 4 {}\n", s.map(|c| c.to_string()).join(" "))).collect();
    for (real, length, index, list) in [
        ("float", "uchar", "int", "vertex_indices"),
        ("double", "int", "uint", "vertex_index"),
        ("float32", "uint8", "int32", "vertex_indices"),
        ("int16", "ushort", "uchar", "vertex_index"),
    ] {
        let text = header("ascii", real, length, index, list) + &corners("", " nan") + &body + "3\n";
        let stone = read("cube.ply", text.as_bytes());
        assert_eq!(stone.format, "ply-text");
        is_the_cube(real, &stone);
        is_the_cube("CRLF", &read("cube.ply", text.replace('\n', "\r\n").as_bytes()));
    }
    for big in [false, true] {
        let order = |mut bytes: Vec<u8>| {
            if big {
                bytes.reverse();
            }
            bytes
        };
        let format = if big { "binary_big_endian" } else { "binary_little_endian" };
        let mut bytes = header(format, "float", "uchar", "short", "vertex_indices").into_bytes();
        for corner in CUBE {
            corner.iter().for_each(|c| bytes.extend(order((*c as f32).to_le_bytes().to_vec())));
            bytes.extend(order(f32::NAN.to_le_bytes().to_vec()));
        }
        for side in SIDES {
            bytes.extend([255, 4]);
            side.iter().for_each(|c| bytes.extend(order((*c as i16).to_le_bytes().to_vec())));
        }
        bytes.extend([0; 4]);
        let stone = read("cube.ply", &bytes);
        assert_eq!(stone.format, "ply");
        is_the_cube(format, &stone);
    }
}

/// A glTF of the cube: buffer views of the given bytes, then accessors, primitives and nodes as
/// JSON.
fn gltf(parts: &[&[u8]], accessors: &str, primitives: &str, nodes: &str) -> Vec<u8> {
    use base64::Engine;
    let (mut all, mut views) = (Vec::new(), Vec::new());
    for part in parts {
        views.push(format!("{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", all.len(), part.len()));
        all.extend_from_slice(part);
        all.resize(all.len().next_multiple_of(4), 0);
    }
    let data = base64::engine::general_purpose::STANDARD.encode(&all);
    format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{nodes}],\
         \"meshes\":[{{\"primitives\":[{primitives}]}}],\"accessors\":[{accessors}],\"bufferViews\":[{}],\
         \"buffers\":[{{\"byteLength\":{},\"uri\":\"data:application/octet-stream;base64,{data}\"}}]}}",
        views.join(","),
        all.len()
    )
    .into_bytes()
}

#[test]
fn gltf_files_of_every_hand_are_one_stone() {
    let floats: Vec<u8> = CUBE.as_flattened().iter().flat_map(|c| (*c as f32).to_le_bytes()).collect();
    let order: Vec<usize> = SIDES.iter().flat_map(|s| [s[0], s[1], s[2], s[0], s[2], s[3]]).collect();
    let at = |view: usize, kind: u32, count: usize, form: &str, more: &str| {
        format!(
            "{{\"bufferView\":{view},\"componentType\":{kind},\"count\":{count},\"type\":\"{form}\"{more}}}"
        )
    };
    let places = at(0, 5126, 8, "VEC3", "");
    let mesh = "{\"attributes\":{\"POSITION\":0},\"indices\":1}";
    let node = "{\"mesh\":0}";
    let narrow: Vec<u8> = order.iter().map(|&i| i as u8).collect();
    let short: Vec<u8> = order.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect();
    let wide: Vec<u8> = order.iter().flat_map(|&i| (i as u32).to_le_bytes()).collect();
    for (kind, indices) in [(5121, &narrow), (5123, &short), (5125, &wide)] {
        let file =
            gltf(&[&floats, indices], &(places.clone() + "," + &at(1, kind, 36, "SCALAR", "")), mesh, node);
        let stone = read("cube.gltf", &file);
        assert_eq!(stone.format, "gltf");
        is_the_cube("indices", &stone);
    }
    // no indices, every triangle's corners in a row
    let loose: Vec<u8> = order.iter().flat_map(|&i| floats[12 * i..12 * i + 12].to_vec()).collect();
    let alone = "{\"attributes\":{\"POSITION\":0}}";
    is_the_cube("no indices", &read("x", &gltf(&[&loose], &at(0, 5126, 36, "VEC3", ""), alone, node)));
    // a strip and a fan for each side, and lines beside them
    let fans: Vec<u8> = SIDES.as_flattened().iter().map(|&c| c as u8).collect();
    let strips: Vec<u8> = SIDES.iter().flat_map(|s| [s[0], s[1], s[3], s[2]]).map(|c| c as u8).collect();
    for (mode, corners) in [(6, &fans), (5, &strips)] {
        let side = |i: usize| at(1, 5121, 4, "SCALAR", &format!(",\"byteOffset\":{}", 4 * i));
        let each =
            |i: usize| format!("{{\"attributes\":{{\"POSITION\":0}},\"indices\":{},\"mode\":{mode}}}", i + 1);
        let accessors: String = (0..6).map(|i| format!(",{}", side(i))).collect();
        let primitives = (0..6).map(each).collect::<Vec<_>>().join(",");
        let file = gltf(&[&floats, corners], &(places.clone() + &accessors), &primitives, node);
        is_the_cube("fans and strips", &read("x", &file));
    }
    // sparse: one corner stored wrong and put right, and all of them from nothing
    let mut wrong = floats.clone();
    wrong[..12].fill(0);
    let sparse = |count: usize, more: &str| {
        format!(
            "{{{more}\"componentType\":5126,\"count\":8,\"type\":\"VEC3\",\"sparse\":{{\"count\":{count},\
             \"indices\":{{\"bufferView\":2,\"componentType\":5121}},\"values\":{{\"bufferView\":3}}}}}}"
        )
    };
    let indices = at(1, 5121, 36, "SCALAR", "");
    let one = gltf(
        &[&wrong, &narrow, &[0], &floats[..12]],
        &format!("{},{indices}", sparse(1, "\"bufferView\":0,")),
        mesh,
        node,
    );
    is_the_cube("sparse", &read("x", &one));
    let all = gltf(
        &[&[0; 4], &narrow, &[0, 1, 2, 3, 4, 5, 6, 7], &floats],
        &format!("{},{indices}", sparse(8, "")),
        mesh,
        node,
    );
    is_the_cube("sparse over nothing", &read("x", &all));
    let beyond = gltf(
        &[&wrong, &narrow, &[8], &floats[..12]],
        &format!("{},{indices}", sparse(1, "\"bufferView\":0,")),
        mesh,
        node,
    );
    assert!(refused("x", &beyond).contains("a sparse index below 8"));
    // quantised, and made as large again by a node above it, which also turns it inside out
    let bytes: Vec<u8> = CUBE.as_flattened().iter().map(|c| (127 * c) as i8 as u8).collect();
    let required = |file: Vec<u8>, extension: &str| {
        let said = format!("\"extensionsUsed\":[\"{extension}\"],\"extensionsRequired\":[\"{extension}\"]");
        let file = String::from_utf8(file).expect("JSON");
        file.replacen("\"scene\":0", &format!("{said},\"scene\":0"), 1).into_bytes()
    };
    let nodes = "{\"children\":[1],\"scale\":[-2,2,2]},{\"mesh\":0,\"scale\":[0.5,0.5,0.5]}";
    let quantised = at(0, 5120, 8, "VEC3", ",\"normalized\":true");
    let quantised = gltf(&[&bytes, &narrow], &(quantised + "," + &indices), mesh, nodes);
    is_the_cube("quantised", &read("x", &required(quantised.clone(), "KHR_mesh_quantization")));
    let packed = required(quantised, "KHR_draco_mesh_compression");
    assert!(refused("x", &packed).contains("glTF"), "{}", refused("x", &packed));
    // two stones are no stone
    let two = "{\"children\":[1,2]},{\"mesh\":0},{\"mesh\":0,\"translation\":[5,0,0]}";
    let two = gltf(&[&floats, &narrow], &(places + "," + &indices), mesh, two);
    assert!(refused("x", &two).contains("2 separate closed surfaces"));
}

#[test]
fn a_gltf_finds_a_buffer_whose_name_is_escaped() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let design = Stone::parse("octahedron").and_then(Stone::into_design).expect("a library cut");
    let text = String::from_utf8(formats::encode(&design, "gltf").expect("is written")).expect("JSON");
    let (before, rest) = text.split_once("data:application/octet-stream;base64,").expect("a buffer inside");
    let (data, after) = rest.split_once('"').expect("its end");
    use base64::Engine;
    let bytes = base64::engine::general_purpose::STANDARD.decode(data).expect("base64");
    std::fs::write(folder.path().join("a stone.bin"), bytes).expect("writes");
    let path = folder.path().join("stone.gltf");
    std::fs::write(&path, format!("{before}a%20stone.bin\"{after}")).expect("writes");
    assert_eq!(formats::read(&path).unwrap_or_else(|e| panic!("{e}")).design.facets().count(), 8);
}

#[test]
fn gem_cut_studio_may_leave_out_and_repeat() {
    let square = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/good/square.gcs"))
        .expect("a test file");
    let plain = read("x.gcs", square.as_bytes());
    for (what, text) in [
        ("no XML head", square[square.find("<GemCut").expect("its element")..].to_owned()),
        ("blank lines first", format!("\r\n \n{square}")),
        ("CRLF", square.replace('\n', "\r\n")),
        ("index angles of -0", square.replace("index_angle=\"0\"", "index_angle=\"-0\"")),
        ("index angles of nan", {
            let mut parts = square.split("index_angle=\"");
            let first = parts.next().unwrap_or_default().to_owned();
            parts.fold(first, |text, part| {
                text + "index_angle=\"nan\"" + part.split_once('"').map_or("", |(_, rest)| rest)
            })
        }),
        ("a comment", square.replacen("<tier", "<!-- pavilion --><tier", 1)),
    ] {
        let other = read("x.gcs", text.as_bytes());
        assert_eq!(plain.design.planes(), other.design.planes(), "{what}");
    }
}
