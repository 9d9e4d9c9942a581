//! Real files: every design and mesh of the corpus has the volume that an independent program found,
//! and every design comes back from every format it is written in.
//!
//! The corpus is in `$CUTLAB_CORPUS`, or in `../shared/corpus` beside the package; where there is
//! none, the tests say so and pass.

use crate::corpus_folder::corpus;
use cutlab::advanced::design::Design;
use cutlab::advanced::formats::{self, FORMATS, Format, Loaded};
use cutlab::advanced::geometry::{Plane, Polyhedron};
use rayon::prelude::*;
use std::path::Path;

fn volume(stone: &Loaded) -> f64 {
    stone.design.solid().expect("what is read is closed").volume()
}

/// The columns of `geometry.csv` that are compared.
struct Known {
    file: String,
    facets: usize,
    closed: bool,
    volume: f64,
    low: [f64; 3],
    high: [f64; 3],
}

fn known(corpus: &Path) -> Vec<Known> {
    let mut table = csv::ReaderBuilder::new()
        .flexible(true)
        .from_path(corpus.join("geometry.csv"))
        .expect("the corpus has its table");
    let heads = table.headers().expect("with a first row").clone();
    let column = |name: &str| heads.iter().position(|h| h == name).expect("and the columns it promises");
    let names = ["xmin", "ymin", "zmin", "xmax", "ymax", "zmax"].map(column);
    let (file, facets) = (column("file"), column("faces_area_gt_1e-9"));
    let (closed, volume) = (column("closed"), column("volume"));
    table
        .records()
        .map(|row| row.expect("rows are CSV"))
        .map(|row| {
            let number = |i: usize| row.get(i).and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::NAN);
            Known {
                file: row[file].into(),
                facets: number(facets) as usize,
                closed: &row[closed] == "1",
                volume: number(volume),
                low: [0, 1, 2].map(|k| number(names[k])),
                high: [3, 4, 5].map(|k| number(names[k])),
            }
        })
        .collect()
}

