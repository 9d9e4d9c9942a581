//! A loose stone on a grey table under one soft light, as the original project's first picture.

use super::placed;
use crate::optics::Material;
use crate::scene::{Camera, Pose, Preset, Reflectance, Scene, SquareLight, Surface};
use crate::walk::Stone;
use glam::Vec3;

/// The table. All lengths are in radii of the stone, so that a stone of any size fills the picture
/// alike.
pub static PRESET: Preset = Preset {
    name: "table",
    about: "a loose stone on a grey table under one soft square light",
    default_stone: "round-brilliant",
    default_pose: Pose::Lying,
    build,
};

const TABLE_HALF: f32 = 20.0;
const TABLE_REFLECTANCE: f32 = 0.35;
const LIGHT_AT: Vec3 = Vec3::new(-1.6, 2.2, 6.5);
const LIGHT_SIDE: f32 = 2.4;
const LIGHT_RADIANCE: f32 = 24.0;
const CAMERA_AT: Vec3 = Vec3::new(0.0, -6.2, 5.0);
const FIELD_DEG: f32 = 28.0;

fn build(stone: Stone, material: Material, pose: Pose, aspect: f32) -> Scene {
    let unit = stone.unit as f32;
    let half = TABLE_HALF * unit;
    let placed = placed(stone, material, pose, unit, Vec3::ZERO);
    let target = Vec3::new(0.0, 0.0, 0.9 * placed.position.z);
    let top = Surface {
        corner: Vec3::new(-half, -half, 0.0),
        u: Vec3::X * 2.0 * half,
        v: Vec3::Y * 2.0 * half,
        reflectance: Reflectance::Grey(TABLE_REFLECTANCE),
    };
    Scene {
        name: PRESET.name,
        surfaces: vec![top],
        lights: vec![SquareLight::facing(LIGHT_AT * unit, Vec3::ZERO, LIGHT_SIDE * unit, LIGHT_RADIANCE)],
        stone: placed,
        camera: Camera { position: CAMERA_AT * unit, target, field_deg: FIELD_DEG, aspect },
    }
}
