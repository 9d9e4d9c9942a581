//! From the tiers of a GemCad text file to a design: wheels, flat facets, texts.

use super::parser::AscFile;
use crate::design::{Design, Gear};
use crate::formats::Parsed;
use crate::formats::error::FormatError;
use crate::geometry::SolidError;

impl AscFile<'_> {
    /// The design of the tiers.
    pub(super) fn design(mut self) -> Result<Parsed, FormatError> {
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
