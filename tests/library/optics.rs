//! Dispersion, Fresnel and colour against published figures and identities.

use cutlab::advanced::batch::validate::figures;
use cutlab::advanced::color::cie;
use cutlab::advanced::materials::{MATERIALS, Material};
use cutlab::advanced::optics::dispersion::lines;
use cutlab::advanced::optics::fresnel::{critical_angle_deg, unpolarised};
use glam::Vec3;

#[test]
fn diamond_at_eight_fraunhofer_lines() {
    let diamond = Material::by_name("diamond").expect("in the catalogue");
    let known = [lines::B, lines::C, lines::D, lines::D_HELIUM, lines::E, lines::F, lines::G, lines::H];
    let published = figures::set("lines of diamond");
    assert_eq!(published.len(), known.len());
    for (nm, f) in known.into_iter().zip(published) {
        assert!((diamond.index(nm) - f.expected).abs() <= f.tolerance(), "{f:?}: {}", diamond.index(nm));
    }
}

/// Index at D and B–G separation of both rays, to what the tables print (they round the lines G and B too).
#[test]
fn indices_and_dispersions_match_the_published_ones() {
    for f in figures::set("indices") {
        let extraordinary = f.quantity.starts_with("extraordinary");
        // a ruby is corundum
        let names =
            if f.of == "corundum" && extraordinary { vec!["corundum", "ruby"] } else { vec![&f.of[..]] };
        for name in names {
            let m = Material::by_name(name).expect("in the catalogue");
            let [_, own, third] = m.principal_axes();
            let law = if extraordinary { third.0 } else { own.0 };
            let ours = match f.quantity.ends_with("n_D") {
                true => law.index(lines::D),
                false => law.index(lines::G) - law.index(lines::B),
            };
            assert!((ours - f.expected).abs() <= f.tolerance(), "{name} {f:?}: {ours}");
        }
    }
}

/// Differences of the two rays by gemmological tables.
#[test]
fn extraordinary_indices_match_the_published_ones() {
    for (name, birefringence) in
        [("beryl", -0.006), ("emerald", -0.006), ("tourmaline", -0.020), ("zircon", 0.059)]
    {
        let m = Material::by_name(name).expect("in the catalogue");
        let [ordinary, _, extraordinary] = m.principal_indices(lines::D);
        assert!((extraordinary - ordinary - birefringence).abs() < 1e-12, "{name}");
    }
    let cubic = Material::by_name("spinel").expect("in the catalogue");
    assert_eq!(cubic.crystal, None);
}

/// [P] Schott's data sheet of N-BK7 (n_d 1.51680, n_F − n_C .008054), Malitson's tables of fused
/// silica and fluorite, calcite of any handbook; chrysoberyl by its law, which gives the greatest index
/// of synthetic crystals and the middle one of gems (1.746, 1.748, 1.756). Cauchy laws go through the n_D and B–G of gemmological tables.
#[test]
fn the_materials_beside_the_table_have_their_indices() {
    let named = |name: &str| Material::by_name(name).expect("in the catalogue");
    for (name, n, tolerance) in [
        ("n-bk7", 1.51680, 1e-5),
        ("fused-silica", 1.45846, 1e-5),
        ("fluorite", 1.43385, 2e-5),
        ("calcite", 1.65846, 1e-3),
        ("chrysoberyl", 1.748, 6e-4),
    ] {
        let found = named(name).index(lines::D_HELIUM);
        assert!((found - n).abs() < tolerance, "{name}: {found}");
    }
    let glass = named("n-bk7");
    assert!((glass.index(lines::F) - glass.index(lines::C) - 0.008054).abs() < 2e-6);
    let calcite = named("calcite").principal_indices(lines::D)[2];
    assert!((calcite - 1.4864).abs() < 1e-3, "{calcite}");
}

