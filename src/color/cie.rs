//! Colour: CIE 1931 observer, the wavelengths a picture is traced at, and linear sRGB.
//!
//! A picture carries eight wavelengths per camera ray, one in each of eight bands. The bands hold
//! equal shares of x̄ + ȳ + z̄, so that each wavelength matters about as much as the others to the
//! eye; a photon carries one wavelength drawn from the same density.

use glam::{Mat3, Vec3};
use std::sync::LazyLock;

/// How many bands a spectrum is carried in.
pub const BANDS: usize = 8;

/// First and last wavelength of the visible range used, nm.
pub const RANGE_NM: (f32, f32) = (380.0, 730.0);

const STEP_NM: f32 = 5.0;

/// CIE 1931 2° colour matching functions x̄ ȳ z̄ at 380, 385 … 730 nm.
/// Source: CIE 018:2019, table 6. Checked by their sums, below.
#[rustfmt::skip]
const MATCHING: [[f32; 3]; 71] = [
    [0.001368, 3.9e-05, 0.00645], // 380
    [0.002236, 6.4e-05, 0.01055], // 385
    [0.004243, 0.00012, 0.02005], // 390
    [0.00765, 0.000217, 0.03621], // 395
    [0.01431, 0.000396, 0.06785], // 400
    [0.02319, 0.00064, 0.1102], // 405
    [0.04351, 0.00121, 0.2074], // 410
    [0.07763, 0.00218, 0.3713], // 415
    [0.13438, 0.004, 0.6456], // 420
    [0.21477, 0.0073, 1.03905], // 425
    [0.2839, 0.0116, 1.3856], // 430
    [0.3285, 0.01684, 1.62296], // 435
    [0.34828, 0.023, 1.74706], // 440
    [0.34806, 0.0298, 1.7826], // 445
    [0.3362, 0.038, 1.77211], // 450
    [0.3187, 0.048, 1.7441], // 455
    [0.2908, 0.06, 1.6692], // 460
    [0.2511, 0.0739, 1.5281], // 465
    [0.19536, 0.09098, 1.28764], // 470
    [0.1421, 0.1126, 1.0419], // 475
    [0.09564, 0.13902, 0.81295], // 480
    [0.05795, 0.1693, 0.6162], // 485
    [0.03201, 0.20802, 0.46518], // 490
    [0.0147, 0.2586, 0.3533], // 495
    [0.0049, 0.323, 0.272], // 500
    [0.0024, 0.4073, 0.2123], // 505
    [0.0093, 0.503, 0.1582], // 510
    [0.0291, 0.6082, 0.1117], // 515
    [0.06327, 0.71, 0.07825], // 520
    [0.1096, 0.7932, 0.05725], // 525
    [0.1655, 0.862, 0.04216], // 530
    [0.22575, 0.91485, 0.02984], // 535
    [0.2904, 0.954, 0.0203], // 540
    [0.3597, 0.9803, 0.0134], // 545
    [0.43345, 0.99495, 0.00875], // 550
    [0.51205, 1.0, 0.00575], // 555
    [0.5945, 0.995, 0.0039], // 560
    [0.6784, 0.9786, 0.00275], // 565
    [0.7621, 0.952, 0.0021], // 570
    [0.8425, 0.9154, 0.0018], // 575
    [0.9163, 0.87, 0.00165], // 580
    [0.9786, 0.8163, 0.0014], // 585
    [1.0263, 0.757, 0.0011], // 590
    [1.0567, 0.6949, 0.001], // 595
    [1.0622, 0.631, 0.0008], // 600
    [1.0456, 0.5668, 0.0006], // 605
    [1.0026, 0.503, 0.00034], // 610
    [0.9384, 0.4412, 0.00024], // 615
    [0.85445, 0.381, 0.00019], // 620
    [0.7514, 0.321, 0.0001], // 625
    [0.6424, 0.265, 5e-05], // 630
    [0.5419, 0.217, 3e-05], // 635
    [0.4479, 0.175, 2e-05], // 640
    [0.3608, 0.1382, 1e-05], // 645
    [0.2835, 0.107, -0.0], // 650
    [0.2187, 0.0816, 0.0], // 655
    [0.1649, 0.061, 0.0], // 660
    [0.1212, 0.04458, 0.0], // 665
    [0.0874, 0.032, 0.0], // 670
    [0.0636, 0.0232, 0.0], // 675
    [0.04677, 0.017, 0.0], // 680
    [0.0329, 0.01192, 0.0], // 685
    [0.0227, 0.00821, 0.0], // 690
    [0.01584, 0.005723, 0.0], // 695
    [0.011359, 0.004102, 0.0], // 700
    [0.008111, 0.002929, 0.0], // 705
    [0.00579, 0.002091, 0.0], // 710
    [0.004109, 0.001484, 0.0], // 715
    [0.002899, 0.001047, 0.0], // 720
    [0.002049, 0.00074, 0.0], // 725
    [0.00144, 0.00052, 0.0], // 730
];

