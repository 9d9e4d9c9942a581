//! A design in its own TOML form: what `cuts/` holds and what `-o stone.toml` writes.
//!
//! Either `family` with `[parameters]`, or `[[tier]]`s. A tier has `angle`, `distance` and
//! `indices`, or explicit facets with `normal` and `distance` (a mesh). `[expect]` lists
//! proportions that a test checks for the library's own files.

use super::design::{Design, Facet, Gear, Tier, Unit, facet_normal};
use super::families::{self, CutError};
use crate::solid::Plane;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A design file as written.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Document {
    /// Name of the cut.
    #[serde(default)]
    pub name: String,
    /// One line for `cutlab list cuts`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub about: String,
    /// Where the proportions are from.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// `mm`, or nothing for a shape without size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Index the design was drawn for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refractive_index: Option<f64>,
    /// Header lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub headers: Vec<String>,
    /// Footnotes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub footers: Vec<String>,
    /// Index wheel, 96 teeth if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gear: Option<GearEntry>,
    /// Symmetry as stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<SymmetryEntry>,
    /// A parametric family.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<String>,
    /// The family's parameters that differ from its defaults.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, f64>,
    /// Proportions that must come out.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub expect: BTreeMap<String, f64>,
    /// Tiers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tier: Vec<TierEntry>,
}

/// `gear = { teeth = 96, offset = 0 }`
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GearEntry {
    teeth: f64,
    #[serde(default)]
    offset: f64,
}

/// `symmetry = { order = 8, mirror = true }`
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SymmetryEntry {
    order: u32,
    mirror: bool,
}

/// One tier as written.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TierEntry {
    #[serde(default)]
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    angle: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    distance: Option<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    indices: Vec<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    names: Vec<String>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    instructions: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    facet: Vec<FacetEntry>,
}

/// One facet given by its plane.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FacetEntry {
    #[serde(default, skip_serializing_if = "String::is_empty")]
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    index: Option<f64>,
    normal: [f64; 3],
    distance: f64,
}

/// A design file that cannot be understood.
#[derive(Debug, thiserror::Error)]
pub enum DocumentError {
    /// Not TOML, or not of this form; the text names line and column.
    #[error("{}", .0.to_string().trim_end())]
    Syntax(#[from] toml::de::Error),
    /// A parameter or family is wrong.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// A tier lacks what it needs.
    #[error("tier {number} ({name}): {problem}")]
    Tier {
        /// Counted from 1.
        number: usize,
        /// The tier's name.
        name: String,
        /// What is wrong with it.
        problem: String,
    },
    /// A unit other than `mm`.
    #[error("unit '{0}' is not known: write unit = \"mm\", or leave it out for a shape without size")]
    Unit(String),
}

impl Document {
    /// Reads the TOML text.
    pub fn parse(text: &str) -> Result<Document, DocumentError> {
        Ok(toml::from_str(text)?)
    }

    /// Builds the design, with `overrides` for the parameters of a family.
    pub fn design(&self, overrides: &BTreeMap<String, f64>) -> Result<Design, DocumentError> {
        if let Some(family) = &self.family {
            let mut values = self.parameters.clone();
            values.extend(overrides.iter().map(|(k, v)| (k.clone(), *v)));
            let mut design = families::build(family, &values)?;
            if !self.name.is_empty() {
                design.name = self.name.clone();
            }
            design.source = self.source.clone();
            return Ok(design);
        }
        if let Some(key) = overrides.keys().next() {
            return Err(CutError::NoParameters { name: self.name.clone(), key: key.clone() }.into());
        }
        let gear = self.gear.map_or(Gear::default(), |g| Gear { teeth: g.teeth, offset: g.offset });
        let tiers =
            self.tier.iter().enumerate().map(|(i, t)| t.tier(i + 1, gear)).collect::<Result<_, _>>()?;
        Ok(Design {
            name: self.name.clone(),
            headers: self.headers.clone(),
            footers: self.footers.clone(),
            source: self.source.clone(),
            gear,
            symmetry: self.symmetry.map(|s| (s.order, s.mirror)),
            refractive_index: self.refractive_index,
            unit: match self.unit.as_deref() {
                None => Unit::Free,
                Some("mm") => Unit::Millimetre,
                Some(other) => return Err(DocumentError::Unit(other.into())),
            },
            tiers,
        })
    }

