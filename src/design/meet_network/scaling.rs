//! Crown and pavilion stretched along the axis: tangents of all angles by one ratio, every meet kept.

use super::change::Change;
use super::corners::Corner;
use super::error::NetworkError;
use super::network::MeetNetwork;
use super::parts::FacetOfPart;
use crate::design::tiers::Zone;
use crate::geometry::Plane;
use glam::DVec3;

/// A place of the girdle is left at least this part of the thickness that it had.
const LEAST_GIRDLE: f64 = 0.5;

impl MeetNetwork {
    /// The network with the tangents of all angles of crown and pavilion multiplied by these ratios.
    ///
    /// The girdle keeps the heights of its thick places, unless its thin places would be left less than half as
    /// thick as they are: then the crown rises. The error names a meet of crown and pavilion that has no girdle
    /// between and does not lie at that height: it cannot be kept.
    pub fn scaled(&self, crown: f64, pavilion: f64) -> Result<MeetNetwork, NetworkError> {
        let height = |corner: usize| self.corners[corner].position.z;
        let [top, bottom] = match (self.holds.girdle, self.holds.outline) {
            (Some(corners), _) => corners.map(height),
            (None, Some(outline)) => [height(outline); 2],
            (None, None) => [0.0; 2],
        };
        let mut scaled = self.stretched((crown, top, 0.0), (pavilion, bottom))?;
        let (was, is) = (self.thinnest_girdle(), scaled.thinnest_girdle());
        let lacks = LEAST_GIRDLE * was - is;
        if was > 0.0 && lacks > 0.0 {
            scaled = self.stretched((crown, top, lacks), (pavilion, bottom))?;
        }
        Ok(scaled)
    }

    /// - `crown`: ratio, the height that stays, and what is added to all heights; `pavilion`: ratio and height
    fn stretched(&self, crown: (f64, f64, f64), pavilion: (f64, f64)) -> Result<MeetNetwork, NetworkError> {
        let mut scaled = self.clone();
        let old = self.own_planes();
        let new: Vec<Plane> = old
            .iter()
            .enumerate()
            .map(|(i, plane)| match self.parts[self.facets[i].part].zone {
                Zone::Table | Zone::Crown => stretched(plane, crown.0, crown.1).moved(DVec3::Z * crown.2),
                Zone::Pavilion | Zone::Culet => stretched(plane, pavilion.0, pavilion.1),
                Zone::Girdle => *plane,
            })
            .collect();
        for part in &mut scaled.parts {
            let first = new[part.facets[0]];
            (part.polar, part.distance) = (polar(&first), first.distance);
        }
        for ((facet, old), plane) in scaled.facets.iter_mut().zip(&self.facets).zip(&new) {
            let part = &scaled.parts[old.part];
            *facet = FacetOfPart::new(
                old.part,
                old.azimuth,
                polar(plane) - part.polar,
                plane.distance - part.distance,
            );
        }
        let new = scaled.own_planes();
        for (number, corner) in scaled.corners.iter_mut().enumerate() {
            (corner.position, corner.moves) = corner.moved(&new);
            let misses: Vec<f64> =
                corner.facets.iter().map(|&f| new[f].signed_distance(corner.position)).collect();
            let opens = misses.iter().zip(&corner.misses).map(|(new, old)| (new - old).abs());
            // what a file's rounding misses is stretched too
            let allowed = 1e-9 * self.width + corner.misses.iter().map(|m| m.abs()).fold(0.0, f64::max);
            if opens.fold(0.0, f64::max) > allowed {
                return Err(self.cannot_meet(number, &new));
            }
            corner.misses = misses;
            corner.misses[..3].fill(0.0);
        }
        for (facet, place) in &mut scaled.holds.hinges {
            let (ratio, from, rise) = match self.parts[self.facets[*facet].part].zone {
                Zone::Table | Zone::Crown => crown,
                Zone::Pavilion | Zone::Culet => (pavilion.0, pavilion.1, 0.0),
                Zone::Girdle => (1.0, 0.0, 0.0),
            };
            place.z = from + ratio * (place.z - from) + rise;
        }
        Ok(scaled)
    }

    /// Planes of the facets, in the network's frame.
    pub(super) fn own_planes(&self) -> Vec<Plane> {
        let polars: Vec<f64> = self.parts.iter().map(|p| p.polar).collect();
        let distances: Vec<f64> = self.parts.iter().map(|p| p.distance).collect();
        self.facets.iter().map(|f| f.plane(&polars, &distances)).collect()
    }

    /// The facets' planes in the design's frame with the angles of `scaled` and of the change, each as far from the
    /// middle as it was.
    pub fn turned_in_place(&self, scaled: &MeetNetwork, change: &Change) -> Vec<Plane> {
        let part = |i: usize| change.polars.get(i).copied().flatten().unwrap_or(scaled.parts[i].polar);
        let polars: Vec<f64> = (0..self.parts.len()).map(part).collect();
        let added = |i: usize| change.distances.get(i).copied().flatten().unwrap_or(0.0);
        let distances: Vec<f64> = self.parts.iter().enumerate().map(|(i, p)| p.distance + added(i)).collect();
        let turned = |f: &FacetOfPart| f.turned(change.turns.get(f.part).copied().unwrap_or(0.0));
        // the frame's origin lies on the axis, wherever the file has it: the distances that stay are from the middle
        let height = self.middle().z - self.frame.origin.z;
        let in_place = |(facet, was): (&FacetOfPart, Plane)| {
            let plane = turned(facet).plane(&polars, &distances);
            let from_middle = (plane.normal.z - was.normal.z) * height;
            self.frame.from(&Plane { distance: plane.distance + from_middle, ..plane })
        };
        self.facets.iter().zip(self.own_planes()).map(in_place).collect()
    }

    /// The least height of girdle between crown and pavilion, above one vertical edge; 0 without a girdle.
    fn thinnest_girdle(&self) -> f64 {
        let touches = |corner: &Corner, zone: Zone| {
            corner.facets.iter().any(|f| self.parts[self.facets[*f].part].zone == zone)
        };
        let on_girdle: Vec<&Corner> = self.corners.iter().filter(|c| touches(c, Zone::Girdle)).collect();
        let tops = on_girdle.iter().filter(|c| touches(c, Zone::Crown));
        let near = 1e-6 * self.width;
        let heights = tops.flat_map(|top| {
            let below = on_girdle.iter().filter(move |c| {
                c.position.truncate().distance(top.position.truncate()) < near && touches(c, Zone::Pavilion)
            });
            below.map(|c| top.position.z - c.position.z)
        });
        heights.reduce(f64::min).unwrap_or(0.0)
    }
}

/// Polar angle of a plane's normal.
fn polar(plane: &Plane) -> f64 {
    plane.normal.truncate().length().atan2(plane.normal.z)
}

/// The plane when heights above `from` are multiplied by `ratio`.
fn stretched(plane: &Plane, ratio: f64, from: f64) -> Plane {
    if ratio == 1.0 {
        return *plane;
    }
    let n = plane.normal;
    let direction = n.truncate().extend(n.z / ratio);
    let length = direction.length();
    Plane {
        normal: direction / length,
        distance: (plane.distance - n.z * from + n.z / ratio * from) / length,
    }
}
