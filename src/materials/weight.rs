//! The material that a stone is weighed as.

use super::Material;
use super::NEAR;

/// A material to weigh by, or why there is none.
#[derive(Debug, Clone)]
pub struct Weight {
    material: Option<Material>,
    /// The bare index that the material was found by.
    index: Option<f64>,
}

impl Weight {
    /// The stone's own material; of a bare index the known material nearest to it.
    pub fn new(material: &Material) -> Weight {
        match material.bare_index() {
            Some(n) => Weight { material: nearest(n).cloned(), index: Some(n) },
            None => Weight { material: Some(material.clone()), index: None },
        }
    }

    /// The weight of a volume in carats, if a density is known.
    pub fn carats(&self, volume_mm3: f64) -> Option<f64> {
        self.material.as_ref()?.carats(volume_mm3)
    }

    /// The volume in mm³ that weighs `carats`, or why it is not known.
    pub fn volume_mm3(&self, carats: f64) -> Result<f64, String> {
        let of_one_mm3 = self.carats(1.0);
        let why = || self.note().unwrap_or_else(|| "the material's density is not known".into());
        of_one_mm3.map(|each| carats / each).ok_or_else(why)
    }

    /// The name of the material that is weighed by, if there is one.
    pub fn name(&self) -> Option<String> {
        self.material.as_ref().map(|m| m.name.to_string())
    }

    /// Whether the stone is of diamond, for which alone grading proportions are published.
    pub fn is_diamond(&self) -> bool {
        let diamond = Material::diamond();
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
    Material::near(n).into_iter().find(|m| m.specific_gravity.is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bare_index_is_weighed_as_the_material_that_has_it() {
        let of = |n: f64| Weight::new(&Material::from_index(n));
        assert_eq!(of(1.544).name().as_deref(), Some("quartz"));
        let carats = of(1.544).carats(200.0).expect("quartz has a density");
        assert!((carats - 2.65).abs() < 0.005, "{carats}");
        assert!(of(1.544).note().is_some_and(|said| said.contains("nearest to quartz")));
        assert_eq!((of(3.5).name(), of(3.5).carats(1.0)), (None, None));
        assert!(of(3.5).note().is_some_and(|said| said.starts_with("no material of n = 3.5 is known")));
        assert!(of(3.5).volume_mm3(1.0).is_err_and(|why| why.contains("n = 3.5")));
        let diamond = Weight::new(Material::diamond());
        assert!(diamond.is_diamond() && diamond.note().is_none() && !of(1.544).is_diamond());
        assert!((diamond.volume_mm3(3.52).expect("known") - 200.0).abs() < 0.5);
    }
}
