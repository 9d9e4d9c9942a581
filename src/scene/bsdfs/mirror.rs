//! The mirror finish.

use super::{Bsdf, BsdfType};
use crate::scene::Reflectance;
use glam::Vec3;
use std::sync::Arc;

/// `mirror = true`.
pub static KIND: BsdfType = BsdfType {
    name: "mirror",
    read: |entry, reflectance| entry.mirror.then(|| Arc::new(Mirror(reflectance)) as Arc<dyn Bsdf>),
};

/// A perfect mirror.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mirror(pub Reflectance);

impl Bsdf for Mirror {
    fn reflectance(&self, nm: f32) -> f32 {
        self.0.value(nm)
    }

    fn is_delta(&self) -> bool {
        true
    }

    fn eval(&self, _: Vec3, _: Vec3, _: Vec3) -> f32 {
        0.0
    }

    fn pdf(&self, _: Vec3, _: Vec3, _: Vec3) -> f32 {
        0.0
    }

    fn sample(&self, normal: Vec3, incoming: Vec3, _: [f32; 2]) -> Vec3 {
        incoming.reflect(normal)
    }
}
