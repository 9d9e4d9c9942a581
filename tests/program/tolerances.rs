//! What counts as one plane and one corner follows from how a mesh is stored: stones far from the origin, few
//! decimals, edges divided on one side, scans with noise.

use cutlab::advanced::design::Design;
use cutlab::advanced::formats::{self, Loaded};
use cutlab::advanced::geometry::triangulation::TriangleMesh;
use cutlab::advanced::stone::Stone;
use glam::DVec3;
use std::collections::{HashMap, HashSet};
use std::fmt::Write;
use std::process::Command;

fn tolkowsky() -> Design {
    Stone::parse("tolkowsky").and_then(Stone::into_design).expect("a library cut").sized(6.5).expect("closed")
}

/// A binary STL of triangles, without normals.
fn stl(triangles: &[[DVec3; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for t in triangles {
        bytes.extend([0; 12]);
        t.iter().flat_map(|p| p.as_vec3().to_array()).for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn triangles(mesh: &TriangleMesh) -> Vec<[DVec3; 3]> {
    mesh.triangles.iter().map(|t| t.map(|i| mesh.vertices[i])).collect()
}

fn read(name: &str, bytes: &[u8]) -> Loaded {
    formats::read_bytes(name, bytes, None).unwrap_or_else(|e| panic!("{e}"))
}

/// Facets that stand, and how far volume and the facets' normals are off.
fn compared(design: &Design, back: &Design) -> (usize, f64, f64) {
    let (a, b) = (design.solid().expect("closed"), back.solid().expect("closed"));
    let gap = |n: DVec3| back.facets().map(|f| f.plane.normal.distance(n)).fold(f64::INFINITY, f64::min);
    let off = design.facets().map(|f| gap(f.plane.normal)).fold(0.0, f64::max);
    (b.faces.len(), (b.volume() / a.volume() - 1.0).abs(), off)
}

/// A corner 100 mm from the origin is good to 4e-6 mm in `f32`: of one facet or not, it was less than that off
/// a plane that was looked for within 3e-6 mm.
#[test]
fn stones_far_from_the_origin_have_the_facets_they_have_there() {
    let design = tolkowsky();
    let solid = design.solid().expect("closed");
    for offset in [0.0, 10.0, 50.0, 100.0, 250.0] {
        let away = DVec3::new(offset, -0.7 * offset, 0.4 * offset);
        let moved: Vec<_> = triangles(&solid.triangulate()).iter().map(|t| t.map(|p| p + away)).collect();
        let (facets, volume, normals) = compared(&design, &read("away.stl", &stl(&moved)).design);
        println!("{offset} mm: {facets} facets, volume off by {volume:.1e}, normals by {normals:.1e}");
        assert_eq!(facets, design.facets().count(), "{offset} mm");
        // half a unit in the last place of the largest coordinate, over the narrowest facet of .3 mm
        let rounding = (offset + 3.25) * 2f64.powi(-24);
        assert!(volume < 10.0 * rounding && normals < 10.0 * rounding / 0.3, "{offset} mm");
    }
}

/// An OBJ of the stone's polygons with so many decimals.
fn obj(design: &Design, decimals: usize) -> String {
    let solid = design.solid().expect("closed");
    let mut text = String::new();
    for v in &solid.vertices {
        let _ = writeln!(text, "v {:.decimals$} {:.decimals$} {:.decimals$}", v.x, v.y, v.z);
    }
    for face in &solid.faces {
        let corners: Vec<_> = face.corners.iter().map(|c| (c + 1).to_string()).collect();
        let _ = writeln!(text, "f {}", corners.join(" "));
    }
    text
}

#[test]
fn few_decimals_are_few_but_no_dents() {
    let design = tolkowsky();
    for decimals in [4, 5, 6, 8, 12] {
        let (facets, volume, normals) =
            compared(&design, &read("few.obj", obj(&design, decimals).as_bytes()).design);
        println!(
            "{decimals} decimals: {facets} facets, volume off by {volume:.1e}, normals by {normals:.1e}"
        );
        assert_eq!(facets, design.facets().count(), "{decimals}");
        let rounding = 0.5 * 10f64.powi(-(decimals as i32));
        assert!(volume < 4.0 * rounding.max(1e-9), "{decimals}: {volume:e}");
    }
}

/// The stone's polygons, every so many edges divided in one of its two faces.
fn divided(design: &Design, every: usize) -> (String, usize) {
    let solid = design.solid().expect("closed");
    let mut vertices = solid.vertices.clone();
    let mut seen: HashSet<(usize, usize)> = HashSet::new();
    let (mut faces, mut count) = (String::new(), 0);
    for face in &solid.faces {
        faces.push('f');
        for (i, &a) in face.corners.iter().enumerate() {
            let b = face.corners[(i + 1) % face.corners.len()];
            let _ = write!(faces, " {}", a + 1);
            let first = seen.insert((a.min(b), a.max(b)));
            if first && seen.len().is_multiple_of(every) {
                vertices.push(vertices[a].lerp(vertices[b], 0.3));
                let _ = write!(faces, " {}", vertices.len());
                count += 1;
            }
        }
        faces.push('\n');
    }
    let vertices: String = vertices.iter().map(|v| format!("v {} {} {}\n", v.x, v.y, v.z)).collect();
    (vertices + &faces, count)
}

#[test]
fn a_corner_on_an_edge_opens_no_stone() {
    let design = tolkowsky();
    for every in [1, 3, 50] {
        let (text, count) = divided(&design, every);
        let back = read("divided.obj", text.as_bytes());
        let (facets, volume, normals) = compared(&design, &back.design);
        assert_eq!(facets, design.facets().count(), "{every}");
        assert!(volume < 1e-9 && normals < 1e-7, "{every}: {volume:e} {normals:e}");
        let said = format!("{count} corner");
        assert!(back.warnings.iter().any(|w| w.contains(&said)), "{every}: {:?}", back.warnings);
    }
    // a triangle that is missing is a hole
    let mesh = design.solid().expect("closed").triangulate();
    let holed = stl(&triangles(&mesh)[1..]);
    let error = formats::read_bytes("hole.stl", &holed, None).map(|i| i.format).expect_err("is open");
    assert!(error.to_string().contains("3 edges are not shared"), "{error}");
}

/// The triangles, each cut into four so many times, their corners moved by noise.
fn scan(mesh: &TriangleMesh, times: usize, mut noise: impl FnMut() -> f64) -> Vec<[DVec3; 3]> {
    let (mut vertices, mut all) = (mesh.vertices.clone(), mesh.triangles.clone());
    for _ in 0..times {
        let mut middle: HashMap<(usize, usize), usize> = HashMap::new();
        all = all
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(a, b)| {
                    *middle.entry((a.min(b), a.max(b))).or_insert_with(|| {
                        vertices.push((vertices[a] + vertices[b]) * 0.5);
                        vertices.len() - 1
                    })
                });
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    vertices.iter_mut().for_each(|v| *v += DVec3::new(noise(), noise(), noise()));
    all.iter().map(|t| t.map(|i| vertices[i])).collect()
}

/// Evenly from -1 to 1, the same at every run.
fn draws() -> impl FnMut() -> f64 {
    let mut state: u64 = 7;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Half a micrometre of noise on 31,616 triangles: `show` read it with a raised limit, `score` did not at all.
#[test]
fn scans_with_noise_are_shown_and_scored_alike() {
    let design = tolkowsky();
    let mesh = design.solid().expect("closed").triangulate();
    let mut even = draws();
    let mut normal = draws();
    let smooth = scan(&mesh, 3, || 5e-4 * even());
    let rough = scan(&mesh, 3, || 5e-4 * (0..12).map(|_| normal()).sum::<f64>() / 2.0);
    assert_eq!(smooth.len(), 64 * mesh.triangles.len());
    for (what, triangles) in [("even", smooth), ("normal", rough)] {
        let back = read("scan.stl", &stl(&triangles));
        let (facets, volume, normals) = compared(&design, &back.design);
        println!("{what}: {facets} facets, volume off by {volume:.1e}, normals by {normals:.1e}");
        // flats of the girdle may go: they bend by no more than the noise is high
        // and leftovers of it may stay
        assert!(facets.abs_diff(design.facets().count()) <= 40, "{what}");
        assert!(volume < 3e-3 && normals < 0.05, "{what}");
        assert!(back.warnings.iter().any(|w| w.contains("coarse mesh")), "{what}: {:?}", back.warnings);
    }
}

fn cutlab(folder: &std::path::Path, arguments: &[&str]) -> std::process::Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_cutlab"));
    program.args(arguments).current_dir(folder).output().expect("the program starts")
}

/// Whatever the noise, what is shown can be scored: of a mesh that is too rough to be a stone of facets, every
/// triangle that merging would bend stays by itself.
#[test]
fn what_is_shown_of_a_rough_mesh_is_scored() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mesh = tolkowsky().solid().expect("closed").triangulate();
    for micrometres in [0.0, 0.02, 0.5, 5.0, 30.0] {
        let mut draw = draws();
        let bytes = stl(&scan(&mesh, 1, || micrometres * 1e-3 * draw()));
        std::fs::write(folder.path().join("scan.stl"), bytes).expect("written");
        let shown = cutlab(folder.path(), &["show", "--json", "scan.stl"]);
        let scored =
            cutlab(folder.path(), &["score", "scan.stl", "--metrics", "wlr", "--error", "0.02", "-q"]);
        let said = |o: &std::process::Output| String::from_utf8_lossy(&o.stderr).into_owned();
        assert!(shown.status.success(), "{micrometres} µm: {}", said(&shown));
        assert!(scored.status.success(), "{micrometres} µm: {}", said(&scored));
        let sheet: serde_json::Value = serde_json::from_slice(&shown.stdout).expect("JSON");
        let table = String::from_utf8_lossy(&scored.stdout).into_owned();
        let mut rows = csv::Reader::from_reader(table.as_bytes());
        let heads = rows.headers().expect("heads").clone();
        let row = rows.records().next().expect("a row").expect("CSV");
        let cell = |name: &str| heads.iter().position(|h| h == name).map_or("", |i| &row[i]);
        assert_eq!(sheet[0]["facets"].to_string(), cell("facets"), "{micrometres} µm: {table}");
        assert!(cell("wlr").parse::<f64>().is_ok_and(|w| w > 0.0), "{micrometres} µm: {table}");
    }
}

/// A convex stone of more facets than the limit is no noise: the error names the factor that is enough.
#[test]
fn too_many_facets_are_counted() {
    // points of a sphere, evenly spread, each with its tangent plane's facet: an icosahedron cut in four five times
    let mesh = Stone::parse("octahedron")
        .and_then(Stone::into_design)
        .expect("a library cut")
        .solid()
        .expect("closed")
        .triangulate();
    let ball: Vec<_> = scan(&mesh, 6, || 0.0).iter().map(|t| t.map(|p| p.normalize() * 3.0)).collect();
    assert_eq!(ball.len(), 32_768);
    let error = formats::read_bytes("ball.stl", &stl(&ball), None).map(|i| i.format).expect_err("too many");
    let said = "more than 10000 facets of a stone: the limit; CUTLAB_LIMIT=4 in the environment is enough";
    assert!(error.to_string().contains(said), "{error}");
}

/// A mesh in metres is shown with the digits it has, not as nothing.
#[test]
fn a_stone_of_millimetres_in_metres_is_shown() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mesh = tolkowsky().solid().expect("closed").triangulate();
    let small: Vec<_> = triangles(&mesh).iter().map(|t| t.map(|p| p * 1e-3)).collect();
    std::fs::write(folder.path().join("metres.stl"), stl(&small)).expect("written");
    let out = cutlab(folder.path(), &["show", "metres.stl"]);
    let said = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(said.contains("e-8 in the file's own unit"), "{said}");
    assert!(said.contains("6.5000e-3 × "), "{said}");
}
