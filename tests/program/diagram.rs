//! The cutting diagram: one page, black on white, every facet once, names inside their facets.

use crate::corpus_folder::corpus;
use cutlab::advanced::design::{Design, Gear, Tier, Zone, library};
use cutlab::advanced::formats;
use cutlab::advanced::report::diagram::Paper;
use cutlab::advanced::report::raster::text_width;
use cutlab::advanced::report::{diagram, pdf, raster};
use glam::DVec2;
use rayon::prelude::*;
use roxmltree::{Document, Node};
use std::collections::BTreeMap;

fn cut(name: &str) -> Design {
    library::design(name, &BTreeMap::new()).expect("in the library").expect("can be made")
}

fn number(node: &Node, name: &str) -> f64 {
    node.attribute(name).unwrap_or("0").parse().expect("a number")
}

/// The polygons of path data that has moves, lines and closings only.
fn polygons(data: &str) -> Vec<Vec<DVec2>> {
    let point = |text: &str| {
        let (x, y) = text.split_once(' ').expect("two numbers");
        DVec2::new(x.parse().expect("x"), y.parse().expect("y"))
    };
    let closed =
        data.split_terminator('Z').map(|p| p.trim_start_matches('M').split('L').map(point).collect());
    closed.collect()
}

fn by_id<'a>(svg: &'a Document, id: &str) -> Option<Node<'a, 'a>> {
    svg.descendants().find(|n| n.attribute("id") == Some(id))
}

/// Whether a point lies in a convex polygon of either sense, or within `slack` of it.
fn inside(p: DVec2, polygon: &[DVec2], slack: f64) -> bool {
    let sides = (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]));
    // the direction of a shorter side is lost in the two decimals of the file
    let sides = sides.filter(|(a, b)| a.distance(*b) > 0.1);
    let heights: Vec<f64> =
        sides.filter_map(|(a, b)| Some((b - a).try_normalize()?.perp_dot(p - a))).collect();
    heights.iter().all(|h| *h > -slack) || heights.iter().all(|h| *h < slack)
}

/// Area of a polygon of either sense.
fn area(polygon: &[DVec2]) -> f64 {
    let sides = (0..polygon.len()).map(|i| polygon[i].perp_dot(polygon[(i + 1) % polygon.len()]));
    0.5 * sides.sum::<f64>().abs()
}

/// The corners of a name's box: as wide as its text, as high as a capital.
fn corners(text: &Node) -> [DVec2; 4] {
    let size = number(text, "font-size");
    let half = 0.5 * size * text_width(text.text().unwrap_or_default(), false);
    let (mut at, mut turn) = (DVec2::new(number(text, "x"), number(text, "y")), 0.0f64);
    let mut origin = DVec2::ZERO;
    if let Some(transform) = text.attribute("transform") {
        let numbers: Vec<f64> = transform
            .split(|c: char| !(c.is_ascii_digit() || "-.".contains(c)))
            .filter_map(|w| w.parse().ok())
            .collect();
        origin = DVec2::new(numbers[0], numbers[1]);
        turn = numbers[2].to_radians();
    }
    if turn == 0.0 {
        origin = at;
        at = DVec2::ZERO;
    }
    [(-half, 0.0), (half, 0.0), (half, -0.729 * size), (-half, -0.729 * size)]
        .map(|(x, y)| origin + DVec2::from_angle(turn).rotate(at + DVec2::new(x, y)))
}

/// What holds for every diagram, on either paper.
fn check(name: &str, design: &Design) {
    [Paper::A4, Paper::Letter].iter().for_each(|paper| check_on(*paper, name, design));
}

