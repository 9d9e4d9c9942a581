//! Mirror images in the edges of a quad: where a kernel is cut off, its part beyond the edge is folded
//! back. The power stays on the quad, and even light stays even up to the edges and corners.

use crate::scene::surface::Quad;
use glam::Vec3;

/// Two pairs of opposite edges of a parallelogram.
#[derive(Debug, Clone, Copy)]
pub struct QuadEdges {
    corner: Vec3,
    /// For each pair the unit vector across the quad, and the distance between the two edges.
    across: [(Vec3, f32); 2],
}

/// A place and its images, as many as the second number says.
pub type MirrorImages = ([Vec3; 9], usize);

impl QuadEdges {
    /// The edges of a quad; `None` if it has no area.
    pub fn new(quad: &Quad) -> Option<QuadEdges> {
        let across = |along: Vec3, other: Vec3| {
            let height = other - along * (other.dot(along) / along.length_squared());
            height.try_normalize().map(|unit| (unit, height.length()))
        };
        Some(QuadEdges { corner: quad.corner, across: [across(quad.u, quad.v)?, across(quad.v, quad.u)?] })
    }

    /// A place of the quad, first, and its images in those edges that are nearer than `radius`; in a corner
    /// also the images of images.
    pub fn images(&self, place: Vec3, radius: f32) -> MirrorImages {
        let (mut images, mut count) = ([place; 9], 1);
        for (unit, width) in self.across {
            let from_first = (place - self.corner).dot(unit);
            let so_far = count;
            for distance in [-from_first, width - from_first] {
                if distance.abs() < radius {
                    for i in 0..so_far {
                        images[count] = images[i] + unit * (2.0 * distance);
                        count += 1;
                    }
                }
            }
        }
        (images, count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_lie_as_far_beyond_an_edge_as_the_place_before_it() {
        let quad = Quad { corner: Vec3::new(1.0, 1.0, 0.0), u: Vec3::X * 4.0, v: Vec3::Y * 2.0 };
        let edges = QuadEdges::new(&quad).expect("has an area");
        let images = |x, y, radius| {
            let (all, count) = edges.images(Vec3::new(x, y, 0.0), radius);
            all[..count].iter().map(|p| [p.x, p.y]).collect::<Vec<_>>()
        };
        assert_eq!(images(3.0, 2.0, 0.5), [[3.0, 2.0]]);
        assert_eq!(images(1.25, 2.0, 0.5), [[1.25, 2.0], [0.75, 2.0]]);
        assert_eq!(images(4.75, 1.25, 0.5).len(), 4);
        assert!(images(4.75, 1.25, 0.5).contains(&[5.25, 0.75]));
        assert_eq!(images(3.0, 2.0, 100.0).len(), 9);
        assert!(QuadEdges::new(&Quad { corner: Vec3::ZERO, u: Vec3::X, v: Vec3::X }).is_none());
    }
}
