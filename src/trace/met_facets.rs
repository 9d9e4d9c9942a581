//! The facets that the lanes of a packet meet next, and where.

// loops over the lanes of a dozen arrays in lockstep: with an index they vectorise
#![allow(clippy::needless_range_loop)]

use super::intersect;
use super::lanes::{LANES, Lanes};
use super::packet::{Interaction, NextFacets, Packet};
use super::stone::ConvexStone;

/// The facets that the lanes of a packet meet next.
pub(super) struct MetFacets {
    nx: Lanes,
    ny: Lanes,
    nz: Lanes,
    /// Distances of the planes from the frame's origin.
    offset: Lanes,
    /// Distances along the rays.
    pub(super) distance: Lanes,
}

impl MetFacets {
    /// Finds them; lanes that meet none lose their power.
    #[inline(always)]
    pub(super) fn of<const FUSED: bool, const W: usize, const B: usize>(
        stone: &ConvexStone,
        p: &mut Packet,
        out: &mut Interaction,
    ) -> MetFacets {
        let mut next = NextFacets::default();
        intersect::next_facets::<FUSED, W, B>(stone, p, &mut next);
        let zero = [0.0; LANES];
        let mut met = MetFacets { nx: zero, ny: zero, nz: zero, offset: zero, distance: next.distance };
        out.lost = 0.0;
        for l in 0..LANES {
            if let Some(plane) = stone.plane_coefficients.get(next.facet[l] as usize) {
                [met.nx[l], met.ny[l], met.nz[l], met.offset[l]] = *plane;
                out.facet[l] = next.facet[l];
            } else {
                out.lost += p.power[l];
                p.power[l] = 0.0;
                met.distance[l] = 0.0;
                out.facet[l] = 0;
            }
        }
        met
    }

    /// The unit normal of a lane's facet.
    #[inline(always)]
    pub(super) fn normal(&self, l: usize) -> [f32; 3] {
        [self.nx[l], self.ny[l], self.nz[l]]
    }

    /// Where a lane's ray meets it.
    #[inline(always)]
    pub(super) fn point(&self, p: &Packet, l: usize) -> [f32; 3] {
        let ([nx, ny, nz], distance) = (self.normal(l), self.distance[l]);
        let (x, y, z) =
            (p.x[l] + distance * p.dx[l], p.y[l] + distance * p.dy[l], p.z[l] + distance * p.dz[l]);
        // back onto the facet plane, so that rounding does not add up over fifty bounces
        let off = self.offset[l] - (nx * x + ny * y + nz * z);
        [x + off * nx, y + off * ny, z + off * nz]
    }
}
