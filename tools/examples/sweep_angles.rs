//! Sweeps the pavilion angle of a brilliant, and names the best.
//!
//! `cargo run --release --example sweep_angles`

use cutlab::prelude::*;

pub fn main() -> Result<(), Error> {
    // the same seed for all: what differs is the stone, not the luck of the rays
    let request = ScoreRequest::new(["wlr"]).samples(1 << 13).seed(7);
    let mut best = (0.0, 0.0);
    for tenths in (395..=425).step_by(5) {
        let angle = f64::from(tenths) / 10.0;
        let stone = Stone::parse(format!("round-brilliant:pavilion-angle={angle}"))?;
        let light = request.run(&stone)?["wlr"];
        println!("{angle:.1}°  {light}");
        best = if light.value > best.0 { (light.value, angle) } else { best };
    }
    println!("best: {:.1}°", best.1);
    assert!((40.0..=42.0).contains(&best.1));
    Ok(())
}
