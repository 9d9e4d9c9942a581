//! What follows from the axes of a crystal: its optics at a wavelength, its class, and the angle of its optic axes.

use super::birefringence::{Birefringence, OpticSign, OpticalClass};
use super::material::Material;
use crate::optics::crystal::Uniaxial;
use crate::optics::crystal::facet::Crystal;
use crate::optics::dispersion::lines;
use glam::{DMat3, DVec3};

impl Material {
    /// The refractive indices at `nm` of light whose field lies along each of [`Material::principal_axes`].
    pub fn principal_indices(&self, nm: f64) -> [f64; 3] {
        self.principal_axes().map(|(dispersion, _)| dispersion.index(nm))
    }

    /// The crystal at `nm`, its axes in the frame of the stone; none for an isotropic material.
    pub fn crystal_at(&self, nm: f64) -> Option<Crystal> {
        let (indices, axes) = (self.principal_indices(nm), self.orientation.axes());
        match self.crystal.as_ref()? {
            Birefringence::Uniaxial { .. } => Some(Crystal::Uniaxial(Uniaxial {
                ordinary: indices[1],
                extraordinary: indices[2],
                axis: axes.z_axis,
            })),
            Birefringence::Biaxial { .. } => {
                // far from the D line the laws may cross
                let mut order = [0, 1, 2];
                order.sort_by(|a: &usize, b: &usize| indices[*a].total_cmp(&indices[*b]));
                let [a, b, c] = order.map(|i| axes.col(i));
                Some(Crystal::new(order.map(|i| indices[i]), DMat3::from_cols(a, b, c)))
            }
        }
    }

    /// The absorption tensor at `nm`, in the frame of the stone: the sum of n α a aᵀ over the principal axes a, with α
    /// the absorption coefficient, natural logarithm, 1/mm, and n the index of light whose field lies along a.
    pub fn absorption_tensor_at(&self, nm: f64) -> DMat3 {
        let axes = self.orientation.axes();
        let terms = self.principal_axes().map(|(dispersion, absorption)| {
            absorption.map_or(0.0, |absorption| dispersion.index(nm) * absorption.per_mm(nm))
        });
        axes * DMat3::from_diagonal(DVec3::from(terms)) * axes.transpose()
    }

    /// Whether it absorbs light differently along its axes.
    pub fn is_pleochroic(&self) -> bool {
        let [a, b, c] = self.principal_axes().map(|(_, absorption)| absorption);
        a != b || b != c
    }

    /// The optical class, with the sign at the D line.
    pub fn optical_class(&self) -> OpticalClass {
        let [alpha, beta, gamma] = self.principal_indices(lines::D);
        match &self.crystal {
            None => OpticalClass::Isotropic,
            Some(Birefringence::Uniaxial { .. }) => OpticalClass::Uniaxial(OpticSign::new(gamma >= beta)),
            Some(Birefringence::Biaxial { .. }) => {
                OpticalClass::Biaxial(OpticSign::new(half_angle_about_gamma_deg(alpha, beta, gamma) <= 45.0))
            }
        }
    }

    /// The acute angle 2V between the two optic axes of a biaxial crystal at the D line, degrees; none for others.
    pub fn optic_angle_deg(&self) -> Option<f64> {
        let Birefringence::Biaxial { .. } = self.crystal.as_ref()? else { return None };
        let [alpha, beta, gamma] = self.principal_indices(lines::D);
        let half = half_angle_about_gamma_deg(alpha, beta, gamma);
        Some(2.0 * half.min(90.0 - half))
    }

    /// The greatest of the principal indices at the D line less the least.
    pub fn birefringence(&self) -> f64 {
        let indices = self.principal_indices(lines::D);
        let (least, greatest) = indices.iter().fold((f64::MAX, f64::MIN), |(l, g), n| (l.min(*n), g.max(*n)));
        greatest - least
    }
}

/// The angle between γ and an optic axis, degrees: tan² V = (1/α² − 1/β²)/(1/β² − 1/γ²).
///
/// Source: Born & Wolf, *Principles of Optics*, §15.3.1.
fn half_angle_about_gamma_deg(alpha: f64, beta: f64, gamma: f64) -> f64 {
    let [a, b, c] = [alpha, beta, gamma].map(|n| 1.0 / (n * n));
    (a - b).max(0.0).sqrt().atan2((b - c).max(0.0).sqrt()).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::materials::birefringence::CrystalAxis;
    use crate::materials::crystal_orientation::CrystalOrientation;
    use crate::optics::absorption::Absorption;
    use crate::optics::dispersion::Dispersion;

    fn biaxial(alpha: f64, beta: f64, gamma: f64) -> Material {
        let axis = |n| CrystalAxis { dispersion: Dispersion::Constant(n), absorption: None };
        Material::from_index(beta)
            .with_crystal(Birefringence::Biaxial { alpha: axis(alpha), gamma: axis(gamma) })
    }

    /// [D] Equal steps of 1/n² make a right angle; a step below three times that above makes tan² V = 3.
    #[test]
    fn the_angle_of_the_optic_axes_follows_from_the_indices() {
        let of = |x: f64| 1.0 / x.sqrt();
        let right = biaxial(of(0.40), of(0.38), of(0.36));
        assert!((right.optic_angle_deg().expect("biaxial") - 90.0).abs() < 1e-9);
        // 60° from γ to each axis: 120° about γ, 60° about α
        let negative = biaxial(of(0.42), of(0.36), of(0.34));
        assert!((negative.optic_angle_deg().expect("biaxial") - 60.0).abs() < 1e-9);
        assert_eq!(negative.optical_class(), OpticalClass::Biaxial(OpticSign::Negative));
        assert_eq!(Material::from_index(1.5).optical_class(), OpticalClass::Isotropic);
        assert_eq!(Material::from_index(1.5).optic_angle_deg(), None);
        assert_eq!(Material::from_index(1.5).birefringence(), 0.0);
    }

    #[test]
    fn the_tensor_of_absorption_turns_with_the_axes() {
        let stone =
            Material::named("iolite").expect("in the catalogue").with_orientation(CrystalOrientation::ACROSS);
        let [alpha, beta, gamma] = stone.principal_axes();
        let value = |(law, absorption): (&Dispersion, Option<&Absorption>)| {
            law.index(560.0) * absorption.expect("coloured").per_mm(560.0)
        };
        let tensor = stone.absorption_tensor_at(560.0);
        for (axis, principal) in [(DVec3::Z, alpha), (DVec3::Y, beta), (DVec3::X, gamma)] {
            assert!((axis.dot(tensor * axis) - value(principal)).abs() < 1e-12);
        }
        assert!(value(beta) > 5.0 * value(alpha) && stone.is_pleochroic());
        assert_eq!(Material::diamond().absorption_tensor_at(560.0), DMat3::ZERO);
        assert!(Material::diamond().crystal_at(560.0).is_none());
    }
}
