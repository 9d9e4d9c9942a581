//! The catalogue's scenes, one a file.

pub mod cornell;
pub mod table;

use super::{PlacedStone, Pose};
use crate::optics::Material;
use crate::walk::Stone;
use glam::{DMat3, Vec3};

/// Sets a stone of `radius` (world units) down so that its lowest corner touches z = `floor`, its
/// centre above (`x`, `y`).
fn placed(stone: Stone, material: Material, pose: Pose, radius: f32, at: Vec3) -> PlacedStone {
    let turn: DMat3 = pose.rotation(&stone.solid);
    let lowest =
        stone.solid.vertices.iter().map(|v| (turn * stone.from_design(*v)).z).fold(f64::INFINITY, f64::min);
    // a hair above the floor, so that no point of the floor lies inside the stone
    const GAP: f32 = 1e-3;
    let position = at + Vec3::Z * radius * (GAP - lowest as f32);
    PlacedStone { stone, material, polarised: true, world_from_stone: turn.as_mat3(), position, radius }
}