/// The colour matching functions at `nm`, linear between the table's entries, 0 outside it.
pub fn matching(nm: f32) -> Vec3 {
    let t = (nm - RANGE_NM.0) / STEP_NM;
    if !(0.0..=70.0).contains(&t) {
        return Vec3::ZERO;
    }
    let i = (t as usize).min(69);
    let (a, b) = (Vec3::from_array(MATCHING[i]), Vec3::from_array(MATCHING[i + 1]));
    a.lerp(b, t - i as f32)
}

/// The density from which wavelengths are drawn: x̄ + ȳ + z̄, normalised over the range.
struct WavelengthDensity {
    /// cumulative[i]: share below table entry i
    cumulative: [f32; 71],
    /// For each of [`STARTS`] equal parts of the unit interval, the table interval in which it begins.
    start: [u8; STARTS],
    /// XYZ of the equal-energy spectrum over the range, before scaling to Y = 1
    white: Vec3,
}

/// Entries of the index into the cumulative density.
const STARTS: usize = 256;

static DENSITY: LazyLock<WavelengthDensity> = LazyLock::new(|| {
    let sum = |i: usize| MATCHING[i].iter().sum::<f32>();
    let mut cumulative = [0.0; 71];
    let mut white = Vec3::ZERO;
    for i in 1..71 {
        cumulative[i] = cumulative[i - 1] + 0.5 * STEP_NM * (sum(i - 1) + sum(i));
        white += 0.5 * STEP_NM * (Vec3::from_array(MATCHING[i - 1]) + Vec3::from_array(MATCHING[i]));
    }
    let total = cumulative[70];
    cumulative.iter_mut().for_each(|c| *c /= total);
    let first = |u: f32| cumulative[1..70].partition_point(|&c| c <= u) as u8;
    let start = std::array::from_fn(|i| first(i as f32 / STARTS as f32));
    WavelengthDensity { cumulative, start, white }
});

/// A wavelength drawn from the density, nm.
///
/// - `u`: uniform in (0, 1); (band + v)/8 with v uniform draws from one band
pub fn wavelength(u: f32) -> f32 {
    let WavelengthDensity { cumulative: c, start, .. } = &*DENSITY;
    let mut i = usize::from(start[((u * STARTS as f32) as usize).min(STARTS - 1)]);
    while i < 69 && c[i + 1] <= u {
        i += 1;
    }
    // within a table interval the density is linear; inverting it linearly in the integral keeps
    // the density piecewise constant, which `density` below states
    RANGE_NM.0 + STEP_NM * (i as f32 + (u - c[i]) / (c[i + 1] - c[i]))
}

/// The density per nm of [`wavelength`] at `nm`.
pub fn density(nm: f32) -> f32 {
    let i = (((nm - RANGE_NM.0) / STEP_NM) as usize).min(69);
    (DENSITY.cumulative[i + 1] - DENSITY.cumulative[i]) / STEP_NM
}

/// The band (0..8) that `nm` lies in.
pub fn band(nm: f32) -> usize {
    let i = (((nm - RANGE_NM.0) / STEP_NM) as usize).min(69);
    let c = &DENSITY.cumulative;
    let u = c[i] + (c[i + 1] - c[i]) * ((nm - RANGE_NM.0) / STEP_NM - i as f32);
    ((u * BANDS as f32) as usize).min(BANDS - 1)
}

/// What radiance 1 at the drawn wavelength `nm` adds to XYZ, so that the mean over draws of a
/// constant spectrum 1 is the equal-energy white with Y = 1.
pub fn xyz_weight(nm: f32) -> Vec3 {
    matching(nm) / (density(nm) * DENSITY.white.y)
}

/// [`xyz_weight`] averaged over one band: what a spectrum constant over the band adds to XYZ.
pub fn band_xyz(band: usize) -> Vec3 {
    static TABLE: LazyLock<[Vec3; BANDS]> = LazyLock::new(|| {
        std::array::from_fn(|b| {
            let n = 256;
            (0..n)
                .map(|i| xyz_weight(wavelength((b as f32 + (i as f32 + 0.5) / n as f32) / BANDS as f32)))
                .sum::<Vec3>()
                / n as f32
        })
    });
    TABLE[band]
}

/// CIE 1931 x, y of a colour.
pub fn chromaticity(xyz: Vec3) -> [f32; 2] {
    [xyz.x / xyz.element_sum(), xyz.y / xyz.element_sum()]
}

