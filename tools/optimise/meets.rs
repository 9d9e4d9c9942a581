//! `meets`: over every closed `.asc` and `.gem` of the corpus, whether the meet network keeps what met when a tier
//! turns by a degree, whether it gives the same planes when nothing changes, and whether `edit` without a change
//! gives the same file.
//!
//! What the network says it kept is computed again here, from its planes alone.

use super::subjects::{corpus, ends};
use super::timing::{self, thread_time};
use cutlab::advanced::design::edit::{Editor, Keep};
use cutlab::advanced::design::meet_network::{Change, Corner, MeetNetwork, NetworkError};
use cutlab::advanced::design::{Design, Zone};
use cutlab::advanced::limits::Limits;
use cutlab::advanced::report::{edited_file, target_format::TargetFormat};
use cutlab::glam::{DMat3, DVec3};
use cutlab::{Plane, Polyhedron, Stone};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};

/// The most that a meet may open or a plane move, in parts of the width.
const KEPT: f64 = 1e-9;

/// The most that a plane of a file that is written again may move, in parts of the width.
const SAME: f64 = 1e-12;

/// Meets of a file are as exact as its rounding. A change of tangent ratio, which draws a side of the stone out, may
/// turn what rounding left by so much.
const AS_EXACT: f64 = 1.5;

/// Edges shorter than this, in parts of the width, are one corner of the meet network.
const ONE_CORNER: f64 = 1e-4;

/// What was counted.
#[derive(Default)]
struct Counts {
    designs: usize,
    /// Designs whose planes stay where they are when nothing changes.
    unchanged: usize,
    /// Designs whose files are written byte by byte as they were, and those with the same planes and text.
    same_bytes: usize,
    same_design: usize,
    /// Tiers turned by a degree, up and down.
    cases: usize,
    solved: usize,
    /// Solved, every meet within [`KEPT`] of what it was; and every meet as exact as the file has it.
    kept: usize,
    as_exact: usize,
    /// Solved, with facets that did not bound the stone before.
    more_facets: usize,
    followed: usize,
    outlines: usize,
    /// Refusals by what they say.
    refused: BTreeMap<&'static str, usize>,
    /// Cases that the network calls solved, and are not; refusals that name no meet.
    wrong: Vec<String>,
    /// Processor time of the cases in milliseconds.
    times: Vec<f64>,
}

/// Measures all designs, and prints what is wrong as it comes.
pub fn run(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    let corpus = corpus(arguments)?;
    let mut counts = Counts::default();
    for file in files(Path::new(&corpus))? {
        let name = file.to_string_lossy().into_owned();
        let Ok(stone) = Stone::parse(&name) else { continue };
        let (Some(design), Some(solid)) = (stone.design(), stone.solid()) else { continue };
        counts.designs += 1;
        let network = MeetNetwork::recover(design, solid);
        unchanged(&mut counts, &name, design, &network);
        written_again(&mut counts, &name, &stone)?;
        turned(&mut counts, &name, design, &network)?;
    }
    let Counts { designs, unchanged, same_bytes, same_design, cases, solved, .. } = counts;
    let percent = |part: usize, of: usize| 100.0 * part as f64 / of as f64;
    println!("{}", timing::machine());
    println!("{designs} closed designs");
    println!(
        "unchanged angles, planes within {KEPT:.0e} of the width: {unchanged} ({:.1} %)",
        percent(unchanged, designs)
    );
    println!(
        "edit without a change: {same_bytes} files of the same bytes, {same_design} with the same planes and text"
    );
    println!("a tier turned by ± 1°: {cases} cases, {solved} solved ({:.1} %)", percent(solved, cases));
    println!(
        "  every meet within {KEPT:.0e} of the width of what it was: {} ({:.1} %)",
        counts.kept,
        percent(counts.kept, cases)
    );
    println!(
        "  else every meet as exact as the file has it: {} ({:.1} %)",
        counts.as_exact,
        percent(counts.as_exact, cases)
    );
    println!("  {} with angles that followed, {} with another outline,", counts.followed, counts.outlines);
    println!("  {} with facets that did not bound the stone before", counts.more_facets);
    println!("  refused, with the meet or the facets named: {:?}", counts.refused);
    println!("  wrong: {}", counts.wrong.len());
    let mean = counts.times.iter().sum::<f64>() / counts.times.len() as f64;
    println!("  {mean:.2} ms a case, worst {:.0} ms", ends(counts.times).1);
    Ok(())
}

