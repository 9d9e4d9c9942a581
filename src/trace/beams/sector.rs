//! The sector of a symmetric stone that stands for the whole of it: its images under rotations and mirrors
//! make it up, and are lit alike.

use crate::geometry::{AxialSymmetry, Plane};
use crate::trace::ConvexStone;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

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

/// Light whose direction is off an axis or a mirror by less than this (sine) runs along it.
const ALONG: f64 = 1e-12;

impl StoneSymmetry {
    /// The symmetry of a stone; its axis goes through the centre of mass.
    pub fn of_stone(stone: &ConvexStone) -> StoneSymmetry {
        let centre = stone.point_from_design(stone.solid.volume_and_centre().1);
        let about_axis: Vec<Plane> = stone.planes.iter().map(|p| p.moved(-centre)).collect();
        StoneSymmetry { symmetry: AxialSymmetry::of_planes(&about_axis), centre }
    }

    /// The sector to follow of light in a unit direction; none where no images are lit alike. Light along the
    /// axis leaves all of the symmetry, light along a mirror plane that mirror.
    pub fn sector(&self, direction: DVec3) -> Option<Sector> {
        let across = direction.truncate();
        let left = if across.length() < ALONG {
            self.symmetry
        } else {
            let AxialSymmetry { order, mirror } = self.symmetry;
            let mirrors = (0..order).map(|k| mirror.map(|first| first + k as f64 * PI / order as f64));
            let holds = |azimuth: &f64| across.perp_dot(DVec2::from_angle(*azimuth)).abs() < ALONG;
            AxialSymmetry { order: 1, mirror: mirrors.flatten().find(holds) }
        };
        let walls = left.walls().iter().map(|wall| wall.moved(self.centre)).collect();
        (left.images() > 1).then(|| Sector { walls, images: left.images() as f64 })
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
