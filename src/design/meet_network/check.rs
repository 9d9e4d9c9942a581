//! Whether a changed stone is still the same stone: every facet stands, and what met still meets.

use super::corners::Outline;
use super::error::NetworkError;
use super::network::MeetNetwork;
use crate::geometry::{Plane, Polyhedron};
use glam::DVec3;

/// A facet is lost if less than this is left of it: of its area, or of the square of the width.
const LEAST_AREA: f64 = 1e-6;

/// How far a changed stone kept what it had.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kept {
    /// Every corner is where its facets meet: the facets have the edges that they had.
    Everything,
    /// Every facet and every meet, but some edges between them run otherwise.
    Meets,
}

impl MeetNetwork {
    /// Whether planes (in the network's frame) bound a stone with every facet and every meet.
    pub(super) fn checked(&self, planes: &[Plane]) -> Result<(), NetworkError> {
        self.kept(planes).map(|_| ())
    }

    /// How far planes (in the network's frame) keep the stone's facets and meets.
    fn kept(&self, planes: &[Plane]) -> Result<Kept, NetworkError> {
        let most = 1e-9 * self.width;
        let mut kept = Kept::Everything;
        for corner in &self.corners {
            let (place, _) = corner.moved(planes);
            // what a file's rounding let a facet stand out of the corner by, it still may
            let slack = corner.misses.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let cutting = planes
                .iter()
                .enumerate()
                .filter(|(i, _)| self.stands[*i] && !corner.facets.contains(i))
                .map(|(i, p)| (i, p.signed_distance(place)))
                .filter(|(_, out)| *out > most + slack)
                .reduce(|a, b| if b.1 > a.1 { b } else { a });
            match cutting {
                Some((by, depth)) if corner.facets.len() > 3 => {
                    let facets = corner.facets.clone();
                    return Err(NetworkError::CutAway { facets, by, depth: depth / self.width });
                }
                Some(_) => kept = Kept::Meets,
                None => {}
            }
        }
        let lost = match kept {
            Kept::Everything => {
                let places: Vec<DVec3> = self.corners.iter().map(|c| c.moved(planes).0).collect();
                let is_lost = |o: &&Outline| o.left(&places, planes[o.facet].normal) < LEAST_AREA;
                self.outlines.iter().filter(is_lost).map(|o| o.facet).collect()
            }
            Kept::Meets => {
                let solid = Polyhedron::from_planes(planes).map_err(NetworkError::Solid)?;
                let mut areas = vec![0.0; planes.len()];
                solid.faces.iter().enumerate().for_each(|(i, f)| areas[f.plane] = solid.area(i));
                let least = LEAST_AREA * self.width.powi(2);
                let is_lost = |i: &usize| self.stands[*i] && areas[*i] <= least * f64::from(self.is_seen(*i));
                (0..planes.len()).filter(is_lost).collect::<Vec<_>>()
            }
        };
        if !lost.is_empty() {
            return Err(NetworkError::Lost { facets: lost });
        }
        Ok(kept)
    }

    /// Whether a facet has an area that is no rounding.
    fn is_seen(&self, facet: usize) -> bool {
        self.outlines.iter().any(|o| o.facet == facet)
    }

    /// The error of a meet that opens.
    pub(super) fn cannot_meet(&self, corner: usize, planes: &[Plane]) -> NetworkError {
        let corner = &self.corners[corner];
        let (place, _) = corner.moved(planes);
        let miss = |(f, before): (&usize, &f64)| (planes[*f].signed_distance(place) - before).abs();
        let by = corner.facets.iter().zip(&corner.misses).map(miss).fold(0.0, f64::max) / self.width;
        NetworkError::Opens { facets: corner.facets.clone(), by }
    }
}
