//! Outlines by name: those of the library's cuts, however they are turned, and those that a catalogue of designs
//! gives its own.

use crate::corpus_folder::corpus;
use cutlab::advanced::design::outline_shape::OutlineShape::{self, *};
use cutlab::{Polyhedron, Stone};
use glam::DMat3;
use std::collections::BTreeMap;

fn outline(stone: &str) -> OutlineShape {
    let stone = Stone::parse(stone).unwrap_or_else(|e| panic!("{stone}: {e}"));
    OutlineShape::of(stone.solid().expect("convex"))
}

#[test]
fn cuts_of_the_library_have_the_outlines_that_they_are_called_by() {
    for (cut, expected) in [
        ("tolkowsky", Round),
        ("portuguese", Round),
        ("oval", Oval),
        ("oval:length-to-width=1.7", Oval),
        ("pear", Pear),
        ("marquise", Marquise),
        ("princess", Square),
        ("french-cut:length-to-width=1.3", Rectangle),
        ("old-mine", Cushion),
        ("trilliant", Triangle),
        ("triangle-step", Triangle),
        ("pentagon-brilliant", Pentagon),
        ("hexagon-step", Hexagon),
        ("octagon-step", Octagon),
        ("emerald", Rectangle),
        ("cushion", Cushion),
    ] {
        assert_eq!(outline(cut), expected, "{cut}");
    }
}

/// A stone that is turned about its axis, enlarged and moved aside has the outline that it had.
#[test]
fn an_outline_is_the_same_however_the_stone_lies() {
    for cut in cutlab::advanced::design::library::names() {
        let stone = Stone::parse(cut).unwrap_or_else(|e| panic!("{cut}: {e}"));
        let solid = stone.solid().expect("convex");
        let expected = OutlineShape::of(solid);
        for turn in [0.1, 0.3712, 1.0, 2.5] {
            let rotation = DMat3::from_rotation_z(turn);
            let turned: Polyhedron = {
                let mut turned = solid.clone();
                turned
                    .vertices
                    .iter_mut()
                    .for_each(|v| *v = rotation * *v * 3.7 + glam::DVec3::new(2.0, -1.0, 5.0));
                turned
            };
            assert_eq!(OutlineShape::of(&turned), expected, "{cut} by {turn}");
        }
    }
}

/// The GemCad design catalogue numbers designs by their outlines: `PC 02.105A` is an oval. More than nine in
/// ten designs of the classes that have a name here are called by it; what is not is in between (a hexagon with
/// wide cut corners, an oval with flat ends).
#[test]
fn designs_have_the_outlines_of_their_catalogue_numbers() {
    let Some(corpus) = corpus() else { return };
    let classes: BTreeMap<&str, &[OutlineShape]> = BTreeMap::from([
        ("01", &[Round][..]),
        ("02", &[Oval]),
        ("03", &[Marquise]),
        ("04", &[Rectangle]),
        ("05", &[Pear]),
        // squares with cut corners, and without
        ("07", &[Square]),
        ("11", &[Square]),
        // long and square cushions
        ("08", &[Cushion]),
        ("09", &[Cushion]),
        ("13", &[Triangle]),
        ("16", &[Triangle]),
        ("21", &[Octagon]),
        ("28", &[Hexagon]),
        ("30", &[Pentagon]),
    ]);
    let (mut counts, mut others) = (BTreeMap::<&str, (usize, usize)>::new(), Vec::new());
    let mut files: Vec<_> = std::fs::read_dir(corpus.join("gemcad"))
        .expect("the corpus")
        .map(|f| f.expect("a file").path())
        .collect();
    files.sort();
    for path in files {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let class = name.strip_prefix("PC").and_then(|number| classes.get_key_value(number.get(..2)?));
        let (Some((class, expected)), Ok(stone)) = (class, Stone::open(&path, &Default::default())) else {
            continue;
        };
        let Some(solid) = stone.solid() else { continue };
        let found = OutlineShape::of(solid);
        let count = counts.entry(class).or_default();
        count.1 += 1;
        match expected.contains(&found) {
            true => count.0 += 1,
            false => others.push(format!("{name}: {found}")),
        }
    }
    println!("{counts:?}\n{}", others.join("\n"));
    let (right, all) = counts.values().fold((0, 0), |sum, n| (sum.0 + n.0, sum.1 + n.1));
    assert!(all > 200 && right * 10 > all * 9, "{right} of {all}: {counts:?}");
}
