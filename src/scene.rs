//! What is around the stone: surfaces, lights, camera, and how the stone lies in it.
//!
//! World frame: right-handed, z up, lengths in millimetres (in the Cornell room, in room units).

pub mod camera;
pub mod light;
pub mod pose;
mod presets;
pub mod surface;

use crate::optics::Material;
use crate::walk::Stone;
use glam::{Mat3, Vec3};

pub use camera::Camera;
pub use light::SquareLight;
pub use pose::Pose;
pub use surface::{Reflectance, Surface};

/// A stone placed in the world.
#[derive(Debug, Clone)]
pub struct PlacedStone {
    /// The stone, ready to walk; made from a solid in millimetres if the material absorbs.
    pub stone: Stone,
    /// What it is made of.
    pub material: Material,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at
    /// each (scalar Fresnel).
    pub polarised: bool,
    /// Rotation from the walking frame to the world.
    pub world_from_stone: Mat3,
    /// World position of the walking frame's origin.
    pub position: Vec3,
    /// World length of one walking unit: the radius of the sphere around the stone.
    pub radius: f32,
}

impl PlacedStone {
    /// A world point in the walking frame.
    pub fn point_to_stone(&self, p: Vec3) -> Vec3 {
        self.world_from_stone.transpose() * (p - self.position) / self.radius
    }

    /// A walking-frame point in the world.
    pub fn point_to_world(&self, p: Vec3) -> Vec3 {
        self.position + self.world_from_stone * p * self.radius
    }

    /// A world direction in the walking frame.
    pub fn direction_to_stone(&self, d: Vec3) -> Vec3 {
        self.world_from_stone.transpose() * d
    }

    /// A walking-frame direction in the world.
    pub fn direction_to_world(&self, d: Vec3) -> Vec3 {
        self.world_from_stone * d
    }

    /// Index of refraction at `nm`.
    pub fn index(&self, nm: f32) -> f32 {
        self.material.index(f64::from(nm) / 1000.0) as f32
    }

    /// Absorption coefficient at `nm`, per walking unit: the stone's own size in millimetres counts,
    /// not how large it is shown.
    pub fn absorption(&self, nm: f32) -> f32 {
        (self.material.absorption_per_mm(f64::from(nm) / 1000.0) * self.stone.unit) as f32
    }
}

/// A scene ready to be traced.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Its name in the catalogue.
    pub name: &'static str,
    /// Diffuse surfaces.
    pub surfaces: Vec<Surface>,
    /// Light sources.
    pub lights: Vec<SquareLight>,
    /// The stone.
    pub stone: PlacedStone,
    /// The view.
    pub camera: Camera,
}

/// A scene of the catalogue.
#[derive(Debug)]
pub struct Preset {
    /// Its name, as in `--scene table`.
    pub name: &'static str,
    /// One line of help.
    pub about: &'static str,
    /// The cut shown when none is named.
    pub default_stone: &'static str,
    /// How the stone stands unless `--pose` says otherwise.
    pub default_pose: Pose,
    /// Width and height of the picture unless they are given.
    pub default_size: (u32, u32),
    /// Puts a stone into the scene; the last argument is width over height of the picture.
    pub build: fn(Stone, Material, Pose, f32) -> Scene,
}

/// Every scene.
pub static SCENES: &[&Preset] = &[&presets::table::PRESET, &presets::cornell::PRESET];

impl Preset {
    /// The scene called `name`.
    pub fn named(name: &str) -> Option<&'static Preset> {
        SCENES.iter().copied().find(|p| p.name == name)
    }
}