#[test]
fn designs_have_the_volume_box_and_facets_known_for_them() {
    let Some(corpus) = corpus() else { return };
    let (mut closed, mut open) = (0, 0);
    let mut wrong = Vec::new();
    let known = known(&corpus);
    for k in &known {
        let stone = match formats::read(&corpus.join(&k.file)) {
            Ok(stone) => stone,
            Err(error) => {
                let line = error.to_string();
                if k.closed || line.contains('\n') {
                    wrong.push(format!("{}: {line}", k.file));
                } else {
                    println!("refused: {line}");
                    open += 1;
                }
                continue;
            }
        };
        let extension = k.file.rsplit('.').next().map(str::to_lowercase);
        let wanted = FORMATS.iter().find(|f| extension.as_deref().is_some_and(|e| f.extensions.contains(&e)));
        assert_eq!(Some(stone.format), wanted.map(|f| f.name), "{}", k.file);
        if !k.closed {
            wrong.push(format!("{}: known to be open, but was read", k.file));
            continue;
        }
        closed += 1;
        let solid = stone.design.solid().expect("what is read is closed");
        let volume = solid.volume();
        if (volume / k.volume - 1.0).abs() > 1e-6 {
            wrong.push(format!("{}: volume {volume}, known {}", k.file, k.volume));
        }
        let facets = (0..solid.faces.len()).filter(|&f| solid.area(f) > 1e-9).count();
        if facets != k.facets {
            wrong.push(format!("{}: {facets} facets, known {}", k.file, k.facets));
        }
        let (low, high) = solid.bounds();
        let off = (0..3).map(|a| (low[a] - k.low[a]).abs().max((high[a] - k.high[a]).abs()));
        let off = off.fold(0.0, f64::max);
        if off > 1e-6 {
            wrong.push(format!("{}: box off by {off:e}", k.file));
        }
        if solid.euler() != 2 {
            wrong.push(format!("{}: V - E + F = {}", k.file, solid.euler()));
        }
    }
    println!("{} designs: {closed} closed, {open} refused as open", known.len());
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn meshes_have_the_volume_and_facets_of_the_designs_they_were_made_from() {
    let Some(corpus) = corpus() else { return };
    let table = std::fs::read_to_string(corpus.join("meshes/volumes.tsv")).expect("the meshes have a table");
    let (mut read, mut wrong) = (0, Vec::new());
    for row in table.lines().skip(1) {
        let cells: Vec<_> = row.split('\t').collect();
        let (name, faces) = (cells[0], cells[3].parse::<usize>().expect("a count"));
        let known: f64 = cells[5].parse().expect("a volume");
        for extension in [".obj", "_tri.obj", ".stl", "_ascii.stl", ".ply", "_le.ply"] {
            let file = corpus.join("meshes").join(format!("{name}{extension}"));
            match formats::read(&file) {
                Err(error) => wrong.push(error.to_string()),
                Ok(stone) => {
                    let (volume, facets) = (volume(&stone), stone.design.facets().count());
                    println!(
                        "{name}{extension}: {facets} facets of {faces}, volume off by {:.1e} {:?}",
                        volume / known - 1.0,
                        stone.warnings
                    );
                    read += 1;
                    if (volume / known - 1.0).abs() > 1e-6 {
                        wrong.push(format!("{name}{extension}: volume {volume}, known {known}"));
                    }
                    if facets != faces {
                        wrong.push(format!("{name}{extension}: {facets} facets, known {faces}"));
                    }
                }
            }
        }
    }
    // an artist's diamond: its crown has concavities of a fiftieth of its size
    let dented = formats::read(&corpus.join("meshes/diamond.glb")).map(|i| i.design.facets().count());
    match dented {
        Err(error) if error.to_string().contains("not convex") => println!("refused: {error}"),
        other => wrong.push(format!("diamond.glb: {other:?}, but it is not convex")),
    }
    println!("{read} meshes read");
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn all_designs_are_shown_in_one_call_in_two_seconds() {
    let Some(corpus) = corpus() else { return };
    let known = known(&corpus);
    let begun = std::time::Instant::now();
    let out = std::process::Command::new(env!("CARGO_BIN_EXE_cutlab"))
        .args(["show", "--json", "--quiet"])
        .args(known.iter().map(|k| &k.file))
        .current_dir(&corpus)
        .output()
        .expect("the program starts");
    let took = begun.elapsed();
    println!("{} designs shown in {:.2} s", known.len(), took.as_secs_f64());
    let sheets: serde_json::Value = serde_json::from_slice(&out.stdout).expect("JSON");
    let open = known.iter().filter(|k| !k.closed).count();
    for (sheet, k) in sheets.as_array().expect("an array").iter().zip(&known) {
        assert_eq!(sheet["closed"], k.closed, "{}", k.file);
    }
    assert_eq!(sheets.as_array().map(Vec::len), Some(known.len()));
    assert_eq!(out.status.code(), Some(i32::from(open > 0)));
    assert!(took.as_secs_f64() < 2.0, "{took:?}");
}

/// The formats that hold facets as planes, and so give them back.
const DESIGN_FORMATS: [&str; 4] = ["cutlab", "gemcad", "gemcad-binary", "gem-cut-studio"];

/// The largest difference of a normal, or of a distance from the middle in parts of the size, facet by
/// facet: each format has a frame of its own.
fn off(a: &Design, b: &Design, [this, that]: [&Polyhedron; 2]) -> f64 {
    if a.facets().count() != b.facets().count() {
        return f64::INFINITY;
    }
    let frame = |solid: &Polyhedron| (solid.volume_and_centre().1, solid.volume().cbrt());
    let ((middle, size), (other_middle, other_size)) = (frame(this), frame(that));
    let gap = |(p, q): (Plane, Plane)| {
        let apart = p.signed_distance(middle) / size - q.signed_distance(other_middle) / other_size;
        p.normal.distance(q.normal).max(apart.abs())
    };
    a.planes().into_iter().zip(b.planes()).map(gap).fold(0.0, f64::max)
}

/// How far the corners of a face stand from the plane of the copy that fits it best, at most over all
/// faces, in parts of the size: what is off in a normal counts as much as the facet is large.
///
/// - `scale`: of the copy
fn surface_off(a: &Polyhedron, b: &[Plane], scale: f64) -> f64 {
    let size = 2.0 * a.bounding_sphere().1;
    let b: Vec<Plane> = b.iter().map(|p| p.scaled(scale.recip())).collect();
    let off = |face: usize| {
        let apart = |p: &Plane| a.polygon(face).map(|v| p.signed_distance(v).abs()).fold(0.0, f64::max);
        b.iter().map(apart).fold(f64::INFINITY, f64::min)
    };
    (0..a.faces.len()).map(off).fold(0.0, f64::max) / size
}

/// One design through one format and back: volume, planes or surface off, facets lost, what is wrong.
fn there_and_back(file: &str, stone: &Design, format: &'static Format) -> (f64, f64, usize, Option<String>) {
    let solid = stone.solid().expect("what is read is closed");
    let bytes = formats::encode(stone, format.name).expect("can be written");
    let back = match formats::read_bytes(file, &bytes, None) {
        Ok(back) => back.design,
        Err(error) => return (0.0, 0.0, 0, Some(format!("{}: {error}", format.name))),
    };
    let again = back.solid().expect("what is read is closed");
    // not of the widths: an edge of the outline that is as short as rounding may count in one of them alone
    let scale = again.bounding_sphere().1 / solid.bounding_sphere().1;
    let volume = (again.volume() / solid.volume() / scale.powi(3) - 1.0).abs();
    let lost = solid.faces.len().abs_diff(again.faces.len());
    let is_design = DESIGN_FORMATS.contains(&format.name);
    let (planes, allowed) = if is_design {
        // GemCad text has ten significant digits
        (off(stone, &back, [&solid, &again]), if format.name == "gemcad" { 1e-8 } else { 1e-12 })
    } else {
        (surface_off(&solid, &back.planes(), scale), 1e-6)
    };
    // Gem Cut Studio has no place for a gear's offset: its base is the state of a window
    let offset = |d: &Design| (format.name != "gem-cut-studio").then_some(d.gear.offset);
    let texts = |d: &Design| {
        let tiers: Vec<_> = d.tiers.iter().map(|t| t.name.clone()).collect();
        (d.name.clone(), d.gear.teeth, offset(d), tiers)
    };
    let wrong = if volume > 1e-6 || planes > allowed || (is_design && lost > 0) {
        Some(format!("volume off by {volume:.1e}, planes by {planes:.1e}, {lost} facets lost"))
    } else if is_design && texts(stone) != texts(&back) {
        Some("names or gear differ".into())
    } else {
        None
    };
    (volume, planes, lost, wrong.map(|w| format!("{file} as {}: {w}", format.name)))
}

#[test]
#[ignore = "some twenty seconds"]
fn real_designs_survive_being_written_and_read_back() {
    let Some(corpus) = corpus() else { return };
    let known = known(&corpus);
    let closed: Vec<_> = known.iter().filter(|k| k.closed).collect();
    let through = |k: &&Known| {
        let stone = formats::read(&corpus.join(&k.file)).expect("is read, see above").design;
        let written = FORMATS.iter().filter(|f| f.write.is_some());
        written.map(|f| (f.name, there_and_back(&k.file, &stone, f))).collect::<Vec<_>>()
    };
    // every other one; all are read, above
    let results: Vec<_> = closed.par_iter().step_by(2).flat_map_iter(through).collect();
    let mut worst = std::collections::BTreeMap::new();
    for (format, (volume, planes, lost, _)) in &results {
        let entry = worst.entry(format).or_insert((0.0f64, 0.0f64, 0usize, 0usize));
        let lossy = usize::from(*lost > 0);
        *entry = (entry.0.max(*volume), entry.1.max(*planes), entry.2.max(*lost), entry.3 + lossy);
    }
    println!("{} designs, {} files", closed.len(), results.len());
    println!("largest difference of volume, of planes, most facets lost, designs that lost any:");
    worst.iter().for_each(|(format, w)| println!("{format}: {w:?}"));
    let wrong: Vec<_> = results.into_iter().filter_map(|(_, r)| r.3).collect();
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn both_forms_of_a_gemcad_design_agree() {
    let Some(corpus) = corpus() else { return };
    for name in ["SRB", "Compear125", "CubeIllusionTri", "Turkey"] {
        let read = |extension: &str| {
            let path = corpus.join("pairs").join(name).with_extension(extension);
            formats::read(&path).unwrap_or_else(|e| panic!("{e}")).design
        };
        let (text, binary) = (read("asc"), read("gem"));
        let solids = [&text, &binary].map(|d| d.solid().expect("closed"));
        let planes = off(&text, &binary, [&solids[0], &solids[1]]);
        println!("{name}: planes off by {planes:.1e}");
        // the text has six decimals of angles in degrees and eight of distances
        assert!(planes < 2e-8, "{name}: {planes:e}");
        let said = |d: &Design| (d.name.clone(), d.headers.clone(), d.footers.clone(), d.symmetry, d.gear);
        assert_eq!(said(&text), said(&binary));
        for (a, b) in text.tiers.iter().zip(&binary.tiers) {
            assert_eq!((&a.name, &a.instructions), (&b.name, &b.instructions));
            assert!(a.angle_deg.zip(b.angle_deg).is_some_and(|(a, b)| (a - b).abs() < 1e-6));
            let names = |t: &cutlab::advanced::design::Tier| {
                t.facets.iter().map(|f| f.name.clone()).collect::<Vec<_>>()
            };
            assert_eq!(names(a), names(b), "{name}");
        }
    }
}
