//! Kronecker sequences: evenly spread points of the unit cube, shifted at random.

use crate::sampling::random::{Purpose, Stream};
use std::ops::Range;
use std::sync::LazyLock;

/// The points `shift + i·step` modulo 1: a Kronecker sequence, whose shift is a pure function of
/// seed, purpose and batch.
///
/// Any run of it covers the cube far more evenly than independent points do; the random shift
/// makes every batch an unbiased estimate, independent of the others, so that the spread of the
/// batches is an honest error (R. Cranley and T. Patterson, SIAM J. Numer. Anal. 13 (1976) 904).
/// The steps are powers of the root of xᴰ⁺¹ = x + 1 (M. Roberts's R sequence). Counted in 64-bit
/// fixed point, so that a point's position does not depend on where its run starts. Checked in
/// `tests/library/coverage.rs` by the coverage of the errors.
pub struct KroneckerPoints<const D: usize> {
    at: [u64; D],
    step: [u64; D],
    left: u64,
}

const TWO_64: f64 = 18_446_744_073_709_551_616.0;

/// Most dimensions of a point.
const MOST: usize = 16;

/// The steps by dimension: those of the D-dimensional sequence are the first D of row D.
static STEPS: LazyLock<[[u64; MOST]; MOST + 1]> = LazyLock::new(|| {
    std::array::from_fn(|dimensions| {
        let root = (0..64).fold(1.5f64, |x, _| (1.0 + x).powf(1.0 / (dimensions as f64 + 1.0)));
        std::array::from_fn(|k| (root.powi(-(k as i32 + 1)) * TWO_64) as u64)
    })
});

impl<const D: usize> KroneckerPoints<D> {
    /// The points numbered `range` of a batch; at most 16 dimensions.
    pub fn new(seed: u64, purpose: Purpose, batch: u64, range: Range<u64>) -> Self {
        const { assert!(D <= MOST) };
        let mut stream = Stream::new(seed, purpose, batch);
        let step: [u64; D] = std::array::from_fn(|k| STEPS[D][k]);
        let at = step.map(|s| ((stream.unit64() * TWO_64) as u64).wrapping_add(s.wrapping_mul(range.start)));
        Self { at, step, left: range.end.saturating_sub(range.start) }
    }
}

impl<const D: usize> Iterator for KroneckerPoints<D> {
    type Item = [f64; D];

    /// The next point; every coordinate lies in the open interval (0, 1).
    fn next(&mut self) -> Option<[f64; D]> {
        self.left = self.left.checked_sub(1)?;
        let point = self.at.map(|v| ((v >> 12) as f64 + 0.5) / (TWO_64 / 4096.0));
        for (at, step) in self.at.iter_mut().zip(self.step) {
            *at = at.wrapping_add(step);
        }
        Some(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_does_not_depend_on_where_its_run_starts() {
        let all: Vec<_> = KroneckerPoints::<4>::new(3, Purpose::TEST, 7, 0..100).collect();
        let tail: Vec<_> = KroneckerPoints::<4>::new(3, Purpose::TEST, 7, 60..100).collect();
        assert_eq!(all[60..], tail);
        assert!(all.iter().flatten().all(|x| *x > 0.0 && *x < 1.0));
    }

    #[test]
    fn runs_are_more_even_than_independent_points() {
        // share of a quarter disc: independent points would be off by √(π/4(1−π/4)/n) = .0064
        let n = 4096;
        for batch in 0..8 {
            let inside = KroneckerPoints::<2>::new(3, Purpose::TEST, batch, 0..n)
                .filter(|p| p[0] * p[0] + p[1] * p[1] < 1.0)
                .count();
            let off = inside as f64 / n as f64 - std::f64::consts::FRAC_PI_4;
            assert!(off.abs() < 0.0025, "{off}");
        }
    }
}
