//! The meet-point solver: finds the distances of tiers as a faceter does at the machine.
//!
//! A tier is placed by a rule that speaks of the tiers before it: through the corner where named
//! facets meet, a girdle's thickness above such a corner, a girdle of given width, a table of given
//! size. Guides are planes that rules may name and that are not cut. The words of a rule are the
//! grammar in [`crate::manual::designs`]. Lengths are in the design's own unit, W is the width of
//! [`super::proportions::wheel_size`] over the girdle cut so far.

mod error;

pub use error::MeetError;

use super::proportions::{flat_extent, wheel_size};
use super::tiers::{Facet, Gear, Tier, Zone, facet_normal};
use crate::geometry::{Plane, Polyhedron};
use crate::limits::{self, Limits};
use glam::{DMat3, DVec3};
use std::cell::Cell;

/// What fixes a tier's distance.
#[derive(Debug, Clone, PartialEq)]
pub enum Rule {
    /// The distance itself.
    Distance(f64),
    /// The tier's first facet passes through these corners (one; or two, which fix its angle too),
    /// away from the girdle by `girdle` × W.
    Meets {
        /// Corners, each `FACET & FACET & FACET …`.
        corners: Vec<String>,
        /// Fraction of W left between the corner and the tier.
        girdle: f64,
    },
    /// A vertical tier whose outline, by itself, has this W.
    Width(f64),
    /// A horizontal tier whose facet has this extent along the width, as a fraction of W.
    Table(f64),
}

/// A tier to be placed.
#[derive(Debug, Clone)]
pub struct TierSpec<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its angle from the girdle plane in degrees, negative on the pavilion; none if two corners
    /// fix it.
    pub angle_deg: Option<f64>,
    /// Its indices; a rule is about the first.
    pub indices: &'a [f64],
    /// What fixes its distance.
    pub rule: Rule,
}

/// Planes count as meeting, and a corner as lying on the stone, within this part of the stone's
/// size: far above the rounding of a dozen chained meets, far below what can be cut.
const MEET: f64 = 1e-9;

/// A stone on the bench: the tiers cut so far, and the guides.
#[derive(Debug, Default)]
pub struct MeetPointSolver {
    gear: Gear,
    /// The tiers cut so far.
    pub tiers: Vec<Tier>,
    guides: Vec<Tier>,
    /// The most facets, and steps, that it takes.
    pub(super) limits: Limits,
    /// What placing tiers has cost so far, see [`limits::SOLVING`].
    steps: Cell<u64>,
}

impl MeetPointSolver {
    /// An empty bench with that index wheel.
    pub fn new(gear: Gear, limits: Limits) -> MeetPointSolver {
        MeetPointSolver { gear, limits, ..MeetPointSolver::default() }
    }

    /// Finds the angle (degrees) and distance of a tier.
    ///
    /// Checked in `tests/library/meet.rs` against hand-derived corners and the closed form of the round
    /// brilliant (1e-12).
    pub fn place(&self, cut: &TierSpec) -> Result<(f64, f64), MeetError> {
        let index = cut.indices.first().copied().unwrap_or_default();
        match &cut.rule {
            Rule::Distance(distance) => Ok((cut.angle_deg.ok_or(MeetError::NoAngle)?, *distance)),
            Rule::Meets { corners, girdle } => self.through(cut.angle_deg, index, corners, *girdle),
            Rule::Width(width) => {
                let angle = cut.angle_deg.ok_or(MeetError::NoAngle)?;
                if angle.abs() != 90.0 {
                    return Err(MeetError::WrongAngle {
                        rule: "width",
                        needed: "vertical",
                        angle_deg: angle,
                    });
                }
                let walls: Vec<Plane> = cut
                    .indices
                    .iter()
                    .map(|&i| Plane { normal: facet_normal(self.gear, angle, i), distance: 1.0 })
                    .collect();
                Ok((angle, width / self.width_within(&walls)?))
            }
            Rule::Table(share) => {
                let angle = cut.angle_deg.ok_or(MeetError::NoAngle)?;
                if angle != 0.0 {
                    return Err(MeetError::WrongAngle {
                        rule: "table",
                        needed: "horizontal",
                        angle_deg: angle,
                    });
                }
                Ok((angle, self.table(facet_normal(self.gear, angle, index), *share)?))
            }
        }
    }

    /// Puts a tier on the stone, or among the guides.
    pub fn add(&mut self, tier: Tier, guide: bool) -> Result<(), MeetError> {
        if guide {
            self.guides.push(tier)
        } else {
            self.tiers.push(tier)
        }
        let all = self.tiers.iter().chain(&self.guides).map(|t| t.facets.len());
        Ok(self.limits.check(&limits::FACETS, all.sum::<usize>())?)
    }

