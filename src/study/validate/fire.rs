//! Fire: lit area and streaks, and the separation of colours that misleads alone.

use super::lab::material;
use super::stones::{STONES, named};
use super::{Expected, Figure, Found, TRACER, Trial, TrialError};
use crate::math::stats::Estimate;

const SUBJECT: &str = "fire";

/// What the tracer's figures are good for, of themselves.
const SHARE: f64 = 0.035;

/// Lit, streak; threshold 10⁻³.
const OF_THE_SIX: [[f64; 2]; 6] =
    [[1.59, 1.25], [1.60, 1.27], [1.47, 1.20], [1.30, 0.92], [1.58, 0.83], [1.21, 0.89]];

/// The trials of this subject.
pub fn trials() -> Vec<Trial> {
    let mut trials: Vec<Trial> = STONES.iter().zip(OF_THE_SIX).map(|(s, x)| of_a_stone(s.0, x)).collect();
    trials.push(separation());
    trials
}

fn of_a_stone(name: &'static str, expected: [f64; 2]) -> Trial {
    let metrics = ["fire_lit", "fire_streak"];
    let figure = |(m, x)| Figure::near(format!("{m} of {name}"), TRACER, x, SHARE * x);
    Trial::new(SUBJECT, metrics.into_iter().zip(expected).map(figure).collect(), move |lab| {
        Ok(Found::of(lab.scores(&named(name)?, material("diamond")?, &metrics, 1 << 18)?))
    })
}

fn separation() -> Trial {
    let figures = vec![
        // by power over crown exits, ± .0008
        Figure::near("dispersion_mean of nailhead", TRACER, 1.5826, 0.0016).unit("°"),
        Figure::new("dispersion_mean of nailhead less the best other", TRACER, Expected::Above(0.0))
            .unit("°"),
    ];
    Trial::new(SUBJECT, figures, |lab| {
        let mean = |(name, _): &(&str, _)| {
            let found = lab.scores(&named(name)?, material("diamond")?, &["dispersion_mean"], 1 << 17)?;
            found.into_iter().next().ok_or_else(|| TrialError::Unknown("dispersion_mean".into()))
        };
        let means: Vec<Estimate> = STONES.iter().map(mean).collect::<Result<_, _>>()?;
        let (nailhead, others) = means.split_last().ok_or_else(|| TrialError::Unknown("stones".into()))?;
        let best = others.iter().copied().max_by(|a, b| a.value.total_cmp(&b.value));
        let less = best.map_or(Estimate::exact(f64::NAN), |b| Estimate {
            value: nailhead.value - b.value,
            error: nailhead.error.hypot(b.error),
        });
        Ok(Found::of(vec![*nailhead, less]))
    })
}
