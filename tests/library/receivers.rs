//! What the programs that read our files accept: a stand-in of each receiver's limits, because a round
//! trip through cutlab's own readers cannot show them.

use base64::Engine;
use cutlab::advanced::design::{Design, Gear, Tier, library};
use cutlab::advanced::formats::{self};
use cutlab::advanced::geometry::{Plane, Polyhedron};
use cutlab::advanced::materials::Material;
use cutlab::advanced::stone::Stone;
use glam::DVec3;
use std::path::Path;

/// Half the side of the cube of rough that GemCad's family cuts the stone out of.
const ROUGH: f64 = 2.2;

fn library_designs() -> impl Iterator<Item = (String, Design)> {
    let extra = ["round-brilliant:size=0.5", "emerald:size=80", "prism:sides=7,size=100"];
    let names = library::names().map(String::from).chain(extra.map(String::from));
    names.map(|spec| {
        (spec.clone(), Stone::parse(&spec).and_then(Stone::into_design).unwrap_or_else(|e| panic!("{e}")))
    })
}

fn data(name: &str) -> Design {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/good").join(name);
    formats::read(&path).unwrap_or_else(|e| panic!("{e}")).design
}

fn encoded(design: &Design, format: &str) -> formats::Encoded {
    formats::encode_as(design, None, format).unwrap_or_else(|e| panic!("{}: {e}", design.name))
}

/// The planes cut out of a cube of rough: faces of the stone, and whether any of the rough is left.
fn out_of_rough(planes: &[Plane]) -> (usize, bool) {
    let mut all = planes.to_vec();
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        all.extend([axis, -axis].map(|normal| Plane { normal, distance: ROUGH }));
    }
    let solid = Polyhedron::from_planes(&all).expect("a solid");
    let rough = solid.faces.iter().filter(|f| f.plane >= planes.len()).count();
    (solid.faces.len() - rough, rough > 0)
}

/// As GemCad's author's reader: words, of which H, F and G take the rest of their line.
fn gemcad_words(text: &str) -> Vec<Plane> {
    let mut planes = Vec::new();
    let (mut gear, mut tier, mut texts) = (0.0, (0.0, 0.0), [0, 0]);
    let mut index_of_refraction = 0.0;
    assert!(text.ends_with("\r\n"), "{text}");
    for (number, line) in text.split("\r\n").enumerate().filter(|(_, l)| !l.is_empty()) {
        assert!(line.chars().count() < 80 || line.starts_with("H "), "{line}");
        let mut words = line.split_whitespace().peekable();
        while let Some(word) = words.next() {
            let number_of = |w: Option<&str>| {
                let w = w.unwrap_or_else(|| panic!("{line}"));
                let digits = w.trim_start_matches('-').trim_start_matches(['0', '.']);
                assert!(digits.bytes().filter(u8::is_ascii_digit).count() <= 15, "{w}");
                w.parse::<f64>().unwrap_or_else(|_| panic!("{w} in {line}"))
            };
            match word {
                "GemCad" if number == 0 => {
                    words.next();
                }
                "g" => {
                    gear = number_of(words.next());
                    assert_eq!(number_of(words.next()), 0.0);
                }
                "y" => {
                    number_of(words.next());
                    assert!(["y", "n"].contains(&words.next().unwrap_or_default()));
                }
                "I" => index_of_refraction = number_of(words.next()),
                "H" | "F" => {
                    texts[usize::from(word == "F")] += 1;
                    break;
                }
                "G" => break,
                "a" => tier = (number_of(words.next()), number_of(words.next())),
                "n" => assert!(words.next().is_some(), "{line}"),
                index => {
                    let index = number_of(Some(index));
                    assert!(index > 0.0 && index <= gear, "{index} in {line}");
                    assert!(tier.1 != 0.0, "a facet through the origin: {line}");
                    let down = if tier.0 == 0.0 { tier.1 < 0.0 } else { tier.0.is_sign_negative() };
                    let angle = tier.0.abs().copysign(if down { -1.0 } else { 1.0 });
                    let normal = cutlab::advanced::design::tiers::facet_normal(
                        Gear { teeth: gear, offset: 0.0 },
                        angle,
                        index,
                    );
                    planes.push(Plane { normal, distance: tier.1.abs() });
                }
            }
        }
    }
    assert!(texts[0] <= 4 && texts[1] <= 4, "{texts:?}");
    assert!((1.0..3.5).contains(&index_of_refraction), "{index_of_refraction}");
    planes
}

