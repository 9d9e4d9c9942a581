//! Remaining time of a progressive picture.

use std::time::Duration;

/// Noise after each round, from which that of the rounds to come is estimated.
#[derive(Debug, Default)]
pub struct Outlook {
    /// Number of rounds and noise after them.
    noise: Vec<(f64, f64)>,
}

impl Outlook {
    /// Notes the noise after so many rounds.
    pub fn note(&mut self, rounds: u32, noise: f64) {
        if noise.is_finite() && noise > 0.0 {
            self.noise.push((f64::from(rounds), noise));
        }
    }

    /// About how many rounds it takes from the first to noise `target`: noise falls as a power of the
    /// rounds, the one by which it fell over their later half. None as long as that is not known.
    pub fn rounds_to(&self, target: f64) -> Option<f64> {
        /// What noise falls by: as 1/√n where rounds are alike, as 1/∛n where estimates shrink.
        const POWERS: (f64, f64) = (0.2, 0.6);
        let (n, noise) = *self.noise.last()?;
        let (before, noise_before) = *self.noise.iter().find(|(m, _)| *m >= n / 2.0)?;
        if n < 4.0 || before >= n {
            return None;
        }
        let power = ((noise_before / noise).ln() / (n / before).ln()).clamp(POWERS.0, POWERS.1);
        Some(n * (noise / target).max(1.0).powf(1.0 / power))
    }
}

/// Time that is left to so many rounds.
///
/// - `taken`: by the `rounds` so far
pub fn time_to(all: f64, rounds: u32, taken: Duration) -> Option<Duration> {
    let rounds = f64::from(rounds);
    let left = taken.as_secs_f64() * (all - rounds).max(0.0) / rounds;
    Duration::try_from_secs_f64(left).ok()
}

/// A time in its largest unit: `40 seconds`, `3 minutes`, `2 hours`.
pub fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let (n, unit) = match seconds {
        s if s < 90.0 => (s, "second"),
        s if s < 90.0 * 60.0 => (s / 60.0, "minute"),
        s => (s / 3600.0, "hour"),
    };
    let n = n.round();
    format!("{n} {unit}{}", if n == 1.0 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_that_falls_as_a_power_is_foreseen() {
        for power in [0.5, 1.0 / 3.0] {
            let mut outlook = Outlook::default();
            (1..=100).for_each(|n| outlook.note(n, f64::from(n).powf(-power)));
            let target = 1000f64.powf(-power);
            let rounds = outlook.rounds_to(target).expect("is known");
            assert!((rounds / 1000.0 - 1.0).abs() < 1e-6, "{power}: {rounds}");
        }
        let left = time_to(1000.0, 100, Duration::from_secs(10)).expect("is a time");
        assert!((left.as_secs_f64() - 90.0).abs() < 1e-6);
    }

    #[test]
    fn times_are_said_in_their_largest_unit() {
        let said = |s: f64| in_words(Duration::from_secs_f64(s));
        assert_eq!([said(1.2), said(89.0), said(150.0)], ["1 second", "89 seconds", "3 minutes"]);
        assert_eq!(said(7300.0), "2 hours");
    }

    #[test]
    fn what_is_not_known_is_not_said() {
        let mut outlook = Outlook::default();
        outlook.note(1, f64::INFINITY);
        assert_eq!(outlook.rounds_to(0.02), None);
        (2..4).for_each(|n| outlook.note(n, 0.1));
        assert_eq!(outlook.rounds_to(0.02), None);
        outlook.note(4, 0.01);
        assert_eq!(outlook.rounds_to(0.02), Some(4.0), "it is reached");
        assert_eq!(time_to(f64::INFINITY, 3, Duration::from_secs(1)), None);
    }
}
