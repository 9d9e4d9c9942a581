//! Stone instance: a stone placed in the world.

use super::photon_guide::BoundingSphere;
use crate::materials::Material;
use crate::trace::ConvexStone;
use glam::{DMat3, DVec3, Mat3, Vec3};

/// A stone placed in the world.
#[derive(Debug, Clone)]
pub struct PlacedStone {
    /// The stone, ready to trace; made from a solid in millimetres if the material absorbs.
    pub stone: ConvexStone,
    /// What it is made of.
    pub material: Material,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at
    /// each (scalar Fresnel).
    pub polarised: bool,
    /// Rotation from the trace frame to the world.
    pub world_from_stone: Mat3,
    /// World position of the trace frame's origin.
    pub position: Vec3,
    /// World length of one trace unit: the radius of the sphere around the stone.
    pub radius: f32,
}

impl PlacedStone {
    /// A stone of `radius` (world units) set down so that its lowest corner touches z = `floor.z`,
    /// its centre above the other two.
    pub fn resting_on(
        stone: ConvexStone,
        material: Material,
        turn: DMat3,
        radius: f32,
        floor: Vec3,
    ) -> PlacedStone {
        let lowest = stone
            .solid
            .vertices
            .iter()
            .map(|v| (turn * stone.point_from_design(*v)).z)
            .fold(f64::INFINITY, f64::min);
        // a hair above the floor, so that no point of the floor lies inside the stone
        const GAP: f32 = 1e-3;
        let position = floor + Vec3::Z * radius * (GAP - lowest as f32);
        PlacedStone { stone, material, polarised: true, world_from_stone: turn.as_mat3(), position, radius }
    }

    /// The stone turned in the world about its centre, then lifted or lowered so that its lowest
    /// corner is as high as before.
    pub fn turned(&self, turn: Mat3) -> PlacedStone {
        let mut turned = PlacedStone { world_from_stone: turn * self.world_from_stone, ..self.clone() };
        turned.position.z += self.lowest() - turned.lowest();
        turned
    }

    /// The stone turned with all that is around it about a point, then moved.
    pub fn moved(&self, turn: Mat3, about: Vec3, by: Vec3) -> PlacedStone {
        let position = about + turn * (self.position - about) + by;
        PlacedStone { world_from_stone: turn * self.world_from_stone, position, ..self.clone() }
    }

    /// Height of its lowest corner.
    pub fn lowest(&self) -> f32 {
        let height = |v: &DVec3| self.point_to_world(self.stone.point_from_design(*v).as_vec3()).z;
        self.stone.solid.vertices.iter().map(height).fold(f32::INFINITY, f32::min)
    }

    /// The sphere around the stone.
    pub fn bounding_sphere(&self) -> BoundingSphere {
        BoundingSphere { centre: self.position, radius: self.radius }
    }

    /// A world point in the trace frame.
    pub fn point_to_stone(&self, p: Vec3) -> Vec3 {
        self.world_from_stone.transpose() * (p - self.position) / self.radius
    }

    /// A trace-frame point in the world.
    pub fn point_to_world(&self, p: Vec3) -> Vec3 {
        self.position + self.world_from_stone * p * self.radius
    }

    /// A world direction in the trace frame.
    pub fn direction_to_stone(&self, d: Vec3) -> Vec3 {
        self.world_from_stone.transpose() * d
    }

    /// A trace-frame direction in the world.
    pub fn direction_to_world(&self, d: Vec3) -> Vec3 {
        self.world_from_stone * d
    }

    /// Whether a world point lies in the stone: the solid angle that its facets fill around the point is
    /// a whole sphere rather than nothing.
    ///
    /// Source: A. van Oosterom and J. Strackee, *The solid angle of a plane triangle*, IEEE Trans.
    /// Biomed. Eng. 30(2), 1983. Checked in this file's tests.
    pub fn contains(&self, point: Vec3) -> bool {
        if point.distance_squared(self.position) > self.radius * self.radius {
            return false;
        }
        let seen: Vec<DVec3> = self
            .stone
            .solid
            .vertices
            .iter()
            .map(|v| {
                self.point_to_world(self.stone.point_from_design(*v).as_vec3()).as_dvec3() - point.as_dvec3()
            })
            .collect();
        let half_angle = |a: DVec3, b: DVec3, c: DVec3| {
            let (x, y, z) = (a.length(), b.length(), c.length());
            a.dot(b.cross(c)).atan2(x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
        };
        let face = |corners: &[usize]| -> f64 {
            (2..corners.len())
                .map(|i| half_angle(seen[corners[0]], seen[corners[i - 1]], seen[corners[i]]))
                .sum()
        };
        let whole: f64 = self.stone.solid.faces.iter().map(|f| face(&f.corners)).sum();
        whole.abs() > std::f64::consts::PI
    }

    /// Index of refraction at `nm`.
    pub fn index(&self, nm: f32) -> f32 {
        self.material.index(f64::from(nm)) as f32
    }

    /// Absorption coefficient at `nm`, per trace unit: the stone's own size in millimetres counts,
    /// not how large it is shown.
    pub fn absorption(&self, nm: f32) -> f32 {
        (self.material.absorption_per_mm(f64::from(nm)) * self.stone.unit) as f32
    }
}
