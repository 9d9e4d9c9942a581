//! The tiers of a design, as `cutlab show` lists them.

use crate::design::edit;
use crate::design::measured_tiers::{self, MeasuredTier};
use crate::design::tiers::same_cutting_row;
use crate::design::{Design, Tier};
use crate::geometry::Polyhedron;
use serde::Serialize;

/// One tier of the design.
#[derive(Debug, Serialize)]
pub struct TierRow {
    name: String,
    /// Its place in its part of the stone, by which it can be changed: `P1`, `C2`.
    place: String,
    angle_deg: Option<f64>,
    facets: Vec<String>,
    /// On the index wheel, as far as they are known.
    indices: Vec<f64>,
    #[serde(skip_serializing_if = "String::is_empty")]
    instructions: String,
    /// Whether it was read off the planes, and its name is that of its zone.
    #[serde(skip)]
    is_measured: bool,
}

impl TierRow {
    /// The rows of a design: its own tiers, or, of a mesh, which has none, those read off its planes.
    pub fn all(design: &Design, solid: &Polyhedron) -> Vec<TierRow> {
        if design.tiers.iter().all(|t| t.angle_deg.is_none()) {
            let tiers = measured_tiers::tiers(design, solid);
            let zones: Vec<_> = tiers.iter().map(|t| (t.zone, "")).collect();
            let labels: Vec<String> =
                design.tiers.iter().enumerate().flat_map(|(i, t)| t.labels(i + 1)).collect();
            let places = edit::places(&zones);
            return tiers.iter().zip(places).map(|(t, place)| TierRow::measured(t, place, &labels)).collect();
        }
        let places = edit::places_of_tiers(design);
        let numbered = design.tiers.iter().zip(places).enumerate();
        numbered.map(|(i, (tier, place))| TierRow::from_tier(tier, place, i + 1)).collect()
    }

    fn from_tier(tier: &Tier, place: String, number: usize) -> TierRow {
        TierRow {
            name: tier.name.clone(),
            is_measured: false,
            place,
            angle_deg: tier.angle_deg,
            facets: tier.labels(number),
            indices: tier.facets.iter().filter_map(|f| f.index).collect(),
            instructions: tier.instructions.clone(),
        }
    }

    fn measured(tier: &MeasuredTier, place: String, labels: &[String]) -> TierRow {
        TierRow {
            name: tier.zone.name().into(),
            is_measured: true,
            place,
            angle_deg: Some(tier.angle_deg),
            facets: tier.facets.iter().map(|&f| labels[f].clone()).collect(),
            indices: tier.indices.clone(),
            instructions: String::new(),
        }
    }

    /// Whether two rows differ in their distances only: the girdle of a fancy outline.
    pub fn reads_like(&self, other: &TierRow) -> bool {
        same_cutting_row((&self.name, self.angle_deg), (&other.name, other.angle_deg))
    }

    /// Rows that read alike, as one.
    pub fn joined(rows: &[TierRow]) -> TierRow {
        TierRow {
            name: rows.first().map(|r| r.name.clone()).unwrap_or_default(),
            is_measured: rows.first().is_some_and(|r| r.is_measured),
            place: rows.first().map(|r| r.place.clone()).unwrap_or_default(),
            angle_deg: rows.first().and_then(|r| r.angle_deg),
            facets: rows.iter().flat_map(|r| r.facets.clone()).collect(),
            indices: rows.iter().flat_map(|r| r.indices.clone()).collect(),
            instructions: String::new(),
        }
    }

    /// Angle, indices and name; a long row of indices is cut short.
    pub fn text(&self) -> String {
        const SHOWN: usize = 16;
        let angle = self.angle_deg.map_or("no angle".into(), |a| format!("{a:.2}°"));
        let digits = |i: &f64| format!("{:.2}", i).trim_end_matches('0').trim_end_matches('.').to_string();
        let mut indices: Vec<String> = self.indices.iter().take(SHOWN).map(digits).collect();
        if self.indices.len() > SHOWN {
            indices.push(format!("… ({})", self.indices.len()));
        } else if indices.is_empty() {
            indices.push(format!("{} facets", self.facets.len()));
        }
        // a file without tier names may name its facets
        let labelled = |label: &&String| self.name.is_empty() && !label.starts_with("tier ");
        let name = self.facets.first().filter(labelled).unwrap_or(&self.name);
        // what has no name of its own is changed by its place
        let name = if name.is_empty() || self.is_measured { &self.place } else { name };
        format!("{angle:>8}  {name}  {}", indices.join(" "))
    }
}
