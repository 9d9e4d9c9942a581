//! The catalogue of materials, one TOML file each, and the reader of materials that users bring.

mod absorption_entry;
mod axis_colours;
mod birefringence;
mod catalogue;
mod crystal_entry;
mod crystal_figures;
mod crystal_orientation;
mod index_entry;
mod material;
pub mod material_file;
#[cfg(feature = "files")]
mod open;
pub mod weight;

use crate::limits::Limits;
use crate::optics::dispersion::Dispersion;
use crate::parse;
pub use axis_colours::AxisColour;
pub use birefringence::{Birefringence, CrystalAxis, OpticSign, OpticalClass};
pub use catalogue::{MATERIAL_FILES, MATERIALS};
pub use crystal_orientation::{CrystalOrientation, CrystalOrientationError};
pub use material::Material;
#[cfg(feature = "files")]
use std::path::Path;

/// Refractive indices at the D line that differ by less than this are taken for one material's: designs
/// state them to two decimals, and a stone's own varies by about as much.
pub const NEAR: f64 = 0.01;

/// Whether a material's name is that of a file, whatever the catalogue has: it has a `/` or ends in `.toml`.
pub fn is_path(name: &str) -> bool {
    name.contains(['/', std::path::MAIN_SEPARATOR]) || name.to_lowercase().ends_with(".toml")
}

/// A name that no material has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no material is called '{name}'{} (all: cutlab list materials)", parse::did_you_mean(.nearest.as_deref()))]
pub struct NoSuchMaterial {
    /// The name.
    pub name: String,
    /// The material that is probably meant.
    pub nearest: Option<String>,
}

impl Material {
    /// The material that `argument` names: one of the catalogue, or a TOML file; a path is never a name of the
    /// catalogue. The error suggests a name that is near, or says where in the file what was expected and found.
    pub fn open(argument: &str, limits: Limits) -> Result<Material, String> {
        if !is_path(argument)
            && let Some(material) = Material::by_name(argument)
        {
            return Ok(material.clone());
        }
        #[cfg(feature = "files")]
        if is_path(argument) || Path::new(argument).is_file() {
            return Material::read(Path::new(argument), argument, false, limits).map_err(|e| e.to_string());
        }
        let _ = limits;
        Material::named(argument).map_err(|e| e.to_string())
    }

    /// The material called `name`, of which the error says that there is none and which is near.
    ///
    /// ```
    /// let ruby = cutlab::Material::named("ruby")?;
    /// assert!((ruby.index_d() - 1.768).abs() < 1e-3 && !ruby.is_clear());
    /// # Ok::<(), cutlab::Error>(())
    /// ```
    pub fn named(name: &str) -> Result<Material, NoSuchMaterial> {
        let near = || parse::nearest_name(name, MATERIALS.iter().map(|m| m.name.as_ref()));
        Material::by_name(name)
            .cloned()
            .ok_or_else(|| NoSuchMaterial { name: name.into(), nearest: near().map(str::to_owned) })
    }

