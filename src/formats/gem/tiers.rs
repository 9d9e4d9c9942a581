//! Tiers of a GemCad binary file, whose records are single facets.

use super::records::RawFacet;
use crate::design::{Facet, Gear, Tier};
use crate::formats::cutting_table::{angle_deg, index_of};
use std::collections::HashMap;

/// Facets whose angle (degrees) and distance (in parts of it) differ by less were cut as one tier.
const ONE_TIER: f64 = 1e-6;

/// Whether two facets by angle (degrees) and distance may have been cut as one tier.
pub fn is_one_tier(a: (f64, f64), b: (f64, f64)) -> bool {
    (a.0 - b.0).abs() < ONE_TIER && (a.1 - b.1).abs() < ONE_TIER * b.1
}

/// Facets grouped by the file's key, and by angle and distance where one key is used for all.
pub struct GroupedFacets {
    pub tiers: Vec<Tier>,
    /// For each facet of the tiers, in their order, the number of its record.
    pub records: Vec<usize>,
}

impl GroupedFacets {
    pub fn new(facets: &[RawFacet], gear: Gear) -> GroupedFacets {
        let mut tiers: Vec<(Tier, Vec<usize>)> = Vec::new();
        let mut with_key: HashMap<i32, Vec<usize>> = HashMap::new();
        for (record, facet) in facets.iter().enumerate() {
            let plane = facet.plane();
            let angle = angle_deg(plane.normal);
            let same = |t: &&usize| {
                let (tier, _) = &tiers[**t];
                let other = tier.facets.first().map_or(f64::INFINITY, |f| f.plane.distance);
                tier.angle_deg.is_some_and(|a| is_one_tier((a, other), (angle, plane.distance)))
            };
            let candidates = with_key.entry(facet.tier).or_default();
            let number = candidates.iter().rev().find(same).copied().unwrap_or_else(|| {
                candidates.push(tiers.len());
                let (name, instructions, facets) = Default::default();
                tiers.push((Tier { name, angle_deg: Some(angle), instructions, facets }, Vec::new()));
                tiers.len() - 1
            });
            let (tier, records) = &mut tiers[number];
            for (kept, new) in [(&mut tier.name, &facet.name), (&mut tier.instructions, &facet.instructions)]
            {
                if kept.is_empty() {
                    kept.clone_from(new);
                }
            }
            let index = Some(index_of(gear, plane.normal));
            tier.facets.push(Facet { name: facet.name.clone(), index, plane });
            records.push(record);
        }
        let (tiers, records): (Vec<_>, Vec<_>) = tiers.into_iter().unzip();
        GroupedFacets { tiers, records: records.concat() }
    }
}
