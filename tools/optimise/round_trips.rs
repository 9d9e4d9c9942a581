//! `round-trips`: designs read from `.asc`, `.gem` and `.gcs`, optimised, written to each of these formats and read
//! again: ISO by exact beams before and after. Into its own format a design goes back into its file, into others it
//! is written anew.

use super::subjects::{SUBJECTS, Subject, objectives};
use cutlab::advanced::formats;
use cutlab::advanced::limits::Limits;
use cutlab::advanced::report::{edited_file, target_format::TargetFormat};
use cutlab::{Material, ScoreRequest, Stone};
use std::error::Error;
use std::path::Path;

/// The formats that cutters' programs read.
const FORMATS: [&str; 3] = ["asc", "gem", "gcs"];

/// The most that ISO may change, in points.
const SAME: f64 = 1e-9;

/// Candidates of each optimisation: enough that every angle has changed.
const CANDIDATES: usize = 60;

/// Optimises each subject from each format and writes it in each.
pub fn run(_: &[String]) -> Result<(), Box<dyn Error>> {
    let folder = std::env::temp_dir().join(format!("cutlab-round-trips-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    println!("| design | from | ISO | to asc | to gem | to gcs |");
    println!("|---|---|--:|--:|--:|--:|");
    let mut worst: f64 = 0.0;
    for subject in &SUBJECTS {
        for from in FORMATS {
            let changes = from_format(subject, from, &folder)?;
            worst = changes.iter().fold(worst, |worst, change| worst.max(change.abs()));
        }
    }
    std::fs::remove_dir_all(&folder)?;
    println!();
    println!("worst change {worst:.1e} points: {}", if worst <= SAME { "the same" } else { "not the same" });
    Ok(())
}

/// The changes of ISO in each format.
fn from_format(subject: &Subject, from: &str, folder: &Path) -> Result<Vec<f64>, Box<dyn Error>> {
    // files hold an index, not a material
    let start = subject.stone()?;
    let material = Material::from_index(start.material().index_d());
    let file = folder.join(format!("{}.{from}", subject.stone));
    std::fs::write(&file, formats::encode_as(start.convex_design()?, Some(&material), from)?.bytes)?;
    let stone = Stone::open(&file, &Default::default())?;
    // of a file neither tiers' names nor a family's parameters can be counted on: the two ratios
    let request = cutlab::OptimiseRequest::new(objectives(&["iso"])?).evaluations(CANDIDATES);
    let found = request.run(&stone, &())?;
    let design = found.finalists.first().ok_or("no finalist")?.edited.design.clone();
    let iso = |stone: &Stone| -> Result<f64, Box<dyn Error>> {
        Ok(ScoreRequest::new(["iso"]).exact(true).run(stone)?["iso"].value)
    };
    let before = iso(&Stone::from_design(design.clone())?.with_material(stone.material().clone()))?;
    let mut changes = Vec::new();
    for to in FORMATS {
        let target = TargetFormat::by_name(to)?;
        let made = edited_file::encode((file.as_os_str(), &stone), &design, None, target, Limits::default())?;
        let again = Stone::from_bytes(&format!("again.{to}"), &made.bytes, None)?;
        changes.push(iso(&again)? - before);
    }
    let written: Vec<String> = changes.iter().map(|change| format!("{change:.1e}")).collect();
    println!("| {} | {from} | {before:.6} | {} |", subject.stone, written.join(" | "));
    Ok(changes)
}
