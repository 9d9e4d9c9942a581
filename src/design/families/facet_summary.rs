//! Facet summary: a stone's facets by name, in one line of words.

use super::CutError;
use crate::design::Design;
use crate::design::tiers::{Tier, Zone};
use crate::geometry::polyhedron::PlaneStatus;

/// Facets of one name on one side of the stone.
struct FacetGroup<'d> {
    name: &'d str,
    side: &'static str,
    count: usize,
}

/// How many facets of each name the finished stone has, in words, and the total.
///
/// `8 pavilion main + 16 lower half`; a name that is no word is quoted (`16 × "1"`), and one that stands
/// on the pavilion and on the crown is counted on each. Checked in `tests/program/same_solid.rs`.
pub fn facet_summary(design: &Design) -> Result<(String, usize), CutError> {
    let solid = design.solid()?;
    let mut statuses = solid.plane_status.iter();
    let mut parts: Vec<FacetGroup> = Vec::new();
    for tier in &design.tiers {
        let standing =
            statuses.by_ref().take(tier.facets.len()).filter(|f| matches!(f, PlaneStatus::Facet(_)));
        let (count, name, side) = (standing.count(), tier.name.trim(), side(tier));
        match parts.iter_mut().find(|p| p.name == name && p.side == side) {
            Some(part) => part.count += count,
            None if count > 0 => parts.push(FacetGroup { name, side, count }),
            None => {}
        }
    }
    let words: Vec<String> = parts.iter().map(|p| p.words(&parts)).collect();
    Ok((words.join(" + "), solid.faces.len()))
}

/// The side of the stone that a tier is on: that of its first facet.
fn side(tier: &Tier) -> &'static str {
    match tier.facets.first().map_or(Zone::Girdle, |f| Zone::from_normal(f.plane.normal)) {
        Zone::Table | Zone::Crown => "crown",
        Zone::Girdle => "girdle",
        Zone::Pavilion | Zone::Culet => "pavilion",
    }
}

impl FacetGroup<'_> {
    fn words(&self, all: &[FacetGroup]) -> String {
        let FacetGroup { name, side, count } = self;
        if name.is_empty() {
            return format!("{count} unnamed on the {side}");
        }
        let is_words = name.split_whitespace().any(|w| w.chars().filter(|c| c.is_alphabetic()).count() > 2);
        let said = if is_words { format!("{count} {name}") } else { format!("{count} × \"{name}\"") };
        let twice = all.iter().filter(|p| p.name == *name).count() > 1;
        if twice { format!("{said} on the {side}") } else { said }
    }
}
