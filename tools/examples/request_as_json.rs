//! A request as data: written as JSON, read again, changed and run. What is left out has its default.
//!
//! `cargo run --release --example request_as_json`

use cutlab::prelude::*;

pub fn main() -> Result<(), Error> {
    let request = ScoreRequest::new(["wlr", "leakage"]).samples(1 << 11).observer(16.0);
    let json = serde_json::to_string_pretty(&request).expect("a request is data");
    println!("{json}");
    let again: ScoreRequest = serde_json::from_str(&json).expect("it is its own format");
    let few: ScoreRequest = serde_json::from_str(r#"{ "metrics": ["wlr"] }"#).expect("the rest is left out");
    let stone = Stone::parse("emerald")?;
    assert_eq!(request.run(&stone)?["wlr"], again.run(&stone)?["wlr"], "the same request, the same bits");
    println!("{}", few.samples(1 << 11).run(&stone)?["wlr"]);
    Ok(())
}