fn check_on(paper: Paper, name: &str, design: &Design) {
    let text =
        diagram::draw_on(design, design.refractive_index, paper).unwrap_or_else(|e| panic!("{name}: {e}"));
    let svg = Document::parse(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
    let solid = design.solid().expect("it was drawn");

    // black and white only
    for node in svg.descendants() {
        for colour in ["fill", "stroke"].iter().filter_map(|a| node.attribute(*a)) {
            assert!(["#000", "#fff", "none"].contains(&colour), "{name}: {colour}");
        }
    }

    // every facet once: in the crown, in the pavilion, or on the girdle
    let zones: Vec<Zone> =
        (0..solid.faces.len()).map(|f| Zone::from_normal(solid.area_vector(f).normalize_or_zero())).collect();
    let facets = |view: &str| {
        let node = by_id(&svg, &format!("{view}-facets"));
        node.map_or_else(Vec::new, |n| polygons(n.attribute("d").expect("data")))
    };
    let of = |wanted: &[Zone]| zones.iter().filter(|z| wanted.contains(z)).count();
    assert_eq!(facets("crown").len(), of(&[Zone::Crown, Zone::Table]), "{name}");
    assert_eq!(facets("pavilion").len(), of(&[Zone::Pavilion, Zone::Culet]), "{name}");

    // the page holds all of it, with an edge that printers reach
    let sheet = if paper == Paper::A4 { DVec2::new(210.0, 297.0) } else { DVec2::new(215.9, 279.4) };
    assert_eq!(svg.root_element().attribute("width"), Some(&*format!("{}mm", sheet.x)));
    let (low, high) = (DVec2::splat(8.0), sheet - 8.0);
    let on_page = |p: DVec2| p.cmpge(low).all() && p.cmple(high).all();
    for node in svg.descendants().filter(|n| n.has_tag_name("text") && n.attribute("transform").is_none()) {
        let said = node.text().unwrap_or_default();
        let size = number(&node, "font-size");
        let wide = size * text_width(said, node.attribute("font-weight").is_some());
        let left = match node.attribute("text-anchor") {
            Some("middle") => 0.5 * wide,
            Some("end") => wide,
            _ => 0.0,
        };
        let start = DVec2::new(number(&node, "x") - left, number(&node, "y"));
        assert!(
            on_page(start) && on_page(start + DVec2::new(wide, -0.75 * size)),
            "{name}: '{said}' at {start}"
        );
        assert!(size >= 0.99, "{name}: '{said}' of {size} mm");
    }

    for view in ["crown", "pavilion", "side", "end"] {
        let mut facets = facets(view);
        facets.retain(|f| area(f) > 0.01); // what rounding leaves between planes is a point on the page
        assert!(facets.iter().flatten().all(|p| on_page(*p)), "{name}: {view}");
        // names stand inside their facets, one in each; .15 mm is what widths of glyphs are rounded by
        let names = by_id(&svg, &format!("{view}-names")).expect("a group");
        let mut taken = vec![false; facets.len()];
        for text in names.children().filter(Node::is_element) {
            let corners = corners(&text);
            let holds = |polygon: &Vec<DVec2>| corners.iter().all(|c| inside(*c, polygon, 0.15));
            let own: Vec<usize> = (0..facets.len()).filter(|i| holds(&facets[*i])).collect();
            assert_eq!(own.len(), 1, "{name}: {view}: {:?} at {}", text.text(), corners[0]);
            assert!(!std::mem::replace(&mut taken[own[0]], true), "{name}: {view}: two names in one facet");
        }
    }
}

#[test]
fn every_library_cut_fits_its_page_with_its_names_in_its_facets() {
    library::names().collect::<Vec<_>>().par_iter().for_each(|name| check(name, &cut(name)));
}

#[test]
#[ignore = "draws every file of the corpus"]
fn every_file_of_the_corpus_fits_its_page() {
    let Some(corpus) = corpus() else { return };
    let mut files = Vec::new();
    for folder in ["gemcad", "pairs", "other", "meshes"] {
        let Ok(entries) = std::fs::read_dir(corpus.join(folder)) else { continue };
        files.extend(entries.map(|e| e.expect("can be listed").path()));
    }
    let drawn = files.par_iter().filter_map(|f| Some((f, formats::read(f).ok()?))).map(|(file, imported)| {
        check(&file.display().to_string(), &imported.design);
    });
    println!("{} of {} files drawn", drawn.count(), files.len());
}

fn said(design: &Design) -> Vec<String> {
    let text = diagram::draw(design, design.refractive_index).expect("draws");
    let svg = Document::parse(&text).expect("SVG");
    let texts = svg.descendants().filter(|n| n.has_tag_name("text"));
    texts.filter_map(|n| n.text().map(str::to_owned)).collect()
}

#[test]
fn the_classic_reads_as_the_guild_prints_it() {
    let said = said(&cut("classic"));
    let has = |line: &str| assert!(said.iter().any(|s| s == line), "{line}: {said:?}");
    has(
        "57 facets + 16 on the girdle = 73 · 8-fold, mirror-image symmetry · 96-index gear · angles for n = 1.540",
    );
    has("L/W = 1.000 · T/W = 0.516 · P/W = 0.466 · C/W = 0.218 · H/W = 0.697 · Vol/W³ = 0.236");
    for (code, angle) in
        [("P1", "45.00°"), ("P2", "43.00°"), ("C1", "47.00°"), ("C2", "42.00°"), ("C3", "27.00°")]
    {
        has(code);
        has(angle);
    }
    has("96-12-24-36-48-60-72-84");
    has("star: Meet mains and breaks");
    // one T in the crown, one in the table of tiers
    assert_eq!(said.iter().filter(|s| *s == "T").count(), 2);
    assert_eq!(said.iter().filter(|s| *s == "P1").count(), 1 + 16 + 12);
}

#[test]
fn a_girdle_of_96_is_listed_as_a_range() {
    assert!(said(&cut("round-brilliant")).iter().any(|s| s == "01 to 96, every tooth"));
}

/// A ball of `n` facets, each a tier of its own.
fn ball(n: usize) -> Design {
    let mut design = Design::new("ball <&> \u{1}");
    for i in 0..n {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / n as f64;
        let index = (i as f64 * 0.381_966).fract() * 96.0;
        let angle = if z < 0.0 { -z.abs().acos().to_degrees() } else { z.acos().to_degrees() };
        let name = format!("a tier with a long name, number {i}");
        design.tiers.push(Tier::new(&name, Gear::default(), angle, 1.0, &[index]));
    }
    design
}

#[test]
fn forty_tiers_fit_and_of_more_than_fit_it_says_how_many_are_missing() {
    check("40", &ball(40));
    assert!(!said(&ball(40)).iter().any(|s| s.contains("more tiers")));
    check("250", &ball(250));
    let said = said(&ball(250));
    let missing = said.iter().find_map(|s| s.strip_prefix("… and ")).expect("says it");
    let missing: usize = missing.split(' ').next().and_then(|n| n.parse().ok()).expect("a number");
    let listed = said.iter().filter(|s| s.ends_with('°')).count();
    assert_eq!(listed + missing, 250);
}

#[test]
fn a_mesh_is_drawn_with_measured_angles_and_indices() {
    let cut = cut("classic");
    let mesh = Design::from_facets("mesh", cut.facets().map(|f| (f.name.clone(), f.plane)));
    check("mesh", &mesh);
    let said = said(&mesh);
    for text in
        ["45.00°", "43.00°", "96-12-24-36-48-60-72-84", "03-09-15-21-27-33-39-45-51-57-63-69-75-81-87-93"]
    {
        assert!(said.iter().any(|s| s == text), "{text}");
    }
    assert!(said.iter().any(|s| s.contains("measured")));
}

#[test]
fn the_page_becomes_a_picture() {
    let svg = diagram::draw(&cut("emerald"), None).expect("draws");
    let picture =
        image::load_from_memory(&raster::png(&svg, 420).expect("a picture")).expect("a PNG").to_luma8();
    assert_eq!(picture.dimensions(), (420, 594));
    let ink = picture.pixels().filter(|p| p.0[0] < 128).count();
    assert!(ink > 1000 && ink < 25_000, "{ink} dark pixels");
}

/// Text of the file that is not compressed: its objects.
fn objects(pdf: &[u8]) -> String {
    String::from_utf8_lossy(pdf).into_owned()
}

#[test]
fn the_page_becomes_a_pdf_of_its_paper_with_its_fonts() {
    for (paper, points) in [(Paper::A4, [595.3, 841.9]), (Paper::Letter, [612.0, 792.0])] {
        let svg = diagram::draw_on(&cut("emerald"), None, paper).expect("draws");
        let page = pdf::pdf(&svg).unwrap_or_else(|e| panic!("{e}"));
        assert!(page.starts_with(b"%PDF-") && page.len() < 300_000, "{} bytes", page.len());
        assert_eq!(page, pdf::pdf(&svg).expect("again"), "the same bytes");
        let said = objects(&page);
        let (_, media) = said.split_once("/MediaBox[").expect("a page");
        let media: Vec<f64> = media
            .split(']')
            .next()
            .into_iter()
            .flat_map(str::split_whitespace)
            .map(|w| w.parse().expect("a number"))
            .collect();
        assert!((media[2] - points[0]).abs() < 0.1 && (media[3] - points[1]).abs() < 0.1, "{media:?}");
        assert!(said.contains("DejaVuSansCondensed") && said.contains("/FontFile"), "fonts are embedded");
    }
    assert!(pdf::pdf("no drawing").is_err());
}

#[test]
fn a_size_is_told_flat_to_flat_and_corner_to_corner() {
    let design = cut("classic").sized(10.0).expect("closed");
    let has = |said: &[String], what: &str| said.iter().any(|s| s.contains(what));
    let said = said(&design);
    assert!(has(&said, "W = 10.20 mm (flat to flat 10.00 mm)"), "{said:?}");
}

#[test]
fn names_with_markup_stay_words() {
    let mut design = cut("classic");
    design.name = "<script>alert(\"1\")</script> & 'Q' ]]> \u{202e}\u{1}".into();
    design.tiers[0].name = "A&B<\"'".into();
    design.tiers[0].instructions = "meet <P1> & \"P2\"".into();
    let text = diagram::draw(&design, None).expect("draws");
    let svg = Document::parse(&text).expect("well-formed");
    assert!(!svg.descendants().any(|n| n.has_tag_name("script")));
    assert!(pdf::pdf(&text).is_ok());
}

#[test]
fn generate_and_show_draw_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = |words: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_cutlab"));
        let out =
            command.args(words.split(' ')).current_dir(folder.path()).output().expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        (out.status.code(), text(out.stdout), text(out.stderr))
    };
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("written");
    assert_eq!(run("generate classic -o a.svg -o a.png -o a.toml").0, Some(0));
    let svg = String::from_utf8(read("a.svg")).expect("UTF-8");
    assert!(svg.starts_with("<svg") && svg.contains("angles for n = 1.540"));
    assert!(read("a.png").starts_with(b"\x89PNG"));
    assert_eq!(run("generate classic -o - --to svg").1, svg);
    assert_eq!(run("show classic --diagram -").1, svg);
    assert_eq!(run("generate classic -o l.pdf --paper letter").0, Some(0));
    let [a4, letter] = ["a4", "letter"].map(|paper| {
        assert_eq!(run(&format!("generate classic -o {paper}.pdf --paper {paper}")).0, Some(0));
        read(&format!("{paper}.pdf"))
    });
    assert!(a4.starts_with(b"%PDF-") && a4 != letter && letter == read("l.pdf"));
    let (code, sheet, _) = run("show a.toml --diagram b.svg --ri 1.77");
    assert!(code == Some(0) && sheet.contains("73 = "), "{sheet}");
    assert!(String::from_utf8(read("b.svg")).expect("UTF-8").contains("angles for n = 1.770"));
    for (words, why) in [
        ("show a.toml classic --diagram c.svg", "one stone"),
        ("show classic --diagram c.eps", ".svg, .pdf or .png"),
        ("generate classic -o c.eps", "gltf, svg, pdf, png"),
        ("generate classic -o c.pdf --paper a5", "a4 or letter"),
    ] {
        let (code, _, said) = run(words);
        assert!(code == Some(2) && said.contains(why) && said.trim_end().lines().count() == 1, "{said}");
    }
}