/// [P] n_D of the ordinary or only ray (of three the middle one), B–G and density of gemmological tables
/// (`materials.tsv` of the project's reference has their sources).
#[test]
fn gems_have_the_figures_of_the_tables() {
    let figures = [
        ("zircon", 1.925, 0.039, 4.70),
        ("topaz", 1.612, 0.014, 3.56),
        ("imperial-topaz", 1.631, 0.014, 3.53),
        ("beryl", 1.583, 0.014, 2.72),
        ("emerald", 1.583, 0.014, 2.72),
        ("aquamarine", 1.583, 0.014, 2.71),
        ("morganite", 1.592, 0.014, 2.80),
        ("tourmaline", 1.644, 0.017, 3.06),
        ("pyrope", 1.746, 0.022, 3.78),
        ("almandine", 1.79, 0.024, 4.05),
        ("rhodolite", 1.76, 0.024, 3.84),
        ("spessartine", 1.81, 0.027, 4.15),
        ("grossular", 1.74, 0.028, 3.61),
        ("demantoid", 1.888, 0.057, 3.84),
        ("alexandrite", 1.748, 0.015, 3.73),
        ("tanzanite", 1.693, 0.021, 3.35),
        ("peridot", 1.671, 0.020, 3.34),
        ("kunzite", 1.666, 0.017, 3.18),
        ("iolite", 1.547, 0.017, 2.61),
        ("sphene", 1.907, 0.051, 3.53),
        ("apatite", 1.638, 0.013, 3.18),
        ("sphalerite", 2.3669, 0.1625, 4.05),
        ("opal", 1.45, 0.0, 2.10),
        ("synthetic-spinel", 1.728, 0.020, 3.64),
        ("ggg", 1.97, 0.038, 7.05),
        ("lithium-niobate", 2.2997, 0.125, 4.64),
        ("paste", 1.6199, 0.030, 3.60),
        ("amethyst", 1.5442, 0.0133, 2.65),
        ("citrine", 1.5442, 0.0133, 2.65),
    ];
    for (name, n, b_g, density) in figures {
        let m = Material::by_name(name).expect("in the catalogue");
        assert!((m.index_d() - n).abs() < 6e-5, "{name}: {}", m.index_d());
        let separation = m.index(lines::G) - m.index(lines::B);
        assert!((separation - b_g).abs() < 6e-5, "{name}: {separation}");
        assert_eq!(m.specific_gravity, Some(density), "{name}");
    }
    for (name, density) in [("cubic-zirconia", 5.8), ("yag", 4.57)] {
        assert_eq!(Material::by_name(name).and_then(|m| m.specific_gravity), Some(density), "{name}");
    }
}

#[test]
fn the_three_colours_of_the_original_project() {
    let rgb = Material::by_name("diamond-rgb").expect("in the catalogue");
    assert_eq!([650.0, 550.0, 450.0].map(|nm| rgb.index(nm)), [2.40, 2.43, 2.46]);
}

#[test]
fn every_material_loses_less_than_all_and_bends_what_it_says() {
    for m in MATERIALS.iter() {
        let n = m.index_d();
        for i in 0..900 {
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
        }
        assert!((unpolarised(0.0, n).0 - 1.0).abs() < 1e-15, "grazing light is reflected whole");
    }
}

#[test]
fn diamond_reflects_and_traps_what_textbooks_say() {
    let n = Material::by_name("diamond").expect("in the catalogue").index_d();
    assert!((unpolarised(1.0, n).0 - 0.17200).abs() < 1e-4);
    assert!((critical_angle_deg(n) - 24.44).abs() < 0.01);
}

#[test]
fn equal_energy_light_is_white() {
    let n = 8 * 512;
    let xyz: Vec3 = (0..n).map(|i| cie::xyz_weight(cie::wavelength((i as f32 + 0.5) / n as f32))).sum();
    let rgb = cie::linear_srgb(xyz / n as f32);
    assert!((rgb - Vec3::ONE).abs().max_element() < 2e-3, "{rgb}");
    assert_eq!(cie::srgb_encode(0.0), 0.0);
    assert!((cie::srgb_encode(1.0) - 1.0).abs() < 1e-6);
}
