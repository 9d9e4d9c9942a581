//! Fire: lit area and streaks, and the separation of colours that misleads alone.

use super::context::material;
use super::figures;
use super::stones::{STONES, brilliant_by_name};
use super::{Check, CheckError, Expected, Figure, Measured, TRACER};
use crate::sampling::stats::Estimate;

const SUBJECT: &str = "fire";

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks: Vec<Check> = figures::subjects("fire").into_iter().map(of_a_stone).collect();
    checks.push(separation());
    checks
}

fn of_a_stone(name: &'static str) -> Check {
    let rows = figures::set_of("fire", name);
    let metrics: Vec<&str> = rows.iter().map(|f| f.quantity.as_str()).collect();
    let figures = rows.iter().map(|f| f.named(format!("{} of {name}", f.quantity))).collect();
    Check::new(SUBJECT, figures, move |lab| {
        Ok(Measured::new(lab.scores(&brilliant_by_name(name)?, material("diamond")?, &metrics, 1 << 18)?))
    })
}

fn separation() -> Check {
    // by power over crown exits, ± .0008
    let mut figures: Vec<Figure> =
        figures::set("separation").into_iter().map(|f| f.named("dispersion_mean of nailhead")).collect();
    let best = "dispersion_mean of nailhead less the best other";
    figures.push(Figure::new(best, TRACER, Expected::Above(0.0)).unit("°"));
    Check::new(SUBJECT, figures, |lab| {
        let mean = |(name, _): &(&str, _)| {
            let found =
                lab.scores(&brilliant_by_name(name)?, material("diamond")?, &["dispersion_mean"], 1 << 17)?;
            found.into_iter().next().ok_or_else(|| CheckError::Unknown("dispersion_mean".into()))
        };
        let means: Vec<Estimate> = STONES.iter().map(mean).collect::<Result<_, _>>()?;
        let (nailhead, others) = means.split_last().ok_or_else(|| CheckError::Unknown("stones".into()))?;
        let best = others.iter().copied().max_by(|a, b| a.value.total_cmp(&b.value));
        let less = best.map_or(Estimate::exact(f64::NAN), |b| Estimate {
            value: nailhead.value - b.value,
            error: nailhead.error.hypot(b.error),
        });
        Ok(Measured::new(vec![*nailhead, less]))
    })
}
