//! Finishes of surfaces: the catalogue of BSDFs, one kind a file.

mod bsdf;
pub mod diffuse;
pub mod mirror;

use super::Reflectance;
use super::surface_schema::SurfaceEntry;
pub use bsdf::{Bsdf, BsdfType};
use std::sync::Arc;

/// Every kind of finish, in the order in which they are asked for a surface; the last takes what none before
/// does.
pub static BSDFS: &[&BsdfType] = &[&mirror::KIND, &diffuse::KIND];

/// Uniforms for [`Bsdf::sample`] of a delta, which has but one direction.
pub const MIDDLE: [f32; 2] = [0.5; 2];

impl SurfaceEntry {
    /// Its finish.
    pub(super) fn bsdf(&self, reflectance: Reflectance) -> Arc<dyn Bsdf> {
        let asked = BSDFS.iter().find_map(|kind| (kind.read)(self, reflectance));
        asked.unwrap_or_else(|| Arc::new(diffuse::Diffuse(reflectance)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};
    use crate::sampling::warps;
    use glam::Vec3;
    use std::f32::consts::{PI, TAU};

    /// One of each kind of the catalogue, as a scene file asks for it.
    fn every_kind() -> Vec<(&'static str, Arc<dyn Bsdf>)> {
        let entry = |keys: &str| -> SurfaceEntry {
            toml::from_str(&format!("reflectance = 0.5\n{keys}")).expect("an entry")
        };
        let made = [("mirror", "mirror = true"), ("diffuse", "")];
        assert_eq!(made.len(), BSDFS.len(), "a sample for each kind");
        let made = made.map(|(name, keys)| (name, entry(keys).bsdf(Reflectance::Grey(0.5))));
        for ((name, _), kind) in made.iter().zip(BSDFS) {
            assert_eq!(*name, kind.name);
        }
        made.into()
    }

    /// Over the hemisphere the density of the directions drawn adds up to 1, what is given back to the
    /// reflectance, and directions are drawn by that density: means of the cosine and its square agree.
    #[test]
    fn every_finish_draws_by_its_density_and_keeps_its_power() {
        let mut stream = Stream::new(11, Purpose::TEST, 0);
        let normal = Vec3::new(0.6, -0.48, 0.64);
        for (name, bsdf) in every_kind() {
            assert_eq!(bsdf.reflectance(560.0), 0.5, "{name}");
            for slant in [0.1f32, 0.7, 1.4] {
                let incoming = -warps::to_world(normal, Vec3::new(slant.sin(), 0.0, slant.cos()));
                if bsdf.is_delta() {
                    let one = bsdf.sample(normal, incoming, stream.pair());
                    assert_eq!(one, bsdf.sample(normal, incoming, stream.pair()), "{name}");
                    assert!((one.length() - 1.0).abs() < 1e-6 && one.dot(normal) > 0.0, "{name}");
                    assert_eq!(
                        (bsdf.pdf(normal, incoming, one), bsdf.eval(normal, incoming, one)),
                        (0.0, 0.0)
                    );
                    continue;
                }
                let n = 200_000;
                let (mut whole, mut back) = (0.0f64, 0.0f64);
                let (mut expected, mut drawn) = ([0.0f64; 2], [0.0f64; 2]);
                for _ in 0..n {
                    let local = warps::uniform_cone(stream.pair(), 0.0);
                    let uniform = warps::to_world(normal, local);
                    let weight = f64::from(bsdf.pdf(normal, incoming, uniform) * TAU) / f64::from(n);
                    whole += weight;
                    back +=
                        f64::from(bsdf.eval(normal, incoming, uniform) * local.z / PI * TAU) / f64::from(n);
                    let sampled = bsdf.sample(normal, incoming, stream.pair()).dot(normal);
                    for (k, power) in [1, 2].into_iter().enumerate() {
                        expected[k] += weight * f64::from(local.z.powi(power));
                        drawn[k] += f64::from(sampled.powi(power)) / f64::from(n);
                    }
                }
                assert!((whole - 1.0).abs() < 0.01 && (back - 1.0).abs() < 0.01, "{name}: {whole} {back}");
                for k in 0..2 {
                    assert!((drawn[k] - expected[k]).abs() < 0.01, "{name}: {drawn:?} {expected:?}");
                }
                assert_eq!(bsdf.pdf(normal, incoming, -normal), 0.0, "{name} lets nothing through");
            }
        }
    }
}
