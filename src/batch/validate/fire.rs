//! Fire: lit area and streaks, and the separation of colours that misleads alone.

use super::context::material;
use super::stones::{STONES, brilliant_by_name};
use super::{Check, CheckError, Expected, Figure, Measured, TRACER};
use crate::sampling::stats::Estimate;

const SUBJECT: &str = "fire";

/// What the tracer's figures are good for, of themselves.
const SHARE: f64 = 0.035;

/// Lit, streak; threshold 10⁻³.
const OF_THE_SIX: [[f64; 2]; 6] =
    [[1.59, 1.25], [1.60, 1.27], [1.47, 1.20], [1.30, 0.92], [1.58, 0.83], [1.21, 0.89]];

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks: Vec<Check> = STONES.iter().zip(OF_THE_SIX).map(|(s, x)| of_a_stone(s.0, x)).collect();
    checks.push(separation());
    checks
}

fn of_a_stone(name: &'static str, expected: [f64; 2]) -> Check {
    let metrics = ["fire_lit", "fire_streak"];
    let figure = |(m, x)| Figure::near(format!("{m} of {name}"), TRACER, x, SHARE * x);
    Check::new(SUBJECT, metrics.into_iter().zip(expected).map(figure).collect(), move |lab| {
        Ok(Measured::new(lab.scores(&brilliant_by_name(name)?, material("diamond")?, &metrics, 1 << 18)?))
    })
}

fn separation() -> Check {
    let figures = vec![
        // by power over crown exits, ± .0008
        Figure::near("dispersion_mean of nailhead", TRACER, 1.5826, 0.0016).unit("°"),
        Figure::new("dispersion_mean of nailhead less the best other", TRACER, Expected::Above(0.0))
            .unit("°"),
    ];
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
