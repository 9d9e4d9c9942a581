//! A BSDF: how a surface scatters the light that falls on it, the same at every place.

use super::super::Reflectance;
use super::super::surface_schema::SurfaceEntry;
use glam::Vec3;
use std::fmt::Debug;
use std::sync::Arc;

/// Scattering of light by a surface, alike on both sides.
///
/// The BSDF is reflectance(λ) / π × [`Bsdf::eval`], per steradian. Directions are unit vectors in which light
/// goes, `incoming` to the surface and `outgoing` from it; `normal` is the unit normal on that side. Checked
/// for every kind in `src/scene/bsdfs.rs`.
pub trait Bsdf: Debug + Send + Sync {
    /// Share of the power that it gives back at `nm`, in 0..=1; the rest is absorbed.
    fn reflectance(&self, nm: f32) -> f32;

    /// Whether all light from one direction goes on in one: then it has no density, and [`Bsdf::sample`]
    /// alone says where light goes.
    fn is_delta(&self) -> bool;

    /// Radiance over that of a Lambertian surface of the same reflectance: 1 for a Lambertian one, 0 for one
    /// that is a delta.
    fn eval(&self, normal: Vec3, incoming: Vec3, outgoing: Vec3) -> f32;

    /// Density, per steradian, with which [`Bsdf::sample`] draws a direction: eval × cosine / π, so that a
    /// photon keeps its power; 0 for a delta.
    fn pdf(&self, normal: Vec3, incoming: Vec3, outgoing: Vec3) -> f32;

    /// Draws the direction in which light goes on.
    ///
    /// - `u`: two uniforms
    fn sample(&self, normal: Vec3, incoming: Vec3, u: [f32; 2]) -> Vec3;
}

/// A kind of finish.
pub struct BsdfType {
    /// Its name, by which tests know it.
    pub name: &'static str,
    /// Makes one of a surface's entry and its reflectance; none if the entry asks for another.
    pub read: fn(&SurfaceEntry, Reflectance) -> Option<Arc<dyn Bsdf>>,
}
