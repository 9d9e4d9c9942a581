//! Pleochroism: the colour of a material along each axis.

use super::birefringence::Birefringence;
use super::material::Material;
use crate::color::Illuminant;
use crate::color::cielab::Lab;
use crate::optics::dispersion::lines;
use glam::Vec3;

/// The colour of light whose field lies along one axis of a crystal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisColour {
    /// `o` or `e`, `alpha`, `beta` or `gamma`; `all` of an isotropic material.
    pub axis: &'static str,
    /// Refractive index at the D line.
    pub index_d: f64,
    /// CIELAB, against the light itself.
    pub lab: Lab,
    /// Linear sRGB, adapted so that the light itself is white; components beyond 0 to 1 cannot be shown.
    pub linear_srgb: Vec3,
}

impl Material {
    /// The colour along each axis that differs: light of `illuminant` through `mm` of the material, its field along the
    /// axis; what facets reflect is not counted.
    ///
    /// ```
    /// use cutlab::{Illuminant, Material};
    ///
    /// let [o, e] = Material::named("green-tourmaline")?.axis_colours(&Illuminant::daylight(), 5.0)[..] else { panic!() };
    /// assert!(o.axis == "o" && o.lab.l < e.lab.l); // darker across the axis
    /// # Ok::<(), cutlab::Error>(())
    /// ```
    pub fn axis_colours(&self, illuminant: &Illuminant, mm: f64) -> Vec<AxisColour> {
        let axes = self.principal_axes();
        let named: &[(&'static str, usize)] = match &self.crystal {
            None => &[("all", 0)],
            Some(Birefringence::Uniaxial { .. }) => &[("o", 0), ("e", 2)],
            Some(Birefringence::Biaxial { .. }) => &[("alpha", 0), ("beta", 1), ("gamma", 2)],
        };
        let white = illuminant.xyz(|_| 1.0);
        let colour = |(axis, i): &(&'static str, usize)| {
            let (dispersion, absorption) = axes[*i];
            let left = |nm: f32| absorption.map_or(1.0, |a| (-mm * a.per_mm(f64::from(nm))).exp() as f32);
            AxisColour {
                axis,
                index_d: dispersion.index(lines::D),
                lab: Lab::new(illuminant.xyz(left), white),
                linear_srgb: illuminant.linear_srgb(left),
            }
        };
        named.iter().map(colour).collect()
    }
}