    /// The document of a design: tiers by angle, distance and index where that gives back the very
    /// planes, explicit planes where not.
    pub fn of(design: &Design) -> Document {
        Document {
            name: design.name.clone(),
            source: design.source.clone(),
            unit: (design.unit == Unit::Millimetre).then(|| "mm".into()),
            refractive_index: design.refractive_index,
            headers: design.headers.clone(),
            footers: design.footers.clone(),
            gear: Some(GearEntry { teeth: design.gear.teeth, offset: design.gear.offset }),
            symmetry: design.symmetry.map(|(order, mirror)| SymmetryEntry { order, mirror }),
            tier: design.tiers.iter().map(|t| TierEntry::of(t, design.gear)).collect(),
            ..Document::default()
        }
    }

    /// The TOML text.
    pub fn text(&self) -> String {
        // every field is a plain value, so this form cannot fail to serialise
        toml::to_string(self).unwrap_or_default()
    }
}

impl TierEntry {
    fn tier(&self, number: usize, gear: Gear) -> Result<Tier, DocumentError> {
        let fail = |problem: String| DocumentError::Tier { number, name: self.name.clone(), problem };
        let mut facets = Vec::new();
        if !self.indices.is_empty() {
            let angle = self.angle.ok_or_else(|| fail("indices need an angle".into()))?;
            let distance = self.distance.ok_or_else(|| fail("indices need a distance".into()))?;
            if !(angle.abs() <= 90.0 && gear.teeth != 0.0 && distance.is_finite()) {
                return Err(fail(format!("angle {angle} must lie in −90..90 and the gear must have teeth")));
            }
            for (i, &index) in self.indices.iter().enumerate() {
                facets.push(Facet {
                    name: self.names.get(i).cloned().unwrap_or_default(),
                    index: Some(index),
                    plane: Plane { normal: facet_normal(gear, angle, index), distance },
                });
            }
        }
        for f in &self.facet {
            let normal = DVec3::from_array(f.normal);
            if !(normal.is_finite() && normal.length() > 0.0 && f.distance.is_finite()) {
                return Err(fail(format!("facet '{}': normal {:?} has no direction", f.name, f.normal)));
            }
            // a normal that is a unit vector to rounding is kept to the bit
            let unit = (normal.length_squared() - 1.0).abs() < 1e-15;
            let plane =
                Plane { normal: if unit { normal } else { normal.normalize() }, distance: f.distance };
            facets.push(Facet { name: f.name.clone(), index: f.index, plane });
        }
        if facets.is_empty() {
            return Err(fail("has neither indices nor facets".into()));
        }
        Ok(Tier {
            name: self.name.clone(),
            angle_deg: self.angle,
            instructions: self.instructions.clone(),
            facets,
        })
    }

    fn of(tier: &Tier, gear: Gear) -> TierEntry {
        let mut entry = TierEntry {
            name: tier.name.clone(),
            angle: tier.angle_deg,
            instructions: tier.instructions.clone(),
            ..TierEntry::default()
        };
        let distance = tier.facets.first().map(|f| f.plane.distance);
        let by_index = tier.angle_deg.is_some_and(|angle| {
            tier.facets.iter().all(|f| {
                Some(f.plane.distance) == distance
                    && f.index.is_some_and(|i| facet_normal(gear, angle, i) == f.plane.normal)
            })
        });
        if by_index {
            entry.distance = distance;
            entry.indices = tier.facets.iter().filter_map(|f| f.index).collect();
            if tier.facets.iter().any(|f| !f.name.is_empty()) {
                entry.names = tier.facets.iter().map(|f| f.name.clone()).collect();
            }
        } else {
            entry.facet = tier
                .facets
                .iter()
                .map(|f| FacetEntry {
                    name: f.name.clone(),
                    index: f.index,
                    normal: f.plane.normal.to_array(),
                    distance: f.plane.distance,
                })
                .collect();
        }
        entry
    }
}
