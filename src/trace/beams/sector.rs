//! The sector of a symmetric stone whose images under rotations and mirrors make up the whole.

use crate::geometry::{AxialSymmetry, Plane};
use crate::trace::ConvexStone;
use glam::DVec3;

/// A sector about the stone's axis, trace frame.
#[derive(Debug, Clone)]
pub struct Sector {
    /// Vertical planes that bound it.
    walls: Vec<Plane>,
    /// How many images of it make up the stone.
    pub images: f64,
}

impl Sector {
    /// The sector of a stone; none if it has no symmetry. The axis goes through the centre of mass.
    pub fn of_stone(stone: &ConvexStone) -> Option<Sector> {
        let centre = stone.point_from_design(stone.solid.volume_and_centre().1);
        let about_axis: Vec<Plane> = stone.planes.iter().map(|p| p.moved(-centre)).collect();
        let symmetry = AxialSymmetry::of_planes(&about_axis);
        let walls = symmetry.walls().iter().map(|wall| wall.moved(centre)).collect();
        (symmetry.images() > 1).then(|| Sector { walls, images: symmetry.images() as f64 })
    }

    /// The part of a convex polygon that lies in the sector; empty if none does.
    pub fn part_of(&self, ring: &[DVec3]) -> Vec<DVec3> {
        self.walls.iter().fold(ring.to_vec(), |ring, wall| cut(&ring, wall))
    }
}

/// The part of a convex polygon behind a plane.
fn cut(ring: &[DVec3], wall: &Plane) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (i, &a) in ring.iter().enumerate() {
        let b = ring[(i + 1) % ring.len()];
        let (ha, hb) = (wall.signed_distance(a), wall.signed_distance(b));
        if ha <= 0.0 {
            kept.push(a);
        }
        if ha * hb < 0.0 {
            kept.push(a + (b - a) * (ha / (ha - hb)));
        }
    }
    if kept.len() > 2 { kept } else { Vec::new() }
}
