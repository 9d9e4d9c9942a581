//! Takes a small picture of a stone on a table, and keeps what it was asked for as JSON.
//!
//! `cargo run --release --example take_a_picture -- picture.png`

use cutlab::prelude::*;
use std::path::PathBuf;

pub fn main() -> Result<(), Error> {
    let file = std::env::args_os().nth(1).filter(|name| PathBuf::from(name).extension().is_some());
    let file = file.map_or_else(|| std::env::temp_dir().join("cutlab-picture.png"), PathBuf::from);
    let stone = Stone::parse("round-brilliant")?;
    let request = RenderRequest::scene("table")?.size(96, 72).samples_per_pixel(4).photons(5_000);
    let picture = request.stone(&stone).run()?;
    picture.save(&file)?;
    println!("{}", file.display());
    assert!(picture.film.linear(None).iter().any(|colour| colour.max_element() > 0.1), "it is dark");
    Ok(())
}
