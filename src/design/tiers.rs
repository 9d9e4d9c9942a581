//! A design: tiers of facets. The planes are the truth; everything else follows from them.
//!
//! Frame: right-handed, +z through the table, gear index 0 at −y, positive gears count
//! counter-clockwise seen from +z.

use crate::geometry::{Plane, Polyhedron, SolidError};
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;

/// The unit of a design's distances.
///
/// ```
/// use cutlab::{LengthUnit, Stone};
///
/// let stone = Stone::parse("tolkowsky")?.with_width(8.0)?;
/// assert_eq!(stone.unit(), LengthUnit::Millimetre);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LengthUnit {
    /// Millimetres: a stone of a definite size.
    Millimetre,
    /// No unit: only shape is known (every foreign design file).
    Free,
}

/// Girdle width of a stone of which nobody says how large it is, in millimetres.
pub const USUAL_WIDTH_MM: f64 = 6.5;

/// The index wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gear {
    /// Number of teeth; negative counts clockwise.
    pub teeth: f64,
    /// Index that stands at −y, in teeth.
    pub offset: f64,
}

impl Default for Gear {
    fn default() -> Self {
        Self { teeth: 96.0, offset: 0.0 }
    }
}

/// One facet.
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    /// Its name, possibly empty.
    pub name: String,
    /// Its index on the wheel, if it was cut by index.
    pub index: Option<f64>,
    /// Its plane.
    pub plane: Plane,
}

/// Facets cut at one angle and distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Tier {
    /// Its name, possibly empty.
    pub name: String,
    /// Angle from the girdle plane in degrees, negative on the pavilion; none if the facets came
    /// from a mesh.
    pub angle_deg: Option<f64>,
    /// What the cutter is told to do.
    pub instructions: String,
    /// The facets, in cutting order.
    pub facets: Vec<Facet>,
}

/// What a design of a family was built from.
#[derive(Debug, Clone, PartialEq)]
pub struct FamilyValues {
    /// The family's name.
    pub name: String,
    /// Values that differ from its defaults, by parameter.
    pub given: BTreeMap<String, f64>,
}

/// A gem design.
///
/// ```
/// use cutlab::Stone;
///
/// let design = Stone::parse("tolkowsky")?.into_design()?;
/// assert_eq!((design.facets().count(), design.solid()?.faces.len()), (153, 153));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// Its name: from the library, the file's first header line, or the file name.
    pub name: String,
    /// Header lines.
    pub headers: Vec<String>,
    /// Footnotes.
    pub footers: Vec<String>,
    /// Where its proportions are from.
    pub source: String,
    /// Index wheel.
    pub gear: Gear,
    /// Rotational order and mirror symmetry as the file states them.
    pub symmetry: Option<(u32, bool)>,
    /// The index of refraction it was drawn for.
    pub refractive_index: Option<f64>,
    /// Unit of the distances.
    pub unit: LengthUnit,
    /// The family that it was built by, with its values; none of a design of tiers, or that was changed since.
    pub family: Option<FamilyValues>,
    /// The tiers, in cutting order.
    pub tiers: Vec<Tier>,
}

/// The part of the stone a facet belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Zone {
    /// Horizontal, on top.
    Table,
    /// Facing up.
    Crown,
    /// Vertical.
    Girdle,
    /// Facing down.
    Pavilion,
    /// Horizontal, at the bottom.
    Culet,
}

impl Zone {
    /// Zone of a facet with unit normal `n`.
    pub fn from_normal(n: DVec3) -> Zone {
        /// A facet tilted less than this (0.06°) from the vertical is a girdle facet, from the
        /// horizontal a table or culet: larger than the error of a mesh in f32, smaller than any
        /// angle that a cutter sets on purpose.
        const FLAT: f64 = 1e-3;
        let sin = n.truncate().length();
        match (n.z.abs() < FLAT, sin < FLAT, n.z > 0.0) {
            (true, ..) => Zone::Girdle,
            (_, true, true) => Zone::Table,
            (_, true, false) => Zone::Culet,
            (_, _, true) => Zone::Crown,
            (_, _, false) => Zone::Pavilion,
        }
    }

    /// The zone's name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Zone::Table => "table",
            Zone::Crown => "crown",
            Zone::Girdle => "girdle",
            Zone::Pavilion => "pavilion",
            Zone::Culet => "culet",
        }
    }
}

/// The outward normal of a facet cut at `angle_deg` from the girdle plane at `index`.
///
/// - `angle_deg`: negative (also −0.0) on the pavilion, ±90 on the girdle
///
/// az = 2π (index − offset)/teeth; n = (sin az sin|a|, −cos az sin|a|, ±cos a). Sines and cosines
/// of whole quarter turns are exact, so that a square stone is square.
pub fn facet_normal(gear: Gear, angle_deg: f64, index: f64) -> DVec3 {
    let (sin_az, cos_az) = turn_sin_cos((index - gear.offset) / gear.teeth);
    let (sin_a, cos_a) = turn_sin_cos(angle_deg.abs() / 360.0);
    let up = if angle_deg.is_sign_negative() { -1.0 } else { 1.0 };
    // the cosine of 90° comes as −0.0, and the sign of the girdle's 0 says on which side it is cut
    DVec3::new(sin_az * sin_a, -cos_az * sin_a, up * cos_a.abs())
}