    /// Counts what is about to be done.
    fn spend(&self, steps: usize) -> Result<(), MeetError> {
        self.steps.set(self.steps.get().saturating_add(steps as u64));
        Ok(self.limits.check(&limits::SOLVING, self.steps.get())?)
    }

    /// The solid of planes.
    fn clip(&self, planes: &[Plane]) -> Result<Polyhedron, MeetError> {
        self.spend(planes.len().pow(2))?;
        Ok(Polyhedron::from_planes(planes)?)
    }

    fn facets(&self) -> impl Iterator<Item = &Facet> {
        self.tiers.iter().flat_map(|t| &t.facets)
    }

    fn planes(&self) -> Vec<Plane> {
        self.facets().map(|f| f.plane).collect()
    }

    fn size(&self) -> f64 {
        self.facets().fold(0.0, |m: f64, f| m.max(f.plane.distance.abs()))
    }

    /// W of the girdle cut so far.
    fn width(&self) -> Result<f64, MeetError> {
        let walls: Vec<Plane> =
            self.planes().into_iter().filter(|p| Zone::from_normal(p.normal) == Zone::Girdle).collect();
        if walls.is_empty() { Err(MeetError::NoGirdle) } else { self.width_within(&walls) }
    }

    fn through(
        &self,
        angle_deg: Option<f64>,
        index: f64,
        corners: &[String],
        girdle: f64,
    ) -> Result<(f64, f64), MeetError> {
        let points = corners.iter().map(|c| self.corner(c)).collect::<Result<Vec<_>, _>>()?;
        let (angle, point) = match (angle_deg, points.as_slice()) {
            (Some(angle), [point]) => (angle, *point),
            (None, [a, b]) => {
                let out = facet_normal(self.gear, 90.0, index);
                let (run, rise) = (out.dot(*a - *b), a.z - b.z);
                if run.abs() <= MEET * self.size() {
                    return Err(MeetError::NoPlane { index });
                }
                ((-rise / run).atan().to_degrees(), *a)
            }
            (None, _) => return Err(MeetError::NoAngle),
            (Some(_), _) => return Err(MeetError::TooMuch),
        };
        let normal = facet_normal(self.gear, angle, index);
        let lift = if girdle == 0.0 { 0.0 } else { girdle * self.width()? };
        Ok((angle, normal.dot(point + DVec3::Z * lift * angle.signum())))
    }

    /// W of the outline between vertical planes.
    fn width_within(&self, walls: &[Plane]) -> Result<f64, MeetError> {
        let mut planes = walls.to_vec();
        planes
            .extend([DVec3::Z, -DVec3::Z].map(|normal| Plane { normal, distance: walls[0].distance.abs() }));
        Ok(wheel_size(&self.clip(&planes)?.hull()).0)
    }

    /// The corner written `FACET & FACET & FACET …`.
    fn corner(&self, corner: &str) -> Result<DVec3, MeetError> {
        let planes =
            corner.split('&').map(|name| self.plane_by_name(name.trim())).collect::<Result<Vec<_>, _>>()?;
        if planes.len() < 3 {
            return Err(MeetError::TooFew { corner: corner.into(), count: planes.len() });
        }
        let point = best_conditioned(&planes)
            .ok_or(MeetError::NoCorner { corner: corner.into(), apart: f64::INFINITY })?;
        let tolerance = MEET * self.size().max(point.length());
        let apart = planes.iter().map(|p| p.signed_distance(point).abs()).fold(0.0, f64::max);
        if apart > tolerance {
            return Err(MeetError::NoCorner { corner: corner.into(), apart });
        }
        match self.facets().find(|f| f.plane.signed_distance(point) > tolerance) {
            None => Ok(point),
            Some(facet) => Err(MeetError::CutAway {
                corner: corner.into(),
                by: self.facet_label(facet),
                depth: facet.plane.signed_distance(point),
            }),
        }
    }

    /// What to call a facet in an error.
    fn facet_label(&self, facet: &Facet) -> String {
        let tier = self.tiers.iter().find(|t| t.facets.iter().any(|f| std::ptr::eq(f, facet)));
        match (tier, facet.index) {
            (Some(tier), Some(index)) => format!("{}@{index}", tier.name),
            _ => facet.name.clone(),
        }
    }

