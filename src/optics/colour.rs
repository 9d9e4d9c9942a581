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
#[allow(clippy::excessive_precision)] // the table as CIE prints it
const MATCHING: [[f32; 3]; 71] = [
    [0.001368, 0.000039, 0.006450], // 380
    [0.002236, 0.000064, 0.010550], // 385
    [0.004243, 0.000120, 0.020050], // 390
    [0.007650, 0.000217, 0.036210], // 395
    [0.014310, 0.000396, 0.067850], // 400
    [0.023190, 0.000640, 0.110200], // 405
    [0.043510, 0.001210, 0.207400], // 410
    [0.077630, 0.002180, 0.371300], // 415
    [0.134380, 0.004000, 0.645600], // 420
    [0.214770, 0.007300, 1.039050], // 425
    [0.283900, 0.011600, 1.385600], // 430
    [0.328500, 0.016840, 1.622960], // 435
    [0.348280, 0.023000, 1.747060], // 440
    [0.348060, 0.029800, 1.782600], // 445
    [0.336200, 0.038000, 1.772110], // 450
    [0.318700, 0.048000, 1.744100], // 455
    [0.290800, 0.060000, 1.669200], // 460
    [0.251100, 0.073900, 1.528100], // 465
    [0.195360, 0.090980, 1.287640], // 470
    [0.142100, 0.112600, 1.041900], // 475
    [0.095640, 0.139020, 0.812950], // 480
    [0.057950, 0.169300, 0.616200], // 485
    [0.032010, 0.208020, 0.465180], // 490
    [0.014700, 0.258600, 0.353300], // 495
    [0.004900, 0.323000, 0.272000], // 500
    [0.002400, 0.407300, 0.212300], // 505
    [0.009300, 0.503000, 0.158200], // 510
    [0.029100, 0.608200, 0.111700], // 515
    [0.063270, 0.710000, 0.078250], // 520
    [0.109600, 0.793200, 0.057250], // 525
    [0.165500, 0.862000, 0.042160], // 530
    [0.225750, 0.914850, 0.029840], // 535
    [0.290400, 0.954000, 0.020300], // 540
    [0.359700, 0.980300, 0.013400], // 545
    [0.433450, 0.994950, 0.008750], // 550
    [0.512050, 1.000000, 0.005750], // 555
    [0.594500, 0.995000, 0.003900], // 560
    [0.678400, 0.978600, 0.002750], // 565
    [0.762100, 0.952000, 0.002100], // 570
    [0.842500, 0.915400, 0.001800], // 575
    [0.916300, 0.870000, 0.001650], // 580
    [0.978600, 0.816300, 0.001400], // 585
    [1.026300, 0.757000, 0.001100], // 590
    [1.056700, 0.694900, 0.001000], // 595
    [1.062200, 0.631000, 0.000800], // 600
    [1.045600, 0.566800, 0.000600], // 605
    [1.002600, 0.503000, 0.000340], // 610
    [0.938400, 0.441200, 0.000240], // 615
    [0.854450, 0.381000, 0.000190], // 620
    [0.751400, 0.321000, 0.000100], // 625
    [0.642400, 0.265000, 0.000050], // 630
    [0.541900, 0.217000, 0.000030], // 635
    [0.447900, 0.175000, 0.000020], // 640
    [0.360800, 0.138200, 0.000010], // 645
    [0.283500, 0.107000, -0.000000], // 650
    [0.218700, 0.081600, 0.000000], // 655
    [0.164900, 0.061000, 0.000000], // 660
    [0.121200, 0.044580, 0.000000], // 665
    [0.087400, 0.032000, 0.000000], // 670
    [0.063600, 0.023200, 0.000000], // 675
    [0.046770, 0.017000, 0.000000], // 680
    [0.032900, 0.011920, 0.000000], // 685
    [0.022700, 0.008210, 0.000000], // 690
    [0.015840, 0.005723, 0.000000], // 695
    [0.011359, 0.004102, 0.000000], // 700
    [0.008111, 0.002929, 0.000000], // 705
    [0.005790, 0.002091, 0.000000], // 710
    [0.004109, 0.001484, 0.000000], // 715
    [0.002899, 0.001047, 0.000000], // 720
    [0.002049, 0.000740, 0.000000], // 725
    [0.001440, 0.000520, 0.000000], // 730
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
    /// XYZ of the equal-energy spectrum over the range, before scaling to Y = 1
    white: Vec3,
}

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
    WavelengthDensity { cumulative, white }
});

/// A wavelength drawn from the density, nm.
///
/// - `u`: uniform in (0, 1); (band + v)/8 with v uniform draws from one band
pub fn wavelength(u: f32) -> f32 {
    let c = &DENSITY.cumulative;
    let i = c.partition_point(|&x| x <= u).clamp(1, 70) - 1;
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

/// XYZ under the equal-energy white to linear sRGB: Bradford adaptation to D65, then the sRGB
/// matrix. Equal-energy light of luminance 1 comes out as (1, 1, 1).
///
/// Source: IEC 61966-2-1 (sRGB); Lam 1985 (Bradford cone responses). Checked below.
pub fn linear_srgb(xyz: Vec3) -> Vec3 {
    static TO_RGB: LazyLock<Mat3> = LazyLock::new(|| {
        let bradford = Mat3::from_cols(
            Vec3::new(0.8951, -0.7502, 0.0389),
            Vec3::new(0.2664, 1.7135, -0.0685),
            Vec3::new(-0.1614, 0.0367, 1.0296),
        );
        let white_e = bradford * (DENSITY.white / DENSITY.white.y);
        let white_d65 = bradford * Vec3::new(0.950_456, 1.0, 1.089_058);
        let adapt = bradford.inverse() * Mat3::from_diagonal(white_d65 / white_e) * bradford;
        let rgb = Mat3::from_cols(
            Vec3::new(3.240_454_2, -0.969_266, 0.055_643_4),
            Vec3::new(-1.537_138_5, 1.876_010_8, -0.204_025_9),
            Vec3::new(-0.498_531_4, 0.041_556, 1.057_225_2),
        );
        rgb * adapt
    });
    *TO_RGB * xyz
}

/// The sRGB transfer curve: linear 0..=1 to display 0..=1.
pub fn srgb_encode(linear: f32) -> f32 {
    let x = linear.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

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
