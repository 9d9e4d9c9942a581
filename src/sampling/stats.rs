//! Estimates with standard errors, from independent batches.

use serde::Serialize;
use std::fmt;

/// A value and its standard error, in the same unit.
///
/// ```
/// use cutlab::Estimate;
///
/// assert_eq!(Estimate { value: 0.28376, error: 0.00103 }.to_string(), "0.2838 ± 0.0010");
/// assert_eq!(Estimate { value: 0.5764512, error: 6.9e-6 }.to_string(), "0.5764512 ± 0.0000069");
/// assert_eq!(Estimate { value: 3.1e-5, error: 2e-7 }.to_string(), "3.10e-5 ± 2e-7");
/// assert_eq!(Estimate::exact(0.5).to_string(), "0.5000");
/// ```
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

    /// As text: the value to two digits of its error, and the error if there is one. Small numbers are in powers of
    /// ten; a value that rounds to zero has no sign.
    pub fn text(self) -> (String, Option<String>) {
        let unsigned = |text: String| {
            let nothing = text.parse::<f64>() == Ok(0.0);
            if nothing { text.trim_start_matches('-').to_owned() } else { text }
        };
        if self.error <= 0.0 || !self.error.is_finite() {
            return (unsigned(format!("{:.4}", self.value)), None);
        }
        let digits = (1.0 - self.error.log10().floor()).max(0.0) as usize;
        if digits > MOST_DECIMALS && self.value.abs() < SMALL {
            return (unsigned(format!("{:.2e}", self.value)), Some(format!("{:.0e}", self.error)));
        }
        (unsigned(format!("{:.digits$}", self.value)), Some(format!("{:.digits$}", self.error)))
    }
}

/// More decimals than these are not written of a small number: it is in powers of ten.
const MOST_DECIMALS: usize = 6;

/// Numbers below this are small.
const SMALL: f64 = 1e-3;

/// `0.2838 ± 0.0010`; a value without error alone.
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.text() {
            (value, Some(error)) => write!(f, "{value} ± {error}"),
            (value, None) => f.write_str(&value),
        }
    }
}

/// Of a normal law, 95 in 100 lie within so many standard errors.
pub const NORMAL_95: f64 = 1.959_964;

/// Estimates a ratio of sums from independent batches.
///
/// - `batches`: one (numerator, denominator) a batch; for a plain mean the denominator is the
///   batch's sample count
///
/// The value is Σnumerator / Σdenominator; the error is that of the ratio estimator,
/// √(Σ(nᵢ − r dᵢ)² · k/(k−1)) / Σdᵢ, times Student's t over 1.96. A zero denominator gives value 0 and error 0 (nothing seen).
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
    let error = (spread * k as f64 / (k - 1) as f64).sqrt() / bottom.abs() * student(k);
    Estimate { value, error }
}

/// What batches add up.
pub trait Accumulate: Default + Clone {
    /// Adds another batch's.
    fn accumulate(&mut self, other: &Self);
}

impl Accumulate for f64 {
    fn accumulate(&mut self, other: &f64) {
        *self += other;
    }
}

impl<T: Accumulate, const N: usize> Accumulate for [T; N]
where
    [T; N]: Default,
{
    fn accumulate(&mut self, other: &Self) {
        self.iter_mut().zip(other).for_each(|(a, b)| a.accumulate(b));
    }
}

/// The sums of all batches.
pub fn all<T: Accumulate>(batches: &[T]) -> T {
    batches.iter().fold(T::default(), |mut sum, batch| {
        sum.accumulate(batch);
        sum
    })
}

/// An estimate whose error also holds what was given up: the most by which that may change the value
/// counts as one more standard error, independent of the noise.
///
/// - `sums`: of all batches; `bounds`: what they would be had all the light that was given up gone one way,
///   for each way that it may have gone; `of`: what was estimated of them
pub fn with_given_up<T>(found: Estimate, sums: &T, bounds: &[T], of: impl Fn(&T) -> f64) -> Estimate {
    let value = of(sums);
    let change = |other: &T| (of(other) - value).abs();
    let given_up = bounds.iter().map(change).filter(|x| x.is_finite()).fold(0.0, f64::max);
    Estimate { error: found.error.hypot(given_up), ..found }
}

