//! A material: dispersion, absorption, density, and where the figures are from.

use super::birefringence::{Birefringence, CrystalAxis};
use super::crystal_orientation::CrystalOrientation;
use crate::optics::absorption::Absorption;
use crate::optics::dispersion::{Dispersion, lines};
use std::borrow::Cow;

/// What a stone is made of.
///
/// ```
/// use cutlab::Material;
///
/// let quartz = Material::named("quartz")?;
/// assert!((quartz.index_d() - 1.544).abs() < 1e-3 && quartz.is_clear());
/// assert_eq!(Material::from_index(1.62).index(450.0), 1.62);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Material {
    /// The name on the command line.
    pub name: Cow<'static, str>,
    /// One line for people.
    pub about: Cow<'static, str>,
    /// Where the figures are from.
    pub source: Cow<'static, str>,
    /// Index against wavelength: the ordinary ray's of a uniaxial crystal, n_β of a biaxial one. Light is traced with it.
    pub dispersion: Dispersion,
    /// The other indices of a crystal that refracts doubly, and what it absorbs along their axes; none for an isotropic
    /// material. Light is not traced with them yet.
    pub crystal: Option<Birefringence>,
    /// How the axes of the crystal lie in the stone.
    pub orientation: CrystalOrientation,
    /// Wavelengths for which the law was measured, nm.
    pub valid_nm: (f64, f64),
    /// Mass per volume, g/cm³; none for a bare index.
    pub specific_gravity: Option<f64>,
    /// What it absorbs; none if it is clear. Of a uniaxial crystal that of light whose field lies across the axis, of a
    /// biaxial one along β; of all light where [`Material::crystal`] has no other.
    pub absorption: Option<Absorption>,
    /// The file that it was read from, as it was named; none for the catalogue's.
    pub file: Option<String>,
}

impl Material {
    /// A material known by one index alone, without dispersion, colour or weight.
    pub fn from_index(n: f64) -> Material {
        Material {
            name: format!("n={n}").into(),
            about: "one refractive index, no dispersion".into(),
            source: "given".into(),
            dispersion: Dispersion::Constant(n),
            crystal: None,
            orientation: CrystalOrientation::default(),
            valid_nm: (0.0, f64::INFINITY),
            specific_gravity: None,
            absorption: None,
            file: None,
        }
    }

    /// The same material, of another name.
    pub fn with_name(mut self, name: impl Into<Cow<'static, str>>) -> Material {
        self.name = name.into();
        self
    }

    /// The same material, isotropic, of this law of dispersion.
    pub fn with_dispersion(mut self, dispersion: Dispersion) -> Material {
        self.dispersion = dispersion;
        self.crystal = None;
        self
    }

    /// The same material, which absorbs so along every axis.
    pub fn with_absorption(mut self, absorption: Absorption) -> Material {
        self.absorption = Some(absorption);
        self.crystal.iter_mut().for_each(Birefringence::forget_absorption);
        self
    }

    /// The same material, as a crystal that refracts doubly.
    pub fn with_crystal(mut self, crystal: Birefringence) -> Material {
        self.crystal = Some(crystal);
        self
    }

    /// The same material, with the axes of its crystal turned so.
    pub fn with_orientation(mut self, orientation: CrystalOrientation) -> Material {
        self.orientation = orientation;
        self
    }

    /// What names it on a command line: its file, or its name in the catalogue.
    pub fn argument(&self) -> &str {
        self.file.as_deref().unwrap_or(&self.name)
    }

    /// Refractive index at `nm`.
    pub fn index(&self, nm: f64) -> f64 {
        self.dispersion.index(nm)
    }

    /// The index at the sodium D line, by which stones are known.
    pub fn index_d(&self) -> f64 {
        self.index(lines::D)
    }

    /// Whether the index changes with wavelength.
    pub fn is_dispersive(&self) -> bool {
        self.index(lines::B) != self.index(lines::G)
    }

    /// What is said of wavelengths in nm at which the index is a guess; none if `from`..=`to` lies
    /// within what was measured.
    pub fn extrapolated(&self, from: f64, to: f64) -> Option<String> {
        let (least, greatest) = self.valid_nm;
        let below = (from < least).then(|| format!("below {least:.0} nm"));
        let above = (to > greatest).then(|| format!("above {greatest:.0} nm"));
        let places: Vec<String> = below.into_iter().chain(above).collect();
        (!places.is_empty()).then(|| format!("index of {} extrapolated {}", self.name, places.join(" and ")))
    }

    /// The dispersion and the absorption of light whose field lies along each principal axis, in the order of
    /// [`CrystalOrientation`]: α, β, γ; of a uniaxial crystal twice the ordinary one and the extraordinary one; thrice the
    /// same of an isotropic material.
    pub fn principal_axes(&self) -> [(&Dispersion, Option<&Absorption>); 3] {
        let own = (&self.dispersion, self.absorption.as_ref());
        match &self.crystal {
            None => [own; 3],
            Some(Birefringence::Uniaxial { extraordinary }) => [own, own, self.along(extraordinary)],
            Some(Birefringence::Biaxial { alpha, gamma }) => [self.along(alpha), own, self.along(gamma)],
        }
    }

    fn along<'a>(&'a self, axis: &'a CrystalAxis) -> (&'a Dispersion, Option<&'a Absorption>) {
        (&axis.dispersion, axis.absorption.as_ref().or(self.absorption.as_ref()))
    }

    /// Whether it absorbs nothing, along any axis.
    pub fn is_clear(&self) -> bool {
        self.principal_axes().iter().all(|(_, absorption)| absorption.is_none())
    }

    /// Absorption coefficient at `nm`, natural logarithm, 1/mm: that of [`Material::absorption`].
    pub fn absorption_per_mm(&self, nm: f64) -> f64 {
        self.absorption.as_ref().map_or(0.0, |a| a.per_mm(nm))
    }

    /// Mass in carats of `volume_mm3`, if the material's weight is known.
    pub fn carats(&self, volume_mm3: f64) -> Option<f64> {
        self.specific_gravity.map(|sg| volume_mm3 * sg / 200.0)
    }
}
