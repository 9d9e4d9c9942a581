//! The catalogue of illuminants, one TOML file each, and the reader of those that users bring: light by which
//! colours are judged.

mod daylight_series;
mod illuminant;
mod illuminant_file;

use crate::parse;
pub use illuminant::{Illuminant, SpectralPower};
use std::sync::{Arc, LazyLock};

/// Every file: its name and its text.
const FILES: [(&str, &str); 4] = [
    ("D65", include_str!("illuminants/d65.toml")),
    ("A", include_str!("illuminants/a.toml")),
    ("D50", include_str!("illuminants/d50.toml")),
    ("E", include_str!("illuminants/e.toml")),
];

/// Every illuminant. A file that cannot be read has none; a test keeps that from happening.
pub static ILLUMINANTS: LazyLock<Vec<Arc<Illuminant>>> = LazyLock::new(|| {
    let no_table = |_: &str| Err("an illuminant of the catalogue has no other file".into());
    FILES
        .iter()
        .filter_map(|(name, text)| Illuminant::parse(name, text, &no_table).ok().map(Arc::new))
        .collect()
});

impl Illuminant {
    /// The illuminant called `name`, or none.
    pub fn by_name(name: &str) -> Option<Arc<Illuminant>> {
        ILLUMINANTS.iter().find(|i| parse::is_name(&i.name, name)).cloned()
    }

    /// CIE standard illuminant D65, daylight.
    pub fn daylight() -> Arc<Illuminant> {
        Illuminant::by_name("D65").unwrap_or_else(Illuminant::equal_energy)
    }

    /// Light of the same power at every wavelength.
    pub fn equal_energy() -> Arc<Illuminant> {
        Illuminant::by_name("E").unwrap_or_else(|| Arc::new(Illuminant::new("E", SpectralPower::Equal)))
    }

    /// Luminance of the spectrum as [`Illuminant::power`] gives it, over that of equal-energy light
    /// of power 1.
    pub fn luminance(&self) -> f32 {
        Self::equal_energy().xyz(|nm| self.power(nm)).y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_is_an_illuminant_of_its_name() {
        let read: Vec<&str> = ILLUMINANTS.iter().map(|i| i.name.as_ref()).collect();
        assert_eq!(read, FILES.map(|(name, _)| name));
        assert!(ILLUMINANTS.iter().all(|i| !i.about.is_empty() && !i.source.is_empty()));
        assert_eq!(Illuminant::equal_energy().spectrum, SpectralPower::Equal);
    }
}