/// Estimates a smooth function of sums over independent batches by the jackknife.
///
/// - `of`: a ratio of sums, or anything else that changes in proportion when they change a little
///
/// The value is that of all batches together, the error √((k−1)/k Σ(θᵢ − θ̄)²) over the values θᵢ
/// without batch i, times Student's t over 1.96; batches that all give one value give it exactly.
/// Source: R. G. Miller, *Biometrika* 61 (1974) 1.
/// Checked in this file's tests, and for every metric in `tests/library/coverage.rs`.
pub fn jackknife<T: Accumulate>(batches: &[T], of: impl Fn(&T) -> f64) -> Estimate {
    let k = batches.len();
    // sums of all batches from each on, the last one empty
    let mut after = vec![T::default(); k + 1];
    for (i, batch) in batches.iter().enumerate().rev() {
        after[i] = after[i + 1].clone();
        after[i].accumulate(batch);
    }
    let value = of(&after[0]);
    let mut each = batches.iter().map(&of);
    if let Some(first) = each.next()
        && k > 1
        && each.all(|other| other == first)
    {
        return Estimate::exact(first);
    }
    if k < 2 {
        return Estimate { value, error: f64::INFINITY };
    }
    let mut before = T::default();
    let mut others = Vec::with_capacity(k);
    for (i, batch) in batches.iter().enumerate() {
        let mut other = before.clone();
        other.accumulate(&after[i + 1]);
        others.push(of(&other));
        before.accumulate(batch);
    }
    let mean = others.iter().sum::<f64>() / k as f64;
    let spread: f64 = others.iter().map(|o| (o - mean).powi(2)).sum();
    Estimate { value, error: (spread * (k - 1) as f64 / k as f64).sqrt() * student(k) }
}

/// By how much wider ±1.96 standard errors must be that come from `k` batches, to hold the truth 95
/// times in 100: Student's t over the normal's 1.96, by Cornish and Fisher's expansion.
pub(super) fn student(k: usize) -> f64 {
    let (z, nu) = (NORMAL_95, (k - 1) as f64);
    let z2 = z * z;
    let second = (5.0 * z2 + 16.0) * z2 + 3.0;
    let third = ((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0;
    1.0 + (z2 + 1.0) / (4.0 * nu) + second / (96.0 * nu.powi(2)) + third / (384.0 * nu.powi(3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};

    #[test]
    fn equal_batches_give_the_textbook_error_of_a_mean() {
        let batches = [1.0, 2.0, 3.0, 4.0].map(|x| (x * 10.0, 10.0));
        let e = ratio(batches.iter().copied());
        assert_eq!(e.value, 2.5);
        let sd = (5.0f64 / 3.0).sqrt();
        assert!((e.error - sd / 2.0 * student(4)).abs() < 1e-12);
    }

    #[test]
    fn the_jackknife_of_a_ratio_is_the_ratio_and_of_a_mean_its_textbook_error() {
        let batches = [1.0, 2.0, 3.0, 4.0].map(|x| [x * 10.0, 10.0]);
        let e = jackknife(&batches, |s| s[0] / s[1]);
        let r = ratio(batches.iter().map(|b| (b[0], b[1])));
        assert!((e.value - r.value).abs() < 1e-15 && (e.error - r.error).abs() < 1e-12, "{e:?} {r:?}");
    }

    /// Student's two-sided 5 % points for 7, 31 and 63 degrees of freedom: 2.3646, 2.0395, 1.9983.
    #[test]
    fn few_batches_widen_the_interval_as_student_says() {
        for (k, t) in [(8, 2.3646), (32, 2.0395), (64, 1.9983)] {
            assert!((student(k) * 1.959_964 - t).abs() < 1e-3, "{k}: {}", student(k) * 1.959_964);
        }
    }

    #[test]
    fn the_interval_covers_the_truth_as_often_as_it_says() {
        let (runs, mut inside) = (2000, 0);
        for run in 0..runs {
            let batches: Vec<_> = (0..32)
                .map(|b| {
                    let mut s = Stream::new(9, Purpose::TEST, run * 32 + b);
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
