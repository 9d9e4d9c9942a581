//! Designs: GemCad's text and binary, Gem Cut Studio, and how all text is encoded.

use super::{encoded, read, refused, warned};
use cutlab::advanced::formats::{self, Loaded};
use std::fmt::Write;

const GEMCAD: &str = "GemCad 5.0\ng 96 0.0\ny 4 y\nI 1.54\nH Square\na -42 0.5 96 n P 24 48 72 G Meet\n\
                      a -90 1 96 n G 24 48 72\na 40 0.9 96 n C 24 48 72\na 0 0.4 96 n T\nF by hand\n";

#[test]
fn gemcad_text_is_words_and_not_lines() {
    let plain = read("plain", "x.asc", GEMCAD.as_bytes());
    for (what, from, to) in [
        ("indices in a line that is not indented", " 48 72 G Meet", "\n48 72 G Meet"),
        ("a name in the next line", "96 n P", "96 n\nP"),
        ("the angle in the next line", "a -42", "a\n-42"),
        ("two tiers in a line", "24 48 72\na 40", "24 48 72 a 40"),
        ("a tier behind a name", "n G 24 48 72\na 40", "24 48 72 n G a 40"),
        ("all but texts in a line", "g 96 0.0\ny 4 y\nI 1.54\nH", "g 96 0.0 y 4 y I 1.54\nH"),
        ("glued", "g 96 0.0\ny 4 y\nI 1.54", "g96 0.0\ny4y\nI1.54"),
        ("glued in part", "y 4 y", "y 4y"),
        ("glued tiers", "a -42 0.5", "a-42 0.5"),
        ("form feeds and odd blanks", "a -42 0.5 96", "a\u{b}-42\u{a0}0.5\u{c}96"),
        ("comments behind words", "24 48 72\na 40", "24 48 72 ; the girdle 3 4\na 40"),
        ("a second gear before all", "y 4 y", "g 96 0\ny 4 y"),
        (
            "prose of a footnote",
            "F by hand\n",
            "F by hand\n  I made this in 1999\n  a nice one\n  a 12 sided one\n",
        ),
        ("prose of a header", "H Square\n", "H Square\n  n of 5, G too\n"),
        ("prose of instructions", "G Meet\n", "G Meet\n  and turn it\n"),
        ("dashes for minus signs", "-42", "\u{2013}42"),
        ("no title", "GemCad 5.0\n", ""),
        ("stray words", "F by hand\n", "F by hand\nI made it\na nice one\n"),
        ("an end-of-file mark", "by hand\n", "by hand\n\u{1a}"),
    ] {
        assert!(GEMCAD.contains(from), "{what}");
        let other = read(what, "x.asc", GEMCAD.replacen(from, to, 1).as_bytes());
        let off = |(p, q): (cutlab::advanced::geometry::Plane, cutlab::advanced::geometry::Plane)| {
            p.normal.distance(q.normal) + (p.distance - q.distance).abs()
        };
        let (mine, its) = (plain.design.planes(), other.design.planes());
        assert_eq!(mine.len(), its.len(), "{what}");
        assert!(mine.into_iter().zip(its).map(off).fold(0.0, f64::max) < 1e-15, "{what}");
        let said = |i: &Loaded| (i.design.gear, i.design.symmetry, i.design.refractive_index);
        assert_eq!(said(&plain), said(&other), "{what}");
    }
    // without a title, and nowhere a line that begins with a tier
    let words = GEMCAD.replace("GemCad 5.0\n", "").replace("H Square\n", "").replace("F by hand\n", "");
    let words = words.replace(" G Meet", "");
    let words = words.split_whitespace().collect::<Vec<_>>();
    for between in [" ", "\n"] {
        let other = read("words alone", "x.asc", words.join(between).as_bytes());
        assert_eq!(plain.design.planes(), other.design.planes());
    }
    let of = |from: &str, to: &str| read(to, "x.asc", GEMCAD.replacen(from, to, 1).as_bytes());
    let named = of("n P 24", "n Star A 24");
    assert_eq!(named.design.tiers[0].facets[0].name, "Star A");
    warned("two words", &named, "line 6: a name of several words: 'Star A'");
    let footnote = of("F by hand\n", "F by hand\n  I made this\n  a nice one\n");
    assert_eq!(footnote.design.footers, ["by hand I made this a nice one"]);
    assert_eq!(of("n P 24", "n a 24").design.tiers[0].facets[0].name, "a");
    assert_eq!(of("n P 24", "n #1 24").design.tiers[0].facets[0].name, "#1");
    let through = of("F by", "a 10 0.0 96 n X\nF by");
    assert_eq!(through.design.facets().count(), plain.design.facets().count());
    warned("distance 0", &through, "line 10: a tier at distance 0");
    warned("negative", &of("a 40 0.9", "a 40 -0.9"), "a distance of -0.9");
    // cut on another wheel: the same facets, and one wheel for all that is said of them
    let wheels = of("a 40 0.9 96 n C 24 48 72\na 0 0.4 96", "g 64 0\na 40 0.9 64 n C 16 32 48\na 0 0.4 64");
    warned("two gears", &wheels, "line 8: a second gear");
    for (p, q) in plain.design.planes().iter().zip(wheels.design.planes()) {
        assert!(p.normal.distance(q.normal) < 1e-15);
    }
    assert_eq!(wheels.design.tiers[0].facets[1].index, Some(16.0));
    // a facet that would be lost is an error
    for (to, said) in [
        ("24 48 72x G Meet", "line 6: expected an index, 'n NAME' or 'G', found '72x'"),
        ("24\n  x48 72", "line 7: expected an index, 'n NAME' or 'G', found 'x48'"),
        ("24\n48 Meet", "line 7: expected an index, 'n NAME' or 'G', found 'Meet'"),
    ] {
        let error = refused("x.asc", GEMCAD.replacen("24 48 72 G Meet", to, 1).as_bytes());
        assert!(error.contains(said), "{error}");
    }
}

