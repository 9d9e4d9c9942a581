//! A metric of your own, on sums that an estimator of cutlab has: one row.
//!
//! `cargo run --release --example your_own_metric`. `tests/library/extending.rs` has one on a sum of its own, and an
//! estimator.

use cutlab::advanced::estimators::hemisphere::{GLARE, HemisphereKind, RETURNED};
use cutlab::advanced::metrics::{MetricSource, Statistic};
use cutlab::prelude::*;

static GLARE_PER_RETURN: Metric = Metric {
    name: "glare_per_return",
    about: "light that the crown's surface mirrors, per light returned from inside",
    range: (0.0, 1e3),
    ..Metric::of(&HemisphereKind, MetricSource::Sums(Statistic::Smooth(|t| t[GLARE] / t[RETURNED])))
};

pub fn main() -> Result<(), Error> {
    let request = ScoreRequest::new(["light_return"]).metric(&GLARE_PER_RETURN).samples(1 << 12);
    for cut in ["tolkowsky", "emerald", "princess"] {
        let scores = request.run(&Stone::parse(cut)?)?;
        println!("{cut:<12} {}", scores["glare_per_return"]);
        assert!(scores["glare_per_return"].value > 0.0);
    }
    Ok(())
}
