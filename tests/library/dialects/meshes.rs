//! Triangles: OBJ, STL, PLY.

use super::{is_octahedron, read, refused, warned};
use std::fmt::Write;

pub const CORNERS: [[i32; 3]; 6] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
pub const FACES: [[usize; 3]; 8] =
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];

fn rows<const N: usize, T: std::fmt::Display>(start: &str, rows: &[[T; N]], end: &str) -> String {
    let row = |r: &[T; N]| r.iter().map(|x| format!(" {x}")).collect::<String>();
    rows.iter().map(|r| format!("{start}{}{end}\n", row(r))).collect()
}

#[test]
fn an_obj_is_read_by_what_a_stone_is_made_of() {
    let (v, f) = (rows("v", &CORNERS, ""), rows("f", &FACES.map(|t| t.map(|c| c + 1)), ""));
    let with_normals = |n: usize| rows("f", &FACES.map(|t| t.map(|c| format!("{}//{n}", c + 1))), "");
    for (what, text) in [
        ("plain", format!("{v}{f}")),
        ("a comment that ends in a backslash", format!("# C:\\stones\\\n{v}# \\\n{f}")),
        ("a comment behind words", format!("{v}{}", f.replace('\n', " # ok \\\n"))),
        ("continued lines", format!("{v}{}", f.replace("f ", "f \\\r\n "))),
        ("blanks after a backslash", format!("{v}{}", f.replace("f ", "f \\ \t\n "))),
        ("a backslash at the end", format!("{v}{f}").trim_end().to_owned() + " \\"),
        ("a long comment first", "# by a program of many words\n".repeat(300) + &v + &f),
        (
            "normals of no number",
            format!("{v}{}", rows("f", &FACES.map(|t| t.map(|c| format!("{}//x", c + 1))), "")),
        ),
        ("normals of another library", format!("{v}vn -1.#IND 1.#QNAN 0\n{}", with_normals(1))),
        ("infinite normals", format!("{v}vn inf 0 0\n{}", with_normals(1))),
        ("short normals", format!("{v}vn 1\n{}", with_normals(1))),
        ("normals that are not there", format!("{v}{}", with_normals(7))),
        ("a corner of nan that no face names", format!("{v}v nan nan nan\n{f}")),
        ("a short corner that no face names", format!("{v}v 1 2\n{f}")),
        ("faces before corners", format!("{f}{v}")),
        ("negative indices", format!("{v}{}", rows("f", &FACES.map(|t| t.map(|c| c as i64 - 6)), ""))),
        ("colours", format!("{}{f}", rows("v", &CORNERS, " .5 .5 .5"))),
        ("lines, points, smoothing, materials", format!("mtllib a.mtl\ns 1\n{v}usemtl b\n{f}l 1 2\np 3\n")),
        ("the old word for faces", format!("{v}{}", f.replace("f ", "fo "))),
        ("a lone CR", format!("{v}{f}").replace('\n', "\r")),
    ] {
        is_octahedron(what, &read(what, "x.obj", text.as_bytes()), 4.0 / 3.0);
    }
    let named = read("a sign in a name", "x.obj", format!("{v}g Facet#1 # first\n{f}").as_bytes());
    assert!(named.design.facets().all(|f| f.name == "Facet#1"));
    assert!(
        refused("x.obj", format!("{v}v nan 0 0\nf 1 2 7\n{f}").as_bytes()).contains("line 7: expected three")
    );
    assert!(
        refused("x.obj", format!("{v}cstype bezier\nsurf 0 1 0 1 1 2 3 4\n").as_bytes())
            .contains("free-form")
    );
}

#[test]
fn an_stl_is_words_or_84_bytes_and_50_for_each_triangle() {
    let mut text = String::from("solid cube\n");
    let mut binary = b"solid facet normal outer loop vertex".to_vec();
    binary.resize(80, b' ');
    binary.extend(8u32.to_le_bytes());
    for face in FACES {
        text += "facet normal 0 0 0\nouter loop\n";
        binary.extend([0xFF; 12]); // nan
        for [x, y, z] in face.map(|c| CORNERS[c]) {
            let _ = writeln!(text, "vertex {x} {y} {z}");
            binary.extend([x, y, z].iter().flat_map(|c| (*c as f32).to_le_bytes()));
        }
        text += "endloop\nendfacet\n";
        binary.extend([0x1F, 0x7C]); // a colour
    }
    text += "endsolid cube\n";
    let mut coloured = binary.clone();
    let counted = |n: u32| [&binary[..80], &n.to_le_bytes(), &binary[84..]].concat();
    let headed = |text: &str| [format!("{text:<80}").as_bytes(), &binary[80..]].concat();
    coloured[..80].copy_from_slice(format!("{:<80}", "COLOR=\u{1}\u{1}\u{1}\u{1},MATERIAL=").as_bytes());
    for (what, bytes) in [
        ("one line", text.replace('\n', " ").into_bytes()),
        ("one word a line", text.replace(' ', "\n").replacen("solid\ncube", "solid cube", 1).into_bytes()),
        ("capitals, one line", text.replace('\n', "\u{b}").to_uppercase().into_bytes()),
        ("a name of its words", text.replace("cube", "facet normal of a loop").into_bytes()),
        ("a name of its last word", text.replace("cube", "facet vertex").into_bytes()),
        (
            "a name of its words, one line",
            text.replace("cube", "vertex of a facet").replace('\n', " ").into_bytes(),
        ),
        ("comments", text.replace("facet normal", "# a facet\nfacet normal").into_bytes()),
        ("no number of triangles yet", counted(0)),
        ("a number of triangles that is none", counted(u32::MAX)),
        ("the beginning of a PLY", headed("ply\nformat ascii 1.0")),
        ("the beginning of a GLB", headed("glTF")),
        ("the beginning of a design", headed("GemCad 5.0\ng 96 0.0\na 1 2 3")),
        ("the beginning of a page", headed("<!doctype html><html>")),
        ("no normals", text.replace(" normal 0 0 0", "").into_bytes()),
        (
            "normals of another library",
            text.replace("normal 0 0 0", "normal -1.#IND 1.#QNAN -inf").into_bytes(),
        ),
        ("half a normal", text.replace("normal 0 0 0", "normal 0 0").into_bytes()),
        ("no end", text.replace("endsolid cube\n", "").into_bytes()),
        ("binary that begins as text does", binary.clone()),
        ("colours in the header", coloured),
        ("bytes after the end", [&binary[..], b"extra"].concat()),
    ] {
        is_octahedron(what, &read(what, "x.stl", &bytes), 4.0 / 3.0);
    }
    warned(
        "after",
        &read("after", "x.stl", &[&binary[..], b"extra"].concat()),
        "5 bytes after the last triangle",
    );
    let cut = refused("x.stl", &binary[..binary.len() - 7]);
    assert!(cut.contains("expected 484 bytes for 8 triangles, found 477 bytes"), "{cut}");
    assert!(refused("x.stl", text.replacen("vertex 1 0 0\n", "", 1).as_bytes()).contains("three vertices"));
}