/// `text` in UTF-8 and in UTF-16 of both byte orders, marked.
fn in_marked_encodings(text: &str) -> [(&'static str, Vec<u8>); 3] {
    let utf_16 = |order: fn(u16) -> [u8; 2]| {
        std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(order).collect::<Vec<u8>>()
    };
    let utf_8 = ["\u{feff}", text].concat().into_bytes();
    [
        ("UTF-8", utf_8),
        ("UTF-16, least first", utf_16(u16::to_le_bytes)),
        ("UTF-16", utf_16(u16::to_be_bytes)),
    ]
}

#[test]
fn every_text_format_is_decoded_before_it_is_read() {
    for format in
        ["cutlab", "gemcad", "gem-cut-studio", "obj", "stl-text", "ply-text", "gltf", "sc-tracer", "cs580"]
    {
        let text = String::from_utf8(encoded("prism:sides=5", format)).expect("text");
        let plain = read(format, "x", text.as_bytes());
        for (what, bytes) in in_marked_encodings(&text) {
            let other = read(&format!("{format} in {what}"), "x", &bytes);
            assert_eq!(
                (plain.format, plain.design.planes()),
                (other.format, other.design.planes()),
                "{what}"
            );
            assert_eq!(plain.design.name, other.design.name, "{what}");
        }
    }
    for (what, bytes) in in_marked_encodings(&GEMCAD.replace("Square", "Flèche ½")) {
        assert_eq!(read(what, "x.asc", &bytes).design.name, "Flèche ½", "{what}");
    }
}

#[test]
fn a_gemcad_binary_may_end_at_any_field_of_its_tail() {
    let whole = encoded("prism:sides=5", "gem");
    let plain = read("whole", "x.gem", &whole);
    let mark = (-99999.0f64).to_le_bytes();
    let end = whole.windows(8).position(|w| w == mark).expect("the end of facets");
    for cut in end..whole.len() {
        let other = read(&format!("{cut} bytes"), "x.gem", &whole[..cut]);
        assert_eq!((plain.format, plain.design.planes()), (other.format, other.design.planes()), "{cut}");
        assert!(other.warnings.iter().any(|w| w.contains("what is missing")), "{cut}");
    }
    assert!(!plain.warnings.iter().any(|w| w.contains("missing")), "{:?}", plain.warnings);
    for (after, said) in [
        (&b"\x1a"[..], "1 byte after"),
        (&[0; 100][..], "100 bytes after"),
        (&b"anything"[..], "8 bytes after"),
    ] {
        warned("bytes after", &read("bytes after", "x.gem", &[&whole, after].concat()), said);
    }
    let preform = [&whole[..], b"\x07preform", &whole].concat();
    warned("a preform", &read("a preform", "x.gem", &preform), "a preform is left out");
    // the wheel only numbers the facets
    let mut no_gear = whole.clone();
    no_gear[end + 16..end + 20].fill(0);
    let no_gear = read("no gear", "x.gem", &no_gear);
    assert_eq!(no_gear.design.planes(), plain.design.planes());
    warned("no gear", &no_gear, "96 teeth assumed");
    // a facet that breaks off is lost
    assert!(refused("x.gem", &whole[..end - 5]).contains("byte "));
}

/// A chiral pinwheel, the design by which the frame was established: read in a mirror, its indices would be
/// 94-82-70 … and 87-75-63 …
const PINWHEEL: [(f64, f64, f64); 2] = [(35.0, 0.75, 2.0), (-41.0, 0.62, 9.0)];

/// Gem Cut Studio's form of it, of each facet what is asked for.
fn pinwheel(normals: bool, angles: bool, depths: bool, index: &str) -> String {
    let mut text = format!("<GemCutStudio version=\"1000\">{index}");
    let turned = |tier: f64, k: usize| (tier + 12.0 * k as f64) * 3.75;
    let mut tier = |polar: f64, depth: f64, azimuths: &[f64]| {
        let _ = write!(text, "<tier name=\"t\" angle=\"{polar}\"");
        if depths {
            let _ = write!(text, " depth=\"{depth}\"");
        }
        text += ">";
        for az in azimuths {
            let (sin, cos) = polar.to_radians().sin_cos();
            // GemCad's azimuth is that of the normal from x, and a quarter turn
            let phi = (az - 90.0).to_radians();
            let n = glam::DVec3::new(phi.cos() * sin, phi.sin() * sin, cos);
            text += "<facet";
            if normals {
                let _ = write!(text, " nx=\"{}\" ny=\"{}\" nz=\"{}\"", n.x, n.y, n.z);
            }
            if angles {
                let index_angle = if polar < 90.0 { *az } else { 360.0 - az };
                let _ = write!(text, " index_angle=\"{index_angle}\"");
            }
            text += ">";
            // three corners in the plane, in no order
            let (u, v) = n.any_orthonormal_pair();
            for p in [n * depth + 0.3 * u, n * depth + 0.3 * v, n * depth - 0.2 * u - 0.1 * v] {
                let _ = write!(text, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x, p.y, p.z);
            }
            text += "</facet>";
        }
        text += "</tier>";
    };
    for (angle, depth, first) in PINWHEEL {
        let polar = if angle > 0.0 { angle } else { 180.0 + angle };
        tier(polar, depth, &(0..8).map(|k| turned(first, k)).collect::<Vec<_>>());
    }
    tier(90.0, 1.0, &(0..16).map(|k| 22.5 * k as f64).collect::<Vec<_>>());
    tier(0.0, 0.5, &[0.0]);
    text + "</GemCutStudio>"
}

#[test]
fn gem_cut_studio_turns_as_gemcad_does() {
    let index = "<index gear=\"96\" base=\"24\" symmetry=\"2\" mirror=\"1\"/>";
    let whole = pinwheel(true, true, true, index);
    for (what, text) in [
        ("whole", whole.clone()),
        ("no index angles", pinwheel(true, false, true, index)),
        ("no normals", pinwheel(false, true, true, index)),
        ("corners alone", pinwheel(false, false, true, index)),
        ("no depths", pinwheel(true, true, false, index)),
        ("index angles of garbage", whole.replace("index_angle=\"", "index_angle=\"#")),
        ("corners of garbage", whole.replace("<vertex x=\"", "<vertex x=\"inf")),
        ("infinite normals", whole.replace("nx=\"", "nx=\"inf\" was=\"")),
        (
            "an index of refraction of garbage",
            whole.replace("</Gem", "<render refractive_index=\"x\"/></Gem"),
        ),
        ("a gear of garbage", whole.replace("gear=\"96\"", "gear=\"many\"")),
        ("angles of garbage", whole.replace(" angle=\"", " angle=\"about ")),
        ("words after the end", whole.clone() + "\n<!-- saved --> by hand"),
        ("another writer's window", whole.replace("base=\"24\" symmetry=\"2\" mirror=\"1\"", "base=\"0\"")),
    ] {
        let stone = read(what, "x.gcs", text.as_bytes());
        let indices = |tier: usize| {
            let facets = &stone.design.tiers[tier].facets;
            let mut all: Vec<i64> =
                facets.iter().map(|f| (f.index.unwrap_or(-1.0) * 1e4).round() as i64).collect();
            all.sort_unstable();
            all
        };
        let expected = |first: i64| (0..8).map(|k| (first + 12 * k) * 10_000).collect::<Vec<_>>();
        assert_eq!(indices(0), expected(2), "{what}: crown");
        assert_eq!(indices(1), expected(9), "{what}: pavilion");
        assert_eq!((stone.design.symmetry, stone.design.gear.offset), (None, 0.0), "{what}");
        assert!(!stone.warnings.iter().any(|w| w.contains("unverified")), "{what}: {:?}", stone.warnings);
    }
    // and so does GemCad's text of the same design, and what is written of it
    let mut text = String::from("GemCad 5.0\ng 96 0\n");
    for (angle, rho, first) in PINWHEEL {
        let indices: Vec<_> = (0..8).map(|k| (first + 12.0 * k as f64).to_string()).collect();
        let _ = writeln!(text, "a {angle} {rho} {}", indices.join(" "));
    }
    text += "a -90 1 6 12 18 24 30 36 42 48 54 60 66 72 78 84 90 96\na 0 0.5 96\n";
    let gemcad = read("GemCad", "x.asc", text.as_bytes()).design;
    let studio = read("whole", "x.gcs", whole.as_bytes()).design;
    let written = formats::encode(&gemcad, "gcs").expect("is written");
    let back = read("written", "x.gcs", &written).design;
    for other in [studio, back] {
        let size = other.solid().expect("closed").bounds().1.x;
        for p in gemcad.planes() {
            let near =
                other.planes().iter().map(|q| p.normal.distance(q.normal)).fold(f64::INFINITY, f64::min);
            assert!(near < 1e-9 && size > 0.0, "{near:e}");
        }
    }
    for (what, text) in [
        ("a facet", whole.replacen("<facet", "<facet frosting=\"0.5\"", 1)),
        ("a tier", whole.replacen("<tier", "<tier frosting=\"0.5\"", 1)),
    ] {
        warned(what, &read(what, "x.gcs", text.as_bytes()), "tier 't': frosted; taken as polished");
    }
    let polished = whole.replacen("<facet", "<facet frosting=\"0\"", 1);
    assert!(!read("polished", "x.gcs", polished.as_bytes()).warnings.iter().any(|w| w.contains("frosted")));
}
