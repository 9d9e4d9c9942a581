//! Waves in a uniaxial crystal, in closed form.

use super::field::{C, Field};
use super::wave::{Side, Wave};
use glam::DVec3;

/// A uniaxial crystal at one wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uniaxial {
    /// Refractive index of the ordinary wave.
    pub ordinary: f64,
    /// Refractive index of the extraordinary wave across the axis.
    pub extraordinary: f64,
    /// The optic axis: unit.
    pub axis: DVec3,
}

/// Squared sine between a wave vector and the axis below which they are one direction.
const ALONG_AXIS: f64 = 1e-24;

impl Uniaxial {
    /// The ordinary and the extraordinary wave that go to one side of a facet.
    ///
    /// - `along`: the part of their wave vectors along the facet, in units of ω/c
    /// - `normal`: unit, out of the crystal
    pub fn waves(&self, along: DVec3, normal: DVec3, side: Side) -> [Wave; 2] {
        let wave = |xi: C, field: fn(&Uniaxial, Field) -> Field| {
            let k = Field { re: along + xi.re * normal, im: xi.im * normal };
            Wave::new(k, field(self, k), normal)
        };
        [
            wave(self.ordinary_root(along, side), Uniaxial::ordinary_field),
            wave(self.extraordinary_root(along, normal, side), Uniaxial::extraordinary_field),
        ]
    }

    /// A wave that travels, by its wave vector and mode, 0 ordinary and 1 extraordinary; of any size.
    pub fn wave_along(&self, k: DVec3, mode: usize) -> Wave {
        let field =
            if mode == 0 { self.ordinary_field(k.into()) } else { self.extraordinary_field(k.into()) };
        Wave::new(k.into(), field, k.normalize())
    }

    /// The waves of one direction: of wave vectors along a unit vector, the ordinary and the extraordinary one, their fields of
    /// any size.
    pub fn index_along(&self, direction: DVec3) -> [f64; 2] {
        let cos = direction.dot(self.axis);
        let [o2, e2] = [self.ordinary, self.extraordinary].map(|n| n * n);
        [self.ordinary, (cos * cos / o2 + (1.0 - cos * cos) / e2).sqrt().recip()]
    }

    /// The part along the normal of the ordinary wave's vector: ξ² = n_o² − q².
    fn ordinary_root(&self, along: DVec3, side: Side) -> C {
        real_or_imaginary(self.ordinary * self.ordinary - along.length_squared(), side)
    }

    /// That of the extraordinary wave: a ξ² + b ξ + d = 0. The sign of the root is that of the energy's way.
    fn extraordinary_root(&self, along: DVec3, normal: DVec3, side: Side) -> C {
        let [o2, e2] = [self.ordinary, self.extraordinary].map(|n| n * n);
        let g = 1.0 / o2 - 1.0 / e2;
        let (nc, qc) = (normal.dot(self.axis), along.dot(self.axis));
        let a = 1.0 / e2 + g * nc * nc;
        let half_b = g * qc * nc;
        let d = along.length_squared() / e2 + g * qc * qc - 1.0;
        (real_or_imaginary(half_b * half_b - a * d, side) - half_b) / a
    }

    /// E_o ∝ K × c.
    fn ordinary_field(&self, k: Field) -> Field {
        let across = k.cross(self.axis.into());
        if across.norm_squared() > ALONG_AXIS * k.norm_squared() {
            across
        } else {
            self.axis.any_orthonormal_vector().into()
        }
    }

    /// E_e ∝ n_o² c − (K·c) K, which is (n_o²/n_e²) K⊥² c − (K·c) K⊥ with K⊥ the part of K across c.
    fn extraordinary_field(&self, k: Field) -> Field {
        let axis = self.axis;
        let kc = k.along(axis);
        let across = k - kc * Field::from(axis);
        if across.norm_squared() > ALONG_AXIS * k.norm_squared() {
            let ratio = self.ordinary / self.extraordinary;
            ratio * ratio * across.dot(across) * Field::from(axis) - kc * across
        } else {
            // across the ordinary wave's field, and that of the same wave vector
            axis.cross(axis.any_orthonormal_vector()).into()
        }
    }
}

/// The root of a real number; its sign is that of the side, and of a root that is imaginary that of its decay.
fn real_or_imaginary(square: f64, side: Side) -> C {
    if square >= 0.0 {
        C::new(side.sign() * square.sqrt(), 0.0)
    } else {
        C::new(0.0, side.sign() * (-square).sqrt())
    }
}
