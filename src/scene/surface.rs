//! Surfaces around the stones: a shape and a finish, the same on both sides.

use super::bsdfs::Bsdf;
use super::bsdfs::diffuse::Diffuse;
use super::build_context::BuildContext;
use super::field_error::FieldError;
use super::reflectance::Reflectance;
pub use super::shapes::{Quad, Shape, SurfaceGeometry};
pub use super::surface_hit::SurfaceHit;
use super::surface_schema::SurfaceEntry;
use glam::{Mat3, Vec3};
use std::sync::Arc;

/// A surface.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Its shape.
    pub shape: Shape,
    /// Its scattering.
    pub finish: Arc<dyn Bsdf>,
    /// Whether it is background, such as a floor or a wall: a picture that leaves its background out
    /// ([`super::Scene::cut_out`]) does not show it.
    pub backdrop: bool,
}

impl Surface {
    /// A diffuse parallelogram; `u × v` points to its front.
    pub fn quad(corner: Vec3, u: Vec3, v: Vec3, reflectance: Reflectance) -> Surface {
        let shape = Shape::Quad(Quad { corner, u, v });
        Surface { shape, finish: Arc::new(Diffuse(reflectance)), backdrop: true }
    }

    /// The first intersection of a ray with either side.
    ///
    /// - `near`: intersections no farther than this do not count
    pub fn intersect(&self, origin: Vec3, direction: Vec3, near: f32) -> Option<SurfaceHit> {
        self.shape.geometry().intersect(origin, direction, near)
    }

    /// Where a ray that leaves the surface starts: of a mesh, which it may meet again, a little off, so
    /// that rounding does not put it on the other side.
    pub fn start(&self, point: Vec3, normal: Vec3) -> Vec3 {
        self.shape.geometry().start(point, normal)
    }

    /// The surface turned about a point, then moved.
    pub fn moved(&self, turn: Mat3, about: Vec3, by: Vec3) -> Surface {
        Surface { shape: self.shape.moved(turn, about, by), ..self.clone() }
    }

    /// Height of its lowest corner.
    pub fn lowest(&self) -> f32 {
        self.shape.geometry().lowest()
    }

    /// Lowest and highest corner of its box.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.shape.geometry().bounds()
    }
}

impl SurfaceEntry {
    /// The surface.
    pub(super) fn surface(&self, place: &BuildContext) -> Result<Surface, FieldError> {
        let finish = self.bsdf(self.reflectance()?);
        let shape = self.shape(place)?;
        // floors and walls are quads, a piece of jewellery is a mesh
        let backdrop = self.backdrop.unwrap_or(shape.as_quad().is_some());
        Ok(Surface { shape, finish, backdrop })
    }
}
