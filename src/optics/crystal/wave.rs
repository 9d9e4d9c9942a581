//! A plane wave in a crystal, and waves by the part of their wave vector along a facet.

use super::field::{C, Field};
use glam::DVec3;

/// Waves that carry less than this through a facet, for fields of size 1, graze it: they count as dying away.
const GRAZING: f64 = 1e-13;

/// To which side of a facet a wave goes: its energy if it travels, else the side on which it dies away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// With the facet's normal.
    Outward,
    /// Against it.
    Inward,
}

impl Side {
    /// 1 outward, −1 inward.
    pub fn sign(self) -> f64 {
        match self {
            Side::Outward => 1.0,
            Side::Inward => -1.0,
        }
    }
}

/// A plane wave of one mode, at a facet.
///
/// Wave vectors are in units of ω/c, so that the size of a real one is the wave's refractive index; H = K × E. Fields of a
/// wave that travels are scaled to a power of 1 through the facet, ½ |Re(E × H*)·N| = 1: squared sizes of amplitudes are
/// shares of power then. Those of one that dies away have size 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// The wave vector.
    pub k: Field,
    /// The electric field.
    pub e: Field,
    /// The magnetic field, K × E.
    pub h: Field,
    /// The direction in which its energy goes, unit; the zero vector for a wave that dies away.
    pub ray: DVec3,
}

impl Wave {
    /// A wave by its wave vector and electric field of any size.
    pub fn new(k: Field, e: Field, normal: DVec3) -> Wave {
        let e = e.norm_squared().max(f64::MIN_POSITIVE).sqrt().recip() * e;
        let h = k.cross(e);
        let s = 0.5 * e.cross(h.conj()).re;
        let through = s.dot(normal).abs();
        if k.im != DVec3::ZERO || through < GRAZING {
            return Wave { k, e, h, ray: DVec3::ZERO };
        }
        let scale = through.sqrt().recip();
        Wave { k, e: scale * e, h: scale * h, ray: s.normalize() }
    }

    /// The same, as one that dies away.
    pub(super) fn dying(self) -> Wave {
        Wave { ray: DVec3::ZERO, ..self }
    }

    /// Whether it carries energy away from the facet.
    pub fn travels(&self) -> bool {
        self.ray != DVec3::ZERO
    }

    /// The refractive index of a wave that travels.
    pub fn index(&self) -> f64 {
        self.k.re.length()
    }
}

/// Light of one wave vector outside a crystal, at a facet: two polarisations that share a direction, or die away
/// together.
#[derive(Debug, Clone, Copy)]
pub struct Outside {
    /// The refractive index outside.
    pub index: f64,
    /// The part of the wave vector along the facet, in units of ω/c.
    pub along: DVec3,
    /// The facet's unit normal, out of the crystal.
    pub normal: DVec3,
    /// Unit, in the facet: along `along`, or where that is nothing any.
    pub in_plane: DVec3,
    /// Unit, in the facet, across the plane of incidence.
    pub across: DVec3,
    /// The part of the wave vector along the normal; imaginary beyond total reflection.
    pub w: C,
}

impl Outside {
    /// Light outside that meets a wave whose wave vector has this part along the facet.
    pub fn new(along: DVec3, normal: DVec3, index: f64) -> Outside {
        let size2 = along.length_squared();
        // at normal incidence any direction in the facet is one
        let in_plane = if size2 > 1e-24 { along / size2.sqrt() } else { normal.any_orthonormal_vector() };
        let across = in_plane.cross(normal);
        let w2 = index * index - size2;
        let w = if w2 > 0.0 { C::new(w2.sqrt(), 0.0) } else { C::new(0.0, (-w2).sqrt()) };
        Outside { index, along, normal, in_plane, across, w }
    }

    /// Whether light leaves at all.
    pub fn travels(&self) -> bool {
        self.w.re > 0.0
    }

    /// The unit direction of light that leaves; means nothing at total reflection.
    pub fn direction(&self) -> DVec3 {
        (self.along + self.w.re * self.normal) / self.index
    }

    /// By how much fields along the facet fail to be those of light that leaves: H·q̂ − w E·ŝ and w H·ŝ + n² E·q̂ are 0 for
    /// such light.
    pub fn mismatch(&self, wave: &Wave) -> [C; 2] {
        let Outside { index, in_plane, across, w, .. } = *self;
        [
            wave.h.along(in_plane) - w * wave.e.along(across),
            w * wave.h.along(across) + index * index * wave.e.along(in_plane),
        ]
    }
}
