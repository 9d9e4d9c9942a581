//! From the tiers of a GemCad text file to a design: wheels, flat facets, texts.

use super::{AscFile, TierLine};
use crate::design::tiers::facet_normal;
use crate::design::{Design, Facet, Gear, Tier};
use crate::formats::Parsed;
use crate::formats::cutting_table::index_of;
use crate::formats::error::FormatError;
use crate::geometry::{Plane, SolidError};

impl AscFile<'_> {
    /// The design of the tiers.
    pub(super) fn design(mut self) -> Result<Parsed, FormatError> {
        // a table lies at any index
        for flat in self.tiers.iter_mut().filter(|t| t.angle_deg == 0.0 && t.indices.is_empty()) {
            flat.indices.push((self.gear.map_or(0.0, |g| g.teeth.abs()), flat.name.clone()));
        }
        if let Some(tier) = self.tiers.iter().find(|t| t.indices.is_empty()) {
            return Err(self.source.at_line(tier.line, "at least one index in the tier", ""));
        }
        let gear = self.gear.unwrap_or_else(|| {
            self.warnings.push("no gear is given: 96 teeth assumed".into());
            Gear::default()
        });
        let mut design = Design::new(self.source.stem());
        if let Some(title) = self.headers.iter().find(|h| !h.is_empty()) {
            design.name = title.clone();
        }
        design.gear = gear;
        design.symmetry = self.symmetry;
        design.refractive_index = self.refractive_index;
        design.tiers = self.tiers.iter().map(|t| t.tier(gear, t.looks_down(false))).collect();
        let by_token = self.tiers.iter().any(|t| t.looks_down(true) != t.looks_down(false));
        if by_token && matches!(design.solid(), Err(SolidError::Open { .. })) {
            let tiers = self.tiers.iter().map(|t| t.tier(gear, t.looks_down(true))).collect();
            let other = Design { tiers, ..design.clone() };
            if other.solid().is_ok() {
                self.warnings
                    .push("a facet at angle -0.00 is taken as culet: the stone is open without".into());
                design = other;
            }
        }
        for (kept, lines) in [(&mut design.headers, self.headers), (&mut design.footers, self.footers)] {
            *kept = lines;
            // blank lines after the last say nothing, and the binary form cannot tell them from none
            kept.truncate(kept.iter().rposition(|l| !l.is_empty()).map_or(0, |last| last + 1));
        }
        Ok(Parsed::new(design, self.warnings))
    }
}
impl TierLine {
    /// Whether the tier's facets are on the pavilion's side. For flat facets the sign of the
    /// distance tells, or, if that leaves the stone open, the sign of the angle's zero.
    fn looks_down(&self, by_token: bool) -> bool {
        if self.angle_deg == 0.0 && !by_token {
            self.rho < 0.0
        } else {
            self.angle_deg.is_sign_negative() || (self.angle_deg == 0.0 && self.rho < 0.0)
        }
    }

    /// - `gear`: the design's, by which facets that were cut on another wheel are numbered anew
    fn tier(&self, gear: Gear, down: bool) -> Tier {
        let angle = self.angle_deg.abs().copysign(if down { -1.0 } else { 1.0 });
        let own = self.gear.unwrap_or(gear);
        let facet = |(index, name): &(f64, String)| {
            let normal = facet_normal(own, angle, *index);
            let index = if own == gear { *index } else { index_of(gear, normal) };
            let plane = Plane { normal, distance: self.rho.abs() };
            Facet { name: name.clone(), index: Some(index), plane }
        };
        Tier {
            name: self.name.clone(),
            angle_deg: Some(angle),
            instructions: self.instructions.clone(),
            facets: self.indices.iter().map(facet).collect(),
        }
    }
}
