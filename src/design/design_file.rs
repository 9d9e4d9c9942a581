//! Design files, cutlab's own TOML form: what `cuts/` holds and what `-o stone.toml` writes. Their grammar is in
//! [`crate::manual::designs`].

use super::families::{self, CutError};
use super::meet_points::{MeetError, MeetPointSolver, Rule, TierSpec};
use super::scaling::{LENGTH_TO_WIDTH, scale_length_to_width};
use super::tiers::{Design, Facet, Gear, LengthUnit, Tier, facet_normal};
use crate::geometry::Plane;
use crate::limits::{self, Limits};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A design file as written.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct DesignFile {
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
    /// The family's parameters that differ from its defaults; of tiers, their length to width.
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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    meets: Option<MeetCorners>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    girdle: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    width: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    table: Option<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    indices: Vec<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    repeat: Option<u32>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    mirror: bool,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    guide: bool,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    names: Vec<String>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    instructions: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    facet: Vec<FacetEntry>,
}

/// One corner, or two.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(untagged)]
enum MeetCorners {
    One(String),
    Several(Vec<String>),
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
    /// A tier whose rule cannot be met.
    #[error("tier {number} ({name}): {cause}")]
    Meet {
        /// Counted from 1.
        number: usize,
        /// The tier's name.
        name: String,
        /// Why not.
        cause: MeetError,
    },
    /// A unit other than `mm`.
    #[error("unit '{0}' is not known: write unit = \"mm\", or leave it out for a shape without size")]
    Unit(String),
}

impl DesignFile {
    /// Reads the TOML text.
    pub fn parse(text: &str) -> Result<DesignFile, DocumentError> {
        Ok(toml::from_str(text)?)
    }

    /// Builds the design, with `overrides` for the parameters of a family, or for the length to
    /// width of a cut of tiers.
    pub fn design(&self, overrides: &BTreeMap<String, f64>) -> Result<Design, DocumentError> {
        self.design_within(overrides, Limits::default())
    }

    /// As [`DesignFile::design`], within limits that may be raised.
    pub fn design_within(
        &self,
        overrides: &BTreeMap<String, f64>,
        limits: Limits,
    ) -> Result<Design, DocumentError> {
        if let Some(family) = &self.family {
            let mut design = families::build_from(family, &self.parameters, overrides)?;
            if !self.name.is_empty() {
                design.name = self.name.clone();
            }
            design.source = self.source.clone();
            design.refractive_index = self.refractive_index;
            return Ok(design);
        }
        let mut values = self.parameters.clone();
        values.extend(overrides.iter().map(|(k, v)| (k.clone(), *v)));
        let length_to_width = values.remove(LENGTH_TO_WIDTH);
        if let Some(key) = values.keys().next() {
            return Err(CutError::NoParameters { name: self.name.clone(), key: key.clone() }.into());
        }
        let gear = self.gear.map_or(Gear::default(), |g| Gear { teeth: g.teeth, offset: g.offset });
        let mut bench = MeetPointSolver::new(gear, limits);
        for (i, entry) in self.tier.iter().enumerate() {
            let tier = entry.tier(i + 1, gear, &bench)?;
            let name = tier.name.clone();
            let many = |cause| DocumentError::Meet { number: i + 1, name, cause };
            bench.add(tier, entry.guide).map_err(many)?;
        }
        let design = Design {
            name: self.name.clone(),
            headers: self.headers.clone(),
            footers: self.footers.clone(),
            source: self.source.clone(),
            gear,
            symmetry: self.symmetry.map(|s| (s.order, s.mirror)),
            refractive_index: self.refractive_index,
            unit: match self.unit.as_deref() {
                None => LengthUnit::Free,
                Some("mm") => LengthUnit::Millimetre,
                Some(other) => return Err(DocumentError::Unit(other.into())),
            },
            family: None,
            tiers: bench.tiers,
        };
        Ok(match length_to_width {
            Some(ratio) => scale_length_to_width(design, ratio)?,
            None => design,
        })
    }

    /// The document of a design: tiers by angle, distance and index where that gives back the very
    /// planes, explicit planes where not.
    pub fn from_design(design: &Design) -> DesignFile {
        DesignFile {
            name: design.name.clone(),
            source: design.source.clone(),
            unit: (design.unit == LengthUnit::Millimetre).then(|| "mm".into()),
            refractive_index: design.refractive_index,
            headers: design.headers.clone(),
            footers: design.footers.clone(),
            gear: Some(GearEntry { teeth: design.gear.teeth, offset: design.gear.offset }),
            symmetry: design.symmetry.map(|(order, mirror)| SymmetryEntry { order, mirror }),
            tier: design.tiers.iter().map(|t| TierEntry::from_tier(t, design.gear)).collect(),
            ..DesignFile::default()
        }
    }

