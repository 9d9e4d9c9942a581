//! Dispersion, Fresnel and colour against published figures and identities.

use cutlab::optics::colour;
use cutlab::optics::dispersion::lines;
use cutlab::optics::fresnel::{critical_angle_deg, unpolarised};
use cutlab::optics::materials::{MATERIALS, Material};
use glam::Vec3;

#[test]
fn diamond_at_eight_fraunhofer_lines() {
    let diamond = Material::named("diamond").expect("in the catalogue");
    for (um, n) in [
        (lines::B, 2.40728),
        (lines::C, 2.40990),
        (lines::D, 2.41726),
        (lines::D_HELIUM, 2.41749),
        (lines::E, 2.42359),
        (lines::F, 2.43554),
        (lines::G, 2.45173),
        (lines::H, 2.46205),
    ] {
        assert!((diamond.index(um) - n).abs() <= 2e-5, "{um} µm: {}", diamond.index(um));
    }
}

#[test]
fn the_three_colours_of_the_original_project() {
    let rgb = Material::named("diamond-rgb").expect("in the catalogue");
    assert_eq!([0.65, 0.55, 0.45].map(|um| rgb.index(um)), [2.40, 2.43, 2.46]);
}

#[test]
fn every_material_loses_less_than_all_and_bends_what_it_says() {
    for m in MATERIALS {
        let n = m.index_d();
        let mut last = 0.0;
        for i in 0..=900 {
            let cos_i = (f64::from(i) / 10.0).to_radians().cos();
            let (r, cos_t) = unpolarised(cos_i, n);
            assert!((0.0..=1.0).contains(&r));
            // Snell: sin i = n sin t
            let (sin_i, sin_t) = ((1.0 - cos_i * cos_i).max(0.0).sqrt(), (1.0 - cos_t * cos_t).sqrt());
            assert!((sin_i - n * sin_t).abs() < 1e-12, "{} at {i}", m.name);
            // reversibility: the same reflectance from inside along the same path
            let (back, cos_back) = unpolarised(cos_t, 1.0 / n);
            assert!((back - r).abs() < 1e-9, "{} at {i}: {back} {r}", m.name);
            assert!((cos_back - cos_i).abs() < 1e-6);
            last = r;
        }
        assert!((last - 1.0).abs() < 1e-15, "grazing light is reflected whole: {last}");
    }
}

#[test]
fn diamond_reflects_and_traps_what_textbooks_say() {
    let n = Material::named("diamond").expect("in the catalogue").index_d();
    assert!((unpolarised(1.0, n).0 - 0.17200).abs() < 1e-4);
    assert!((critical_angle_deg(n) - 24.44).abs() < 0.01);
}

#[test]
fn equal_energy_light_is_white() {
    let n = 8 * 512;
    let xyz: Vec3 = (0..n).map(|i| colour::xyz_weight(colour::wavelength((i as f32 + 0.5) / n as f32))).sum();
    let rgb = colour::linear_srgb(xyz / n as f32);
    assert!((rgb - Vec3::ONE).abs().max_element() < 2e-3, "{rgb}");
    assert_eq!(colour::srgb_encode(0.0), 0.0);
    assert!((colour::srgb_encode(1.0) - 1.0).abs() < 1e-6);
}