    /// The material called `name`, or none.
    pub fn by_name(name: &str) -> Option<&'static Material> {
        MATERIALS.iter().find(|m| parse::is_name(&m.name, name))
    }

    /// Diamond, which a stone is taken to be of where nobody says otherwise.
    pub fn diamond() -> &'static Material {
        catalogue::diamond()
    }

    /// The index of a material of which nothing else is known ([`Material::from_index`]).
    pub fn bare_index(&self) -> Option<f64> {
        let Dispersion::Constant(n) = self.dispersion else { return None };
        (*self == Material::from_index(n)).then_some(n)
    }

    /// The known materials whose index at the D line is `n`, or near enough to be meant by it ([`NEAR`]), the
    /// nearest first; without those that are seldom cut.
    pub fn near(n: f64) -> Vec<&'static Material> {
        let off = |m: &Material| (m.index_d() - n).abs();
        let mut known: Vec<&Material> = MATERIALS
            .iter()
            .filter(|m| off(m) <= NEAR && !catalogue::RARE.contains(&m.name.as_ref()))
            .collect();
        known.sort_by(|a, b| off(a).total_cmp(&off(b)));
        known
    }

    /// Why there are no colours where a material without dispersion is lit, and what can be done about it.
    pub fn no_dispersion(&self) -> String {
        let Some(n) = self.bare_index() else {
            return format!("no dispersion is known of {}", self.name);
        };
        let near = Material::near(n).into_iter().filter(|m| m.is_dispersive());
        let names: Vec<&str> = near.map(|m| m.name.as_ref()).collect();
        let names = if names.is_empty() { "no material is known".into() } else { names.join(", ") };
        format!("no dispersion is known of a bare index: --material NAME gives one (n = {n}: {names})")
    }

    /// The material of a stone of which at most an index is known: that index alone, or diamond.
    pub fn drawn_for(index: Option<f64>) -> Material {
        index.map_or_else(|| Material::diamond().clone(), Material::from_index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::dispersion::lines;

    #[test]
    fn every_file_is_a_material_of_its_name() {
        for (name, text) in MATERIAL_FILES {
            assert_eq!(catalogue::read(name, text).map(|m| m.name.to_string()).as_deref(), Ok(*name));
        }
        assert_eq!(MATERIALS.len(), MATERIAL_FILES.len());
        assert_eq!(Material::diamond().name, "diamond");
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/materials");
        let files = std::fs::read_dir(folder).expect("the folder is there");
        let files =
            files.filter(|f| f.as_ref().is_ok_and(|f| f.path().extension().is_some_and(|e| e == "toml")));
        assert_eq!(files.count(), MATERIAL_FILES.len(), "a file is missing in the catalogue");
    }

    #[test]
    fn every_material_has_a_source_and_falls_with_wavelength_over_its_range() {
        for m in MATERIALS.iter() {
            assert!(!m.source.is_empty() && !m.about.is_empty(), "{}", m.name);
            let (from, to) = (m.valid_nm.0.max(380.0), m.valid_nm.1.min(730.0));
            for (law, _) in m.principal_axes() {
                let n: Vec<f64> =
                    (0..=100).map(|i| law.index(from + (to - from) * f64::from(i) / 100.0)).collect();
                assert!(n.iter().all(|n| *n > 1.0), "{}", m.name);
                assert!(n.windows(2).all(|w| w[1] <= w[0]), "{}", m.name);
            }
        }
    }

    #[test]
    fn every_absorption_says_what_it_is_and_lets_some_light_pass() {
        let mut coloured = 0;
        for (m, a) in MATERIALS.iter().flat_map(|m| m.principal_axes().map(|(_, a)| (m, a))) {
            let Some(a) = a else { continue };
            coloured += 1;
            assert!(!m.is_clear() && !a.source.is_empty() && !a.about.is_empty(), "{}", m.name);
            let spectrum: Vec<f64> = (380..=780).map(|nm| a.per_mm(f64::from(nm))).collect();
            assert!(spectrum.iter().all(|a| *a >= 0.0 && *a < 5.0), "{}", m.name);
            let (least, most) = spectrum.iter().fold((f64::MAX, 0f64), |(l, m), a| (l.min(*a), m.max(*a)));
            // of some light more than a third passes 5 mm
            assert!(least < 0.22 && most > 2.0 * least, "{}: {least} {most}", m.name);
        }
        assert!(coloured >= 60);
    }

    #[test]
    fn a_guess_is_called_one() {
        let said = |name: &str, from, to| Material::by_name(name).and_then(|m| m.extrapolated(from, to));
        let note = said("strontium-titanate", 380.0, 730.0);
        assert_eq!(note.as_deref(), Some("index of strontium-titanate extrapolated below 430 nm"));
        assert_eq!(said("strontium-titanate", lines::G, lines::B), None);
        let note = said("topaz", 380.0, 730.0);
        assert_eq!(note.as_deref(), Some("index of topaz extrapolated below 431 nm and above 687 nm"));
        assert_eq!(said("diamond", 380.0, 730.0), None);
    }
}
