//! Statistics of independent batches: what a score is of their sums, and with it how its error is
//! found.

use super::histogram::CumulativeHistogram;
use super::stats::{self, Estimate, NORMAL_95};
use super::tally::{Column, Tally};

/// A score as a function of the sums of batches. Its kind decides how the error is found.
#[derive(Debug, Clone, Copy)]
pub enum Statistic {
    /// A smooth function of the sums, by the jackknife ([`stats::jackknife`]). Batches that agree to
    /// the last bit give it exactly.
    Smooth(fn(&Tally) -> f64),
    /// A mean over samples, in units of the number, the greatest that one sample can add: the columns of
    /// the sum and of the number of samples. By the jackknife; but where nothing was seen, that is not
    /// certain ([`nothing_seen`]).
    Mean(Column, Column, f64),
    /// The share of samples that are of a kind: the columns of their number, and that of all. By Wilson's
    /// interval (`share` in this file).
    Share(Column, Column),
    /// The median of the quantity that the tally's histogram has, whose classes are so wide: by a
    /// confidence interval (`error_of_median` in this file).
    Median(f64),
}

/// Not a number as 0: a batch that has seen nothing.
fn number(x: f64) -> f64 {
    if x.is_finite() { x } else { 0.0 }
}

impl Statistic {
    /// The score of sums; not finite if nothing was seen that it could be a score of.
    pub fn value(&self, sums: &Tally) -> f64 {
        match *self {
            Statistic::Smooth(of) => of(sums),
            Statistic::Mean(sum, n, most) => most * sums[sum] / sums[n],
            Statistic::Share(seen, n) => sums[seen] / sums[n],
            Statistic::Median(width) => sums.histogram.cumulative().median().map_or(f64::NAN, |m| m * width),
        }
    }

    /// The score with its error, of batches of random samples; none if nothing was seen that it could
    /// be a score of. The error holds what was given up ([`stats::with_given_up`]).
    ///
    /// - `bounds`: what sums would be had all the light that was given up gone one way, for each way
    pub fn sampled(&self, batches: &[Tally], bounds: impl Fn(&Tally) -> Vec<Tally>) -> Option<Estimate> {
        let all = stats::all(batches);
        let value = Some(self.value(&all)).filter(|v| v.is_finite())?;
        let found = match *self {
            Statistic::Smooth(_) => self.jackknifed(batches),
            Statistic::Mean(sum, n, most) if all[sum] == 0.0 => {
                Estimate { value, error: most * nothing_seen(all[n]) }
            }
            Statistic::Mean(..) => self.jackknifed(batches),
            Statistic::Share(_, n) => share(self.jackknifed(batches), all[n]),
            Statistic::Median(width) => {
                let cumulated: Vec<CumulativeHistogram> =
                    batches.iter().map(|b| b.histogram.cumulative()).collect();
                let classes = all.histogram.cumulative().classes();
                Estimate { value, error: error_of_median(value / width, &cumulated, classes) * width }
            }
        };
        Some(stats::with_given_up(found, &all, &bounds(&all), |sums| self.value(sums)))
    }

    /// The same of batches that share what is known without samples (areas of beams) and differ in the
    /// rest alone: what all agree on is exact. Nothing but a median is known by samples alone.
    pub fn computed(&self, batches: &[Tally], bounds: impl Fn(&Tally) -> Vec<Tally>) -> Option<Estimate> {
        let all = stats::all(batches);
        let value = Some(self.value(&all)).filter(|v| v.is_finite())?;
        let found = match (self, batches) {
            (Statistic::Median(_), _) => return self.sampled(batches, bounds),
            (_, [_]) => Estimate::exact(value),
            _ => self.jackknifed(batches),
        };
        Some(stats::with_given_up(found, &all, &bounds(&all), |sums| self.value(sums)))
    }

    fn jackknifed(&self, batches: &[Tally]) -> Estimate {
        stats::jackknife(batches, |sums| number(self.value(sums)))
    }
}

/// The standard error of a share of which none (or all) of `n` samples is: ±1.96 of it reach to the
/// end of Wilson's 95 % interval, z²/(n + z²); it holds the "rule of three", 3/n.
pub fn nothing_seen(n: f64) -> f64 {
    NORMAL_95 / (n + NORMAL_95 * NORMAL_95)
}

