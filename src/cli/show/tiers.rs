//! The tiers of a design, as `cutlab show` lists them.

use crate::cut::Tier;
use crate::cut::design::read_alike;
use serde::Serialize;

/// One tier of the design.
#[derive(Debug, Serialize)]
pub struct TierRow {
    name: String,
    angle_deg: Option<f64>,
    facets: Vec<String>,
    /// On the index wheel, as far as they are known.
    indices: Vec<f64>,
    #[serde(skip_serializing_if = "String::is_empty")]
    instructions: String,
}

impl TierRow {
    /// The row of a tier.
    pub fn of(tier: &Tier) -> TierRow {
        TierRow {
            name: tier.name.clone(),
            angle_deg: tier.angle_deg,
            facets: tier.facets.iter().map(|f| f.name.clone()).collect(),
            indices: tier.facets.iter().filter_map(|f| f.index).collect(),
            instructions: tier.instructions.clone(),
        }
    }

    /// Whether two rows differ in their distances only: the girdle of a fancy outline.
    pub fn reads_like(&self, other: &TierRow) -> bool {
        read_alike((&self.name, self.angle_deg), (&other.name, other.angle_deg))
    }

    /// Rows that read alike, as one.
    pub fn joined(rows: &[TierRow]) -> TierRow {
        TierRow {
            name: rows.first().map(|r| r.name.clone()).unwrap_or_default(),
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
        let name = if self.name.is_empty() { self.facets.first() } else { Some(&self.name) };
        let name = name.filter(|n| !n.is_empty()).map_or(String::new(), |n| format!("  {n}"));
        format!("{angle:>8}{name}  {}", indices.join(" "))
    }
}
