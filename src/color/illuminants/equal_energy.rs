//! Equal energy: the light of the pictures.

use super::{Illuminant, SpectralPower};

/// Equal power per nm.
pub static EQUAL_ENERGY: Illuminant = Illuminant {
    name: "E",
    about: "equal energy at every wavelength; the light of the scenes",
    source: "its definition",
    spectrum: SpectralPower::Equal,
};
