//! The diffuse finish.

use super::{Bsdf, BsdfType};
use crate::sampling::warps;
use crate::scene::Reflectance;
use glam::Vec3;
use std::sync::Arc;

/// What a surface has that asks for nothing else.
pub static KIND: BsdfType =
    BsdfType { name: "diffuse", read: |_, reflectance| Some(Arc::new(Diffuse(reflectance))) };

/// Lambertian: the same radiance in all directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Diffuse(pub Reflectance);

impl Bsdf for Diffuse {
    fn reflectance(&self, nm: f32) -> f32 {
        self.0.value(nm)
    }

    fn is_delta(&self) -> bool {
        false
    }

    fn eval(&self, _: Vec3, _: Vec3, _: Vec3) -> f32 {
        1.0
    }

    fn pdf(&self, normal: Vec3, _: Vec3, outgoing: Vec3) -> f32 {
        warps::cosine_hemisphere_pdf(outgoing.dot(normal))
    }

    fn sample(&self, normal: Vec3, _: Vec3, u: [f32; 2]) -> Vec3 {
        warps::to_world(normal, warps::cosine_hemisphere(u))
    }
}
