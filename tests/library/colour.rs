//! Colour against published figures: whites, the spectral locus, sRGB, a chart's patches, gems.

use cutlab::advanced::color::Illuminant;
use cutlab::advanced::color::cie;
use cutlab::advanced::color::cie::{adapted_srgb, chromaticity, matching, srgb_encode, srgb_matrix};
use cutlab::advanced::materials::Material;
use glam::Vec3;

fn light(name: &str) -> std::sync::Arc<Illuminant> {
    Illuminant::by_name(name).expect("in the catalogue")
}

fn assert_near(found: [f32; 2], published: [f32; 2], tolerance: f32, what: &str) {
    let off = (0..2).map(|i| (found[i] - published[i]).abs()).fold(0.0, f32::max);
    assert!(off <= tolerance, "{what}: {found:?}, published {published:?}");
}

/// [P] CIE 015: chromaticities of the illuminants.
#[test]
fn whites_are_where_the_cie_has_them() {
    for (name, published) in
        [("D65", [0.3127, 0.3290]), ("A", [0.4476, 0.4074]), ("D50", [0.3457, 0.3585]), ("E", [1.0 / 3.0; 2])]
    {
        assert_near(light(name).chromaticity(), published, 1.5e-4, name);
    }
}

/// [P] CIE 015: relative power of A at five wavelengths, 100 at 560 nm.
#[test]
fn incandescent_light_has_the_published_spectrum() {
    for (nm, published) in
        [(380.0, 9.7951), (450.0, 33.0859), (500.0, 59.8611), (600.0, 129.043), (700.0, 198.261)]
    {
        let found = 100.0 * light("A").power(nm);
        assert!((found - published).abs() < 2e-4 * published, "{nm}: {found}");
    }
}

/// [P] CIE 015: chromaticities of the spectral locus.
#[test]
fn the_spectral_locus_is_where_the_cie_has_it() {
    for (nm, published) in [
        (400.0, [0.1733, 0.0048]),
        (450.0, [0.1566, 0.0177]),
        (480.0, [0.0913, 0.1327]),
        (500.0, [0.0082, 0.5384]),
        (520.0, [0.0743, 0.8338]),
        (550.0, [0.3016, 0.6923]),
        (580.0, [0.5125, 0.4866]),
        (600.0, [0.6270, 0.3725]),
        (650.0, [0.7260, 0.2740]),
    ] {
        assert_near(chromaticity(matching(nm)), published, 1e-4, &format!("{nm} nm"));
    }
}

/// [P] IEC 61966-2-1: the matrix from XYZ to linear sRGB, to its four digits.
#[test]
fn srgb_has_its_published_matrix() {
    let published = [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]];
    for (row, published) in published.into_iter().enumerate() {
        let found = srgb_matrix().row(row);
        // the standard inverts a matrix that it has rounded to four digits
        assert!((found - Vec3::from(published)).abs().max_element() < 5e-4, "row {row}: {found}");
    }
}

#[test]
fn every_light_is_white_to_an_eye_adapted_to_it() {
    for name in ["D65", "A", "D50", "E"] {
        for grey in [1.0, 0.18] {
            let rgb = light(name).linear_srgb(|_| grey);
            assert!((rgb - Vec3::splat(grey)).abs().max_element() < 2e-5, "{name}: {rgb}");
        }
    }
    // and to one that is not, incandescent light is orange
    let rgb = adapted_srgb(light("A").xyz(|_| 1.0), light("D65").xyz(|_| 1.0));
    assert!(rgb.x > 1.5 && rgb.z < 0.4, "{rgb}");
}

