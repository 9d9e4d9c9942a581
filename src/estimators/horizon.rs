//! The horizon, and the ends of the bands of elevation: the side on which a direction lies, by one
//! rule in every estimator, whether photons or beams carry its light.
//!
//! Facets at exactly 45° mirror the horizon, and crystal shapes send light out exactly level: without
//! a rule, rounding decides by several percent of a score.

/// A direction whose height (sine of its elevation) is less than this above a limit counts as below it.
///
/// Light that leaves exactly level comes out of a trace in `f32` within 1e-6 of it, measured over the
/// crystal shapes of the library at stop powers of 1e-4; this is ten times as much. The angles of
/// designs, given to a hundredth of a degree, send light 1.7e-4 or more away. Uniform light changes by
/// a part in 1e5. A smaller value lets rounding decide again (`tests/library/horizon.rs`).
pub const MAX_LEVEL_SINE: f32 = 1e-5;

/// Whether light comes from above a limit.
///
/// - `height`, `limit`: sines of elevation
#[inline(always)]
pub fn is_above(height: f32, limit: f32) -> bool {
    height >= limit + MAX_LEVEL_SINE
}

/// Whether light comes from above the horizon.
#[inline(always)]
pub fn is_up(height: f32) -> bool {
    height >= MAX_LEVEL_SINE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_light_is_below_the_horizon_whichever_way_it_was_rounded() {
        for level in [0.0, -0.0, 1e-6, -1e-6, f32::MIN_POSITIVE] {
            assert!(!is_up(level), "{level}");
            let at_45 = std::f32::consts::FRAC_1_SQRT_2 + level;
            assert!(!is_above(at_45, std::f32::consts::FRAC_1_SQRT_2), "{level}");
        }
        // 0.01° above
        assert!(is_up(1.7e-4) && !is_up(-1.7e-4));
    }
}
