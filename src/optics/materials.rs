//! The catalogue of materials, one a file.

mod corundum;
mod cubic_zirconia;
mod diamond;
mod diamond_rgb;
mod moissanite;
mod quartz;

use super::dispersion::{Dispersion, lines};
use std::borrow::Cow;

/// What a stone is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The name on the command line.
    pub name: Cow<'static, str>,
    /// One line for people.
    pub about: &'static str,
    /// Where the figures are from.
    pub source: &'static str,
    /// Index against wavelength; for a uniaxial crystal the ordinary ray.
    pub dispersion: Dispersion,
    /// Wavelengths for which the law was measured, µm.
    pub valid_um: (f64, f64),
    /// Mass per volume, g/cm³; none for a bare index.
    pub specific_gravity: Option<f64>,
}

/// Every material, by name.
pub static MATERIALS: &[&Material] = &[
    &diamond::DIAMOND,
    &diamond_rgb::DIAMOND_RGB,
    &corundum::CORUNDUM,
    &quartz::QUARTZ,
    &moissanite::MOISSANITE,
    &cubic_zirconia::CUBIC_ZIRCONIA,
];

impl Material {
    /// The material called `name`, or none.
    pub fn named(name: &str) -> Option<&'static Material> {
        MATERIALS.iter().copied().find(|m| m.name == name)
    }

    /// A material known by one index alone, without dispersion or weight.
    pub fn of_index(n: f64) -> Material {
        Material {
            name: format!("n={n}").into(),
            about: "one refractive index, no dispersion",
            source: "given",
            dispersion: Dispersion::Constant(n),
            valid_um: (0.0, f64::INFINITY),
            specific_gravity: None,
        }
    }

    /// Refractive index at `um` (µm).
    pub fn index(&self, um: f64) -> f64 {
        self.dispersion.index(um)
    }

    /// The index at the sodium D line, by which stones are known.
    pub fn index_d(&self) -> f64 {
        self.index(lines::D)
    }

    /// Whether the index changes with wavelength.
    pub fn is_dispersive(&self) -> bool {
        self.index(lines::B) != self.index(lines::G)
    }

    /// Mass in carats of `volume_mm3`, if the material's weight is known.
    pub fn carats(&self, volume_mm3: f64) -> Option<f64> {
        self.specific_gravity.map(|sg| volume_mm3 * sg / 200.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_has_a_source_and_falls_with_wavelength_over_its_range() {
        for m in MATERIALS {
            assert!(!m.source.is_empty() && !m.about.is_empty(), "{}", m.name);
            let (from, to) = (m.valid_um.0.max(0.38), m.valid_um.1.min(0.73));
            let n: Vec<f64> = (0..=100).map(|i| m.index(from + (to - from) * f64::from(i) / 100.0)).collect();
            assert!(n.iter().all(|n| *n > 1.0), "{}", m.name);
            assert!(n.windows(2).all(|w| w[1] <= w[0]), "{}", m.name);
        }
    }

    /// Index at D and B–G separation as listed in the project's sources.
    #[test]
    fn indices_and_dispersions_match_the_published_ones() {
        for (name, n_d, b_g, tolerance) in [
            ("diamond", 2.41726, 0.04444, 5e-5),
            ("corundum", 1.76808, 0.0181, 6e-5),
            ("quartz", 1.54421, 0.0133, 6e-5),
            ("moissanite", 2.64743, 0.112, 6e-4),
            ("cubic-zirconia", 2.15846, 0.0604, 6e-5),
        ] {
            let m = Material::named(name).expect("in the catalogue");
            assert!((m.index_d() - n_d).abs() < 2e-5, "{name}: {}", m.index_d());
            let separation = m.index(lines::G) - m.index(lines::B);
            assert!((separation - b_g).abs() < tolerance, "{name}: {separation}");
        }
    }
}
