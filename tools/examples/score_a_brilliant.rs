//! Scores a brilliant: light return and fire, each with its error.
//!
//! `cargo run --release --example score_a_brilliant`

use cutlab::prelude::*;

pub fn main() -> Result<(), Error> {
    let stone = Stone::parse("round-brilliant:crown-angle=35")?.with_material(Material::named("diamond")?);
    let scores = ScoreRequest::new(["wlr", "fire_streak", "iso"]).error(2e-3).run(&stone)?;
    println!("{} of {}, {} facets", stone.name(), stone.material().name, stone.facets());
    for (name, score) in scores.iter() {
        match score {
            Some(score) => println!("  {name:<12} {score}"),
            None => println!("  {name:<12} left out: {}", scores.why_left_out(name).unwrap_or_default()),
        }
    }
    assert!((scores["wlr"].value - 0.284).abs() < 0.01);
    Ok(())
}