/// The designs of the corpus, in order.
fn files(corpus: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut files = Vec::new();
    for folder in ["gemcad", "pairs", "other"] {
        for entry in std::fs::read_dir(corpus.join(folder))? {
            let path = entry?.path();
            let extension = path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
            if extension == "asc" || extension == "gem" {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// By how much the worst of some planes moved, in parts of the width.
fn moved<'p>(pairs: impl Iterator<Item = (&'p Plane, &'p Plane)>, width: f64) -> f64 {
    let by =
        |(a, b): (&Plane, &Plane)| a.normal.distance(b.normal).max((a.distance - b.distance).abs() / width);
    pairs.map(by).fold(0.0, f64::max)
}

/// The network solved at the angles that there are.
fn unchanged(counts: &mut Counts, name: &str, design: &Design, network: &MeetNetwork) {
    match network.solve(&Change::default()) {
        Ok(solved) => match moved(solved.planes.iter().zip(&design.planes()), network.width) {
            by if by < KEPT => counts.unchanged += 1,
            by => println!("{name}: planes move by {by:.1e} of the width though nothing changes"),
        },
        Err(error) => println!("{name}: unchanged, {error}"),
    }
}

/// The design edited by nothing and written into its file.
fn written_again(counts: &mut Counts, name: &str, stone: &Stone) -> Result<(), Box<dyn Error>> {
    let edited = Editor::new(stone.convex_design()?)?.edit(&[], Keep::Meets)?;
    let target = TargetFormat::by_name(stone.format())?;
    let made = edited_file::encode((name.as_ref(), stone), &edited.design, None, target, Limits::default())?;
    counts.same_bytes += usize::from(made.bytes == std::fs::read(name)?);
    let again = Stone::from_bytes(name, &made.bytes, None)?;
    let (was, is) = (stone.convex_design()?, again.convex_design()?);
    let by = moved(is.planes().iter().zip(&was.planes()), stone.width());
    match by <= SAME && text(was) == text(is) {
        true => counts.same_design += 1,
        false => println!(
            "{name}: written again, planes move by {by:.1e}, text {}",
            if text(was) == text(is) { "same" } else { "other" }
        ),
    }
    Ok(())
}

/// All that a design holds besides planes.
fn text(design: &Design) -> String {
    let mut bare = design.clone();
    bare.tiers
        .iter_mut()
        .flat_map(|tier| &mut tier.facets)
        .for_each(|facet| facet.plane = Plane { normal: DVec3::Z, distance: 0.0 });
    format!("{bare:?}")
}

/// Each tier of crown and pavilion turned by a degree, up and down.
fn turned(
    counts: &mut Counts,
    name: &str,
    design: &Design,
    network: &MeetNetwork,
) -> Result<(), Box<dyn Error>> {
    let tiers = Editor::new(design)?.tiers.tiers;
    for tier in tiers.iter().filter(|tier| matches!(tier.zone, Zone::Crown | Zone::Pavilion)) {
        for degrees in [1.0_f64, -1.0] {
            let mut change = Change { polars: vec![None; network.parts.len()], ..Change::default() };
            for &part in &tier.parts {
                change.polars[part] = Some(network.parts[part].polar + degrees.to_radians());
            }
            let begun = thread_time();
            let result = network.solve(&change);
            counts.times.push(1e3 * (thread_time() - begun).as_secs_f64());
            counts.cases += 1;
            let wrong = match &result {
                Ok(solved) => {
                    counts.solved += 1;
                    counts.followed += usize::from(!solved.followed.is_empty());
                    counts.outlines += usize::from(solved.is_outline_changed);
                    checked(counts, network, &design.planes(), &solved.planes)
                }
                Err(error) => refusal(&mut counts.refused, error),
            };
            if let Some(why) = wrong {
                let line = format!("{name}: {} by {degrees:+}°: {why}", tier.label());
                println!("{line}");
                counts.wrong.push(line);
            }
        }
    }
    Ok(())
}

/// Counts how well planes that are said to be a stone with all its meets keep them; what is wrong with them.
fn checked(counts: &mut Counts, network: &MeetNetwork, was: &[Plane], is: &[Plane]) -> Option<String> {
    let width = network.width;
    let mut opened: f64 = 0.0;
    let mut looser: f64 = 0.0;
    for corner in network.corners.iter().filter(|corner| corner.facets.len() > 3) {
        let (before, after) = (misses(corner, was), misses(corner, is));
        let of_file = before.iter().fold(0.0, |most: f64, miss| most.max(miss.abs()));
        for (before, after) in before.iter().zip(&after) {
            opened = opened.max((after - before).abs() / width);
            looser = looser.max((after.abs() - AS_EXACT * of_file) / width);
        }
    }
    if opened <= KEPT {
        counts.kept += 1;
    } else if looser <= KEPT {
        counts.as_exact += 1;
    } else {
        return Some(format!(
            "a meet opens by {opened:.1e} of the width, and is not as exact as in the file"
        ));
    }
    let (Ok(before), Ok(after)) = (Polyhedron::from_planes(was), Polyhedron::from_planes(is)) else {
        return Some("the planes bound no stone".into());
    };
    let has = |solid: &Polyhedron, plane: usize| solid.faces.iter().any(|face| face.plane == plane);
    let lost = facets(&before).filter(|plane| !has(&after, *plane)).count();
    counts.more_facets += usize::from(facets(&after).any(|plane| !has(&before, plane)));
    (lost > 0).then(|| format!("{lost} facets are lost"))
}

/// The planes of the facets that are no rounding: wider, by twice their area over their outline's length, than edges
/// of one corner are long.
fn facets(solid: &Polyhedron) -> impl Iterator<Item = usize> {
    let width = solid.width();
    let is_wide = move |i: &usize| {
        let corners: Vec<DVec3> = solid.polygon(*i).collect();
        let next = corners.iter().cycle().skip(1);
        let around: f64 = corners.iter().zip(next).map(|(a, b)| a.distance(*b)).sum();
        2.0 * solid.area(*i) / around > ONE_CORNER * width
    };
    (0..solid.faces.len()).filter(is_wide).map(|i| solid.faces[i].plane)
}

/// Of the facets that meet in a corner beyond three their distances from the corner of these three.
fn misses(corner: &Corner, planes: &[Plane]) -> Vec<f64> {
    let [a, b, c] = [0, 1, 2].map(|i| planes[corner.facets[i]]);
    let normals = DMat3::from_cols(a.normal, b.normal, c.normal).transpose();
    let place = normals.inverse() * DVec3::new(a.distance, b.distance, c.distance);
    corner.facets[3..].iter().map(|facet| planes[*facet].signed_distance(place)).collect()
}

/// Counts a refusal; what is wrong with one that names nothing.
fn refusal(refused: &mut BTreeMap<&'static str, usize>, error: &NetworkError) -> Option<String> {
    let (kind, named) = match error {
        NetworkError::Opens { facets, .. } => ("opens", facets.len()),
        NetworkError::CutAway { facets, .. } => ("cut away", facets.len()),
        NetworkError::Lost { facets } => ("facets lost", facets.len()),
        _ => ("other", 0),
    };
    *refused.entry(kind).or_default() += 1;
    (named == 0).then(|| format!("refused without a name: {error}"))
}