#[test]
fn gemcad_cuts_every_stone_whole_out_of_its_rough_from_text() {
    for (name, design) in library_designs() {
        // a byte a character
        let text: String = encoded(&design, "asc").bytes.into_iter().map(char::from).collect();
        let planes = gemcad_words(&text);
        let (faces, rough) = out_of_rough(&planes);
        let solid = design.solid().expect("closed");
        assert!(!rough, "{name}: some of the rough is left");
        assert_eq!(faces, solid.faces.len(), "{name}");
        let seen = Polyhedron::from_planes(&planes).expect("closed");
        let (low, high) = seen.bounds();
        let largest = low.abs().max(high.abs()).max_element();
        assert!((0.7..1.5).contains(&largest), "{name}: {largest}");
        // fifteen digits keep the shape
        let shape = |s: &Polyhedron| s.volume() / s.width().powi(3);
        assert!((shape(&seen) / shape(&solid) - 1.0).abs() < 1e-8, "{name}");
    }
}

/// As a reader of the binary form takes it; texts of facets and the rest.
fn gemcad_binary(bytes: &[u8]) -> (Vec<Plane>, Vec<Vec<u8>>, f64) {
    let mut at = 0;
    let mut take = |n: usize| {
        at += n;
        &bytes[at - n..at]
    };
    let float = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("eight bytes"));
    let int = |b: &[u8]| i32::from_le_bytes(b.try_into().expect("four bytes"));
    let (mut planes, mut texts) = (Vec::new(), Vec::new());
    loop {
        let x = float(take(8));
        if x == -99999.0 {
            break;
        }
        let p = DVec3::new(x, -float(take(8)), float(take(8)));
        planes.push(Plane { normal: p.normalize(), distance: p.length().recip() });
        take(4);
        let length = usize::from(take(1)[0]);
        texts.push(take(length).to_vec());
        while int(take(4)) == 1 {
            let corner = [float(take(8)), float(take(8)), float(take(8))];
            assert!(corner.iter().all(|c| c.abs() < ROUGH));
        }
    }
    take(12);
    let index = float(take(8));
    (planes, texts, index)
}

#[test]
fn gemcad_cuts_every_stone_whole_out_of_its_rough_from_binary() {
    for (name, design) in library_designs() {
        let (planes, texts, index) = gemcad_binary(&encoded(&design, "gem").bytes);
        let (faces, rough) = out_of_rough(&planes);
        assert_eq!((faces, rough), (design.solid().expect("closed").faces.len(), false), "{name}");
        assert!(texts.iter().all(|t| t.len() <= 79), "{name}");
        assert!((1.0..3.5).contains(&index), "{name}");
    }
    let (.., index) = gemcad_binary(
        &encoded(&Stone::parse("tolkowsky").and_then(Stone::into_design).expect("a cut"), "gem").bytes,
    );
    assert_eq!(index, 2.417);
}

#[test]
fn long_instructions_are_shortened_at_a_word_and_that_is_said() {
    let mut design = data("square.asc");
    let long = "Cut these facets to meet at the temporary centre point and then check the depth of every one \
                of them twice before you polish";
    design.tiers[0].instructions = long.into();
    design.tiers[1].instructions = "x".repeat(300);
    let written = encoded(&design, "gem");
    let (_, texts, _) = gemcad_binary(&written.bytes);
    assert!(texts.iter().all(|t| t.len() <= 79), "{texts:?}");
    let first = String::from_utf8(texts[0].clone()).expect("ASCII");
    let (name, said) = first.split_once('\t').expect("a tab");
    assert!(!name.is_empty() && long.starts_with(&format!("{said} ")) && said.len() > 50, "{said}");
    assert_eq!(written.remarks.len(), 1);
    for tier in &design.tiers[..2] {
        assert!(written.remarks[0].contains(&format!("'{}'", tier.name)), "{:?}", written.remarks);
    }
    assert!(encoded(&data("square.asc"), "gem").remarks.is_empty());
    // text keeps them, in lines that GemCad's editor shows
    let text = encoded(&design, "asc");
    assert!(text.remarks.is_empty());
    let back = formats::read_bytes("x", &text.bytes, None).expect("is read").design;
    assert_eq!(back.tiers[0].instructions, long);
}

