//! A loose stone on a grey table, as the original project's first picture, under a soft box and a
//! small lamp.

use super::placed;
use crate::optics::Material;
use crate::scene::{Camera, Pose, Preset, Reflectance, Scene, SquareLight, Surface};
use crate::walk::Stone;
use glam::Vec3;

/// The table. All lengths are in radii of the stone, so that a stone of any size fills the picture
/// alike.
pub static PRESET: Preset = Preset {
    name: "table",
    about: "a loose stone on a grey table under a soft box and a small lamp",
    default_stone: "round-brilliant",
    default_pose: Pose::Lying,
    default_size: (640, 480),
    build,
};

const TABLE_HALF: f32 = 20.0;
const TABLE_REFLECTANCE: f32 = 0.45;
/// A large soft box above the viewer's left shoulder: the white in the stone.
const BOX_AT: Vec3 = Vec3::new(1.8, -1.0, 8.0);
const BOX_SIDE: f32 = 6.0;
const BOX_RADIANCE: f32 = 2.4;
/// A small lamp behind the stone: caustics on the table, fire in the stone.
const LAMP_AT: Vec3 = Vec3::new(-4.5, 3.0, 6.5);
const LAMP_SIDE: f32 = 0.8;
const LAMP_RADIANCE: f32 = 170.0;
const CAMERA_AT: Vec3 = Vec3::new(3.4, -5.6, 4.6);
const FIELD_DEG: f32 = 34.0;

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
        lights: vec![
            SquareLight::facing(BOX_AT * unit, Vec3::ZERO, BOX_SIDE * unit, BOX_RADIANCE),
            SquareLight::facing(LAMP_AT * unit, Vec3::ZERO, LAMP_SIDE * unit, LAMP_RADIANCE),
        ],
        stone: placed,
        camera: Camera { position: CAMERA_AT * unit, target, field_deg: FIELD_DEG, aspect },
    }
}