    /// The plane called `TIER@INDEX`, `TIER NUMBER`, by a facet's own name, or `TIER` if it has one.
    fn plane_by_name(&self, name: &str) -> Result<Plane, MeetError> {
        let tiers = || self.tiers.iter().chain(&self.guides);
        self.spend(tiers().map(|t| 1 + t.facets.len()).sum())?;
        if let Some((tier, index)) = name.rsplit_once('@').and_then(|(t, i)| Some((t, i.parse().ok()?))) {
            let index: f64 = index;
            let teeth = self.gear.teeth.abs();
            let same = |i: f64| {
                let off = (i - index).rem_euclid(teeth);
                off.min(teeth - off) < 1e-6
            };
            let facets = tiers().filter(|t| t.name == tier).flat_map(|t| &t.facets);
            if let Some(facet) = facets.into_iter().find(|f| f.index.is_some_and(same)) {
                return Ok(facet.plane);
            }
        }
        if let Some(facet) = tiers().flat_map(|t| &t.facets).find(|f| f.name == name) {
            return Ok(facet.plane);
        }
        if let Some(tier) = tiers().find(|t| t.name == name) {
            return match tier.facets.as_slice() {
                [facet] => Ok(facet.plane),
                several => Err(MeetError::WhichFacet { tier: name.into(), count: several.len() }),
            };
        }
        let numbered = name.rsplit_once(' ').and_then(|(t, k)| Some((t, k.parse::<usize>().ok()?)));
        let facet = numbered.and_then(|(tier, k)| {
            tiers().find(|t| t.name == tier).and_then(|t| t.facets.get(k.checked_sub(1)?))
        });
        facet.map(|f| f.plane).ok_or_else(|| MeetError::UnknownFacet {
            facet: name.into(),
            known: tiers().map(|t| t.name.clone()).collect(),
        })
    }

    /// Distance of the horizontal plane along `normal` whose facet is `share` × W wide.
    fn table(&self, normal: DVec3, share: f64) -> Result<f64, MeetError> {
        let width = self.width()?;
        let mut planes = self.planes();
        // the far side may still be uncut
        planes.push(Plane { normal: -normal, distance: 100.0 * self.size() });
        let stone = self.clip(&planes)?;
        let heights = stone.vertices.iter().map(|v| v.dot(normal));
        let mut high = heights.fold(f64::NEG_INFINITY, f64::max);
        let girdle =
            (0..stone.faces.len()).filter(|&f| Zone::from_normal(stone.area_vector(f)) == Zone::Girdle);
        let mut low = girdle
            .flat_map(|f| stone.polygon(f).map(|v| v.dot(normal)))
            .fold(f64::NEG_INFINITY, f64::max)
            .min(high);
        let outline = stone.outline();
        let excess = |distance: f64| -> Result<f64, MeetError> {
            let mut cut = planes.clone();
            cut.push(Plane { normal, distance });
            let solid = self.clip(&cut)?;
            let face = solid.faces.iter().position(|f| f.plane == cut.len() - 1);
            Ok(face.map_or(0.0, |f| flat_extent(&solid, f, &outline)) / width - share)
        };
        // just above the girdle, where the outline itself would merge with the table
        low += 1e-9 * (high - low);
        let (mut at_low, mut at_high) = (excess(low)?, -share);
        if at_low < 0.0 || share <= 0.0 {
            return Err(MeetError::TableTooLarge { asked: share, most: at_low + share });
        }
        // the extent falls in straight pieces: false position ends exactly, halving keeps it safe
        for step in 0..200 {
            let middle = if step % 3 == 2 {
                0.5 * (low + high)
            } else {
                low + (high - low) * at_low / (at_low - at_high)
            };
            let at_middle = excess(middle)?;
            if at_middle.abs() < 1e-15 || high - low < 1e-15 * width {
                return Ok(middle);
            }
            if at_middle > 0.0 {
                (low, at_low) = (middle, at_middle);
            } else {
                (high, at_high) = (middle, at_middle);
            }
        }
        Ok(0.5 * (low + high))
    }
}

/// The point common to the three planes among `planes` that cross most squarely.
fn best_conditioned(planes: &[Plane]) -> Option<DVec3> {
    /// Of a corner that names more, the first so many are tried by threes; all are checked.
    const MAX_CORNERS_TRIED: usize = 16;
    let planes = &planes[..planes.len().min(MAX_CORNERS_TRIED)];
    let mut best: Option<(f64, DVec3)> = None;
    for (i, a) in planes.iter().enumerate() {
        for (j, b) in planes.iter().enumerate().skip(i + 1) {
            for c in &planes[j + 1..] {
                let rows = DMat3::from_cols(a.normal, b.normal, c.normal).transpose();
                let squareness = rows.determinant().abs();
                if squareness > 1e-9 && best.is_none_or(|(s, _)| squareness > s) {
                    let point = rows.inverse() * DVec3::new(a.distance, b.distance, c.distance);
                    best = Some((squareness, point));
                }
            }
        }
    }
    best.map(|(_, point)| point)
}