/// The share of samples of a kind with an error that does not vanish when few are seen.
///
/// - `found`: the share with the error that the spread of batches gives it; `n`: number of samples
///
/// Evenly spread samples count for more than independent ones: for p(1 − p)/error². Wilson's 95 %
/// interval for so many reaches further to one side than to the other, and ±1.96 errors reach as far as
/// that; they are never less than [`nothing_seen`]. Source: E. B. Wilson, *J. Am. Stat. Assoc.* 22
/// (1927) 209; A. Agresti and B. A. Coull, *Am. Stat.* 52 (1998) 119.
fn share(found: Estimate, n: f64) -> Estimate {
    let (p, z) = (found.value, NORMAL_95);
    let least = nothing_seen(n);
    let of_one = p * (1.0 - p);
    if of_one <= 0.0 || found.error == 0.0 {
        return Estimate { value: p, error: least };
    }
    let effective = of_one / found.error.powi(2);
    let middle = (p + 0.5 * z * z / effective) / (1.0 + z * z / effective);
    let half = z * (of_one / effective + 0.25 * (z / effective).powi(2)).sqrt() / (1.0 + z * z / effective);
    Estimate { value: p, error: (((middle - p).abs() + half) / z).max(least) }
}

/// An error for the median of all batches' weights, in classes, from its confidence interval.
///
/// - `value`: the median; `classes`: how many all batches have
///
/// A jackknife of a median does not estimate its error, least of all between two peaks with little
/// between them (R. G. Miller 1974). Here values are tried one by one: each could be the median if the
/// weight below it differs from a half by no more than chance allows, which is a mean over batches with
/// a known error. The values that could be are a 95 % interval, whatever the histogram (R. S. Woodruff,
/// *J. Am. Stat. Assoc.* 47 (1952) 635); its longer side is 1.96 of the errors given. Where the half
/// falls between two peaks it reaches from one to the other until the samples can tell. Checked in
/// `tests/library/coverage.rs`.
fn error_of_median(value: f64, batches: &[CumulativeHistogram], classes: usize) -> f64 {
    let k = batches.len() as f64;
    if k < 2.0 {
        return f64::INFINITY;
    }
    let t = NORMAL_95 * stats::student(batches.len());
    let could_be = |x: f64| {
        let excess = |batch: &CumulativeHistogram| batch.below(x) - 0.5 * batch.total();
        let mean = batches.iter().map(excess).sum::<f64>() / k;
        let spread: f64 = batches.iter().map(|b| (excess(b) - mean).powi(2)).sum();
        mean.powi(2) <= t * t * spread / (k * (k - 1.0))
    };
    // the end of the interval between a value that could not be and one that could
    let end = |mut out: f64, mut inside: f64| {
        for _ in 0..40 {
            let middle = 0.5 * (out + inside);
            *(if could_be(middle) { &mut inside } else { &mut out }) = middle;
        }
        inside
    };
    let (floor, ceil) = (value.floor(), value.ceil());
    let least = match (0..=floor as usize).map(|x| x as f64).find(|x| could_be(*x)) {
        Some(x) => end((x - 1.0).max(0.0), x),
        None => end(floor, value),
    };
    let most = match (ceil as usize..=classes).rev().map(|x| x as f64).find(|x| could_be(*x)) {
        Some(x) => end((x + 1.0).min(classes as f64), x),
        None => end(ceil, value),
    };
    (most - value).max(value - least) / NORMAL_95
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};
    use crate::sampling::tally::columns;

    columns! {
        /// Samples of a kind.
        SEEN,
        /// All samples.
        SAMPLES,
    }

    const SHARE: Statistic = Statistic::Share(SEEN, SAMPLES);

    fn no_bounds(_: &Tally) -> Vec<Tally> {
        Vec::new()
    }

    fn seen([seen, samples]: [f64; 2]) -> Tally {
        Tally::of(&[(SEEN, seen), (SAMPLES, samples)])
    }

    /// Batches of 64 independent values each.
    fn batches(run: u64, value: impl Fn(f64) -> f64) -> Vec<Tally> {
        let batch = |b: u64| {
            let mut stream = Stream::new(11, Purpose::TEST, run * 32 + b);
            let mut tally = Tally::default();
            (0..64).for_each(|_| tally.histogram.insert(value(stream.unit64()), 1.0));
            tally
        };
        (0..32).map(batch).collect()
    }

    /// Two peaks far apart, the lower with a little less than half, a little more, or a half of the
    /// values; one broad hill; all at one place.
    #[test]
    fn a_median_lies_within_two_errors_whatever_the_histogram() {
        let median = Statistic::Median(0.5);
        let peaks = |share: f64| move |u: f64| if u < share { 10.0 + u } else { 60.0 + u };
        type Case = (Box<dyn Fn(f64) -> f64>, std::ops::RangeInclusive<f64>);
        let cases: [Case; 5] = [
            (Box::new(peaks(0.49)), 30.0..=30.02),
            (Box::new(peaks(0.51)), 5.49..=5.5),
            (Box::new(peaks(0.5)), 5.5..=30.0),
            (Box::new(|u| 100.0 * u), 25.0..=25.0),
            (Box::new(|_| 7.5), 3.75..=3.75),
        ];
        for (case, (value, truth)) in cases.iter().enumerate() {
            let runs = 400;
            let held = (0..runs).filter(|run| {
                let e =
                    median.sampled(&batches(1000 * case as u64 + run, value), no_bounds).expect("has weight");
                let off = (truth.start() - e.value).max(e.value - truth.end());
                off <= 1.96 * e.error
            });
            let held = held.count();
            // 95 % of 400, less 2.5 of its own errors
            assert!(held >= 369, "case {case}: {held} of {runs}");
        }
    }

    #[test]
    fn nothing_seen_is_not_certain_and_few_seen_are_hardly_more() {
        let tallies = |batches: &[[f64; 2]]| batches.iter().copied().map(seen).collect::<Vec<_>>();
        let of = |batches: &[[f64; 2]]| SHARE.sampled(&tallies(batches), no_bounds).expect("has samples");
        // the rule of three: 0 of 3,200 may be 3 in 3,200
        let none = of(&[[0.0, 100.0]; 32]);
        assert!(
            none.value == 0.0 && 1.96 * none.error > 3.0 / 3200.0 && none.error < 2.0 / 3200.0,
            "{none:?}"
        );
        let every = of(&[[100.0, 100.0]; 32]);
        assert_eq!((every.value, every.error), (1.0, none.error));
        let mut one = [[0.0, 100.0]; 32];
        one[5][0] = 1.0;
        // of one seen, Poisson's 95 % interval reaches to 5.57
        let one = of(&one);
        assert!((5.0..6.0).contains(&(3200.0 * (one.value + 1.96 * one.error))), "{one:?}");
        // of many, the spread of the batches decides
        let many: Vec<[f64; 2]> = (0..32).map(|i| [4990.0 + f64::from(i % 3) * 10.0, 10_000.0]).collect();
        let jackknife = SHARE.computed(&tallies(&many), no_bounds).expect("has samples");
        let many = of(&many);
        assert!((many.error / jackknife.error - 1.0).abs() < 1e-3, "{many:?} {jackknife:?}");
        assert_eq!(SHARE.sampled(&tallies(&[[0.0; 2]; 32]), no_bounds), None);
    }

    #[test]
    fn shares_of_every_size_lie_within_two_errors() {
        for (case, truth) in [0.0003, 0.001, 0.003, 0.02, 0.3, 0.999].into_iter().enumerate() {
            let runs = 2000;
            let held = (0..runs).filter(|run| {
                let mut stream = Stream::new(12, Purpose::TEST, 10_000 * case as u64 + run);
                let batch = |_| seen([(0..64).filter(|_| stream.unit64() < truth).count() as f64, 64.0]);
                let batches: Vec<Tally> = (0..32).map(batch).collect();
                let e = SHARE.sampled(&batches, no_bounds).expect("has samples");
                (e.value - truth).abs() <= 1.96 * e.error
            });
            let held = held.count() as f64 / runs as f64;
            assert!(held >= 0.938, "{truth}: {held}");
        }
    }
}