/// Sine and cosine of a number of full turns, exact at quarter turns.
fn turn_sin_cos(turns: f64) -> (f64, f64) {
    let quarters = (turns * 4.0).round();
    let (s, c) = ((turns - quarters / 4.0) * std::f64::consts::TAU).sin_cos();
    match quarters.rem_euclid(4.0) as i64 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// Whether two tiers, by name and angle, differ in their distances only: the girdle of a fancy
/// outline, which a cutter reads as one tier.
pub fn same_cutting_row(a: (&str, Option<f64>), b: (&str, Option<f64>)) -> bool {
    let same = |a: f64, b: f64| (a - b).abs() < 0.005;
    !a.0.is_empty() && a.0 == b.0 && a.1.zip(b.1).is_some_and(|(a, b)| same(a, b))
}

impl Tier {
    /// A tier cut by angle and distance at the given indices; facets are named `name 1`, `name 2`
    /// … or just `name` if there is one.
    pub fn new(name: &str, gear: Gear, angle_deg: f64, distance: f64, indices: &[f64]) -> Tier {
        let facets = indices
            .iter()
            .enumerate()
            .map(|(i, &index)| Facet {
                name: if indices.len() == 1 { name.into() } else { format!("{name} {}", i + 1) },
                index: Some(index),
                plane: Plane { normal: facet_normal(gear, angle_deg, index), distance },
            })
            .collect();
        Tier { name: name.into(), angle_deg: Some(angle_deg), instructions: String::new(), facets }
    }
}

impl Tier {
    /// A name for each facet: its own, or the tier's with its number. Of a tier whose first facet alone
    /// is named, as GemCad's files have it, that name is the tier's.
    ///
    /// - `number`: of the tier, from 1, for one without a name
    pub fn labels(&self, number: usize) -> Vec<String> {
        let named = self.facets.iter().filter(|f| !f.name.is_empty()).count();
        let only_first = named == 1 && self.facets.len() > 1 && self.facets[0].name == self.name;
        let label = |(i, f): (usize, &Facet)| match (&*f.name, &*self.name) {
            ("", "") => format!("tier {number} {}", i + 1),
            ("", of) => format!("{of} {}", i + 1),
            (own, _) if i == 0 && only_first => format!("{own} 1"),
            (own, _) => own.to_owned(),
        };
        self.facets.iter().enumerate().map(label).collect()
    }
}

impl Design {
    /// An empty design of that name, without unit.
    pub fn new(name: impl Into<String>) -> Design {
        Design {
            name: name.into(),
            headers: Vec::new(),
            footers: Vec::new(),
            source: String::new(),
            gear: Gear::default(),
            symmetry: None,
            refractive_index: None,
            unit: LengthUnit::Free,
            family: None,
            tiers: Vec::new(),
        }
    }

    /// A design of bare planes, one tier a zone (table, crown, girdle, pavilion, culet); `facets`
    /// are (name, plane). Used for meshes, whose facets have no tiers.
    pub fn from_facets(name: impl Into<String>, facets: impl IntoIterator<Item = (String, Plane)>) -> Design {
        let mut design = Design::new(name);
        for (facet_name, plane) in facets {
            let zone = Zone::from_normal(plane.normal).name();
            let facet = Facet { name: facet_name, index: None, plane };
            match design.tiers.iter_mut().find(|t| t.name == zone) {
                Some(tier) => tier.facets.push(facet),
                None => design.tiers.push(Tier {
                    name: zone.into(),
                    angle_deg: None,
                    instructions: String::new(),
                    facets: vec![facet],
                }),
            }
        }
        design
    }

    /// All facets, tier after tier.
    pub fn facets(&self) -> impl Iterator<Item = &Facet> {
        self.tiers.iter().flat_map(|t| &t.facets)
    }

    /// All planes, in the order of [`Design::facets`].
    pub fn planes(&self) -> Vec<Plane> {
        self.facets().map(|f| f.plane).collect()
    }

    /// The solid that the facets leave; face `plane` numbers count [`Design::facets`].
    pub fn solid(&self) -> Result<Polyhedron, SolidError> {
        Polyhedron::from_planes(&self.planes())
    }

    fn each_plane(mut self, change: impl Fn(&Plane) -> Plane) -> Design {
        for facet in self.tiers.iter_mut().flat_map(|t| &mut t.facets) {
            facet.plane = change(&facet.plane);
        }
        self
    }

    /// The design scaled by `k` about its origin, in millimetres.
    pub fn scaled_to_mm(self, k: f64) -> Design {
        let mut design = self.each_plane(|p| p.scaled(k));
        design.unit = LengthUnit::Millimetre;
        if k != 1.0 {
            design.family = None;
        }
        design
    }

    /// The design scaled so that its girdle width is `mm`.
    pub fn sized(self, mm: f64) -> Result<Design, SolidError> {
        let width = self.solid()?.width();
        Ok(self.scaled_to_mm(mm / width))
    }

    /// The design turned by `rotation` about the origin; indices and angles no longer hold and go.
    pub fn turned(self, rotation: DMat3) -> Design {
        let mut design = self.each_plane(|p| p.turned(rotation));
        design.family = None;
        for tier in &mut design.tiers {
            tier.angle_deg = None;
            tier.facets.iter_mut().for_each(|f| f.index = None);
        }
        design
    }
}
