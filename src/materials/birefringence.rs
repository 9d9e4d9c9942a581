//! Materials that refract doubly: their indices and absorption by axis, and the classes of crystals.

use crate::optics::absorption::Absorption;
use crate::optics::dispersion::Dispersion;
use std::fmt;

/// What a crystal has beside the dispersion and the absorption of its [`Material`](super::Material).
#[derive(Debug, Clone, PartialEq)]
pub enum Birefringence {
    /// One optic axis. The material's own dispersion is that of the ordinary ray.
    Uniaxial {
        /// Of light whose field lies along the axis.
        extraordinary: CrystalAxis,
    },
    /// Two optic axes. The material's own dispersion is n_β.
    Biaxial {
        /// Of light whose field lies along the axis of the least index.
        alpha: CrystalAxis,
        /// Of light whose field lies along the axis of the greatest.
        gamma: CrystalAxis,
    },
}

/// A principal axis of a crystal: how light is refracted and absorbed whose electric field lies along it.
#[derive(Debug, Clone, PartialEq)]
pub struct CrystalAxis {
    /// Index against wavelength.
    pub dispersion: Dispersion,
    /// What it absorbs; none if that is the material's own.
    pub absorption: Option<Absorption>,
}

/// The optical class of a material with its sign.
///
/// ```
/// use cutlab::Material;
///
/// assert_eq!(Material::named("quartz")?.optical_class().to_string(), "uniaxial +");
/// assert_eq!(Material::named("iolite")?.optical_class().to_string(), "biaxial −");
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpticalClass {
    /// One index.
    Isotropic,
    /// One optic axis: positive if the extraordinary index is the greater.
    Uniaxial(OpticSign),
    /// Two optic axes: positive if γ halves the acute angle between them.
    Biaxial(OpticSign),
}

/// The optic sign of a crystal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpticSign {
    /// +
    Positive,
    /// −
    Negative,
}

impl Birefringence {
    /// Takes away what the axes absorb by themselves.
    pub fn forget_absorption(&mut self) {
        match self {
            Birefringence::Uniaxial { extraordinary } => extraordinary.absorption = None,
            Birefringence::Biaxial { alpha, gamma } => {
                alpha.absorption = None;
                gamma.absorption = None;
            }
        }
    }
}

impl OpticSign {
    /// Positive or negative.
    pub fn new(is_positive: bool) -> OpticSign {
        if is_positive { OpticSign::Positive } else { OpticSign::Negative }
    }
}

impl fmt::Display for OpticSign {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(if *self == OpticSign::Positive { "+" } else { "−" })
    }
}

impl fmt::Display for OpticalClass {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            OpticalClass::Isotropic => f.write_str("isotropic"),
            OpticalClass::Uniaxial(sign) => write!(f, "uniaxial {sign}"),
            OpticalClass::Biaxial(sign) => write!(f, "biaxial {sign}"),
        }
    }
}
