//! The material that a stone is weighed as.

use super::outcome::Failure;
use super::stones::Substance;
use crate::cut::Design;
use crate::math::typed::{self, Unit};
use crate::optics::Material;
use crate::optics::materials::MATERIALS;

/// Refractive indices at the D line that differ by less than this are taken for one material's: designs
/// state them to two decimals, and a stone's own varies by about as much.
const NEAR: f64 = 0.01;

/// A material to weigh by, or why there is none.
#[derive(Debug)]
pub struct Weight {
    material: Option<Material>,
    /// The bare index that the material was found by.
    index: Option<f64>,
}

impl Weight {
    /// The material asked for; of a bare index the known material nearest to it; else diamond.
    pub fn of(substance: &Substance, design: &Design) -> Weight {
        if let Some(material) = substance.material {
            return Weight { material: Some(material.clone()), index: None };
        }
        let index = substance.ri.or(design.refractive_index);
        let material = match index {
            None => Some(MATERIALS[0]),
            Some(n) => nearest(n),
        };
        Weight { material: material.cloned(), index }
    }

    /// The weight of a volume in carats, if a density is known.
    pub fn carats(&self, volume_mm3: f64) -> Option<f64> {
        self.material.as_ref()?.carats(volume_mm3)
    }

    /// The girdle width in millimetres of a stone of the design's shape that weighs `carats`.
    pub fn width_mm(&self, design: &Design, carats: f64) -> Result<f64, Failure> {
        let solid = design.solid()?;
        let of_one_mm3 = self.carats(1.0).ok_or_else(|| {
            let why = self.note().unwrap_or_else(|| "the material's density is not known".into());
            Failure::input(format!("--carat {carats}: {why}"))
        })?;
        Ok(solid.width() * (carats / of_one_mm3 / solid.volume()).cbrt())
    }

    /// The material's name.
    pub fn name(&self) -> Option<String> {
        self.material.as_ref().map(|m| m.name.to_string())
    }

    /// Whether the stone is of diamond, for which alone grading proportions are published.
    pub fn is_diamond(&self) -> bool {
        let diamond = MATERIALS[0];
        self.material.as_ref().is_some_and(|m| {
            m.specific_gravity == diamond.specific_gravity && (m.index_d() - diamond.index_d()).abs() < NEAR
        })
    }

    /// What the reader must know about the weight.
    pub fn note(&self) -> Option<String> {
        let n = self.index?;
        Some(match &self.material {
            Some(material) => format!("n = {n} is nearest to {}; --material NAME decides", material.name),
            None => format!("no material of n = {n} is known: --material NAME gives the weight"),
        })
    }
}

/// The material of known density whose index is nearest to `n`.
fn nearest(n: f64) -> Option<&'static Material> {
    let off = |m: &Material| (m.index_d() - n).abs();
    let known = MATERIALS.iter().copied().filter(|m| m.specific_gravity.is_some() && off(m) <= NEAR);
    known.min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// Value parser of `--carat`.
pub fn carats(text: &str) -> Result<f64, String> {
    typed::within(text, Unit::Carats, 1e-6..=1e6, "a weight is a number of carats")
}
