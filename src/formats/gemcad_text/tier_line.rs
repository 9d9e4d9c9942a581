//! A tier of a GemCad text file: its words with their places, and the facets that they mean.

use crate::design::tiers::facet_normal;
use crate::design::{Facet, Gear, Tier};
use crate::formats::cutting_table::index_of;
use crate::geometry::Plane;
use std::ops::Range;

/// A tier as the file gives it, before it is known which way its flat facets look.
pub struct TierLine {
    pub line: usize,
    /// Where its `a` stands.
    pub start: usize,
    /// The wheel at that place of the file.
    pub gear: Option<Gear>,
    pub angle_deg: f64,
    /// Where the angle stands.
    pub angle_at: Range<usize>,
    pub rho: f64,
    /// Where the distance stands.
    pub rho_at: Range<usize>,
    pub indices: Vec<AscIndex>,
    pub name: String,
    pub instructions: String,
}

/// A facet's index as the file gives it.
pub struct AscIndex {
    pub value: f64,
    /// The facet's name, possibly empty.
    pub name: String,
    /// Where the index stands; nowhere if a table has none.
    pub at: Option<Range<usize>>,
}

impl TierLine {
    /// Whether the tier's facets are on the pavilion's side. For flat facets the sign of the
    /// distance tells, or, if that leaves the stone open, the sign of the angle's zero.
    pub fn looks_down(&self, by_token: bool) -> bool {
        if self.angle_deg == 0.0 && !by_token {
            self.rho < 0.0
        } else {
            self.angle_deg.is_sign_negative() || (self.angle_deg == 0.0 && self.rho < 0.0)
        }
    }

    /// - `gear`: the design's, by which facets that were cut on another wheel are numbered anew
    pub fn tier(&self, gear: Gear, down: bool) -> Tier {
        let angle = self.angle_deg.abs().copysign(if down { -1.0 } else { 1.0 });
        let own = self.gear.unwrap_or(gear);
        let facet = |index: &AscIndex| {
            let normal = facet_normal(own, angle, index.value);
            let number = if own == gear { index.value } else { index_of(gear, normal) };
            let plane = Plane { normal, distance: self.rho.abs() };
            Facet { name: index.name.clone(), index: Some(number), plane }
        };
        Tier {
            name: self.name.clone(),
            angle_deg: Some(angle),
            instructions: self.instructions.clone(),
            facets: self.indices.iter().map(facet).collect(),
        }
    }
}
