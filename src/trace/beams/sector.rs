//! The sector of a symmetric stone that stands for the whole of it: its images under rotations and mirrors
//! make it up, and are lit alike.

use crate::geometry::{AxialSymmetry, Plane};
use crate::trace::ConvexStone;
use glam::DVec3;

/// The symmetry of a stone about an axis, trace frame.
#[derive(Debug, Clone, Copy)]
pub struct StoneSymmetry {
    symmetry: AxialSymmetry,
    centre: DVec3,
}

/// A part of a stone.
#[derive(Debug, Clone)]
pub struct Sector {
    /// Vertical planes that bound it.
    walls: Vec<Plane>,
    /// How many images of it make up the stone.
    pub images: f64,
}

/// Light whose direction is off the axis by less than this (sine) runs along it.
const ALONG: f64 = 1e-12;

impl StoneSymmetry {
    /// The symmetry of a stone; its axis goes through the centre of mass.
    pub fn of_stone(stone: &ConvexStone) -> StoneSymmetry {
        let centre = stone.point_from_design(stone.solid.volume_and_centre().1);
        let about_axis: Vec<Plane> = stone.planes.iter().map(|p| p.moved(-centre)).collect();
        StoneSymmetry { symmetry: AxialSymmetry::of_planes(&about_axis), centre }
    }

    /// The sector to follow of light in a unit direction; none where no images are lit alike: light along the axis
    /// leaves all of the symmetry. (Light along a mirror plane leaves that mirror; a half of the stone saves too
    /// little to be followed by itself.)
    pub fn sector(&self, direction: DVec3) -> Option<Sector> {
        if direction.truncate().length() >= ALONG || self.symmetry.images() < 2 {
            return None;
        }
        let walls = self.symmetry.walls().iter().map(|wall| wall.moved(self.centre)).collect();
        Some(Sector { walls, images: self.symmetry.images() as f64 })
    }
}

impl Sector {
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
