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
    followed: usize,
    outlines: usize,
    /// Refusals by what they say.
    refused: BTreeMap<&'static str, usize>,
    /// Cases that the network calls solved, and are not; refusals that name no meet.
    wrong: Vec<String>,
    /// Processor time of the cases in milliseconds.
    times: Vec<f64>,
    /// By how much the worst meet of all that is called kept opened, in parts of the width.
    opened: f64,
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
    println!("a tier turned by ± 1°: {cases} cases, {solved} solved ({:.1} %),", percent(solved, cases));
    println!(
        "  of them {} with angles that followed, {} with another outline",
        counts.followed, counts.outlines
    );
    println!("  the worst meet of them opened by {:.1e} of the width", counts.opened);
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
                    let opened = opened(network, &design.planes(), &solved.planes);
                    counts.opened = counts.opened.max(opened);
                    wrong_of(design, &solved.planes, opened)
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

/// What is wrong with planes that are said to be a stone with all its meets.
fn wrong_of(design: &Design, planes: &[Plane], opened: f64) -> Option<String> {
    if opened > KEPT {
        return Some(format!("a meet opened by {opened:.1e} of the width"));
    }
    let facets = |planes: &[Plane]| {
        Polyhedron::from_planes(planes).map(|solid| {
            let mut facets: Vec<usize> = solid.faces.iter().map(|face| face.plane).collect();
            facets.sort_unstable();
            facets
        })
    };
    match (facets(&design.planes()), facets(planes)) {
        (_, Err(error)) => Some(error.to_string()),
        (Ok(was), Ok(is)) if was != is => Some(format!("{} facets became {}", was.len(), is.len())),
        _ => None,
    }
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

/// By how much the worst meet opened, in parts of the width: the distance of a facet that met from the corner of
/// three of the others, against what it was.
fn opened(network: &MeetNetwork, was: &[Plane], is: &[Plane]) -> f64 {
    let misses = |corner: &Corner, planes: &[Plane]| -> Vec<f64> {
        let [a, b, c] = [0, 1, 2].map(|i| planes[corner.facets[i]]);
        let normals = DMat3::from_cols(a.normal, b.normal, c.normal).transpose();
        let place = normals.inverse() * DVec3::new(a.distance, b.distance, c.distance);
        corner.facets[3..].iter().map(|facet| planes[*facet].signed_distance(place)).collect()
    };
    let of = |corner: &Corner| {
        let pairs = misses(corner, was).into_iter().zip(misses(corner, is));
        pairs.map(|(was, is)| (is - was).abs()).fold(0.0, f64::max)
    };
    network.corners.iter().filter(|corner| corner.facets.len() > 3).map(of).fold(0.0, f64::max)
        / network.width
}