    /// The TOML text.
    pub fn to_toml(&self) -> String {
        // every field is a plain value, so this form cannot fail to serialise
        toml::to_string(self).unwrap_or_default()
    }
}

/// The TOML text of tiers alone, as they stand in a design file of that gear.
pub fn tiers_to_toml(tiers: &[Tier], gear: Gear) -> String {
    #[derive(Serialize)]
    struct Tiers {
        tier: Vec<TierEntry>,
    }
    let tier = tiers.iter().map(|t| TierEntry::from_tier(t, gear)).collect();
    // as of a whole file
    toml::to_string(&Tiers { tier }).unwrap_or_default()
}

impl TierEntry {
    fn tier(&self, number: usize, gear: Gear, bench: &MeetPointSolver) -> Result<Tier, DocumentError> {
        let fail = |problem: String| DocumentError::Tier { number, name: self.name.clone(), problem };
        let mut facets = Vec::new();
        let mut angle_deg = self.angle;
        let count = self.indices.len().saturating_mul(self.repeat.unwrap_or(1) as usize);
        bench.limits.check(&limits::FACETS, count).map_err(|e| fail(e.to_string()))?;
        if [self.angle, self.girdle, self.width, self.table].iter().flatten().any(|x| !x.is_finite()) {
            return Err(fail("angle, girdle, width and table must be numbers".into()));
        }
        let indices = self.all_indices(gear);
        if !indices.is_empty() {
            let rule = self.rule().map_err(fail)?;
            if gear.teeth == 0.0 || angle_deg.is_some_and(|a| a.is_nan() || a.abs() > 90.0) {
                return Err(fail("angle must lie in −90..90 and the gear must have teeth".into()));
            }
            let named = self.repeat.is_some() || self.mirror || !matches!(rule, Rule::Distance(_));
            let cut = TierSpec { name: &self.name, angle_deg, indices: &indices, rule };
            let (angle, distance) = bench.place(&cut).map_err(|cause| DocumentError::Meet {
                number,
                name: self.name.clone(),
                cause,
            })?;
            angle_deg = Some(angle);
            let tier = Tier::new(&self.name, gear, angle, distance, &indices);
            facets.extend(tier.facets.into_iter().enumerate().map(|(i, facet)| Facet {
                name: self.names.get(i).cloned().unwrap_or(if named { facet.name } else { String::new() }),
                ..facet
            }));
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
        Ok(Tier { name: self.name.clone(), angle_deg, instructions: self.instructions.clone(), facets })
    }

    /// The indices with their repetitions around the wheel and their mirror images, each once, in
    /// the wheel's order from the first one given.
    fn all_indices(&self, gear: Gear) -> Vec<f64> {
        let mut all: Vec<f64> = Vec::new();
        let copies = self.repeat.unwrap_or(1).max(1);
        let teeth = gear.teeth.abs();
        let wheel = self.repeat.is_some() || self.mirror;
        for &index in &self.indices {
            for k in 0..copies {
                let turned = index + teeth * f64::from(k) / f64::from(copies);
                let both = [Some(turned), self.mirror.then_some(2.0 * gear.offset - turned)];
                for i in both.into_iter().flatten() {
                    let i = if wheel { i.rem_euclid(teeth) } else { i };
                    if !wheel || !all.iter().any(|j| (i - j).abs() < 1e-9 || (i - j).abs() > teeth - 1e-9) {
                        all.push(i);
                    }
                }
            }
        }
        if wheel && let Some(&first) = all.first() {
            all.sort_by(|a, b| (a - first).rem_euclid(teeth).total_cmp(&(b - first).rem_euclid(teeth)));
        }
        all
    }

    /// The one rule that fixes the distance.
    fn rule(&self) -> Result<Rule, String> {
        let meets = self.meets.clone().map(|corners| Rule::Meets {
            corners: match corners {
                MeetCorners::One(corner) => vec![corner],
                MeetCorners::Several(corners) => corners,
            },
            girdle: self.girdle.unwrap_or(0.0),
        });
        let given = [
            self.distance.map(Rule::Distance),
            meets,
            self.width.map(Rule::Width),
            self.table.map(Rule::Table),
        ];
        let mut given = given.into_iter().flatten();
        match (given.next(), given.next()) {
            (Some(Rule::Distance(d)), None) if !d.is_finite() => Err("distance must be a number".into()),
            (Some(_), Some(_)) => Err("has two rules for its distance: keep one".into()),
            (Some(rule), None) if self.girdle.is_none() || self.meets.is_some() => Ok(rule),
            (Some(_), None) => Err("girdle needs meets: the corner that it is left above or below".into()),
            (None, _) => Err("indices need a distance, or meets, width or table to find it".into()),
        }
    }

    fn from_tier(tier: &Tier, gear: Gear) -> TierEntry {
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
