//! A convex stone, measured: what `cutlab show` prints of it.

use super::measured::{self, MeasuredProportions};
use super::tiers::TierRow;
use crate::design::edit::meets::MeetReport;
use crate::design::proportions::{self, Ratios};
use crate::design::round_brilliant_measures::FacetLengths;
use crate::design::symmetry::Symmetry;
use crate::design::{Design, LengthUnit, gia_envelopes};
use crate::formats;
use crate::geometry::Polyhedron;
use crate::materials::weight::Weight;
use crate::optics::fresnel::critical_angle_deg;
use crate::stone::Stone;
use serde::Serialize;
use std::collections::BTreeMap;

/// One stone as JSON. Lengths are in `unit`, percentages of the girdle width.
#[derive(Debug, Serialize)]
pub struct StoneSheet {
    pub file: String,
    pub format: String,
    pub name: String,
    pub facets: usize,
    pub closed: bool,
    pub convex: bool,
    /// In the file's own unit cubed.
    pub volume: f64,
    pub unit: &'static str,
    /// Length of the unit in the text's, which is millimetres where the file has one.
    #[serde(skip)]
    pub unit_mm: f64,
    pub facets_by_kind: BTreeMap<&'static str, usize>,
    #[serde(flatten)]
    pub measured: MeasuredProportions,
    /// The faceter's ratios, W as GemCad takes it: corner to corner in a round stone.
    pub ratios: Ratios,
    pub symmetry: Symmetry,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub brilliant: Option<FacetLengths>,
    /// Whether the envelopes apply: they are for diamonds.
    #[serde(skip)]
    pub graded: bool,
    /// The proportion envelope of a round brilliant of diamond; no grade.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proportion_envelope: Option<&'static str>,
    pub tiers: Vec<TierRow>,
    /// If it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meets: Option<MeetReport>,
    pub material: String,
    pub refractive_index: f64,
    pub critical_angle_deg: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

impl StoneSheet {
    /// Measures a stone.
    ///
    /// - `design`, `solid`: of the stone
    /// - `size`: girdle width in millimetres, if asked for
    pub fn new(stone: &Stone, design: &Design, solid: &Polyhedron, size: Option<f64>) -> StoneSheet {
        let index = stone.material().index_d();
        let p = proportions::measure(solid);
        // a glTF too wide for metres has its own numbers
        let in_mm = design.unit == LengthUnit::Millimetre;
        let unit_mm = formats::unit_mm(stone.format()).filter(|_| in_mm).unwrap_or(1.0);
        let weight = Weight::new(stone.material());
        StoneSheet {
            file: stone.name().into(),
            format: stone.format().into(),
            name: design.name.clone(),
            facets: p.facets,
            closed: true,
            convex: true, // what the readers let through is the solid of its planes
            volume: p.volume / unit_mm.powi(3),
            unit: measured::unit_name(design.unit, stone.format()),
            unit_mm,
            facets_by_kind: p.by_zone.iter().copied().collect(),
            measured: MeasuredProportions::new(&p, design, size, &weight).in_unit_of(unit_mm),
            tiers: TierRow::all(design, solid),
            meets: None,
            brilliant: p.brilliant,
            proportion_envelope: gia_envelopes::envelope(&p).filter(|_| weight.is_diamond()),
            graded: weight.is_diamond(),
            ratios: Ratios { w: p.ratios.w / unit_mm, ..p.ratios },
            symmetry: p.symmetry,
            material: stone.material().name.to_string(),
            refractive_index: index,
            critical_angle_deg: critical_angle_deg(index),
            warnings: stone.warnings().to_vec(),
        }
    }
}
