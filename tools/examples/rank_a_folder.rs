//! Ranks the designs and meshes of a folder by how bright they are to a faceter's eye.
//!
//! `cargo run --release --example rank_a_folder -- designs/`

use cutlab::prelude::*;
use std::path::PathBuf;

pub fn main() -> Result<(), Error> {
    let own = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/good");
    let folder = std::env::args_os().nth(1).map(PathBuf::from).filter(|path| path.is_dir());
    let folder = folder.unwrap_or_else(|| PathBuf::from(own));
    let request = ScoreRequest::new(["iso"]).samples(1 << 12);
    let mut ranked: Vec<(f64, String)> = Vec::new();
    // what `cutlab score` takes of a folder
    for spec in expand_stones([&folder], Limits::default())? {
        // what has no such score is not ranked
        let Ok(stone) = Stone::open(spec, &StoneOptions::default()) else { continue };
        let Ok(scores) = request.run(&stone) else { continue };
        ranked.extend(scores.get("iso").map(|iso| (iso.value, format!("{iso}  {}", stone.name()))));
    }
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    ranked.iter().for_each(|(_, line)| println!("{line}"));
    assert!(!ranked.is_empty(), "no stones in {}", folder.display());
    Ok(())
}