#[test]
fn a_ply_is_read_in_all_its_forms() {
    let header = |format: &str, vertex: &str, rest: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment by hand\nobj_info 3\nelement vertex {vertex}\nproperty float x\n\
                 property float y\nproperty float z\n{rest}end_header\n"
        )
    };
    let faces = "element face 8\nproperty list uchar int vertex_indices\n";
    let strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    let (v, f) = (rows("", &CORNERS, ""), rows("3", &FACES, ""));
    let strip: Vec<i32> = FACES.iter().flat_map(|t| t.iter().map(|c| *c as i32).chain([-1])).collect();
    let words = strip.iter().map(|c| format!(" {c}")).collect::<String>();
    let plain = header("ascii", "6", faces) + &v + &f;
    let big = |faces: &str, body: Vec<u8>| {
        let mut bytes = header("binary_big_endian", "6", faces).into_bytes();
        bytes.extend(CORNERS.as_flattened().iter().flat_map(|c| (*c as f32).to_be_bytes()));
        [bytes, body].concat()
    };
    let big_faces =
        FACES.iter().flat_map(|t| [&[3u8][..], &t.map(|c| (c as i32).to_be_bytes()).concat()].concat());
    let big_strip = [strip.len() as i32].iter().chain(&strip).flat_map(|c| c.to_be_bytes()).collect();
    let lone_cr = [
        &b"ply\rformat binary_little_endian 1.0\relement vertex 6\rproperty char x\rproperty char y\r\
        property char z\relement face 8\rproperty list uchar uchar vertex_indices\rend_header\r"[..],
        &CORNERS.as_flattened().iter().map(|c| *c as i8 as u8).collect::<Vec<_>>(),
        &FACES.iter().flat_map(|t| [3, t[0] as u8, t[1] as u8, t[2] as u8]).collect::<Vec<_>>(),
    ]
    .concat();
    for (what, bytes) in [
        ("text", plain.clone().into_bytes()),
        ("a blank after its first word", plain.replacen("ply\n", "ply \n", 1).into_bytes()),
        (
            "many comments first",
            plain.replacen("ply\n", &("ply\n".to_owned() + &"comment è\n".repeat(900)), 1).into_bytes(),
        ),
        ("a byte-order mark", ["\u{feff}", &plain].concat().into_bytes()),
        ("a mark before binary", [b"\xEF\xBB\xBF", &big(faces, big_faces.clone().collect())[..]].concat()),
        (
            "Windows-1252",
            plain
                .replace("by hand", "fl~che")
                .into_bytes()
                .iter()
                .map(|b| if *b == b'~' { 0xE8 } else { *b })
                .collect(),
        ),
        ("greatest byte first", big(faces, big_faces.clone().collect())),
        (
            "triangle strips",
            (header("ascii", "6", strips) + &v + &format!("{}{words}\n", strip.len())).into_bytes(),
        ),
        ("triangle strips in binary", big(strips, big_strip)),
        (
            "a corner of nan that no face names",
            (header("ascii", "7", faces) + &v + "nan -nan inf\n" + &f).into_bytes(),
        ),
        (
            "all on one line",
            (header("ascii", "6", faces) + &(v.clone() + &f).replace('\n', " ")).into_bytes(),
        ),
        ("lines that end in CR", lone_cr),
    ] {
        is_octahedron(what, &read(what, "x.ply", &bytes), 4.0 / 3.0);
    }
    warned("words after", &read("words after", "x.ply", (plain + "1 2 3\n").as_bytes()), "3 words after");
    let after = [big(faces, big_faces.collect()), b"xy".to_vec()].concat();
    warned("bytes after", &read("bytes after", "x.ply", &after), "2 bytes after");
    let cloud = refused("x.ply", (header("ascii", "6", "") + &v).as_bytes());
    assert!(
        cloud.contains("expected an element 'face' before it, found 'end_header after vertex'"),
        "{cloud}"
    );
}
