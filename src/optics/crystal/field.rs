//! Complex vectors: fields and wave vectors of waves that may die away.

use glam::DVec3;
use nalgebra::Complex;
use std::ops::{Add, Mul, Sub};

/// A complex number.
pub type C = Complex<f64>;

/// A complex vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Real part.
    pub re: DVec3,
    /// Imaginary part.
    pub im: DVec3,
}

impl From<DVec3> for Field {
    fn from(re: DVec3) -> Field {
        Field { re, im: DVec3::ZERO }
    }
}

impl Field {
    /// The product of the components, summed; nothing is conjugated.
    pub fn dot(self, other: Field) -> C {
        C::new(self.re.dot(other.re) - self.im.dot(other.im), self.re.dot(other.im) + self.im.dot(other.re))
    }

    /// The component along a real vector.
    pub fn along(self, axis: DVec3) -> C {
        C::new(self.re.dot(axis), self.im.dot(axis))
    }

    /// The cross product; nothing is conjugated.
    pub fn cross(self, other: Field) -> Field {
        Field {
            re: self.re.cross(other.re) - self.im.cross(other.im),
            im: self.re.cross(other.im) + self.im.cross(other.re),
        }
    }

    /// The complex conjugate.
    pub fn conj(self) -> Field {
        Field { re: self.re, im: -self.im }
    }

    /// The sum of the squared sizes of the components.
    pub fn norm_squared(self) -> f64 {
        self.re.length_squared() + self.im.length_squared()
    }
}

impl Mul<Field> for C {
    type Output = Field;

    fn mul(self, field: Field) -> Field {
        Field { re: self.re * field.re - self.im * field.im, im: self.re * field.im + self.im * field.re }
    }
}

impl Mul<Field> for f64 {
    type Output = Field;

    fn mul(self, field: Field) -> Field {
        Field { re: self * field.re, im: self * field.im }
    }
}

impl Add for Field {
    type Output = Field;

    fn add(self, other: Field) -> Field {
        Field { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Field {
    type Output = Field;

    fn sub(self, other: Field) -> Field {
        Field { re: self.re - other.re, im: self.im - other.im }
    }
}
