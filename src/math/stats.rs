//! Means with their errors, from independent batches.

use serde::Serialize;

/// A value and its standard error, in the same unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// One standard error of the value; 0 for a closed form.
    pub error: f64,
}

impl Estimate {
    /// A value without error (a closed form).
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }
}

/// Estimates a ratio of sums from independent batches.
///
/// - `batches`: one (numerator, denominator) a batch; for a plain mean the denominator is the
///   batch's sample count
///
/// The value is Σnumerator / Σdenominator; the error is that of the ratio estimator,
/// √(Σ(nᵢ − r dᵢ)² · k/(k−1)) / Σdᵢ. A zero denominator gives value 0 and error 0 (nothing seen).
/// Source: W. G. Cochran, *Sampling Techniques*, §2.11.
pub fn ratio(batches: impl Iterator<Item = (f64, f64)> + Clone) -> Estimate {
    let (mut top, mut bottom, mut k) = (0.0, 0.0, 0usize);
    for (n, d) in batches.clone() {
        top += n;
        bottom += d;
        k += 1;
    }
    if bottom == 0.0 {
        return Estimate::exact(0.0);
    }
    let value = top / bottom;
    if k < 2 {
        return Estimate { value, error: f64::INFINITY };
    }
    let spread: f64 = batches.map(|(n, d)| (n - value * d).powi(2)).sum();
    let error = (spread * k as f64 / (k - 1) as f64).sqrt() / bottom.abs();
    Estimate { value, error }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Purpose, Stream};

    #[test]
    fn equal_batches_give_the_textbook_error_of_a_mean() {
        let batches = [1.0, 2.0, 3.0, 4.0].map(|x| (x * 10.0, 10.0));
        let e = ratio(batches.iter().copied());
        assert_eq!(e.value, 2.5);
        let sd = (5.0f64 / 3.0).sqrt();
        assert!((e.error - sd / 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_interval_covers_the_truth_as_often_as_it_says() {
        let (runs, mut inside) = (2000, 0);
        for run in 0..runs {
            let batches: Vec<_> = (0..32)
                .map(|b| {
                    let mut s = Stream::new(9, Purpose::Test, run * 32 + b);
                    ((0..64).map(|_| s.unit64()).sum::<f64>(), 64.0)
                })
                .collect();
            let e = ratio(batches.iter().copied());
            inside += i32::from((e.value - 0.5).abs() < 1.96 * e.error);
        }
        let share = f64::from(inside) / runs as f64;
        assert!((0.93..0.97).contains(&share), "{share}");
    }
}
