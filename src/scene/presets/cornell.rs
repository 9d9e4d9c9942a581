//! The original project's room: a cube with a red and a blue wall and a stone on its point.

use super::placed;
use crate::optics::Material;
use crate::scene::{Camera, Pose, Preset, Reflectance, Scene, SquareLight, Surface};
use crate::walk::Stone;
use glam::Vec3;

/// The room, 5.5 units wide, its front open.
pub static PRESET: Preset = Preset {
    name: "cornell",
    about: "the original room: red left wall, blue right wall, square ceiling light, the stone on its point",
    default_stone: "octahedron",
    default_pose: Pose::TableUp,
    default_size: (480, 480),
    build,
};

const SIDE: f32 = 5.5;
/// Camera's distance before the open front.
const DISTANCE: f32 = 8.0;
const LIGHT_SIDE: f32 = 1.2;
/// How far right of the middle the light hangs: read off the original's picture.
const LIGHT_X: f32 = 1.5;
/// Chosen so that the directly lit back wall comes out near the middle of the tone curve.
const LIGHT_RADIANCE: f32 = 38.0;
/// Radius of the sphere around the stone.
const STONE_RADIUS: f32 = 1.0;

fn build(stone: Stone, material: Material, pose: Pose, aspect: f32) -> Scene {
    let half = SIDE / 2.0;
    let (x, y, z) = (Vec3::X * SIDE, Vec3::Y * SIDE, Vec3::Z * SIDE);
    // floor centre at the origin; the front is at y = −half, where the camera looks in
    let corner = Vec3::new(-half, -half, 0.0);
    let grey = Reflectance::Grey(0.75);
    let red = Reflectance::Edge { low: 0.12, high: 0.75, edge_nm: 592.0 };
    let blue = Reflectance::Edge { low: 0.6, high: 0.12, edge_nm: 492.0 };
    let wall = |corner, u, v, reflectance| Surface { corner, u, v, reflectance };
    let floor = wall(corner, x, y, grey);
    let ceiling = wall(corner + z, y, x, grey);
    let back = wall(corner + y, x, z, grey);
    let left = wall(corner, y, z, red);
    let right = wall(corner + x, z, y, blue);
    Scene {
        name: PRESET.name,
        surfaces: vec![floor, ceiling, back, left, right],
        lights: vec![SquareLight::facing_down(
            Vec3::new(LIGHT_X, 0.0, SIDE - 1e-3),
            LIGHT_SIDE,
            LIGHT_RADIANCE,
        )],
        stone: placed(stone, material, pose, STONE_RADIUS, Vec3::ZERO),
        camera: Camera {
            position: Vec3::new(0.0, -half - DISTANCE, half),
            target: Vec3::new(0.0, 0.0, half),
            // 38° over the shorter side, which the front fills
            field_deg: 2.0 * (aspect.max(1.0) * half / DISTANCE).atan().to_degrees(),
            aspect,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::library;
    use std::collections::BTreeMap;

    #[test]
    fn the_walls_face_inward_and_the_stone_stands_on_the_floor() {
        let design =
            library::design("octahedron", &BTreeMap::new()).expect("in the library").expect("builds");
        let stone = Stone::new(design.solid().expect("closed"));
        let scene = build(stone, Material::of_index(2.417), Pose::TableUp, 1.0);
        let middle = Vec3::new(0.0, 0.0, SIDE / 2.0);
        for surface in &scene.surfaces {
            let centre = surface.corner + (surface.u + surface.v) / 2.0;
            assert!(surface.normal().dot(middle - centre) > 2.7);
        }
        let top = scene.stone.point_to_world(Vec3::Z);
        assert!((top.z - 2.0).abs() < 0.01 && scene.stone.position.z > 1.0);
        assert!((scene.camera.field_deg - 38.0).abs() < 0.1);
    }
}