/// Patches of a colour chart: average reflectance at 380, 390 … 730 nm, and x, y, Y under D50.
/// [P] BabelColor, D. Pascale, average of 30 charts.
const PATCHES: [(&str, [f32; 36], [f32; 3]); 4] = [
    (
        "dark skin",
        [
            0.055, 0.058, 0.061, 0.062, 0.062, 0.062, 0.062, 0.062, 0.062, 0.062, 0.062, 0.063, 0.065, 0.070,
            0.076, 0.079, 0.081, 0.084, 0.091, 0.103, 0.119, 0.134, 0.143, 0.147, 0.151, 0.158, 0.168, 0.179,
            0.188, 0.190, 0.186, 0.181, 0.182, 0.187, 0.196, 0.209,
        ],
        [0.4325, 0.3788, 0.1034],
    ),
    (
        "blue sky",
        [
            0.130, 0.177, 0.251, 0.306, 0.324, 0.330, 0.333, 0.331, 0.323, 0.311, 0.298, 0.285, 0.269, 0.250,
            0.231, 0.214, 0.199, 0.185, 0.169, 0.157, 0.149, 0.145, 0.142, 0.141, 0.141, 0.141, 0.143, 0.147,
            0.152, 0.154, 0.150, 0.144, 0.136, 0.132, 0.135, 0.147,
        ],
        [0.2761, 0.3004, 0.1847],
    ),
    (
        "green",
        [
            0.052, 0.053, 0.054, 0.055, 0.057, 0.059, 0.061, 0.066, 0.075, 0.093, 0.125, 0.178, 0.246, 0.307,
            0.337, 0.334, 0.317, 0.293, 0.262, 0.230, 0.198, 0.165, 0.135, 0.115, 0.104, 0.098, 0.094, 0.092,
            0.093, 0.097, 0.102, 0.108, 0.113, 0.115, 0.114, 0.114,
        ],
        [0.3270, 0.5033, 0.2307],
    ),
    (
        "red",
        [
            0.050, 0.049, 0.048, 0.047, 0.047, 0.047, 0.047, 0.047, 0.046, 0.045, 0.044, 0.044, 0.045, 0.046,
            0.047, 0.048, 0.049, 0.050, 0.054, 0.060, 0.072, 0.104, 0.178, 0.312, 0.467, 0.581, 0.644, 0.675,
            0.690, 0.698, 0.706, 0.715, 0.724, 0.730, 0.734, 0.738,
        ],
        [0.5709, 0.3298, 0.1268],
    ),
];

#[test]
fn a_colour_chart_comes_out_as_published() {
    for (name, reflectance, [x, y, luminance]) in PATCHES {
        let at = |nm: f32| {
            let t = (nm - 380.0) / 10.0;
            let i = (t as usize).min(34);
            reflectance[i] + (reflectance[i + 1] - reflectance[i]) * (t - i as f32)
        };
        let xyz = light("D50").xyz(at);
        assert_near(chromaticity(xyz), [x, y], 1e-3, name);
        assert!((xyz.y - luminance).abs() < 1e-3, "{name}: {}", xyz.y);
    }
}

/// A gem's colour through five millimetres by daylight has the hue that names it.
#[test]
fn gems_have_their_colours() {
    let colour = |name: &str, mm: f32| {
        let material = Material::by_name(name).expect("in the catalogue");
        light("D65").linear_srgb(|nm| (-mm * material.absorption_per_mm(f64::from(nm)) as f32).exp())
    };
    let ruby = colour("ruby", 5.0);
    assert!(ruby.x > 2.0 * ruby.y.max(ruby.z), "{ruby}");
    let sapphire = colour("sapphire", 5.0);
    assert!(sapphire.z > 2.0 * sapphire.x.max(sapphire.y), "{sapphire}");
    let emerald = colour("emerald", 5.0);
    assert!(emerald.y > 1.5 * emerald.x.max(emerald.z), "{emerald}");
    let cape = colour("cape-diamond", 5.0);
    assert!(cape.z < 0.95 * cape.y && cape.x > 0.9 * cape.y, "{cape}");
    assert!((colour("diamond", 5.0) - Vec3::ONE).abs().max_element() < 1e-4);
    // size matters: twice as deep, darker
    assert!(colour("ruby", 10.0).max_element() < ruby.max_element());
}

#[test]
fn the_transfer_curve_meets_its_ends() {
    assert_eq!(srgb_encode(0.0), 0.0);
    assert!((srgb_encode(1.0) - 1.0).abs() < 1e-6);
    // [P] IEC 61966-2-1: 18 % grey is 118 of 255
    assert_eq!((255.0 * srgb_encode(0.18)).round(), 118.0);
    assert_eq!(cie::nodes().count(), 71);
}