#[test]
fn a_design_of_gemcads_size_keeps_its_numbers() {
    let square = data("square.asc");
    let text = String::from_utf8_lossy(&encoded(&square, "asc").bytes).into_owned();
    let own =
        std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/good/square.asc")).expect("reads");
    let own = String::from_utf8_lossy(&own).into_owned();
    let distances = |text: &str| -> Vec<String> {
        let tiers = text.lines().filter(|l| l.starts_with("a "));
        tiers.filter_map(|l| l.split_whitespace().nth(2)?.parse().ok()).map(|d: f64| format!("{d}")).collect()
    };
    assert_eq!(distances(&text), distances(&own));
    // names stand once, where the file had them
    let mut named = data("square.asc");
    let tier = &mut named.tiers[2];
    tier.name = "X".into();
    tier.facets.iter_mut().for_each(|f| f.name.clear());
    tier.facets[2].name = "X".into();
    let text = String::from_utf8_lossy(&encoded(&named, "asc").bytes).into_owned();
    assert_eq!(text.matches(" n X").count(), 1, "{text}");
    assert_eq!(
        formats::read_bytes("x", text.as_bytes(), None).expect("reads").design.tiers[2].facets[2].name,
        "X"
    );
}

#[test]
fn gem_cut_studio_gets_its_frame() {
    for (name, design) in library_designs() {
        let text = String::from_utf8(encoded(&design, "gcs").bytes).expect("text");
        let xml = roxmltree::Document::parse(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let value = |node: &roxmltree::Node, key: &str| -> f64 {
            node.attribute(key).and_then(|v| v.parse().ok()).unwrap_or_else(|| panic!("{name}: {key}"))
        };
        let (mut across, mut low, mut high) = (0f64, 0f64, 0f64);
        for facet in xml.descendants().filter(|n| n.has_tag_name("facet")) {
            let n = DVec3::new(value(&facet, "nx"), value(&facet, "ny"), value(&facet, "nz"));
            let tier = facet.parent_element().expect("in a tier");
            let polar = value(&tier, "angle");
            assert!((n.z - polar.to_radians().cos()).abs() < 1e-9, "{name}");
            // 90° + φ on crown and table, 270° − φ on pavilion and girdle
            let phi = n.y.atan2(n.x).to_degrees();
            let meant = if polar < 90.0 { 90.0 + phi } else { 270.0 - phi };
            let off = (value(&facet, "index_angle") - meant + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 1e-9, "{name}: {off}");
            for v in facet.children().filter(|c| c.has_tag_name("vertex")) {
                let v = DVec3::new(value(&v, "x"), value(&v, "y"), value(&v, "z"));
                assert!((n.dot(v) - value(&tier, "depth")).abs() < 1e-9, "{name}");
                across = across.max(v.x.abs()).max(v.y.abs());
                (low, high) = (low.min(v.z), high.max(v.z));
            }
        }
        assert!((across - 1.0).abs() < 1e-12 && (low + high).abs() < 1e-9, "{name}: {across} {low} {high}");
        let render = xml.descendants().find(|n| n.has_tag_name("render")).expect("an index of refraction");
        assert!((1.0..3.5).contains(&value(&render, "refractive_index")), "{name}");
    }
}

/// The one buffer of a `.gltf`, which stands in its address.
fn embedded(document: &gltf::Document) -> Vec<u8> {
    let buffer = document.buffers().next().expect("a buffer");
    let gltf::buffer::Source::Uri(uri) = buffer.source() else { panic!("no address") };
    let text = uri.strip_prefix("data:application/octet-stream;base64,").expect("inside the file");
    base64::engine::general_purpose::STANDARD.decode(text).expect("base64")
}

/// Corners as a viewer places them, in metres, and the document.
fn viewed(bytes: &[u8]) -> (DVec3, gltf::Document) {
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(bytes).expect("a valid file");
    let data = blob.unwrap_or_else(|| embedded(&document));
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for node in document.nodes() {
        let place = glam::DMat4::from_cols_array_2d(&node.transform().matrix().map(|c| c.map(f64::from)));
        for primitive in node.mesh().into_iter().flat_map(|m| m.primitives().collect::<Vec<_>>()) {
            for p in primitive.reader(|_| Some(&data)).read_positions().expect("positions") {
                let p = place.transform_point3(DVec3::from_array(p.map(f64::from)));
                (low, high) = (low.min(p), high.max(p));
            }
        }
    }
    (high - low, document)
}

#[test]
fn gltf_is_in_metres_upright_and_of_its_material() {
    let design = Stone::parse("tolkowsky").and_then(Stone::into_design).expect("a cut");
    let (low, high) = design.solid().expect("closed").bounds();
    for format in ["glb", "gltf"] {
        let (size, document) = viewed(&encoded(&design, format).bytes);
        assert!((size.x - 0.0065).abs() < 1e-8 && (size.z - 0.0065).abs() < 1e-8, "{size}");
        assert!((size.y - (high.z - low.z) / 1e3).abs() < 1e-8, "{size}");
        for primitive in document.meshes().flat_map(|m| m.primitives().collect::<Vec<_>>()) {
            let material = primitive.material();
            assert!((material.ior().expect("an index") - 2.41726).abs() < 1e-4);
            assert_eq!(material.transmission().expect("clear").transmission_factor(), 1.0);
            let volume = material.volume().expect("a body");
            assert!((f64::from(volume.thickness_factor()) - size.y).abs() < 1e-6);
            assert_eq!(volume.attenuation_color(), [1.0; 3]);
            let base = material.pbr_metallic_roughness();
            assert_eq!((base.metallic_factor(), base.roughness_factor()), (0.0, 0.0));
        }
        for used in ["KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume"] {
            assert!(document.extensions_used().any(|e| e == used), "{used}");
        }
        // and back in millimetres
        let back = formats::read_bytes("x", &encoded(&design, format).bytes, None).expect("reads").design;
        assert_eq!(back.unit, cutlab::advanced::design::LengthUnit::Millimetre);
        assert!((back.solid().expect("closed").width() - 6.5).abs() < 1e-5);
    }
    let ruby = formats::encode_as(&design, Material::by_name("ruby"), "glb").expect("is written");
    let (_, document) = viewed(&ruby.bytes);
    let material = document.materials().next().expect("a material");
    let volume = material.volume().expect("a body");
    let [r, g, b] = volume.attenuation_color();
    assert!(r > 2.0 * g && r > 2.0 * b && volume.attenuation_distance() == 0.01, "{r} {g} {b}");
    assert_eq!(material.name(), Some("ruby"));
    // a shape without size gets one, and that is said
    let classic = Stone::parse("classic").and_then(Stone::into_design).expect("a cut");
    let written = encoded(&classic, "glb");
    assert!(written.remarks[0].contains("6.5 mm wide"), "{:?}", written.remarks);
    assert!((viewed(&written.bytes).0.x - 0.0065).abs() < 2e-4);
}

#[test]
fn every_design_file_states_an_index_of_refraction() {
    let line = |design: &Design, material: Option<&str>| {
        let material = material.and_then(Material::by_name);
        let bytes = formats::encode_as(design, material, "asc").expect("is written").bytes;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        text.lines().find(|l| l.starts_with("I ")).map(String::from).unwrap_or_default()
    };
    let classic = Stone::parse("classic").and_then(Stone::into_design).expect("a cut");
    let tolkowsky = Stone::parse("tolkowsky").and_then(Stone::into_design).expect("a cut");
    assert_eq!(line(&classic, None), "I 1.54");
    assert_eq!(line(&tolkowsky, None), "I 2.417");
    assert_eq!(line(&classic, Some("corundum")), "I 1.768");
}

#[test]
fn a_stone_off_its_origin_comes_to_stand_about_it() {
    let mut design = Design::new("box");
    let gear = Gear::default();
    design.tiers = vec![
        Tier::new("G", gear, -90.0, 1.0, &[96.0, 24.0, 48.0, 72.0]),
        Tier::new("C", gear, -0.0, 0.5, &[96.0]),
        Tier::new("T", gear, 0.0, 0.7, &[96.0]),
    ];
    for facet in design.tiers.iter_mut().flat_map(|t| &mut t.facets) {
        facet.plane = facet.plane.moved(DVec3::new(100.0, -50.0, 30.0));
    }
    let text = String::from_utf8(encoded(&design, "asc").bytes).expect("text");
    assert_eq!(out_of_rough(&gemcad_words(&text)), (6, false));
    let (planes, ..) = gemcad_binary(&encoded(&design, "gem").bytes);
    assert_eq!(out_of_rough(&planes), (6, false));
}
