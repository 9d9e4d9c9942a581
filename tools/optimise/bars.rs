//! Bar 4 of optimising: Keller's SRB by its two tangent ratios, and WLR of the brilliant from four starts.
//!
//! `cargo run --release --example optimise_bars`

use cutlab::advanced::design::edit::EditRequest;
use cutlab::advanced::scoring::{Effort, Objective};
use cutlab::{Material, OptimiseRequest, ScoreRequest, Stone, Tilt, Variable};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let srb = Stone::parse(std::env::args().nth(1).unwrap_or("../shared/corpus/pairs/SRB.asc".into()))?;
    let tan = |degrees: f64| degrees.to_radians().tan();
    let keller = EditRequest::new([format!("pavilion.scale={}", tan(41.0) / tan(41.5))])?
        .run(srb.design().ok_or("convex")?)?;
    let keller = Stone::from_design(keller.design)?.with_material(Material::from_index(1.64));
    let iso = |stone: &Stone, tilt: f64| -> Result<f64, Box<dyn Error>> {
        let request = ScoreRequest::new(["iso"]).exact(true).observer(0.0);
        let tilt = (tilt != 0.0).then_some(Tilt { degrees: tilt, azimuth: 0.0 });
        Ok(request.run_tilted(stone, tilt)?["iso"].value)
    };
    println!("start: ISO {:.2} {:.2} {:.2}", iso(&keller, 0.0)?, iso(&keller, 10.0)?, iso(&keller, 20.0)?);
    for seed in 1..=4 {
        let begun = Instant::now();
        let objective = Objective::maximise("iso@0,10".parse()?).observer(0.0);
        let mut request = OptimiseRequest::new([objective]).evaluations(200).seed(seed);
        request.effort = Effort::default();
        let found = request.run(&keller, &())?;
        let best = &found.finalists[0];
        let stone = Stone::from_design(best.edited.design.clone())?.with_material(Material::from_index(1.64));
        println!(
            "seed {seed}: {} candidates in {:.2} s: ISO {:.2} {:.2}, {:?}, gain {} ({})",
            found.candidates.len(),
            begun.elapsed().as_secs_f64(),
            iso(&stone, 0.0)?,
            iso(&stone, 10.0)?,
            best.values,
            best.gains[0].gain,
            best.gains[0].said()
        );
    }
    for (crown, pavilion) in [(34.0, 40.5), (22.0, 38.5), (39.0, 42.5), (28.0, 42.0)] {
        let begun = Instant::now();
        let stone = Stone::parse(format!("round-brilliant:crown-angle={crown},pavilion-angle={pavilion}"))?;
        let vary: Vec<Variable> = ["crown-angle=20:40".parse()?, "pavilion-angle=38:43".parse()?].to_vec();
        let request = OptimiseRequest::new([Objective::maximise("wlr".parse()?)]).vary(vary).evaluations(150);
        let found = request.run(&stone, &())?;
        let best = &found.finalists[0];
        println!(
            "wlr from {crown} {pavilion}: {} candidates in {:.1} s: {} at {:?}, gain {} ({})",
            found.candidates.len(),
            begun.elapsed().as_secs_f64(),
            best.gains[0].value,
            best.values,
            best.gains[0].gain,
            best.gains[0].said()
        );
    }
    Ok(())
}