/// The wavelengths of the table, 380, 385 … 730 nm.
pub fn nodes() -> impl Iterator<Item = f32> {
    (0..MATCHING.len()).map(|i| RANGE_NM.0 + STEP_NM * i as f32)
}

/// XYZ of a chromaticity, Y = 1.
fn of_chromaticity(x: f32, y: f32) -> Vec3 {
    Vec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

/// The white of sRGB: D65.
fn srgb_white() -> Vec3 {
    of_chromaticity(0.3127, 0.3290)
}

/// XYZ under D65 to linear sRGB, from the chromaticities of its primaries and its white.
///
/// Source: IEC 61966-2-1. Checked in `tests/library/colour.rs` against the matrix printed there.
pub fn srgb_matrix() -> Mat3 {
    let primaries = Mat3::from_cols(
        of_chromaticity(0.64, 0.33),
        of_chromaticity(0.30, 0.60),
        of_chromaticity(0.15, 0.06),
    );
    let shares = primaries.inverse() * srgb_white();
    (primaries * Mat3::from_diagonal(shares)).inverse()
}

/// XYZ to linear sRGB for an eye adapted to `white` (XYZ, Y = 1), which comes out as (1, 1, 1):
/// Bradford adaptation to D65, then the sRGB matrix.
///
/// Source: Lam 1985 (Bradford cone responses). Checked in `tests/library/colour.rs`.
pub fn adapted_srgb(xyz: Vec3, white: Vec3) -> Vec3 {
    to_adapted_srgb(white) * xyz
}

/// The matrix of [`adapted_srgb`].
pub fn to_adapted_srgb(white: Vec3) -> Mat3 {
    let bradford = Mat3::from_cols(
        Vec3::new(0.8951, -0.7502, 0.0389),
        Vec3::new(0.2664, 1.7135, -0.0685),
        Vec3::new(-0.1614, 0.0367, 1.0296),
    );
    let gain = (bradford * srgb_white()) / (bradford * white);
    srgb_matrix() * bradford.inverse() * Mat3::from_diagonal(gain) * bradford
}

/// XYZ under the equal-energy white, the light of the scenes, to linear sRGB: equal-energy light of
/// luminance 1 comes out as (1, 1, 1).
pub fn linear_srgb(xyz: Vec3) -> Vec3 {
    static TO_RGB: LazyLock<Mat3> = LazyLock::new(|| to_adapted_srgb(DENSITY.white / DENSITY.white.y));
    *TO_RGB * xyz
}

/// The sRGB transfer curve: linear 0..=1 to display 0..=1.
pub fn srgb_encode(linear: f32) -> f32 {
    let x = linear.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// Linear light of an sRGB value in 0..=1, as a fraction of full scale.
pub fn srgb_decode(shown: f32) -> f32 {
    if shown <= 0.04045 { shown / 12.92 } else { ((shown + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transfer_curve_comes_back() {
        for i in 0..=255u8 {
            let shown = f32::from(i) / 255.0;
            assert!((srgb_encode(srgb_decode(shown)) - shown).abs() < 1e-5, "{i}");
        }
    }

    #[test]
    fn the_matching_functions_have_the_published_sums() {
        let mut sums = [0.0; 3];
        MATCHING.iter().for_each(|row| (0..3).for_each(|i| sums[i] += f64::from(row[i])));
        // the sums over 380–780 nm are 21.3714, 21.3711, 21.3715; beyond 730 nm lie .0031 and .0009
        for (sum, expected) in sums.iter().zip([21.3683, 21.3702, 21.3715]) {
            assert!((sum - expected).abs() < 2e-4, "{sums:?}");
        }
    }

    #[test]
    fn eight_stratified_wavelengths_of_white_light_make_white() {
        let n = 4096;
        let sum: Vec3 =
            (0..n * BANDS).map(|i| xyz_weight(wavelength((i as f32 + 0.5) / (n * BANDS) as f32))).sum();
        let rgb = linear_srgb(sum / (n * BANDS) as f32);
        assert!((rgb - Vec3::ONE).abs().max_element() < 2e-3, "{rgb}");
        let bands: Vec3 = (0..BANDS).map(band_xyz).sum::<Vec3>() / BANDS as f32;
        assert!((linear_srgb(bands) - Vec3::ONE).abs().max_element() < 2e-3);
    }

    #[test]
    fn drawing_and_band_agree() {
        for i in 0..800 {
            let u = (i as f32 + 0.5) / 800.0;
            assert_eq!(band(wavelength(u)), (u * BANDS as f32) as usize, "u = {u}");
        }
    }
}
